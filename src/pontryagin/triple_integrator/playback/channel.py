"""Recordings of one channel: a body that turns about one axis, and its states against time."""

from collections.abc import Sequence
from math import ceil, log10
from pathlib import Path

import numpy as np

from pontryagin.arrays import Array
from pontryagin.display.plotting import BLUE, ORANGE
from pontryagin.display.recording import Events, Plot, Recording, Scene, View, record
from pontryagin.numerics.rotation import quaternion
from pontryagin.triple_integrator.attitude import impulses, single
from pontryagin.triple_integrator.playback.spacecraft import (
    NORMS,
    draw_spacecraft,
    draw_target,
    rest_to_rest,
    sample_times,
)
from pontryagin.triple_integrator.problem.maneuver import Maneuver
from pontryagin.triple_integrator.problem.programme import Programme

CHANNEL_AXIS = np.array([0.0, 0.0, 1.0])
"""The axis about which the channel turns the body."""


def three_norms(path: Path) -> None:
    """One channel, three norms side by side.

    Three spacecraft turn about one axis by a quarter turn in six seconds: with the least energy, the least
    peak and the least total impulse of the control. Impulses are spikes in the control's plot, events, and
    arrows along the axis.
    """
    maneuver = rest_to_rest(np.pi / 2)
    _record_channels(path, "three norms", {name: solve(maneuver) for name, (solve, _) in NORMS.items()})


def record_solution(solution: Programme, path: Path) -> None:
    """Record one solution of one manoeuvre: a body that turns about one axis, and its states against time.

    Parameters
    ----------
    solution : solution of one manoeuvre
        From `minimum_energy`, `minimum_peak`, `minimum_impulse`, `minimum_norm` or `minimum_time`.
    path : Path
        File to write, ending in ``.rrd``.

    Raises
    ------
    ValueError
        If the solution is that of a stack.
    """
    single(solution, "solution")
    _record_channels(path, "one channel", {"programme": solution})


def _record_channels(path: Path, name: str, programmes: dict[str, Programme]) -> None:
    plots: list[View] = [
        Plot("angle, rad", "angle"),
        Plot("rate, rad/s", "rate"),
        Plot("control acceleration, rad/s²", "acceleration"),
        Plot("control, rad/s³; impulses, rad/s²", "control"),
    ]
    layout = [[Scene("the turn", "turn"), Events("impulses and switches", "events")], plots]
    t = sample_times(list(programmes.values()))
    with record(path, name, layout) as recording:
        for place, (label, programme) in enumerate(programmes.items()):
            colour = NORMS[label][1] if label in NORMS else BLUE
            position = np.array([5.0 * place, 0.0, 0.0])
            _channel(recording, label, programme, t, position, colour)


def _channel(
    recording: Recording, label: str, programme: Programme, t: Array, position: Array, colour: str
) -> None:
    x = programme.state(t)
    maneuver = programme.maneuver
    draw_spacecraft(recording, f"turn/{label}", t, quaternion(x[:, :1] * CHANNEL_AXIS), position, colour)
    draw_target(recording, f"turn/{label}-target", t, quaternion(maneuver.xf[0] * CHANNEL_AXIS), position)
    for branch, values in zip(("angle", "rate", "acceleration"), x.T, strict=True):
        recording.curve(f"{branch}/{label}", t, values, label, colour)
    kicks = impulses(programme)
    times, heights = _spikes(kicks, maneuver, t) if kicks else (t, programme.control(t))
    recording.curve(f"control/{label}", times, heights, label, colour)
    for time, jump in kicks:
        recording.event("events", time, f"{label}: impulse {jump:+.4g} rad/s²")
    if kicks:
        flash = _flash(t, kicks, float(maneuver.duration))
        origin = np.tile(position, (t.size, 1))
        recording.arrow(f"turn/{label}-impulse", t, flash[:, None] * CHANNEL_AXIS, ORANGE, origin)
    else:
        for time in programme.breakpoints:
            recording.event("events", time, f"{label}: the control switches")


def _spikes(kicks: Sequence[tuple[float, float]], maneuver: Maneuver, t: Array) -> tuple[Array, Array]:
    """Impulses as a curve: each is a spike as high as the impulse, 1 % of T wide so that a screen shows it.

    The player averages values that fall on one pixel. Therefore every time occurs only once, and the times t
    of the other curves are included.
    """
    first, last = float(maneuver.t0), float(maneuver.tf)
    offsets = 0.005 * (last - first) * np.array([-1.2, -1.0, 1.0, 1.2])
    times = np.concatenate([[first], *(np.clip(time + offsets, first, last) for time, _ in kicks), [last]])
    heights = np.concatenate([[0.0], *([0.0, jump, jump, 0.0] for _, jump in kicks), [0.0]])
    order = np.lexsort((-np.abs(heights), times))
    once, place = np.unique(times[order], return_index=True)
    digits = 8 - ceil(log10(last - first))
    dense = np.unique(first + np.round(np.concatenate([once, t]) - first, digits))
    return dense, np.interp(dense, once, heights[order][place])


def _flash(t: Array, kicks: Sequence[tuple[float, float]], duration: float) -> Array:
    """Length of the arrow that marks an impulse within 3 % of T of it, (k,): 3 for the largest impulse."""
    largest = max(abs(jump) for _, jump in kicks)
    marks = [np.where(np.abs(t - time) <= 0.03 * duration, 3 * jump / largest, 0.0) for time, jump in kicks]
    return np.asarray(np.sum(marks, axis=0))
