"""The layout and the contents of a rendezvous recording."""

import math
from pathlib import Path

import numpy as np

from pontryagin.arrays import Array
from pontryagin.display.plotting import (
    BLUE,
    GREEN,
    GREY,
    INK,
    ORANGE,
    PURPLE,
    RED,
    SKY,
)
from pontryagin.display.recording import (
    Events,
    Plot,
    Point,
    Recording,
    Scene,
    View,
    record,
)
from pontryagin.numerics.rotation import product, rotated
from pontryagin.rendezvous.false_meetings.meeting import RotatedMeeting
from pontryagin.rendezvous.playback.motion import RendezvousMotion

SECONDS = 30.0
"""Duration of a replay, in seconds."""
POINTS = 121
"""Number of points with which an orbit is drawn."""
CRAFT, TARGET, ROTATED = BLUE, GREEN, ORANGE
AXES = np.eye(3)
COMPONENTS = ("p1", "p2", "p3")
FLOOR = -17.0
"""Lowest power of ten at which |H| is drawn; smaller values are 0 to rounding."""


def record_motion(motion: RendezvousMotion, path: Path, true: RendezvousMotion | None = None) -> None:
    """Record a motion; if a motion `true` is given, the path of its craft is drawn in grey."""
    speed = float(motion.times[-1]) / SECONDS
    with record(path, "rendezvous", _layout(motion), speed, (5, 3, 3)) as recording:
        _orbits(recording, motion)
        _bodies(recording, motion)
        _axes(recording, motion)
        _curves(recording, motion)
        if motion.is_false:
            _rotated_target(recording, motion)
        if true is not None:
            recording.path("orbit/true", true.place[: true.meeting], GREY)
        for t, words in sorted(_events(motion, true)):
            recording.event("events", t, words)


def _layout(motion: RendezvousMotion) -> list[list[View]]:
    problem = motion.extremal.problem
    colours = "craft blue, target green, thrust red"
    if motion.is_false:
        colours += ", orange: where it would have to be"
    scenes: list[View] = [
        Scene(
            colours,
            "orbit",
            share=3.2,
            trails=("orbit/flown", "orbit/led"),
            eye=_eye(motion),
            grid=False,
        ),
        Events("events", "events"),
    ]
    largest = _largest(motion)
    bound = problem.peak if problem.peak < 3 * largest else largest
    far = 1.5 * float(np.max(list(_distances(motion).values())))
    energy = "log10 |H|" if problem.free else "log10 |H - H(t_k)|"
    middle: list[View] = [
        Scene(
            "axes eta (blue) and eta* (green) from one origin",
            "axes",
            eye=((1.5, -1.35, 1.1), (0.0, 0.0, 0.15)),
            grid=False,
            share=2.0,
        ),
        Plot("distance of the craft, over p*", "distance", span=(0.0, far), whole=True),
        Plot(f"{energy}, over the largest running cost", "hamiltonian", span=(FLOOR, 0.0), whole=True),
    ]
    right: list[View] = [
        Plot(
            "thrust: radial, onward, across",
            "thrust",
            span=(-1.7 * bound, 1.15 * bound),
            whole=True,
            legend="LeftBottom",
        ),
        Plot("its magnitude", "magnitude", span=(0.0, 1.25 * bound), whole=True, legend="LeftBottom"),
        Plot(
            "switching function |n|",
            "switching",
            span=(0.0, 1.15 * max(float(motion.primer.max()), motion.saturation or 0.0)),
            whole=True,
        ),
    ]
    return [scenes, middle, right]


def _eye(motion: RendezvousMotion) -> tuple[Point, Point]:
    """A viewpoint above the orbits, on the side where the craft is at t_k."""
    last = motion.meeting - 1
    middle = motion.place[last] + motion.target[last]
    azimuth = math.atan2(middle[1], middle[0]) + 0.25
    x, y = motion.size * math.cos(azimuth), motion.size * math.sin(azimuth)
    return (1.55 * x, 1.55 * y, 1.27 * motion.size), (0.25 * x, 0.25 * y, 0.0)


def _orbits(recording: Recording, motion: RendezvousMotion) -> None:
    full = np.linspace(0.0, 2 * np.pi, POINTS)
    recording.path("orbit/target", motion.on_orbit(full), TARGET)
    recording.path("orbit/start", motion.osculating(POINTS, slice(1))[0], GREY)
    recording.net("orbit/osculating", motion.t, motion.osculating(POINTS)[:, None], CRAFT, 0.8)
    centre = np.full((1, 3), 0.06 * motion.size)
    recording.ellipsoid("orbit/centre", [0.0], centre, np.zeros((1, 3)), [[1.0, 0, 0, 0]], SKY)
    recording.trail("orbit/flown", motion.times, motion.place, CRAFT, 2.2)
    recording.trail("orbit/led", motion.times, motion.target, TARGET, 2.2)


