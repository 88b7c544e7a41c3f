"""Turns of the family of exact solutions: solved ones, and those between, interpolated in the turn's number.

The members at one place of every turn depend smoothly on epsilon times the number of the turn, so that the
number of turns to be solved does not grow as epsilon falls.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pontryagin.arrays import Array
from pontryagin.averaging.exact.members import MemberTable, chord
from pontryagin.averaging.exact.shooting import Shooting
from pontryagin.progress import report

NODES = 6
"""Largest number of turns that a polynomial passes through."""
ALIKE = 3e-4
"""Largest error of a solved turn's interpolation from its neighbours, relative to the range of the values.

Turns that are not solved lie half as far from their neighbours: their error is about 2**-NODES of it.
"""


@dataclass(frozen=True)
class Turn:
    """Members of one turn, numbered from the one where the search began.

    `ends` says why the family breaks off in this turn, below or above.
    """

    number: int
    members: MemberTable
    ends: tuple[str, str] = ("", "")

    @property
    def mean(self) -> float:
        """Mean of y."""
        return float(self.members.y.mean())


def at(turns: Sequence[Turn], number: int) -> MemberTable:
    """The members of a turn by the polynomials through the nearest of complete turns."""
    nearest = sorted(turns, key=lambda turn: abs(turn.number - number))[:NODES]
    nodes = np.array([[float(turn.number) for turn in nearest]])
    weights = lagrange(nodes, np.array([float(number)]))[0]
    return MemberTable.combined(weights, [turn.members for turn in nearest])


def means_at(turns: Sequence[Turn], numbers: Array) -> Array:
    """The means of y of turns (k) by the polynomial through the nearest of complete turns."""
    middle = float(np.mean(numbers))
    nearest = sorted(turns, key=lambda turn: abs(turn.number - middle))[:NODES]
    nodes = np.array([float(turn.number) for turn in nearest])
    weights = lagrange(np.tile(nodes, (len(numbers), 1)), np.asarray(numbers, dtype=float))
    return np.asarray(weights @ np.array([turn.mean for turn in nearest]))


def resolved(problem: Shooting, turns: Sequence[Turn], size: int) -> list[Turn]:
    """Solve turns between those given, until each complete one is as its neighbours predict.

    Raises
    ------
    NotConverged
        If Newton's method does not find a turn from its interpolation.
    """
    current = list(turns)
    while True:
        complete = [turn for turn in current if len(turn.members.theta) == size]
        added = [_solved(problem, complete, number) for number in _unresolved(complete)]
        report("exact solutions followed, turns between them", len(added))
        if not added:
            return current
        current = sorted([*current, *added], key=lambda turn: turn.number)


def filled(turns: Sequence[Turn], size: int) -> list[Turn]:
    """The turns, and those between them, interpolated."""
    complete = [turn for turn in turns if len(turn.members.theta) == size]
    found = list(turns[:1])
    for turn in turns[1:]:
        skipped = range(found[-1].number + 1, turn.number)
        found += [Turn(number, at(complete, number)) for number in skipped]
        found.append(turn)
    return found


def _solved(problem: Shooting, complete: Sequence[Turn], number: int) -> Turn:
    guess = at(complete, number)
    return Turn(number, chord(problem, guess.theta, guess.unknowns, guess.derivatives))


def _unresolved(complete: Sequence[Turn]) -> list[int]:
    """The middle turns of gaps next to turns that differ from what their neighbours predict."""
    numbers = [turn.number for turn in complete]
    wanted: set[int] = set()
    for i in range(1, len(complete) - 1):
        gaps = [(low, high) for low, high in ((i - 1, i), (i, i + 1)) if numbers[high] - numbers[low] > 1]
        if gaps and _error([*complete[:i], *complete[i + 1 :]], complete[i], complete) > ALIKE:
            wanted |= {(numbers[low] + numbers[high]) // 2 for low, high in gaps}
    return sorted(wanted)


def _error(others: Sequence[Turn], turn: Turn, every: Sequence[Turn]) -> float:
    """Error of the unknowns and of y of a turn as interpolated from others, relative to their ranges."""
    predicted = at(others, turn.number)
    unknowns = np.concatenate([each.members.unknowns for each in every])
    size = np.maximum(np.ptp(unknowns, axis=0), 1e-9 * np.abs(unknowns).max(axis=0)) + 1e-300
    missed = np.abs(predicted.unknowns - turn.members.unknowns) / size
    return max(float(missed.max()), excess(predicted.y, turn.members.y))


def excess(predicted: Array, y: Array) -> float:
    """Largest difference of predicted and true values of y in a turn, relative to their range."""
    return float(np.abs(predicted - y).max() / max(float(np.ptp(y)), 1e-300))


def lagrange(nodes: Array, places: Array) -> Array:
    """Weights (k, m) of the values at nodes (k, m) in their polynomial's value at the places (k,)."""
    same = np.eye(nodes.shape[1], dtype=bool)
    differences = np.where(same, 1.0, nodes[:, :, None] - nodes[:, None, :])
    reached = np.where(same, 1.0, places[:, None, None] - nodes[:, None, :])
    return np.asarray((reached / differences).prod(axis=2))
