"""The expected number of extremals, |Psi(kappa'') - Psi(kappa')| / (pi epsilon), from the averaged family.

A member kappa of the averaged family ends with <h*> = -omega kappa, so that (2.7) holds at kappa = 0. The
exact extremals near it are where h* vanishes on the turn at its end: at two phases if h* rises and falls
once a turn, at four for the rigid body. The members counted lie between kappa' < 0 < kappa'', beyond which
h* keeps one sign, or Psi turns back, or there is no averaged solution. Over them the phase at the end runs
through |Psi(kappa'') - Psi(kappa')|/epsilon.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, lru_cache

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.solution import AveragedSolution
from pontryagin.averaging.averaged.solve import solved
from pontryagin.averaging.exact.arrivals import fixed_ending
from pontryagin.averaging.exact.canonical import Canonical, canonical, y
from pontryagin.errors import ArgumentValueError, Infeasible, NotConverged
from pontryagin.numerics import compile as compiler
from pontryagin.validation import positive

POINTS = 2048
"""Number of anomalies over a turn at which h* is compared with zero."""
FIRST = 1 / 16
"""First step of kappa, relative to the mean running cost over the frequency."""
EXACT, NEAR = 1e-7, 1e-3
"""Tolerances of kappa at a window's end, and at one without solutions beyond; in the unit of `FIRST`."""
CELLS = 48
"""The roots on a turn are counted in this many parts of the window."""
LEVEL = 1e-12
"""A range of h* over a turn below this share of the mean running cost counts as zero."""


@dataclass(frozen=True)
class Window:
    """The range of kappa for which h* vanishes somewhere on the turn at the averaged solution's end.

    Attributes
    ----------
    kappa : (2,) array
        kappa' and kappa''.
    turned : (2,) array
        Psi at these: the integral of omega over the slow time, an angle.
    roots : float
        Roots of h* at the end on a turn, on average over Psi.
    authority : float
        dPsi/dkappa at kappa = 0, (2.15): how far the control moves the phase at the end. The error of the
        first correction holds up to epsilon^2 pi^2/2 over this.
    limits : tuple of two str
        Why the window ends: "no further root", "turning point" of Psi, or "no solution" of the averaged
        problem, where there may be more extremals than are counted.
    """

    kappa: Array
    turned: Array
    roots: float
    authority: float
    limits: tuple[str, str]

    def count(self, epsilon: float) -> float:
        """Expected number of extremals: roots |Psi(kappa'') - Psi(kappa')| / (2 pi epsilon)."""
        small = float(positive("epsilon", epsilon))
        return float(self.roots * abs(self.turned[1] - self.turned[0]) / (2 * np.pi * small))


def window(solution: AveragedSolution) -> Window:
    """The range of kappa, about a solution at kappa = 0, for which h* has roots at the end.

    Raises
    ------
    ValueError
        If the solution is a stack, its kappa is not zero, its anomaly at the end cannot be chosen (least time
        with one slow variable), or h* does not depend on the phase at the end.

    Examples
    --------
    >>> from pontryagin.averaging import smooth_example
    >>> roots = window(smooth_example(1.0, 2.0, ripple=0.5))
    >>> round(roots.count(0.01)), roots.limits
    (35, ('no further root', 'no further root'))
    """
    if solution.duration.shape or solution.kappa != 0:
        got = (
            f"a stack of shape {shape}"
            if (shape := solution.duration.shape)
            else f"kappa = {solution.kappa:g}"
        )
        raise ArgumentValueError(f"solution must be that of one problem, at kappa = 0, got {got}", "solution")
    if fixed_ending(canonical(solution.system)):
        message = (
            "solution must leave the control a choice of the end's anomaly, got the least time with one slow "
            "variable, which leaves none"
        )
        raise ArgumentValueError(message, "solution")
    if np.ptp(_at_end(solution)) <= LEVEL * float(solution.cost / solution.duration):
        message = (
            "solution must end where h* depends on the phase, got one whose h* does not: "
            "there is one extremal only"
        )
        raise ArgumentValueError(message, "solution")

    @cache
    def member(kappa: float) -> AveragedSolution:
        return _members(solution, kappa)

    unit = float(solution.cost / solution.duration / solution.frequency([0.0])[0])
    low, high = (_limit(member, sense, unit) for sense in (-1, 1))
    kappa = np.array([low[0], high[0]])
    small = 1e-3 * unit
    authority = (_phase_angle(member(small)) - _phase_angle(member(-small))) / (2 * small)
    inside = _members(solution, kappa[0] + np.ptp(kappa) * (np.arange(CELLS) + 0.5) / CELLS)
    return Window(kappa, np.array([low[1], high[1]]), _roots(inside), float(authority), (low[2], high[2]))


