"""What a recording of a rendezvous shows, and where."""

import math
from pathlib import Path

import numpy as np

from pontryagin.arrays import Array
from pontryagin.display.plotting import (
    BLUE,
    GREEN,
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
from pontryagin.rendezvous.false_meetings.meeting import paper_residual
from pontryagin.rendezvous.playback.motion import Passage

SECONDS = 30.0
"""How long a replay takes."""
POINTS = 121
"""Points of an orbit as drawn."""
CRAFT, TARGET, PHANTOM, GREY = BLUE, GREEN, ORANGE, "#b8b8b8"
AXES = np.eye(3)
COMPONENTS = ("p1", "p2", "p3")
FLOOR = -17.0
"""Power of ten below which H is not told from zero."""


def record_passage(flown: Passage, path: Path, true: Passage | None = None) -> None:
    """Record a passage, with another one's way in grey where it is given."""
    speed = float(flown.times[-1]) / SECONDS
    with record(path, "rendezvous", _layout(flown), speed, (5, 3, 3)) as recording:
        _orbits(recording, flown)
        _bodies(recording, flown)
        _axes(recording, flown)
        _curves(recording, flown)
        if flown.misled:
            _phantom(recording, flown)
        if true is not None:
            recording.path("orbit/true", true.place[: true.meeting], GREY)
        for t, words in sorted(_events(flown, true)):
            recording.event("events", t, words)


def _layout(flown: Passage) -> list[list[View]]:
    problem = flown.extremal.problem
    colours = "craft blue, target green, thrust red"
    if flown.misled:
        colours += ", orange: where it would have to be"
    scenes: list[View] = [
        Scene(
            colours,
            "orbit",
            share=3.2,
            trails=("orbit/flown", "orbit/led"),
            eye=_eye(flown),
            grid=False,
        ),
        Events("events", "events"),
    ]
    largest = _largest(flown)
    bound = problem.peak if problem.peak < 3 * largest else largest
    far = 1.5 * float(np.max(list(_distances(flown).values())))
    told = "log10 |H|" if problem.free else "log10 |H - H(t_k)|"
    middle: list[View] = [
        Scene(
            "axes eta (blue) and eta* (green) from one origin",
            "axes",
            eye=((1.5, -1.35, 1.1), (0.0, 0.0, 0.15)),
            grid=False,
            share=2.0,
        ),
        Plot("distance of the craft, over p*", "distance", span=(0.0, far), whole=True),
        Plot(f"{told}, over the largest running cost", "hamiltonian", span=(FLOOR, 0.0), whole=True),
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
            span=(0.0, 1.15 * max(float(flown.primer.max()), flown.saturation or 0.0)),
            whole=True,
        ),
    ]
    return [scenes, middle, right]


def _eye(flown: Passage) -> tuple[Point, Point]:
    """From above, on the side where the craft ends."""
    last = flown.meeting - 1
    middle = flown.place[last] + flown.target[last]
    azimuth = math.atan2(middle[1], middle[0]) + 0.25
    x, y = flown.size * math.cos(azimuth), flown.size * math.sin(azimuth)
    return (1.55 * x, 1.55 * y, 1.27 * flown.size), (0.25 * x, 0.25 * y, 0.0)


def _orbits(recording: Recording, flown: Passage) -> None:
    full = np.linspace(0.0, 2 * np.pi, POINTS)
    recording.path("orbit/target", flown.on_orbit(full), TARGET)
    recording.path("orbit/start", flown.osculating(POINTS, slice(1))[0], GREY)
    recording.net("orbit/osculating", flown.t, flown.osculating(POINTS)[:, None], CRAFT, 0.8)
    centre = np.full((1, 3), 0.06 * flown.size)
    recording.ellipsoid("orbit/centre", [0.0], centre, np.zeros((1, 3)), [[1.0, 0, 0, 0]], SKY)
    recording.trail("orbit/flown", flown.times, flown.place, CRAFT, 2.2)
    recording.trail("orbit/led", flown.times, flown.target, TARGET, 2.2)


def _bodies(recording: Recording, flown: Passage) -> None:
    t, size = flown.times, flown.size
    box = size * np.array([0.08, 0.04, 0.04])
    recording.body("orbit/craft", t, flown.attitude, box, flown.place, CRAFT)
    recording.body("orbit/goal", t, flown.target_attitude, 0.8 * box[[1, 0, 2]], flown.target, TARGET)
    recording.arrow("orbit/thrust", t, 0.42 * size * flown.thrust / _largest(flown), RED, flown.place)
    for i, axis in enumerate(0.16 * size * AXES, start=1):
        recording.arrow(f"orbit/eta-{i}", t, _turned(axis, flown.attitude), CRAFT, flown.place)
        recording.arrow(f"orbit/eta-star-{i}", t, _turned(axis, flown.target_attitude), TARGET, flown.target)


