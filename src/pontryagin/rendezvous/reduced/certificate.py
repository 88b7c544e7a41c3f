"""The certificate of an extremal: the conditions of the maximum principle, evaluated in three ways.

The reduced flight is compared with the 16 equations, integrated by another method, and with Newton's law in
inertial axes. Condition (6) is tested with the attitude of the 16 equations; lambda* and -lambda* are the
same attitude.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from pontryagin.arrays import Array
from pontryagin.certificate import MaximumPrinciple
from pontryagin.numerics.rotation import conjugate, product, rotated
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.reduced.flight import (
    Flight,
    switching,
)
from pontryagin.rendezvous.reduced.quadrature import energy
from pontryagin.rendezvous.root import Root, scales
from pontryagin.rendezvous.witness.cartesian import (
    cartesian_of,
    fly_cartesian,
    integrate,
    target_by_kepler,
)
from pontryagin.value import value_class

SAMPLES = 201  # evenly spaced times at which the flight is tested
FAINT = 1e-3
"""Smallest unit in which H is measured, as a share of the largest costate, for small running costs."""
TINY = 1e-300  # keeps relative errors of zero from being 0/0


@value_class
@dataclass(frozen=True, eq=False)
class RendezvousCertificate(MaximumPrinciple):
    """Residuals of a rendezvous, in units with p* = c* = fM = 1; no bound on the cost of other controls.

    Parameters
    ----------
    boundary : () array
        Residual of (5).
    transversality : () array
        Residual of (16) and, for a free duration, of the law for the thrust at the end.
    hamiltonian : () array
        |H| for a free duration, the change of H for a fixed one. Its unit is the largest running cost, or a
        thousandth of the largest costate if that is more: where almost no thrust is needed, the costates
        determine the rounding error of H.
    maximality : () array
        As in `MaximumPrinciple`, in the unit of ``hamiltonian``.
    attitude : () array
        |vect(lambda~ o lambda*)| of (6) at the meeting, with lambda integrated by its own equation.
    agreement : () array
        Largest difference during the flight between the reduced equations and the 16 equations, and between
        the reduced equations and Newton's law in inertial axes, where n is the costate of the velocity;
        costates are relative to the largest.
    cartesian : () array
        Distance between craft and target at the meeting, and difference of their velocities, by Newton's
        law in inertial axes and Kepler's equation.
    cost : () array
        Relative difference between the integral of p^2 and the same integral along Newton's law.
    condition : () array
        Condition number of the shooting equations: the factor by which errors of the costates can be larger
        than the residuals.

    Examples
    --------
    >>> import math
    >>> from pontryagin.rendezvous import Chaser, Orbit, Rendezvous, solve
    >>> target = Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6)
    >>> leap = Rendezvous(Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]), target, time_weight=0, energy_weight=1,
    ...                   peak=math.inf, duration=6.0)
    >>> proof = solve(leap).certificate
    >>> proof.holds(1e-10), bool(proof.condition < 1e3)
    (True, True)
    """

    attitude: Array
    agreement: Array
    cartesian: Array
    cost: Array
    condition: Array

    @cached_property
    def residual(self) -> Array:
        """The largest of all entries but the condition number."""
        own = (self.boundary, self.transversality, self.hamiltonian, self.maximality)
        return np.asarray(np.max([*own, self.attitude, self.agreement, self.cartesian, self.cost], axis=0))


def certify(root: Root[Flight], weights: tuple[float, float], free: bool) -> RendezvousCertificate:
    """Evaluate every condition independently; weights are alpha1 and alpha2 in the solver's units."""
    flight = root.flight
    times = np.linspace(0, flight.duration, SAMPLES)
    reduced, whole, inertial = flight.sample(times), fly_full(flight, times), fly_cartesian(flight, times)
    thrust = flown_thrust(flight, times, reduced)
    running = float(np.max(weights[0] + weights[1] * np.sum(thrust**2, axis=1)))
    largest = max(running, FAINT * float(np.abs(flight.costates).max()), TINY)
    constant = anomaly_constant(flight)
    values = hamiltonian(reduced, thrust, constant, weights)
    end = whole[-1]
    goal, _ = flight.scaled.target(float(end[3]))
    law = terminal_law(reduced[-1], thrust[-1], weights) / largest if free else 0.0
    return RendezvousCertificate(
        boundary=np.abs(reduced[-1, :3] - goal[:3]).max(),
        transversality=np.maximum(abs(law), transversality(end, flight.scaled.eccentricity)),
        hamiltonian=np.abs(values - (0.0 if free else values[-1])).max() / largest,
        maximality=np.asarray(np.max(maximality(flight, reduced, thrust, weights)) / largest),
        attitude=np.abs(product(conjugate(end[4:8]), goal[3:])[1:]).max(),
        agreement=np.maximum(agreement(flight, reduced, whole), newton_agreement(flight, reduced, inertial)),
        cartesian=np.abs(inertial[-1, :6] - target_by_kepler(flight.scaled, flight.duration)).max(),
        cost=np.asarray(abs(energy(flight) - inertial[-1, 12]) / max(float(inertial[-1, 12]), TINY)),
        condition=np.asarray(condition(root)),
    )


