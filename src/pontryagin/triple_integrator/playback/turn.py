"""Recordings of the turn of a rigid body about a fixed axis, with and without the gyroscopic torque."""

from pathlib import Path

import numpy as np

from pontryagin.arrays import Array
from pontryagin.display.plotting import BLUE, INK, ORANGE, RED
from pontryagin.display.recording import Events, Plot, Recording, Scene, View, record
from pontryagin.numerics.rotation import rotated
from pontryagin.triple_integrator.attitude import Turn, impulses, turn
from pontryagin.triple_integrator.playback.spacecraft import (
    CHANNEL_COLOURS,
    NORMS,
    SPACECRAFT,
    draw_spacecraft,
    draw_target,
    rest_to_rest,
    sample_times,
)


def real_turn_energy(path: Path) -> None:
    """The real turn with the least energy.

    A rigid body with a full inertia tensor turns about a skew axis. The left one is given the gyroscopic
    torque as well and reaches the target, drawn in grey; the right one is not, and misses it.
    """
    record_turn(path, "energy")


def real_turn_peak(path: Path) -> None:
    """The real turn with the least peak.

    A rigid body with a full inertia tensor turns about a skew axis. The left one is given the gyroscopic
    torque as well and reaches the target, drawn in grey; the right one is not, and misses it.
    """
    record_turn(path, "peak")


def real_turn_impulse(path: Path) -> None:
    """The real turn with the least total impulse.

    A rigid body with a full inertia tensor turns about a skew axis. The left one is given the gyroscopic
    torque as well and reaches the target, drawn in grey; the right one is not, and misses it.
    """
    record_turn(path, "impulse")


def record_turn(path: Path, norm: str) -> None:
    """Record the real turn under a norm, "energy", "peak" or "impulse", with and without the feedforward."""
    solve, _ = NORMS[norm]
    programme = solve(rest_to_rest(2.0))
    t = sample_times([programme])
    turns = {
        "with feedforward": turn(SPACECRAFT, [1, 2, 2], programme),
        "without": turn(SPACECRAFT, [1, 2, 2], programme, feedforward=False),
    }
    plots: list[View] = [
        Plot("error of the attitude, rad", "error"),
        Plot("angular rate, rad/s", "rate"),
        Plot("torque along J e, N m", "torque/channel"),
        Plot("gyroscopic torque across the axis, N m", "torque/gyroscopic"),
    ]
    layout = [[Scene("the turn", "turn"), Events("what happens", "events")], plots]
    with record(path, f"real turn, least {norm}", layout) as recording:
        for place, (label, made) in enumerate(turns.items()):
            _turning(recording, label, made, t, np.array([6.0 * place, 0.0, 0.0]), (BLUE, RED)[place])
        _torques(recording, turns["with feedforward"], t)
        for time, jump in impulses(programme):
            recording.event("events", time, f"impulse {jump:+.4g} rad/s²")
        for label, made in turns.items():
            recording.event("events", t[-1], f"{label}: misses the target by {made.attitude_miss:.3g} rad")


def _turning(recording: Recording, label: str, made: Turn, t: Array, position: Array, colour: str) -> None:
    name = label.replace(" ", "-")
    draw_spacecraft(recording, f"turn/{name}", t, made.attitude(t), position, colour)
    draw_target(recording, f"turn/{name}-target", t, made.planned_attitude(t[-1:])[0], position)
    recording.path(f"turn/{name}-axis", position + np.outer([-2.6, 2.6], made.axis), INK)
    origin = np.tile(position, (t.size, 1))
    largest = np.linalg.norm(made.torque(t), axis=1).max()
    torque = rotated(made.torque(t), made.attitude(t))
    recording.arrow(f"turn/{name}-torque", t, 3 * torque / largest, ORANGE, origin)
    error = np.linalg.norm(made.error(t), axis=1)
    recording.curve(f"error/{name}", t, error, label, colour)
    for i, values in enumerate(made.rate(t).T):
        recording.curve(f"rate/{name}-{i + 1}", t, values, f"w{i + 1} {label}", CHANNEL_COLOURS[i])


def _torques(recording: Recording, made: Turn, t: Array) -> None:
    for i, colour in enumerate(CHANNEL_COLOURS):
        channel, gyroscopic = made.channel_torque(t)[:, i], made.gyroscopic_torque(t)[:, i]
        recording.curve(f"torque/channel/{i + 1}", t, channel, f"channel M{i + 1}", colour)
        recording.curve(f"torque/gyroscopic/{i + 1}", t, gyroscopic, f"gyroscopic M{i + 1}", colour)
