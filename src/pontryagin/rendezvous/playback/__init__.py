"""Recordings of rendezvous for replay: three true meetings and a false one.

`recordings` lists them, each with the function that writes it; `record_extremal` records any extremal.
Places are in units of p*, in inertial axes of the target's orbit; times are in the problem's unit and shown
as seconds.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from pontryagin.rendezvous.case_solutions import solved
from pontryagin.rendezvous.false_meetings.family import false_meeting
from pontryagin.rendezvous.playback.motion import motion_of
from pontryagin.rendezvous.playback.scene import record_motion
from pontryagin.rendezvous.problem.cases import case
from pontryagin.rendezvous.reduced.solution import Extremal
from pontryagin.rendezvous.reduced.solve import solve

FIVE_ARCS = 0.05
"""A bound on the thrust under which the mixed case has five arcs, three of them at the bound."""
FALSE_ANGLE = math.radians(-35)
"""Angle about nu* of the false meeting that is recorded, in radians."""


def recordings() -> dict[str, Callable[[Path], None]]:
    """The recordings of this paper: the function that writes the file, by the name of the recording."""
    return {
        "rendezvous-inclined": rendezvous_inclined,
        "rendezvous-saturated": rendezvous_saturated,
        "rendezvous-mars": rendezvous_mars,
        "rendezvous-false": rendezvous_false,
    }


def rendezvous_inclined(path: Path) -> None:
    """A rendezvous in another plane in the least time.

    From a circle to a target on an ellipse inclined by 30 degrees, with the thrust at its bound throughout.
    Its direction reverses where |n| is small. The thin blue ellipse is where the craft would go if the thrust
    stopped; at the meeting it lies on the target's orbit, the axes eta of the craft on the axes eta* of the
    target, and both move on together. H vanishes to rounding.
    """
    record_extremal(solved("inclined-30"), path)


def rendezvous_saturated(path: Path) -> None:
    """A rendezvous at the least cost of time and thrust, with three arcs at the bound.

    The integral of alpha1 + alpha2 p^2 is minimised. The thrust is n/2 (alpha2 = 1) wherever that is within
    the bound: it meets the bound and leaves it where |n| passes the black line.
    """
    record_extremal(solve(replace(case("mixed").problem, peak=FIVE_ARCS)), path)


def rendezvous_mars(path: Path) -> None:
    """From the Earth to Mars in the least time.

    The planets move on Kepler orbits, and the thrust is 0.6 mm/s^2 all the way (times are in seconds, the
    thrust in km/s^2); the attraction of the planets themselves is neglected. About halfway, where |n| nearly
    vanishes, the thrust reverses its direction within three weeks.
    """
    record_extremal(solved("mars"), path)


def rendezvous_false(path: Path) -> None:
    """A false meeting: the ten equations and their conditions are satisfied, and the target is missed.

    Every residual of the conditions that the paper imposes on its ten equations is at rounding level, and the
    cost is less than that of the true optimum. But condition (15), which is meant to replace the condition on
    the attitude, does not change when the end is rotated about nu*: the craft reaches the target's orbit
    rotated about that axis (orange), and never the target (the gap is purple). The true optimum, found with
    the missing condition, is grey.
    """
    true = solved("mixed")
    record_extremal(false_meeting(true.problem, FALSE_ANGLE, true), path, true)


def record_extremal(extremal: Extremal, path: Path, true: Extremal | None = None) -> None:
    """Record an extremal: craft and target in space, their axes, thrust, |n| and H.

    Parameters
    ----------
    extremal : Extremal
        A true meeting, or a result of `false_meeting`. For a false meeting the target is shown where it is,
        and in orange where the craft would meet it.
    path : Path
        File to write, ending in ``.rrd``.
    true : Extremal, optional
        Another extremal of the problem, whose path is drawn in grey.
    """
    record_motion(motion_of(extremal), path, None if true is None else motion_of(true))
