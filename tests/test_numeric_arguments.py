"""Every numeric argument of every public function: what is no number is converted or refused by name."""

import importlib
import inspect
from datetime import timedelta
from decimal import Decimal
from fractions import Fraction
from functools import cache

import numpy as np
import pytest
import sympy as sp

from pontryagin.averaging import (
    Ball,
    BoundedQuadratic,
    Box,
    Ellipsoid,
    PhaseSystem,
    Quadratic,
    kepler,
    rotor,
    smooth_example,
    solve_averaged,
    spin_down,
)
from pontryagin.orbit_correction import (
    DiscreteSystem,
    close_loop,
    correct,
    count_impulses,
    fewest_power_steps,
    fly,
    gauge,
    impulse_distribution,
    power_gauge,
    random_states,
)
from pontryagin.rendezvous import (
    Chaser,
    Elements,
    Orbit,
    Rendezvous,
    carry,
    false_family,
    false_meeting,
    multistart,
    solve,
    solve_in_elements,
)
from pontryagin.rendezvous import least_fuel as fuel_in_elements
from pontryagin.triple_integrator import Maneuver, minimum_norm, minimum_peak, minimum_time
from pontryagin.triple_integrator.attitude import RigidBody, turn
from pontryagin.triple_integrator.coupling import spherical_factor
from test_bare_numbers import Length, Quantity

Z0, UNIT = [0.001, 0.002, -0.0015], [1.0, 0.0, 0.0, 0.0]


@cache
def held(name):
    """A problem or a solution that methods are called on."""
    turn = Maneuver([0, 0, 0], [1, 0.3, 0.2], 2.0)
    a, u, x = sp.symbols("a u x", real=True)
    system = {"control_set": Quadratic(), "slow": [a], "control": [u], "phase": x, "target": [a - 2]}
    target = Orbit(1.2, 0.05, UNIT, 0.5)
    makers = {
        "turn": lambda: turn,
        "peak": lambda: minimum_peak(turn),
        "norm": lambda: minimum_norm(turn, 3.0),
        "body": lambda: RigidBody(np.diag([2.0, 3.0, 4.0])),
        "rippled": lambda: smooth_example(1.0, 2.0, ripple=0.5),
        "extremal": lambda: held("rippled").exact(0.1, 0.0)[0],
        "system": lambda: PhaseSystem(f=[u], omega=1, **system),
        "discrete": lambda: DiscreteSystem(np.eye(2), np.eye(2)),
        "meeting": lambda: Rendezvous(Chaser(1.0, 0.0, 1.0, UNIT), target, peak=0.1),
        "timed": lambda: Rendezvous(
            Chaser(1.0, 0.0, 1.0, UNIT), target, energy_weight=1.0, peak=0.1, duration=4.0
        ),
        "met": lambda: solve(held("meeting")),
    }
    return makers[name]()


def scaled_system(weight, number):
    a, u, x, k = sp.symbols("a u x k", real=True)
    return PhaseSystem(
        f=[k * u],
        omega=1,
        control_set=Quadratic(),
        slow=[a],
        control=[u],
        phase=x,
        target=[a - 2],
        running_cost=weight,
        numbers={k: number},
    )


