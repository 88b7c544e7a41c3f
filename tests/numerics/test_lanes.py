"""Many trajectories at once end where single ones do, in any order, whatever the others do."""

import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose

from pontryagin.errors import NotConverged
from pontryagin.numerics.lanes import ends, stacked
from pontryagin.numerics.vector_mode import has_heyoka

x, v, k, t = sp.symbols("x v k t")
KINDS = [pytest.param(False, id="native"), *([pytest.param(True, id="heyoka")] if has_heyoka() else [])]


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
