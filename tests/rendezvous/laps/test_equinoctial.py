"""Elements, longitudes and costates agree with positions, Kepler's equation and the reduced form."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.laps.equinoctial import TAU, Lap, elements_of, reduced_costates
from pontryagin.rendezvous.problem.cases import cases
from pontryagin.rendezvous.witness.cartesian import target_by_kepler

SCALED = cases()["inclined-30"].problem.scaled
small = st.floats(-0.6, 0.6)


@given(st.tuples(st.floats(0.1, 10.0), small, small, small, small, st.floats(-3.0, 3.0)))
def test_elements_of_a_place_are_those_it_was_made_of(elements):
    place = np.array(kernels.equinoctial_place(*elements))
    assert elements_of(place) == pytest.approx(elements, rel=1e-11, abs=1e-11)


def test_craft_starts_at_longitude_zero_in_the_plane_of_its_axes():
    assert Lap.of(SCALED, 0).start[3:] == pytest.approx([0, 0, 0], abs=1e-15)


@pytest.mark.parametrize("time", [0.0, 0.7, 3.0, 11.0])
@pytest.mark.parametrize("laps", [0, 2])
def test_longitude_and_elements_of_the_target_are_those_of_kepler_s_equation(time, laps):
    lap = Lap.of(SCALED, laps)
    there = elements_of(target_by_kepler(SCALED, time))
    longitude, pace = lap.longitude(time)
    assert there[:5] == pytest.approx(lap.goal, abs=1e-12)
    assert math.remainder(longitude - there[5], TAU) == pytest.approx(0, abs=1e-12)
    later, sooner = (lap.longitude(time + shift)[0] for shift in (1e-5, -1e-5))
    assert pace == pytest.approx((later - sooner) / 2e-5, rel=1e-8)


def test_longitude_grows_by_a_turn_with_each_lap():
    assert Lap.of(SCALED, 3).longitude(2.0)[0] - Lap.of(SCALED, 1).longitude(2.0)[0] == pytest.approx(2 * TAU)


def test_reduced_costates_give_the_same_switching_function():
    rng = np.random.default_rng(3)
    node = np.append(Lap.of(SCALED, 0).start, rng.standard_normal(6))
    rho, s1, e, nu1, nu2, nu3 = reduced_costates(SCALED, node)
    r, _, c = SCALED.start
    assert kernels.switching(r, c, s1, e, nu1) == pytest.approx(
        kernels.equinoctial_switching(*node), abs=1e-13
    )
    assert np.isfinite([rho, nu2, nu3]).all()
