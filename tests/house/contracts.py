"""``python -m tests.house.contracts``: the walls of the house as import-linter's contracts, and their check.

The papers are read from `pontryagin.papers`, so that a new paper stands between the walls at once.
"""

import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path

from pontryagin.papers import packages

ABOVE = ("cli", "report")
"""Packages that find the papers through `pontryagin.papers` and are imported by nothing below them."""
SHOWING = ("display", "terminal", "ledger")
COMPUTING = ("numerics", "io")
GROUND = ("papers", "certificate", "value", "validation", "errors", "arrays", "progress")


def configuration(papers: Iterable[str]) -> str:
    """The contracts as an INI file: layers, walls between papers, derivations free of numerical libraries."""
    floors = [
        " : ".join(ABOVE),
        " | ".join(papers),
        *(" : ".join(one) for one in (SHOWING, COMPUTING, GROUND)),
    ]
    layers = "\n".join(f"    {floor}" for floor in floors)
    return f"""[importlinter]
root_package = pontryagin
include_external_packages = True
exclude_type_checking_imports = True

[importlinter:contract:layers]
name = Imports point down: above the papers, papers, display and ledger, numerics and io, the ground
type = layers
containers = pontryagin
exhaustive = True
layers =
{layers}

[importlinter:contract:derivations]
name = Derivations are SymPy alone
type = forbidden
source_modules =
    pontryagin.*.derivation
    pontryagin.*.derivation.**
forbidden_modules =
    numpy
    scipy
    numba
    matplotlib
    pontryagin.numerics
allow_indirect_imports = True

[importlinter:contract:solvers]
name = No solver loads the report, the terminal or the recorder
type = forbidden
source_modules =
    pontryagin.numerics
    pontryagin.ledger
forbidden_modules =
    matplotlib
    rerun
    IPython
    typer
allow_indirect_imports = True
"""


def main() -> int:
    """Check the contracts; 0 if all are kept."""
    from importlinter.cli import lint_imports

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "contracts.ini"
        path.write_text(configuration(packages()))
        return lint_imports(config_filename=str(path), no_cache=True, no_logo=True)


if __name__ == "__main__":
    sys.exit(main())
