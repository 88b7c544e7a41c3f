"""Animated recordings of Akulenko 1977: an averaged extremal beside an exact one."""

from pontryagin.averaging.playback.catalogue import (
    low_thrust_spiral,
    precession_removed,
    record_solution,
    recordings,
)

__all__ = ["low_thrust_spiral", "precession_removed", "record_solution", "recordings"]
