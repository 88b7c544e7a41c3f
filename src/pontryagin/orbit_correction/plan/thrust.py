"""The three sets of admissible impulses, and their gauges for states and numbers of steps side by side.

ball    the paper's: three impulse components in succession, together in a ball of the peak's radius
disc    each impulse (radial, transverse) in a disc: an engine that turns
box     each component within the peak: two engines, and the paper's own constraint before its last step
"""

from dataclasses import dataclass
from functools import lru_cache
from math import fabs

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.errors import Infeasible
from pontryagin.numerics.jit import compiled
from pontryagin.orbit_correction.gauges.ellipsoids import gauge_of
from pontryagin.orbit_correction.gauges.kinks import flat_gauge
from pontryagin.orbit_correction.gauges.zonotope import zonotope_gauge
from pontryagin.orbit_correction.system import satellite

THRUSTS = ("ball", "disc", "box")
SIGNATURE = (
    "void(int64,float64[:,:,::1],float64[:,:,::1],int64[::1],float64[:,::1],"
    "float64[:,::1],float64[:,:,::1],float64[:,::1])"
)
MISS_SIGNATURE = (
    "void(float64[:,:,::1],float64[:,:,::1],int64[::1],float64[:,::1],float64[:,:,::1],float64[::1])"
)
COMPILE_FROM = 60
"""States times steps from which loading the compiled kernel pays."""

FIRST = 2
"""Steps whose impulses span the space, for every thrust."""

KEPT = 1024
"""Up to this many steps the factors are kept for the next call: they are most of what one state costs."""

CHUNK = 1_000_000
"""States times steps for which controls are kept at a time."""


def gauges_of(kind, factors, gram_factors, counts, targets, costates, controls, results):
    """Gauge of each target (rows, 3) for its own number of steps; ``kind`` is the index in `THRUSTS`."""
    width = factors.shape[2]
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
                    for i in range(3):
                        segments[2 * k + j, i] = factors[k, i, j]
            found = zonotope_gauge(segments, b, psi, flat)
            for k in range(n):
                for j in range(width):
                    controls[row, k, j] = flat[2 * k + j]
        results[row, 0], results[row, 1] = found


def misses_of(transitions, inputs, counts, states, controls, results):
    """What remains of each state (rows, 3) after its steps, flown one by one, relative to its start.

    ``transitions`` and ``inputs`` hold the matrices of an even and an odd step.
    """
    current, following = np.empty(3), np.empty(3)
    for row in range(states.shape[0]):
        size = 0.0
        for i in range(3):
            current[i] = states[row, i]
            size = max(size, fabs(current[i]))
        for k in range(counts[row]):
            parity = k % 2
            for i in range(3):
                following[i] = 0.0
                for j in range(3):
                    following[i] += transitions[parity, i, j] * current[j]
                for j in range(inputs.shape[2]):
                    following[i] += inputs[parity, i, j] * controls[row, k, j]
            for i in range(3):
                current[i] = following[i]
        left = 0.0
        for i in range(3):
            left = max(left, fabs(current[i]))
        results[row] = left / size if size > 0.0 else 0.0


@dataclass(frozen=True)
class Gauges:
    """Gauges of states, each for its own number of steps: bounds, costates and controls."""

    lower: Array
    upper: Array
    costates: Array
    controls: Array


@dataclass(frozen=True)
class Scaled:
    """Factors of steps in units of their reach along each axis, and what their sums need.

    Attributes
    ----------
    reach : (n,) array
        That of the first steps: a state's answer does not depend on what else is in the stack.
    factors : (steps, n, components) array
    gram_factors : (steps, n, n) array
        Cholesky factors of the Gramians after each step, zero where they are singular.
    """

    reach: Array
    factors: Array
    gram_factors: Array

    def first(self, steps: int) -> "Scaled":
        """The same for fewer steps."""
        return Scaled(self.reach, self.factors[:steps], self.gram_factors[:steps])


