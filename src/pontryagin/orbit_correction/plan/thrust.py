"""The three sets of admissible impulses, and gauges of stacks of states, each for its own number of steps.

ball    the paper's (12): three successive impulse components together in a ball whose radius is the peak
disc    each impulse (radial, transverse) in a disc: one engine that turns
box     each component within the peak: two engines, the constraint that the paper replaces by the ball
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentValueError, Infeasible
from pontryagin.numerics.jit import compiled
from pontryagin.orbit_correction import arguments
from pontryagin.orbit_correction.gauges.ellipsoids import gauge_of
from pontryagin.orbit_correction.gauges.kinks import flat_gauge
from pontryagin.orbit_correction.gauges.zonotope import zonotope_gauge
from pontryagin.orbit_correction.plan.misses import MISS_SIGNATURE, misses_of
from pontryagin.orbit_correction.system import satellite

THRUSTS = ("ball", "disc", "box")
SIGNATURE = (
    "void(int64,float64[:,:,::1],float64[:,:,::1],int64[::1],float64[:,::1],"
    "float64[:,::1],float64[:,:,::1],float64[:,::1])"
)
COMPILE_FROM = 60
"""The compiled kernels are loaded when the number of states times that of steps exceeds this."""

SPANNING = 2
"""This many steps are enough for the impulses to span the space, whatever the set of impulses."""

KEPT = 1024
"""Factors of at most this many steps are cached: computing them takes most of the time for one state."""

CHUNK = 1_000_000
"""A stack is solved in pieces of at most this many states times steps, to limit the memory for controls."""


def gauges_of(
    kind: int,
    factors: Array,
    gram_factors: Array,
    counts: NDArray[np.int64],
    targets: Array,
    costates: Array,
    controls: Array,
    results: Array,
) -> None:
    """Gauge of each target (rows, 3) for its own number of steps; ``kind`` is the index in `THRUSTS`.

    Targets of two components are speeds, reached by impulses that all act at one place of the orbit.
    """
    for row in range(targets.shape[0]):
        n = counts[row]
        b, psi = targets[row], costates[row]
        if n == 0:
            continue
        if kind < 2 and b.shape[0] == 3:
            found = flat_gauge(factors[:n], gram_factors[n - 1], b, psi, controls[row, :n])
        elif kind == 0:
            found = gauge_of(factors[:n], gram_factors[n - 1], b, psi, controls[row, :n])
        else:
            segments, flat = np.empty((2 * n, 3)), np.empty(2 * n)
            for k in range(n):
                for j in range(2):
                    segments[2 * k + j] = factors[k, :, j]
            found = zonotope_gauge(segments, b, psi, flat)
            for k in range(n):
                controls[row, k] = flat[2 * k : 2 * k + 2]
        results[row, 0], results[row, 1] = found


@dataclass(frozen=True)
class Gauges:
    """Gauges of a stack of states, each for its own number of steps.

    Attributes
    ----------
    lower, upper : (rows,) arrays
        Bounds on the gauges: the lower ones by the costates, the upper ones by the peaks of the controls.
    costates : (rows, 3) array
        Costates psi_0, not normalised.
    controls : (rows, steps, components) array
        Controls in units of the peak.
    """

    lower: Array
    upper: Array
    costates: Array
    controls: Array


@dataclass(frozen=True)
class Scaled:
    """Factors G_k in units of the reach of the impulses along each axis, and the Gramians of the steps.

    Attributes
    ----------
    reach : (n,) array
        Largest entry of the first steps along each axis. It does not depend on the number of steps, so that
        the answer for a state does not depend on the rest of its stack.
    factors : (steps, n, components) array
        G_k / reach.
    gram_factors : (steps, n, n) array
        Cholesky factors of the Gramians after each step, zero where they are singular.
    """

    reach: Array
    factors: Array
    gram_factors: Array

    def up_to(self, steps: int) -> "Scaled":
        """The factors and Gramians of the first steps alone."""
        return Scaled(self.reach, self.factors[:steps], self.gram_factors[:steps])


@dataclass(frozen=True)
class Thrust:
    """A set of admissible impulses with their interval and peak, and the discrete system that they define.

    Attributes
    ----------
    name : str
        One of `THRUSTS`.
    interval, peak : float
        Time between impulses (radians of the orbit) and bound on them (orbital speeds).
    """

    name: str
    interval: float
    peak: float

    @property
    def phase(self) -> float:
        """The interval minus the nearest number of whole revolutions."""
        return satellite.phase(self.interval)

    @property
    def whole_revolutions(self) -> bool:
        """Whether the interval is whole revolutions, to the precision of a floating number of its size.

        If it is, every impulse acts at the same place of the orbit, and none changes the radius there.
        """
        return abs(self.phase) <= min(np.finfo(float).eps * self.interval, 1e-9)

    @property
    def fewest(self) -> int:
        """The fewest steps whose impulses span the space of states."""
        return 1 if self.name == "ball" or self.whole_revolutions else 2

    def factors(self, steps: int) -> Array:
        """G_k of Lemma 1 for unit balls (discs, squares) of impulses, (steps, 3, components)."""
        return self.peak * self.unit_factors(steps)

    def unit_factors(self, steps: int) -> Array:
        """G_k for a peak of 1."""
        make = satellite.step_factors if self.name == "ball" else satellite.impulse_columns
        return make(steps, self.phase)

    def step_transition(self, k: int) -> Array:
        """A(k) of (12), or for disc and box A(k) of the system with one impulse in each step, (3, 3)."""
        if self.name == "ball":
            return satellite.step_transition(k, self.phase)
        return satellite.transition(self.phase)

    def step_input(self, k: int) -> Array:
        """B(k) of (12), or for disc and box B(k) with one impulse in each step, (3, components)."""
        if self.name == "ball":
            return satellite.step_input(k, self.phase)
        return satellite.transition(self.phase)[:, 1:]

    def miss(self, z0: Array, counts: NDArray[np.int64], controls: Array) -> Array:
        """What remains, relative to the states (rows, 3), after controls in units of the peak."""
        transitions, inputs = _motion(self)
        results = np.empty(len(z0))
        run = compiled(misses_of, MISS_SIGNATURE, len(z0) * controls.shape[1] > COMPILE_FROM)
        writable = (np.require(array, requirements=["C", "W"]) for array in (counts, z0, controls))
        run(transitions, inputs, *writable, results)
        return results

    def bounds(self, z0: Array, counts: NDArray[np.int64]) -> tuple[Array, Array]:
        """The lower and upper bounds by `gauges`, computed in pieces so that large stacks fit into memory."""
        lower, upper = np.empty(len(z0)), np.empty(len(z0))
        order = np.argsort(counts, kind="stable")
        while order.size:
            fitting = np.flatnonzero(np.arange(1, order.size + 1) * counts[order] <= CHUNK)
            size = int(fitting[-1]) + 1 if fitting.size else 1
            now, order = order[:size], order[size:]
            found = self.gauges(z0[now], counts[now])
            lower[now], upper[now] = found.lower, found.upper
        return lower, upper

    def gauges(self, z0: Array, counts: NDArray[np.int64]) -> Gauges:
        """Gauges of the states (rows, 3) for their numbers of steps (rows,)."""
        with np.errstate(all="ignore"):
            if self.whole_revolutions:
                return self._gauges_of_speeds(z0, counts)
            alone = counts < self.fewest
            if self.fewest > 1 and alone.any():
                return self._with_first_impulses(z0, counts, alone)
            most = max(int(counts.max(initial=0)), SPANNING)
            if most > KEPT:
                return self._gauges(z0, counts, scaled(self.unit_factors(most), self.fewest))
            return self._gauges(z0, counts, _kept(self, max(16, 1 << (most - 1).bit_length())).up_to(most))

    def first_impulse(self, z0: Array) -> Gauges:
        """Gauges of the states (rows, 3) for disc and box and the impulse at the start alone.

        It leaves the radius as it is. Where that deviates, the gauge is infinite, which the costate (1, 0, 0)
        proves.
        """
        found = self._speeds_by_share(z0, np.ones(len(z0), dtype=np.int64), most=SPANNING)
        beyond = z0[:, 0] != 0
        alpha = np.where(beyond, np.inf, found.lower)
        outward = np.sign(z0[:, :1]) * [-1.0, 0.0, 0.0]
        return Gauges(alpha, alpha, np.where(beyond[:, None], outward, found.costates), found.controls)

    def _with_first_impulses(self, z0: Array, counts: NDArray[np.int64], alone: NDArray[np.bool_]) -> Gauges:
        """The gauges, those of at most one impulse in closed form."""
        first = self.first_impulse(np.where((counts == 1)[:, None], z0, 0.0))
        rest = self.gauges(np.where(alone[:, None], 0.0, z0), np.where(alone, SPANNING, counts))
        lower, upper = np.where(alone, [first.lower, first.upper], [rest.lower, rest.upper])
        controls = np.where(alone[:, None, None], 0.0, rest.controls)
        controls[alone, :1] = first.controls[alone, :1]
        return Gauges(lower, upper, np.where(alone[:, None], first.costates, rest.costates), controls)

    def _gauges(self, z0: Array, counts: NDArray[np.int64], steps: "Scaled") -> Gauges:
        """The gauges, computed in units of the state and of the impulses' reach, since both may be tiny."""
        reach, factors, gram_factors = steps.reach, steps.factors, steps.gram_factors
        most = len(factors)
        size = np.abs(z0).max(axis=1, initial=0.0)
        targets = -z0 / np.where(size > 0, size, 1.0)[:, None] / reach
        longest = np.abs(targets).max(axis=1, initial=0.0)
        targets /= np.where(longest > 0, longest, 1.0)[:, None]
        costates, results = np.zeros_like(targets), np.zeros((len(targets), 2))
        controls = np.zeros((len(targets), most, factors.shape[2]))
        run = compiled(gauges_of, SIGNATURE, len(targets) * most > COMPILE_FROM)
        run(THRUSTS.index(self.name), factors, gram_factors, counts, targets, costates, controls, results)
        scale = size / self.peak * longest
        lower, upper = results.T * scale
        return Gauges(lower, upper, costates / reach, controls * scale[:, None, None])

    def _gauges_of_speeds(self, z0: Array, counts: NDArray[np.int64]) -> Gauges:
        """The gauges where all impulses act at one place of the orbit and change only the speeds."""
        if z0[:, 0].any():
            raise Infeasible(
                f"interval = {self.interval} is a whole number of revolutions: all impulses act at one place "
                f"of the orbit, where none changes the radius; z0 = {z0[np.argmax(z0[:, 0] != 0)].tolist()} "
                "cannot be corrected",
                "interval",
            )
        speeds, most = z0[:, 1:], max(int(counts.max(initial=0)), SPANNING)
        if self.name == "ball":
            found = self._gauges(speeds, counts, scaled(self.unit_factors(most)[:, 1:], self.fewest))
            costates = np.pad(found.costates, ((0, 0), (1, 0)))
            return Gauges(found.lower, found.upper, costates, found.controls)
        return self._speeds_by_share(z0, counts, most)

    def _speeds_by_share(self, z0: Array, counts: NDArray[np.int64], most: int) -> Gauges:
        """Gauges of the speeds, for disc and box, where each impulse takes an equal share of them."""
        share = -z0[:, 1:] / self.peak / np.maximum(counts, 1)[:, None]
        acting = np.arange(most) < counts[:, None]
        if self.name == "disc":
            alpha, costates = np.hypot(*share.T), share
        else:
            alpha = np.abs(share).max(axis=1)
            costates = np.where(np.abs(share) == alpha[:, None], share, 0.0)
        controls = share[:, None] * acting[..., None]
        return Gauges(alpha, alpha, np.pad(costates, ((0, 0), (1, 0))), controls)


