"""The motion of craft and target in space, up to t_k and for a while after it.

Places are in units of p*, in inertial axes of the target's orbit: the first to its pericentre, the third
along its normal. After t_k the craft coasts. If it met the target, both move on together; after a false
meeting the craft moves on the target's orbit rotated about nu*.
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
"""Number of evenly spaced samples up to t_k, before samples are added where the thrust turns fast."""
TURN = 0.1
"""Largest angle in radians by which the thrust turns from one sample to the next."""
HALVINGS = 8
"""Maximum number of times that an interval between samples is halved."""
COASTING = 0.12
"""Duration of the coasting shown after t_k, as a share of t_k."""
COASTING_SAMPLES = 49
"""Number of samples of the coasting shown after t_k, the one at t_k included."""
FARTHEST = 4.0
"""Distance at which an osculating orbit is cut off, in units of the scene's size."""


@dataclass(frozen=True, eq=False)
class RendezvousMotion:
    """The motion of craft and target that belongs to an extremal.

    Attributes
    ----------
    extremal : Extremal
        The extremal.
    t : (k,) array
        Times up to t_k, in the user's unit.
    states : (k, 12) array
        The reduced flight's states at these times, in the solver's units.
    """

    extremal: Extremal
    t: Array
    states: Array

    @property
    def meeting(self) -> int:
        """Number of samples up to t_k, the one at t_k included."""
        return len(self.t)

    @cached_property
    def times(self) -> Array:
        """Times up to t_k and after it, (n,)."""
        after = self.t[-1] * (1 + COASTING * np.linspace(0.0, 1.0, COASTING_SAMPLES)[1:])
        return np.concatenate([self.t, after])

    @cached_property
    def anomaly(self) -> Array:
        """phi* at `times`, (n,), in radians; after t_k by Kepler's equation, modulo revolutions."""
        scaled = self.extremal.problem.scaled
        later = self.times[self.meeting :] / scaled.time
        places = np.array([target_by_kepler(scaled, float(t))[:3] for t in later])
        in_orbit = rotated(places, conjugate(scaled.orientation))
        return np.concatenate([self.states[:, 3], np.arctan2(in_orbit[:, 1], in_orbit[:, 0])])

    @cached_property
    def target_attitude(self) -> Array:
        """The attitude of eta* at `times`, (n, 4)."""
        return about_third(self.anomaly)

    @cached_property
    def target(self) -> Array:
        """The target's place at `times`, (n, 3)."""
        return self.on_orbit(self.anomaly)

    def on_orbit(self, anomaly: Array) -> Array:
        """Places on the target's orbit at given anomalies, (..., 3)."""
        radius = 1 / (1 + self.extremal.problem.scaled.eccentricity * np.cos(anomaly))
        direction = np.stack([np.cos(anomaly), np.sin(anomaly), np.zeros_like(anomaly)], axis=-1)
        return np.asarray(radius[..., None] * direction)

    @cached_property
    def flown_attitude(self) -> Array:
        """The attitude of eta up to t_k, (k, 4)."""
        start = conjugate(self.extremal.problem.scaled.orientation)
        return product(start, self.extremal.flight.attitude(self.states))

    @cached_property
    def turn(self) -> Array:
        """The quaternion lambda o lambda*~ at t_k, (4,): 1 at a true meeting."""
        relative = product(self.flown_attitude[-1], conjugate(self.target_attitude[self.meeting - 1]))
        return relative if relative[0] >= 0 else -relative

    @property
    def invariant(self) -> Array:
        """The direction of nu*, (3,)."""
        flight = self.extremal.flight
        axis = rotated(flight.costates[3:], conjugate(flight.scaled.orientation))
        return axis / np.linalg.norm(axis)

    @property
    def is_false(self) -> bool:
        """Whether the meeting is false: the attitude at t_k is not that of the target."""
        return float(self.extremal.certificate.attitude) > 1e-6

    @cached_property
    def attitude(self) -> Array:
        """The attitude of eta at `times`, (n, 4)."""
        return np.concatenate([self.flown_attitude, product(self.turn, self.target_attitude[self.meeting :])])

    @cached_property
    def place(self) -> Array:
        """The craft's place at `times`, (n, 3)."""
        flown = rotated(self.states[:, :1] * np.array([1.0, 0.0, 0.0]), self.flown_attitude)
        return np.concatenate([flown, self.rotated_target[self.meeting :]])

    @cached_property
    def rotated_target(self) -> Array:
        """The target's place at `times` rotated by `turn`, where the craft would meet it, (n, 3)."""
        return rotated(self.target, self.turn)

    @cached_property
    def control(self) -> Array:
        """p in eta at `t`, (k, 3), in the user's unit."""
        flight = self.extremal.flight
        return thrust_of(self.states, flight.peak, flight.bang) * self.extremal.problem.scaled.acceleration

    @cached_property
    def thrust(self) -> Array:
        """p in the axes of the scene at `times`, (n, 3); zero after t_k."""
        return np.concatenate(
            [rotated(self.control, self.flown_attitude), np.zeros((len(self.times) - self.meeting, 3))]
        )

    @cached_property
    def primer(self) -> Array:
        """|n| at `t`, (k,), in the user's unit of the running cost over that of the thrust."""
        return np.asarray(np.linalg.norm(switching(self.states), axis=-1) * self._primer_unit)

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
        """H at `t`, (k,), over the largest running cost; for a fixed duration H minus its value at t_k."""
        flight, problem = self.extremal.flight, self.extremal.problem
        weights = problem.scaled.weights
        thrust = certify.flown_thrust(flight, self.t / problem.scaled.time, self.states)
        energy = certify.hamiltonian(self.states, thrust, certify.anomaly_constant(flight), weights)
        largest = float(np.max(weights[0] + weights[1] * np.sum(thrust**2, axis=1)))
        return (energy - (0.0 if problem.free else energy[-1])) / largest

    def osculating(self, points: int, samples: slice = slice(None)) -> Array:
        """The osculating orbits of the craft at some of the samples, (m, points, 3)."""
        r, v1, c = self.states[samples, :3].T[..., None]
        angle = np.linspace(0.0, 2 * math.pi, points)
        growth = 1 + (c**2 / r - 1) * np.cos(angle) - c * v1 * np.sin(angle)
        radius = c**2 / np.maximum(growth, c**2 / (FARTHEST * self.size))
        flat = np.stack([radius * np.cos(angle), radius * np.sin(angle), np.zeros_like(radius)], axis=-1)
        return rotated(flat, self.flown_attitude[samples][:, None])

    @cached_property
    def size(self) -> float:
        """The largest distance from the centre of attraction."""
        return float(np.linalg.norm(np.concatenate([self.place[: self.meeting], self.target]), axis=1).max())


def motion_of(extremal: Extremal) -> RendezvousMotion:
    """The motion of an extremal, with more samples where the direction of the thrust changes fast."""
    flight, unit = extremal.flight, extremal.problem.scaled.time
    times = np.union1d(np.linspace(0.0, flight.duration, EVEN), flight.switch_times)
    for _ in range(HALVINGS):
        thrust = flight.thrust(times)
        direction = thrust / np.linalg.norm(thrust, axis=1, keepdims=True)
        fast = np.linalg.norm(np.diff(direction, axis=0), axis=1) > TURN
        if not fast.any():
            break
        times = np.union1d(times, (times[:-1] + times[1:])[fast] / 2)
    return RendezvousMotion(extremal, times * unit, flight.sample(times))
