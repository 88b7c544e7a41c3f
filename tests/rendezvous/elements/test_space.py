"""Planes of opposite senses are met in the elements, which do not need an angular momentum."""

import math

import numpy as np
import pytest

from pontryagin.rendezvous import Chaser, Orbit, Rendezvous, solve_in_elements
from pontryagin.rendezvous.elements.space import half_anomaly, in_space
from pontryagin.rendezvous.laps.transcription import Path


def opposite(**changes):
    target = Orbit(1.2, 0.05, [0, 1, 0, 0], 0.5)
    weights = {"time_weight": 0, "energy_weight": 1, "peak": math.inf, "duration": 10.0}
    return Rendezvous(Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]), target, **weights | changes)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("changes", "cost"),
    [
        ({}, 0.425297),
        ({"duration": None, "time_weight": 0.0036}, 0.174729),
        ({"duration": None, "time_weight": 1, "energy_weight": 0, "peak": 0.1}, 16.839230),
    ],
)
def test_planes_of_opposite_senses_are_met(changes, cost):
    """The costs are the limits of those at inclinations near 180 degrees, by the reduced form."""
    found = solve_in_elements(opposite(**changes))
    assert found.certificate.holds(1e-9) and found.cost == pytest.approx(cost, abs=2e-6)


def test_a_path_in_space_gives_the_unknowns_of_a_meeting():
    scaled = opposite().scaled
    starts = list(in_space(scaled))
    assert len(starts) >= 2 and all(start.shape == (7,) for start in starts)


def test_half_the_eccentric_anomaly_of_an_orbit():
    """On an ellipse phi grows by pi in a revolution; s grows by the integral of dt/r^(3/2)."""
    eccentricity = 0.4
    anomaly = np.linspace(0.0, 2 * math.pi, 4001)
    distance, pace = 1 - eccentricity * np.cos(anomaly), 1 / (1 - eccentricity * np.cos(anomaly))
    minor = math.sqrt(1 - eccentricity**2)
    still = np.zeros_like(anomaly)
    place = np.stack([np.cos(anomaly) - eccentricity, minor * np.sin(anomaly), still])
    speed = np.stack([-np.sin(anomaly), minor * np.cos(anomaly), still]) * pace
    s = np.append(0.0, np.cumsum(np.diff(anomaly) * (distance[1:] ** -0.5 + distance[:-1] ** -0.5) / 2))
    even = np.linspace(0.0, s[-1], 801)
    nodes = np.array([np.interp(even, s, row) for row in (*place, *speed)])
    path = Path(np.vstack([nodes, np.zeros_like(nodes)]), 0.0, float(s[-1]), 2 * math.pi)
    assert half_anomaly(path) == pytest.approx(math.pi, rel=1e-5)
    fast = Path(path.nodes * np.repeat([1.0, 2.0, 1.0], [3, 3, 6])[:, None], 0.0, path.span, path.duration)
    assert math.isnan(half_anomaly(fast))
