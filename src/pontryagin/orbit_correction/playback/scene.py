"""The recording of one plan: the orbit, the impulses, and the sets of states that can still be corrected.

The orbit's radius and speed are the units; a radian of the orbit takes `PACE` seconds.
"""

from pathlib import Path

import numpy as np

from pontryagin.arrays import Array
from pontryagin.display.plotting import BLUE, GREEN, GREY, ORANGE, RED, SKY
from pontryagin.display.recording import Events, Plot, Point, Recording, Scene, View, record
from pontryagin.errors import ArgumentValueError
from pontryagin.orbit_correction import sets
from pontryagin.orbit_correction.flight import fly_plan
from pontryagin.orbit_correction.plan.correction import Plan, single
from pontryagin.orbit_correction.playback.remaining import Remaining, remaining
from pontryagin.orbit_correction.system import satellite

SAMPLES = 13
"""Number of instants recorded in each interval between impulses, including its two ends."""

PACE = 10.0
"""Seconds of the recording for a radian of the orbit."""

BLINK = 0.06
"""Seconds that a jump takes in a plot, because the player averages values that share a pixel."""

HOLD = 0.5
"""Seconds for which an impulse is shown."""

RADIUS = 10.0
"""Radius of the orbit as drawn."""

LENGTH = 4.0
"""Length of the arrow of an impulse of the largest admissible size."""

NEAR_THE_SET: tuple[Point, Point] = ((1.1, -1.3, 0.7), (0.0, 0.0, 0.0))
"""The place of the camera that shows the sets, and the point that it looks at."""

SIDES = (("radial", RED), ("transverse", GREEN))
"""The components of an impulse and their colours."""

STATES = (("dr", BLUE), ("dvR", RED), ("dvT", GREEN))
"""The deviations and their colours."""


def record_plan(plan: Plan, path: Path) -> None:
    """Record one plan: its true flight, and in the linear model the states that can still be corrected.

    Parameters
    ----------
    plan : Plan
        A plan of one state, with at least one impulse.
    path : Path
        File to write, ending in ``.rrd``.

    Raises
    ------
    ValueError
        If the plan is that of a stack, or of no impulse.
    """
    if int(single(plan).impulse_count) == 0:
        raise ArgumentValueError("plan must have an impulse, got a plan without any", "plan")
    factor = magnification(plan)
    plots: list[View] = [
        Plot("deviation of the true flight, thousandths", "state"),
        Plot("impulse over its bound", "impulse", span=(-1.1, 1.1)),
        Plot("gauge of the state in the remaining set; home at or below 1", "gauge", span=(0.0, 1.1)),
    ]
    scenes: list[View] = [
        Scene(
            f"the orbit, deviation of the radius times {factor:g}, {PACE:g} s a radian", "orbit", _above(plan)
        ),
        Scene("states that the remaining impulses bring back, stretched to unit size", "sets", NEAR_THE_SET),
        Events("impulses", "events"),
    ]
    with record(path, f"orbit correction, {plan.thrust.name}", [scenes, plots]) as recording:
        _orbit(recording, plan, factor)
        _sets(recording, plan)
        for j, impulse in enumerate(plan.impulses / plan.thrust.peak):
            time = PACE * j * plan.thrust.interval
            words = f"impulse {j}: radial {impulse[0]:+.3f}, transverse {impulse[1]:+.3f} of the bound"
            recording.event("events", time, words)
        last = fly_plan(plan)
        words = f"left by the true flight: {last.residual:.2e}"
        recording.event("events", PACE * len(plan.impulses) * plan.thrust.interval, words)


def magnification(plan: Plan) -> float:
    """The factor by which deviations of the radius are enlarged: 1, 2 or 5 times a power of ten."""
    largest = float(np.abs(fly_plan(plan).path(SAMPLES)[1][:, 0]).max())
    wanted = 0.25 / max(largest, 1e-12)
    power = 10.0 ** np.floor(np.log10(wanted))
    return float(max(step for step in (1, 2, 5) if step * power <= wanted) * power)


