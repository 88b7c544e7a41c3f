"""Figures and tables of Pimkina & Chelnokov: from a rendezvous to a picture."""

from pontryagin.rendezvous.figures import tables
from pontryagin.rendezvous.figures.crowd import trajectories
from pontryagin.rendezvous.figures.false import false_meetings, missed, singular_values
from pontryagin.rendezvous.figures.orbit import orbit
from pontryagin.rendezvous.figures.revolutions import revolutions
from pontryagin.rendezvous.figures.series import series
from pontryagin.rendezvous.figures.solved import solved

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