CALLS = {
    "Maneuver": (
        Maneuver,
        {"x0": [0.0, 0, 0], "xf": [1.0, 0, 0], "tf": 2.0, "t0": 0.5, "disturbance": 0.3, "edges": [1.0]},
    ),
    "Maneuver.times": (lambda t: held("turn").times(t), {"t": [0.5, 1.0]}),
    "Maneuver.drift": (lambda t: held("turn").drift(t), {"t": [0.5, 1.0]}),
    "minimum_norm": (lambda q: minimum_norm(held("turn"), q), {"q": 3.0}),
    "minimum_time": (
        minimum_time,
        {"x0": [0.0, 0, 0], "xf": [1.0, 0, 0], "peak": 2.0, "disturbance": 0.1},
    ),
    **{
        f"{name}.{method}": (lambda t, n=name, m=method: getattr(held(n), m)(t), {"t": [0.5, 1.0]})
        for name in ("peak", "norm", "met")
        for method in ("control", "state", "costate")
    },
    "attitude.RigidBody": (RigidBody, {"inertia": np.diag([2.0, 3.0, 4.0])}),
    "attitude.turn": (lambda axis: turn(held("body"), axis, held("peak")), {"axis": [1.0, 0, 0]}),
    "coupling.spherical_factor": (spherical_factor, {"angle": 0.3}),
    "DiscreteSystem": (DiscreteSystem, {"A": np.eye(2), "H": np.eye(2)}),
    "gauge": (lambda x0, steps: gauge(held("discrete"), x0, steps), {"x0": [1.0, 2.0], "steps": 3}),
    "correct": (correct, {"z0": Z0, "interval": 0.25, "peak": 0.0035}),
    "close_loop": (close_loop, {"z0": Z0, "interval": 0.25, "peak": 0.0035, "tolerance": 1e-10}),
    "count_impulses": (count_impulses, {"z0": Z0, "interval": 0.25, "peak": 0.0035}),
    "fewest_power_steps": (fewest_power_steps, {"z0": Z0, "p": 4.0, "interval": 0.25, "peak": 0.0035}),
    "power_gauge": (power_gauge, {"z0": Z0, "steps": 4, "p": 4.0, "interval": 0.25, "peak": 0.0035}),
    "fly": (fly, {"z0": Z0, "impulses": [[0.001, 0.001]], "interval": 0.25, "angle": 0.1}),
    "impulse_distribution": (
        impulse_distribution,
        {"covariance": 1e-6 * np.eye(3), "samples": 20, "interval": 0.25, "peak": 0.0035, "seed": 3},
    ),
    "random_states": (random_states, {"count": 5, "size": 0.01, "seed": 3}),
    "Ball": (Ball, {"radius": 2.0}),
    "BoundedQuadratic": (BoundedQuadratic, {"radius": 2.0, "weight": 3.0}),
    "Box": (Box, {"bounds": [1.0, 2.0]}),
    "Ellipsoid": (Ellipsoid, {"semiaxes": [1.0, 2.0]}),
    "Quadratic": (Quadratic, {"weight": 2.0}),
    "kepler": (kepler, {"E0": -0.5, "K0": 0.95, "E1": -0.35, "l": 0.1}),
    "rotor": (rotor, {"a0": 1.0, "a1": 4.0, "mass": 2.0, "potential": 0.5, "force": 0.1, "peak": 1.0}),
    "rotor, paid": (lambda k: rotor(1.0, 4.0, k=k), {"k": 1.0}),
    "smooth_example": (smooth_example, {"v0": 1.0, "v1": 2.0, "k": 1.0, "ripple": 0.1}),
    "solve_averaged": (
        lambda start, kappa: solve_averaged(held("system"), start, kappa=kappa),
        {"start": [1.0], "kappa": 0.1},
    ),
    "spin_down": (spin_down, {"omega0": [3.0, 4, 2], "semiaxes": [1.0, 1, 1], "ratio": 0.5}),
    "PhaseSystem": (
        lambda running_cost, k: scaled_system(running_cost, k),
        {"running_cost": 2.0, "k": 1.5},
    ),
    **{
        f"averaged.{method}": (lambda m=method, **given: getattr(held("rippled"), m)(**given), given)
        for method, given in {
            "slow": {"tau": [0.5]},
            "costate": {"tau": [0.5]},
            "frequency": {"tau": [0.5]},
            "mean_rate": {"tau": [0.5]},
            "phase": {"tau": [0.5], "epsilon": 0.1, "phase": 0.3},
            "anomaly": {"tau": [0.5], "epsilon": 0.1, "phase": 0.3},
            "control": {"tau": [0.5], "anomaly": [0.1]},
            "phase_of": {"tau": [0.5], "anomaly": [0.1]},
            "correction": {"phase": 0.3, "ending": 0.5},
            "exact": {"epsilon": 0.1, "phase": 0.3},
        }.items()
    },
    **{
        f"extremal.{method}": (lambda tau, m=method: getattr(held("extremal"), m)(tau), {"tau": [0.5]})
        for method in ("slow", "costate", "control")
    },
    "Chaser": (Chaser, {"r": 1.0, "v1": 0.1, "c": 1.0, "attitude": UNIT}),
    "Orbit": (Orbit, {"parameter": 1.2, "eccentricity": 0.1, "attitude": UNIT, "anomaly": 0.5}),
    "Orbit.from_angles": (
        Orbit.from_angles,
        {
            "parameter": 1.2,
            "eccentricity": 0.1,
            "node": 0.1,
            "inclination": 0.2,
            "pericentre": 0.3,
            "anomaly": 0.5,
        },
    ),
    "Rendezvous": (
        lambda **given: Rendezvous(held("meeting").chaser, held("meeting").target, **given),
        {"time_weight": 1.0, "energy_weight": 1.0, "peak": 0.1, "gravity": 2.0, "duration": 3.0},
    ),
    "Elements": (
        Elements,
        {"A": [0.3, 0.0, 0.0, 0.0], "B": [0.0, 0.0, 0.0, 0.0], "phi": 0.1, "gravity": 1.0},
    ),
    "carry": (
        lambda costates, durations: carry(held("meeting"), costates, durations),
        {"costates": np.ones((1, 6)), "durations": 1.0},
    ),
    "multistart": (lambda costates: multistart(held("timed"), costates), {"costates": np.ones((1, 6))}),
    "false_meeting": (lambda angle: false_meeting(held("meeting"), angle), {"angle": 0.1}),
    "false_family": (lambda angles: false_family(held("met"), angles), {"angles": [0.1]}),
    "least_fuel": (lambda revolutions: fuel_in_elements(held("timed"), revolutions), {"revolutions": 0}),
    "solve_in_elements": (
        lambda revolutions: solve_in_elements(held("timed"), revolutions=revolutions),
        {"revolutions": 0},
    ),
}
ARGUMENTS = [(name, argument) for name, (_, given) in CALLS.items() for argument in given]