def _members(solution: AveragedSolution, kappa: float | Array) -> AveragedSolution:
    """The averaged solutions of the same problem at other kappas."""
    return solved(
        solution.model,
        solution.names,
        solution.start,
        solution.numbers,
        solution.make_system,
        kappa=kappa,
    )


def _roots(members: AveragedSolution) -> float:
    """Roots of h* on the turn at the end, averaged over Psi."""
    above = _at_end(members) > 0
    count = (above != np.roll(above, 1, axis=-1)).sum(axis=-1)
    weight = np.gradient(members.phase(members.duration[:, None], 1.0, 0.0)[:, 0])
    return float((count * weight).sum() / weight.sum())


def _limit(one: Callable[[float], AveragedSolution], sense: int, unit: float) -> tuple[float, float, str]:
    """kappa, Psi and the reason at one end of the window."""

    def excess(kappa: float) -> float:
        """Largest h* on the turn at the end, with the sign opposite to its mean -kappa omega."""
        return float((sense * _at_end(one(kappa))).max())

    def angle(kappa: float) -> float:
        return _phase_angle(one(kappa))

    here, step = 0.0, sense * FIRST * unit
    last, reason = angle(0.0), "no further root"
    while abs(step) > (NEAR if reason == "no solution" else EXACT) * unit:
        try:
            there, after = excess(here + step), angle(here + step)
        except (NotConverged, Infeasible, ValueError):
            step, reason = step / 2, "no solution"
            continue
        if sense * (after - last) < 0:
            edges = (min(here - step, here + step), max(here - step, here + step))
            kappa = float(minimize_scalar(lambda k: -sense * angle(k), bounds=edges, method="bounded").x)
            if excess(kappa) >= 0:
                return kappa, angle(kappa), "turning point"
            there = -1.0
        if there < 0:
            kappa = float(brentq(excess, here, here + step, xtol=EXACT * EXACT * unit))
            return kappa, angle(kappa), "no further root"
        here, last = here + step, after
        step = step if reason == "no solution" else 2 * step
    return here, last, reason


def _phase_angle(solution: AveragedSolution) -> float:
    return float(solution.phase(solution.duration, 1.0, 0.0)[0])


def _at_end(solution: AveragedSolution) -> Array:
    """h* of the averaged solution on the turn at the end, which (2.6) makes zero, (..., points)."""
    end = solution.duration[..., None]
    z = np.concatenate([solution.slow(end), solution.costate(end)], axis=-1)
    x = 2 * np.pi * np.arange(POINTS) / POINTS
    numbers = [np.asarray(number)[..., None] for number in solution.numbers]
    (h,) = _hamiltonian(canonical(solution.system))(*np.moveaxis(z[..., 0, :], -1, 0)[..., None], x, *numbers)
    return np.asarray(h)


@lru_cache(maxsize=32)
def _hamiltonian(equations: Canonical) -> Callable[..., tuple[Array, ...]]:
    arguments = [*equations.slow, *equations.costates, equations.anomaly, *equations.parameters[1:]]
    return compiler.function("hamiltonian", arguments, {"h": equations.hamiltonian.subs(y, 0)})
