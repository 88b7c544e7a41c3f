"""How many extremals there are: the window of the family in which h* takes both signs over a turn.

A member kappa of the averaged family ends with <h*> = -omega kappa. The exact extremals near it are where h*
vanishes, and they exist as long as h* takes both signs over a turn of the phase there. Between the two ends
of that window the phase turns through (Psi(kappa'') - Psi(kappa'))/epsilon, with two extremals to a turn.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from pontryagin import compile as compiler
from pontryagin.averaging.solution import AveragedSolution, solve_averaged
from pontryagin.errors import Infeasible, NotConverged

Array = NDArray[np.float64]

POINTS = 512
"""Anomalies over a turn at which h* is compared with zero."""
STEPS = 60
"""Steps outwards from kappa = 0."""


@dataclass(frozen=True)
class Window:
    """The range of kappa about 0 in which there are extremals.

    Attributes
    ----------
    low, high : float
        kappa' and kappa''.
    turned : tuple of two float
        Psi, the integral of omega over (0, tau_1), at both.
    """

    low: float
    high: float
    turned: tuple[float, float]

    def count(self, epsilon: float) -> float:
        """|Psi(kappa'') - Psi(kappa')| / (pi epsilon): two extremals to a turn."""
        return abs(self.turned[1] - self.turned[0]) / (np.pi * epsilon)


def window(solution: AveragedSolution) -> Window:
    """Where h* at the end, over a turn of the phase, touches zero.

    Parameters
    ----------
    solution : AveragedSolution
        Of one problem with a smooth family.

    Raises
    ------
    NotConverged
        If the family ends before h* keeps one sign, or h* keeps one sign at kappa = 0 already.

    Examples
    --------
    >>> from pontryagin.averaging import smooth_example
    >>> found = window(smooth_example(1, 2, k=1.0, ripple=0.5))
    >>> round(found.high, 9) == round((5**0.5 - 1) / 4, 9)
    True
    """
    low, high = (_border(solution, sense) for sense in (-1, 1))
    return Window(low, high, (_turned(solution, low), _turned(solution, high)))


def _border(solution: AveragedSolution, sense: int) -> float:
    """The kappa on one side at which the least (or largest) h* over a turn vanishes."""

    def distance(kappa: float) -> float:
        return _extreme(solution, kappa, sense)

    if not distance(0.0) > 0:
        raise NotConverged("h* does not depend on the phase at kappa = 0: there is one extremal", 0.0)
    rate = -float(_ending(solution, 0.0).min()) / float(solution.frequency([float(solution.duration)])[0])
    step, inside = sense * rate / 8, 0.0
    for _ in range(STEPS):
        try:
            reached = distance(inside + step)
        except (ValueError, Infeasible, NotConverged):
            step /= 2
            continue
        if reached <= 0:
            low, high = sorted((inside, inside + step))
            return float(brentq(distance, low, high, xtol=1e-13))
        inside += step
    raise NotConverged("the averaged family ends before h* keeps one sign", distance(inside))


def _extreme(solution: AveragedSolution, kappa: float, sense: int) -> float:
    """How far h* over a turn reaches beyond zero: upwards for a positive kappa, downwards for a negative."""
    return float((sense * _ending(solution, kappa)).max())


def _ending(solution: AveragedSolution, kappa: float) -> Array:
    """h* at the end of a member, over a turn."""
    member = _member(solution, kappa)
    last = [float(member.duration)]
    z = [*member.slow(last)[0], *member.costate(last)[0]]
    system = member.system
    numbers = [float(number) for number in member.numbers]
    x = 2 * np.pi * np.arange(POINTS) / POINTS
    return np.broadcast_to(_hamiltonian(system)(*z, x, *numbers)[0], x.shape)


def _turned(solution: AveragedSolution, kappa: float) -> float:
    member = _member(solution, kappa)
    first, last = member.phase([0.0, float(member.duration)], 1.0, 0.0)
    return float(last - first)


def _member(solution: AveragedSolution, kappa: float) -> AveragedSolution:
    return solve_averaged(solution.system, solution.start, kappa=kappa)


@lru_cache(maxsize=32)
def _hamiltonian(system):
    h = system.hamiltonian.subs(system.phase_costate, 0)
    return compiler.function("h", [*system.slow, *system.costates, system.phase, *system.numbers], {"h": h})
