"""The systems: the satellite near its circular orbit (section 7), and any system (1) of section 6."""
