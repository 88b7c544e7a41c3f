"""The paper's examples: the smooth one of section 3, the rotor, the Kepler orbit, the rigid body."""
