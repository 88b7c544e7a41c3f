"""Certificates of extremals, which detect wrong costates, places and costs."""

import math
from dataclasses import replace

import numpy as np
import pytest

from pontryagin.rendezvous import (
    Rendezvous,
    solve,
)
from pontryagin.rendezvous.reduced.certificate import (
    agreement,
    certify,
    flown_thrust,
    fly_full,
    maximality,
    newton_agreement,
)
from pontryagin.rendezvous.reduced.conditions import Setting, equations
from pontryagin.rendezvous.reduced.quadrature import energy
from pontryagin.rendezvous.reduced.shooting import meet
from pontryagin.rendezvous.root import Root
from pontryagin.rendezvous.witness.cartesian import cartesian_of, fly_cartesian
from rendezvous_problems import CRAFT, orbit, problem


@pytest.mark.slow
def test_the_certificate_detects_a_wrong_costate():
    root = solve(problem(20, duration=3.0)).root
    setting = Setting(problem(20).scaled, 1.0, math.inf, duration=root.flight.duration)
    moved = equations(setting, root.unknowns + 1e-6 * np.eye(6)[3])
    assert certify(root, (0.0, 1.0), free=False).holds(1e-10)
    wrong = Root(root.unknowns, moved)
    assert not certify(wrong, (0.0, 1.0), free=False).holds(1e-8)


@pytest.mark.slow
def test_a_meeting_ahead_of_the_target_violates_only_the_condition_on_the_attitude():
    """In one plane and with a circular target orbit, (5), (15), (16) and H = 0 hold anywhere on the orbit."""
    free = Rendezvous(CRAFT, orbit(0, eccentricity=0.0), 0.002, 1.0, math.inf)
    best = solve(free)
    later = replace(free, target=replace(free.target, anomaly=free.target.anomaly + 0.1))
    ahead = meet(Setting(later.scaled, later.scaled.ratio, math.inf), best.root.unknowns).unknowns
    setting = Setting(free.scaled, free.scaled.ratio, math.inf)
    false = certify(Root(ahead, equations(setting, ahead)), free.scaled.weights, free=True)
    others = (false.boundary, false.transversality, false.hamiltonian, false.maximality, false.agreement)
    assert max(others) < 1e-10
    assert false.attitude == pytest.approx(math.sin(0.05), rel=1e-6)
    assert best.certificate.holds(1e-10)


@pytest.mark.slow
def test_the_certificate_detects_a_wrong_cost(leap, monkeypatch):
    monkeypatch.setattr(
        "pontryagin.rendezvous.reduced.certificate.energy", lambda flight: energy(flight) * (1 + 1e-6)
    )
    again = replace(leap)
    assert float(again.certificate.cost) == pytest.approx(1e-6, rel=1e-3)
    assert not again.certificate.holds(1e-9)


FAULT = 1e-5


