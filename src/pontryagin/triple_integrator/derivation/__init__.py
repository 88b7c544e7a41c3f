"""Derivation of the optimal programmes (Gorelov & Morozova 2012) in SymPy, from first principles.

One module per step of the argument: `model` reduces the manoeuvre to a moment problem, `energy`, `peak`,
`impulse` and `time` solve it in L2, L-infinity and L1 and for least time.
"""
