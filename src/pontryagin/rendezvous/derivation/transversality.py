"""The moving end: the anomaly at the meeting is free, which gives one condition on the costates, (16)."""

from functools import cache

import sympy as sp

from pontryagin.rendezvous.derivation import model, principle, reduction
from pontryagin.rendezvous.derivation.model import anomaly, attitude, c, eccentricity, r, v1
from pontryagin.rendezvous.derivation.quaternion import product, turn


def meeting() -> sp.Matrix:
    """The curve of meetings, with phi* as its parameter: r*, v1*, c*, phi* and lambda* of (5) and (6)."""
    ordered = model.target_radius(), model.target_radial_velocity(), model.areal, anomaly
    return sp.Matrix([*ordered, *model.target_attitude()])


def tangent() -> sp.Matrix:
    """Tangent of that curve, with lambda in place of lambda*.

    lambda* at a nearby anomaly is lambda* followed by a rotation about i3. The same holds for -lambda*, which
    is the same attitude, so in terms of lambda one formula gives the tangents at lambda* and at -lambda*.
    """
    step = sp.Symbol("step", real=True)
    nearby = product(attitude, turn(model.EZ, step)).diff(step).subs(step, 0)
    return sp.Matrix([*meeting()[:4, :].diff(anomaly), *nearby])


@cache
def condition() -> sp.Expr:
    """Left-hand side of (16), in C_phi: (costate, tangent) times (1 + e* cos phi*)^2."""
    growth = (1 + eccentricity * sp.cos(anomaly)) ** 2
    along_the_curve = principle.in_nu(sp.Matrix(principle.COSTATE).dot(tangent()))
    in_constant = along_the_curve.subs(principle.anomaly_costate, reduction.anomaly_costate_of())
    return sp.Add(*(sp.factor(growth * term) for term in in_constant.args))


def end_values() -> dict[sp.Symbol, sp.Expr]:
    """r, v1, c of (5) at the anomaly phi*."""
    return dict(zip((r, v1, c), meeting()[:3], strict=True))


def anomaly_constant_at_the_end() -> sp.Expr:
    """C_phi as (16) determines it at t_k."""
    return sp.solve(condition(), reduction.anomaly_constant)[0]
