"""K in Cartesian coordinates is as defined, and costates of R and V are those of the reduced form."""

import math

import numpy as np
import pytest

from pontryagin.numerics.complex_step import jacobian
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.laps.cartesian import Transfer, reduced_costates
from pontryagin.rendezvous.laps.hamiltonian import RunningCost
from pontryagin.rendezvous.problem.cases import cases

SCALED = cases()["inclined-30"].problem.scaled
TRANSFER = Transfer(SCALED)
PRICE, PEAK = 0.3, 0.6
COSTS = {
    "unbounded": RunningCost(0.1, 1.0, math.inf),
    "bounded": RunningCost(0.1, 1.0, PEAK),
    "least time": RunningCost(1.0, 0.0, PEAK),
}


@pytest.fixture(scope="module")
def nodes():
    return np.random.default_rng(2).standard_normal((12, 9))


def plain(cost, nodes):
    position, velocity, of_position, n = nodes.reshape(4, 3, -1)
    distance = (position**2).sum(axis=0) ** 0.5
    coasting = (of_position * velocity - n * position / distance**3).sum(axis=0)
    gain = cost.gain((n * n).sum(axis=0))[0]
    return (gain + PRICE + coasting) * distance**1.5


@pytest.mark.parametrize("cost", COSTS.values(), ids=COSTS)
def test_derivatives_are_those_of_the_definition(cost, nodes):
    found = TRANSFER.hamiltonian(cost, nodes, PRICE)
    assert found.value == pytest.approx(plain(cost, nodes), rel=1e-13)
    step = 1e-6
    for i in range(12):
        move = step * np.eye(12)[:, i : i + 1]
        change = plain(cost, nodes + move) - plain(cost, nodes - move)
        assert found.slopes[:, i] == pytest.approx(change / (2 * step), rel=1e-6, abs=1e-6)
        pair = [TRANSFER.hamiltonian(cost, nodes + sign * move, PRICE) for sign in (1, -1)]
        change = (pair[0].slopes - pair[1].slopes) / (2 * step)
        assert found.curvatures[:, i] == pytest.approx(change, rel=1e-6, abs=1e-5)
        change = (pair[0].gain - pair[1].gain) / (2 * step)
        assert found.gain_slopes[:, i] == pytest.approx(change, rel=1e-6, abs=1e-6)
    dearer = TRANSFER.hamiltonian(cost, nodes, PRICE + 1)
    assert dearer.value - found.value == pytest.approx(found.weight, rel=1e-12)
    assert dearer.slopes - found.slopes == pytest.approx(found.weight_slopes, abs=1e-11)


def test_attraction_and_its_derivatives(nodes):
    def pull(x):
        return -x / (x**2).sum(axis=0) ** 1.5

    values, slopes = jacobian(pull, nodes[:3])
    found = np.array(kernels.attraction(*nodes[:6]))
    upper = np.triu_indices(3)
    assert found[:3] == pytest.approx(values, rel=1e-13)
    assert found[3:9] == pytest.approx(slopes[upper], rel=1e-12)
    step = 1e-6
    for place, (i, j) in enumerate(zip(*upper, strict=True)):
        move = step * np.eye(3)[:, j : j + 1]
        change = [jacobian(pull, nodes[:3] + sign * move)[1][:, i] for sign in (1, -1)]
        expected = (nodes[3:6] * (change[0] - change[1])).sum(axis=0) / (2 * step)
        assert found[9 + place] == pytest.approx(expected, rel=1e-6, abs=1e-6)


def test_the_meeting_moves_by_newton_s_law():
    there, rates = TRANSFER.meeting(3.0)
    later, sooner = (TRANSFER.meeting(3.0 + shift)[0] for shift in (1e-5, -1e-5))
    assert rates == pytest.approx((later - sooner) / 2e-5, abs=1e-8)
    assert np.linalg.norm(np.cross(there[:3], there[3:])) == pytest.approx(1, rel=1e-12)
    assert TRANSFER.inclination == pytest.approx(math.radians(30), rel=1e-12)


def test_reduced_costates_give_the_same_primer():
    costates = np.random.default_rng(3).standard_normal(6)
    found = reduced_costates(SCALED, costates)
    assert kernels.primer(*SCALED.start, *found) == pytest.approx(costates, abs=1e-13)
