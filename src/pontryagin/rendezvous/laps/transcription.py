"""The extremal of a transfer, transcribed by the midpoint rule in equinoctial elements or other coordinates.

The independent variable s runs like the longitude of an undisturbed orbit. The regularised Hamiltonian K
vanishes along the extremal. Unknown are coordinates and costates at the nodes, the price c of time, the
length of s and the duration. Newton's step eliminates the nodes one by one, so that nine equations remain.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.newton import expected
from pontryagin.rendezvous.laps.ends import Ends
from pontryagin.rendezvous.laps.hamiltonian import Cost, Hamiltonian

NODES_PER_LAP, FEWEST = 32, 32
"""Intervals of s for each turn, and the fewest intervals."""
ACCURACY, FINELY, ROUGH = 1e-7, 1e-4, 1e-2
"""Relative correction at which Newton's method ends, and those that suffice for a guess of a flight and
along a continuation."""
ITERATIONS = 8
"""Largest number of steps of Newton's method."""
LARGEST, CONTRACTION = 0.8, 0.7
"""Largest relative correction, and the largest ratio of one to that before."""


@dataclass(frozen=True, eq=False)
class Path:
    """A transfer at the nodes.

    Attributes
    ----------
    nodes : (12, N + 1) array
        Coordinates, such as p, f, g, h, k and L, and their costates at equal steps of s.
    price : float
        c: minus the value of H, less alpha1.
    span : float
        The length of s.
    duration : float
        The time at the last node.
    """

    nodes: Array
    price: float
    span: float
    duration: float

    @property
    def unknowns(self) -> Array:
        """All numbers as one vector."""
        return np.append(self.nodes.ravel(), [self.price, self.span, self.duration])

    @classmethod
    def of(cls, unknowns: Array) -> "Path":
        """The path of a vector of unknowns."""
        return cls(unknowns[:-3].reshape(12, -1), *map(float, unknowns[-3:]))


def switching(ends: Ends, path: Path) -> Array:
    """|n| at the nodes, (N + 1,)."""
    return np.asarray(np.sqrt(ends.square(path.nodes)))


@dataclass(frozen=True, eq=False)
class Plane:
    """A plane in the space of the unknowns, in which an extremal of any duration is sought.

    Attributes
    ----------
    normal : (n,) array
        Its normal, as long as `Path.unknowns`.
    offset : float
        The scalar product of the normal and the unknowns in the plane.
    """

    normal: Array
    offset: float


Closing = float | Plane | None
"""What determines the duration: its value, a plane through the unknowns, or None for the terminal law."""


@dataclass(frozen=True, eq=False)
class Transcription:
    """The equations of a transfer at given unknowns, and the step that solves them when linearised.

    Attributes
    ----------
    residual : (n,) array
        Errors of the midpoint rule, then of the conditions at both ends.
    step : (n,) array or None
        Newton's step for `Path.unknowns`; None where the equations are singular.
    """

    residual: Array
    step: Array | None


def transcribed(ends: Ends, cost: Cost, closing: Closing, path: Path) -> Transcription:
    """The equations of the transfer between two ends at a path; the last one determines the duration."""
    nodes, count = path.nodes, path.nodes.shape[1] - 1
    h = path.span / count
    middles = (nodes[:, 1:] + nodes[:, :-1]) / 2
    here = ends.hamiltonian(cost, np.hstack([middles, nodes[:, [0, -1]]]), path.price)
    changes = canonical(here.slopes[:-2]).T
    defects = nodes[:, 1:] - nodes[:, :-1] - h * changes
    met, moving = ends.meeting(path.duration)
    off_start = nodes[:6, 0] - ends.start
    time = here.weight[:-2].sum() / count
    off = np.array(
        [
            *(nodes[:6, -1] - met),
            time * path.span - path.duration,
            here.value[-2],
            _closed(closing, cost, here, path),
        ]
    )
    residual = np.concatenate([defects.ravel(), off_start, off])
    try:
        transfers = _transfers(h, here, changes, defects, off_start)
        final, middle = transfers[-1], (transfers[1:] + transfers[:-1]) / 2
        matrix = np.zeros((9, 10))  # columns: six costates at t0, c, span, duration; the constant
        kept = [*range(8), 9]
        matrix[:6, kept] = final[:6]
        matrix[:6, 8] = -moving
        matrix[6, kept] = h * np.tensordot(here.weight_slopes[:-2], middle, 2)
        matrix[6, 7] += time
        matrix[6, 8] = -1.0
        matrix[7, kept] = here.slopes[-2] @ transfers[0]
        matrix[7, 6] += here.weight[-2]
        if closing is None:
            matrix[8, kept] = here.gain_slopes[-1] @ final
        elif isinstance(closing, Plane):
            matrix[8, kept] = np.tensordot(closing.normal[:-3].reshape(12, -1).T, transfers, 2)
            matrix[8, 6:9] += closing.normal[-3:]
        else:
            matrix[8, 8] = 1.0
        found = np.linalg.solve(matrix[:, :9], -off - matrix[:, 9])
    except np.linalg.LinAlgError:
        return Transcription(residual, None)
    moved = (transfers @ np.append(found[:8], 1.0)).T
    return Transcription(residual, np.append(moved.ravel(), found[6:]))


