"""Writes `kernels.py` from the derivations: ``python -m pontryagin.averaging.generate``."""

from pathlib import Path

from pontryagin.averaging.system.average import kernel_expressions
from pontryagin.averaging.system.derived_systems import (
    EXAMPLES,
    Example,
)
from pontryagin.averaging.system.phase_system import PhaseSystem
from pontryagin.io.files import write
from pontryagin.numerics.compile import source

HEADER = '''"""Numeric kernels of the paper's examples, and the examples themselves as SymPy text.

Generated from the derivations by `make kernels`; do not edit.
"""

from numpy import cos, sin, sqrt
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


def kernels() -> str:
    """The text of `kernels.py`."""
    parts = []
    for name, derive in EXAMPLES.items():
        example = derive()
        parts += [*_functions(name, example), _as_text(name, example.system)]
    return HEADER + "\n\n" + "\n\n\n".join(parts) + "\n"


def _functions(name: str, example: Example) -> list[str]:
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


def _as_text(name: str, system: PhaseSystem) -> str:
    symbols = (*system.slow, *system.control, system.phase, *system.numbers)
    signs = {s: "positive" if s.is_positive else "negative" if s.is_negative else "real" for s in symbols}
    lines = [
        f"{name.upper()} = {{",
        f'    "symbols": {{{", ".join(f"{str(s)!r}: {sign!r}" for s, sign in signs.items())}}},',
        f'    "slow": {[str(s) for s in system.slow]},',
        f'    "control": {[str(s) for s in system.control]},',
        f'    "phase": {str(system.phase)!r},',
        f'    "numbers": {[str(s) for s in system.numbers]},',
        f'    "f": {[str(e) for e in system.f]},',
        f'    "target": {[str(e) for e in system.target]},',
        *(
            f'    "{field}": {str(getattr(system, field))!r},'
            for field in ("omega", "weight", "running_cost", "terminal_cost", "phase_rate", "control_set")
        ),
        "}",
    ]
    return "\n".join(lines).replace("'", '"')


def main() -> None:
    """Write the file beside this one."""
    write(Path(__file__).with_name("kernels.py"), kernels())


if __name__ == "__main__":
    main()
