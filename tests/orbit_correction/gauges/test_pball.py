"""p-balls: the paper's ball at p = 2, the cube in the limit, and two bounds that agree in between."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from independent import cube, least_scale
from pontryagin import Infeasible
from pontryagin.orbit_correction import correct, printed
from pontryagin.orbit_correction.gauges.pball import fewest_power_steps, power_gauge
from pontryagin.orbit_correction.plan.thrust import Thrust
from pontryagin.orbit_correction.system.satellite import step_factors
from strategies import deviations

Z0 = np.array(printed.Z0)


states = deviations(least=1e-4)


@pytest.mark.slow
@given(states, st.sampled_from([1.5, 2.0, 8.0, 16.0]), st.integers(1, 7))
def test_controls_and_costate_prove_each_other(z0, p, steps):
    found = power_gauge(z0, steps, p)
    assert found.certificate.holds(1e-9)
    factors = step_factors(steps, 0.25)
    assert_allclose(np.einsum("kij,kj->i", factors, found.step_controls), -z0, atol=1e-13)
    sizes = (np.abs(found.step_controls / 0.0035) ** p).sum(axis=1) ** (1 / p)
    assert_allclose(sizes.max(), found.alpha, rtol=1e-12)
    q = p / (p - 1)
    along = np.abs(0.0035 * np.einsum("kij,i->kj", factors, found.costate))
    support = ((along**q).sum(axis=1) ** (1 / q)).sum()
    assert_allclose(-z0 @ found.costate / support, found.alpha, rtol=1e-9)


@pytest.mark.slow
@given(states, st.integers(1, 8))
def test_two_is_the_ball_and_the_cube_is_the_limit(z0, steps):
    ball = Thrust("ball", 0.25, 0.0035).gauges(z0[None], np.array([steps])).lower[0]
    chain = [power_gauge(z0, steps, p).alpha for p in (2, 8, 16)]
    assert_allclose(chain[0], ball, rtol=1e-9)
    limit = least_scale(0.0035 * step_factors(steps, 0.25), -z0, cube(3))
    assert np.all(np.diff([*chain, limit]) <= 1e-7 * limit)
    assert chain[2] <= 3 ** (1 / 16) * limit * (1 + 1e-7)


@pytest.mark.slow
@pytest.mark.parametrize("p", [2.0, 8.0, 16.0])
def test_the_fewest_steps_are_proved_and_never_more_than_the_ball_s(p):
    for z0 in (Z0, 3 * Z0, np.array([0.01, 0.0, 0.0])):
        found, shorter = fewest_power_steps(z0, p)
        assert found.alpha <= 1 < shorter
        assert found.steps <= correct(z0).steps and found.impulse_count >= 2
        if p == 2:
            assert found.steps == correct(z0).steps


def test_no_deviation_has_gauge_zero():
    found = power_gauge(np.zeros(3), 2, 8)
    assert found.alpha == 0 and not found.costate.any() and not found.step_controls.any()


def test_impulses_at_one_place_span_no_space():
    with pytest.raises(Infeasible, match="do not span"):
        power_gauge(Z0, 3, 8, interval=2 * np.pi)
    with pytest.raises(Infeasible, match="2000 steps"):
        fewest_power_steps(Z0, 8, interval=2 * np.pi)
    assert fewest_power_steps(Z0, 8, interval=np.pi)[0].certificate.holds(1e-9)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (([Z0, Z0], 4, 8), "z0 must be"),
        ((Z0, 0, 8), "steps must be"),
        ((Z0, 4, 1.0), "p must be a number greater than 1, got 1.0"),
        ((Z0, 4, [2.0, 3.0]), r"p must be a number greater than 1, got \[2.0, 3.0\]"),
        ((Z0, 4, np.inf), "p must be"),
        ((Z0, 4, 8, -1.0), "interval must be positive"),
    ],
)
def test_what_cannot_be_solved_is_named(arguments, words):
    with pytest.raises(ValueError, match=words):
        power_gauge(*arguments)


@pytest.mark.parametrize("steps", [2, 3, 4, 5])
def test_two_steps_take_three_impulses_and_an_odd_one_two(steps):
    count = power_gauge(Z0, steps, 2.0).impulse_count
    assert count == 3 * (steps // 2) + 2 * (steps % 2) and isinstance(count, int)


def test_every_power_above_one_is_taken_and_a_smaller_one_means_a_smaller_set():
    """The p-balls grow with p, so that the gauge falls."""
    gauges = [power_gauge(Z0, 4, p).alpha for p in (1.25, 1.5, 2.0)]
    assert np.all(np.diff(gauges) < 0)
    for wrong in (1.0, 0.5, np.nan):
        with pytest.raises(ValueError, match="p must be a number greater than 1"):
            power_gauge(Z0, 4, wrong)
