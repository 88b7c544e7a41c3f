"""The orbit in the plane: position, velocity, thrust and osculating ellipse (Akulenko 1977, example 2).

Fixed axes with the attracting centre as origin; gamma is the angle from the first axis to the pericentre.
"""

import sympy as sp

from pontryagin.averaging.derivation.kepler import (
    CONTROL,
    affine,
    anomaly,
    conic,
    element_rates,
    epsilon,
    gamma,
    in_slow_variables,
    phi,
    r,
    v_radial,
    v_transverse,
)
from pontryagin.averaging.derivation.kepler_phase import true_from_eccentric
from pontryagin.averaging.derivation.kepler_principle import maximiser


def frame() -> sp.Matrix:
    """Matrix whose columns are the unit vectors along and across the radius, at phi = gamma + x."""
    return sp.rot_ccw_axis3(phi)[:2, :2].subs(phi, gamma + anomaly)


def in_the_plane(radial: sp.Expr, transverse: sp.Expr) -> sp.ImmutableMatrix:
    """A vector in fixed axes from its radial and transverse components, in terms of E, K, gamma and x."""
    components = sp.Matrix([radial, transverse]).subs(conic()).applyfunc(in_slow_variables)
    return sp.ImmutableMatrix(frame() * components)


def position() -> sp.ImmutableMatrix:
    """Position (2, 1) from E, K, gamma, x; as x varies at fixed elements it traces the osculating ellipse."""
    return in_the_plane(r, sp.S.Zero)


def velocity() -> sp.ImmutableMatrix:
    """Velocity (2, 1) from E, K, gamma, x."""
    return in_the_plane(v_radial, v_transverse)


def thrust() -> sp.ImmutableMatrix:
    """u* of (3.8) in fixed axes (2, 1), from E, K, gamma, x, p_E, p_K; along the velocity if p_K = 0."""
    return in_the_plane(*(maximiser()[u] for u in CONTROL))


def any_thrust() -> sp.ImmutableMatrix:
    """A thrust (u_r, u_phi) in fixed axes (2, 1), from E, K, gamma, x, u_r, u_phi."""
    return in_the_plane(*CONTROL)


def true_anomaly() -> sp.Expr:
    """x within one turn, from E, K and the eccentric anomaly xi."""
    parts = {part: in_slow_variables(seen) for part, seen in true_from_eccentric().items()}
    return sp.atan2(parts[sp.sin(anomaly)], parts[sp.cos(anomaly)])


def pericentre_rate() -> sp.Expr:
    """gamma' per epsilon, from E, K, x, u_r, u_phi; without thrust the pericentre is fixed."""
    return in_slow_variables(affine(element_rates()[gamma] / epsilon))
