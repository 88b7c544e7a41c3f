"""Newton's method for the conditions of a meeting in the reduced form, and families of its solutions."""

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from pontryagin.arrays import Array
from pontryagin.numerics.continuation import Family, Point, follow
from pontryagin.rendezvous.families import Shooting, fine_grid
from pontryagin.rendezvous.reduced.conditions import ReducedEquations, Setting, equations
from pontryagin.rendezvous.reduced.flight import (
    Flight,
)
from pontryagin.rendezvous.root import Root, root, scales
from pontryagin.rendezvous.terminal_law import end_switching_slopes

WITHIN = 5.0
"""Largest factor by which a step of Newton's method may change a free duration."""
ITERATIONS, HALVINGS = 12, 6
"""Largest number of steps of Newton's method, and how many lengths of each are tried."""
PACES = {
    "duration": (0.1, 0.5, 400),
    "lead": (0.3, 1.5, 100),
    "peak": (0.1, 1.0, 120),
    "ratio": (0.3, 3.0, 80),
}
"""First step, largest step and largest number of steps along the curve over each parameter."""


def meet(setting: Setting, unknowns: Array) -> Root[Flight]:
    """The meeting that Newton's method reaches; the first steps use rough flights.

    Raises
    ------
    NotConverged
        If it reaches none.
    """
    rough = setting.replace(rough=True)
    return root(
        lambda x: equations(setting, x),
        unknowns,
        within=WITHIN,
        rough=lambda x: equations(rough, x),
        iterations=ITERATIONS,
        halvings=HALVINGS,
    )


def family(setting: Setting, name: str) -> Family[ReducedEquations]:
    """The equations as a family over one attribute of the setting.

    Parameters
    ----------
    setting : Setting
        The setting, which gives all other attributes.
    name : "peak", "ratio", "duration" or "lead"
        The attribute. The parameter is the lead itself, or the logarithm of one of the others. For "ratio"
        the costates are divided by |n(t_k)|, which keeps their size nearly constant. For "duration" there are
        six unknowns; the last of the seven equations, the terminal law, is evaluated but not solved.
    """

    def over_duration(unknowns: Array, parameter: float) -> tuple[ReducedEquations, Array]:
        duration = math.exp(parameter)
        values = equations(setting.replace(duration=None), np.append(unknowns, duration))
        return values, values.jacobian[:6, 6] * duration

    def over_ratio(unknowns: Array, parameter: float) -> tuple[ReducedEquations, Array]:
        there = setting.replace(ratio=math.exp(parameter))
        scale, (growth, _) = _end_scale(there), end_switching_slopes(there.ratio, there.peak)
        values = equations(there, unknowns * scale)
        by_ratio = values.by_ratio + values.jacobian[:, :6] @ unknowns[:6] * growth
        return replace(values, jacobian=values.jacobian * scale), by_ratio

    def over_peak(unknowns: Array, parameter: float) -> tuple[ReducedEquations, Array]:
        values = equations(setting.replace(peak=math.exp(parameter)), unknowns)
        return values, values.by_peak

    def over_lead(unknowns: Array, parameter: float) -> tuple[ReducedEquations, Array]:
        values = equations(setting.replace(lead=parameter), unknowns)
        return values, values.by_lead

    return {"duration": over_duration, "ratio": over_ratio, "peak": over_peak, "lead": over_lead}[name]


def _end_scale(setting: Setting) -> Array:
    """|n(t_k)| for the six costates, and 1 for t_k."""
    return np.append(np.full(6, setting.end_switching), 1.0)


def curve(
    setting: Setting, start: Root[Flight], name: str, towards: float
) -> Iterator[Point[ReducedEquations]]:
    """The curve of extremals through a given one as an attribute of the setting changes, by rough flights.

    Parameters
    ----------
    setting : Setting
        The setting that the start solves; the curve begins at its value of the attribute.
    start : Root
        An extremal.
    name : "peak", "ratio", "duration" or "lead"
        The attribute that changes; `family` states the parameter.
    towards : float
        The value of the parameter in whose direction the curve is followed first.
    """
    rough = setting.replace(
        rough=True, ratio=1.0 if name == "duration" and not setting.free else setting.ratio
    )
    begin = {
        "peak": lambda: math.log(setting.peak),
        "ratio": lambda: math.log(setting.ratio),
        "duration": lambda: math.log(start.flight.duration),
        "lead": lambda: setting.lead,
    }[name]()
    step, largest, steps = PACES[name]
    unscaled = name == "ratio"
    unknowns = start.unknowns / _end_scale(setting) if unscaled else start.unknowns
    points = follow(
        family(rough, name),
        unknowns,
        begin,
        towards - begin,
        scales=scales,
        step=step,
        largest=largest,
        steps=steps,
        rows=6 if name == "duration" else None,
    )
    for point in points:
        scale = _end_scale(setting.replace(ratio=math.exp(point.parameter))) if unscaled else 1.0
        yield replace(point, unknowns=point.unknowns * scale)


def _thrust(flight: Flight) -> Array:
    """|p| on a fine grid."""
    return np.asarray(np.linalg.norm(flight.thrust(fine_grid(flight.duration)), axis=1))


SHOOTING = Shooting(
    meet=meet,
    equations=equations,
    curve=curve,
    released=np.append,
    law=lambda setting, point: float(point.equations.residual[-1]),
    thrust=_thrust,
)
"""The reduced form as a formulation for `pontryagin.rendezvous.families`."""
