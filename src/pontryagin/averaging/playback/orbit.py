"""Example 2 as a recording: the spacecraft on its osculating ellipse, its thrust, its cost so far."""

from pathlib import Path

import numpy as np

from pontryagin.arrays import Array
from pontryagin.averaging.examples import spiral
from pontryagin.averaging.playback.pair import AVERAGED, EXACT, Pair, arrivals, panel, slow_curves, slow_plots
from pontryagin.display.plotting import GREEN, GREY, INK, RED, SKY
from pontryagin.display.recording import (
    Events,
    Recording,
    Scene,
    View,
    record,
)

POINTS = 97
"""Number of points with which an ellipse is drawn."""
WORDS = {"E": "energy E", "K": "angular momentum K"}


def record_orbit(pair: Pair, path: Path) -> None:
    """Record the flight of an exact extremal of `kepler` beside the averaged one."""
    flight = spiral.fly(pair.exact)
    lines = flight.ellipses(POINTS)
    reach = float(np.abs(lines).max())
    middle = float(lines[..., 0].min() + lines[..., 0].max()) / 2
    scenes: list[View] = [
        Scene(
            f"epsilon = {pair.epsilon:g}: exact blue, averaged orange",
            "orbit",
            share=3.5,
            trails=("orbit/flown",),
            eye=((middle, -0.5 * reach, 1.9 * reach), (middle, 0.0, 0.0)),
            grid=False,
        ),
        Events("events", "events"),
    ]
    slow, rest = slow_plots(pair, WORDS)
    columns = [
        scenes,
        slow,
        [*rest, panel("control u; the thrust is epsilon u", "thrust", "LeftBottom")],
    ]
    with record(path, "low-thrust spiral", columns, pair.speed, (5, 3, 3)) as recording:
        _scene(recording, pair, flight, reach)
        slow_curves(recording, pair, flight.tau)
        t = flight.tau / pair.epsilon
        for name, values, colour in zip(
            ("along the radius", "across it"), flight.control.T, (RED, GREEN), strict=True
        ):
            recording.curve(f"thrust/{name.split()[0]}", t, values, name, colour)
        arrivals(recording, pair)


def _scene(recording: Recording, pair: Pair, flight: spiral.SpiralFlight, reach: float) -> None:
    t = flight.tau / pair.epsilon
    osculating = _in_space(flight.ellipses(POINTS))
    mean = spiral.ellipses(pair.averaged.slow(pair.grid), np.zeros(len(pair.grid)), POINTS)
    recording.path("orbit/first", osculating[0], GREY)
    recording.path("orbit/last", _in_space(mean)[-1], GREY)
    recording.net("orbit/averaged", pair.grid / pair.epsilon, _in_space(mean)[:, None], AVERAGED, 1.2)
    recording.net("orbit/osculating", t, osculating[:, None], EXACT, 1.2)
    places = _in_space(flight.place)
    recording.trail("orbit/flown", t, places, INK, 0.8)
    planet = np.full(3, 0.12 * reach)
    recording.ellipsoid("orbit/centre", t[:1], planet[None], np.zeros((1, 3)), [[1.0, 0, 0, 0]], SKY)
    heading = np.arctan2(flight.thrust[:, 1], flight.thrust[:, 0]) / 2
    attitude = np.column_stack([np.cos(heading), np.zeros((len(t), 2)), np.sin(heading)])
    recording.body("orbit/spacecraft", t, attitude, reach * np.array([0.09, 0.045, 0.045]), places)
    longest = float(np.hypot(*flight.thrust.T).max())
    arrows = _in_space(flight.thrust) * 0.35 * reach / longest
    recording.arrow("orbit/thrust", t, arrows, RED, places, "thrust")


def _in_space(points: Array) -> Array:
    """Points of the plane (..., 2) as (..., 3)."""
    return np.concatenate([points, np.zeros((*points.shape[:-1], 1))], axis=-1)
