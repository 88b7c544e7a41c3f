"""Derivation of the optimal programmes (Gorelov & Morozova 2012) in SymPy, from first principles.

There is one module for each step of the argument. `channel` and `model` reduce the manoeuvre to a moment
problem; `energy`, `peak`, `impulse` and `time` solve it in L2, L-infinity and L1 and for least time;
`duality` holds the exact bounds. `parabola` and `chebyshev` follow the paper's own routes, `coverage`
determines where (4.10) holds, and `rigid_body` derives the torques and couplings of the body in space.
"""