@dataclass(frozen=True)
class Thrust:
    """What the impulses of a step do to the initial state, for as many steps as asked.

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
        """The interval less whole revolutions."""
        return satellite.phase(self.interval)

    @property
    def whole_revolutions(self) -> bool:
        """Whether every impulse acts at the same place of the orbit; then none changes the radius there.

        An interval is that when no number of its size is closer to whole revolutions.
        """
        return abs(self.phase) <= min(np.finfo(float).eps * self.interval, 1e-9)

    @property
    def fewest(self) -> int:
        """Steps below which the impulses span less than the space."""
        return 1 if self.name == "ball" or self.whole_revolutions else 2

    def factors(self, steps: int) -> Array:
        """G_k, (steps, 3, components)."""
        return self.peak * self.unit_factors(steps)

    def unit_factors(self, steps: int) -> Array:
        """G_k for a peak of 1."""
        make = satellite.step_factors if self.name == "ball" else satellite.impulse_columns
        return make(steps, self.phase)

    def step_transition(self, k: int) -> Array:
        """A(k), (3, 3)."""
        if self.name == "ball":
            return satellite.step_transition(k, self.phase)
        return satellite.transition(self.phase)

    def step_input(self, k: int) -> Array:
        """B(k), (3, components)."""
        if self.name == "ball":
            return satellite.step_input(k, self.phase)
        return satellite.transition(self.phase)[:, 1:]

    def miss(self, z0: NDArray, counts: NDArray, controls: NDArray) -> Array:
        """What remains of the states (rows, 3) after flying their controls (in units of the peak)."""
        transitions, inputs = _motion(self)
        results = np.empty(len(z0))
        run = compiled(misses_of, MISS_SIGNATURE, len(z0) * controls.shape[1] > COMPILE_FROM)
        run(transitions, inputs, counts, np.ascontiguousarray(z0), controls, results)
        return results

    def bounds(self, z0: Array, counts: NDArray[np.int64]) -> tuple[NDArray, NDArray]:
        """Lower and upper bounds on the gauges, as `gauges` gives them, whatever the size of the stack."""
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
            most = max(int(counts.max(initial=0)), FIRST)
            if most > KEPT:
                return self._gauges(z0, counts, scaled(self.unit_factors(most), self.fewest))
            return self._gauges(z0, counts, _kept(self, max(16, 1 << (most - 1).bit_length())).first(most))

    def _gauges(self, z0: NDArray, counts: NDArray[np.int64], steps: "Scaled") -> Gauges:
        """Solved in units of the state and of the impulses' reach along each axis: both may be tiny."""
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
        return Gauges(
            results[:, 0] * scale,
            results[:, 1] * scale,
            costates / reach,
            controls * scale[:, None, None],
        )

    def _gauges_of_speeds(self, z0: NDArray, counts: NDArray[np.int64]) -> Gauges:
        """Impulses that all act at one place: they change the speeds alone, and share the work equally."""
        if z0[:, 0].any():
            raise Infeasible(
                f"interval = {self.interval} is a whole number of revolutions: all impulses act at one place "
                f"of the orbit and leave the radius as it is; z0 = {z0[np.argmax(z0[:, 0] != 0)].tolist()} "
                "cannot be corrected"
            )
        speeds, most = z0[:, 1:], max(int(counts.max(initial=0)), FIRST)
        if self.name == "ball":
            found = self._gauges(speeds, counts, scaled(self.unit_factors(most)[:, 1:], self.fewest))
            costates = np.pad(found.costates, ((0, 0), (1, 0)))
            return Gauges(found.lower, found.upper, costates, found.controls)
        share = -speeds / self.peak / np.maximum(counts, 1)[:, None]
        acting = np.arange(most) < counts[:, None]
        if self.name == "disc":
            alpha, costates = np.hypot(*share.T), share
        else:
            alpha = np.abs(share).max(axis=1)
            costates = np.where(np.abs(share) == alpha[:, None], share, 0.0)
        controls = share[:, None] * acting[..., None]
        return Gauges(alpha, alpha, np.pad(costates, ((0, 0), (1, 0))), controls)


def scaled(factors: Array, fewest: int) -> Scaled:
    """What the gauges need of the factors (steps, n, components), with Gramians from `fewest` steps on."""
    reach = np.maximum(np.abs(factors[:FIRST]).max(axis=(0, 2)), 1e-300)
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
