"""Names, colours and axis labels that the figures of this paper share."""

from typing import Any

import numpy as np

from pontryagin.arrays import Array
from pontryagin.display.plotting import BLUE, GREEN, INK, ORANGE, PURPLE, RED
from pontryagin.errors import ArgumentValueError
from pontryagin.triple_integrator.least_time.time import TimeSolution
from pontryagin.triple_integrator.norms.energy import EnergySolution, minimum_energy
from pontryagin.triple_integrator.norms.impulse import ImpulseSolution, minimum_impulse
from pontryagin.triple_integrator.norms.norm import NormSolution
from pontryagin.triple_integrator.norms.peak import PeakSolution, minimum_peak
from pontryagin.triple_integrator.problem.maneuver import Maneuver

Solution = EnergySolution | PeakSolution | ImpulseSolution | NormSolution | TimeSolution

TIME = "$t$, s"
STATES = ("angle $x_1$, rad", "rate $x_2$, rad/s", "acceleration $x_3$, rad/s²")
CONTROL = "control $u$, rad/s³"

NAMES = {
    EnergySolution: "least energy, $L_2$",
    PeakSolution: r"least peak, $L_\infty$",
    ImpulseSolution: "least total impulse, $L_1$",
    TimeSolution: "least time",
}
COLOURS = {
    EnergySolution: BLUE,
    PeakSolution: RED,
    ImpulseSolution: GREEN,
    NormSolution: PURPLE,
    TimeSolution: ORANGE,
}


def three(maneuver: Maneuver) -> tuple[EnergySolution, PeakSolution, ImpulseSolution]:
    """The paper's three programmes for one manoeuvre."""
    single(maneuver)
    return minimum_energy(maneuver), minimum_peak(maneuver), minimum_impulse(maneuver)


def name(solution: Solution) -> str:
    """The quantity that a programme minimises, in words."""
    if isinstance(solution, NormSolution):
        return f"least $L_q$ norm, $q = {solution.q:g}$"
    return NAMES[type(solution)]


def colour(solution: Solution) -> str:
    """The colour of a programme, by its kind."""
    return COLOURS.get(type(solution), INK)


def value(solution: Solution) -> str:
    """The least value, with its symbol."""
    if isinstance(solution, TimeSolution):
        return rf"$T = {float(solution.duration):.4g}$ s"
    symbol = {
        EnergySolution: r"$\Vert u\Vert_2 = {}$ rad s$^{{-5/2}}$",
        PeakSolution: r"$\max\,|u| = {}$ rad/s³",
        ImpulseSolution: r"$\int\,|u|\,dt = {}$ rad/s²",
    }.get(type(solution), r"$\Vert u\Vert_q = {}$")
    return symbol.format(number(float(solution.norm)))


def number(x: float) -> str:
    """A number in mathtext with four digits, and with a power of ten if needed."""
    mantissa, _, exponent = f"{x + 0.0:.4g}".partition("e")
    return mantissa if not exponent else rf"{mantissa}\cdot 10^{{{int(exponent)}}}"


def single(solution: Any) -> Maneuver:
    """The manoeuvre of a solution of one problem.

    Raises
    ------
    ValueError
        If the solution is that of a stack.
    """
    maneuver: Maneuver = solution if isinstance(solution, Maneuver) else solution.maneuver
    if maneuver.shape:
        name = "maneuver" if solution is maneuver else "solution"
        raise ArgumentValueError(
            f"{name} must be that of one manoeuvre, got a stack of shape {maneuver.shape}", name
        )
    return maneuver


def instants(solution: Solution, count: int = 400) -> Array:
    """Times (k,) over the manoeuvre, with both sides of every instant where the programme is not smooth."""
    m = single(solution)
    even = np.linspace(float(m.t0), float(m.tf), count)
    cuts = solution.breakpoints
    ends = [np.nextafter(float(m.t0), np.inf), np.nextafter(float(m.tf), -np.inf)]
    beside = np.concatenate([np.nextafter(cuts, -np.inf), cuts, ends])
    return np.unique(np.clip(np.concatenate([even, beside]), m.t0, m.tf))
