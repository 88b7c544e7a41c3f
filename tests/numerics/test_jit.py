"""Stacks of problems have the values of single calls, compiled or not."""

from math import sqrt

import numpy as np
import pytest

from pontryagin.numerics import jit
from pontryagin.numerics.closure import closure_of

OFFSET = 0.25


def shifted_root(p):
    return sqrt(p) + OFFSET


def two_values(p, q):
    total = shifted_root(p)
    for _ in range(3):
        total = total * q
    return total, p - q


@pytest.mark.slow
def test_a_large_stack_equals_single_calls_bit_by_bit():
    stack = jit.batched(two_values, outputs=2)
    rng = np.random.default_rng(1)
    p, q = rng.random((2, 3 * jit.COMPILE_FROM))
    assert stack(p, q).tolist() == [
        list(two_values(*pair)) for pair in zip(p.tolist(), q.tolist(), strict=True)
    ]


def test_columns_may_be_strided_and_read_only():
    stack = jit.batched(two_values, outputs=2)
    table = np.random.default_rng(2).random((jit.COMPILE_FROM, 2))
    fixed = table.copy()
    fixed.flags.writeable = False
    expected = stack(*np.ascontiguousarray(table.T))
    assert stack(table[:, 0], table[:, 1]).tolist() == expected.tolist()
    assert stack(fixed[::-1, 0], fixed[::-1, 1]).tolist() == expected[::-1].tolist()
    assert stack(np.broadcast_to(0.5, 600), np.broadcast_to(0.5, 600)).shape == (600, 2)


def test_a_stack_of_none_has_no_rows():
    assert jit.batched(two_values, outputs=2)(np.empty(0), np.empty(0)).shape == (0, 2)


def test_without_numba_the_same_numbers_come_more_slowly(monkeypatch):
    p = np.linspace(0, 1, jit.COMPILE_FROM + 1)
    compiled = jit.batched(two_values, outputs=2)(p, p)
    monkeypatch.setattr(jit, "has_numba", lambda: False)
    assert jit.batched(two_values, outputs=2)(p, p).tolist() == compiled.tolist()


def doubles(values):
    """A kernel that works on an array in place."""
    for i in range(values.shape[0]):
        values[i] *= 2.0


def test_small_work_runs_plain_until_the_kernel_is_compiled():
    signature = "void(float64[::1])"
    assert jit.compiled(doubles, signature, large=False) is doubles
    quick = jit.compiled(doubles, signature)
    assert quick is not doubles
    assert jit.compiled(doubles, signature, large=False) is quick
    values = np.arange(3.0)
    quick(values)
    assert values.tolist() == [0.0, 2.0, 4.0]


@pytest.mark.slow
def test_an_edited_kernel_is_not_served_stale(tmp_path, monkeypatch):
    count = jit.COMPILE_FROM
    for factor in (2, 3):
        path = tmp_path / f"version{factor}.py"
        path.write_text(f"def kernel(p):\n    return ({factor} * p,)\n")
        scope: dict = {}
        exec(compile(path.read_text(), str(path), "exec"), scope)
        assert jit.batched(scope["kernel"], outputs=1)(np.ones(count))[0, 0] == factor


TABLE = [1.0, 2.0]


def looks_up(p):
    return (p * TABLE[0],)


def test_a_kernel_may_use_numbers_and_functions_only():
    with pytest.raises(TypeError, match="looks_up uses TABLE"):
        jit.batched(looks_up, outputs=1)(np.ones(jit.COMPILE_FROM))


def test_two_things_of_one_name_do_not_meet_in_one_kernel():
    """A compiled kernel has one namespace, whereas plain Python modules have one each; clashes are errors."""

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
        with pytest.raises(TypeError, match=f"^f uses two different .* called {clash}"):
            jit.batched(kernel, outputs=1)(np.ones(jit.COMPILE_FROM))


HALF = 0.5


def test_the_identity_of_a_kernel_is_what_it_computes(monkeypatch):
    def defined(text):
        scope = {"HALF": HALF}
        exec(text, scope)
        return closure_of(scope["f"]).identity

    texts = ["return sum([HALF * k for k in p])", "return sum([2.0 * k for k in p])", "return p * HALF"]
    kernels = [f"def f(p):\n    {text}" for text in texts]
    kernels += ["def f(p, q=1.0):\n    return p", "def f(p, q=2.0):\n    return p"]
    assert len({*map(defined, kernels)}) == len(kernels)
    assert defined(kernels[0]) == defined("\n\n\n" + kernels[0])
    monkeypatch.setitem(globals(), "HALF", 0.25)
    before = defined(kernels[0])
    monkeypatch.undo()
    assert defined(kernels[0]) != before


def power_and_sum(p):
    return p**1.5, p + 1.0


def test_a_root_of_a_negative_number_is_nan_as_in_compiled_code():
    plain = jit.batched(power_and_sum, outputs=2)
    np.testing.assert_array_equal(plain(np.array([4.0, -4.0])), [[8.0, 5.0], [np.nan, -3.0]])
    np.testing.assert_array_equal(plain.one(-4.0), [np.nan, -3.0])
