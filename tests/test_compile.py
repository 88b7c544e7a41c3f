"""Compiled functions take the values of the expressions they were made from; stacks those of single calls."""

import math
from math import sqrt

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from pontryagin import compile as compiler

x, y = sp.symbols("x y")
OFFSET = 0.25


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


def shifted_root(p):
    return sqrt(p) + OFFSET


def two_values(p, q):
    total = shifted_root(p)
    for _ in range(3):
        total = total * q
    return total, p - q


def test_a_large_stack_equals_single_calls_bit_by_bit():
    stack = compiler.batched(two_values, outputs=2)
    rng = np.random.default_rng(1)
    p, q = rng.random((2, 3 * compiler.COMPILE_FROM))
    assert stack(p, q).tolist() == [
        list(two_values(*pair)) for pair in zip(p.tolist(), q.tolist(), strict=True)
    ]


def test_columns_may_be_strided_and_read_only():
    stack = compiler.batched(two_values, outputs=2)
    table = np.random.default_rng(2).random((compiler.COMPILE_FROM, 2))
    fixed = table.copy()
    fixed.flags.writeable = False
    expected = stack(*np.ascontiguousarray(table.T))
    assert stack(table[:, 0], table[:, 1]).tolist() == expected.tolist()
    assert stack(fixed[::-1, 0], fixed[::-1, 1]).tolist() == expected[::-1].tolist()
    assert stack(np.broadcast_to(0.5, 600), np.broadcast_to(0.5, 600)).shape == (600, 2)


def test_a_stack_of_none_has_no_rows():
    assert compiler.batched(two_values, outputs=2)(np.empty(0), np.empty(0)).shape == (0, 2)


def test_without_numba_the_same_numbers_come_more_slowly(monkeypatch):
    p = np.linspace(0, 1, compiler.COMPILE_FROM + 1)
    compiled = compiler.batched(two_values, outputs=2)(p, p)
    monkeypatch.setattr(compiler, "has_numba", lambda: False)
    assert compiler.batched(two_values, outputs=2)(p, p).tolist() == compiled.tolist()


def doubles(values):
    """A kernel of arrays."""
    for i in range(values.shape[0]):
        values[i] *= 2.0


def test_small_work_runs_plain_until_the_kernel_is_compiled():
    signature = "void(float64[::1])"
    assert compiler.compiled(doubles, signature, large=False) is doubles
    quick = compiler.compiled(doubles, signature)
    assert quick is not doubles
    assert compiler.compiled(doubles, signature, large=False) is quick
    values = np.arange(3.0)
    quick(values)
    assert values.tolist() == [0.0, 2.0, 4.0]


def test_an_edited_kernel_is_not_served_stale(tmp_path, monkeypatch):
    count = compiler.COMPILE_FROM
    for factor in (2, 3):
        path = tmp_path / f"version{factor}.py"
        path.write_text(f"def kernel(p):\n    return ({factor} * p,)\n")
        scope: dict = {}
        exec(compile(path.read_text(), str(path), "exec"), scope)
        assert compiler.batched(scope["kernel"], outputs=1)(np.ones(count))[0, 0] == factor


TABLE = [1.0, 2.0]


def looks_up(p):
    return (p * TABLE[0],)


def test_a_kernel_may_use_numbers_and_functions_only():
    with pytest.raises(TypeError, match="looks_up uses TABLE"):
        compiler.batched(looks_up, outputs=1)(np.ones(compiler.COMPILE_FROM))


def test_two_things_of_one_name_do_not_meet_in_one_kernel():
    """The compiled module has one namespace; modules of plain Python have one each."""

    def in_module(text, **names):
        scope: dict = dict(names)
        exec(text, scope)
        return scope["f"]

    alias, double = in_module("def f(p):\n    return p"), in_module("N = 2.0\ndef f(p):\n    return p * N")
    double.__name__ = "g"
    for kernel, clash in (
        (in_module("def f(p):\n    return (g(p),)", g=alias), "f"),
        (in_module("N = 3.0\ndef f(p):\n    return (g(p) + N,)", g=double), "N"),
    ):
        with pytest.raises(TypeError, match=f"called {clash} meet in f"):
            compiler.batched(kernel, outputs=1)(np.ones(compiler.COMPILE_FROM))
