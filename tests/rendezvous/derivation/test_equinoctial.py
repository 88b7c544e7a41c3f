"""Gauss's equations in equinoctial elements are Newton's law; K is the Hamiltonian with s as the time."""

import pytest
import sympy as sp

from pontryagin.rendezvous.derivation import equinoctial
from pontryagin.rendezvous.derivation.equinoctial import COSTATES, ELEMENTS, gain, price, thrust


@pytest.mark.slow
def test_the_elements_move_by_newton_s_law():
    position, velocity = equinoctial.place()
    moving = sp.Matrix([*position, *velocity]).jacobian(ELEMENTS) * equinoctial.rates()
    distance = equinoctial.parameter / equinoctial.nearness()
    law = [*velocity, *(equinoctial.axes() * thrust - position / distance**3)]
    assert [equinoctial.reduced(a - b) for a, b in zip(moving, law, strict=True)] == [0] * 6


def test_without_thrust_the_longitude_alone_moves():
    coasting = equinoctial.rates().subs(dict.fromkeys(thrust, 0))
    assert list(coasting[:5]) == [0] * 5
    assert sp.simplify(coasting[5] - equinoctial.coasting_rate()) == 0


def test_the_regularised_hamiltonian_is_the_hamiltonian_times_the_weight():
    plain = gain + price + COSTATES[-1] * equinoctial.coasting_rate()
    assert equinoctial.reduced(equinoctial.regular_hamiltonian() * equinoctial.coasting_rate() - plain) == 0
