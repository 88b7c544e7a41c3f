"""What a chunk of random problems gave: counts, the worst of each measure, and failures with exact inputs."""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from pontryagin.certificate import ACCEPTED

Input = Mapping[str, Any]
"""The inputs of a problem by their names: numbers, arrays, texts."""

KEPT = 20
"""Failures of a chunk that are kept with their inputs; all are counted."""
SUSPICIOUS = 1e-10
"""A certificate that is worse than this has its problem looked at by the oracle too."""
LARGEST = 1e300
"""Stands for a measure that is not finite."""


def number(value: float) -> str:
    """A number as Python text, exactly."""
    return f'h("{float(value).hex()}")'


def text(value: Any) -> str:
    """An input as Python text that is the same to the last bit, where ``h`` is ``float.fromhex``."""
    if isinstance(value, str | None | bool | int | np.integer):
        return repr(value)
    if np.ndim(value) == 0:
        return number(value)
    return "[" + ", ".join(map(text, value)) + "]"


def exact(value: Any) -> Any:
    """An input for JSON: floating numbers in hexadecimal."""
    if isinstance(value, str | None | bool | int):
        return value
    if isinstance(value, np.integer):
        return int(value)
    return float(value).hex() if np.ndim(value) == 0 else [exact(part) for part in value]


class Outcome:
    """What was found so far.

    Parameters
    ----------
    line : callable
        From the input of a problem to a line of Python that solves it.
    """

    def __init__(self, line: Callable[[Input], str]) -> None:
        self._line = line
        self.problems, self.failures, self.unsolved, self.compared = 0, 0, 0, 0
        self.absent: set[str] = set()
        self._kept: list[dict[str, Any]] = []
        self._worst: dict[str, dict[str, Any]] = {}

    def failed(self, what: str, given: Input) -> None:
        """Count a failure, and keep it with its input."""
        self.failures += 1
        if len(self._kept) < KEPT:
            self._kept.append({"what": what, **self._case(given)})

    def raised(self, error: Exception, given: Input) -> None:
        """Count a problem that was not solved, a failure too."""
        self.unsolved += 1
        self.failed(f"{type(error).__name__}: {error}", given)

    def measured(self, name: str, value: float, given: Input) -> None:
        """Keep the input if the measure of this name was never worse."""
        value = abs(float(value))
        value = value if value <= LARGEST else LARGEST  # nan too
        if name not in self._worst or value > self._worst[name]["value"]:
            self._worst[name] = {"value": value, **self._case(given)}

    def certified(self, certificate: Any, inputs: Sequence[Input]) -> list[int]:
        """Judge a stack by its own certificate; the problems that are suspicious, by number."""
        gap = np.atleast_1d(getattr(certificate, "gap", np.zeros(len(inputs))))
        whole = np.atleast_1d(certificate.residual)
        primal = np.atleast_1d(getattr(certificate, "primal_residual", whole))
        for name, values in (("gap", gap), ("residual", primal)):
            worst = int(np.argmax(np.where(np.isnan(values), np.inf, np.abs(values))))
            self.measured(name, values[worst], inputs[worst])
        for i in np.flatnonzero(~(whole <= ACCEPTED)):
            self.failed(f"the certificate does not hold: residual {whole[i]:.1e}", inputs[i])
        return [int(i) for i in np.flatnonzero(~(whole <= SUSPICIOUS))]

    def judged(self, disagreement: float, given: Input, allowed: float, by: str) -> None:
        """Count a comparison with an oracle, and a failure where it disagrees."""
        self.compared += 1
        self.measured("disagreement", disagreement, given)
        if not abs(disagreement) <= allowed:
            self.failed(f"{by} disagrees by {disagreement:.1e}", given)

    def found(self) -> dict[str, Any]:
        """All of it, ready for JSON."""
        return {
            "problems": self.problems,
            "failures": self.failures,
            "unsolved": self.unsolved,
            "compared": self.compared,
            "absent": sorted(self.absent),
            "kept": self._kept,
            "worst": self._worst,
        }

    def _case(self, given: Input) -> dict[str, Any]:
        return {"input": {name: exact(value) for name, value in given.items()}, "line": self._line(given)}


def attempt(outcome: Outcome, solve: Callable[[Sequence[int]], Any], inputs: Sequence[Input]) -> list[Any]:
    """Solve a stack; where that raises, its halves, down to the members that fail alone, which are kept.

    Returns the solutions with the numbers of their problems: pairs (numbers, solution).
    """
    solved: list[Any] = []
    waiting = [[*range(len(inputs))]] if len(inputs) else []
    while waiting:
        numbers = waiting.pop()
        try:
            solved.append((numbers, solve(numbers)))
        except Exception as error:  # whatever is raised is what is looked for
            if len(numbers) == 1:
                outcome.raised(error, inputs[numbers[0]])
            else:
                half = len(numbers) // 2
                waiting += [numbers[half:], numbers[:half]]
    return solved


def relative(one: float, other: float) -> float:
    """The difference of two numbers, relative to the larger; 0 where they are equal."""
    if one == other:
        return 0.0
    size = max(abs(one), abs(other))
    return abs(one - other) / size if math.isfinite(size) else math.inf
