"""Example 3 as a recording: a body under the averaged synthesis beside one under the exact optimum."""

from pathlib import Path

import numpy as np

from pontryagin.arrays import Array
from pontryagin.averaging.playback.attitude import BodyMotion, exact_motion, synthesised_motion
from pontryagin.averaging.playback.pair import AVERAGED, EXACT, Pair, arrivals
from pontryagin.display.plotting import GREEN, GREY, INK, PURPLE, RED
from pontryagin.display.recording import (
    Events,
    Plot,
    Recording,
    Scene,
    View,
    record,
)

LONG = 1.5
"""Length at which the axis and the angular momentum are drawn."""
COMPONENTS = ("x", "y", "z")


def record_body(pair: Pair, path: Path) -> None:
    """Record the motion under the averaged synthesis and that on the exact extremal."""
    motions = {"synthesis": synthesised_motion(pair), "exact": exact_motion(pair)}
    size = float(np.abs(motions["exact"].rate).max())
    scenes: list[View] = [
        _scene(f"inertial axes, epsilon = {pair.epsilon:g}: averaged synthesis", "synthesis"),
        _scene(f"inertial axes, epsilon = {pair.epsilon:g}: exact optimum", "exact"),
    ]
    semiaxes = motions["exact"].semiaxes
    far = float(semiaxes.max())
    control: list[View] = [
        Scene(
            "body axes: both controls on the ellipsoid",
            "ellipsoid",
            share=2.0,
            trails=("ellipsoid/synthesis/way", "ellipsoid/exact/way"),
            eye=((1.8 * far, -2.0 * far, 1.5 * far), (0.0, 0.0, 0.0)),
            grid=False,
        ),
        Events("events", "events"),
    ]
    plots: list[View] = [
        *(
            Plot(f"angular velocity about the body's {name} axis", f"rate-{name}", span=span, whole=True)
            for name, span in zip(COMPONENTS, _spans(motions["exact"]), strict=True)
        ),
        Plot("form of the ellipsoid: 1 on it", "form", span=(0.0, 1.25), whole=True),
    ]
    layout = [scenes, control, plots]
    with record(path, "spin-down", layout, pair.speed, (3, 3, 3)) as recording:
        for (name, motion), colour in zip(motions.items(), (AVERAGED, EXACT), strict=True):
            _space(recording, name, motion, size)
            _control(recording, name, motion, colour)
            _curves(recording, name, motion, colour)
        _ellipsoid(recording, semiaxes)
        _arrivals(recording, pair, motions["synthesis"])


def _scene(title: str, entity: str) -> Scene:
    return Scene(title, entity, ((1.9, -1.9, 1.5), (0.0, 0.0, 0.45)), trails=(f"{entity}/way",), grid=False)


def _spans(motion: BodyMotion) -> list[tuple[float, float]]:
    most = 1.15 * float(np.abs(motion.rate[:, :2]).max())
    along = motion.rate[:, 2]
    margin = 0.1 * float(np.abs(along).max())
    return [(-most, most), (-most, most), (float(along.min()) - margin, float(along.max()) + margin)]


def _space(recording: Recording, name: str, motion: BodyMotion, size: float) -> None:
    t, d = motion.t, float(motion.moments[2])
    edges = np.array([1.0, 1.0, np.sqrt(max(2 / d - 1, 0.01))])
    recording.body(f"{name}/body", t, motion.attitude, 0.9 * edges / edges.max())
    axis = motion.in_space(np.array([0.0, 0.0, LONG * np.sign(motion.rate[0, 2])]))
    recording.arrow(f"{name}/axis", t, axis, INK, label="axis")
    recording.trail(f"{name}/way", t, axis, INK, 0.8)
    recording.arrow(
        f"{name}/velocity", t, motion.in_space(motion.rate) * LONG / size, GREEN, label="velocity"
    )
    momentum = motion.angular_momentum
    recording.arrow(
        f"{name}/momentum", t, momentum * LONG / np.linalg.norm(momentum[0]), PURPLE, label="momentum"
    )
    torque = motion.in_space(motion.moments * motion.control)
    longest = float(np.linalg.norm(torque, axis=-1).max())
    recording.arrow(f"{name}/torque", t, torque * 0.7 / longest, RED, label="torque")


def _control(recording: Recording, name: str, motion: BodyMotion, colour: str) -> None:
    recording.arrow(f"ellipsoid/{name}/control", motion.t, motion.control, colour, label=name)
    recording.trail(f"ellipsoid/{name}/way", motion.t, motion.control, colour, 1.0)


def _ellipsoid(recording: Recording, semiaxes: Array) -> None:
    upright = [[1.0, 0.0, 0.0, 0.0]]
    recording.ellipsoid("ellipsoid/bound", [0.0], semiaxes[None], np.zeros((1, 3)), upright, GREY)
    for axis, name in zip(np.diag(1.25 * semiaxes), COMPONENTS, strict=True):
        recording.arrow(f"ellipsoid/axis-{name}", [0.0], axis[None], GREY, label=name)


def _curves(recording: Recording, name: str, motion: BodyMotion, colour: str) -> None:
    for i, component in enumerate(COMPONENTS):
        recording.curve(f"rate-{component}/{name}", motion.t, motion.rate[:, i], name, colour)
    recording.curve(f"form/{name}", motion.t, motion.form, name, colour)


def _arrivals(recording: Recording, pair: Pair, synthesis: BodyMotion) -> None:
    arrivals(recording, pair)
    duration = float(synthesis.t[-1])
    words = f"t = {duration:.2f}: synthesis arrives, cost {pair.epsilon * duration:.6f}"
    recording.event("events", duration, words)
