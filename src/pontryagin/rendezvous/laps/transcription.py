"""The extremal of a transfer on a given lap, transcribed by the midpoint rule in equinoctial elements.

The independent variable s runs like the longitude of an undisturbed orbit. The regularised Hamiltonian K
vanishes along the extremal. Unknown are elements and costates at the nodes, the price c of time, the length
of s and the duration. Newton's step eliminates the nodes one after the other, so that nine equations remain.
"""

import math
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.complex_step import jacobian
from pontryagin.numerics.newton import expected
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.laps.equinoctial import Lap

Inputs = NDArray[Any]
"""Floats, or complex numbers for derivatives by a complex step."""

NODES_PER_LAP, FEWEST = 32, 32
"""Intervals of s for each turn, and the fewest intervals."""
ACCURACY, ROUGH = 1e-7, 1e-2
"""Relative correction at which Newton's method ends, and the one that suffices along a continuation."""
ITERATIONS = 8
"""Largest number of steps of Newton's method."""
LARGEST, CONTRACTION = 0.8, 0.7
"""Largest relative correction, and the largest ratio of one to that before."""
THINNEST, ROUNDEST = 0.02, 0.98
"""Smallest parameter, in units of p*, and largest square of the eccentricity, on the way of an iteration."""


class Cost(Protocol):
    """A running cost that depends on the length of the thrust."""

    @property
    def time_weight(self) -> float:
        """The cost without thrust."""

    def gain(self, square: Inputs) -> tuple[Inputs, Inputs]:
        """S, the largest (n, p) less what the thrust costs, and its derivative, as functions of |n|^2."""


@dataclass(frozen=True)
class RunningCost:
    """alpha1 + alpha2 p^2 under a bound on the thrust, with alpha2 = 0 for least time."""

    time_weight: float
    energy_weight: float
    peak: float

    def gain(self, square: Inputs) -> tuple[Inputs, Inputs]:
        """S, the largest (n, p) - alpha2 p^2, and its derivative, as functions of |n|^2."""
        weight, peak = self.energy_weight, self.peak
        if peak == math.inf:
            return square / (4 * weight), np.full_like(square, 1 / (4 * weight))
        size = np.sqrt(square)
        saturated = peak * size - weight * peak**2, peak / (2 * size)
        if weight == 0:
            return saturated
        inside = size.real <= 2 * weight * peak
        return (
            np.where(inside, square / (4 * weight), saturated[0]),
            np.where(inside, 1 / (4 * weight), saturated[1]),
        )


