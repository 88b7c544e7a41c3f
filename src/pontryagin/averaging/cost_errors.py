"""Errors of the cost against epsilon: averaged, corrected by the end terms of J1, and by all of J1."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import sympy as sp

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.solution import AveragedSolution
from pontryagin.averaging.exact.arrivals import fixed_ending
from pontryagin.averaging.exact.canonical import canonical
from pontryagin.averaging.exact.extremal import Extremal
from pontryagin.averaging.examples.kepler import kepler
from pontryagin.averaging.examples.rotor import rotor
from pontryagin.averaging.examples.smooth import smooth_example
from pontryagin.averaging.examples.spin_down import spin_down
from pontryagin.errors import ArgumentValueError
from pontryagin.io.kept_results import kept

EPSILONS = (0.04, 0.028, 0.02, 0.014, 0.01, 0.007)
X = sp.Symbol("x", real=True)


@dataclass(frozen=True)
class CostErrors:
    """Errors of the least cost of one problem at the epsilons (k).

    Attributes
    ----------
    name : str
    epsilon : (k,) array
    exact : (k,) array
        Least cost of the exact extremals.
    between : (k,) array
        Least value of the parabola through the best minimum and its neighbours over the ending anomaly: the
        best cost if the phase at the end were not restricted to whole turns.
    first : float
        J0.
    terms : dict
        The terms of J1, by `AveragedSolution.correction_terms`: numbers, or (k,) arrays where J1 depends on
        the anomaly at which the exact optimum ends.
    """

    name: str
    epsilon: Array
    exact: Array
    between: Array
    first: float
    terms: dict[str, Array]

    @property
    def correction(self) -> Array:
        """J1."""
        return np.asarray(np.add.reduce([*self.terms.values()]))

    @property
    def averaged(self) -> Array:
        """|J - J0|, (k,), with J as in `between`."""
        return np.abs(self.between - self.first)

    @property
    def ends(self) -> Array:
        """The error that is left when only the end terms of J1 are used, (k,)."""
        return np.abs(self.between - self.first - self.epsilon * (self.terms["start"] + self.terms["end"]))

    @property
    def corrected(self) -> Array:
        """|J - J0 - epsilon J1|, (k,)."""
        return np.abs(self.between - self.first - self.epsilon * self.correction)

    def slope(self, errors: Array) -> float:
        """Fitted slope of log error against log epsilon."""
        return float(np.polyfit(np.log(self.epsilon), np.log(errors), 1)[0])


def problems() -> dict[str, tuple[Callable[[], AveragedSolution], float | None]]:
    """The problems compared, each with its phase at the start, or None for the solution's own."""
    uneven = 1 + sp.cos(X) / 5
    return {
        "rippled flywheel": (lambda: smooth_example(1, 2, k=1.0, ripple=0.5), 0.0),
        "uneven pendulum": (lambda: rotor(3, 6, mass=uneven, potential=sp.cos(X), force=0, k=1.0), 1.0),
        "Kepler orbit": (lambda: kepler(-0.5, 0.9, -0.3, 0.1), 0.0),
        "rigid body": (lambda: spin_down([1.0, 0.4, 2.0], [1.0, 0.5, 0.7], 1.6), None),
        "lopsided rotor": (lambda: rotor(1.6, 4, mass=1, potential=sp.cos(X), force=sp.sin(X), k=1.0), 0.0),
    }


@kept
def errors(name: str, epsilons: tuple[float, ...] = EPSILONS) -> CostErrors:
    """Solve one of `problems` exactly at each epsilon, and find the errors of its approximate costs.

    Raises
    ------
    ValueError
        If there is no such problem.
    """
    if name not in problems():
        raise ArgumentValueError(
            f"name: got {name!r}, takes one of {', '.join(map(repr, problems()))}", "name"
        )
    make, phase = problems()[name]
    return measured(make(), epsilons, phase, name)


def measured(
    solution: AveragedSolution,
    epsilons: Sequence[float] = EPSILONS,
    phase: float | None = None,
    name: str = "",
) -> CostErrors:
    """Solve a problem exactly at each epsilon, and find the errors of its approximate costs.

    Parameters
    ----------
    solution : AveragedSolution
        The averaged solution of one problem.
    epsilons : sequence of float
        Positive; at least two for slopes.
    phase : float, optional
        psi_0; the solution's own by default.
    name : str

    Examples
    --------
    >>> solution = rotor(2.0, 5.0, potential=sp.cos(X), peak=1.0)
    >>> found = measured(solution, [0.04, 0.02, 0.01])
    >>> found.slope(found.corrected) > 1.8
    True
    """
    begin = float(solution.initial_phase) if phase is None else phase
    found = [solution.exact(epsilon, begin) for epsilon in epsilons]
    best = np.array([some[0].cost for some in found])
    between = np.array([least_between(some) for some in found])
    ends = [some[0].ending_anomaly for some in found] if fixed_ending(canonical(solution.system)) else [None]
    each = [solution.correction_terms(begin, end) for end in ends]
    terms = {part: np.array([float(one[part]) for one in each]) for part in each[0]}
    if len(each) == 1:
        terms = {part: value[0] for part, value in terms.items()}
    return CostErrors(name, np.array(epsilons), best, between, float(solution.cost), terms)


def least_between(found: Sequence[Extremal]) -> float:
    """Vertex of the parabola through the best minimum and the minima a turn before and after it.

    It is the cost of the best minimum itself where one of these neighbours is missing.
    """
    minima = sorted((one for one in found if one.kind == "minimum"), key=lambda one: one.ending_anomaly)
    costs = [one.cost for one in minima]
    i = int(np.argmin(costs))
    if not 0 < i < len(minima) - 1:
        return costs[i]
    theta = np.array([one.ending_anomaly for one in minima[i - 1 : i + 2]])
    bend, slope, level = np.polyfit(theta - theta[1], costs[i - 1 : i + 2], 2)
    return float(level - slope**2 / (4 * bend))


def ahead() -> None:
    """Find the errors of all problems, the last first, while a notebook does so from the first on."""
    for name in reversed(problems()):
        errors.ahead(name)
