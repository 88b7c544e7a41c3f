"""Problems and solutions are values: they pickle, copy, compare and hash, and their arrays are read-only."""

import copy
import inspect
import math
import pickle
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from functools import cache
from typing import Any

import cloudpickle
import numpy as np
import pytest
import sympy as sp

from pontryagin import averaging, orbit_correction, rendezvous, triple_integrator
from pontryagin.certificate import Certificate, MaximumPrinciple
from pontryagin.triple_integrator import attitude, coupling, search
from pontryagin.triple_integrator.figures.coupling import Attempt
from public import public_classes

TARGET = rendezvous.Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6)
CHASER = rendezvous.Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0])
LEAP = rendezvous.Rendezvous(CHASER, TARGET, time_weight=0, energy_weight=1, peak=math.inf, duration=6.0)
MEETING = rendezvous.Rendezvous(CHASER, TARGET, time_weight=0.1, energy_weight=1, peak=math.inf)
STARTS = 0.1 * np.random.default_rng(1).standard_normal((8, 6))
MANEUVER = triple_integrator.Maneuver([0, 0, 0], [1, 0.25, 0], 2.0, disturbance=0.1)
STACK = triple_integrator.Maneuver([0, 0, 0], [[1, 0, 0], [0, 0, 0]], [2.0, 3.0])
STATE = [-0.0037787, -0.0039109, 0.0141512]
SYSTEM = orbit_correction.DiscreteSystem([np.eye(2), 2 * np.eye(2)], np.eye(2))
BODY = attitude.RigidBody([[4.0, 0.3, -0.2], [0.3, 3.0, 0.1], [-0.2, 0.1, 2.0]])
x, a, u = sp.symbols("x a u", real=True)


def diamond(s):
    """The support function of the square |u_i| <= 1."""
    return sp.Add(*map(sp.Abs, s))


def resting(t, z):
    """Commands that do not change."""
    return np.zeros_like(z)


def grown(k):
    """The identity, which grows with k."""
    return (1 + k) * np.eye(2)


def pushed(control_set):
    """A slow variable pushed by one control."""
    return averaging.PhaseSystem(
        [u], sp.exp(a), control_set, slow=[a], control=[u], phase=x, target=[a - 2], numbers={}
    )


def coupled():
    """Three coupled channels of a body."""
    ends = (triple_integrator.Maneuver([0, 0, 0], [angle, 0, 0], 2.0) for angle in (0.1, 0.2, 0.0))
    return coupling.couple(BODY, [*ends], triple_integrator.minimum_peak)


