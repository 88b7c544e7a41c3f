"""The lemmas and theorems of sections 2 to 6 on random systems in dimension 2 to 6 with random ellipsoids.

Sets are described by points, trajectories and support functions. The solver gives gauges and
their bounds.
"""

from dataclasses import dataclass
from itertools import accumulate

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from pontryagin.orbit_correction import DiscreteSystem, gauge
from pontryagin.orbit_correction.gauges.general import gauge_of_factors


@dataclass(frozen=True)
class RandomSystem:
    """A nonstationary system: A (N, n, n), factors L (N, n, n) of the ellipsoids L B, and a generator."""

    A: np.ndarray
    L: np.ndarray
    generator: np.random.Generator

    @property
    def steps(self):
        return len(self.A)

    @property
    def n(self):
        return self.A.shape[1]

    def direction(self):
        vector = self.generator.normal(size=self.n)
        return vector / np.linalg.norm(vector)

    def controls(self, boundary=False):
        """Random points of the ellipsoids, (N, n)."""
        w = self.generator.normal(size=(self.steps, self.n))
        size = 1 if boundary else self.generator.uniform(size=(self.steps, 1))
        return np.einsum("kij,kj->ki", self.L, w / np.linalg.norm(w, axis=1, keepdims=True) * size)

    def reach(self, k=0):
        """Factors of the summands of X(N - k, k)."""
        back, result = np.eye(self.n), []
        for A, L in zip(self.A[k:], self.L[k:], strict=True):
            back = back @ np.linalg.inv(A)
            result.append(back @ L)
        return np.array(result)

    def fly(self, x, controls):
        """The states from x on, (N + 1, n)."""
        states = [x]
        for A, u in zip(self.A, controls, strict=True):
            states.append(A @ states[-1] + u)
        return np.array(states)

    def brought_back(self, end):
        """The start of the motion without controls that has this end."""
        return np.linalg.solve(np.linalg.multi_dot([*self.A[::-1], np.eye(self.n)]), end)

    def costates(self, psi):
        """The costates psi_1, ..., psi_N that follow psi, (N, n)."""
        return np.array([*accumulate(self.A, lambda psi, A: np.linalg.solve(A.T, psi), initial=psi)][1:])

    def system(self, k=0, size=1.0):
        shapes = np.linalg.inv(self.L @ np.swapaxes(self.L, 1, 2)) / size**2
        shapes = (shapes + np.swapaxes(shapes, 1, 2)) / 2
        return DiscreteSystem(self.A[k:], shapes[k:])


@st.composite
def systems(draw):
    n, steps = draw(st.integers(2, 6)), draw(st.integers(2, 4))
    generator = np.random.default_rng(draw(st.integers(0, 10**6)))

    def matrices():
        first, second = (np.linalg.qr(generator.normal(size=(steps, n, n)))[0] for _ in range(2))
        return first * generator.uniform(0.5, 2.0, size=(steps, 1, n)) @ second

    return RandomSystem(matrices(), matrices(), generator)


def support(factors, p):
    """Support function of the sum of the ellipsoids G B."""
    return np.linalg.norm(np.einsum("kij,i->kj", factors, p), axis=1).sum()


def support_parts(factors, p):
    """Support points of the summands, (N, n)."""
    along = np.einsum("kij,i->kj", factors, p)
    return np.einsum("kij,kj->ki", factors, along / np.linalg.norm(along, axis=1, keepdims=True))


def support_point(L, p):
    """The point of L B that is farthest along p."""
    return L @ L.T @ p / np.linalg.norm(L.T @ p)


def normal(L, x):
    """The unit normal of L B at a point of its boundary."""
    outward = np.linalg.solve(L @ L.T, x)
    return outward / np.linalg.norm(outward)


def level(L, x):
    """The Minkowski functional of L B."""
    return np.linalg.norm(np.linalg.solve(L, x))


@given(systems())
def test_lemma_1_controls_that_end_at_zero_start_in_the_sum(case):
    """Lemma 1: the states of (2) that controls of system (1) bring to 0 lie in the sum."""
    controls, x = case.controls(), np.zeros(case.n)
    for k in reversed(range(case.steps)):
        x = np.linalg.solve(case.A[k], x - controls[k])
    assert_allclose(case.fly(x, controls)[-1], 0, atol=1e-12)
    found = gauge(case.system(), x, case.steps)
    assert found.certificate.dual_value <= 1 + 1e-12
    p = case.direction()
    assert p @ x <= support(case.reach(), p) * (1 + 1e-12)


