"""Problems and solutions are values: they pickle, copy, compare and hash, and their arrays are read-only."""

import copy
import inspect
import math
import pickle
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from functools import cache
from typing import Any

import numpy as np
import pytest
import sympy as sp

from pontryagin import averaging, orbit_correction, rendezvous, triple_integrator
from pontryagin.certificate import Certificate, MaximumPrinciple

TARGET = rendezvous.Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6)
CHASER = rendezvous.Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0])
LEAP = rendezvous.Rendezvous(CHASER, TARGET, time_weight=0, energy_weight=1, peak=math.inf, duration=6.0)
MANEUVER = triple_integrator.Maneuver([0, 0, 0], [1, 0.25, 0], 2.0, disturbance=0.1)
STACK = triple_integrator.Maneuver([0, 0, 0], [[1, 0, 0], [0, 0, 0]], [2.0, 3.0])
STATE = [-0.0037787, -0.0039109, 0.0141512]

MADE = {
    "Maneuver": lambda: MANEUVER,
    "a stack": lambda: STACK,
    "a formula": lambda: triple_integrator.Maneuver([0, 0, 0], [1, 0, 0], 2.0, disturbance=sp.Symbol("t")),
    "EnergySolution": lambda: triple_integrator.minimum_energy(STACK),
    "PeakSolution": lambda: triple_integrator.minimum_peak(MANEUVER),
    "ImpulseSolution": lambda: triple_integrator.minimum_impulse(STACK),
    "NormSolution": lambda: triple_integrator.minimum_norm(MANEUVER, 3),
    "TimeSolution": lambda: triple_integrator.minimum_time([0, 0, 0], [1, 0, 0], peak=1.0),
    "EntropySolution": lambda: triple_integrator.maximum_entropy(
        triple_integrator.Maneuver([0, 0, 0], [1, 2.2, 3], 2.0)
    ),
    "Plan": lambda: orbit_correction.correct(STATE),
    "DiscreteSystem": lambda: orbit_correction.DiscreteSystem(np.eye(2), [[1, 0], [0, 2]]),
    "Gauge": lambda: orbit_correction.gauge(orbit_correction.DiscreteSystem(np.eye(2), np.eye(2)), [3, 4], 9),
    "Quadratic": lambda: averaging.Quadratic(2),
    "Ball": lambda: averaging.Ball(),
    "Ellipsoid": lambda: averaging.Ellipsoid((1, 2)),
    "Box": lambda: averaging.Box((1, 2)),
    "AveragedSolution": lambda: averaging.smooth_example(1.0, [0.5, 0.25]),
    "Extremal of averaging": lambda: averaging.smooth_example(1.0, 0.5).exact(0.1)[0],
    "Orbit": lambda: TARGET,
    "Chaser": lambda: CHASER,
    "Rendezvous": lambda: LEAP,
    "Elements": lambda: rendezvous.Elements.from_state([1.0, 0, 0], [0.0, 1, 0]),
    "Extremal": lambda: rendezvous.solve(LEAP),
    "RendezvousCertificate": lambda: solved("Extremal").certificate,
    "ElementsExtremal": lambda: rendezvous.solve_in_elements(LEAP),
    "ElementsCertificate": lambda: solved("ElementsExtremal").certificate,
    "Certificate": lambda: Certificate(np.zeros(2), np.ones(2), np.array([1.0, np.nan])),
    "MaximumPrinciple": lambda: MaximumPrinciple(*np.zeros((4, 2))),
}


@cache
def solved(name: str) -> Any:
    return MADE[name]()


def arrays(value: Any) -> Iterator[np.ndarray]:
    """All arrays in a value: in its fields, tuples, mappings and cached properties."""
    if isinstance(value, np.ndarray):
        yield value
    elif isinstance(value, dict):
        yield from (array for entry in value.values() for array in arrays(entry))
    elif isinstance(value, tuple):
        yield from (array for entry in value for array in arrays(entry))
    elif is_dataclass(value) and not isinstance(value, type):
        yield from (array for field in fields(value) for array in arrays(getattr(value, field.name)))
        kept = getattr(value, "__dict__", {})
        yield from (array for entry in kept.values() if not is_dataclass(entry) for array in arrays(entry))


def read_everything(value: Any) -> None:
    """Read every cached property, so that it is computed."""
    for name, _ in inspect.getmembers(type(value), lambda member: hasattr(member, "attrname")):
        getattr(value, name)


@pytest.mark.slow
@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda one: pickle.loads(pickle.dumps(one))])
@pytest.mark.parametrize("name", MADE)
def test_copies_and_pickles_are_equal(name, again):
    one = solved(name)
    two = again(one)
    assert two == one and hash(two) == hash(one)
    assert one != name and one != np.zeros(2).tolist()
    assert not any(array.flags.writeable for array in arrays(two))


@pytest.mark.parametrize("name", MADE)
def test_arrays_are_read_only(name):
    one = solved(name)
    read_everything(one)
    assert not any(array.flags.writeable for array in arrays(one))


def test_solved_twice_is_equal():
    for name in ("PeakSolution", "NormSolution", "Plan", "Gauge"):
        assert MADE[name]() == solved(name) and hash(MADE[name]()) == hash(solved(name))
