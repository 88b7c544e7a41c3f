"""How far collocation and means resolve the functions of a system along averaged extremals.

Slow time and anomaly are divided into boxes until, about each box, a disc in either complex plane is found on
which the functions are bounded: then polynomials on the box, which are exact at the nodes, are exact between
them too, and no feature hides there. Where a function has a narrow feature, boxes become as narrow.
"""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.cells import Cells, Index, discs, panels
from pontryagin.averaging.averaged.collocation import Problem, Trajectories, scales
from pontryagin.averaging.system.jets import evaluate
from pontryagin.numerics.discs import Disc
from pontryagin.numerics.periodic_means import PARTS

if TYPE_CHECKING:
    from pontryagin.averaging.system.bounds import Bounds

REACH, REACH_OF_TURN = 1.5, 1.3
"""Radii of the discs over half the lengths of the cells of slow time, and of the anomaly.

A function that is bounded by M on a disc of 1.5 differs from its interpolation at 27 Chebyshev points by less
than 1e-11 M; Gauss's rule of 16 nodes on a disc of 1.3 errs by less than 1e-10 M.
"""
EXPONENT = 28.0
"""Whole panels, where the certificate adds m points to the collocation's, need discs of cosh(28 / m) only."""
LIMIT = 100.0
"""Largest bound on a disc, relative to the value at its centre or to the mean over the trajectory."""
MARGIN = 1e-2
"""Least radius of a disc, relative to the variable, times the cell's length.

Derivatives across the trajectory are bounded with it, also where a variable does not change.
"""
MOST_BOXES = 400
"""Number of boxes of one trajectory at which the division ends."""
LONGISH = 8.0
"""A box so many times longer in the anomaly than in slow time, as shares, is halved in the anomaly.

What is bounded in the middle of a cell need not be at its end, however short the cell is.
"""
SHORTEST = 2.0**-20
"""Shortest cell, as a share of the way or of a turn."""
IDLE = 1e-9
"""Factor that makes a costate negligible; see `guess`."""


@dataclass(frozen=True, eq=False)
class Resolution:
    """The division of the way and of a turn, for a stack of trajectories (s).

    Attributes
    ----------
    edges : list of tuples of float
        Ends of the cells of tau / duration, for each trajectory: those of the mesh and more.
    turn : list of tuples of float
        Ends of the cells of a turn, for each trajectory; empty where an eighth of a turn is short enough.
    unresolved : (s) array
        Length of the longest cell, as a share of the way or of a turn, on which no bound was found; else 0.
    positive : (s) array of bool
        Whether the frequency and the weight were seen to be positive.
    """

    edges: list[tuple[float, ...]]
    turn: list[tuple[float, ...]]
    unresolved: Array
    positive: NDArray[np.bool_]

    @property
    def groups(self) -> dict[tuple[tuple[float, ...], tuple[float, ...]], Index]:
        """Trajectories with the same division of the way and of a turn."""
        found: dict[tuple[tuple[float, ...], tuple[float, ...]], list[int]] = {}
        for i, division in enumerate(zip(self.edges, self.turn, strict=True)):
            found.setdefault(division, []).append(i)
        return {division: np.array(members) for division, members in found.items()}


@dataclass(frozen=True, eq=False)
class _Boxes:
    """Pairs of cells: of slow time, given by their place in a list, and of the anomaly."""

    cell: Index
    left: Array
    right: Array

    def __getitem__(self, chosen: NDArray[np.bool_]) -> "_Boxes":
        return _Boxes(self.cell[chosen], self.left[chosen], self.right[chosen])


def resolution(problem: Problem, path: Trajectories) -> Resolution:
    """Divide the ways of solved trajectories (s)."""
    bounds, stack = problem.model.bounds, len(path.duration)
    cells = panels(path)
    if bounds is None or not bounds.averaged:
        edges = [path.mesh.edges] * stack
        return Resolution(edges, [()] * stack, np.zeros(stack), np.zeros(stack, bool))
    search = _Search(problem, path, bounds)
    parts = PARTS if bounds.turning else 1
    turn = 2 * np.pi * np.arange(parts + 1) / parts
    count = len(cells.low)
    boxes = _Boxes(np.repeat(np.arange(count), parts), np.tile(turn[:-1], count), np.tile(turn[1:], count))
    unresolved = np.zeros(stack)
    used = np.zeros(stack)
    ways: list[set[float]] = [set(path.mesh.edges) for _ in range(stack)]
    turns: list[set[float]] = [set(turn) for _ in range(stack)]
    while len(boxes.cell):
        member = cells.member[boxes.cell]
        bad = ~search.bounded(cells, boxes, REACH)
        if not bad.any():
            break
        boxes, member = boxes[bad], member[bad]
        by_turn = np.zeros(len(member), bool)
        if bounds.turning:
            wide = (boxes.right - boxes.left) / (2 * np.pi) > LONGISH * cells.lengths[boxes.cell]
            by_turn = wide | ~search.bounded(cells, boxes, 0.0)
        length = np.where(by_turn, (boxes.right - boxes.left) / (2 * np.pi), cells.lengths[boxes.cell])
        used += np.bincount(member, minlength=stack)
        lost = (length <= SHORTEST) | (used[member] > MOST_BOXES)
        np.maximum.at(unresolved, member[lost], length[lost])
        search.positive[member[lost]] = False
        boxes, by_turn = boxes[~lost], by_turn[~lost]
        cells, boxes = _divided(cells, boxes, by_turn, ways, turns)
    return Resolution(
        [tuple(sorted(way)) for way in ways],
        [tuple(sorted(t)) if len(t) > parts + 1 else () for t in turns],
        unresolved,
        search.positive,
    )


