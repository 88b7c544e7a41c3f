"""Figures and tables of the rendezvous."""

from pontryagin.rendezvous.case_solutions import solved
from pontryagin.rendezvous.figures import tables
from pontryagin.rendezvous.figures.false_meetings import false_meetings, missed, singular_values
from pontryagin.rendezvous.figures.orbit import orbit
from pontryagin.rendezvous.figures.revolutions import revolutions
from pontryagin.rendezvous.figures.series import series
from pontryagin.rendezvous.figures.trajectories import trajectories

__all__ = [
    "false_meetings",
    "missed",
    "orbit",
    "revolutions",
    "series",
    "singular_values",
    "solved",
    "tables",
    "trajectories",
]
