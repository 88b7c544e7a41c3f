"""Gauges in very many steps: closed forms, the compiled kernel's answers, stacks, evaluations of matrices."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pontryagin.orbit_correction import DiscreteSystem, gauge
from pontryagin.orbit_correction.gauges.ellipsoids import gauge_stack
from pontryagin.orbit_correction.gauges.general import LONG, gauge_of_factors
from pontryagin.orbit_correction.gauges.long_sums import gauge_rows

STEPS = 100_000


def growing(steps):
    """Matrices A(k) whose products up to k are k + 2 times a rotation, (steps, 3, 3)."""
    k = np.arange(steps)
    first, second = k % 3, (k + 1) % 3
    turns = np.tile(np.eye(3), (steps, 1, 1))
    turns[k, first, first] = turns[k, second, second] = np.cos(k)
    turns[k, second, first] = np.sin(k)
    turns[k, first, second] = -np.sin(k)
    return turns * ((k + 2) / (k + 1))[:, None, None]


def test_balls_in_100000_steps_have_a_closed_form():
    """X(N, 0) is a ball; its radius is the sum of 1/(k + 2)."""
    found = gauge(DiscreteSystem(growing(STEPS), np.eye(3)), [[1.0, -2.0, 2.0], [0.0, 0.0, 0.0]], STEPS)
    assert_allclose(found.alpha, [3 / (1 / np.arange(2.0, STEPS + 2)).sum(), 0], rtol=1e-12)
    assert_allclose(found.costate, [[-1 / 3, 2 / 3, -2 / 3], [0, 0, 0]], rtol=0, atol=1e-10)
    assert found.certificate.holds(1e-12)


def test_ellipsoids_with_common_axes_in_100000_steps_have_a_closed_form_along_them():
    k = np.arange(1.0, STEPS + 1)
    semiaxes = np.stack([1 + 1 / k, 0.1 + np.sin(k) ** 2, 1 / np.sqrt(k)], axis=1)
    shapes = np.eye(3) / semiaxes[:, None] ** 2
    found = gauge(DiscreteSystem(np.diag([-1.0, 1.0, 1.0]), shapes), 7 * np.eye(3), STEPS)
    assert_allclose(found.alpha, 7 / semiaxes.sum(axis=0), rtol=1e-12)
    assert_allclose(found.costate, -np.eye(3), rtol=0, atol=1e-10)
    assert found.certificate.holds(1e-12)


@pytest.mark.parametrize("semiaxes", [[1.0, 1.0, 1.0], [1.0, 1e-2, 0.0], [1.0, 1e-5, 1e-6]])
@pytest.mark.parametrize("steps", [4, 300])
def test_sweeps_by_numpy_agree_with_the_kernel(semiaxes, steps):
    """The needles need the continuation, the flat ones have a kink wherever psi is orthogonal to them."""
    generator = np.random.default_rng(121)
    turns = [np.linalg.qr(generator.normal(size=(3, 3)))[0] for _ in range(steps)]
    factors = np.array([turn * semiaxes for turn in turns])
    root = np.linalg.cholesky(np.einsum("kij,klj->il", factors, factors))
    factors, targets = np.ascontiguousarray(np.linalg.solve(root, factors)), generator.normal(size=(3, 3))
    targets[1] = 0.0
    answers = []
    for run in (gauge_stack, gauge_rows):
        costates, results = np.empty((3, 3)), np.empty((3, 3))
        run(factors, targets, costates, results)
        assert (results[:, 2] <= 1e-12).all()
        answers.append((results[:, :2], costates))
    for by_kernel, by_numpy in zip(*answers, strict=True):
        assert_allclose(by_numpy, by_kernel, rtol=1e-8, atol=1e-9)
        assert not by_numpy[1].any()
    gaps = [1 - bounds[[0, 2], 0] / bounds[[0, 2], 1] for bounds, _ in answers]
    assert (gaps[1] <= np.maximum(2 * gaps[0], 1e-11)).all()


def test_long_stacks_are_their_members():
    system = DiscreteSystem(growing(LONG), lambda k: np.diag([1.0, 2 + np.sin(k), 3.0]))
    states = np.random.default_rng(0).normal(size=(2, 3, 3))
    together = gauge(system, states, LONG)
    for place in np.ndindex(2, 3):
        single = gauge(system, states[place], LONG)
        assert_allclose(together.alpha[place], single.alpha, rtol=1e-13)
        assert_allclose(together.costate[place], single.costate, rtol=0, atol=1e-11)


def test_short_and_long_sums_meet():
    """Steps without controls change nothing but the method."""
    factors = np.random.default_rng(1).normal(size=(LONG - 1, 3, 3))
    padded = np.concatenate([factors, np.zeros((2, 3, 3))])
    short, long = (gauge_of_factors(some, np.array([1.0, 2.0, 3.0])) for some in (factors, padded))
    assert_allclose(long.alpha, short.alpha, rtol=1e-13)
    assert_allclose(long.costate, short.costate, rtol=1e-12)


def test_callables_are_evaluated_once_in_the_order_of_the_steps():
    calls = []

    def matrix(name):
        def evaluate(k):
            calls.append((name, k))
            return (1 + k) * np.eye(2)

        return evaluate

    system = DiscreteSystem(matrix("A"), matrix("H"))
    for steps in (3, 2, 5):
        gauge(system, [1.0, 2.0], steps)
    assert calls == [(name, k) for k in range(5) for name in "AH"]


@pytest.mark.parametrize(
    ("A", "H", "message"),
    [
        (lambda k: np.diag([1.0, float(k != 7)]), np.eye(2), r"A\(7\) must be nonsingular"),
        (np.eye(2), lambda k: np.diag([1.0, 8.0 - k]), r"H\(8\) must be positive definite"),
        (np.eye(2), lambda k: [[1, 0.1 * (k > 5)], [0, 1]], r"H\(6\) must be symmetric, .* by 0\.1"),
        (np.eye(2), lambda k: [[1, 0], [0, np.nan if k == 4 else 1]], r"H\(4\) must be .* finite, got nan"),
        (np.eye(2), np.ones((9, 2, 2)) + np.eye(2), "H must hold a matrix for step 9, got 9 matrices"),
    ],
)
def test_the_first_step_at_fault_is_named(A, H, message):
    system = DiscreteSystem(A, H)
    gauge(system, [1.0, 2.0], 3)
    with pytest.raises(ValueError, match=message):
        gauge(system, [1.0, 2.0], 20)
