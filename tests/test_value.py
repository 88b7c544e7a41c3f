"""Value classes compare, hash, pickle and copy by value, and their arrays are read-only."""

import copy
import operator
import pickle
from collections.abc import Callable, Mapping
from dataclasses import FrozenInstanceError, dataclass, field, replace
from functools import cached_property, partial
from inspect import signature
from typing import Any

import numpy as np
import pytest
import sympy as sp

from pontryagin.value import value_class

x = sp.Symbol("x", real=True)


@dataclass(frozen=True)
class Plain:
    level: np.ndarray


@value_class
@dataclass(frozen=True, eq=False)
class Inner:
    """A value with an array, for use as a field of another value."""

    level: np.ndarray


@value_class
@dataclass(frozen=True, eq=False)
class Outer:
    """A value with one field of each kind."""

    level: Any = 0.0
    inner: Inner | Plain = field(default_factory=lambda: Inner(np.arange(3.0)))
    parts: tuple = ()
    numbers: Mapping = field(default_factory=dict)
    force: Callable | None = None
    formula: sp.Expr | None = None
    note: str = field(default="", compare=False)
    serial: int = field(default=7, init=False)

    @cached_property
    def doubled(self) -> tuple[np.ndarray, np.ndarray]:
        """Arrays that are computed once and cached."""
        return self.inner.level * 2, np.zeros(2)


def full(level=1.5):
    return Outer(
        np.array([level, np.nan]),
        Plain(np.arange(2.0)),
        (np.eye(2), "name", [1, np.array(["a", None], dtype=object)]),
        {x: np.array(2.0)},
        partial(operator.add, np.ones(2)),
        x**2,
    )


def with_matrix():
    return Outer(formula=sp.Matrix([x, 1]), parts=(float("nan"),), force=len)


again = pytest.mark.parametrize(
    "again", [copy.copy, copy.deepcopy, lambda one: pickle.loads(pickle.dumps(one)), replace]
)


@again
@pytest.mark.parametrize("make", [Outer, full, with_matrix])
def test_equal_values_have_equal_hashes_and_survive(make, again):
    one = make()
    two = again(one)
    assert two is not one
    assert one == two == make()
    assert hash(one) == hash(two) == hash(make())
    assert {one: "found"}[two] == "found"


@pytest.mark.parametrize(
    "other",
    [
        replace(full(), level=np.array([1.5, 0.0])),
        replace(full(), level=np.array([[1.5, np.nan]])),
        replace(full(), level=np.array([1, 2])),
        replace(full(), level=None),
        replace(full(), inner=Plain(np.arange(3.0))),
        replace(full(), inner=Inner(np.arange(2.0))),
        replace(full(), parts=()),
        replace(full(), parts=(np.eye(2), "name", [1, np.array(["b", None], dtype=object)])),
        replace(full(), numbers={x: np.array(3.0)}),
        replace(full(), force=partial(operator.add, np.zeros(2))),
        replace(full(), force=lambda: 0.0),
        replace(full(), formula=x**3),
        full(2.5),
        Inner(np.arange(3.0)),
        "another type",
        None,
        np.zeros(2),
    ],
)
def test_one_field_or_another_class_makes_a_difference(other):
    assert not np.any(full() == other)
    assert np.all(full() != other)


def test_both_zeros_are_one_and_a_field_may_be_left_out_of_the_comparison():
    one, two = Outer(np.array([0.0, 1.0]), note="one"), Outer(np.array([-0.0, 1.0]), note="two")
    assert one == two and hash(one) == hash(two)


@again
def test_arrays_are_read_only(again):
    one = full()
    assert not one.doubled[0].flags.writeable
    two = again(one)
    assert "doubled" not in vars(two)
    for value in (one, two):
        arrays = [value.level, value.parts[0], value.numbers[x], *value.doubled]
        assert not any(array.flags.writeable for array in arrays)
        with pytest.raises(ValueError, match="read-only"):
            value.level[0] = 3.0


def test_an_array_is_not_copied():
    level = np.zeros(3)
    assert Inner(level).level is level


def test_its_fields_cannot_be_replaced():
    with pytest.raises(FrozenInstanceError):
        full().level = 1.0


def test_it_is_made_as_a_dataclass_is():
    assert str(signature(Inner)) == "(level: numpy.ndarray) -> None"
    assert Outer(inner=Inner(np.zeros(1))).inner == Inner(np.zeros(1))
    assert Outer().inner is not Outer().inner
    assert (Outer().serial, Outer().note) == (7, "")
    assert repr(Inner(np.zeros(1))) == "Inner(level=array([0.]))"
    with pytest.raises(TypeError, match="missing 1 required positional argument: 'level'"):
        Inner()


def test_what_is_checked_after_it_is_made_is_made_read_only_as_well():
    @value_class
    @dataclass(frozen=True, eq=False)
    class Checked:
        level: Any

        def __post_init__(self):
            self.__dict__["level"] = np.array(self.level)

    given = np.zeros(2)
    assert not Checked(given).level.flags.writeable
    assert given.flags.writeable


def test_a_class_keeps_what_it_defines_itself():
    @value_class
    @dataclass(frozen=True, eq=False)
    class Named:
        name: str

        def __eq__(self, other):
            return other == self.name

        def __hash__(self):
            return 3

    assert Named("one") == "one" and hash(Named("one")) == 3