def thrust_of(thrust: str, interval: ArrayLike, peak: ArrayLike) -> Thrust:
    """The set of impulses that a user names, with its interval and peak checked."""
    if thrust not in THRUSTS:
        raise ArgumentValueError(f"thrust must be one of {', '.join(THRUSTS)}, got {thrust!r}", "thrust")
    spacing = arguments.positive_number("interval", interval)
    return Thrust(thrust, spacing, arguments.positive_number("peak", peak))


def scaled(factors: Array, fewest: int) -> Scaled:
    """The scaled factors (steps, n, components), with Gramians from `fewest` steps on."""
    reach = np.maximum(np.abs(factors[:SPANNING]).max(axis=(0, 2)), 1e-300)
    units = np.ascontiguousarray(factors / reach[:, None])
    gram = np.cumsum(np.einsum("kij,klj->kil", units, units), axis=0)
    gram_factors = np.zeros_like(gram)
    gram_factors[fewest - 1 :] = np.linalg.cholesky(gram[fewest - 1 :])
    return Scaled(reach, units, gram_factors)


@lru_cache(maxsize=32)
def _kept(thrust: Thrust, steps: int) -> Scaled:
    return scaled(thrust.unit_factors(steps), thrust.fewest)


@lru_cache(maxsize=32)
def _motion(thrust: Thrust) -> tuple[Array, Array]:
    """A(k) and B(k) of an even and an odd step, in units of the peak."""
    transitions = np.stack([thrust.step_transition(k) for k in range(2)])
    return transitions, thrust.peak * np.stack([thrust.step_input(k) for k in range(2)])