def _bodies(recording: Recording, motion: RendezvousMotion) -> None:
    t, size = motion.times, motion.size
    box = size * np.array([0.08, 0.04, 0.04])
    recording.body("orbit/craft", t, motion.attitude, box, motion.place, CRAFT)
    recording.body("orbit/goal", t, motion.target_attitude, 0.8 * box[[1, 0, 2]], motion.target, TARGET)
    recording.arrow("orbit/thrust", t, 0.42 * size * motion.thrust / _largest(motion), RED, motion.place)
    for i, axis in enumerate(0.16 * size * AXES, start=1):
        recording.arrow(f"orbit/eta-{i}", t, _along(axis, motion.attitude), CRAFT, motion.place)
        recording.arrow(f"orbit/eta-star-{i}", t, _along(axis, motion.target_attitude), TARGET, motion.target)


def _axes(recording: Recording, motion: RendezvousMotion) -> None:
    for i, axis in enumerate(AXES, start=1):
        star = 0.85 * _along(axis, motion.target_attitude)
        recording.arrow(f"axes/eta-{i}", motion.times, _along(axis, motion.attitude), CRAFT, label=f"{i}")
        recording.arrow(f"axes/eta-star-{i}", motion.times, star, TARGET, label=f"{i}*")
    recording.arrow("axes/thrust", motion.times, 0.7 * motion.thrust / _largest(motion), RED)


def _largest(motion: RendezvousMotion) -> float:
    """The largest magnitude of the thrust."""
    return float(np.linalg.norm(motion.control, axis=1).max())


def _along(axis: Array, attitude: Array) -> Array:
    """One axis of a body with the attitudes (n, 4), in the axes of the scene, (n, 3)."""
    return rotated(np.broadcast_to(axis, (len(attitude), 3)), attitude)


def _distances(motion: RendezvousMotion) -> dict[str, Array]:
    """Distances of the craft from the target and from the rotated target, at `times`."""
    targets = {"target": motion.target, "rotated": motion.rotated_target}
    return {name: np.linalg.norm(motion.place - place, axis=1) for name, place in targets.items()}


def _curves(recording: Recording, motion: RendezvousMotion) -> None:
    t = motion.t
    for name, values, colour in zip(COMPONENTS, motion.control.T, (CRAFT, ORANGE, PURPLE), strict=True):
        recording.curve(f"thrust/{name}", t, values, name, colour)
    recording.curve("magnitude/thrust", t, np.linalg.norm(motion.control, axis=1), "|p|", RED)
    ends = t[[0, -1]]
    peak = motion.extremal.problem.peak
    if np.isfinite(peak):
        recording.curve("magnitude/bound", ends, [peak] * 2, "bound", INK)
    recording.curve("switching/primer", t, motion.primer, "|n|", CRAFT)
    if motion.saturation is not None:
        recording.curve("switching/saturation", ends, [motion.saturation] * 2, "bound binds above", INK)
    distances = _distances(motion)
    recording.curve("distance/target", motion.times, distances["target"], "to the target", TARGET)
    if motion.is_false:
        name = "to where it would have to be"
        recording.curve("distance/phantom", motion.times, distances["rotated"], name, ROTATED)
    powers = np.log10(np.maximum(np.abs(motion.hamiltonian), 10.0**FLOOR))
    recording.curve("hamiltonian/power", t, powers, "power of ten", CRAFT)


def _rotated_target(recording: Recording, motion: RendezvousMotion) -> None:
    """The target and its orbit rotated about nu*, and the distance missed from t_k on."""
    t, size = motion.times, motion.size
    full = motion.on_orbit(np.linspace(0.0, 2 * np.pi, POINTS))
    recording.path("orbit/phantom-orbit", rotated(full, motion.turn), ROTATED)
    box = 0.8 * size * np.array([0.04, 0.08, 0.04])
    attitude = product(motion.turn, motion.target_attitude)
    recording.body("orbit/phantom", t, attitude, box, motion.rotated_target, ROTATED)
    recording.arrow("orbit/nu-star", [0.0], 0.5 * size * motion.invariant[None], INK, label="nu*")
    gap = np.where(t[:, None] >= motion.t[-1], motion.target - motion.place, 0.0)
    recording.arrow("orbit/gap", t, gap, PURPLE, motion.place)


def _events(motion: RendezvousMotion, true: RendezvousMotion | None) -> list[tuple[float, str]]:
    """Times of the events, and their descriptions."""
    extremal = motion.extremal
    events = [
        (float(t), f"t = {t:.6g}: the thrust {'meets' if mode == 'saturated' else 'leaves'} its bound")
        for t, mode in zip(extremal.switch_times, extremal.modes[1:], strict=True)
    ]
    end = f"t = {extremal.duration:.6g}"
    cost = f"cost {extremal.cost:.6g}"
    if not motion.is_false:
        return [*events, (extremal.duration, f"{end}: the target is met, {cost}")]
    gap = float(_distances(motion)["target"][motion.meeting - 1])
    angle = 2 * math.acos(min(1.0, float(motion.turn[0])))
    residual = RotatedMeeting(extremal, angle).printed
    words = f"{end}: conditions left {residual:.0e}, {cost}; the target is {gap:.2f} p* away"
    events.append((extremal.duration, words))
    if true is not None:
        best = true.extremal
        events.append((0.0, f"grey: the true optimum, t = {best.duration:.6g}, cost {best.cost:.6g}"))
    return events
