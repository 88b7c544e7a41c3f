"""Paths of least energy and fixed duration in Cartesian coordinates, as a nonlinear least-squares problem.

The thrust of a path is R'' + R/r^3. Without a bound every path is admissible, so that the least energy is the
least integral of the square of this over all paths between the ends: a descent leads from any path to an
extremal, and to one that is a minimum among the paths near it. Paths are cubic polynomials between nodes.
The costates at a node are the derivatives of the energy by the place and the velocity of the node.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.laps.cartesian import attraction
from pontryagin.rendezvous.laps.transcription import Path

POINTS, WEIGHTS = (np.polynomial.legendre.leggauss(3)[i] / 2 for i in (0, 1))
POINTS = POINTS + 0.5
"""Points and weights of the quadrature over an interval, in units of its length."""
SHARES = (1.0, 0.5, 0.25, 0.1, 0.0)
"""Shares of the curvature of the attraction in the Hessian; with 0 the step is the Gauss-Newton step."""
SHORTER, SHORTEST, ENOUGH = 0.4, 0.03, 0.1
"""Factor by which a step is shortened, its least length, and the least share of the predicted decrease."""
STEPS = 60
"""Largest number of steps of a descent."""
MOST = 10.0
"""Curves along which s grows by more laps than this are not followed."""
FINE = 8
"""Points of an interval at which the pace is measured where nodes are placed anew."""


@dataclass(frozen=True, eq=False)
class Curve:
    """A path in space.

    Attributes
    ----------
    times : (N + 1,) array
        Ascending times of the nodes, from 0.
    nodes : (N + 1, 6) array
        R and V.
    """

    times: Array
    nodes: Array

    @property
    def ends(self) -> Array:
        """R and V at the beginning of each interval and V, R at its end, (N, 4, 3)."""
        nodes = self.nodes
        return np.stack([nodes[:-1, :3], nodes[:-1, 3:], nodes[1:, :3], nodes[1:, 3:]], axis=1)

    def at(self, times: Array) -> Array:
        """R and V at ascending times, (k, 6)."""
        index = np.clip(np.searchsorted(self.times, times, side="right") - 1, 0, self.times.size - 2)
        steps = np.diff(self.times)[index]
        place, slope, _ = _shapes((times - self.times[index]) / steps)
        ends = self.ends[index]
        factors = np.stack([np.ones_like(steps), steps] * 2, axis=1)
        found = [np.einsum("ka,kad->kd", shape * factors, ends) for shape in (place, slope / steps[:, None])]
        return np.hstack(found)


def _shapes(share: Array) -> tuple[Array, Array, Array]:
    """The four cubic polynomials of R, V, R, V at the ends of a unit interval, and their derivatives."""
    s, zero = share, np.zeros_like(share)
    place = [1 - 3 * s**2 + 2 * s**3, s - 2 * s**2 + s**3, 3 * s**2 - 2 * s**3, s**3 - s**2]
    slope = [6 * s**2 - 6 * s, 1 - 4 * s + 3 * s**2, 6 * s - 6 * s**2, 3 * s**2 - 2 * s]
    bend = [12 * s - 6, 6 * s - 4, 6 - 12 * s, 6 * s - 2 + zero]
    first, second, third = (np.stack(each, axis=-1) for each in (place, slope, bend))
    return first, second, third


PLACES, _, BENDS = _shapes(POINTS)


def spaced(curve: Curve, per_lap: float, fewest: int) -> Curve:
    """The curve on nodes that lie evenly in s, where dt/ds = r^(3/2), so many for each 2 pi of s.

    Raises
    ------
    NotConverged
        If s grows by more laps than `MOST`, as for a curve through the centre.
    """
    inner = np.linspace(curve.times[:-1], curve.times[1:], FINE, endpoint=False)
    fine = np.append(inner.T.ravel(), curve.times[-1])
    with np.errstate(divide="ignore"):
        pace = 1 / kernels.cartesian_pace(*curve.at(fine)[:, :3].T)[0]
    passed = np.append(0.0, np.cumsum(np.diff(fine) * (pace[1:] + pace[:-1]) / 2))
    laps = passed[-1] / (2 * math.pi)
    if not laps <= MOST:
        raise NotConverged("a path in space makes too many laps or passes too near the centre", laps)
    count = max(fewest, math.ceil(per_lap * laps))
    times = np.interp(np.linspace(0.0, passed[-1], count + 1), passed, fine)
    times[[0, -1]] = curve.times[[0, -1]]
    nodes = curve.at(times)
    nodes[[0, -1]] = curve.nodes[[0, -1]]
    return Curve(times, nodes)


@dataclass(frozen=True, eq=False)
class Thrust:
    """The thrust p (N, 3, 3) at the points of each interval, with what Newton's method needs.

    Attributes
    ----------
    values : (N, P, 3) array
        p = R'' - g.
    positions : (N, P, 3) array
        R.
    factors : (2, N, P, 4) array
        Factors of the ends of an interval in R and in R''.
    weights : (N, P) array
        Weights of the quadrature.
    """

    values: Array
    positions: Array
    factors: Array
    weights: Array

    @classmethod
    def of(cls, curve: Curve) -> "Thrust":
        """The thrust that a curve needs."""
        steps = np.diff(curve.times)
        scale = np.stack([np.ones_like(steps), steps] * 2, axis=1)[:, None]
        factors = np.stack([PLACES * scale, BENDS * scale / (steps**2)[:, None, None]])
        positions, accelerations = factors @ curve.ends
        cubes = (positions**2).sum(axis=-1, keepdims=True) ** 1.5
        return cls(accelerations + positions / cubes, positions, factors, WEIGHTS * steps[:, None])

    @property
    def energy(self) -> float:
        """The integral of p^2."""
        return float((self.weights * (self.values**2).sum(axis=-1)).sum())

    def derivatives(self, multipliers: Array | None = None) -> tuple[Array, Array, Array, Array]:
        """Slopes of p in the ends of each interval, (N, P, 3, 12), and derivatives of the energy in these.

        The energy's slopes are (N, 12); two parts of its Hessian, by the slopes of p and by the curvature of
        the attraction, are (N, 12, 12). In the second the multipliers stand for the thrust if given.
        """
        places, bends = self.factors
        count = len(places)
        _, turn, curve = attraction(self.positions, self.values if multipliers is None else multipliers)
        slopes = bends[:, :, None, :, None] * np.eye(3)[:, None]
        slopes = slopes - places[:, :, None, :, None] * turn[:, :, :, None]
        slopes = slopes.reshape(count, -1, 3, 12)
        weighted = 2 * self.weights[..., None, None] * slopes
        by_slopes = np.einsum("njkc,njk->nc", weighted, self.values)
        flat = slopes.reshape(count, -1, 12)
        first = weighted.reshape(count, -1, 12).transpose(0, 2, 1) @ flat
        spread = np.einsum("njik,nja->naijk", -2 * self.weights[..., None, None] * curve, places)
        second = np.einsum("naijk,njb->naibk", spread, places).reshape(count, 12, 12)
        return slopes, by_slopes, first, second


def descended(curve: Curve, accuracy: float) -> Curve:
    """The curve of least energy near a curve, on the same nodes.

    The curvature of the attraction is weighted by the thrust that the last linearised problem predicts, as in
    sequential quadratic programming: on the first curves the true thrust is far from that of the last one.

    Raises
    ------
    NotConverged
        If the predicted decrease stays above the accuracy, in units of the energy.
    """
    from scipy.linalg import cho_solve_banded, cholesky_banded

    here, multipliers = Thrust.of(curve), None
    for _ in range(STEPS):
        slopes, gradient, first, second = here.derivatives(multipliers)
        right = -(gradient[:-1, 6:] + gradient[1:, :6]).ravel()
        plain, curved = _banded(first), _banded(second)
        moved = None
        for share in SHARES:
            try:
                factor = cholesky_banded(plain + share * curved, check_finite=False)
            except np.linalg.LinAlgError:
                continue
            step = cho_solve_banded((factor, False), right, check_finite=False)
            decrease = float(right @ step)
            moved = _shortened(curve, here.energy, step.reshape(-1, 6), decrease)
            if moved is not None:
                break
        if moved is None:
            raise NotConverged("no path of less energy was found near a path", decrease / here.energy)
        length, curve, there = moved
        inner = np.pad(step.reshape(-1, 6), ((1, 1), (0, 0)))
        by_end = np.hstack([inner[:-1], inner[1:]])
        predicted = here.values + np.einsum("njkc,nc->njk", slopes, by_end)
        multipliers = predicted if multipliers is None else multipliers + length * (predicted - multipliers)
        if length == 1 and decrease < accuracy * there.energy:
            return curve
        here = there
    raise NotConverged("the energy of a path did not settle", decrease / here.energy)


def _shortened(
    curve: Curve, energy: float, step: Array, decrease: float
) -> tuple[float, Curve, Thrust] | None:
    """The length of the longest step that lowers the energy enough, with its curve and the thrust."""
    length = 1.0
    while length > SHORTEST:
        nodes = curve.nodes.copy()
        nodes[1:-1] += length * step
        there = replace(curve, nodes=nodes)
        thrust = Thrust.of(there)
        if thrust.energy <= energy - ENOUGH * length * decrease or decrease < 1e-11 * energy:
            return length, there, thrust
        length *= SHORTER
    return None


def _banded(blocks: Array) -> Array:
    """The matrix of the inner nodes as the bands on and above its diagonal, (12, n), from (N, 12, 12)."""
    diagonal, beside = blocks[:-1, 6:, 6:] + blocks[1:, :6, :6], blocks[1:-1, :6, 6:]
    bands = np.zeros((12, 6 * len(diagonal)))
    for i in range(6):
        for j in range(6):
            if j >= i:
                bands[11 - j + i, j::6] = diagonal[:, i, j]
            bands[5 - j + i, 6 + j :: 6] = beside[:, i, j]
    return bands


def path_of(curve: Curve) -> Path:
    """The extremal with its costates, for a curve of least energy whose nodes lie evenly in s."""
    thrust = Thrust.of(curve)
    gradient = thrust.derivatives()[1]
    costates = np.vstack([-gradient[:1, :6], (gradient[:-1, 6:] - gradient[1:, :6]) / 2, gradient[-1:, 6:]])
    nodes = np.hstack([curve.nodes, costates]).T
    pull = attraction(curve.nodes[:, :3], costates[:, 3:])[0]
    plain = (costates[:, 3:] ** 2).sum(axis=1) / 4
    plain += (costates[:, :3] * curve.nodes[:, 3:]).sum(axis=1) + (costates[:, 3:] * pull).sum(axis=1)
    weight = kernels.cartesian_pace(*curve.nodes[:, :3].T)[0]
    span = float((np.diff(curve.times) * (1 / weight[1:] + 1 / weight[:-1]) / 2).sum())
    return Path(nodes, -float(np.median(plain)), span, float(curve.times[-1]))
