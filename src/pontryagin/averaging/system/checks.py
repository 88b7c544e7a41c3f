"""What a `PhaseSystem` and its control set must satisfy, each refused by the name of its argument."""

from collections.abc import Mapping, Sequence

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from pontryagin.numerics import compile as compiler
from pontryagin.validation import common_shape, finite


def checked(system) -> dict[str, object]:
    """The arguments of a `PhaseSystem` as SymPy expressions and arrays, or the error that names one."""
    slow = _symbols("slow", system.slow)
    control = _symbols("control", system.control)
    (phase,) = _symbols("phase", [system.phase])
    numbers = _numbers(system.numbers, {*slow, *control, phase})
    parameters = set(numbers)
    if len({*slow, *control, phase}) < len(slow) + len(control) + 1:
        raise ValueError("slow, control and phase must be different symbols")

    in_slow = {*slow} | parameters
    in_phase = in_slow | {phase}
    everywhere = in_phase | {*control}
    f = tuple(_expression(f"f[{i}]", e, everywhere) for i, e in enumerate(_sequence("f", system.f)))
    if len(f) != len(slow):
        raise ValueError(f"f must hold one rate for each of {len(slow)} slow variables, got {len(f)}")
    target = tuple(
        _expression(f"target[{i}]", e, in_slow) for i, e in enumerate(_sequence("target", system.target))
    )
    if not 1 <= len(target) <= len(slow):
        raise ValueError(f"target must hold 1 to {len(slow)} expressions, got {len(target)}")
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
        raise TypeError(
            f"control_set must be a set of controls like Quadratic() or Ball(1), got {system.control_set!r}"
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


def _sequence(name: str, value: object) -> list:
    if isinstance(value, str) or not hasattr(value, "__iter__"):
        raise TypeError(f"{name} must be a sequence, got {value!r}")
    return list(value)


def _symbols(name: str, values: object) -> tuple[sp.Symbol, ...]:
    symbols = tuple(_sequence(name, values))
    if not symbols:
        raise ValueError(f"{name} must hold at least one symbol")
    for symbol in symbols:
        if not isinstance(symbol, sp.Symbol):
            raise TypeError(f"{name} must hold SymPy symbols, got {symbol!r}")
        if not symbol.is_real:
            raise ValueError(f"{name} must hold real symbols: write sympy.Symbol({str(symbol)!r}, real=True)")
    return symbols


def _numbers(values: Mapping, taken: set[sp.Symbol]) -> dict[sp.Symbol, NDArray]:
    if not isinstance(values, Mapping):
        raise TypeError(f"numbers must map symbols to numbers, got {values!r}")
    (_symbols("numbers", values) if values else ())
    both = taken & set(values)
    if both:
        raise ValueError(f"numbers must not hold slow, control or phase symbols, got {listed(both)}")
    numbers = {symbol: finite(str(symbol), value, "a number or an array") for symbol, value in values.items()}
    common_shape(**{str(symbol): array.shape for symbol, array in numbers.items()})
    return numbers


def _expression(name: str, value: object, known: set[sp.Symbol]) -> sp.Expr:
    if isinstance(value, str):
        raise TypeError(f"{name} must be a SymPy expression or a number, got the text {value!r}")
    try:
        expression = sp.sympify(value)
    except sp.SympifyError:
        raise TypeError(f"{name} must be a SymPy expression or a number, got {value!r}") from None
    if not isinstance(expression, sp.Expr):
        raise TypeError(f"{name} must be a SymPy expression or a number, got {value!r}")
    if expression.has(sp.nan, sp.oo, sp.zoo):
        raise ValueError(f"{name} must be finite, got {expression}")
    if expression.has(sp.I):
        raise ValueError(f"{name} must be real, got {expression}")
    unknown = expression.free_symbols - known
    if unknown:
        raise ValueError(
            f"{name} holds unknown symbols {listed(unknown)}; it may hold {listed(known)} "
            f"(symbols of the same name differ if one is declared real and the other is not)"
        )
    return expression


def _frequencies(system, in_slow: set[sp.Symbol], in_phase: set[sp.Symbol]) -> dict[str, sp.Expr | None]:
    if (system.omega is None) == (system.anomaly_rate is None):
        raise ValueError("exactly one of omega and anomaly_rate must be given")
    if system.omega is None:
        if sp.sympify(system.weight) != 1:
            raise ValueError("weight must not be given beside anomaly_rate, which determines it")
        rate = _expression("anomaly_rate", system.anomaly_rate, in_phase)
        result: dict[str, sp.Expr | None] = {"omega": None, "anomaly_rate": rate}
    else:
        rate = _expression("omega", system.omega, in_slow)
        result = {"omega": rate, "anomaly_rate": None}
    if rate.is_nonpositive:
        name = "anomaly_rate" if system.omega is None else "omega"
        raise ValueError(f"{name} must be positive, got {rate}")
    return result


def _require_affine(name: str, expression: sp.Expr, control: Sequence[sp.Symbol]) -> None:
    for first in control:
        slope = sp.diff(expression, first)
        if slope.has(*control) and sp.simplify(slope).has(*control):
            raise ValueError(f"{name} must be affine in the control, its derivative in {first} is {slope}")


def require_periodic(
    name: str, expression: sp.Expr, phase: sp.Symbol, numbers: Mapping[sp.Symbol, NDArray]
) -> None:
    """2 pi-periodic in the phase: by structure, or at random points where structure does not tell."""
    change = expression.subs(phase, phase + 2 * sp.pi) - expression
    if change == 0:
        return
    symbols = sorted(expression.free_symbols - set(numbers), key=str)
    parameters = sorted(expression.free_symbols & set(numbers), key=str)
    draws = np.random.default_rng(1977).uniform(0.5, 1.5, (len(symbols), 16))
    constants = [np.ravel(numbers[symbol])[0] for symbol in parameters]
    evaluate = compiler.function("change", [*symbols, *parameters], {"change": change, "value": expression})
    difference, value = evaluate(*draws, *constants)
    if (np.abs(difference) > 1e-9 * (1 + np.abs(value))).any():
        raise ValueError(f"{name} must be 2 pi-periodic in {phase}, got {expression}")


def require_count(name: str, values: Sequence, dimension: int) -> None:
    """One entry for each control, or ValueError."""
    if len(values) != dimension:
        raise ValueError(f"{name} must hold one for each of {dimension} controls, got {len(values)}")


def require_positive(name: str, values: Sequence, numbers: Mapping[sp.Symbol, NDArray]) -> None:
    """Positive at every member of the stack, or ValueError."""
    for value in numeric(name, values, numbers):
        least = value.min()
        if not (np.isfinite(least) and least > 0):
            raise ValueError(f"{name} must be positive for a convex set of controls, got {least:g}")


def numeric(name: str, values: Sequence, numbers: Mapping[sp.Symbol, NDArray]) -> tuple[NDArray, ...]:
    """The values as arrays, of the shape that the numbers in them broadcast to."""
    expressions = [sp.sympify(value) for value in values]
    held = set().union(*(expression.free_symbols for expression in expressions))
    if held - set(numbers):
        raise ValueError(f"{name} holds unknown symbols {listed(held - set(numbers))}")
    symbols = sorted(held, key=str)
    evaluate = compiler.function("values", symbols, {f"v{i}": e for i, e in enumerate(expressions)})
    return evaluate(*(numbers[symbol] for symbol in symbols))


def listed(symbols: set[sp.Symbol]) -> str:
    """Symbols as text."""
    return ", ".join(sorted(map(str, symbols)))
