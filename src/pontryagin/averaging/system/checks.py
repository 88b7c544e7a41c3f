"""Checks of a phase system: symbols known, rates affine in the control, periodic in the anomaly."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import sympy as sp

from pontryagin.arrays import Array
from pontryagin.averaging.system.control_checks import Numbers, listed
from pontryagin.averaging.system.expressions import real_expression
from pontryagin.averaging.system.model import PERIODIC
from pontryagin.averaging.system.standard_form import StandardForm
from pontryagin.errors import ArgumentTypeError, ArgumentValueError
from pontryagin.numerics import compile as compiler
from pontryagin.validation import common_shape, finite

SAMPLES = 48
"""Number of random points at which an expression and its value a turn later are compared."""
MOST = 4_000_000
"""Largest number of points in all members of a stack; each member has four at least."""


def checked(system: StandardForm) -> dict[str, object]:
    """The fields of a system as SymPy expressions and arrays; an invalid field raises an error naming it."""
    slow = _symbols("slow", system.slow)
    control = _symbols("control", system.control)
    (phase,) = _symbols("phase", [system.phase])
    numbers = _numbers(system.numbers, {*slow, *control, phase})
    parameters = set(numbers)
    if len({*slow, *control, phase}) < len(slow) + len(control) + 1:
        repeated = {s for s in (*slow, *control, phase) if (*slow, *control, phase).count(s) > 1}
        raise ArgumentValueError(
            f"slow, control and phase must be different symbols, got {listed(repeated)} more than once",
            "slow",
        )

    in_slow = {*slow} | parameters
    in_phase = in_slow | {phase}
    everywhere = in_phase | {*control}
    f = tuple(_expression(f"f[{i}]", e, everywhere) for i, e in enumerate(_sequence("f", system.f)))
    if len(f) != len(slow):
        raise ArgumentValueError(
            f"f must hold one rate for each of {len(slow)} slow variables, got {len(f)}", "f"
        )
    target = tuple(
        _expression(f"target[{i}]", e, in_slow) for i, e in enumerate(_sequence("target", system.target))
    )
    if not 1 <= len(target) <= len(slow):
        raise ArgumentValueError(
            f"target must hold 1 to {len(slow)} expressions, got {len(target)}", "target"
        )
    scalars = {
        "running_cost": _expression("running_cost", system.running_cost, in_phase),
        "terminal_cost": _expression("terminal_cost", system.terminal_cost, in_slow),
        "phase_rate": _expression("phase_rate", system.phase_rate, everywhere),
        "weight": _expression("weight", system.weight, in_phase),
    }
    frequencies = _frequencies(system, in_slow, in_phase)

    for name, expression in [(f"f[{i}]", e) for i, e in enumerate(f)] + [
        ("phase_rate", scalars["phase_rate"])
    ]:
        _require_affine(name, expression, control)
    periodic = {f"f[{i}]": e for i, e in enumerate(f)} | scalars | frequencies
    for name, expression in periodic.items():
        if expression is not None:
            require_periodic(name, expression, phase, numbers)
    if isinstance(system.control_set, type) or not hasattr(system.control_set, "require_convex"):
        raise ArgumentTypeError(
            f"control_set must be a set of controls like Quadratic() or Ball(1), got {system.control_set!r}",
            "control_set",
        )
    system.control_set.require_convex(len(control), numbers)
    return {
        "f": f,
        "slow": slow,
        "control": control,
        "target": target,
        "numbers": numbers,
        **scalars,
        **frequencies,
    }


def _sequence(name: str, value: Any) -> list[Any]:
    if (
        isinstance(value, str | bytes)
        or not hasattr(value, "__iter__")
        or getattr(value, "shape", None) == ()
    ):
        raise ArgumentTypeError(f"{name} must be a sequence such as a list, got {value!r}", name)
    return list(value)


def _symbols(name: str, values: object) -> tuple[sp.Symbol, ...]:
    symbols = tuple(_sequence(name, values))
    if not symbols:
        raise ArgumentValueError(f"{name} must hold at least one symbol, got none", name)
    for symbol in symbols:
        if not isinstance(symbol, sp.Symbol):
            raise ArgumentTypeError(f"{name} must hold SymPy symbols, got {symbol!r}", name)
        if not symbol.is_real:
            raise ArgumentValueError(
                f"{name} must hold real symbols: write sympy.Symbol({str(symbol)!r}, real=True), "
                f"got {symbol}, which is not declared real",
                name,
            )
    return symbols


def _numbers(values: object, taken: set[sp.Symbol]) -> dict[sp.Symbol, Array]:
    if not isinstance(values, Mapping):
        raise ArgumentTypeError(
            f"numbers must map symbols to numbers, as a dict does, got {values!r}", "numbers"
        )
    if values:
        _symbols("numbers", values)
    both = taken & set(values)
    if both:
        raise ArgumentValueError(
            f"numbers must not hold slow, control or phase symbols, got {listed(both)}", "numbers"
        )
    numbers = {symbol: finite(str(symbol), value, "a number or an array") for symbol, value in values.items()}
    common_shape(**{str(symbol): array.shape for symbol, array in numbers.items()})
    return numbers


def _expression(name: str, value: object, known: set[sp.Symbol]) -> sp.Expr:
    expression = real_expression(name, value)
    unknown = expression.free_symbols - known
    if unknown:
        raise ArgumentValueError(
            f"{name} holds unknown symbols {listed(unknown)}; it may hold {listed(known)} "
            f"(symbols of the same name differ if one is declared real and the other is not)",
            name.partition("[")[0],
        )
    return expression


def _frequencies(
    system: StandardForm, in_slow: set[sp.Symbol], in_phase: set[sp.Symbol]
) -> dict[str, sp.Expr | None]:
    if (system.omega is None) == (system.anomaly_rate is None):
        got = "neither" if system.omega is None else "both"
        raise ArgumentValueError(f"exactly one of omega and anomaly_rate must be given, got {got}", "omega")
    if system.omega is None:
        if real_expression("weight", system.weight) != 1:
            raise ArgumentValueError(
                f"weight must not be given where anomaly_rate is, which determines it, got {system.weight}",
                "weight",
            )
        rate = _expression("anomaly_rate", system.anomaly_rate, in_phase)
        result: dict[str, sp.Expr | None] = {"omega": None, "anomaly_rate": rate}
    else:
        rate = _expression("omega", system.omega, in_slow)
        result = {"omega": rate, "anomaly_rate": None}
    if rate.is_nonpositive:
        name = "anomaly_rate" if system.omega is None else "omega"
        raise ArgumentValueError(f"{name} must be positive, got {rate}", name)
    return result


def _require_affine(name: str, expression: sp.Expr, control: Sequence[sp.Symbol]) -> None:
    for first in control:
        slope = sp.diff(expression, first)
        if slope.has(*control) and sp.simplify(slope).has(*control):
            message = f"{name} must be affine in the control, got one whose derivative in {first} is {slope}"
            raise ArgumentValueError(message, name.partition("[")[0])


def require_periodic(name: str, expression: sp.Expr, phase: sp.Symbol, numbers: Numbers) -> None:
    """Raise ValueError unless an expression is 2 pi-periodic in the anomaly `phase`.

    SymPy decides by the expression's form where it can; otherwise values at random points where the
    expression is defined are compared, for every member of a stack.
    """
    change = expression.subs(phase, phase + 2 * sp.pi) - expression
    if change == 0:
        return
    symbols = sorted(expression.free_symbols - set(numbers), key=str)
    parameters = sorted(expression.free_symbols & set(numbers), key=str)
    constants = np.broadcast_arrays(*(numbers[symbol] for symbol in parameters))
    members = [np.ravel(constant)[:, None] for constant in constants]
    evaluate = compiler.function("change", [*symbols, *parameters], {"change": change, "value": expression})
    with np.errstate(all="ignore"):
        fewer = max(4, MOST // max((member.size for member in members), default=1))
        difference, value = evaluate(*_points(len(symbols))[:, :fewer], *members)
        wrong = np.abs(difference) > PERIODIC * (1 + np.abs(value))
    if (wrong & np.isfinite(difference)).any():
        message = f"{name} must be 2 pi-periodic in {phase}, got {expression}"
        raise ArgumentValueError(message, name.partition("[")[0])


def _points(count: int) -> Array:
    """Random values of so many variables, (count, k): of both signs, of sizes about 0.1, 1 and 10."""
    rng = np.random.default_rng(1977)
    shape = (count, SAMPLES)
    signs, sizes = rng.choice([-1.0, 1.0], shape), 10.0 ** rng.uniform(-1.5, 1.5, shape)
    near_one = rng.uniform(0.5, 1.5, (count, SAMPLES // 4))
    return np.concatenate([near_one, signs * sizes], axis=1)
