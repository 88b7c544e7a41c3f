"""Options, table columns and solvers of the paper's examples, for the command line."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from pontryagin.io import formula, rows
from pontryagin.terminal import console

VECTORS = {"omega0": ("omega_x", "omega_y", "omega_z"), "semiaxes": ("l_x", "l_y", "l_z")}
"""Options that take three numbers, each with the table columns that hold them."""

FORMULAS = {"mass": ("x",), "potential": ("x",), "force": ("x", "v")}
"""Options that take formulas, each with the variables that its formula may contain."""

Given = Mapping[str, str | None]


@dataclass(frozen=True)
class ExampleSchema:
    """One example of the paper: its solver, and its arguments on the command line and in tables.

    Attributes
    ----------
    solver : str
        Name of the function of `pontryagin.averaging`.
    title : str
    required : tuple of str
        Arguments that must be given; on the command line each has two hyphens before it.
    optional : mapping of str to str
        Arguments that may be left out, with their default values.
    either : tuple of str
        Arguments of which exactly one must be given.
    phase : bool
        Whether the phase at the start may be chosen.
    """

    solver: str
    title: str
    required: tuple[str, ...]
    optional: Mapping[str, str] = field(default_factory=dict)
    either: tuple[str, ...] = ()
    phase: bool = True

    @property
    def options(self) -> tuple[str, ...]:
        """All arguments."""
        return (*self.required, *self.optional, *self.either)

    def read(self, given: Given) -> dict[str, Any]:
        """Values of the arguments for one problem.

        Raises
        ------
        pontryagin.terminal.console.Refusal
            If an argument is missing or invalid, or two arguments exclude each other.
        """
        console.required({option(name): given[name] for name in self.required})
        self._require_one([name for name in self.either if given[name] is not None])
        texts = {name: given[name] or self.optional.get(name) for name in self.options}
        return {name: value(name, text) for name, text in texts.items() if text is not None}

    def stacks(self, given: Given, path: Path) -> Iterator[rows.Rows]:
        """Read a table with one problem in each row, block by block; see `of_block`.

        Raises
        ------
        pontryagin.terminal.console.Refusal
            If an argument has both an option and a column, or one is missing, or two exclude each other.
        """
        for block in rows.blocks(path, _columns(self._wanted(given)), _columns(self._possible)):
            both = [name for name in self.options if given[name] and set(columns(name)) & set(block.header)]
            console.excluded(f"the column of {path} that holds it", {option(name): True for name in both})
            held = [name for name in self.either if given[name] or set(columns(name)) <= set(block.header)]
            self._require_one(held)
            yield block

    def of_block(self, given: Given, read: rows.Rows) -> dict[str, Any]:
        """The value of every argument: the array of a column, or one number from an option for all rows."""
        names = (*self._wanted(given), *self._possible)
        stated = {name: self._column(read, name) for name in names if given[name] is None}
        given_columns = {name: column for name, column in stated.items() if column is not None}
        texts = {
            name: given[name] or self.optional.get(name) for name in self.options if name not in given_columns
        }
        values = {name: value(name, text) for name, text in texts.items() if text is not None}
        return given_columns | values

    def _wanted(self, given: Given) -> list[str]:
        return [name for name in self.required if given[name] is None]

    @property
    def _possible(self) -> list[str]:
        return [name for name in self.options if name not in FORMULAS and name not in self.required]

    def _column(self, read: rows.Rows, name: str) -> Any:
        if not set(columns(name)) <= set(read.columns):
            return None
        return np.stack([read.columns[part] for part in columns(name)], axis=-1).reshape(
            -1, *([3] if name in VECTORS else [])
        )

    def _require_one(self, chosen: list[str]) -> None:
        if self.either and not chosen:
            raise console.Refusal(option(self.either[0]), f"or {option(self.either[1])} must be given")
        if len(chosen) > 1:
            raise console.Refusal(option(chosen[0]), f"cannot be combined with {option(chosen[1])}")


EXAMPLES = {
    "kepler": ExampleSchema(
        "kepler", "Energy of a Kepler orbit changed by small thrust", ("E0", "K0", "E1", "l")
    ),
    "smooth": ExampleSchema(
        "smooth_example",
        "A speed changed against a periodic force",
        ("v0", "v1"),
        {"k": "1", "ripple": "0"},
    ),
    "rotor": ExampleSchema(
        "rotor",
        "A rotor of varying mass and potential, sped up or braked",
        ("a0", "a1"),
        {"mass": "1", "potential": "0", "force": "0"},
        ("peak", "k"),
    ),
    "spin-down": ExampleSchema(
        "spin_down",
        "The precession of a symmetric rigid body brought to rest",
        ("omega0", "semiaxes", "ratio"),
        phase=False,
    ),
}


def option(name: str) -> str:
    """An argument's name as it is typed.

    Examples
    --------
    >>> option("E0")
    '--E0'
    """
    return f"--{name}"


def columns(name: str) -> tuple[str, ...]:
    """The columns of a table that hold an argument.

    Examples
    --------
    >>> columns("semiaxes"), columns("ratio")
    (('l_x', 'l_y', 'l_z'), ('ratio',))
    """
    return VECTORS.get(name, (name,))


def _columns(names: list[str]) -> list[str]:
    return [column for name in names for column in columns(name)]


def value(name: str, text: str) -> Any:
    """The value that an argument's text stands for: a number, three numbers, or an expression.

    Examples
    --------
    >>> value("ratio", "1/2"), value("semiaxes", "1,1,0.5"), value("mass", "1 + 0.2*cos(x)")
    (0.5, [1.0, 1.0, 0.5], cos(x)/5 + 1)
    """
    if name in VECTORS:
        return console.vector(option(name), text, 3)
    if name not in FORMULAS:
        return console.number(option(name), text)
    try:
        return formula.expression(text, *FORMULAS[name])
    except ValueError as reason:
        raise console.Refusal(option(name), f": {reason}") from None


def solve(example: ExampleSchema, values: Mapping[str, Any]) -> Any:
    """The averaged solution of a problem or of a stack."""
    from pontryagin import averaging

    blamed = {name: option(name) for name in example.options} | {"omega": "--example: omega"}
    with console.solving(blamed):
        return getattr(averaging, example.solver)(**values)
