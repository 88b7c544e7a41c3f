"""The certificate in the elements detects a wrong costate."""

from types import SimpleNamespace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pontryagin.numerics.rotation import product
from pontryagin.rendezvous import (
    solve_in_elements,
)
from pontryagin.rendezvous.elements.certificate import (
    certify,
    fly_cartesian,
    maximality,
    off_level,
    turn_momentum,
)
from pontryagin.rendezvous.elements.conditions import ElementsSetting, equations
from pontryagin.rendezvous.elements.elements import I1
from pontryagin.rendezvous.elements.flight import COSTATES, switching
from pontryagin.rendezvous.elements.law import Law
from pontryagin.rendezvous.root import Root
from rendezvous_problems import problem


def test_the_certificate_detects_a_wrong_costate():
    mine = solve_in_elements(problem(20, duration=6.0))
    moved = mine.root.unknowns + 1e-6 * np.eye(7)[2]
    wrong = Root(moved, equations(ElementsSetting(mine.problem.scaled, mine.flight.law, 1.0), moved))
    assert mine.certificate.holds(1e-10) and not certify(wrong, free=False).holds(1e-8)


COSTS = {
    Law("square", 0.3, 0.8): lambda size: 0.3 + size**2,
    Law("square", 0.0, np.inf): lambda size: size**2,
    Law("fuel", 0.3, 0.8): lambda size: 0.3 + size,
    Law("square", np.inf, 0.8): lambda size: np.ones_like(size),
}


@pytest.mark.parametrize("law", COSTS)
def test_what_a_thrust_loses_is_the_difference_to_the_best_one_on_a_grid(law):
    """H is n.p less the running cost; largest for a thrust along n. What is beyond p_max counts too."""
    rng = np.random.default_rng(4)
    n, thrust = rng.normal(size=(2, 40, 3)) * rng.uniform(0.1, 2.0, (2, 40, 1))
    sizes = np.linspace(0.0, min(law.peak, 10.0), 100_001)
    gains = np.linalg.norm(n, axis=1)[:, None] * sizes - COSTS[law](sizes)
    given = np.linalg.norm(thrust, axis=1)
    used = np.sum(n * thrust, axis=1) - COSTS[law](given)
    beyond = np.maximum(given - law.peak, 0.0)
    found = maximality(SimpleNamespace(law=law), n, thrust)
    assert_allclose(found, np.abs(gains.max(axis=1) - used) + beyond, atol=1e-8)
    assert (beyond > 0).any() == (law.peak < np.inf)


def test_a_momentum_of_the_turn_is_its_share_of_the_largest_costate():
    """Turning A and B together moves neither place nor velocity: the momentum of an extremal is zero."""
    flight = solve_in_elements(problem(20, duration=6.0)).flight
    states = flight.sample(np.linspace(0.0, flight.phi, 9))
    assert turn_momentum(states) < 1e-12
    along = np.hstack([product(I1, states[4, :4]), product(I1, states[4, 4:8])])
    largest, wrong = np.abs(states[:, COSTATES]).max(), states.copy()
    wrong[4, COSTATES] += 1e-6 * along / (along @ along)
    assert_allclose(turn_momentum(wrong), 1e-6 / largest, rtol=1e-4)


def test_switches_off_their_level_are_seen_by_their_share(fuel):
    flight = fuel.flight
    assert len(flight.pieces) > 1 and off_level(flight) < 1e-10

    class Shifted:
        """The law of the flight with levels that are a millionth lower."""

        def constants(self, mode):
            constants = flight.law.constants(mode)
            return constants._replace(level=constants.level / (1 + 1e-6))

    shifted = SimpleNamespace(pieces=flight.pieces, law=Shifted(), switch_angles=flight.switch_angles)
    assert_allclose(off_level(shifted), 1e-6, rtol=1e-3)


def test_the_worst_moment_counts(monkeypatch):
    """The unit of H is the largest running cost, here the largest square of the thrust."""
    root = solve_in_elements(problem(20, duration=6.0)).root
    grid = np.linspace(0.0, root.flight.phi, 201)
    running = (root.flight.thrust(root.flight.sample(grid), grid) ** 2).sum(axis=1).max()
    place = "pontryagin.rendezvous.elements.certificate.maximality"
    monkeypatch.setattr(place, lambda *given: 1e-5 * running * np.eye(201)[77])
    assert_allclose(certify(root, free=False).maximality, 1e-5, rtol=1e-9)


def test_a_flight_with_coasts_agrees_with_newton_s_law_arc_by_arc(fuel):
    again = certify(fuel.root, free=False)
    assert len(fuel.flight.pieces) > 1 and again.agreement < 1e-9 and again.holds(1e-8)


@pytest.mark.parametrize("column", [2, 10])
def test_places_and_costates_that_newton_s_law_does_not_confirm_are_seen_alone(fuel, monkeypatch, column):
    """A place of the witness, or a component of n, is wrong in the middle of the flight by a millionth."""
    root, place = fuel.root, "pontryagin.rendezvous.elements.certificate.fly_cartesian"
    grid = np.linspace(0.0, root.flight.phi, 201)
    n = switching(root.flight.sample(grid), grid)
    unit = 1.0 if column == 2 else np.linalg.norm(n, axis=1).max()

    def wrong(flight, times):
        rows = fly_cartesian(flight, times)
        rows[100, column] += 1e-6 * unit
        return rows

    monkeypatch.setattr(place, wrong)
    assert_allclose(certify(root, free=False).agreement, 1e-6, rtol=1e-3)
