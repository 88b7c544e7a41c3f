"""Gauges of general systems (Lemma 7, Lemma 9): dimensions, sizes, nearly flat sets, invalid arguments."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from independent import cube, least_scale
from pontryagin import Infeasible, NotConverged
from pontryagin.certificate import Certificate
from pontryagin.orbit_correction import DiscreteSystem, gauge
from pontryagin.orbit_correction.gauges.general import gauge_of_factors
from pontryagin.orbit_correction.gauges.proof import require_closed
from strategies import random_system

PLANE = np.eye(2)


@given(st.integers(0, 10_000), st.integers(1, 6), st.integers(1, 8), st.integers(0, 5))
def test_controls_and_costate_meet_in_every_dimension(seed, n, steps, decades):
    A, H, x0 = random_system(seed, n, steps, decades)
    found = gauge(DiscreteSystem(A, H), x0, steps)
    proof = found.certificate
    assert proof.primal_residual <= 1e-12
    assert_allclose(proof.primal_value, proof.dual_value, rtol=1e-9)
    state, bound, carried = x0, 0.0, found.costate
    for k in range(steps):
        carried = np.linalg.solve(A[k].T, carried)
        bound += np.sqrt(carried @ np.linalg.solve(H[k], carried))
        state = A[k] @ state
    assert_allclose(-x0 @ found.costate / bound, found.alpha, rtol=1e-7)


@pytest.mark.parametrize("seed", [121, 1355])
def test_needles_are_solved_where_newtons_method_alone_stalls(seed):
    generator = np.random.default_rng(seed)
    turns = [np.linalg.qr(generator.normal(size=(3, 3)))[0] for _ in range(4)]
    factors = np.array([turn * [1.0, 1e-5, 1e-6] for turn in turns])
    assert gauge_of_factors(factors, generator.normal(size=(50, 3))).certificate.holds(1e-8)


@given(st.integers(0, 10_000), st.integers(2, 4))
def test_the_gauge_in_boxes_drawn_round_the_ellipsoids_is_a_linear_programme(seed, n):
    """An ellipsoid lies between the box and the cross-polytope of its axes, whose gauges HiGHS finds."""
    A, H, x0 = random_system(seed, n, 4, 1)
    system = DiscreteSystem(A, H)
    corners = np.array(list(product([-1, 1], repeat=n)))
    low, high = (least_scale(system.factors(4), -x0, normals) for normals in (cube(n), corners))
    assert low * (1 - 1e-7) <= gauge(system, x0, 4).alpha <= high * (1 + 1e-7)


@pytest.mark.parametrize("size", [1e-300, 1e-160, 1e80, 1e300])
def test_states_of_any_size(size):
    found = gauge(DiscreteSystem(PLANE, PLANE), [3 * size, 4 * size], 10)
    assert_allclose(found.alpha / size, 0.5, rtol=1e-12)
    assert_allclose(found.costate, [-0.6, -0.8], rtol=1e-12)


@pytest.mark.parametrize("scale", [1e-300, 1e-200, 1e200, 1e300])
def test_ellipsoids_of_any_size(scale):
    found = gauge(DiscreteSystem(PLANE, scale * PLANE), [3.0, 4.0], 10)
    assert_allclose(found.alpha / np.sqrt(scale), 0.5, rtol=1e-12)
    assert_allclose(found.costate, [-0.6, -0.8], rtol=1e-12)


def test_steps_that_hardly_count_do_not_spoil_the_proof():
    found = gauge(DiscreteSystem(1e3 * PLANE, PLANE), [3.0, 4.0], 200)
    assert_allclose(found.alpha, 5 * 999.0, rtol=1e-12)
    found = gauge(DiscreteSystem(np.diag([2.0, 0.5]), PLANE), [0.5, 0.5], 600)
    assert_allclose(found.alpha, 0.5, rtol=1e-12)


def test_zero_states_and_empty_stacks_have_answers():
    system = DiscreteSystem(PLANE, PLANE)
    mixed = gauge(system, [[0.0, 0.0], [3.0, 4.0]], 5)
    assert_allclose(mixed.alpha, [0, 1], rtol=1e-12)
    assert mixed.costate[0].tolist() == [0, 0]
    assert gauge(system, np.zeros((2, 0, 2)), 5).costate.shape == (2, 0, 2)


def test_sequences_arrays_and_callables_are_one():
    A, H, x0 = random_system(3, 3, 4, 1)
    expected = gauge(DiscreteSystem(A, H), x0, 4).alpha
    for given_A, given_H in ((list(A), list(H)), (A.__getitem__, H), (A, H.__getitem__)):
        assert gauge(DiscreteSystem(given_A, given_H), x0, 4).alpha == expected


def test_flat_sums_hold_what_lies_in_their_plane_and_nothing_else():
    factors = np.array([np.diag([1.0, 2.0, 0.0]), np.diag([3.0, 0.0, 0.0])])
    found = gauge_of_factors(factors, np.array([4.0, 0.0, 0.0]))
    assert_allclose(found.alpha, 1, rtol=1e-12)
    assert_allclose(found.costate, [-1, 0, 0], atol=1e-12)
    turn = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))[0]
    assert_allclose(gauge_of_factors(turn @ factors, turn @ [4.0, 0, 0]).alpha, 1, rtol=1e-12)
    for outside in ([0.0, 0.0, 1.0], [1.0, 1.0, 1e-3]):
        with pytest.raises(Infeasible, match=r"do not span the state space: x0 = .* is out of their reach"):
            gauge_of_factors(turn @ factors, np.array([turn @ [1.0, 0, 0], turn @ outside]))
    with pytest.raises(Infeasible, match="do nothing"):
        gauge_of_factors(np.zeros((2, 3, 3)), np.ones(3))


@pytest.mark.parametrize(
    ("A", "H", "message"),
    [
        (PLANE, [[1, 0.5], [0, 1]], r"H\(0\) must be symmetric"),
        (PLANE, [[1, 0], [0, -1]], r"H\(0\) must be positive definite, got the least eigenvalue -1"),
        (PLANE, [[1, 0], [0, 0]], r"H\(0\) must be positive definite"),
        (PLANE, [[1, 0], [0, 3e15]], r"H\(0\) must have a condition number below 1e15, got 3e\+15"),
        (PLANE, np.eye(3), r"H\(0\) must have shape \(2, 2\) like A\(0\), got \(3, 3\)"),
        (PLANE, [1.0, 2.0], r"H must be an array \(n, n\) or \(steps, n, n\), got shape \(2,\)"),
        (PLANE, [[1, np.nan], [0, 1]], "H must be .* finite, got nan"),
        (np.ones((2, 2)), PLANE, r"A\(0\) must be nonsingular"),
        (np.ones((2, 3)), PLANE, r"A\(0\) must be an \(n, n\) matrix, got shape \(2, 3\)"),
        (np.zeros((0, 0)), PLANE, r"A\(0\) must be an \(n, n\) matrix, got shape \(0, 0\)"),
        ([PLANE], PLANE, "A must hold a matrix for step 1, got 1 matrices"),
        (
            lambda k: np.eye(2 + k),
            lambda k: np.eye(2 + k),
            r"A\(1\) must have shape \(2, 2\) like A\(0\), got \(3, 3\)",
        ),
        (lambda k: PLANE, lambda k: PLANE - 2 * k * PLANE, r"H\(1\) must be positive definite"),
        (1e-200 * PLANE, PLANE, r"A must have inverses .* within the range .*, got one beyond it at k = 1"),
    ],
)
def test_matrices_are_refused_by_name(A, H, message):
    with pytest.raises(ValueError, match=message):
        gauge(DiscreteSystem(A, H), [3.0, 4.0], 2)


def test_arguments_of_other_kinds_are_refused_by_name():
    system = DiscreteSystem(PLANE, PLANE)
    for steps in (0, -1, 2.0, "3", None, True):
        with pytest.raises(ValueError, match="steps must be a positive whole number"):
            gauge(system, [1.0, 2.0], steps)
    for x0, error in (([1.0, 2.0, 3.0], ValueError), ([np.nan, 1.0], ValueError), (None, TypeError)):
        with pytest.raises(error, match="x0 must be"):
            gauge(system, x0, 2)
    for wrong in (None, "A", lambda k: None):
        with pytest.raises(TypeError, match=r"A(\(0\))? must be"):
            gauge(DiscreteSystem(wrong, PLANE), [1.0, 2.0], 2)
    with pytest.raises(TypeError, match="system must be a DiscreteSystem, got NoneType"):
        gauge(None, [1.0, 2.0], 2)


def test_an_open_proof_is_not_handed_out_however_small_the_gauge():
    for residual, upper, lower in ((1e-3, 1.0, 1.0), (0.0, 1e-20, 0.9e-20), (0.0, np.nan, 1.0), (0.0, 1, 0)):
        with pytest.raises(NotConverged, match="the gauge could not be proved"):
            require_closed(Certificate(*map(np.array, (residual, upper, lower))), "the gauge")
    require_closed(Certificate(np.zeros(2), np.array([0.0, 1e-20]), np.array([0.0, 1e-20])), "the gauge")


@pytest.mark.parametrize(
    ("state", "weight"), [(1e-200, 1e-300), (1e160, 1e300), (1e-310, 1.0), (1e300, 1e20)]
)
def test_a_gauge_that_doubles_do_not_hold_is_refused(state, weight):
    """Controls with (u, weight u) <= 1 have lengths up to 1/sqrt(weight)."""
    system = DiscreteSystem(np.eye(2), np.eye(2) * weight)
    with pytest.raises(ValueError, match=r"^x0 must give with the system a gauge within the range") as caught:
        gauge(system, [[1.0, 1.0], [state, 0.5 * state]], steps=3)
    assert caught.value.argument == "x0"
