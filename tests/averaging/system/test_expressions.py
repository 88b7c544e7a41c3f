"""Text in place of expressions: refused, and not run, whatever it is wrapped in."""

import inspect
import sys
from contextlib import suppress

import numpy as np
import pytest
import sympy as sp

from pontryagin import averaging
from pontryagin.averaging import Ball, Custom, PhaseSystem, Quadratic, rotor
from pontryagin.averaging.system.expressions import expression
from pontryagin.triple_integrator import Maneuver, minimum_peak

a, x, u, t = sp.symbols("a x u t", real=True)
RAN: list[str] = []
"""Text that is run as code leaves a note here."""
TEXT = f"__import__('sys').modules[{__name__!r}].RAN.append('run')"
SYSTEM = {
    "f": [u],
    "omega": 1,
    "control_set": Quadratic(),
    "slow": [a],
    "control": [u],
    "phase": x,
    "target": [a - 2],
    "running_cost": 1,
    "terminal_cost": 0,
    "phase_rate": 0,
    "weight": 1,
    "numbers": {},
}


class Named:
    """An object whose text is code."""

    def __repr__(self):
        return TEXT


HOSTILE = {
    "text": TEXT,
    "bytes": TEXT.encode(),
    "text of NumPy": np.str_(TEXT),
    "list": [TEXT],
    "tuple": (TEXT,),
    "set": {TEXT},
    "dict": {TEXT: TEXT},
    "rows": [[TEXT, 0], [0, 1]],
    "array": np.array([TEXT]),
    "array of objects": np.array([TEXT], dtype=object),
    "number of objects": np.array(TEXT, dtype=object),
    "slice": slice(TEXT),
    "object": Named(),
    "function": sp.Function(TEXT)(x),
    "function of nothing": sp.Function(TEXT)(),
}


@pytest.fixture(autouse=True)
def text_is_not_run():
    assert sys.modules[__name__].RAN is RAN
    RAN.clear()
    yield
    assert RAN == []


def test_the_text_would_be_run_by_sympy():
    for name in ("text", "list", "tuple", "set", "dict", "array of objects"):
        RAN.clear()
        with suppress(AttributeError):
            sp.sympify(HOSTILE[name])
        assert RAN, name
    RAN.clear()


@pytest.mark.parametrize("name", [*SYSTEM, "anomaly_rate"])
def test_no_argument_of_a_phase_system_runs_text(name):
    given = {key: value for key, value in SYSTEM.items() if name != "anomaly_rate" or key != "omega"}
    for hostile in HOSTILE.values():
        for value in (hostile, [hostile]):
            with pytest.raises((TypeError, ValueError)) as refused:
                PhaseSystem(**given | {name: value})
            assert hasattr(refused.value, "argument")


@pytest.mark.parametrize("name", ["Quadratic", "Ball", "Ellipsoid", "Box", "BoundedQuadratic", "Custom"])
def test_no_control_set_runs_text(name):
    control_set = getattr(averaging, name)
    for argument in inspect.signature(control_set).parameters:
        for hostile in HOSTILE.values():
            for value in (hostile, [hostile]):
                with pytest.raises((TypeError, ValueError)) as refused:
                    control_set(**{argument: value})
                assert refused.value.argument == argument


@pytest.mark.parametrize("control_set", [Quadratic(), Ball(), Custom(lambda s: sp.Abs(s[0]))])
def test_no_method_of_a_control_set_runs_text(control_set):
    for hostile in HOSTILE.values():
        for method in (control_set.support, control_set.maximiser):
            with pytest.raises((TypeError, ValueError)):
                method([hostile])


def test_what_a_support_function_returns_is_not_run():
    for hostile in HOSTILE.values():
        with pytest.raises((TypeError, ValueError), match="the support function's value"):
            PhaseSystem(**SYSTEM | {"control_set": Custom(lambda s, value=hostile: value)})


@pytest.mark.parametrize("name", ["mass", "potential", "force", "a0", "a1", "peak"])
def test_no_argument_of_the_rotor_runs_text(name):
    for hostile in HOSTILE.values():
        with pytest.raises((TypeError, ValueError), match=name):
            rotor(**{"a0": 1.0, "a1": 4.0, "peak": 1.0} | {name: hostile})


def test_a_disturbance_with_a_function_without_definition_is_refused():
    for function in (sp.Function(TEXT)(t), sp.Function(TEXT)()):
        with pytest.raises(ValueError, match="disturbance"):
            minimum_peak(Maneuver([0, 0, 0], [1, 0, 0], 1.0, disturbance=function))


@pytest.mark.parametrize("number", [2, 0.5, np.float32(0.5), np.int64(2), sp.Rational(1, 2), a + 1])
def test_numbers_and_expressions_are_taken(number):
    assert expression("mass", number) == sp.sympify(number)
    assert expression("mass", np.array(number)) == sp.sympify(number)


@pytest.mark.parametrize(
    "function",
    [
        sp.floor(x),
        sp.frac(x),
        sp.DiracDelta(x),
        sp.erf(x),
        sp.gamma(x),
        sp.Integral(sp.sin(x * t), (t, 0, 1)),
    ],
    ids=str,
)
def test_what_numpy_does_not_evaluate_is_refused_by_name(function):
    with pytest.raises(ValueError, match=r"f\[0\] holds .*, which NumPy does not evaluate"):
        PhaseSystem(**SYSTEM | {"f": [u + function]})


def test_a_step_is_written_with_a_sign():
    assert expression("f", 2 * sp.Heaviside(x)) == 1 + sp.sign(x)
    assert expression("f", sp.Heaviside(x, 0)) == (1 + sp.sign(x)) / 2
