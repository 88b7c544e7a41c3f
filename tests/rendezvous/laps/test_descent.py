"""A descent ends at the exact extremal, up to the fourth power of its steps, with the costates of that."""

import math
from dataclasses import replace

import numpy as np
import pytest

from pontryagin import NotConverged
from pontryagin.rendezvous import Chaser, Orbit, Rendezvous
from pontryagin.rendezvous.laps import descent
from pontryagin.rendezvous.laps.cartesian import Transfer, reduced_costates
from pontryagin.rendezvous.laps.descent import Curve, Thrust, descended, path_of, spaced
from pontryagin.rendezvous.laps.shapes import Shape, curve
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.quadrature import energy
from pontryagin.rendezvous.reduced.shooting import meet
from pontryagin.rendezvous.witness.cartesian import fly_cartesian

HALF = math.radians(60)
SCALED = Rendezvous(
    Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]),
    Orbit(1.2, 0.05, [math.cos(HALF), math.sin(HALF), 0, 0], 0.5),
    time_weight=0,
    energy_weight=1,
    peak=math.inf,
    duration=10.0,
).scaled
DURATION = SCALED.duration


def first(per_lap=40):
    return spaced(curve(SCALED, DURATION, Shape(0, 0.5, back=False)), per_lap, 32)


def test_a_curve_passes_through_its_nodes_and_has_their_velocities():
    path = first()
    assert path.at(path.times) == pytest.approx(path.nodes, abs=1e-12)
    inner = path.times[:-1] + 0.3 * np.diff(path.times)
    shift = 1e-6
    change = (path.at(inner + shift) - path.at(inner - shift)) / (2 * shift)
    assert path.at(inner)[:, 3:] == pytest.approx(change[:, :3], abs=1e-6)


def test_a_coasting_orbit_needs_almost_no_thrust():
    times = np.linspace(0.0, 5.0, 81)
    still = np.zeros_like(times)
    place = np.stack([np.cos(times), np.sin(times), still], axis=1)
    speed = np.stack([-np.sin(times), np.cos(times), still], axis=1)
    assert Thrust.of(Curve(times, np.hstack([place, speed]))).energy < 1e-6


def test_derivatives_of_the_energy():
    path = first()
    thrust = Thrust.of(path)
    _, slopes, bend, curved = thrust.derivatives()
    random = np.random.default_rng(5)
    move = random.standard_normal(path.nodes.shape)
    both = np.hstack([move[:-1], move[1:]])
    step = 1e-5

    def there(share):
        return Thrust.of(replace(path, nodes=path.nodes + share * move))

    change = (there(step).energy - there(-step).energy) / (2 * step)
    assert (slopes * both).sum() == pytest.approx(change, rel=1e-6)
    change = (there(step).derivatives()[1] - there(-step).derivatives()[1]) / (2 * step)
    assert np.einsum("nij,nj->ni", bend + curved, both) == pytest.approx(change, rel=1e-5, abs=1e-3)


def test_the_energy_and_the_costates_approach_those_of_the_exact_extremal():
    setting = Setting(SCALED, SCALED.ratio, math.inf, duration=DURATION)
    errors = []
    for per_lap in (40, 80):
        path = descended(spaced(descended(first(), 1e-3), per_lap, 32), 1e-9)
        found = path_of(path)
        start = reduced_costates(SCALED, found.nodes[6:, 0])
        root = meet(setting, start)
        errors.append([Thrust.of(path).energy - energy(root.flight), np.abs(start - root.unknowns).max()])
    assert errors[0][0] > 0 and 10 < errors[0][0] / errors[1][0] < 22
    assert errors[0][1] < 1e-3 and 8 < errors[0][1] / errors[1][1] < 32
    exact = fly_cartesian(root.flight, path.times)
    assert np.abs(found.nodes.T - exact[:, :12]).max() < 1e-3


def test_nodes_are_spaced_evenly_in_s():
    path = first()
    weight = Transfer(SCALED).weight(path.nodes.T)
    steps = np.diff(path.times) * (1 / weight[1:] + 1 / weight[:-1]) / 2
    assert steps == pytest.approx(steps.mean(), rel=0.03)
    assert path.times[[0, -1]].tolist() == [0.0, DURATION]


def test_a_descent_that_is_cut_short_is_not_converged(monkeypatch):
    monkeypatch.setattr(descent, "STEPS", 2)
    with pytest.raises(NotConverged, match="did not settle"):
        descended(first(), 1e-9)