def _above(plan: Plan) -> tuple[Point, Point]:
    """A camera above the arc that is flown, or above the circle if the arc exceeds 2 rad."""
    arc = float(fly_plan(plan).angles[-1])
    if arc > 2:
        return (0.0, -1.6 * RADIUS, 2.6 * RADIUS), (0.0, 0.0, 0.0)
    x, y = RADIUS * np.cos(arc / 2), RADIUS * np.sin(arc / 2)
    return (1.1 * x, 1.1 * y, 0.7 * RADIUS), (0.88 * x, 0.88 * y, 0.0)


def _orbit(recording: Recording, plan: Plan, factor: float) -> None:
    flight = fly_plan(plan)
    instants, states, angles = flight.path(SAMPLES)
    t = PACE * instants
    t[1:] += BLINK * (np.diff(t) == 0)
    along = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(len(t))])
    across = np.column_stack([-np.sin(angles), np.cos(angles), np.zeros(len(t))])
    places = RADIUS * (1 + factor * states[:, :1]) * along
    turn = np.linspace(0, 2 * np.pi, 181)
    circle = RADIUS * np.column_stack([np.cos(turn), np.sin(turn), np.zeros(turn.size)])
    recording.path("orbit/circle", circle, GREY)
    recording.path("orbit/flown", places, BLUE)
    recording.ellipsoid("orbit/planet", t[:1], [[2.0] * 3], [[0.0] * 3], [[1.0, 0, 0, 0]], SKY)
    attitude = np.column_stack([np.cos(angles / 2), np.zeros((len(t), 2)), np.sin(angles / 2)])
    recording.body("orbit/satellite", t, attitude, (0.45, 0.8, 0.3), places)
    fired = _flash(plan, t)
    arrows = LENGTH * (fired[:, :1] * along + fired[:, 1:] * across)
    recording.arrow("orbit/impulse", t, arrows, ORANGE, places)
    for (name, colour), values in zip(STATES, states.T, strict=True):
        recording.curve(f"state/{name}", t, 1e3 * values, name, colour)
    dense = np.unique(np.concatenate([t, *(t + shift for shift in (HOLD, HOLD + BLINK))]))
    for (name, colour), values in zip(SIDES, _flash(plan, dense).T, strict=True):
        recording.curve(f"impulse/{name}", dense[dense <= t[-1]], values[dense <= t[-1]], name, colour)


def _flash(plan: Plan, t: Array) -> Array:
    """Impulses over their bound as shown at the times (k,), each for `HOLD` seconds, (k, 2)."""
    since = t[:, None] - PACE * plan.thrust.interval * np.arange(len(plan.impulses))
    shown = (since > 0) & (since < HOLD + BLINK / 2)
    return np.asarray(shown @ (plan.impulses / plan.thrust.peak))


def _sets(recording: Recording, plan: Plan) -> None:
    square = plan.thrust.name == "box"
    frame = sets.frame_of(plan.thrust.factors(int(plan.steps)), square)
    normals = frame.back(sets.sphere_grid(10, 20))
    times, states, nets, gauges = [], [], [], []
    held = plan.z0
    for j in range(len(plan.impulses) + 1):
        left = remaining(plan, j)
        instants = plan.thrust.interval * (np.linspace(j - 1, j, SAMPLES) if j else np.zeros(1))
        surface = left.boundary(normals, square)
        for t in instants:
            moved = satellite.transition(t)
            times.append(PACE * t)
            states.append(frame.points(moved @ held))
            nets.append(frame.points(surface @ moved.T))
            if j < len(plan.impulses):
                gauges.append(_proved(plan, held, left, square))
        if j < len(plan.impulses):
            held = held + satellite.transition(-j * plan.thrust.interval) @ [0.0, *plan.impulses[j]]
    grid, path = np.array(nets), np.array(states)
    recording.net("sets/meridians", times, np.moveaxis(grid, 2, 1), BLUE)
    recording.net("sets/parallels", times, grid[:, 1:-1], SKY)
    recording.arrow("sets/state", times, path, RED)
    recording.path("sets/flown", path, GREY)
    home = [times[len(gauges) - 1] + BLINK, times[-1]]
    recording.curve("gauge/alpha", times[: len(gauges)] + home, [*gauges, 0.0, 0.0], "alpha", BLUE)


def _proved(plan: Plan, held: Array, left: Remaining, square: bool) -> float:
    """The gauge, as the plan's costate proves it, of a state ``held`` that is carried back to the start."""
    psi = -plan.initial_costate
    return float(held @ psi) / float(left.boundary(psi, square) @ psi)