MADE = {
    "Maneuver": lambda: MANEUVER,
    "a stack": lambda: STACK,
    "a formula": lambda: triple_integrator.Maneuver([0, 0, 0], [1, 0, 0], 2.0, disturbance=sp.Symbol("t")),
    "a function": lambda: triple_integrator.Maneuver([0, 0, 0], [1, 3, 6], 1.0, disturbance=np.sin),
    "EnergySolution": lambda: triple_integrator.minimum_energy(STACK),
    "PeakSolution": lambda: triple_integrator.minimum_peak(MANEUVER),
    "ImpulseSolution": lambda: triple_integrator.minimum_impulse(STACK),
    "NormSolution": lambda: triple_integrator.minimum_norm(MANEUVER, 3),
    "Quadratic of norms": lambda: solved("NormSolution").shape,
    "TimeSolution": lambda: triple_integrator.minimum_time([0, 0, 0], [1, 0, 0], peak=1.0),
    "EntropySolution": lambda: triple_integrator.maximum_entropy(
        triple_integrator.Maneuver([0, 0, 0], [1, 2.2, 3], 2.0)
    ),
    "RigidBody": lambda: attitude.RigidBody(BODY.inertia),
    "Commands": lambda: attitude.Commands([0.0, 0.1], resting, [1.0, 1.0], [0.5], [(0.5, [0.0, 1.0])]),
    "Turn": lambda: attitude.turn(BODY, [1, 2, 2], solved("PeakSolution")),
    "Motion": lambda: MADE["Turn"]().motion,
    "CoupledManeuver": coupled,
    "Channels": lambda: coupling.Channels(BODY, solved("CoupledManeuver").programmes, (0, 1, 2)),
    "Coupling": lambda: solved("CoupledManeuver").programmes[0].maneuver.disturbance,
    "Attempt": lambda: Attempt(10.0, solved("CoupledManeuver"), ""),
    "SearchResult": lambda: search.search(MANEUVER, "zeros"),
    "Survey": lambda: search.survey(count=2),
    "Plan": lambda: orbit_correction.correct(STATE),
    "Thrust": lambda: solved("Plan").thrust,
    "a stack of plans": lambda: orbit_correction.correct([STATE, [0.0, 0.0, 0.0]]),
    "Alternative": lambda: orbit_correction.least_energy(orbit_correction.correct(STATE)),
    "DiscreteSystem": lambda: orbit_correction.DiscreteSystem([np.eye(2), 2 * np.eye(2)], np.eye(2)),
    "a stationary system": lambda: orbit_correction.DiscreteSystem(np.eye(2), [[1, 0], [0, 2]]),
    "a system of functions": lambda: orbit_correction.DiscreteSystem(grown, np.eye(2)),
    "Gauge": lambda: orbit_correction.gauge(SYSTEM, [3, 4], 2),
    "PowerGauge": lambda: orbit_correction.power_gauge(STATE, 4, 8),
    "Flight": lambda: orbit_correction.fly(STATE, [[0.0, 0.001]], 0.25),
    "ClosedLoop": lambda: orbit_correction.close_loop(STATE, thrust="box"),
    "Sweep": lambda: orbit_correction.intervals.sweep(STATE, [0.25, 2 * np.pi]),
    "Distribution": lambda: orbit_correction.impulse_distribution(1e-5 * np.eye(3), 5),
    "Waste": lambda: orbit_correction.count_impulses(STATE),
    "PhaseSystem": lambda: pushed(averaging.Custom(diamond)),
    "Quadratic": lambda: averaging.Quadratic(2),
    "a matrix": lambda: averaging.Quadratic(np.array([[2.0, 1.0], [1.0, 3.0]])),
    "Ball": lambda: averaging.Ball(),
    "Ellipsoid": lambda: averaging.Ellipsoid([1, 2]),
    "Box": lambda: averaging.Box([1, 2]),
    "BoundedQuadratic": lambda: averaging.BoundedQuadratic(1, sp.Rational(1, 2)),
    "Custom": lambda: averaging.Custom(diamond),
    "AveragedSolution": lambda: averaging.smooth_example(1.0, [0.5, 0.25]),
    "AveragedSolution of a system": lambda: averaging.solve_averaged(
        pushed(averaging.Custom(diamond)), [0.5]
    ),
    "AveragedCertificate": lambda: solved("AveragedSolution").certificate,
    "Extremals of averaging": lambda: averaging.smooth_example(1.0, 0.5).exact(0.1),
    "Extremal of averaging": lambda: solved("Extremals of averaging")[0],
    "Orbit": lambda: TARGET,
    "Chaser": lambda: CHASER,
    "Rendezvous": lambda: LEAP,
    "Scaled": lambda: MEETING.scaled,
    "Elements": lambda: rendezvous.Elements.from_state([1.0, 0, 0], [0.0, 1, 0]),
    "Extremal": lambda: rendezvous.solve(LEAP),
    "Flight of an Extremal": lambda: solved("Extremal").flight,
    "RendezvousCertificate": lambda: solved("Extremal").certificate,
    "ElementsExtremal": lambda: rendezvous.solve_in_elements(LEAP),
    "ElementFlight": lambda: solved("ElementsExtremal").flight,
    "ElementsCertificate": lambda: solved("ElementsExtremal").certificate,
    "Carried": lambda: rendezvous.carry(LEAP, STARTS),
    "FalseFamily": lambda: rendezvous.false_family(rendezvous.solve(MEETING), [0.0, 0.1]),
    "RotatedMeeting": lambda: solved("FalseFamily").members[1],
    "Root": lambda: solved("Extremal").root,
    "Search": lambda: solved("Extremal").searched,
    "Certificate": lambda: Certificate(np.zeros(2), np.ones(2), np.array([1.0, np.nan])),
    "MaximumPrinciple": lambda: MaximumPrinciple(*np.zeros((4, 2))),
}


DEAR = {"CoupledManeuver", "Channels", "Coupling", "Attempt", "FalseFamily", "RotatedMeeting"}
"""What takes more than about a second to make."""
QUICK_AND_DEAR = [pytest.param(name, marks=[pytest.mark.slow] if name in DEAR else []) for name in MADE]


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
def test_every_public_class_has_an_instance_here():
    missing = public_classes() - {type(solved(name)) for name in MADE}
    assert not missing


@pytest.mark.slow
@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda one: pickle.loads(pickle.dumps(one))])
@pytest.mark.parametrize("name", MADE)
def test_copies_and_pickles_are_equal(name, again):
    one = solved(name)
    two = again(one)
    assert two is not one and two == one and hash(two) == hash(one)
    assert one != name and one != np.zeros(2).tolist()
    assert not any(array.flags.writeable for array in arrays(two))


@pytest.mark.parametrize("name", QUICK_AND_DEAR)
def test_arrays_are_read_only(name):
    one = solved(name)
    read_everything(one)
    assert not any(array.flags.writeable for array in arrays(one))


@pytest.mark.slow
@pytest.mark.parametrize("name", MADE)
def test_made_twice_is_equal(name):
    one = MADE[name]()
    assert one == solved(name) and hash(one) == hash(solved(name))


@pytest.mark.parametrize(
    ("value", "argument"),
    [
        (averaging.Custom(lambda s: sp.Abs(s[0])), "Custom.of"),
        (pushed(averaging.Custom(lambda s: sp.Abs(s[0]))), "Custom.of"),
        (orbit_correction.DiscreteSystem(lambda k: np.eye(2), np.eye(2)), "DiscreteSystem.A"),
        (attitude.Commands([0.0], lambda t, z: z, [1.0]), "Commands.rate"),
        (
            triple_integrator.Maneuver([0, 0, 0], [1, 0, 0], 2.0, disturbance=lambda t: 2 * t),
            "Maneuver.disturbance",
        ),
    ],
)
def test_pickle_refuses_a_lambda_by_the_argument_and_cloudpickle_carries_it(value, argument):
    with pytest.raises(pickle.PicklingError, match=f"{argument}: pickle takes no lambda"):
        pickle.dumps(value)
    assert copy.deepcopy(value) == value
    carried = pickle.loads(cloudpickle.dumps(value))
    assert pickle.loads(cloudpickle.dumps(carried)) != carried != value
    assert repr(carried).partition(" at 0x")[0] == repr(value).partition(" at 0x")[0]
