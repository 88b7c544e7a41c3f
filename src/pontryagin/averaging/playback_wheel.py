"""The smooth example and the rotor as a recording: a wheel that is sped up or braked."""

from pathlib import Path

import numpy as np

from pontryagin.averaging import replay
from pontryagin.averaging.replay import Pair
from pontryagin.plotting import GREEN, RED
from pontryagin.recording import Events, Scene, View, record

A_TURN = 60
"""Samples a turn."""
RADIUS = 1.0


def record_wheel(pair: Pair, path: Path) -> None:
    """Record an exact extremal of `smooth_example` or `rotor` beside the averaged one."""
    tau = np.linspace(0.0, pair.exact.duration, max(2, int(np.ceil(A_TURN * pair.exact.turns))) + 1)
    t, angle = tau / pair.epsilon, pair.exact.anomaly(tau)
    control = pair.exact.control(tau)[:, 0]
    scenes: list[View] = [
        Scene("the wheel, turned by the anomaly x; control red", "wheel", share=3.0, eye=(1.5, -2.5, 2.5)),
        Events("events", "events"),
    ]
    plots: list[View] = [*replay.slow_plots(pair), replay.panel("control u", "control")]
    with record(path, "wheel", [scenes, plots], pair.speed) as recording:
        attitude = np.column_stack([np.cos(angle / 2), np.zeros((len(t), 2)), np.sin(angle / 2)])
        recording.body("wheel/bar", t, attitude, (2 * RADIUS, 0.2, 0.1))
        spoke = RADIUS * np.column_stack([np.cos(angle), np.sin(angle), np.zeros(len(t))])
        across = np.column_stack([-np.sin(angle), np.cos(angle), np.zeros(len(t))])
        recording.arrow("wheel/mark", t, spoke, GREEN)
        push = across * control[:, None] * 0.7 * RADIUS / max(np.abs(control).max(), np.finfo(float).tiny)
        recording.arrow("wheel/control", t, push, RED, spoke)
        replay.slow_curves(recording, pair, tau)
        recording.curve("control/exact", t, control, "exact", replay.EXACT)
        replay.arrivals(recording, pair)
