"""Recordings that replay: one channel under three norms, the real turn, the coupled manoeuvre.

`recordings` names them, each with the function that writes it; `record_solution` records any one solution.
Angles are in rad, times in s.
"""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.display.plotting import BLUE, GREEN, INK, ORANGE, PURPLE, RED
from pontryagin.display.recording import Events, Plot, Recording, Scene, View, record
from pontryagin.numerics.rotation import between, quaternion, rotation_vector
from pontryagin.triple_integrator.attitude import Programme, Turn, impulses, single, turn
from pontryagin.triple_integrator.attitude.rigid_body import RigidBody
from pontryagin.triple_integrator.coupling import CoupledManeuver, couple
from pontryagin.triple_integrator.coupling.channels import Channels
from pontryagin.triple_integrator.norms.energy import minimum_energy
from pontryagin.triple_integrator.norms.impulse import minimum_impulse
from pontryagin.triple_integrator.norms.peak import minimum_peak
from pontryagin.triple_integrator.problem.maneuver import Maneuver

SAMPLES = 401
NORMS: dict[str, tuple[Callable[[Maneuver], Programme], str]] = {
    "energy": (minimum_energy, BLUE),
    "peak": (minimum_peak, RED),
    "impulse": (minimum_impulse, GREEN),
}
CHANNEL_AXIS = np.array([0.0, 0.0, 1.0])
CHANNEL_COLOURS = (BLUE, RED, GREEN)
GREY = "#9a9a9a"

SPACECRAFT = RigidBody(np.array([[4.0, 0.3, -0.2], [0.3, 3.0, 0.1], [-0.2, 0.1, 2.0]]))
"""The body of the recordings: unequal moments and products of inertia, kg m²."""


def recordings() -> dict[str, Callable[[Path], None]]:
    """The recordings of this paper: name and the function that writes the file."""
    return {
        "three-norms": three_norms,
        "real-turn-energy": real_turn_energy,
        "real-turn-peak": real_turn_peak,
        "real-turn-impulse": real_turn_impulse,
        "coupled-channels": coupled_channels,
    }


def three_norms(path: Path) -> None:
    """One channel, three norms side by side.

    Three spacecraft turn about one axis by a quarter turn in six seconds: with the least energy, the least
    peak and the least total impulse of the control. Impulses are spikes in the control's plot, events, and
    arrows along the axis.
    """
    maneuver = rest_to_rest(np.pi / 2)
    _record_channels(path, "three norms", {name: solve(maneuver) for name, (solve, _) in NORMS.items()})


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


def coupled_channels(path: Path) -> None:
    """Three coupled channels of one body.

    All three channels turn at once. The left body follows programmes that know the cross-coupling, iterated
    until the full equations reach the target; the right one the programmes of channels that know of no other.
    """
    channels = [rest_to_rest(angle) for angle in (0.4, -0.5, 0.6)]
    coupled = couple(SPACECRAFT, channels, minimum_energy)
    record_coupled(path, coupled)


def rest_to_rest(angle: float) -> Maneuver:
    """A turn by an angle from rest to rest in six seconds."""
    return Maneuver(np.zeros(3), np.array([angle, 0.0, 0.0]), np.array(6.0))


def record_solution(solution: Programme, path: Path) -> None:
    """Record one solution of one manoeuvre: a body that turns about one axis, and its states against time.

    Parameters
    ----------
    solution : solution of one manoeuvre
    path : Path
        File to write, ending in ``.rrd``.

    Raises
    ------
    ValueError
        If the solution is that of a stack.
    """
    single(solution)
    _record_channels(path, "one channel", {"programme": solution})


