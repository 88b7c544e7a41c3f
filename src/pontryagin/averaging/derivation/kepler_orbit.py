"""The orbit in the plane: place, velocity, thrust and osculating ellipse (Akulenko 1977, example 2).

Fixed axes through the attracting centre; gamma is the angle of the pericentre from the first.
"""

import sympy as sp

from pontryagin.averaging.derivation.kepler import (
    CONTROL,
    anomaly,
    conic,
    gamma,
    in_slow_variables,
    phi,
    r,
    v_radial,
    v_transverse,
)
from pontryagin.averaging.derivation.kepler_principle import maximiser


def frame() -> sp.Matrix:
    """Columns: the unit vectors along and across the radius, at phi = gamma + x."""
    return sp.rot_ccw_axis3(phi)[:2, :2].subs(phi, gamma + anomaly)


def in_the_plane(radial: sp.Expr, transverse: sp.Expr) -> sp.ImmutableMatrix:
    """A vector given along and across the radius, in fixed axes, as a function of E, K, gamma and x."""
    components = sp.Matrix([radial, transverse]).subs(conic()).applyfunc(in_slow_variables)
    return sp.ImmutableMatrix(frame() * components)


def position() -> sp.ImmutableMatrix:
    """Place (2, 1) from E, K, gamma, x; over x at fixed elements it traces the osculating ellipse."""
    return in_the_plane(r, sp.S.Zero)


def velocity() -> sp.ImmutableMatrix:
    """Velocity (2, 1) from E, K, gamma, x."""
    return in_the_plane(v_radial, v_transverse)


def thrust() -> sp.ImmutableMatrix:
    """u* of (3.8) in fixed axes (2, 1), from E, K, gamma, x, p_E, p_K; with p_K = 0 along the velocity."""
    return in_the_plane(*(maximiser()[u] for u in CONTROL))
