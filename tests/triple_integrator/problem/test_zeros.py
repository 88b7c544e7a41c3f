"""Zeros of expressions: all of them, to the last place, against exact ones."""

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from pontryagin.triple_integrator.problem.zeros import t, zeros

AT = sp.Rational(9, 10)
WHOLE = np.array([0.0]), np.array([2.0])


@given(st.lists(st.integers(1, 1999), min_size=1, max_size=5, unique=True))
def test_zeros_of_polynomials_are_exact(places):
    roots = sorted(sp.Rational(k, 1000) for k in places)
    polynomial = sp.expand(sp.Mul(*(t - root for root in roots)))
    rests = {}
    found = zeros(polynomial, *WHOLE, rests)
    assert_allclose(found, [float(root) for root in roots], rtol=4e-15)
    exact = [sp.Rational(x) + sp.Rational(rests[x]) for x in found.tolist()]
    assert all(abs(x - root) < sp.Rational(1, 10**23) for x, root in zip(exact, roots, strict=True))


@pytest.mark.parametrize(
    ("expression", "roots"),
    [
        (sp.sin(50 * t), np.arange(32) * np.pi / 50),
        (sp.exp(t) - 3, [np.log(3)]),
        (sp.sin(t**2) - sp.Rational(1, 2), np.sqrt([np.pi / 6, 5 * np.pi / 6])),
        (sp.tanh((t - 1) * 10**9) - sp.Rational(1, 2), [1 + np.arctanh(0.5) * 1e-9]),
        (sp.cos(3 * t) - sp.cos(3 * t + 2 * sp.pi / 3), [np.pi * 2 / 9, np.pi * 5 / 9]),
        (t - sp.pi / 3, [np.pi / 3]),
        (sp.log(t) - sp.cos(t), [1.302964001216013]),
        (2 + sp.cos(9 * t), []),
        (sp.cosh(1000 * (t - 1)), []),
        (sp.Integer(3), []),
        ((t - 1) ** 2, [1.0]),
    ],
)
def test_zeros_are_found_to_the_last_place(expression, roots):
    found = zeros(sp.sympify(expression), *WHOLE)
    assert_allclose(found[found > 1e-13], [root for root in roots if root > 0], rtol=1e-15)


def test_two_zeros_close_to_each_other_are_two():
    found = zeros(sp.sin(t) - sp.sin(AT) - (t - AT) * (sp.cos(AT) - sp.Rational(1, 100)), *WHOLE)
    assert_allclose(found[:2], [0.9, 0.9253], rtol=0, atol=1e-3)
    assert len(found) == 2


def test_the_zeros_of_many_intervals_are_those_within_them():
    low = np.arange(100) * 10.0
    found = zeros(sp.sin(t), low, low + 1.5)
    exact = np.arange(320) * np.pi
    inside = (exact[:, None] >= low) & (exact[:, None] <= low + 1.5)
    assert_allclose(found, exact[inside.any(axis=1)], rtol=1e-15)


def test_what_cannot_be_enclosed_is_sampled():
    assert_allclose(
        zeros(sp.gamma(t + 1) - sp.Rational(9, 10), np.array([0.5]), np.array([1.5])), [0.6492265], atol=1e-4
    )


def test_too_many_zeros_are_refused():
    with pytest.raises(ValueError, match=r"^disturbance must change its form at fewer times, got sin"):
        zeros(sp.sin(10**6 * t), *WHOLE)