def _closed(closing: Closing, cost: Cost, here: Hamiltonian, path: Path) -> float:
    """The residual of the last equation."""
    if closing is None:
        return float(here.gain[-1]) - cost.time_weight
    if isinstance(closing, Plane):
        return float(closing.normal @ path.unknowns) - closing.offset
    return path.duration - closing


def canonical(slopes: Array) -> Array:
    """Rates of elements and costates from the derivatives of a Hamiltonian, (n, 12, ...)."""
    return np.concatenate([slopes[:, 6:], -slopes[:, :6]], axis=1)


def _transfers(h: float, here: Hamiltonian, changes: Array, defects: Array, off_start: Array) -> Array:
    """Changes of the nodes, (N + 1, 12, 9), by six costates at t0, c, span, and the constant part.

    A step of the midpoint rule, (1 - A) x' = (1 + A) x + b, is x' = (2 M - 1) x + M b with M = 1/(1 - A).

    Raises
    ------
    LinAlgError
        If the length of a step makes its equations singular.
    """
    count = defects.shape[1]
    unit = np.eye(12)
    others = [h * canonical(here.weight_slopes[:-2]), changes.T / count, -defects.T]
    right = np.concatenate([np.broadcast_to(unit, (count, 12, 12)), np.stack(others, axis=2)], axis=2)
    solved = np.linalg.solve(unit - h / 2 * canonical(here.curvatures[:-2]), right)
    # Three further rows hold the factors of c, span and the constant part, which do not change.
    steps = np.zeros((count, 15, 15))
    steps[:, :12] = solved
    steps[:, :12, :12] *= 2
    steps += np.diag([-1.0] * 12 + [1.0] * 3)
    found = np.zeros((count + 1, 15, 9))
    found[0, 6:12, :6] = np.eye(6)
    found[0, :6, 8] = -off_start
    found[0, 12:, 6:] = np.eye(3)
    for step, before, after in zip(steps, found[:-1], found[1:], strict=True):
        np.matmul(step, before, out=after)
    return found[:, :12]


def extremal(ends: Ends, cost: Cost, closing: Closing, guess: Path, accuracy: float = ACCURACY) -> Path:
    """The transcribed extremal that Newton's method reaches, with full steps that become shorter.

    Raises
    ------
    NotConverged
        If it reaches none.
    """
    path, last = guess, math.inf
    for _ in range(ITERATIONS):
        with np.errstate(all="ignore"):
            step = transcribed(ends, cost, closing, path).step
        if step is None or not np.isfinite(step).all():
            raise NotConverged("the equations of a transfer are singular", math.inf)
        before, path = path, Path.of(path.unknowns + step)
        correction = distance(before, path)
        if correction > min(LARGEST, CONTRACTION * last) or not _admissible(ends, path):
            raise NotConverged("no transcribed extremal was reached from a guess", correction)
        if (correction**2 if last == math.inf else expected(correction, last)) < accuracy:
            return path
        last = correction
    raise NotConverged("no transcribed extremal was reached from a guess", last)


def refined(ends: Ends, cost: Cost, duration: float | None, path: Path, doublings: int) -> Path:
    """The transcribed extremal on more nodes, the number of whose intervals is doubled so many times.

    Raises
    ------
    NotConverged
        If it is not reached.
    """
    for _ in range(doublings):
        nodes = np.empty((12, 2 * path.nodes.shape[1] - 1))
        nodes[:, ::2] = path.nodes
        nodes[:, 1::2] = (path.nodes[:, 1:] + path.nodes[:, :-1]) / 2
        path = extremal(ends, cost, duration, replace(path, nodes=nodes), FINELY)
    return path


def distance(one: Path, other: Path) -> float:
    """The largest change of a coordinate, or relative change of the costates, the span or the duration."""
    elements, costates = np.split(np.abs(other.nodes - one.nodes), 2)
    size = max(np.abs(one.nodes[6:]).max(), np.abs(other.nodes[6:]).max())
    dual = max(costates.max(), abs(other.price - one.price)) / size
    times = abs(other.span / one.span - 1), abs(other.duration / one.duration - 1)
    return float(max(elements.max(), dual, *times))


def _admissible(ends: Ends, path: Path) -> bool:
    """Whether a path keeps to where its coordinates are regular, and runs forward."""
    return ends.admissible(path.nodes) and path.span > 0 and path.duration > 0
