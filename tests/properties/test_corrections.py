"""Invariances of gauges and corrections: size, sign, sums, coordinates, revolutions, reversed time."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from pontryagin.orbit_correction import DiscreteSystem, correct, gauge
from pontryagin.orbit_correction.plan.thrust import THRUSTS, Thrust
from pontryagin.orbit_correction.system.satellite import transition
from strategies import deviations, systems

MIRROR = np.diag([1.0, -1.0, 1.0])
"""Reversal of time turns the radial speed round."""
intervals = st.floats(0.1, 3.0)
thrusts = st.sampled_from(THRUSTS)
powers = st.integers(-30, 30).map(lambda k: 2.0**k)


def share(name, interval, z0, steps):
    """The gauge of a deviation for a peak of 1."""
    return float(Thrust(name, interval, 1.0).gauges(np.asarray(z0)[None], np.array([steps])).upper[0])


@given(systems(), powers, st.sampled_from([-1, 1]))
def test_a_gauge_is_homogeneous_and_symmetric(drawn, factor, sign):
    system, x0, steps = drawn
    base, scaled = gauge(system, x0, steps), gauge(system, sign * factor * x0, steps)
    assert scaled.alpha == base.alpha * factor
    assert_array_equal(scaled.costate, sign * base.costate)


@given(systems(), st.integers(0, 1000))
def test_a_gauge_is_subadditive(drawn, seed):
    system, x0, steps = drawn
    other = np.random.default_rng(seed).normal(size=len(x0))
    first, second, both = (float(gauge(system, x, steps).alpha) for x in (x0, other, x0 + other))
    assert both <= (first + second) * (1 + 1e-9)


@given(systems(), st.integers(0, 1000))
def test_a_gauge_does_not_depend_on_coordinates(drawn, seed):
    """x -> M x turns A into M A M^-1 and H into M^-T H M^-1; the costate becomes one along M^-T psi."""
    system, x0, steps = drawn
    n = len(x0)
    left, right = (np.linalg.qr(m)[0] for m in np.random.default_rng(seed).normal(size=(2, n, n)))
    M = left * np.linspace(0.5, 2.0, n) @ right
    back = np.linalg.inv(M)
    H = back.T @ np.asarray(system.H) @ back
    changed = DiscreteSystem(M @ np.asarray(system.A) @ back, (H + H.swapaxes(1, 2)) / 2)
    base, found = gauge(system, x0, steps), gauge(changed, M @ x0, steps)
    assert_allclose(found.alpha, base.alpha, rtol=1e-8)
    along = back.T @ base.costate
    assert_allclose(found.costate, along / np.linalg.norm(along), atol=1e-4)


@given(systems(), powers)
def test_a_gauge_scales_with_the_ellipsoids(drawn, factor):
    system, x0, steps = drawn
    wider = DiscreteSystem(system.A, np.asarray(system.H) / factor**2)
    assert_allclose(gauge(wider, x0, steps).alpha * factor, gauge(system, x0, steps).alpha, rtol=1e-9)


@given(systems(), st.integers(0, 1000))
def test_a_stack_of_mixed_sizes_has_the_gauges_of_its_members(drawn, seed):
    system, x0, steps = drawn
    generator = np.random.default_rng(seed)
    sizes = 10.0 ** generator.uniform(-100, 100, (5, 1))
    states = np.vstack([generator.normal(size=(5, len(x0))) * sizes, np.zeros(len(x0))])
    together = gauge(system, states, steps)
    for i, state in enumerate(states):
        alone = gauge(system, state, steps)
        assert_allclose(together.alpha[i], alone.alpha, rtol=1e-11)
        assert_allclose(together.costate[i], alone.costate, atol=1e-6)


@given(deviations(least=1e-5), deviations(least=1e-5), intervals, thrusts, st.integers(2, 10))
def test_the_share_of_a_sum_is_at_most_the_sum_of_shares(first, second, interval, name, steps):
    a, b, both = (share(name, interval, z, steps) for z in (first, second, first + second))
    assert both <= (a + b) * (1 + 1e-9)


@given(deviations(least=1e-5), intervals, thrusts, powers, st.sampled_from([-1, 1]))
def test_a_plan_scales_with_the_state_and_the_peak(z0, interval, name, factor, sign):
    base = correct(z0, interval, 0.0035, name)
    scaled = correct(sign * factor * z0, interval, 0.0035 * factor, name)
    assert scaled.steps == base.steps
    assert_allclose(scaled.gauge, base.gauge, rtol=1e-9)
    assert_allclose(scaled.impulses, sign * factor * base.impulses, atol=1e-7 * 0.0035 * factor)


@given(deviations(least=1e-5), intervals, thrusts, st.integers(2, 10), st.integers(1, 3))
def test_whole_revolutions_between_impulses_change_nothing(z0, interval, name, steps, turns):
    assert_allclose(
        share(name, interval + turns * 2 * np.pi, z0, steps), share(name, interval, z0, steps), rtol=1e-8
    )


@given(deviations(least=1e-5), intervals, thrusts, st.integers(2, 10))
def test_what_a_revolution_less_the_interval_does_is_done_in_reversed_time(z0, interval, name, steps):
    assert_allclose(
        share(name, 2 * np.pi - interval, z0, steps), share(name, interval, MIRROR @ z0, steps), rtol=1e-8
    )


@pytest.mark.parametrize("name", ["disc", "box"])
@given(deviations(least=1e-5), intervals, st.integers(2, 10))
def test_the_way_back_needs_the_same_share(name, z0, interval, steps):
    """In reversed time the impulses lead from the circle to where the deviation is at the last of them."""
    last = MIRROR @ transition((steps - 1) * interval) @ z0
    assume(np.abs(last).max() > 1e-6)
    assert_allclose(share(name, interval, last, steps), share(name, interval, z0, steps), rtol=1e-8)


@given(deviations(least=1e-4), intervals, thrusts)
def test_what_is_left_on_the_way_needs_the_same_share(z0, interval, name):
    """Corollary 1: after two steps, a period of the ball's system, the state has the gauge of the plan."""
    plan = correct(z0, interval, 0.0035, name)
    assume(plan.steps >= 4 and np.abs(plan.states[2]).max() > 1e-6)
    left = share(name, interval, plan.states[2] / 0.0035, int(plan.steps) - 2)
    assert left <= float(plan.gauge) * (1 + 1e-9)