def sample_times(programmes: Sequence[Programme]) -> Array:
    """Evenly spaced times of the manoeuvre and both sides of every switch and impulse, (k,)."""
    maneuver = programmes[0].maneuver
    first, last = float(maneuver.t0), float(maneuver.tf)
    events = np.concatenate([[*p.breakpoints, *(time for time, _ in impulses(p))] for p in programmes])
    sides = [events, np.nextafter(events, -np.inf), np.nextafter(events, np.inf)]
    return np.unique(np.clip(np.concatenate([np.linspace(first, last, SAMPLES), *sides]), first, last))


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
    _spacecraft(recording, f"turn/{label}", t, quaternion(x[:, :1] * CHANNEL_AXIS), position, colour)
    _target(recording, f"turn/{label}-target", t, quaternion(maneuver.xf[0] * CHANNEL_AXIS), position)
    for branch, values in zip(("angle", "rate", "acceleration"), x.T, strict=True):
        recording.curve(f"{branch}/{label}", t, values, label, colour)
    told = impulses(programme)
    times, heights = _spikes(told, maneuver, t) if told else (t, programme.control(t))
    recording.curve(f"control/{label}", times, heights, label, colour)
    for time, jump in told:
        recording.event("events", time, f"{label}: impulse {jump:+.4g} rad/s²")
    if told:
        flash = _flash(t, told, float(maneuver.duration))
        origin = np.tile(position, (t.size, 1))
        recording.arrow(f"turn/{label}-impulse", t, flash[:, None] * CHANNEL_AXIS, ORANGE, origin)
    else:
        for time in programme.breakpoints:
            recording.event("events", time, f"{label}: the control switches")


def _spikes(told: Sequence[tuple[float, float]], maneuver: Maneuver, t: Array) -> tuple[Array, Array]:
    """Impulses as a curve: each a spike of its height, 1 % of T wide so that a screen shows it.

    The player averages values that fall on one pixel: every time stands once, and those between, t, too.
    """
    first, last = float(maneuver.t0), float(maneuver.tf)
    offsets = 0.005 * (last - first) * np.array([-1.2, -1.0, 1.0, 1.2])
    times = np.concatenate([[first], *(np.clip(time + offsets, first, last) for time, _ in told), [last]])
    heights = np.concatenate([[0.0], *([0.0, jump, jump, 0.0] for _, jump in told), [0.0]])
    order = np.lexsort((-np.abs(heights), times))
    once, place = np.unique(times[order], return_index=True)
    dense = np.unique(np.round(np.concatenate([once, t]), 7))
    return dense, np.interp(dense, once, heights[order][place])


def _flash(t: Array, told: Sequence[tuple[float, float]], duration: float) -> Array:
    """Length of the arrow that marks impulses: 3 for the largest, drawn within 3 % of T of its instant."""
    largest = max(abs(jump) for _, jump in told)
    marks = [np.where(np.abs(t - time) <= 0.03 * duration, 3 * jump / largest, 0.0) for time, jump in told]
    return np.sum(marks, axis=0)


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
    _spacecraft(recording, f"turn/{name}", t, made.attitude(t), position, colour)
    _target(recording, f"turn/{name}-target", t, made.planned_attitude(t[-1:])[0], position)
    recording.path(f"turn/{name}-axis", position + np.outer([-2.6, 2.6], made.axis), INK)
    origin = np.tile(position, (t.size, 1))
    largest = np.linalg.norm(made.torque(t), axis=1).max()
    rotated = _to_inertial(made.attitude(t), made.torque(t))
    recording.arrow(f"turn/{name}-torque", t, 3 * rotated / largest, ORANGE, origin)
    error = np.linalg.norm(made.error(t), axis=1)
    recording.curve(f"error/{name}", t, error, label, colour)
    for i, values in enumerate(made.rate(t).T):
        recording.curve(f"rate/{name}-{i + 1}", t, values, f"w{i + 1} {label}", CHANNEL_COLOURS[i])


def _torques(recording: Recording, made: Turn, t: Array) -> None:
    for i, colour in enumerate(CHANNEL_COLOURS):
        channel, gyroscopic = made.channel_torque(t)[:, i], made.gyroscopic_torque(t)[:, i]
        recording.curve(f"torque/channel/{i + 1}", t, channel, f"channel M{i + 1}", colour)
        recording.curve(f"torque/gyroscopic/{i + 1}", t, gyroscopic, f"gyroscopic M{i + 1}", colour)


