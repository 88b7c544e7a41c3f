"""Compiled functions have the values of the expressions that they were made from."""

import math

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from pontryagin.numerics import compile as compiler

x, y = sp.symbols("x y")


@st.composite
def expressions(draw):
    """Rational functions of x and y, with powers and a square root, finite where x and y are positive."""
    leaves = st.one_of(st.sampled_from([x, y]), st.integers(1, 9).map(sp.Integer), st.just(sp.Rational(2, 7)))

    def grown(children):
        return st.one_of(
            st.tuples(children, children).map(lambda pair: pair[0] + pair[1]),
            st.tuples(children, children).map(lambda pair: pair[0] * pair[1]),
            st.tuples(children, st.sampled_from([-5, -4, -3, -2, -1, 2, 3, 4, 5])).map(
                lambda p: p[0] ** p[1]
            ),
            children.map(lambda e: sp.sqrt(e) - e / 3),
        )

    expression = draw(st.recursive(leaves, grown, max_leaves=6))
    value = expression.subs({x: sp.Rational(3, 2), y: sp.Rational(2, 3)})
    return expression if value.is_real and 1e-6 < abs(value.evalf()) < 1e6 else x + y


@given(expressions())
def test_both_forms_take_the_value_of_the_expression(expression):
    exact = float(expression.subs({x: sp.Rational(3, 2), y: sp.Rational(2, 3)}).evalf(30))
    (value,) = compiler.function("f", [x, y], {"value": expression})(1.5, 2 / 3)
    assert_allclose(value, exact, rtol=1e-9)
    scope: dict = {"sqrt": math.sqrt}
    exec(compiler.source("g", [x, y], {"value": expression}, "A value."), scope)
    assert_allclose(scope["g"](1.5, 2 / 3), exact, rtol=1e-9)


def test_constants_and_matrices_have_the_broadcast_shape():
    matrix = sp.Matrix([[x, 0, y], [1, x * y, 2]])
    constant, table = compiler.function("f", [x, y], {"one": sp.Integer(1), "table": matrix})(
        np.ones((4, 1)), np.arange(3.0)
    )
    assert constant.shape == (4, 3)
    assert table.shape == (4, 3, 2, 3)
    assert table[2, 1].tolist() == [[1.0, 0.0, 1.0], [1.0, 1.0, 2.0]]


def test_a_function_says_what_it_computes():
    made = compiler.function("area", [x, y], {"product": x * y})
    assert made.__name__ == "area"
    assert "area(x, y)" in made.__doc__
    assert "product = x*y" in made.__doc__


def test_a_symbol_that_is_no_argument_is_named():
    for make in (
        lambda: compiler.function("f", [x], {"value": x + y}),
        lambda: compiler.source("f", [x], {"value": x + y}, ""),
    ):
        with pytest.raises(ValueError, match=r"^f: .*not arguments: y"):
            make()


def test_complex_values_are_refused_not_cut():
    with pytest.raises(TypeError, match=r"^root: .*complex"):
        compiler.function("root", [x], {"value": sp.I * x})(1.0)


def test_shared_parts_are_written_once():
    text = compiler.source("f", [x, y], {"p": sp.sin(x + y) + 1, "q": sp.sin(x + y) ** 2}, "")
    assert text.count("sin(") == 1


def test_an_argument_keeps_its_name_beside_shared_parts():
    x0 = sp.Symbol("x0")
    scope: dict = {}
    exec(compiler.source("f", [x0, y], {"p": (x0 + y) ** 2 + x0, "q": (x0 + y) ** 2}, ""), scope)
    assert scope["f"](2.0, 3.0) == (27.0, 25.0)