@dataclass(frozen=True, eq=False)
class Path:
    """A transfer at the nodes.

    Attributes
    ----------
    nodes : (12, N + 1) array
        p, f, g, h, k, L and their costates at equal steps of s.
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

    def switching(self) -> Array:
        """|n| at the nodes, (N + 1,)."""
        n = np.array(kernels.equinoctial_switching(*self.nodes))
        return np.asarray(np.linalg.norm(n, axis=0))


def square(nodes: Inputs) -> Inputs:
    """|n|^2 at elements and costates (12, ...)."""
    n = np.array(kernels.equinoctial_switching(*nodes))
    return np.asarray((n * n).sum(axis=0))


def rates(cost: Cost, nodes: Inputs) -> Inputs:
    """Rates by s of elements and costates, and dt/ds, (13, ...), at these and c, (13, ...)."""
    gain, slope = cost.gain(square(nodes[:12]))
    values = kernels.equinoctial_rates(*[*nodes[:12], gain, slope, nodes[12]])
    return np.array(np.broadcast_arrays(*values))


def hamiltonian(cost: Cost, node: Inputs) -> Inputs:
    """K at elements, costates and c, (13, ...)."""
    gain, _ = cost.gain(square(node[:12]))
    weight = kernels.equinoctial_weight(*[*node[:3], node[5]])
    return np.asarray((gain + node[12]) * weight + node[11])


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


def transcribed(lap: Lap, cost: Cost, duration: float | None, path: Path) -> Transcription:
    """The equations of the transfer on a lap, for a fixed duration or a free one, at a path."""
    nodes, count = path.nodes, path.nodes.shape[1] - 1
    h = path.span / count
    middles = np.vstack([(nodes[:, 1:] + nodes[:, :-1]) / 2, np.full(count, path.price)])
    values, slopes = jacobian(lambda x: rates(cost, x), middles)
    defects = nodes[:, 1:] - nodes[:, :-1] - h * values[:12]
    first = np.append(nodes[:, 0], path.price)
    energy, by_first = jacobian(lambda x: hamiltonian(cost, x)[None], first)
    longitude, pace = lap.longitude(path.duration)
    off_start = nodes[:6, 0] - lap.start
    if duration is None:
        law, by_last = jacobian(lambda x: cost.gain(square(x))[0][None], nodes[:, -1])
        last = law[0] - cost.time_weight
    else:
        last = path.duration - duration
    ends = np.array(
        [
            *(nodes[:5, -1] - lap.goal),
            nodes[5, -1] - longitude,
            h * values[12].sum() - path.duration,
            energy[0],
            last,
        ]
    )
    transfers = _transfers(h, defects, values, slopes, off_start)
    if transfers is None:
        return Transcription(np.concatenate([defects.ravel(), off_start, ends]), None)
    final, middle = transfers[-1], (transfers[1:] + transfers[:-1]) / 2
    matrix = np.zeros((9, 10))  # columns: six costates at t0, c, span, duration; the constant
    kept = [*range(8), 9]
    matrix[:6, kept] = final[:6]
    matrix[5, 8] = -pace
    matrix[6, kept] = h * np.einsum("an,nak->k", slopes[12, :12], middle)
    matrix[6, 7] += values[12].sum() / count
    matrix[6, 8] = -1.0
    matrix[7, kept] = by_first[0, :12] @ transfers[0]
    matrix[7, 6] += by_first[0, 12]
    if duration is None:
        matrix[8, kept] = by_last[0] @ final
    else:
        matrix[8, 8] = 1.0
    step = None
    try:
        found = np.linalg.solve(matrix[:, :9], -ends - matrix[:, 9])
        moved = np.moveaxis(transfers @ np.append(found[:8], 1.0), 0, 1)
        step = np.append(moved.ravel(), [found[6], found[7], found[8]])
    except np.linalg.LinAlgError:
        pass
    return Transcription(np.concatenate([defects.ravel(), off_start, ends]), step)


def _transfers(h: float, defects: Array, values: Array, slopes: Array, off_start: Array) -> Array | None:
    """Changes of the nodes, (N + 1, 12, 9), by six costates at t0, c, span, and the constant part."""
    count = defects.shape[1]
    by_node = np.moveaxis(slopes[:12, :12], -1, 0) * h / 2
    others = [h * slopes[:12, 12].T, values[:12].T / count, -defects.T]
    right = np.concatenate([np.eye(12) + by_node, np.stack(others, axis=2)], axis=2)
    try:
        solved = np.linalg.solve(np.eye(12) - by_node, right)
    except np.linalg.LinAlgError:
        return None
    found = np.zeros((count + 1, 12, 9))
    found[0, 6:, :6] = np.eye(6)
    found[0, :6, 8] = -off_start
    for i in range(count):
        np.matmul(solved[i, :, :12], found[i], out=found[i + 1])
        found[i + 1, :, 6:] += solved[i, :, 12:]
    return found


def extremal(lap: Lap, cost: Cost, duration: float | None, guess: Path, accuracy: float = ACCURACY) -> Path:
    """The transcribed extremal that Newton's method reaches, with full steps that become shorter.

    Raises
    ------
    NotConverged
        If it reaches none.
    """
    path, last = guess, math.inf
    for _ in range(ITERATIONS):
        with np.errstate(all="ignore"):
            step = transcribed(lap, cost, duration, path).step
        if step is None or not np.isfinite(step).all():
            raise NotConverged("the equations of a transfer on this lap are singular", math.inf)
        before, path = path, Path.of(path.unknowns + step)
        correction = distance(before, path)
        if correction > min(LARGEST, CONTRACTION * last) or not _admissible(path):
            raise NotConverged("no extremal was reached on this lap", correction)
        if (correction**2 if last == math.inf else expected(correction, last)) < accuracy:
            return path
        last = correction
    raise NotConverged("no extremal was reached on this lap", last)


def distance(one: Path, other: Path) -> float:
    """The largest change of an element, or relative change of the costates, the span or the duration."""
    elements, costates = np.split(np.abs(other.nodes - one.nodes), 2)
    size = max(np.abs(one.nodes[6:]).max(), np.abs(other.nodes[6:]).max())
    dual = max(costates.max(), abs(other.price - one.price)) / size
    times = abs(other.span / one.span - 1), abs(other.duration / one.duration - 1)
    return float(max(elements.max(), dual, *times))


def _admissible(path: Path) -> bool:
    """Whether a path keeps to ellipses and runs forward."""
    p, f, g = path.nodes[:3]
    near = (p > THINNEST).all() and (f**2 + g**2 < ROUNDEST).all()
    return bool(near and path.span > 0 and path.duration > 0)