@given(systems())
def test_lemma_1_outside_the_sum_no_controls_end_at_zero(case):
    """Lemma 1: no controls of system (1) bring states outside the sum to 0."""
    p = case.direction()
    x = 1.01 * support_parts(case.reach(), p).sum(axis=0)
    assert gauge(case.system(), x, case.steps).alpha > 1.009
    for _ in range(5):
        missed = case.brought_back(case.fly(x, case.controls(boundary=True))[-1])
        assert p @ missed > 0.009 * support(case.reach(), p)


@given(systems())
def test_corollary_1_in_support_functions(case):
    """Corollary 1: A(k) X(N, k) is X(N - 1, k + 1) - U(k)."""
    p = case.direction()
    left = support(case.A[0] @ case.reach(), p)
    assert_allclose(left, support(case.reach(1), p) + np.linalg.norm(case.L[0].T @ p), rtol=1e-11)


@given(systems())
def test_lemma_2_and_corollary_2_one_support_point_and_disjoint_cones(case):
    """Lemma 2: each p has one support point. Corollary 2: two boundary points have no common normal."""
    L, p = case.L[0], case.direction()
    best = support_point(L, p)
    assert_allclose([level(L, best), p @ best], [1, np.linalg.norm(L.T @ p)], rtol=1e-11)
    for other in (case.controls()[0], case.controls(boundary=True)[0]):
        assert p @ best - p @ other >= p @ best / 2 * level(L, other - best) ** 2 * (1 - 1e-9)
    assert normal(L, other) @ best < normal(L, other) @ other


@given(systems())
def test_lemma_2_for_a_strictly_convex_set_that_is_no_ellipsoid(case):
    """Lemma 2 for linear images of the 4-ball."""

    def ball_4(w):
        return (w**4).sum() ** 0.25

    L, p = case.L[0], case.direction()
    reach = L.T @ p
    size = (np.abs(reach) ** (4 / 3)).sum() ** 0.75
    best = L @ (np.sign(reach) * np.abs(reach / size) ** (1 / 3))
    assert_allclose([ball_4(np.linalg.solve(L, best)), p @ best], [1, size], rtol=1e-10)
    for _ in range(5):
        w = case.generator.normal(size=case.n)
        other = L @ w / ball_4(w)
        assert p @ other < size
        assert ball_4(np.linalg.solve(L, (best + other) / 2)) < 1


@given(systems())
def test_lemmas_3_and_8_images_of_ellipsoids(case):
    """Lemma 8: the image is the ellipsoid of A^-T H A^-1. Lemma 3: A^-T carries its normals."""
    A, L, p = case.A[0], case.L[1], case.direction()
    H, inverse = np.linalg.inv(L @ L.T), np.linalg.inv(A)
    shape = inverse.T @ H @ inverse
    assert np.linalg.eigvalsh((shape + shape.T) / 2).min() > 0
    x = case.controls()[1]
    assert_allclose((A @ x) @ shape @ (A @ x), level(L, x) ** 2, rtol=1e-9)
    image = support_point(A @ L, inverse.T @ p)
    assert_allclose(A @ support_point(L, p), image, rtol=1e-9, atol=1e-12)


@given(systems())
def test_lemma_4_the_middle_of_two_points_of_a_sum_is_inside(case):
    """Lemma 4: a sum of strictly convex sets is strictly convex."""
    factors = case.reach()
    ends = [support_parts(factors, case.direction()).sum(axis=0) for _ in range(2)]
    sizes = gauge_of_factors(factors, np.array([*ends, (ends[0] + ends[1]) / 2])).certificate
    assert_allclose(sizes.primal_value[:2], 1, rtol=1e-9)
    assert np.abs(ends[0] - ends[1]).max() > 0
    assert sizes.primal_value[2] < 1


