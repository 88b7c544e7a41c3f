"""Formulas in texts have the values that SymPy gives them, and anything else is refused."""

from typing import NamedTuple

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from pontryagin.io.formula import (
    FUNCTIONS,
    Formula,
    expression,
    number,
    read,
)


class Known(NamedTuple):
    """A text, its meaning, and a bound on the moduli of all intermediate values for |t| < 2."""

    text: str
    meaning: sp.Expr
    bound: float


T = sp.Symbol("t")
LEAVES = st.sampled_from(
    [
        Known("t", T, 2),
        Known("pi", sp.pi, 4),
        Known("2", sp.Integer(2), 2),
        Known("3.5e-1", sp.Rational(7, 20), 1),
        Known("-1.25", sp.Rational(-5, 4), 2),
    ]
)
STEADY = {"sin": sp.sin, "cos": sp.cos, "tanh": sp.tanh, "atan": sp.atan, "abs": sp.Abs}
"""Functions that do not magnify errors of their argument."""


def compound(parts):
    return st.one_of(
        st.builds(
            lambda a, b: Known(f"{a.text} + ({b.text})", a.meaning + b.meaning, a.bound + b.bound),
            parts,
            parts,
        ),
        st.builds(
            lambda a, b: Known(f"{a.text} - ({b.text})", a.meaning - b.meaning, a.bound + b.bound),
            parts,
            parts,
        ),
        st.builds(
            lambda a, b: Known(f"({a.text})*({b.text})", a.meaning * b.meaning, a.bound * b.bound),
            parts,
            parts,
        ),
        st.builds(lambda a: Known(f"-({a.text})", -a.meaning, a.bound), parts),
        st.builds(lambda a: Known(f"({a.text})/7", a.meaning / 7, a.bound), parts),
        st.builds(lambda a, n: Known(f"({a.text})^{n}", a.meaning**n, a.bound**n), parts, st.integers(1, 3)),
        st.builds(
            lambda name, a: Known(f"{name}({a.text})", STEADY[name](a.meaning), a.bound + 2),
            st.sampled_from(sorted(STEADY)),
            parts,
        ),
    )


@settings(deadline=None)
@given(st.recursive(LEAVES, compound, max_leaves=5), st.floats(-2, 2))
def test_a_formula_has_the_values_that_sympy_gives_to_its_meaning(known, t):
    formula = read(known.text, "t")
    value = formula(t) if isinstance(formula, Formula) else formula
    exact = float(known.meaning.evalf(30, subs={T: sp.Rational(t)}))
    assert abs(value - exact) <= 1e-13 * known.bound


@settings(deadline=None, max_examples=40)
@given(st.recursive(LEAVES, compound, max_leaves=5), st.floats(-2, 2))
def test_an_expression_has_the_values_of_the_formula(known, t):
    found, formula = expression(known.text, "t"), read(known.text, "t")
    value = float(sp.sympify(found).subs(sp.Symbol("t", real=True), sp.Rational(t)))
    exact = formula(t) if isinstance(formula, Formula) else formula
    assert abs(value - exact) <= 1e-13 * known.bound


def test_an_expression_holds_what_was_typed_in_every_variable():
    x, v = sp.symbols("x v", real=True)
    assert expression("0.3*sin(x) - v^3/4", "x", "v") == sp.Rational(3, 10) * sp.sin(x) - v**3 / 4
    assert expression("asin(sqrt(abs(x)))/(2*pi)", "x").subs(x, 1).evalf() == pytest.approx(0.25, rel=1e-15)
    assert expression("3/4", "x") == 0.75


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("x^13", "exponent that is not a number from -12 to 12"),
        ("(1+x)^1e9", "exponent that is not a number"),
        ("2^x", "exponent that is not a number"),
        ("x*9**9**9**9", "no finite"),
        ("x + y", "not a formula: takes numbers, x, v, pi"),
        ("x.evalf()", "not a formula"),
    ],
)
def test_an_expression_that_sympy_cannot_expand_in_time_is_refused(text, words):
    with pytest.raises(ValueError, match=words):
        expression(text, "x", "v")


@pytest.mark.parametrize("name", FUNCTIONS)
def test_each_function_is_the_one_of_its_name(name):
    known = {"abs": sp.Abs, **{other: getattr(sp, other) for other in FUNCTIONS if other != "abs"}}
    assert number(f"{name}(0.3)") == pytest.approx(float(known[name](sp.Float("0.3"))), rel=1e-15)


def test_a_power_binds_more_tightly_than_a_sign_and_a_product():
    assert number("-2^2") == -4
    assert number("2*3^2") == 18
    assert number("2^3^2") == 512


def test_a_formula_takes_an_array_and_keeps_its_shape():
    t = np.linspace(0, 1, 6).reshape(2, 3)
    assert read("t - t + 1", "t")(t).tolist() == np.ones((2, 3)).tolist()


@pytest.mark.parametrize(
    "text",
    [
        "__import__('os').system('true')",
        "open('there', 'w')",
        "(lambda: 0)()",
        "t.real",
        "t[0]",
        "[t for t in t]",
        "sin(t, t)",
        "sin(x=t)",
        "x",
        "'text'",
        "True",
        "1j",
        "t < 1",
        "t if t else 1",
        "t; t",
        "t = 1",
        "",
        "sin",
        "t @ t",
        "t // 2",
        "(" * 300 + "t" + ")" * 180,
        "+".join(["t"] * 300),
    ],
)
def test_what_is_no_formula_is_refused(text):
    with pytest.raises(ValueError, match="formula"):
        read(text, "t")


@pytest.mark.parametrize(
    "text", ["1/0", "9**9**9**9", "(-1)^0.5", "log(-1)", "1e999", "9" * 400, "sqrt(-pi)"]
)
def test_a_number_has_to_be_finite_and_real(text):
    with pytest.raises(ValueError, match="no finite real value"):
        number(text)
