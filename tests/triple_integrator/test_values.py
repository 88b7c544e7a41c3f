"""Problems and solutions as values: they pickle, copy, compare and hash, and their arrays are read-only."""

import copy
import io
import marshal
import pickle
import threading
from dataclasses import fields
from types import FunctionType

import cloudpickle
import numpy as np
import pytest
import sympy as sp

from pontryagin.triple_integrator import (
    Maneuver,
    maximum_entropy,
    minimum_energy,
    minimum_impulse,
    minimum_norm,
    minimum_peak,
    minimum_time,
)
from pontryagin.triple_integrator.attitude import RigidBody, turn
from pontryagin.triple_integrator.coupling import couple
from pontryagin.triple_integrator.least_time import arrival
from pontryagin.triple_integrator.norms import energy, impulse, peak
from pontryagin.triple_integrator.problem import maneuver
from pontryagin.triple_integrator.search import search

BODY = [[4.0, 0.3, -0.2], [0.3, 3.0, 0.1], [-0.2, 0.1, 2.0]]


def single(disturbance=None):
    return Maneuver([0, 0, 0], [1, 3, 6], tf=1.0, disturbance=disturbance)


def stack():
    return Maneuver([[0, 0, 0], [1, 0, 0]], [1, 3, 6], tf=[1.0, 2.0], disturbance=[0.0, 0.1])


def coupled():
    return couple(RigidBody(BODY), [Maneuver([0, 0, 0], [a, 0, 0], 2.0) for a in (0.1, 0.2, 0)], minimum_peak)


VALUES = {
    "manoeuvre": single,
    "manoeuvre under a constant": lambda: single(0.25),
    "manoeuvre under a function": lambda: single(np.sin),
    "manoeuvre under an expression": lambda: single(sp.sin(sp.Symbol("t"))),
    "stack": stack,
    "energy": lambda: minimum_energy(stack()),
    "peak": lambda: minimum_peak(stack()),
    "impulse": lambda: minimum_impulse(stack()),
    "norm": lambda: minimum_norm(single(), 3.0),
    "entropy": lambda: maximum_entropy(single()),
    "time": lambda: minimum_time([0, 0, 0], [1, 0, 0], [2.0, 3.0]),
    "rigid body": lambda: RigidBody(BODY),
    "turn": lambda: turn(RigidBody(BODY), [1, 2, 2], minimum_peak(Maneuver([0, 0, 0], [1, 0, 0], 2.0))),
    "coupled channels": coupled,
    "search": lambda: search(single(), "zeros"),
}


def arrays(value):
    """The arrays in the fields and the cached properties of a value, with their names."""
    for name, held in vars(value).items():
        if isinstance(held, np.ndarray):
            yield name, held
        elif hasattr(held, "__dataclass_fields__"):
            yield from arrays(held)


@pytest.mark.slow
@pytest.mark.parametrize("make", VALUES.values(), ids=VALUES)
def test_they_survive_copies_and_pickles_and_are_told_apart_by_value(make):
    one = make()
    for again in (copy.copy(one), copy.deepcopy(one), pickle.loads(pickle.dumps(one)), make()):
        assert again is not one
        assert again == one
        assert hash(again) == hash(one)
        assert not any(held.flags.writeable for _, held in arrays(again))
    assert one != single(0.125)


@pytest.mark.slow
@pytest.mark.parametrize("make", VALUES.values(), ids=VALUES)
def test_no_array_can_be_changed(make):
    one = make()
    for name in ("switch_times", "impulse_times", "multipliers", "moments", "principal_moments"):
        if name in dir(one):
            getattr(one, name)
    for name, held in arrays(one):
        with pytest.raises(ValueError, match="read-only"):
            held[...] = 0
        assert not held.flags.writeable, name