def record_coupled(path: Path, coupled: CoupledManeuver) -> None:
    """Record a coupled manoeuvre beside the motion of the uncoupled programmes.

    Parameters
    ----------
    path : Path
        File to write, ending in ``.rrd``.
    coupled : CoupledManeuver
        With all three channels programmed for the least energy.
    """
    plain = tuple(
        minimum_energy(Maneuver(m.x0, m.xf, m.tf, m.t0)) for m in (p.maneuver for p in coupled.programmes)
    )
    uncoupled = Channels(coupled.body, plain, coupled.programmed).move()
    t = sample_times([*coupled.programmes, *plain])
    target = quaternion([programme.maneuver.xf[0] for programme in coupled.programmes])
    plots: list[View] = [
        Plot("channel angle, rad", "angle"),
        Plot("cross-coupling f, rad/s²", "coupling"),
        Plot("control, rad/s³", "control"),
        Plot("turn left to the target, rad", "left"),
    ]
    layout = [[Scene("the manoeuvre", "turn"), Events("iterations", "events")], plots]
    with record(path, "coupled channels", layout) as recording:
        bodies: list[tuple[str, Any, str]] = [("coupled", coupled, BLUE), ("uncoupled", uncoupled, RED)]
        for place, (label, motion, colour) in enumerate(bodies):
            position = np.array([6.0 * place, 0.0, 0.0])
            _spacecraft(recording, f"turn/{label}", t, motion.attitude(t), position, colour)
            _target(recording, f"turn/{label}-target", t, target, position)
            recording.curve(f"left/{label}", t, angle_between(motion.attitude(t), target), label, colour)
        state, f, u = coupled.state(t), coupled.coupling(t), coupled.control(t)
        for i, colour in enumerate(CHANNEL_COLOURS):
            recording.curve(f"angle/{i + 1}", t, state[i, :, 0], f"channel {i + 1}", colour)
            recording.curve(f"coupling/{i + 1}", t, f[i], f"channel {i + 1}", colour)
            recording.curve(f"control/{i + 1}", t, u[i], f"channel {i + 1}", colour)
        for k, miss in enumerate(coupled.misses):
            recording.event("events", t[0], f"iterate {k}: misses the target by {miss:.2e}")


def angle_between(attitude: ArrayLike, target: ArrayLike) -> Array:
    """Angle of the turn from attitudes (k, 4) to a target (4,), rad, (k,)."""
    stack = np.asarray(attitude, dtype=float)
    left = rotation_vector(between(stack, np.broadcast_to(target, stack.shape)))
    return np.asarray(np.linalg.norm(left, axis=1))


def _to_inertial(attitude: Array, vectors: Array) -> Array:
    scalar, axis = attitude[:, :1], attitude[:, 1:]
    turned = 2 * np.cross(axis, vectors)
    return vectors + scalar * turned + np.cross(axis, turned)


def _spacecraft(
    recording: Recording, entity: str, t: Array, attitude: Array, position: Array, colour: str
) -> None:
    """A bus with two solar wings along its second axis and a dish along its first."""
    recording.body(entity, t, attitude, (1.2, 0.9, 0.9), np.tile(position, (t.size, 1)), colour)
    parts = {
        "wing-left": ((0.0, 1.35, 0.0), (0.9, 1.5, 0.05), PURPLE),
        "wing-right": ((0.0, -1.35, 0.0), (0.9, 1.5, 0.05), PURPLE),
        "dish": ((0.75, 0.0, 0.0), (0.3, 0.5, 0.5), ORANGE),
    }
    for part, (place, size, look) in parts.items():
        recording.body(f"{entity}/{part}", t[:1], [[1, 0, 0, 0]], size, [place], look)


def _target(recording: Recording, entity: str, t: Array, attitude: Array, position: Array) -> None:
    """The target attitude as a triad."""
    for i, unit in enumerate(np.eye(3)):
        arm = 2.2 * _to_inertial(attitude[None], unit[None])[0]
        recording.path(f"{entity}/{i + 1}", [position, position + arm], GREY, 0.03)
