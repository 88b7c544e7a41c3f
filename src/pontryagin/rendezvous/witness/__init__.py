"""Independent checks of a flight: Newton's law and Kepler's equation in inertial axes."""
