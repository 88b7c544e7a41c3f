"""The extremals of the system before averaging, (1.4) to (1.6): found, counted and certified."""
