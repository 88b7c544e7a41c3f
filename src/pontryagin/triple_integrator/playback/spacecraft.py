"""The spacecraft of the recordings: the body, how it is drawn, its manoeuvres, the times of samples."""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.display.plotting import BLUE, GREEN, GREY, ORANGE, PURPLE, RED
from pontryagin.display.recording import Recording
from pontryagin.numerics.rotation import between, rotated, rotation_vector
from pontryagin.triple_integrator.attitude import RigidBody, impulses
from pontryagin.triple_integrator.norms.energy import minimum_energy
from pontryagin.triple_integrator.norms.impulse import minimum_impulse
from pontryagin.triple_integrator.norms.peak import minimum_peak
from pontryagin.triple_integrator.problem.maneuver import Maneuver
from pontryagin.triple_integrator.problem.programme import Programme

SAMPLES = 401
"""How many evenly spaced times a recording holds."""

NORMS: dict[str, tuple[Callable[[Maneuver], Programme], str]] = {
    "energy": (minimum_energy, BLUE),
    "peak": (minimum_peak, RED),
    "impulse": (minimum_impulse, GREEN),
}
"""The solver and the colour of each norm."""

CHANNEL_COLOURS = (BLUE, RED, GREEN)
"""Colours of the three channels, and of the components of vectors."""

SPACECRAFT = RigidBody([[4.0, 0.3, -0.2], [0.3, 3.0, 0.1], [-0.2, 0.1, 2.0]])
"""The body of the recordings: unequal moments and products of inertia, kg m²."""


def rest_to_rest(angle: float) -> Maneuver:
    """A turn by an angle from rest to rest in six seconds."""
    return Maneuver([0, 0, 0], [angle, 0, 0], tf=6.0)


def sample_times(programmes: Sequence[Programme]) -> Array:
    """Evenly spaced times of the manoeuvre and both sides of every switch and impulse, (k,)."""
    maneuver = programmes[0].maneuver
    first, last = float(maneuver.t0), float(maneuver.tf)
    events = np.concatenate([[*p.breakpoints, *(time for time, _ in impulses(p))] for p in programmes])
    sides = [events, np.nextafter(events, -np.inf), np.nextafter(events, np.inf)]
    return np.unique(np.clip(np.concatenate([np.linspace(first, last, SAMPLES), *sides]), first, last))


def angle_between(attitude: ArrayLike, target: ArrayLike) -> Array:
    """Angle of the turn from attitudes (k, 4) to a target (4,), rad, (k,)."""
    stack = np.asarray(attitude, dtype=float)
    left = rotation_vector(between(stack, np.broadcast_to(target, stack.shape)))
    return np.asarray(np.linalg.norm(left, axis=1))


def draw_spacecraft(
    recording: Recording, entity: str, t: Array, attitude: Array, position: Array, colour: str
) -> None:
    """Draw a bus with two solar wings along its second axis and a dish along its first."""
    recording.body(entity, t, attitude, (1.2, 0.9, 0.9), np.tile(position, (t.size, 1)), colour)
    parts = {
        "wing-left": ((0.0, 1.35, 0.0), (0.9, 1.5, 0.05), PURPLE),
        "wing-right": ((0.0, -1.35, 0.0), (0.9, 1.5, 0.05), PURPLE),
        "dish": ((0.75, 0.0, 0.0), (0.3, 0.5, 0.5), ORANGE),
    }
    for part, (place, size, look) in parts.items():
        recording.body(f"{entity}/{part}", t[:1], [[1, 0, 0, 0]], size, [place], look)


def draw_target(recording: Recording, entity: str, t: Array, attitude: Array, position: Array) -> None:
    """Draw the target attitude as a triad."""
    for i, unit in enumerate(np.eye(3)):
        arm = 2.2 * rotated(unit, attitude)
        recording.path(f"{entity}/{i + 1}", [position, position + arm], GREY, 0.03)
