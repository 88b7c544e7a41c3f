"""What `make kernels` has generated of the paper's examples: their models, and the systems when asked for."""

from dataclasses import fields
from typing import Any

from numpy.typing import NDArray

from pontryagin.averaging import kernels
from pontryagin.averaging.system.model import Model


def model(name: str) -> Model:
    """The numeric side of an example; no SymPy is loaded."""
    text = getattr(kernels, name.upper())
    given: dict[str, Any] = {"slow": len(text["slow"]), "target": len(text["target"])}
    functions: dict[str, Any] = {
        f.name: getattr(kernels, f"{name}_{f.name}", None) for f in fields(Model) if f.name not in given
    }
    return Model(**given, **functions)


def system(name: str, numbers: tuple[NDArray, ...]):
    """The example as a `PhaseSystem`, with values of its numbers in their order."""
    import sympy as sp

    from pontryagin.averaging.system import control_sets
    from pontryagin.averaging.system.phase_system import PhaseSystem

    text = getattr(kernels, name.upper())
    symbols = {symbol: sp.Symbol(symbol, **{sign: True}) for symbol, sign in text["symbols"].items()}
    sets = {kind: getattr(control_sets, kind) for kind in ("Quadratic", "Ellipsoid")}

    def read(expression: str):
        return sp.sympify(expression, locals=symbols)

    return PhaseSystem(
        f=[read(rate) for rate in text["f"]],
        omega=read(text["omega"]),
        control_set=eval(text["control_set"], {"__builtins__": {}, **sets, **symbols}),
        slow=[symbols[symbol] for symbol in text["slow"]],
        control=[symbols[symbol] for symbol in text["control"]],
        phase=symbols[text["phase"]],
        target=[read(condition) for condition in text["target"]],
        running_cost=read(text["running_cost"]),
        terminal_cost=read(text["terminal_cost"]),
        phase_rate=read(text["phase_rate"]),
        weight=read(text["weight"]),
        numbers={symbols[symbol]: value for symbol, value in zip(text["numbers"], numbers, strict=True)},
    )
