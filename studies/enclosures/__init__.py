"""Proved intervals of optima, in ball arithmetic, around what the solvers return.

The numbers that a solver returns, and those of its problem, are taken as the rationals that they are. Its
control is completed to one that meets the constraints exactly, which proves one end of the interval. Its
multipliers prove the other. Every operation encloses its rounding errors (FLINT's balls).
"""
