"""Recordings that replay: a low-thrust spiral, a body freed of its precession, averaged beside exact.

`recordings` names them, each with the function that writes it; `record_solution` records any one problem.
Times are t = tau/epsilon, dimensionless, shown as seconds.
"""

from collections.abc import Callable
from pathlib import Path

from pontryagin.averaging.extremal import Extremal
from pontryagin.averaging.kepler_example import kepler
from pontryagin.averaging.replay import Pair
from pontryagin.averaging.solution import AveragedSolution


def recordings() -> dict[str, Callable[[Path], None]]:
    """The recordings of this paper: name and the function that writes the file."""
    return {"low-thrust-spiral": low_thrust_spiral}


def low_thrust_spiral(path: Path) -> None:
    """A low-thrust spiral.

    In ten revolutions a spacecraft raises the energy of its orbit from -1/2 to -1/5 by a weak thrust, at the
    least price of time and thrust together. Blue: the exact optimum and its osculating ellipse, on which the
    spacecraft would go on if the thrust stopped; black: what it has flown. Orange: the averaged optimum, which
    does not know where on its ellipse the spacecraft is. Grey: the first ellipse and the last averaged one.
    """
    solution = kepler(E0=-0.5, K0=0.95, E1=-0.2, l=0.1)
    record_solution(solution, solution.exact(0.01)[0], path)


def record_solution(solution: AveragedSolution, exact: Extremal, path: Path) -> None:
    """Record an exact extremal of one of the paper's examples beside the averaged solution.

    Parameters
    ----------
    solution : AveragedSolution
        Of one problem.
    exact : Extremal
        One of those that its `exact` found.
    path : Path
        File to write, ending in ``.rrd``.

    Raises
    ------
    ValueError
        If the solution is that of a stack.
    """
    from pontryagin.averaging import playback_orbit

    pair = Pair(solution, exact)
    playback_orbit.record_orbit(pair, path)
