"""Many trajectories at once end where single ones do, in any order, whatever the others do."""

import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose

from pontryagin.errors import NotConverged
from pontryagin.numerics.equations import Kernel
from pontryagin.numerics.flow import has_heyoka, integrator
from pontryagin.numerics.lanes import Lanes, ends, stacked
from pontryagin.numerics.symbolic import Symbolic

x, v, k, t = sp.symbols("x v k t")
KINDS = [pytest.param(False, id="DOP853"), *([pytest.param(True, id="heyoka")] if has_heyoka() else [])]
HEYOKA = pytest.mark.skipif(not has_heyoka(), reason="heyoka is not installed")
COUNT = 13
"""More trajectories than a processor has lanes, and no multiple of them."""
ENOUGH = np.full(COUNT, 10_000)


def pendulums():
    """Driven pendulums with their derivatives, and starts, beginnings, ends and frequencies of many."""
    system = Symbolic((x, v), (v, -k * sp.sin(x) + sp.cos(t)), (k,), t, (x, v))
    rng = np.random.default_rng(5)
    begin, span = rng.uniform(-2, 2, COUNT), rng.uniform(-6, 6, COUNT)
    return system, rng.standard_normal((COUNT, 2)), begin, begin + span, rng.uniform(0.5, 2.0, (COUNT, 1))


@HEYOKA
def test_lanes_end_where_single_trajectories_end():
    system, starts, begin, end, rate = pendulums()
    found = Lanes(system).carry(starts, begin, end, rate, ENOUGH)
    single = integrator(system, True)
    for i in range(COUNT):
        whole = np.append(starts[i], system.identity)
        reached = single.run(whole, begin[i], end[i], rate[i])
        assert_allclose(found.states[i], reached.whole[:2], rtol=0, atol=1e-12)
        assert_allclose(found.slopes[i].ravel(), reached.whole[2:], rtol=0, atol=1e-11)
    assert not found.left.any() and not found.switches.any()


@HEYOKA
def test_the_order_of_the_trajectories_does_not_matter():
    system, *given = pendulums()
    shuffled = np.random.default_rng(6).permutation(COUNT)
    found, again = (
        Lanes(system).carry(*(rows[order] for rows in given), ENOUGH)
        for order in (np.arange(COUNT), shuffled)
    )
    assert_allclose(again.states, found.states[shuffled], rtol=0, atol=1e-13)
    assert_allclose(again.slopes, found.slopes[shuffled], rtol=0, atol=1e-12)


@HEYOKA
def test_a_lane_that_fails_does_not_harm_the_others():
    """x' = x^2 has x = x0/(1 - x0 t) with the derivative 1/(1 - x0 t)^2, and blows up at t = 1/x0."""
    starts = np.linspace(-1.5, 2.0, COUNT)
    lanes = Lanes(Symbolic((x,), (x**2,), wrt=(x,)))
    zeros, ones, steps = np.zeros(COUNT), np.ones(COUNT), ENOUGH.copy()
    short = 2
    steps[short] = 1
    with np.errstate(all="ignore"):
        found = lanes.carry(starts[:, None], zeros, ones, np.empty((COUNT, 0)), steps)
    reached = starts < 1
    reached[short] = False
    left = 1 / (1 - starts[reached])
    assert_allclose(found.states[reached, 0], starts[reached] * left, rtol=1e-12)
    assert_allclose(found.slopes[reached, 0, 0], left**2, rtol=1e-11)
    assert ((found.left == 0) == reached).all()
    assert np.isnan(found.states[~reached]).all() and np.isnan(found.slopes[~reached]).all()


@HEYOKA
def test_lanes_switch_each_in_its_own_time():
    """Ramps x' = u of different slopes side by side; each changes u to -u at x = 1."""
    turning = Kernel(("x",), lambda of, t, z, p: [p[0] + 0.0 * z[0]], 1, (0,), (one_passed,), 1e-14)
    slopes = np.linspace(0.5, 3.0, 11)
    ends = np.linspace(3.0, 1.0, 11)
    found = Lanes(turning).carry(
        np.zeros((11, 1)), np.zeros(11), ends, slopes[:, None], np.full(11, 1000), lambda _, p: -p, 5
    )
    turned = slopes * ends > 1
    assert_allclose(found.states[:, 0], np.where(turned, 2 - slopes * ends, slopes * ends), atol=1e-12)
    assert found.switches.tolist() == turned.astype(int).tolist()
    assert (found.left == 0).all() and (found.slopes == 1).all()


