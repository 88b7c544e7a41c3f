"""The smooth example and the rotor as a recording: a wheel that is sped up or braked."""

from pathlib import Path

import numpy as np

from pontryagin.averaging.playback.pair import EXACT, Pair, arrivals, panel, slow_curves, slow_plots
from pontryagin.display.plotting import GREY, RED
from pontryagin.display.recording import (
    Events,
    Scene,
    View,
    record,
)

PER_TURN = 60
"""Number of samples per turn."""
EYE = ((0.6, -1.4, 2.2), (0.0, 0.0, 0.0))
WORDS = {"v": "speed v", "a": "energy a"}


def record_wheel(pair: Pair, path: Path) -> None:
    """Record an exact extremal of `smooth_example` or `rotor` beside the averaged one."""
    tau = np.linspace(0.0, pair.exact.duration, max(2, int(np.ceil(PER_TURN * pair.exact.turns))) + 1)
    t, angle = tau / pair.epsilon, pair.exact.anomaly(tau)
    control = pair.exact.control(tau)[:, 0]
    scenes: list[View] = [
        Scene("the angle x; red: the control", "wheel", EYE, share=3.0, grid=False),
        Events("events", "events"),
    ]
    slow, rest = slow_plots(pair, WORDS)
    columns = [scenes, slow, [*rest, panel("control u", "control")]]
    with record(path, "wheel", columns, pair.speed, (5, 3, 3)) as recording:
        spoke = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(len(t))])
        attitude = np.column_stack([np.cos(angle / 2), np.zeros((len(t), 2)), np.sin(angle / 2)])
        rim = np.linspace(0, 2 * np.pi, 121)
        recording.path("wheel/rim", np.column_stack([np.cos(rim), np.sin(rim), np.zeros(rim.size)]), GREY)
        recording.body("wheel/spoke", t, attitude, (1.0, 0.08, 0.05), spoke / 2)
        across = np.column_stack([-np.sin(angle), np.cos(angle), np.zeros(len(t))])
        push = across * control[:, None] * 0.7 / max(np.abs(control).max(), np.finfo(float).tiny)
        recording.arrow("wheel/control", t, push, RED, spoke)
        slow_curves(recording, pair, tau)
        recording.curve("control/exact", t, control, "exact", EXACT)
        arrivals(recording, pair)
