"""How fast the errors of the cost fall with epsilon: averaged, with the end terms, with all of J1."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from pontryagin.averaging.correction import parts
from pontryagin.averaging.kepler_example import kepler
from pontryagin.averaging.rotor_example import rotor
from pontryagin.averaging.smooth import smooth_example
from pontryagin.averaging.solution import AveragedSolution
from pontryagin.averaging.spin_down_example import spin_down

Array = NDArray[np.float64]

EPSILONS = (0.05, 0.025, 0.0125, 0.00625)
X = sp.Symbol("x", real=True)
LOPSIDED = sp.Rational(2, 5) * sp.cos(X) + sp.Rational(2, 5) * sp.sin(2 * X)
"""A potential that no reflection of the angle leaves as it is."""


@dataclass(frozen=True)
class Errors:
    """Errors of the least cost of one problem at the epsilons (k).

    Attributes
    ----------
    name : str
    epsilon : (k,) array
    exact : (k,) array
        Least cost of the exact extremals.
    averaged, ends, corrected : (k,) array
        |J* - J0|, and the same after epsilon times the end terms of J1, or all of it, was taken off.
    """

    name: str
    epsilon: Array
    exact: Array
    averaged: Array
    ends: Array
    corrected: Array

    def slope(self, errors: Array) -> float:
        """Fitted slope of log error against log epsilon."""
        return float(np.polyfit(np.log(self.epsilon), np.log(errors), 1)[0])


def problems() -> dict[str, tuple[Callable[[], AveragedSolution], float]]:
    """The problems compared, each with its phase at the start."""
    uneven = 1 + sp.cos(X) / 5
    return {
        "rippled flywheel": (lambda: smooth_example(1, 2, k=1.0, ripple=0.5), 0.0),
        "uneven pendulum": (lambda: rotor(3, 6, mass=uneven, potential=sp.cos(X), force=0, k=1.0), 1.0),
        "Kepler orbit": (lambda: kepler(-0.5, 0.9, -0.3, 0.1), 0.0),
        "rigid body": (lambda: spin_down([1.0, 0.4, 2.0], [1.0, 0.5, 0.7], 1.6), 0.4),
        "lopsided rotor": (lambda: rotor(1.6, 4, mass=1, potential=LOPSIDED, force=0, k=1.0), 0.0),
    }


@cache
def errors(name: str, epsilons: tuple[float, ...] = EPSILONS) -> Errors:
    """Solve one of `problems` exactly at each epsilon and compare.

    Raises
    ------
    ValueError
        If there is no such problem.
    """
    if name not in problems():
        raise ValueError(f"name: got {name!r}, takes one of {', '.join(map(repr, problems()))}")
    make, phase = problems()[name]
    solution = make()
    begin = float(solution.initial_phase) if name == "rigid body" else phase
    small = np.array(epsilons)
    best = np.array([solution.exact(epsilon, begin)[0].cost for epsilon in epsilons])
    first = float(solution.cost)
    terms = {part: float(value) for part, value in parts(solution, begin).items()}
    ends, whole = terms["start"] + terms["end"], sum(terms.values())
    return Errors(
        name,
        small,
        best,
        np.abs(best - first),
        np.abs(best - first - small * ends),
        np.abs(best - first - small * whole),
    )
