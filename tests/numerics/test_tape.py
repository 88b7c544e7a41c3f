"""Recorded operations have the values and the derivatives of the functions that were recorded."""

import math

import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose
from scipy.special import erf, erfc

from pontryagin.numerics.symbolic import Symbolic
from pontryagin.numerics.tape import FUNCTIONS, SLOPES, Tape, call
from pontryagin.numerics.trajectory import compiled

x, y = sp.symbols("x y")
ROOTS = [sp.Rational(1, 2), sp.Rational(-3, 2), sp.Rational(2, 7)]
ARGUMENTS = {"acosh": 1.7, "atan2": 0.3}


def derivative(expression, point):
    """f and df/dx at a point: the end of y' = f(x), x' = 0 after a unit of time, and its derivative in x."""
    native = compiled(Symbolic((x, y), (sp.Integer(0), expression), wrt=(x,)))
    begin = np.array([point, 0.0, 1.0, 0.0])
    found = native.follow(begin, 0.0, 1.0, np.empty(0), 1e-14, math.inf, 100, np.empty(0))
    return found.whole[1], found.whole[3]


@pytest.mark.parametrize("name", [name for name in FUNCTIONS if name not in ("copysign", "atan2")])
def test_every_function_has_its_value_and_its_derivative(name):
    point = ARGUMENTS.get(name, 0.6)
    of = getattr(sp, name)(x) if name != "fabs" else sp.Abs(x)
    value, slope = derivative(of, point)
    plain = {"erf": erf, "erfc": erfc}.get(name) or getattr(math, name)
    h = 1e-4
    eighth = sum(
        weight * (plain(point + i * h) - plain(point - i * h))
        for i, weight in enumerate((4 / 5, -1 / 5, 4 / 105, -1 / 280), 1)
    )
    assert_allclose(value, plain(point), rtol=1e-14)
    assert_allclose(slope, eighth / h, rtol=1e-10)


@pytest.mark.parametrize(
    "exponent", [2, 3, 7, -1, -4, sp.Rational(1, 2), sp.Rational(-3, 2), sp.Rational(2, 7), 70]
)
def test_powers_have_their_values_and_derivatives(exponent):
    value, slope = derivative(x**exponent, 1.3)
    assert_allclose(value, 1.3 ** float(exponent), rtol=1e-13)
    assert_allclose(slope, float(exponent) * 1.3 ** (float(exponent) - 1), rtol=1e-13)


def test_functions_of_two_numbers():
    value, slope = derivative(sp.atan2(x, 1 + x**2), 0.7)
    assert_allclose(value, math.atan2(0.7, 1.49), rtol=1e-15)
    assert_allclose(slope, float(sp.diff(sp.atan(x / (1 + x**2)), x).subs(x, 0.7)), rtol=1e-13)
    value, slope = derivative((2 + x) ** x, 0.7)
    assert_allclose(value, 2.7**0.7, rtol=1e-14)
    assert_allclose(slope, float(sp.diff((2 + x) ** x, x).subs(x, sp.Float(0.7, 30))), rtol=1e-13)


def test_the_sign_and_the_modulus():
    for point in (-0.4, 0.4):
        found = derivative(sp.Abs(x) * sp.sign(x) ** 2, point)
        assert_allclose(found, (abs(point), math.copysign(1.0, point)), rtol=1e-14)


def test_an_operation_is_recorded_once():
    tape = Tape()
    a, b = tape.record("state", 0), tape.record("state", 1)
    assert a * b + call("sin", a) == a * b + call("sin", a)
    before = len(tape.operations)
    _ = (a * b + call("sin", a)) * 1.0
    assert len(tape.operations) == before


def test_derivatives_of_what_does_not_change_are_zero():
    tape = Tape()
    a, b = tape.record("state", 0), tape.record("state", 1)
    one = tape.number(1.0)
    by_a = tape.derivatives([a, b, a + 2.0 * b], {a: one, b: tape.number(3.0)})
    assert [d.constant for d in by_a[:2]] == [1.0, 3.0]
    (none,) = tape.derivatives([tape.number(5.0)], {a: one})
    assert none.constant == 0.0


def test_what_cannot_be_compiled_is_named():
    with pytest.raises(ValueError, match="expressions must hold functions that can be compiled, got gamma"):
        compiled(Symbolic((x,), (sp.gamma(x),)))


def test_every_operation_has_slopes():
    assert {*FUNCTIONS} < {*SLOPES}
