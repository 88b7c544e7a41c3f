"""Stacks of flights: each member has the same result as if integrated alone."""

import math

import numpy as np
import pytest

from pontryagin.errors import NotConverged
from pontryagin.rendezvous.reduced.flight import (
    fly,
)
from pontryagin.rendezvous.reduced.flights import fly_all
from rendezvous_problems import FALLING, in_units, starts

KINDS = [(math.inf, False), (0.05, False), (0.05, True)]


@pytest.mark.parametrize(("peak", "bang"), KINDS)
def test_each_flight_of_a_stack_ends_as_if_integrated_alone(peak, bang):
    """There are more flights than lanes, with different durations and switches, in both charts."""
    scaled, costates = in_units().scaled, starts(19)
    durations = np.linspace(0.5, 4.0, 19)
    together = fly_all(scaled, costates, durations, peak, bang)
    plain = fly_all(scaled, costates, durations, peak, bang, slopes=False)
    assert together.reached.all() and plain.reached.all() and plain.slopes is None
    assert set(together.charts) == {1, -1}
    for i in range(19):
        alone = fly(scaled, costates[i], durations[i], peak, bang)
        assert together.switches[i] == plain.switches[i] == len(alone.pieces) - 1
        np.testing.assert_allclose(together.ends[i], alone.end, rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(plain.ends[i], alone.end, rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(together.slopes[i], alone.slopes, rtol=1e-10, atol=1e-10)
    assert bool(together.switches.any()) == (peak < math.inf and not bang)


def test_a_flight_that_fails_does_not_change_the_others():
    scaled, costates = in_units().scaled, starts(11)
    whole = fly_all(scaled, costates, 3.0)
    with pytest.raises(NotConverged):
        fly(scaled, FALLING, 5.0)
    mixed = fly_all(
        scaled, np.insert(costates, [0, 4], FALLING, axis=0), np.insert(np.full(11, 3.0), [0, 4], 5.0)
    )
    assert np.flatnonzero(~mixed.reached).tolist() == [0, 5]
    assert np.isnan(mixed.ends[[0, 5]]).all()
    np.testing.assert_allclose(mixed.ends[mixed.reached], whole.ends, rtol=1e-12, atol=1e-13)


def test_an_empty_stack_of_flights_is_empty():
    assert fly_all(in_units().scaled, np.empty((0, 6)), 1.0).ends.shape == (0, 12)
