"""Recordings for playback: the satellite beside its circle, its impulses, and the sets that shrink around it.

`recordings` lists them, each with the function that writes it; `record_plan` records any single plan.
"""

from collections.abc import Callable
from pathlib import Path

from pontryagin.orbit_correction import printed
from pontryagin.orbit_correction.plan.correction import correct
from pontryagin.orbit_correction.playback.scene import record_plan

__all__ = ["orbit_correction", "orbit_correction_square", "record_plan", "recordings"]


def recordings() -> dict[str, Callable[[Path], None]]:
    """The recordings of this paper: for each name the function that writes the file."""
    return {"orbit-correction": orbit_correction, "orbit-correction-square": orbit_correction_square}


def orbit_correction(path: Path) -> None:
    """The worked example: six impulses of the paper's ball.

    Above, the satellite on its true flight beside the circle, its deviation magnified, impulses as arrows.
    Below, the states from which the impulses still to come lead back to the circle, a set that shrinks around
    the state (red arrow, grey path); the state keeps its gauge until it is home.
    """
    record_plan(correct(printed.Z0, thrust="ball"), path)


def orbit_correction_square(path: Path) -> None:
    """The same state corrected by five impulses of the square.

    Above, the satellite on its true flight beside the circle, its deviation magnified, impulses as arrows.
    Below, the zonotope of states from which the impulses still to come lead back, which loses one impulse's
    parallelogram after the other; the state is the red arrow, its path grey.
    """
    record_plan(correct(printed.Z0, thrust="box"), path)