@given(systems())
def test_lemma_5_one_decomposition_with_one_common_normal(case):
    """Lemma 5, and (8), (9) and (10): the parts of a boundary point are support points with its normal."""
    factors, p = case.reach(), case.direction()
    parts = support_parts(factors, p)
    found = gauge_of_factors(factors, parts.sum(axis=0))
    assert_allclose(found.alpha, 1, rtol=1e-11)
    assert_allclose(-found.costate, p, atol=1e-6)
    assert_allclose(support_parts(factors, -found.costate), parts, atol=1e-5)
    for L, part in zip(factors, parts, strict=True):
        assert_allclose(level(L, part), 1, rtol=1e-10)
        assert_allclose(normal(L, part), p, atol=1e-9)


@given(systems())
def test_theorems_1_to_3_from_the_boundary(case):
    """Theorem 1 with the steps (3) and normals (4), Theorem 2 and Theorem 3 from a boundary point."""
    psi = case.direction()
    x = support_parts(case.reach(), -psi).sum(axis=0)
    costates = case.costates(psi)
    states = case.fly(x, [*map(support_point, case.L, costates)])
    for k, costate in enumerate([psi, *costates[:-1]]):
        assert_allclose(-costate @ states[k], support(case.reach(k), costate), rtol=1e-9)
    assert_allclose(states[-1], 0, atol=1e-9)
    rest = gauge(case.system(1), states[1], case.steps - 1)
    assert_allclose(rest.alpha, 1, rtol=1e-9)
    assert_allclose(rest.costate, costates[0] / np.linalg.norm(costates[0]), atol=1e-5)
    strayed = case.A[0] @ x + case.controls()[0]
    assert gauge(case.system(1), strayed, case.steps - 1).alpha > 1


@given(systems())
def test_lemmas_6_7_and_theorem_4_from_inside(case):
    """From an interior state, as in (5): Lemma 7 on the system (7), Theorem 4, and Lemma 6.

    By Lemma 6 the controls of (6), which leave out alpha, miss the origin.
    """
    x = 0.7 * support_parts(case.reach(), case.direction()).sum(axis=0)
    found = gauge(case.system(), x, case.steps)
    alpha, psi = float(found.alpha), found.costate
    assert_allclose(alpha, 0.7, rtol=1e-9)
    assert_allclose(gauge(case.system(size=alpha), x, case.steps).alpha, 1, rtol=1e-9)
    controls = np.array([*map(support_point, case.L, case.costates(psi))])
    flown = case.fly(x, alpha * controls)
    assert_allclose(flown[-1], 0, atol=1e-6)
    for k in range(case.steps):
        assert_allclose(gauge(case.system(k), flown[k], case.steps - k).alpha, alpha, rtol=1e-5)
    back = case.brought_back(case.fly(x, controls)[-1])
    assert_allclose(-psi @ back, -0.3 * support(case.reach(), psi), rtol=1e-5)


@given(systems())
def test_lemmas_9_and_10_by_products_of_the_matrices(case):
    """Lemma 9: the sum over psi_0 is -x0. Lemma 10: its controls bring x0 to the origin."""
    psi, product = case.direction(), np.eye(case.n)
    start, controls = np.zeros(case.n), []
    for A, L in zip(case.A, case.L, strict=True):
        product = A @ product
        inverse = np.linalg.inv(product.T @ np.linalg.inv(L @ L.T) @ product)
        part = inverse @ psi / np.sqrt(psi @ inverse @ psi)
        start -= part
        controls.append(product @ part)
    assert_allclose(start, support_parts(case.reach(), -psi).sum(axis=0), rtol=1e-8, atol=1e-10)
    assert_allclose(case.fly(start, controls)[-1], 0, atol=1e-9)
    for L, u in zip(case.L, controls, strict=True):
        assert_allclose(level(L, u), 1, rtol=1e-9)


@given(systems())
def test_system_11_has_one_solution_because_its_right_side_is_monotone(case):
    """The system (11), whose right-hand side is also homogeneous of degree 0 and odd."""
    first, second = case.direction(), case.direction()
    sums = [support_parts(case.reach(), psi).sum(axis=0) for psi in (first, second)]
    assert (sums[0] - sums[1]) @ (first - second) > 0
    assert_allclose(support_parts(case.reach(), 3 * first).sum(axis=0), sums[0], rtol=1e-12)
    assert_allclose(support_parts(case.reach(), -first).sum(axis=0), -sums[0], rtol=1e-12)
