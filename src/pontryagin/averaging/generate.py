"""Write the generated modules from the derivations: ``python -m pontryagin.averaging.generate``.

`kernels` holds numeric functions, `system.generated_systems` functions that build the examples in SymPy.
"""

from pathlib import Path

import sympy as sp
from sympy.printing.str import StrPrinter

from pontryagin.averaging.system.average import kernel_expressions
from pontryagin.averaging.system.derived_systems import EXAMPLES, DerivedSystem
from pontryagin.averaging.system.phase_system import PhaseSystem
from pontryagin.io.files import write
from pontryagin.numerics.compile import source

KERNELS_HEADER = '''"""Numeric kernels of the paper's examples.

Generated from the derivations by `make kernels`; do not edit.
"""

from numpy import cos, sin, sqrt
'''

SYSTEMS_HEADER = '''"""The paper's examples as phase systems, each a function of the values of its numbers.

Generated from the derivations by `make kernels`; do not edit.
"""

# fmt: off
# ruff: noqa: E501
from numpy.typing import ArrayLike
from sympy import Rational, Symbol, cos, sin, sqrt

from pontryagin.averaging.system.control_sets import Ellipsoid, Quadratic
from pontryagin.averaging.system.phase_system import PhaseSystem
'''

MEANING = {
    "mean": "h0, its gradient and the upper triangle of its Hessian in (a, p), (2.3).",
    "density": "h* dpsi/dx at q = 0, its gradient and Hessian in (a, p), and its derivative in x.",
    "frequency": "omega, its gradient and Hessian in a.",
    "boundary": "M and g, each with its gradient and Hessian in a, (1.2), (1.3).",
    "control": "u*(a, x, p) at q = 0, (1.5).",
    "rates": "f and the running cost, (1.1).",
    "pace": "dt/dx at epsilon = 0.",
}
TITLE = {"smooth": "Section 3, smooth example", "kepler": "Example 2", "spin_down": "Example 3"}
EXPRESSIONS = ("omega", "weight", "running_cost", "terminal_cost", "phase_rate", "control_set")


class _PythonPrinter(StrPrinter):  # type: ignore[misc]
    """SymPy's text form, with each fraction as an exact Rational instead of a quotient of integers."""

    def _print_Rational(self, expression: sp.Rational) -> str:
        return f"Rational({expression.p}, {expression.q})"


def kernels() -> str:
    """The text of `kernels.py`."""
    sizes, functions = [], []
    for name, derive in EXAMPLES.items():
        example = derive()
        sizes.append(f'    "{name}": ({len(example.system.slow)}, {len(example.system.target)}),')
        functions += _functions(name, example)
    table = ["SIZES = {", *sizes, "}", '"""Numbers of slow variables and of conditions at the end."""']
    return KERNELS_HEADER + "\n" + "\n\n\n".join(["\n".join(table), *functions]) + "\n"


def systems() -> str:
    """The text of `system/generated_systems.py`."""
    parts = [_builder(name, derive().system) for name, derive in EXAMPLES.items()]
    return SYSTEMS_HEADER + "\n\n" + "\n\n\n".join(parts) + "\n"


def _functions(name: str, example: DerivedSystem) -> list[str]:
    columns = kernel_expressions(example.system, example.averaged)
    return [
        source(
            f"{name}_{kind}",
            arguments,
            {f"c{i}": expression for i, expression in enumerate(expressions)},
            f"{TITLE[name]}: {MEANING[kind]}",
        )
        for kind, (arguments, expressions) in columns.items()
        if expressions is not None
    ]


def _builder(name: str, system: PhaseSystem) -> str:
    """A function that builds one example."""
    text = _PythonPrinter().doprint
    symbols = (*system.slow, *system.control, system.phase, *system.numbers)
    signs = {s: "positive" if s.is_positive else "negative" if s.is_negative else "real" for s in symbols}
    numbers = "".join(f"{symbol}, " for symbol in system.numbers)
    lines = [
        f"def {name}(*values: ArrayLike) -> PhaseSystem:",
        f'    """{TITLE[name]}, with values of {numbers.removesuffix(", ")}."""',
        *(f'    {symbol} = Symbol("{symbol}", {sign}=True)' for symbol, sign in signs.items()),
        "    return PhaseSystem(",
        *(
            f"        {field}=[{', '.join(map(text, getattr(system, field)))}],"
            for field in ("f", "slow", "control", "target")
        ),
        f"        phase={system.phase},",
        *(f"        {field}={text(getattr(system, field))}," for field in EXPRESSIONS),
        f"        numbers=dict(zip(({numbers}), values, strict=True)),",
        "    )",
    ]
    return "\n".join(lines)


def main() -> None:
    """Write both files."""
    here = Path(__file__).parent
    write(here / "kernels.py", kernels())
    write(here / "system" / "generated_systems.py", systems())


if __name__ == "__main__":
    main()
