"""The gauges of ball, disc and box (Lemma 7, Lemma 9): their two bounds, and linear programmes."""

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from independent import cube, least_scale
from pontryagin.numerics import jit
from pontryagin.orbit_correction.gauges.zonotope import turning_place
from pontryagin.orbit_correction.plan.thrust import THRUSTS, Thrust
from strategies import deviations

INTERVALS = (0.25, 1.0, np.pi / 2, np.pi, 4.0)


states = deviations(least=1e-5)


@given(states, st.sampled_from(INTERVALS), st.integers(2, 12), st.sampled_from(THRUSTS))
def test_controls_and_costate_agree_from_both_sides(z0, interval, steps, name):
    thrust = Thrust(name, interval, 0.0035)
    found = thrust.gauges(z0[None], np.array([steps]))
    factors = thrust.factors(steps)
    reached = np.einsum("kij,kj->i", factors, found.controls[0])
    assert_allclose(reached, -z0, atol=1e-13)
    sizes = np.abs(found.controls[0]) if name == "box" else np.linalg.norm(found.controls[0], axis=1)
    assert_allclose(sizes.max(), found.upper[0], rtol=1e-12)
    along = np.einsum("kij,i->kj", factors, found.costates[0])
    support = np.abs(along).sum() if name == "box" else np.linalg.norm(along, axis=1).sum()
    assert_allclose(found.lower[0], -z0 @ found.costates[0] / support, rtol=1e-12)
    assert_allclose(found.upper[0], found.lower[0], rtol=5e-12)


@given(states, st.sampled_from(INTERVALS), st.integers(2, 9))
def test_the_box_is_the_linear_programme(z0, interval, steps):
    thrust = Thrust("box", interval, 0.0035)
    by_highs = least_scale(thrust.factors(steps), -z0, cube(2))
    assert_allclose(thrust.gauges(z0[None], np.array([steps])).upper[0], by_highs, rtol=1e-8)


@given(states, st.sampled_from(INTERVALS), st.integers(2, 6))
def test_the_disc_lies_between_its_polygons(z0, interval, steps):
    thrust = Thrust("disc", interval, 0.0035)
    angles = np.arange(96) * 2 * np.pi / 96
    around = np.column_stack([np.cos(angles), np.sin(angles)])
    outer = least_scale(thrust.factors(steps), -z0, around)
    found = thrust.gauges(z0[None], np.array([steps])).upper[0]
    assert outer * (1 - 1e-8) <= found <= outer / np.cos(np.pi / 96) * (1 + 1e-8)


@given(states, st.sampled_from(THRUSTS))
def test_the_gauge_falls_with_the_number_of_steps_and_scales_with_the_state(z0, name):
    thrust = Thrust(name, 0.25, 0.0035)
    counts = np.arange(2, 20)
    rows = np.broadcast_to(z0, (len(counts), 3))
    alpha = thrust.gauges(rows, counts).lower
    assert (np.diff(alpha) < 0).all()
    assert_allclose(thrust.gauges(-3 * rows, counts).lower, 3 * alpha, rtol=1e-11)


@pytest.mark.parametrize("name", THRUSTS)
def test_compiled_and_plain_kernels_agree(name, monkeypatch):
    generator = np.random.default_rng(5)
    rows = generator.normal(size=(40, 3)) * 0.01
    thrust = Thrust(name, 0.25, 0.0035)
    together = thrust.gauges(rows, np.full(40, 7))
    served = [thrust.gauges(row[None], np.array([7])).upper[0] for row in rows]
    assert served == together.upper.tolist()
    monkeypatch.setattr(jit, "_COMPILED", {})
    alone = [thrust.gauges(row[None], np.array([7])).upper[0] for row in rows]
    assert not jit._COMPILED
    assert_allclose(together.upper, alone, rtol=1e-12)


@given(
    st.lists(st.tuples(st.integers(0, 6), st.integers(1, 5)), min_size=1, max_size=40), st.integers(-120, 0)
)
def test_the_selection_stops_where_the_sorted_slopes_turn(pieces, slope):
    """Whole numbers give many ties, and their sums are exact in any order."""
    times, rates = (np.array(column, float) for column in zip(*pieces, strict=True))
    order = np.argsort(times, kind="stable")
    stops = np.flatnonzero(slope + 2 * np.cumsum(rates[order]) >= 0)
    crossed = np.arange(len(pieces))
    place = turning_place(times, rates, crossed, len(pieces), float(slope))
    assert sorted(crossed) == list(range(len(pieces)))
    if not stops.size:
        assert place == -1
        return
    assert times[crossed[place]] == times[order[stops[0]]]
    before = slope + 2 * rates[crossed[:place]].sum()
    assert before < 0 or place == 0
    assert before + 2 * rates[crossed[place]] >= 0
    assert (times[crossed[:place]] <= times[crossed[place]]).all()
    assert (times[crossed[place:]] >= times[crossed[place]]).all()


def test_an_interval_is_whole_revolutions_within_a_billionth_of_a_radian():
    """Ten million radians: neighbouring floating numbers are 1.9e-9 apart, and 2 pi is taken in 40 digits."""
    seen = set()
    with mp.workdps(40):
        for count in range(1_600_000, 1_600_040):
            nearest = float(2 * mp.pi * count)
            for interval in (nearest, np.nextafter(nearest, 0), np.nextafter(nearest, np.inf)):
                away = abs(mp.mpf(float(interval)) - 2 * mp.pi * count)
                if away < 0.9e-9 or 1.1e-9 < away < 1.9e-9:
                    seen.add(away < 1e-9)
                    assert Thrust("ball", float(interval), 0.0035).whole_revolutions == (away < 1e-9)
    assert seen == {True, False}
