"""Recordings that replay: transfers to a moving target, and one that ends beside it.

`recordings` names them, each with the function that writes it; `record_extremal` records any extremal.
Places are in units of p*, in inertial axes of the target's orbit; times are in the problem's unit and shown
as seconds.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from pontryagin.rendezvous.false_meetings.meeting import false_meeting
from pontryagin.rendezvous.playback.motion import passage
from pontryagin.rendezvous.playback.scene import record_passage
from pontryagin.rendezvous.problem.cases import case
from pontryagin.rendezvous.reduced.solution import (
    Extremal,
    solve,
)

FIVE_ARCS = 0.05
"""A bound so low that the mixed case is at it on three arcs of five."""
MISLED = math.radians(-35)
"""About nu*: the false meeting that is shown."""


def recordings() -> dict[str, Callable[[Path], None]]:
    """The recordings of this paper: name and the function that writes the file."""
    return {
        "rendezvous-inclined": rendezvous_inclined,
        "rendezvous-saturated": rendezvous_saturated,
        "rendezvous-mars": rendezvous_mars,
        "rendezvous-false": rendezvous_false,
    }


def rendezvous_inclined(path: Path) -> None:
    """A rendezvous in another plane in the least time.

    From a circle to a target on an ellipse inclined by 30 degrees, the thrust at its bound throughout. It
    turns over where |n| is small. The thin blue ellipse is where the craft would go if the
    thrust stopped; at the meeting it lies on the target's orbit, the axes eta of the craft on the axes eta*
    of the target, and both go on as one. H vanishes to rounding.
    """
    record_extremal(solve(case("inclined-30").problem), path)


def rendezvous_saturated(path: Path) -> None:
    """A rendezvous at the least price of time and thrust, with three arcs at the bound.

    The integral of alpha1 + alpha2 p^2 is least. The thrust is n/2 (alpha2 = 1) wherever that is within the
    bound: it meets the bound and leaves it where |n| passes the black line.
    """
    record_extremal(solve(replace(case("mixed").problem, peak=FIVE_ARCS)), path)


def rendezvous_mars(path: Path) -> None:
    """From the Earth to Mars in the least time.

    A thrust of 0.6 mm/s^2 all the way, on the planets' Kepler orbits (times in seconds, the thrust in
    km/s^2); the attraction of the planets themselves is left out. About halfway, where |n| all but vanishes,
    the thrust turns over within three weeks.
    """
    record_extremal(solve(case("mars").problem), path)


def rendezvous_false(path: Path) -> None:
    """A false meeting: the ten equations are satisfied, and the target is elsewhere.

    Everything that the paper asks of its ten equations is left at rounding, and it costs less than the true
    optimum. But condition (15), which is to stand for the attitude, does not change when the end is turned
    about nu*: the craft meets the target's orbit as turned about that axis (orange), and stays beside the
    target for ever (the gap is purple). Grey: the true optimum, found with the missing condition.
    """
    problem = case("mixed").problem
    true = solve(problem)
    record_extremal(false_meeting(problem, MISLED, true), path, true)


def record_extremal(extremal: Extremal, path: Path, true: Extremal | None = None) -> None:
    """Record an extremal: craft and target in space, their axes, thrust, |n| and H.

    Parameters
    ----------
    extremal : Extremal
        A meeting, or one that `false_meeting` found: then the target is shown where it is, and in orange
        where the craft would meet it.
    path : Path
        File to write, ending in ``.rrd``.
    true : Extremal, optional
        Another extremal of the problem, whose way is drawn in grey.
    """
    record_passage(passage(extremal), path, None if true is None else passage(true))
