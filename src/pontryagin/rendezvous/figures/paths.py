"""Paths and orbits of craft and target, in inertial axes and the user's units."""

import numpy as np

from pontryagin.arrays import Array
from pontryagin.numerics.rotation import about_third, product, rotated
from pontryagin.rendezvous.problem.rendezvous import Rendezvous
from pontryagin.rendezvous.reduced.flight import Flight
from pontryagin.rendezvous.witness.cartesian import target_by_kepler

EX = np.array([1.0, 0.0, 0.0])


def flight_path(problem: Rendezvous, flight: Flight, count: int = 400) -> tuple[Array, Array, Array]:
    """Times (k,), positions (k, 3) and thrust (k, 3) of the craft."""
    scaled = problem.scaled
    times = np.linspace(0.0, flight.duration, count)
    states = flight.sample(times)
    attitude = product(problem.chaser.attitude, flight.attitude(states))
    places = states[:, :1] * rotated(np.broadcast_to(EX, (count, 3)), attitude)
    thrust = rotated(flight.thrust(times), attitude)
    return times * scaled.time, places * scaled.length, thrust * scaled.acceleration


def target_at(problem: Rendezvous, time: float) -> Array:
    """The target's position at a time, (3,), by Kepler's equation."""
    scaled = problem.scaled
    place = target_by_kepler(scaled, time / scaled.time)[:3] * scaled.length
    return rotated(place, np.asarray(problem.chaser.attitude))


def target_orbit(problem: Rendezvous) -> Array:
    """The target's ellipse, (k, 3)."""
    orbit = problem.target
    angles = np.linspace(0, 2 * np.pi, 181)
    r = orbit.parameter / (1 + orbit.eccentricity * np.cos(angles))
    attitude = product(orbit.attitude, about_third(angles))
    return r[:, None] * rotated(np.broadcast_to(EX, (len(angles), 3)), attitude)


def rotated_orbit(problem: Rendezvous, turn: Array) -> Array:
    """The target's ellipse rotated by a quaternion in inertial axes, (k, 3)."""
    return rotated(target_orbit(problem), turn)


def initial_orbit(problem: Rendezvous) -> Array:
    """The ellipse on which the craft starts, (k, 3)."""
    craft = problem.chaser
    parameter = craft.c**2 / problem.gravity
    along, across = parameter / craft.r - 1, craft.v1 * craft.c / problem.gravity
    angles = np.linspace(0, 2 * np.pi, 181)
    r = parameter / (1 + along * np.cos(angles) + across * np.sin(angles))
    attitude = product(craft.attitude, about_third(angles))
    return r[:, None] * rotated(np.broadcast_to(EX, (len(angles), 3)), attitude)