def carriers(value):
    """Things that are no plain numbers, made like a value that is accepted."""
    array = np.asarray(value, dtype=float)
    spoiled = np.array(array)
    spoiled.flat[0] = np.nan
    mask = np.zeros(array.shape, dtype=bool)
    mask.flat[-1] = True
    text = np.vectorize(str)(array)
    return {
        "masked": np.ma.array(array, mask=mask),
        "masked in a list": [np.ma.masked] if array.ndim else np.ma.masked,
        "with a unit": array.view(Length),
        "quantity": Quantity(array),
        "nan": spoiled if array.ndim else float("nan"),
        "complex": array + 1j,
        "text": text.tolist(),
        "timedelta": array.astype("timedelta64[s]"),
        "datetime": np.full(array.shape, np.datetime64("2026-01-01")),
        "python's timedelta": timedelta(seconds=1),
        "boolean": array.astype(bool) if array.ndim else True,
        "nothing in a list": [None],
        "set": {1.0, 2.0, 3.0},
        "mapping": {"a": 1.0},
    }


@pytest.mark.parametrize(("name", "argument"), ARGUMENTS)
def test_what_is_no_plain_number_is_refused_by_name(name, argument):
    function, given = CALLS[name]
    for kind, carrier in carriers(given[argument]).items():
        with pytest.raises((TypeError, ValueError)) as caught:
            print(kind, function(**given | {argument: carrier}))
        assert getattr(caught.value, "argument", None) == argument, f"{kind}: {caught.value!r}"


NUMBERS = {
    "fractions": lambda x: Fraction(x),
    "decimals": lambda x: Decimal(repr(float(x))),
    "symbolic": lambda x: sp.Float(repr(float(x)), 30),
    "single precision": np.float32,
    "arrays": np.array,
}


def replaced(value, make):
    """The same value with its numbers as others."""
    if isinstance(value, np.ndarray | list):
        return [replaced(part, make) for part in value]
    return value if isinstance(value, int) else make(value)


@pytest.mark.slow
@pytest.mark.parametrize("name", CALLS)
def test_numbers_of_other_kinds_are_converted_or_refused_by_name(name):
    """Fractions, decimals and SymPy's numbers give what floats give, single precision to its own accuracy."""
    function, given = CALLS[name]
    for argument, value in given.items():
        if isinstance(value, int):
            continue
        for make in NUMBERS.values():
            try:
                function(**given | {argument: replaced(value, make)})
            except (TypeError, ValueError) as error:
                assert getattr(error, "argument", None) == argument, f"{error!r}"


def test_every_numeric_argument_of_a_public_function_is_tried():
    """What is left out takes objects of this package, functions, symbols, or words."""
    others = {"maneuver", "plan", "system", "problem", "solution", "start", "true", "of", "thrust", "verbose"}
    others |= {"f", "omega", "control_set", "slow", "control", "phase", "target", "numbers", "chaser"}
    others |= {"anomaly_rate", "weight", "running_cost", "terminal_cost", "phase_rate"}
    results = {"Gauge", "Plan", "AveragedSolution", "Carried", "ElementsExtremal", "Extremal"}
    results |= {"ElementsCertificate", "RendezvousCertificate"}
    tried = {(name.split(",")[0].split(".")[0], argument) for name, argument in ARGUMENTS}
    for paper in ("triple_integrator", "orbit_correction", "averaging", "rendezvous"):
        package = importlib.import_module(f"pontryagin.{paper}")
        for name in set(package.__all__) - results:
            thing = getattr(package, name)
            if callable(thing):
                for argument in inspect.signature(thing).parameters:
                    assert argument in others or (name, argument) in tried, f"{paper}.{name}: {argument}"


@pytest.mark.parametrize(
    "answer",
    [
        lambda t: np.asarray(t * 1.0).view(Length),
        Quantity,
        lambda t: np.ma.masked_greater(np.asarray(t) * 1.0, 0.5),
        lambda t: np.asarray(t * 10).astype("timedelta64[s]"),
        lambda t: t + 1j,
        lambda t: [str(t)],
    ],
)
def test_what_a_disturbance_returns_is_plain_numbers(answer):
    with pytest.raises((TypeError, ValueError)) as caught:
        Maneuver([0, 0, 0], [1, 0, 0], 2.0, disturbance=answer)
    assert caught.value.argument == "disturbance"
