"""Invalid arguments are refused by messages that name the argument, the value given and what is expected."""

from fractions import Fraction

import numpy as np
import pytest
import sympy as sp

from pontryagin.validation import common_shape, finite, integer, positive, times, vectors


@pytest.mark.parametrize(
    ("value", "error", "got"),
    [
        ("abc", TypeError, "'abc'"),
        (None, TypeError, "None"),
        ([None, 1.0], TypeError, "None"),
        ([1j, 2.0], TypeError, "complex128"),
        ([True, False], TypeError, "bool"),
        ({}, TypeError, "{}"),
        ([sp.Symbol("x")], TypeError, "x"),
        ([[1.0], [1.0, 2.0]], ValueError, "ragged"),
        (np.nan, ValueError, "nan"),
        ([0.0, np.inf], ValueError, r"inf at index \(1,\)"),
        (np.r_[np.zeros(5), -np.inf], ValueError, r"-inf at index \(5,\)"),
    ],
)
def test_what_is_not_finite_numbers_is_refused(value, error, got):
    with pytest.raises(error, match=rf"^speed must be a number.*{got}"):
        finite("speed", value, "a number")


@pytest.mark.parametrize("value", [1, Fraction(1), sp.Integer(1), np.float32(1), np.int8(1), [[1]]])
def test_every_kind_of_number_becomes_a_float(value):
    array = finite("speed", value, "a number")
    assert array.dtype == float
    assert array.ravel().tolist() == [1.0]


def test_the_array_returned_is_not_the_one_given():
    given = np.ones(3)
    taken = finite("speed", given, "numbers")
    given[0] = 7.0
    assert taken[0] == 1.0


@pytest.mark.parametrize("value", [1.0, [1.0, 2.0], np.zeros((3, 2)), []])
def test_vectors_have_the_length_asked(value):
    with pytest.raises(ValueError, match=r"^x must be an array \(\.\.\., 3\), got shape"):
        vectors("x", value, 3)
    assert vectors("x", np.zeros((2, 0, 3)), 3).shape == (2, 0, 3)


@pytest.mark.parametrize("value", [0.0, -1.0, [1.0, 0.0]])
def test_positive_is_more_than_zero(value):
    with pytest.raises(ValueError, match=r"^peak must be positive, got (0|-1)"):
        positive("peak", value)


def test_times_outside_are_refused_and_rounding_is_not():
    start, end = np.array(1.0), np.array(3.0)
    assert times("t", [1 - 1e-15, 3 + 1e-15], start, end).tolist() == [1.0, 3.0]
    for outside in (0.999, 3.001):
        with pytest.raises(ValueError, match=rf"^t must lie between .* got {outside}"):
            times("t", [2.0, outside], start, end)


def test_times_are_checked_against_each_interval_of_a_stack():
    start, end = np.array([0.0, 1.0]), np.array([1.0, 2.0])
    with pytest.raises(ValueError, match="t must lie between"):
        times("t", [0.5], start, end)
    assert times("t", [[0.5], [1.5]], start, end).tolist() == [[0.5], [1.5]]
    with pytest.raises(
        ValueError, match=r"^t must be an array .* got shape \(3, 1\) for a stack of shape \(2,\)"
    ):
        times("t", [[0.0]] * 3, start, end)


def test_shapes_that_do_not_broadcast_are_named():
    assert common_shape(x0=(2, 1), xf=(3,)) == (2, 3)
    with pytest.raises(ValueError, match=r"^xf: .* x0 \(2,\), xf \(3,\), tf \(\)") as refused:
        common_shape(x0=(2,), xf=(3,), tf=())
    assert refused.value.argument == "xf"


@pytest.mark.parametrize(
    "refuse",
    [
        lambda: finite("speed", "abc", "a number"),
        lambda: finite("speed", [None], "a number"),
        lambda: finite("speed", [[1.0], []], "a number"),
        lambda: finite("speed", np.nan, "a number"),
        lambda: finite("speed", [10**400], "a number"),
        lambda: vectors("speed", [1.0], 3),
        lambda: integer("speed", 1.5),
        lambda: positive("speed", -1.0),
        lambda: times("speed", 2.0, np.array(0.0), np.array(1.0)),
        lambda: times("speed", [[0.0]] * 3, np.zeros(2), np.ones(2)),
    ],
)
def test_an_error_carries_the_argument_and_its_message_begins_with_it(refuse):
    with pytest.raises((ValueError, TypeError), match=r"^speed must .*, got") as refused:
        refuse()
    assert refused.value.argument == "speed"
