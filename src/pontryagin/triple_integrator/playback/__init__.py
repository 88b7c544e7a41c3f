"""Recordings for playback: one channel under three norms, the turn of a rigid body, coupled channels.

`recordings` lists them, each with the function that writes it; `record_solution` records any one solution.
Angles are in rad, times in s.
"""

from collections.abc import Callable
from pathlib import Path

from pontryagin.triple_integrator.playback.channel import record_solution, three_norms
from pontryagin.triple_integrator.playback.coupled import coupled_channels, record_coupled
from pontryagin.triple_integrator.playback.spacecraft import SPACECRAFT, angle_between, sample_times
from pontryagin.triple_integrator.playback.turn import (
    real_turn_energy,
    real_turn_impulse,
    real_turn_peak,
    record_turn,
)

__all__ = [
    "SPACECRAFT",
    "angle_between",
    "coupled_channels",
    "real_turn_energy",
    "real_turn_impulse",
    "real_turn_peak",
    "record_coupled",
    "record_solution",
    "record_turn",
    "recordings",
    "sample_times",
    "three_norms",
]


def recordings() -> dict[str, Callable[[Path], None]]:
    """The recordings of this paper: for each name the function that writes the file."""
    return {
        "three-norms": three_norms,
        "real-turn-energy": real_turn_energy,
        "real-turn-peak": real_turn_peak,
        "real-turn-impulse": real_turn_impulse,
        "coupled-channels": coupled_channels,
    }
