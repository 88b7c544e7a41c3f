"""The certificate of an extremal in the elements: the maximum principle, compared with Newton's law.

Newton's law is integrated in Cartesian coordinates, with other costates and another integrator; only the law
of thrust and the switch times are shared.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.certificate import MaximumPrinciple
from pontryagin.errors import NotConverged
from pontryagin.numerics.rotation import product
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.elements.arcs import (
    COSTATES,
    TIME,
)
from pontryagin.rendezvous.elements.elements import (
    I1,
    Elements,
    place,
    place_gradient,
    relation_gradient,
)
from pontryagin.rendezvous.elements.flight import (
    ElementFlight,
    start_of,
    switching,
)
from pontryagin.rendezvous.root import Root, scales
from pontryagin.rendezvous.witness.cartesian import (
    cartesian_of,
    target_by_kepler,
)
from pontryagin.value import value_class

SAMPLES = 201


@value_class
@dataclass(frozen=True, eq=False)
class ElementsCertificate(MaximumPrinciple):
    """Residuals of a rendezvous in the elements, in units with p* = c* = fM = 1.

    No bound on the cost of other controls follows.

    Parameters
    ----------
    boundary : () array
        The largest of the distance between craft and target at the meeting, the difference of their
        velocities, and the error of a fixed duration.
    transversality : () array
        Momentum of the turn (see `turn_momentum`), relative to the largest costate, and for a free duration
        the residual of the terminal law.
    hamiltonian : () array
        For a free duration |H|, with the constant that the target's motion contributes; it must be 0. For a
        fixed duration the change of H. The unit is the largest running cost.
    maximality : () array
        As in `MaximumPrinciple`, in units of the largest running cost.
    cartesian : () array
        Distance between craft and target at the meeting, and difference of their velocities, by Newton's law
        in inertial axes.
    agreement : () array
        Largest difference during the flight between the elements and Newton's law, of R, V and n, with n
        relative to its largest size.
    relation : () array
        Largest |scal(A~ o i1 o B)|.
    switching : () array
        Largest relative difference between |n| and its level at the switches.
    condition : () array
        Condition number of the shooting equations, with the unknowns in the units of `scales`.

    Examples
    --------
    >>> import math
    >>> from pontryagin.rendezvous import Chaser, Orbit, Rendezvous, solve_in_elements
    >>> target = Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6)
    >>> leap = Rendezvous(Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]), target, time_weight=0, energy_weight=1,
    ...                   peak=math.inf, duration=6.0)
    >>> proof = solve_in_elements(leap).certificate
    >>> proof.holds(1e-10), bool(proof.relation < 1e-12)
    (True, True)
    """

    cartesian: Array
    agreement: Array
    relation: Array
    switching: Array
    condition: Array

    @cached_property
    def residual(self) -> Array:
        """The largest of all entries but the condition number."""
        own = (self.boundary, self.transversality, self.hamiltonian, self.maximality)
        return np.asarray(
            np.max([*own, self.cartesian, self.agreement, self.relation, self.switching], axis=0)
        )


def certify(root: Root[ElementFlight], free: bool) -> ElementsCertificate:
    """Evaluate every condition independently."""
    flight = root.flight
    grid = np.linspace(0.0, flight.phi, SAMPLES)
    states = flight.sample(grid)
    thrust, n = flight.thrust(states, grid), switching(states, grid)
    running = running_cost(flight, thrust)
    largest = float(running.max())
    kappa = np.asarray(kernels.element_phase(*[*states[:, :16].T, grid]))
    energy = -running + np.sum(n * thrust, axis=1) + kappa
    law = abs(float(n[-1] @ thrust[-1] - running[-1])) / largest if free else 0.0
    late = 0.0 if free else abs(flight.duration - float(flight.scaled.duration or 0))
    here = place(states[:, :4], states[:, 4:8], grid)
    there = fly_cartesian(flight, states[:, TIME])
    goal = target_by_kepler(flight.scaled, flight.duration)
    size = np.linalg.norm(n, axis=1).max()
    pair = Elements(states[:, :4], states[:, 4:8])
    return ElementsCertificate(
        boundary=np.maximum(np.abs(here[-1] - goal).max(), late),
        transversality=np.maximum(law, turn_momentum(states)),
        hamiltonian=np.abs(energy - (kappa[-1] if free else energy[-1])).max() / largest,
        maximality=np.asarray(np.max(maximality(flight, n, thrust)) / largest),
        cartesian=np.abs(there[-1, :6] - goal).max(),
        agreement=np.maximum(np.abs(there[:, :6] - here).max(), np.abs(there[:, 9:] - n).max() / size),
        relation=np.abs(pair.relation).max(),
        switching=np.asarray(off_level(flight)),
        condition=np.asarray(np.linalg.cond(root.equations.jacobian * scales(root.unknowns))),
    )


def running_cost(flight: ElementFlight, thrust: Array) -> Array:
    """The running cost L at thrusts (k, 3), as (k,)."""
    size = np.linalg.norm(thrust, axis=1)
    if flight.law.bang:
        return np.ones_like(size)
    return np.asarray(flight.law.ratio + (size**2 if flight.law.kind == "square" else size))


def maximality(flight: ElementFlight, n: Array, thrust: Array) -> Array:
    """Difference between the largest H over |p| <= p_max and H at the thrust used, (k,)."""
    size, law = np.linalg.norm(n, axis=1), flight.law
    if law.bang:
        most = size * law.peak
    elif law.kind == "fuel":
        most = np.maximum(size - 1, 0.0) * law.peak
    else:
        best = np.minimum(size / 2, law.peak)
        most = size * best - best**2
    used = np.sum(n * thrust, axis=1) - running_cost(flight, thrust) + (1.0 if law.bang else law.ratio)
    excess = np.maximum(np.linalg.norm(thrust, axis=1) - law.peak, 0.0)
    return np.asarray(np.abs(most - used) + excess)


def turn_momentum(states: Array) -> float:
    """Largest |(a, i1 o A) + (b, i1 o B)|, relative to the largest costate.

    It is the momentum conjugate to turning A and B together, which changes neither R nor V.
    """
    moved = np.hstack([product(I1, states[:, :4]), product(I1, states[:, 4:8])])
    costates = states[:, COSTATES]
    return float(np.abs(np.sum(moved * costates, axis=1)).max() / np.abs(costates).max())


def off_level(flight: ElementFlight) -> float:
    """Largest relative difference between |n| and its level, at the switches."""
    if len(flight.pieces) == 1:
        return 0.0
    states = np.array([piece.whole[:17] for piece in flight.pieces[1:]])
    level = flight.law.constants(flight.pieces[0].mode).level
    return float(np.abs(np.linalg.norm(switching(states, flight.switch_angles), axis=1) / level - 1).max())


def fly_cartesian(flight: ElementFlight, times: Array) -> Array:
    """R, V, psi_R and psi_V, (k, 12), at ascending times, integrated arc by arc by DOP853."""
    from scipy.integrate import solve_ivp

    state = cartesian_start(flight)
    rows = np.empty((len(times), 12))
    begins = np.append(0.0, flight.switch_times)
    for piece, begin, end in zip(flight.pieces, begins, np.append(begins[1:], flight.duration), strict=True):
        peak = flight.law.peak if piece.mode == "saturated" else 0.0
        kernel, scale = (
            (kernels.cartesian_unsaturated, 1.0)
            if piece.mode == "unsaturated"
            else (kernels.cartesian_saturated, peak)
        )

        def rate(
            _: float, x: Array, kernel: Callable[..., ArrayLike] = kernel, scale: float = scale
        ) -> Array:
            return np.array(kernel(*x, 1.0, scale))

        inside = (times >= begin) & (times <= end)
        grid, back = np.unique(np.append(times[inside], end), return_inverse=True)
        result = solve_ivp(rate, (begin, end), state, "DOP853", grid, rtol=3e-14, atol=1e-15)
        if result.status:
            raise NotConverged(
                f"the Runge-Kutta integrator stopped before the end: {result.message}", end - result.t[-1]
            )
        rows[inside], state = result.y.T[back[:-1]], result.y[:, -1]
    return rows


def cartesian_start(flight: ElementFlight) -> Array:
    """R, V and their costates psi at t0.

    (a, b) is M' psi plus a multiple of the relation's gradient, with M the derivative of R and V in A and B.
    """
    craft = start_of(flight.scaled)
    costates = flight.pieces[0].whole[COSTATES]
    columns = np.column_stack([place_gradient(craft).T, relation_gradient(craft)])
    psi = np.linalg.lstsq(columns, costates, rcond=None)[0][:6]
    return np.concatenate([cartesian_of(flight.scaled.start, np.array([1.0, 0, 0, 0])), psi])
