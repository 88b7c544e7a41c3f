"""Rules for powers, and integrals of powers of a quadratic: exactness, identities, an independent rule."""

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from pontryagin.triple_integrator.norms.power_integrals import HEAD, power_integrals
from pontryagin.triple_integrator.norms.power_rules import (
    COARSE,
    FINE,
    INDEPENDENT,
    gauss_jacobi,
    rule,
    stages,
    table,
)
from pontryagin.triple_integrator.norms.quadrature import Quadratic, graded_rule

POWERS = (1.00001, 1.03, 1.2, 1.5, 2.0, 3.0, 4.7, 11.0, 25.0, 101.0, 1001.0)
zeros = st.one_of(st.floats(-3, 3), st.sampled_from([0.0, 1.0, 0.5, 1e-9, 1 - 1e-9, -1e-7, 1 + 1e-5]))


def exact(h: Quadratic, p: float) -> np.ndarray:
    """Integrals of |h|^p and of |h|^(p-1) sign h times 1, y, y^2, y = s - 1/2, by the graded rule."""
    s, values, weights = h.sample(graded_rule())
    u = weights * np.sign(values) * np.abs(values) ** (p - 1)
    y = s - 0.5
    return np.stack([(part).sum() for part in (weights * np.abs(values) ** p, u, u * y, u * y * y)])


def found(h: Quadratic, p: float, grade) -> np.ndarray:
    h0, h1, h2 = h.coefficients.tolist()
    b = (h0 + h1 / 2 + h2 / 4, h1 + h2, h2)
    return np.array(power_integrals(*b, float(h.discriminant), rule(grade, p).tolist(), 0))


def assert_integrals(h: Quadratic, p: float) -> None:
    h = h.scaled(1 / np.abs(h.cuts[1]).max())
    for grade, relative in ((COARSE, 3e-3), (FINE, 1e-12), (INDEPENDENT, 1e-12)):
        expected = exact(h, p)
        accuracy = relative * (1 + p / 10 if grade is not COARSE else 1)
        assert_allclose(found(h, p, grade)[:4], expected, rtol=0, atol=accuracy * expected[0])


@pytest.mark.parametrize("p", POWERS)
@pytest.mark.parametrize("grade", [COARSE, FINE, INDEPENDENT])
def test_rules_are_exact_for_polynomials_with_both_weights(p, grade):
    """Gauss and Jacobi for t^(p-1); with the node 0, Gauss and Radau for t^(p-2)."""
    n, numbers = grade.nodes, rule(grade, p)
    assert numbers.size == grade.size and numbers[0] == p and numbers[1] == n
    t, over_t, at_zero = numbers[HEAD + 2 * n : HEAD + 3 * n], numbers[HEAD + 3 * n : -1], numbers[-1]
    for j in range(2 * n):
        assert_allclose((over_t * t ** (j + 1)).sum(), 1 / (p + j), rtol=1e-12)
    assert_allclose(over_t.sum() + at_zero, 1 / (p - 1), rtol=1e-12)
    assert at_zero >= 0, "no node has a negative weight"


def test_nodes_of_gauss_and_jacobi_are_those_of_gauss_and_legendre_for_p_one():
    t, w = gauss_jacobi(5, 1.0)
    x, v = np.polynomial.legendre.leggauss(5)
    assert_allclose([t, w], [(1 + x) / 2, v / 2], rtol=1e-13)


@pytest.mark.parametrize("q", [1.0001, 1.05, 1.7, 2.0, 4.0, 30.0, 1e5])
def test_stages_lead_from_the_quadratic_norm_to_p(q):
    p = stages(q)
    assert p[-1] == pytest.approx(q / (q - 1), rel=1e-14) and 1.2 - 1e-12 <= p[0] <= 4
    numbers = np.frombuffer(table(q))
    assert numbers[0] == len(p) and numbers.size == 1 + len(p) * COARSE.size + FINE.size + INDEPENDENT.size
    assert [numbers[1 + i * COARSE.size] for i in range(len(p))] == p


@given(zeros, zeros, st.sampled_from(POWERS))
@example(0.5, 0.5, 1.2)
def test_quadratics_with_real_zeros(a, b, p):
    assert_integrals(Quadratic(np.array([a * b, -a - b, 1.0]), np.asarray((a - b) ** 2)), p)


@given(zeros, st.floats(-9, 1), st.sampled_from(POWERS), st.sampled_from([-1, 1]))
def test_quadratics_with_double_and_complex_zeros(middle, decade, p, sign):
    width = sign * 10.0 ** (2 * decade)
    assert_integrals(Quadratic(np.array([middle**2 - width, -2 * middle, 1.0]), np.asarray(4 * width)), p)


@given(st.floats(-3, 3), st.sampled_from(POWERS), st.floats(-12, 0))
def test_quadratics_that_are_nearly_linear_and_nearly_constant(zero, p, decade):
    bend = 10.0**decade
    assert_integrals(Quadratic.of([-zero, 1.0, bend]), p)
    assert_integrals(Quadratic.of([1.0, bend * zero, bend / 3]), p)


@given(st.floats(0.05, 0.95), st.floats(-2, 2), st.sampled_from([p for p in POWERS if p < 30]))
def test_integrals_of_the_three_powers_belong_together(a, b, p):
    """For |h|^(p-2) h^2 = |h|^p, and by parts: (p-1) <h' |h|^(p-2)> is |h|^(p-1) sign h at the ends."""
    h = Quadratic(np.array([a * b, -a - b, 1.0]), np.asarray((a - b) ** 2))
    h = h.scaled(1 / np.abs(h.cuts[1]).max())
    assume(min(abs(a - b), abs(b), abs(1 - b)) > 0.1)
    whole, g0, g1, g2, a0, a1, a2, *_ = found(h, p, FINE)
    h0, h1, h2 = h.coefficients
    b0, b1, b2 = h0 + h1 / 2 + h2 / 4, h1 + h2, h2
    assert_allclose(b0 * g0 + b1 * g1 + b2 * g2, whole, rtol=1e-11)
    assert_allclose(b0 * a0 + b1 * a1 + b2 * a2, g0, rtol=0, atol=1e-10 * a0)
    ends = np.array([h0 + h1 + h2, h0])
    change = np.sign(ends) * np.abs(ends) ** (p - 1)
    assert_allclose((p - 1) * (b1 * a0 + 2 * b2 * a1), change[0] - change[1], atol=1e-10 * (1 + (p - 1) * a0))
