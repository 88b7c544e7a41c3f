"""Proof that the frequency and the weight of the phase are positive along whole trajectories."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.cells import Cells, discs, panels
from pontryagin.averaging.averaged.collocation import Problem, Trajectories
from pontryagin.errors import ArgumentValueError
from pontryagin.numerics.discs import Disc
from pontryagin.numerics.enclosure import exact
from pontryagin.numerics.periodic_means import PARTS

if TYPE_CHECKING:
    from pontryagin.averaging.system.bounds import Bounds

MOST_BOXES = 2000
"""Number of boxes of one trajectory at which the division ends."""
SHORTEST = 2.0**-26
"""Shortest interval, as a share of the way or of a turn."""


def undecided(problem: Problem, path: Trajectories, names: Sequence[str], members: NDArray[np.intp]) -> Array:
    """Longest interval of each trajectory (s) on which positivity was not decided, as a share; 0 if none.

    Raises
    ------
    ValueError
        If omega, the weight or the anomaly's rate is not positive, with the place.
    """
    bounds = problem.model.bounds
    result = np.zeros(len(path.duration))
    if bounds is None or not bounds.positive:
        return result
    boxes = _first(path, PARTS if bounds.turning_signs else 1)
    used = np.zeros(len(result))
    while len(boxes.left):
        boxes = boxes[~_positive(problem, path, bounds, boxes, 1.0)]
        _require_not_negative(problem, path, bounds, boxes, names, members)
        by_turn = np.zeros(len(boxes.left), bool)
        if bounds.turning_signs:
            wide = (boxes.right - boxes.left) / (2 * np.pi) > boxes.cells.lengths
            by_turn = wide | ~_positive(problem, path, bounds, boxes, 0.0)
        member = boxes.cells.member
        length = np.where(by_turn, (boxes.right - boxes.left) / (2 * np.pi), boxes.cells.lengths)
        used += np.bincount(member, minlength=len(used))
        lost = (length <= SHORTEST) | (used[member] > MOST_BOXES)
        np.maximum.at(result, member[lost], length[lost])
        boxes = boxes[~lost].halved(by_turn[~lost])
    return result


@dataclass(frozen=True, eq=False)
class _Boxes:
    """Products (c) of cells of slow time and of intervals of the anomaly."""

    cells: Cells
    left: Array
    right: Array

    def __getitem__(self, chosen: NDArray[np.bool_]) -> "_Boxes":
        return _Boxes(self.cells[np.nonzero(chosen)[0]], self.left[chosen], self.right[chosen])

    def halved(self, by_turn: NDArray[np.bool_]) -> "_Boxes":
        """Both halves of every box: in the anomaly where `by_turn` holds, else in slow time, (2c)."""
        cells, middle = self.cells, (self.left + self.right) / 2
        halves = cells.halves()
        twice = np.repeat(by_turn, 2)

        def either(of_turn: Array, of_way: Array) -> Array:
            return np.where(twice, of_turn, of_way)

        def pairs(first: Array, second: Array) -> Array:
            return np.stack([first, second], axis=1).reshape(-1)

        return _Boxes(
            Cells(
                halves.member,
                halves.panel,
                either(np.repeat(cells.low, 2), halves.low),
                either(np.repeat(cells.high, 2), halves.high),
            ),
            either(pairs(self.left, middle), np.repeat(self.left, 2)),
            either(pairs(middle, self.right), np.repeat(self.right, 2)),
        )


def _first(path: Trajectories, parts: int) -> _Boxes:
    cells = panels(path)
    count = len(cells.low)
    left = np.tile(2 * np.pi * np.arange(parts) / parts, count)
    return _Boxes(cells[np.repeat(np.arange(count), parts)], left, left + 2 * np.pi / parts)


def _positive(
    problem: Problem, path: Trajectories, bounds: "Bounds", boxes: _Boxes, reach: float
) -> NDArray[np.bool_]:
    """Whether all functions are positive on boxes (c); with `reach` 0, at the middle of their slow time."""
    n = problem.model.slow
    centre, radius = discs(path, boxes.cells, reach)
    found = bounds.positive_enclosure(
        *(Disc(c, r) for c, r in zip(centre[:, :n].T, radius[:, :n].T, strict=True)),
        Disc((boxes.left + boxes.right) / 2, (boxes.right - boxes.left) / 2),
        *(number[boxes.cells.member] for number in problem.numbers),
    )
    result = np.ones(len(boxes.left), bool)
    for disc in found:
        result &= disc.lower > 0
    return result


def _require_not_negative(
    problem: Problem,
    path: Trajectories,
    bounds: "Bounds",
    boxes: _Boxes,
    names: Sequence[str],
    members: NDArray[np.intp],
) -> None:
    """Raise if a function is not positive in the middle of a box."""
    slow = discs(path, boxes.cells, 0.0)[0][:, : problem.model.slow]
    x = (boxes.left + boxes.right) / 2
    numbers = [number[boxes.cells.member] for number in problem.numbers]
    found = bounds.positive_enclosure(*(exact(c) for c in slow.T), exact(x), *numbers)
    for (name, expression), disc in zip(bounds.positive.items(), found, strict=True):
        wrong = np.broadcast_to(disc.upper <= 0, x.shape)
        if wrong.any():
            i = int(np.argmax(wrong))
            point = [*zip(names, slow[i], strict=True)]
            if expression.has(bounds.system.phase):
                point.append((str(bounds.system.phase), float(x[i])))
            value = float(np.broadcast_to(disc.centre, x.shape)[i])
            refuse(name, value, point, members, int(boxes.cells.member[i]))


def refuse(
    name: str, value: float, point: Sequence[tuple[str, float]], members: NDArray[np.intp], member: int
) -> None:
    """Raise the error for a function that is not positive at a point of a trajectory."""
    at = ", ".join(f"{symbol} = {number:.6g}" for symbol, number in point)
    where = f" (problem {members[member]} of the stack)" if len(members) > 1 else ""
    raise ArgumentValueError(
        f"{name} must be positive along the whole trajectory, got {value:.6g} at {at}{where}", name
    )
