"""Craft and target in space against time, on to a while after the meeting.

Places are in units of p*, in inertial axes of the target's orbit: the first to its pericentre, the third
across its plane. After the meeting nobody thrusts: the craft coasts as it was left. Where it met the target
they go on as one; where it was misled it goes round beside it, on the target's orbit turned about nu*.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from pontryagin.arrays import Array
from pontryagin.numerics.rotation import about_third, conjugate, product, rotated
from pontryagin.rendezvous.reduced import certificate as certify
from pontryagin.rendezvous.reduced.flight import switching
from pontryagin.rendezvous.reduced.flight import thrust as thrust_of
from pontryagin.rendezvous.reduced.solution import Extremal
from pontryagin.rendezvous.witness.cartesian import target_by_kepler

EVEN = 401
"""Samples evenly spaced."""
TURN = 0.1
"""Largest angle in radians by which the thrust turns from one sample to the next."""
HALVINGS = 8
COASTING = 0.12
"""Share of the duration that is shown after the meeting, in so many samples:"""
COASTED = 49
FARTHEST = 4.0
"""Where an osculating orbit is cut off, in units of the scene's size."""


@dataclass(frozen=True, eq=False)
class Passage:
    """One extremal as a motion in space.

    Attributes
    ----------
    extremal : Extremal
    t : (k,) array
        Times up to the meeting, in the user's unit.
    states : (k, 12) array
        Those of the reduced flight there.
    """

    extremal: Extremal
    t: Array
    states: Array

    @property
    def meeting(self) -> int:
        """Samples up to the meeting, the meeting included."""
        return len(self.t)

    @cached_property
    def times(self) -> Array:
        """Times up to the meeting and after it, (n,)."""
        after = self.t[-1] * (1 + COASTING * np.linspace(0.0, 1.0, COASTED)[1:])
        return np.concatenate([self.t, after])

    @cached_property
    def anomaly(self) -> Array:
        """phi* at `times`, after the meeting by Kepler's equation, modulo revolutions there, (n,)."""
        scaled = self.extremal.problem.scaled
        later = self.times[self.meeting :] / scaled.time
        places = np.array([target_by_kepler(scaled, float(t))[:3] for t in later])
        seen = rotated(places, conjugate(scaled.orientation))
        return np.concatenate([self.states[:, 3], np.arctan2(seen[:, 1], seen[:, 0])])

    @cached_property
    def target_attitude(self) -> Array:
        """eta* at `times`, (n, 4)."""
        return about_third(self.anomaly)

    @cached_property
    def target(self) -> Array:
        """The target's place at `times`, (n, 3)."""
        return self.on_orbit(self.anomaly)

    def on_orbit(self, anomaly: Array) -> Array:
        """Places on the target's orbit, (..., 3)."""
        radius = 1 / (1 + self.extremal.problem.scaled.eccentricity * np.cos(anomaly))
        along = np.stack([np.cos(anomaly), np.sin(anomaly), np.zeros_like(anomaly)], axis=-1)
        return radius[..., None] * along

    @cached_property
    def flown_attitude(self) -> Array:
        """eta up to the meeting, (k, 4)."""
        start = conjugate(self.extremal.problem.scaled.orientation)
        return product(start, self.extremal.flight.attitude(self.states))

    @cached_property
    def turn(self) -> Array:
        """What turns the target's attitude at the end into the craft's, (4,): 1 at a true meeting."""
        whole = product(self.flown_attitude[-1], conjugate(self.target_attitude[self.meeting - 1]))
        return whole if whole[0] >= 0 else -whole

    @property
    def invariant(self) -> Array:
        """The direction of nu*, (3,)."""
        flight = self.extremal.flight
        axis = rotated(flight.costates[3:], conjugate(flight.scaled.orientation))
        return axis / np.linalg.norm(axis)

    @property
    def misled(self) -> bool:
        """Whether the craft ends somewhere else than at the target."""
        return float(self.extremal.certificate.attitude) > 1e-6

    @cached_property
    def attitude(self) -> Array:
        """eta at `times`, (n, 4)."""
        return np.concatenate([self.flown_attitude, product(self.turn, self.target_attitude[self.meeting :])])

    @cached_property
    def place(self) -> Array:
        """The craft's place at `times`, (n, 3)."""
        flown = rotated(self.states[:, :1] * np.array([1.0, 0.0, 0.0]), self.flown_attitude)
        return np.concatenate([flown, self.phantom[self.meeting :]])

    @cached_property
    def phantom(self) -> Array:
        """Where the target would be if the craft had met it, at `times`, (n, 3)."""
        return rotated(self.target, self.turn)

    @cached_property
    def control(self) -> Array:
        """p in eta at `t`, (k, 3), in the user's unit."""
        flight = self.extremal.flight
        return thrust_of(self.states, flight.peak, flight.bang) * self.extremal.problem.scaled.acceleration

    @cached_property
    def thrust(self) -> Array:
        """p in the axes of the scene at `times`, (n, 3): none after the meeting."""
        return np.concatenate(
            [rotated(self.control, self.flown_attitude), np.zeros((len(self.times) - self.meeting, 3))]
        )

    @cached_property
    def primer(self) -> Array:
        """|n| at `t`, (k,), in the user's unit of the running cost over that of the thrust."""
        return np.linalg.norm(switching(self.states), axis=-1) * self._primer_unit

    @property
    def saturation(self) -> float | None:
        """|n| above which the thrust is at its bound; None where there is no such value."""
        flight = self.extremal.flight
        return 2 * flight.peak * self._primer_unit if flight.has_switches else None

    @property
    def _primer_unit(self) -> float:
        scaled = self.extremal.problem.scaled
        return scaled.value / (scaled.time * scaled.acceleration)

    @cached_property
    def hamiltonian(self) -> Array:
        """H at `t`, (k,), at a fixed duration less its value at the end, over the largest running cost."""
        flight, problem = self.extremal.flight, self.extremal.problem
        weights = problem.scaled.weights
        thrust = certify.flown_thrust(flight, self.t / problem.scaled.time, self.states)
        energy = certify.hamiltonian(self.states, thrust, certify.anomaly_constant(flight), weights)
        largest = float(np.max(weights[0] + weights[1] * np.sum(thrust**2, axis=1)))
        return (energy - (0.0 if problem.free else energy[-1])) / largest

    def osculating(self, points: int, some: slice = slice(None)) -> Array:
        """Orbits on which the craft would go on without thrust, from some of the states, (m, points, 3)."""
        r, v1, c = self.states[some, :3].T[..., None]
        angle = np.linspace(0.0, 2 * math.pi, points)
        grown = 1 + (c**2 / r - 1) * np.cos(angle) - c * v1 * np.sin(angle)
        radius = c**2 / np.maximum(grown, c**2 / (FARTHEST * self.size))
        flat = np.stack([radius * np.cos(angle), radius * np.sin(angle), np.zeros_like(radius)], axis=-1)
        return rotated(flat, self.flown_attitude[some][:, None])

    @cached_property
    def size(self) -> float:
        """The largest distance from the centre of attraction."""
        return float(np.linalg.norm(np.concatenate([self.place[: self.meeting], self.target]), axis=1).max())


def passage(extremal: Extremal) -> Passage:
    """An extremal as a motion, with more samples where the thrust turns fast."""
    flight, unit = extremal.flight, extremal.problem.scaled.time
    times = np.union1d(np.linspace(0.0, flight.duration, EVEN), flight.switch_times)
    for _ in range(HALVINGS):
        thrust = flight.thrust(times)
        along = thrust / np.linalg.norm(thrust, axis=1, keepdims=True)
        fast = np.linalg.norm(np.diff(along, axis=0), axis=1) > TURN
        if not fast.any():
            break
        times = np.union1d(times, (times[:-1] + times[1:])[fast] / 2)
    return Passage(extremal, times * unit, flight.sample(times))
