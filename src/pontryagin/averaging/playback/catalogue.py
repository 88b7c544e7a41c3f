"""The recordings of this paper: a low-thrust spiral, a body freed of its precession, any single problem.

`recordings` names them, each with the function that writes it; `record_solution` records one problem.
Times are t = tau/epsilon, dimensionless, shown as seconds.
"""

from collections.abc import Callable
from pathlib import Path

from pontryagin.averaging.averaged.solution import AveragedSolution
from pontryagin.averaging.exact.extremal import Extremal
from pontryagin.averaging.examples.kepler import kepler
from pontryagin.averaging.examples.spin_down import spin_down
from pontryagin.averaging.playback.body import record_body
from pontryagin.averaging.playback.orbit import record_orbit
from pontryagin.averaging.playback.pair import Pair
from pontryagin.averaging.playback.wheel import record_wheel
from pontryagin.errors import ArgumentValueError


def recordings() -> dict[str, Callable[[Path], None]]:
    """The recordings of this paper: name and the function that writes the file."""
    return {"low-thrust-spiral": low_thrust_spiral, "precession-removed": precession_removed}


def low_thrust_spiral(path: Path) -> None:
    """A low-thrust spiral.

    A spacecraft raises the energy E of its orbit by weak thrust, at the least price of time and thrust.
    Blue: the exact optimum, on the ellipse it would keep if the thrust stopped; black: its path. Orange: the
    averaged optimum, which does not depend on where on its ellipse the spacecraft is. Grey: first and last
    ellipse. The costate of the anomaly oscillates about zero and vanishes at the end: no neighbouring place
    of arrival costs less.
    """
    solution = kepler(E0=-0.5, K0=0.95, E1=-0.2, l=0.1)
    record_solution(solution, solution.exact(0.01)[0], path)


def precession_removed(path: Path) -> None:
    """A tumbling body freed of its precession.

    Two equal bodies in inertial space. A weak torque takes away the angular velocity across the body's axis
    in the least time; without it the axis would circle the angular momentum for ever. Left, above: the
    averaged optimum as a feedback law; below: the exact optimum. Middle: both controls in body axes, on the
    ellipsoid that bounds them.
    """
    solution = spin_down(omega0=[1.0, 0.2, 2.0], semiaxes=[1.0, 0.5, 0.7], ratio=0.5)
    record_solution(solution, solution.exact(0.02)[0], path)


def record_solution(solution: AveragedSolution, exact: Extremal, path: Path) -> None:
    """Record an exact extremal of one of the paper's examples beside the averaged solution.

    Parameters
    ----------
    solution : AveragedSolution
        The averaged solution of one problem.
    exact : Extremal
        One of the extremals that its `exact` found.
    path : Path
        File to write, ending in ``.rrd``.

    Raises
    ------
    ValueError
        If the solution is that of a stack, or not of an example of the paper.
    """
    scenes: dict[tuple[str, ...], Callable[[Pair, Path], None]]
    scenes = {("E", "K"): record_orbit, ("a", "c"): record_body, ("v",): record_wheel, ("a",): record_wheel}
    if solution.names not in scenes:
        names = ", ".join(solution.names)
        raise ArgumentValueError(
            f"solution must be that of one of the paper's examples, got one with the slow variables {names}",
            "solution",
        )
    scenes[solution.names](Pair(solution, exact), path)