def _axes(recording: Recording, flown: Passage) -> None:
    for i, axis in enumerate(AXES, start=1):
        star = 0.85 * _turned(axis, flown.target_attitude)
        recording.arrow(f"axes/eta-{i}", flown.times, _turned(axis, flown.attitude), CRAFT, label=f"{i}")
        recording.arrow(f"axes/eta-star-{i}", flown.times, star, TARGET, label=f"{i}*")
    recording.arrow("axes/thrust", flown.times, 0.7 * flown.thrust / _largest(flown), RED)


def _largest(flown: Passage) -> float:
    """The largest thrust."""
    return float(np.linalg.norm(flown.control, axis=1).max())


def _turned(axis: Array, attitude: Array) -> Array:
    return rotated(np.broadcast_to(axis, (len(attitude), 3)), attitude)


def _distances(flown: Passage) -> dict[str, Array]:
    """Distances of the craft at `times`."""
    apart = {"craft": flown.target, "phantom": flown.phantom}
    return {name: np.linalg.norm(flown.place - there, axis=1) for name, there in apart.items()}


def _curves(recording: Recording, flown: Passage) -> None:
    t = flown.t
    for name, values, colour in zip(COMPONENTS, flown.control.T, (CRAFT, ORANGE, PURPLE), strict=True):
        recording.curve(f"thrust/{name}", t, values, name, colour)
    recording.curve("magnitude/thrust", t, np.linalg.norm(flown.control, axis=1), "|p|", RED)
    ends = t[[0, -1]]
    peak = flown.extremal.problem.peak
    if np.isfinite(peak):
        recording.curve("magnitude/bound", ends, [peak] * 2, "bound", INK)
    recording.curve("switching/primer", t, flown.primer, "|n|", CRAFT)
    if flown.saturation is not None:
        recording.curve("switching/saturation", ends, [flown.saturation] * 2, "bound binds above", INK)
    apart = _distances(flown)
    recording.curve("distance/target", flown.times, apart["craft"], "to the target", TARGET)
    if flown.misled:
        name = "to where it would have to be"
        recording.curve("distance/phantom", flown.times, apart["phantom"], name, PHANTOM)
    left = np.log10(np.maximum(np.abs(flown.hamiltonian), 10.0**FLOOR))
    recording.curve("hamiltonian/power", t, left, "power of ten", CRAFT)


def _phantom(recording: Recording, flown: Passage) -> None:
    """The target's orbit turned about nu*, its place on it, and the gap at the end."""
    t, size = flown.times, flown.size
    full = flown.on_orbit(np.linspace(0.0, 2 * np.pi, POINTS))
    recording.path("orbit/phantom-orbit", rotated(full, flown.turn), PHANTOM)
    box = 0.8 * size * np.array([0.04, 0.08, 0.04])
    attitude = product(flown.turn, flown.target_attitude)
    recording.body("orbit/phantom", t, attitude, box, flown.phantom, PHANTOM)
    recording.arrow("orbit/nu-star", [0.0], 0.5 * size * flown.invariant[None], INK, label="nu*")
    gap = np.where(t[:, None] >= flown.t[-1], flown.target - flown.place, 0.0)
    recording.arrow("orbit/gap", t, gap, PURPLE, flown.place)


def _events(flown: Passage, true: Passage | None) -> list[tuple[float, str]]:
    """What happens, and when."""
    extremal = flown.extremal
    told = [
        (float(t), f"t = {t:.6g}: the thrust {'meets' if mode == 'saturated' else 'leaves'} its bound")
        for t, mode in zip(extremal.switch_times, extremal.modes[1:], strict=True)
    ]
    end = f"t = {extremal.duration:.6g}"
    cost = f"cost {extremal.cost:.6g}"
    if not flown.misled:
        return [*told, (extremal.duration, f"{end}: the target is met, {cost}")]
    gap = float(_distances(flown)["craft"][flown.meeting - 1])
    words = f"{end}: conditions left {paper_residual(extremal):.0e}, {cost}; the target is {gap:.2f} p* away"
    told.append((extremal.duration, words))
    if true is not None:
        best = true.extremal
        told.append((0.0, f"grey: the true optimum, t = {best.duration:.6g}, cost {best.cost:.6g}"))
    return told
