"""The control of least norm for a given duration, (1.13) to (1.20): one module for each norm."""