@pytest.mark.parametrize("solve", [minimum_energy, minimum_peak, minimum_impulse])
def test_other_numbers_make_another_value(solve):
    assert solve(single()) != solve(single(0.1))
    assert solve(single()) != single()
    assert Maneuver([0, 0, 0], [1, 0, 0], 1.0) != Maneuver([0, 0, 0], [1, 0, 0], 2.0)


def test_plain_pickle_refuses_a_lambda_and_names_the_argument():
    for value in (single(lambda t: t), minimum_energy(single(lambda t: t))):
        with pytest.raises(pickle.PicklingError, match="disturbance: pickle takes no lambda"):
            pickle.dumps(value)


class ByValue(pickle.Pickler):
    """A pickler that pickles functions by value, as cloudpickle does."""

    def reducer_override(self, obj):
        if not isinstance(obj, FunctionType) or obj is rebuilt:
            return NotImplemented
        return rebuilt, (marshal.dumps(obj.__code__), obj.__qualname__)


def rebuilt(code, name):
    """The inverse of `ByValue` for functions of their arguments alone."""
    function = FunctionType(marshal.loads(code), globals())
    function.__qualname__ = name
    return function


def by_value(value):
    file = io.BytesIO()
    ByValue(file).dump(value)
    return file.getvalue()


def by_cloudpickle(value):
    return cloudpickle.dumps(value)


@pytest.mark.parametrize("dumps", [by_value, by_cloudpickle])
def test_picklers_by_value_carry_a_lambda(dumps):
    given = single(lambda t: 2 * t)
    carried = pickle.loads(dumps(minimum_energy(given))).maneuver
    assert carried.disturbance(3.0) == 6.0
    assert carried.disturbance.__qualname__ == given.disturbance.__qualname__
    assert carried.moments.tolist() == given.moments.tolist()


ALONE = {
    "energy": lambda: minimum_energy(single()),
    "peak": lambda: minimum_peak(single()),
    "impulse": lambda: minimum_impulse(single(0.25)),
    "time": lambda: minimum_time([0, 0, 0], [1, 2, 3], 2.0, 0.5),
    "manoeuvre": lambda: single(2),
}


@pytest.mark.parametrize("make", ALONE.values(), ids=ALONE)
def test_native_code_and_the_source_make_equal_values(make, monkeypatch):
    """A value of native code makes its fields when they are read, in whatever order."""
    solvers = [part.solve_stack for part in (peak, energy, impulse, arrival)] + [maneuver.one_maneuver]
    assert all(solver._start() for solver in solvers)
    native = make()
    assert "x0" not in vars(vars(native).get("maneuver", native))
    for solver in solvers:
        monkeypatch.setattr(solver, "call", lambda *_: None)
    plain = make()
    assert plain == native and hash(plain) == hash(native) and repr(plain) == repr(native)
    for name in (field.name for field in fields(plain)):
        monkeypatch.undo()
        one, other = getattr(make(), name), getattr(plain, name)
        assert one == other if name == "certificate" else np.array_equal(one, other)
        assert type(one) is type(other) and np.shape(one) == np.shape(other)
    assert pickle.loads(pickle.dumps(make())) == plain == copy.copy(make()) == copy.deepcopy(make())
    with pytest.raises(AttributeError, match=f"'{type(native).__name__}' object has no attribute 'colour'"):
        make().colour  # noqa: B018


def test_threads_read_the_same_fields():
    maneuver.one_maneuver._start()
    values = [single() for _ in range(200)]
    held = [[] for _ in values]
    barrier = threading.Barrier(4)

    def read():
        for value, seen in zip(values, held, strict=True):
            barrier.wait()
            seen.append(value.x0)

    threads = [threading.Thread(target=read) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(len({id(array) for array in seen}) == 1 for seen in held)


def test_a_copy_keeps_the_function():
    given = single(lambda t: t)
    assert copy.deepcopy(given).disturbance is given.disturbance
    assert copy.deepcopy(minimum_peak(given)) == minimum_peak(given)
