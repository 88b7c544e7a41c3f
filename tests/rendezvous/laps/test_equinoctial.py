"""Elements, longitudes and costates agree with positions, Kepler's equation and the reduced form."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.laps.equinoctial import TAU, Lap, axes_between, elements_of, reduced_costates, seen
from pontryagin.rendezvous.problem.cases import cases
from pontryagin.rendezvous.witness.cartesian import target_by_kepler

SCALED = cases()["inclined-30"].problem.scaled
small = st.floats(-0.6, 0.6)


@given(st.tuples(st.floats(0.1, 10.0), small, small, small, small, st.floats(-3.0, 3.0)))
def test_elements_of_a_place_are_those_it_was_made_of(elements):
    place = np.array(kernels.equinoctial_place(*elements))
    assert elements_of(place) == pytest.approx(elements, rel=1e-11, abs=1e-11)


@given(*[st.tuples(*[st.floats(-1, 1)] * 6)] * 2)
def test_axes_lie_between_the_planes(one, other):
    craft, target = np.array(one), np.array(other)
    normals = [np.cross(state[:3], state[3:]) for state in (craft, target)]
    assume(min(map(np.linalg.norm, normals)) > 0.1)
    axes = axes_between(craft, target)
    assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-14) and np.linalg.det(axes) > 0
    first, second = (axes[2] @ normal / np.linalg.norm(normal) for normal in normals)
    assert first == pytest.approx(second, abs=1e-9) and first > -1e-9
    assert math.remainder(elements_of(seen(axes, craft))[5], TAU) == pytest.approx(0, abs=1e-12)


def test_axes_between_opposite_senses_are_perpendicular_to_both():
    craft, target = np.array([1.0, 0, 0, 0, 1, 0]), np.array([0.0, 1.2, 0, 0.9, 0, 0])
    axes = axes_between(craft, target)
    assert axes[2] @ [0, 0, 1] == pytest.approx(0, abs=1e-15)
    elements = [elements_of(seen(axes, state)) for state in (craft, target)]
    assert [np.hypot(*each[3:5]) for each in elements] == pytest.approx([1, 1], rel=1e-14)


@pytest.mark.parametrize("time", [0.0, 0.7, 3.0, 11.0])
@pytest.mark.parametrize("laps", [0, 2])
def test_longitude_and_elements_of_the_target_are_those_of_kepler_s_equation(time, laps):
    lap = Lap.of(SCALED, laps)
    there = elements_of(seen(lap.axes, target_by_kepler(SCALED, time)))
    longitude, pace = lap.longitude(time)
    assert there[:5] == pytest.approx(lap.goal, abs=1e-12)
    assert math.remainder(longitude - there[5], TAU) == pytest.approx(0, abs=1e-12)
    later, sooner = (lap.longitude(time + shift)[0] for shift in (1e-5, -1e-5))
    assert pace == pytest.approx((later - sooner) / 2e-5, rel=1e-8)


def test_longitude_grows_by_a_turn_with_each_lap():
    assert Lap.of(SCALED, 3).longitude(2.0)[0] - Lap.of(SCALED, 1).longitude(2.0)[0] == pytest.approx(2 * TAU)


def test_reduced_costates_give_the_same_switching_function():
    rng = np.random.default_rng(3)
    lap = Lap.of(SCALED, 0)
    node = np.append(lap.start, rng.standard_normal(6))
    rho, s1, e, nu1, nu2, nu3 = reduced_costates(SCALED, lap.axes, node)
    r, _, c = SCALED.start
    assert kernels.switching(r, c, s1, e, nu1) == pytest.approx(
        kernels.equinoctial_switching(*node), abs=1e-13
    )
    assert np.isfinite([rho, nu2, nu3]).all()