def one_passed(of, t, z, p):
    return z[0] - 1.0


@HEYOKA
def test_each_lane_has_its_own_events_and_its_own_limit_of_them():
    """x'' = -u with u the sign of x, from rest at x0: u changes at the odd multiples of sqrt(2 x0)."""
    relay = Kernel(("x", "v"), lambda of, t, z, p: [z[1], 0.0 * z[1] - p[0]], 1, (), (beyond_zero,), 1e-14)
    quarter, end, most = np.geomspace(0.3, 20.0, COUNT), 10.0, 12
    starts = np.stack([quarter**2 / 2, np.zeros(COUNT)], axis=1)
    found = Lanes(relay).carry(
        starts, np.zeros(COUNT), np.full(COUNT, end), np.ones((COUNT, 1)), ENOUGH, lambda _, p: -p, most
    )
    switches = np.floor((end / quarter + 1) / 2)
    given_up = switches > most
    assert found.switches.tolist() == np.minimum(switches, most).tolist()
    assert given_up.any() and not given_up.all() and ((found.left > 0) == given_up).all()
    since = (end + quarter) - 2 * quarter * switches - quarter
    sign = (-1.0) ** switches
    expected = np.stack([sign * (quarter**2 - since**2) / 2, -sign * since], axis=1)
    assert_allclose(found.states[~given_up], expected[~given_up], rtol=0, atol=1e-11)
    assert np.isnan(found.states[given_up]).all()


def beyond_zero(of, t, z, p):
    return -p[0] * z[0]


def test_what_is_given_once_is_given_to_every_trajectory():
    starts, begin, end, values = stacked([[1.0, 0.0], [2.0, 0.0]], 0.0, [1.0, 2.0], [3.0], 1)
    assert starts.shape == (2, 2) and begin.tolist() == [0.0, 0.0] and end.tolist() == [1.0, 2.0]
    assert values.tolist() == [[3.0], [3.0]]


@pytest.mark.parametrize("taylor", KINDS)
def test_many_trajectories_reach_the_ends_of_their_own_spans(taylor):
    carry = ends([x, v], [v, -(k**2) * x + sp.sin(t)], [k], clock=t, wrt=[x, v], taylor=taylor)
    rng = np.random.default_rng(3)
    count = 11
    starts, rate = rng.standard_normal((count, 2)), rng.uniform(1.5, 3.0, count)
    begin, span = rng.uniform(-2, 2, count), rng.uniform(-5, 5, count)
    states, slopes = carry(starts, begin, begin + span, rate[:, None])
    c, s = np.cos(rate * span), np.sin(rate * span)
    free = np.array([[c, s / rate], [-rate * s, c]]).transpose(2, 0, 1)

    def forced(time):
        return np.array([np.sin(time), np.cos(time)]).T / (rate**2 - 1)[:, None]

    expected = (free @ (starts - forced(begin))[..., None])[..., 0] + forced(begin + span)
    assert_allclose(slopes, free, atol=1e-11)
    assert_allclose(states, expected, atol=1e-11)


@pytest.mark.parametrize("taylor", KINDS)
def test_derivatives_of_a_nonlinear_flow_are_those_of_its_ends(taylor):
    carry = ends([x, v], [v, -k * sp.sin(x) + sp.cos(t)], [k], clock=t, wrt=[v], taylor=taylor)
    plain = ends([x, v], [v, -k * sp.sin(x) + sp.cos(t)], [k], clock=t, taylor=taylor)
    start, step = np.array([1.0, 0.3]), 1e-5
    _, slopes = carry([start], 0.0, 6.0, [1.3])
    (above, below), empty = plain([start + np.array([0, step]), start - np.array([0, step])], 0.0, 6.0, [1.3])
    assert_allclose(slopes[0, :, 0], (above - below) / (2 * step), rtol=0, atol=2e-8)
    assert empty.shape == (2, 2, 0)


@pytest.mark.parametrize("taylor", KINDS)
def test_a_flow_that_ends_in_a_singularity_is_not_handed_out(taylor):
    with np.errstate(all="ignore"), pytest.raises(NotConverged):
        ends([x], [x**2], taylor=taylor)([[1.0]], 0.0, 2.0)


@pytest.mark.parametrize("taylor", KINDS)
def test_fractions_are_taken_as_they_are(taylor):
    grow = ends([x], [x * sp.Rational(1, 3) * k], [k], taylor=taylor)
    assert_allclose(grow([[1.0]], 0.0, 3.0, [2.0])[0], [[np.exp(2.0)]], rtol=1e-13)