class TestFaultsOfAKnownFlight:
    """Each check measures a fault at a single time of the flight by its size."""

    @pytest.fixture
    def sampled(self, leap):
        """The flight, times, and its states by the reduced equations."""
        flight = leap.root.flight
        times = np.linspace(0, flight.duration, 11)
        return flight, times, flight.sample(times)

    @staticmethod
    def disturbed(states, column, size):
        wrong = states.copy()
        wrong[4, column] += size
        return wrong

    @pytest.mark.parametrize("check", [agreement, newton_agreement])
    def test_a_fault_of_the_radial_speed_is_its_size(self, sampled, check):
        flight, times, states = sampled
        other = fly_full(flight, times) if check is agreement else fly_cartesian(flight, times)
        assert check(flight, states, other) < 1e-10
        along = np.abs(cartesian_of(states, flight.attitude(states))[4, :3]).max() / states[4, 0]
        found = check(flight, self.disturbed(states, 1, FAULT), other)
        assert found == pytest.approx(FAULT * along, rel=1e-4)

    def test_a_fault_of_a_costate_is_its_share_of_the_largest(self, sampled):
        flight, times, states = sampled
        largest = np.abs(states[:, 4:10]).max()
        found = agreement(flight, self.disturbed(states, 6, FAULT), fly_full(flight, times))
        assert found == pytest.approx(FAULT / largest, rel=1e-4)
        turned = newton_agreement(flight, self.disturbed(states, 5, FAULT), fly_cartesian(flight, times))
        along = np.abs(cartesian_of(states, flight.attitude(states))[4, :3]).max() / states[4, 0]
        assert turned == pytest.approx(FAULT * along / largest, rel=1e-4)

    @pytest.mark.parametrize("factor", [0.9, 1.1])
    def test_what_another_thrust_loses_is_a_square(self, sampled, factor):
        """H is a parabola in the thrust about the optimum: -alpha2 (p - p*)^2."""
        flight, times, states = sampled
        thrust, weights = flown_thrust(flight, times, states), (0.0, 1.0)
        assert np.abs(maximality(flight, states, thrust, weights)).max() < 1e-12
        lost = ((factor - 1) * np.linalg.norm(thrust, axis=1)) ** 2
        assert maximality(flight, states, factor * thrust, weights) == pytest.approx(
            lost, rel=1e-6, abs=1e-14
        )

    def test_a_thrust_beyond_the_bound_is_counted(self, sampled):
        flight, times, states = sampled
        thrust = flown_thrust(flight, times, states)
        peak = np.linalg.norm(thrust, axis=1).max()
        bounded = replace(flight, peak=0.5 * peak)
        size = np.linalg.norm(thrust, axis=1)
        beyond = size > 0.5 * peak
        assert beyond.any()
        over = np.maximum(size - 0.5 * peak, 0.0)
        found = maximality(bounded, states, thrust, (0.0, 1.0))
        assert found[beyond] == pytest.approx((over + over**2)[beyond], rel=1e-6)

    def test_the_hamiltonian_of_a_free_duration_is_zero_and_of_a_fixed_one_constant(self, leap):
        """That of the fixed duration is no zero: the same flight is refused as one of a free duration."""
        root = leap.root
        assert certify(root, (0.0, 1.0), free=False).hamiltonian < 1e-10
        assert certify(root, (0.0, 1.0), free=True).hamiltonian > 1e-3

    def test_the_worst_moment_counts(self, leap, monkeypatch):
        """The unit of H is the largest running cost, here the largest square of the thrust."""
        root = leap.root
        times = np.linspace(0, root.flight.duration, 201)
        running = (flown_thrust(root.flight, times, root.flight.sample(times)) ** 2).sum(axis=1).max()
        place = "pontryagin.rendezvous.reduced.certificate.maximality"
        monkeypatch.setattr(place, lambda *given: FAULT * running * np.eye(201)[77])
        assert float(certify(root, (0.0, 1.0), free=False).maximality) == pytest.approx(FAULT, rel=1e-9)

    @pytest.mark.parametrize("witness", ["fly_full", "fly_cartesian"])
    def test_a_witness_that_disagrees_is_seen_alone(self, leap, monkeypatch, witness):
        """A costate of the 16 equations, or a place by Newton's law, is wrong at one moment."""
        plain = {"fly_full": fly_full, "fly_cartesian": fly_cartesian}[witness]

        def wrong(flight, times):
            rows = plain(flight, times)
            rows[77, 2 if witness == "fly_cartesian" else 8] += FAULT
            return rows

        monkeypatch.setattr(f"pontryagin.rendezvous.reduced.certificate.{witness}", wrong)
        found = certify(leap.root, (0.0, 1.0), free=False)
        unit = np.abs(leap.root.flight.sample(np.linspace(0, leap.root.flight.duration, 201))[:, 4:10]).max()
        assert found.agreement == pytest.approx(FAULT / (1 if witness == "fly_cartesian" else unit), rel=1e-3)
