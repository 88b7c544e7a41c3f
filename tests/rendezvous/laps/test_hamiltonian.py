"""K is (S + c) dt/ds + l_L, and its derivatives are those of this function, for each kind of thrust."""

import math

import numpy as np
import pytest

from pontryagin.numerics.complex_step import jacobian
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.laps.hamiltonian import RunningCost, at_nodes, hamiltonian

PRICE, PEAK = 0.3, 1.1
COSTS = {
    "unbounded": RunningCost(0.1, 1.0, math.inf),
    "bounded": RunningCost(0.1, 1.0, PEAK),
    "least time": RunningCost(1.0, 0.0, PEAK),
}


@pytest.fixture(scope="module")
def nodes():
    random = np.random.default_rng(4)
    elements = [[1.2], [0.1], [0.2], [0.3], [-0.2], [2.0]] + 0.1 * random.standard_normal((6, 9))
    return np.vstack([elements, random.standard_normal((6, 9))])


def gain(cost, square):
    """S by its definition: the largest p |n| - alpha2 p^2 over 0 <= p <= p_max."""
    if cost.energy_weight == 0:
        return cost.peak * np.sqrt(square)
    best = np.sqrt(square) / (2 * cost.energy_weight)
    used = np.where(best.real < cost.peak, best, cost.peak)
    return used * np.sqrt(square) - cost.energy_weight * used**2


def plain(cost, nodes):
    n = np.array(kernels.equinoctial_switching(*nodes))
    weight = kernels.equinoctial_weight(*nodes[:3], nodes[5])
    return (gain(cost, (n * n).sum(axis=0)) + PRICE) * weight + nodes[11]


@pytest.mark.parametrize("cost", COSTS.values(), ids=COSTS)
def test_value_and_slopes(cost, nodes):
    value, slopes = jacobian(lambda x: plain(cost, x)[None], nodes)
    found = hamiltonian(cost, nodes, PRICE)
    assert found.value == pytest.approx(value[0], rel=1e-13)
    assert found.slopes == pytest.approx(slopes[0].T, rel=1e-11, abs=1e-12)
    by_price = (hamiltonian(cost, nodes, PRICE + 1).slopes - found.slopes, found.weight_slopes)
    assert by_price[0] == pytest.approx(by_price[1], rel=1e-11, abs=1e-11)


@pytest.mark.parametrize("cost", COSTS.values(), ids=COSTS)
def test_curvatures_are_the_slopes_of_the_slopes(cost, nodes):
    step, found = 1e-6, hamiltonian(cost, nodes, PRICE)
    for i in range(12):
        move = step * np.eye(12)[:, i : i + 1]
        change = hamiltonian(cost, nodes + move, PRICE).slopes - hamiltonian(cost, nodes - move, PRICE).slopes
        assert found.curvatures[:, i] == pytest.approx(change / (2 * step), rel=1e-6, abs=1e-6)


def test_thrust_of_both_kinds_was_tried(nodes):
    n = np.linalg.norm(kernels.equinoctial_switching(*nodes), axis=0)
    assert (n < 2 * PEAK).any() and (n > 2 * PEAK).any()


@pytest.mark.slow
def test_native_code_computes_what_the_plain_source_does(nodes):
    expected = np.array([at_nodes.kernel(*column) for column in nodes.T])
    assert at_nodes._start()
    np.testing.assert_allclose(at_nodes(*nodes), expected, rtol=1e-13, atol=1e-13)