def fly_full(flight: Flight, times: Array) -> Array:
    """The 16 equations at ascending times, (k, 16), by DOP853: nu0 = 0 and lambda0 = 1 at the start."""
    scaled, z = flight.scaled, flight.costates
    grown = (1 + scaled.eccentricity * np.cos(scaled.anomaly)) ** 2
    pair = anomaly_constant(flight) / grown
    start = np.concatenate([scaled.start, [scaled.anomaly, 1, 0, 0, 0], z[:3], [pair, 0.0], z[3:]])

    def rates(mode: str) -> Callable[[Array], Array]:
        kernel, scale = getattr(kernels, f"full_{mode}"), flight.peak if mode == "saturated" else 1.0
        return lambda x: np.array(kernel(*x, 1.0, 1.0, scaled.eccentricity, 1.0, scale))

    return integrate(rates, flight, start, times)


def anomaly_constant(flight: Flight) -> float:
    """C_phi as (16) requires it."""
    end = flight.end
    return float(
        kernels.anomaly_constant(end[4], end[5], end[9], end[3], 1.0, flight.scaled.eccentricity, 1.0)
    )


def transversality(end: Array, eccentricity: float) -> float:
    """Residual of (16) at the end of the 16 equations, relative to the largest costate."""
    rho, s1, _, pair = end[8:12]
    nu3 = product(conjugate(end[4:8]), end[12:])[3]
    wanted = kernels.anomaly_constant(rho, s1, nu3, end[3], 1.0, eccentricity, 1.0)
    constant = pair * (1 + eccentricity * np.cos(end[3])) ** 2
    return float(abs(constant - wanted) / max(np.abs(end[8:]).max(), TINY))


def flown_thrust(flight: Flight, times: Array, states: Array) -> Array:
    """The thrust, (k, 3), of the mode in which each arc was integrated, independent of |n|."""
    begins = np.array([piece.begin for piece in flight.pieces])
    which = np.clip(np.searchsorted(begins, times, side="right") - 1, 0, None)
    saturated = np.array([piece.mode == "saturated" for piece in flight.pieces])[which]
    n = switching(states)
    size = np.linalg.norm(n, axis=-1)
    magnitude = np.where(saturated, flight.peak if saturated.any() else 0.0, size / 2)
    return n * (magnitude / np.where(size > 0, size, 1.0))[:, None]


def hamiltonian(states: Array, thrust: Array, constant: float, weights: tuple[float, float]) -> Array:
    """H of (17) at the given states."""
    r, v1, c, _, rho, s1, e, nu1, nu2, nu3 = states.T[:10]
    inputs = [r, v1, c, rho, s1, e, nu1, nu2, nu3, *thrust.T, constant, 1.0, 1.0, 1.0, *weights]
    return np.asarray(kernels.hamiltonian(*inputs))


def terminal_law(state: Array, thrust: Array, weights: tuple[float, float]) -> float:
    """(n, p) - alpha1 - alpha2 p^2 at the end."""
    return float(kernels.terminal_law(*[state[0], state[2], *state[5:8], *thrust, *weights]))


def maximality(flight: Flight, states: Array, thrust: Array, weights: tuple[float, float]) -> Array:
    """Difference between the largest H over |p| <= p_max and H at the thrust used, (k,)."""
    n = switching(states)
    size = np.linalg.norm(n, axis=-1)
    best = np.minimum(size / (2 * weights[1]), flight.peak) if weights[1] else flight.peak
    most = size * best - weights[1] * best**2
    used = np.sum(n * thrust, axis=-1) - weights[1] * np.sum(thrust**2, axis=-1)
    excess = np.maximum(np.linalg.norm(thrust, axis=-1) - flight.peak, 0.0)
    return np.asarray(np.abs(most - used) + excess)


def agreement(flight: Flight, reduced: Array, whole: Array) -> float:
    """Largest difference of R, V, rho, s1, e and nu between the reduced and the 16 equations.

    Costates are relative to the largest of them.
    """
    attitude = flight.attitude(reduced)
    places = cartesian_of(reduced, attitude) - cartesian_of(whole, whole[:, 4:8])
    nu = product(conjugate(whole[:, 4:8]), whole[:, 12:])[:, 1:]
    costates = reduced[:, 4:10] - np.hstack([whole[:, 8:11], nu])
    largest = max(np.abs(reduced[:, 4:10]).max(), TINY)
    return float(max(np.abs(places).max(), np.abs(costates).max() / largest))


def newton_agreement(flight: Flight, reduced: Array, inertial: Array) -> float:
    """Largest difference of R, V and n from those of Newton's law, n relative to the largest costate."""
    attitude = flight.attitude(reduced)
    places = cartesian_of(reduced, attitude) - inertial[:, :6]
    n = rotated(switching(reduced), attitude) - inertial[:, 9:12]
    largest = max(np.abs(reduced[:, 4:10]).max(), TINY)
    return float(max(np.abs(places).max(), np.abs(n).max() / largest))


def condition(root: Root[Flight]) -> float:
    """Condition number of the shooting equations, with the unknowns in the units of `scales`."""
    return float(np.linalg.cond(root.equations.jacobian * scales(root.unknowns)))