def _divided(
    cells: Cells,
    boxes: _Boxes,
    by_turn: NDArray[np.bool_],
    ways: list[set[float]],
    turns: list[set[float]],
) -> tuple[Cells, _Boxes]:
    """Halve boxes in the anomaly or in slow time; their new ends are added to the sets."""
    kept, apart = boxes[by_turn], boxes[~by_turn]
    middle = (kept.left + kept.right) / 2
    parents, which = np.unique(apart.cell, return_inverse=True)
    halves = cells[parents].halves()
    for member, end in zip(halves.member[::2], halves.high[::2], strict=True):
        ways[member].add(float(end))
    for member, end in zip(cells.member[kept.cell], middle, strict=True):
        turns[member].add(float(end))
    first = len(kept.cell)
    cells = Cells(
        np.append(cells.member[kept.cell], halves.member),
        np.append(cells.panel[kept.cell], halves.panel),
        np.append(cells.low[kept.cell], halves.low),
        np.append(cells.high[kept.cell], halves.high),
    )
    same = np.arange(first)
    return cells, _Boxes(
        np.concatenate([same, same, first + 2 * which, first + 2 * which + 1]),
        np.concatenate([kept.left, middle, apart.left, apart.left]),
        np.concatenate([middle, kept.right, apart.right, apart.right]),
    )


class _Search:
    """Decides whether functions are bounded about boxes; what is large is learnt from the first boxes."""

    def __init__(self, problem: Problem, path: Trajectories, bounds: "Bounds") -> None:
        self.problem, self.path, self.bounds = problem, path, bounds
        self.least = MARGIN * scales(path.z)
        self.control: Array | None = None
        self.usual: Array | None = None
        self.positive = np.full(len(path.duration), bool(bounds.judges))
        points = 2 * path.mesh.degree + 4
        self.of_panels = math.cosh(EXPONENT / points)

    def bounded(self, cells: Cells, boxes: _Boxes, reach: float) -> NDArray[np.bool_]:
        """Whether all functions are bounded about the boxes, (b)."""
        member = cells.member[boxes.cell]
        centre, radius = discs(self.path, cells, reach, self.of_panels if reach else None)
        if reach:
            radius = np.maximum(radius, self.least[cells.member] * cells.lengths[:, None])
        centre, radius = centre[boxes.cell], radius[boxes.cell]
        numbers = [number[member] for number in self.problem.numbers]
        x = (boxes.left + boxes.right) / 2
        u, swing = self._control(centre, x, numbers, member)
        values = [_complex(c, r) for c, r in zip(centre.T, radius.T, strict=True)]
        values.append(_complex(x, REACH_OF_TURN / 2 * (boxes.right - boxes.left)))
        values += [_complex(c, r) for c, r in zip(u.T, swing.T, strict=True)]
        found = self.bounds.averaged_enclosure(*values, *numbers)
        shape = (len(found), len(member))
        at, size = np.empty(shape), np.empty(shape)
        for i, disc in enumerate(found):
            at[i], size[i] = np.where(np.isfinite(disc.radius), np.abs(disc.centre), np.nan), disc.size
        if self.usual is None:
            self.usual = self._usual(at, centre, numbers, member)
        local = np.fmax(at, self.usual[:, member])
        bounded = np.asarray((size <= LIMIT * local).all(axis=0))
        for judge in self.bounds.judges if reach else ():
            np.logical_and.at(
                self.positive, member[bounded], np.broadcast_to(found[judge].lower > 0, len(member))[bounded]
            )
        return bounded

    def _control(self, centre: Array, x: Array, numbers: list[Array], member: Index) -> tuple[Array, Array]:
        """u* at the centres, and the largest |u*| of a trajectory's first boxes, (b, m) each."""
        count = len(self.bounds.system.control)
        if self.bounds.closed:
            return np.zeros((len(x), count)), np.zeros((len(x), count))
        u = np.nan_to_num(evaluate(self.problem.model.control, *centre.T, x, *numbers))
        if self.control is None:
            self.control = np.zeros((len(self.path.duration), count))
            np.maximum.at(self.control, member, np.abs(u))
        return u, self.control[member]

    def _usual(self, at: Array, centre: Array, numbers: list[Array], member: Index) -> Array:
        """Mean moduli over a trajectory's first boxes, (functions, s); of h0 without a costate, for h0."""
        model = self.problem.model
        if self.bounds.closed:
            assert model.mean is not None
            n = model.slow
            idle = evaluate(model.mean, *centre[:, :n].T, *(IDLE * centre[:, n:]).T, *numbers)
            at = np.concatenate([np.abs(idle[:, :1].T), at[1:]])
        known = np.isfinite(at)
        stack = len(self.path.duration)
        total = np.stack(
            [np.bincount(member, np.where(k, a, 0), stack) for a, k in zip(at, known, strict=True)]
        )
        count = np.stack([np.bincount(member, k, stack) for k in known])
        return np.asarray(total / np.maximum(count, 1))


def _complex(centre: Array, radius: Array) -> Disc:
    return Disc(np.asarray(centre, np.complex128), radius)
