"""Newton's law in inertial axes for the craft, and Kepler's equation for the target.

This is an independent check of the solver: it uses other variables, another integrator (SciPy's DOP853) and
another formula for the target's place. It takes only the costates at t0 and the switch times from the solver.
"""

import math
from collections.abc import Callable

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics import kepler
from pontryagin.numerics.rotation import rotated
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.reduced.flight import Flight

Rates = Callable[[Array], Array]
"""A function from a state, (n,), to its rates, (n,)."""


def integrate(rates: Callable[[str], Rates], flight: Flight, start: Array, times: Array) -> Array:
    """States at ascending times, (k, n), integrated arc by arc; ``rates(mode)`` is a mode's `Rates`."""
    from scipy.integrate import solve_ivp

    ends = [*(piece.begin for piece in flight.pieces[1:]), flight.duration]
    rows = np.empty((len(times), len(start)))
    state = np.asarray(start, dtype=float)
    for piece, end in zip(flight.pieces, ends, strict=True):
        rate = rates(piece.mode)

        def along(_: float, x: Array, rate: Rates = rate) -> Array:
            return rate(x)

        inside = (times >= piece.begin) & (times <= end)
        grid, back = np.unique(np.append(times[inside], end), return_inverse=True)
        result = solve_ivp(along, (piece.begin, end), state, "DOP853", grid, rtol=3e-14, atol=1e-15)
        if result.status:
            raise NotConverged(
                f"the Runge-Kutta integrator stopped before the end: {result.message}", end - result.t[-1]
            )
        rows[inside], state = result.y.T[back[:-1]], result.y[:, -1]
    return rows


def cartesian_of(states: Array, attitude: Array) -> Array:
    """R and V, (..., 6), as functions of r, v1, c and the attitude."""
    r, v1, c = np.moveaxis(states[..., :3], -1, 0)
    return np.stack(kernels.cartesian(r, v1, c, *np.moveaxis(attitude, -1, 0)), axis=-1)


def start_of(flight: Flight) -> Array:
    """R, V, psi_R and psi_V at t0, (12,), in the axes eta of t0."""
    scaled = flight.scaled
    place = cartesian_of(scaled.start, np.array([1.0, 0, 0, 0]))
    return np.concatenate([place, kernels.primer(*scaled.start, *flight.costates)])


def fly_cartesian(flight: Flight, times: Array) -> Array:
    """R, V, psi_R, psi_V and the integral of p^2 at ascending times, (k, 13).

    Vectors are in the axes eta of t0, quantities in the units of `Scaled`.
    """

    def rates(mode: str) -> Rates:
        kernel, scale = getattr(kernels, f"cartesian_{mode}"), flight.peak if mode == "saturated" else 1.0

        def along(x: Array) -> Array:
            square = flight.peak**2 if mode == "saturated" else x[9:12] @ x[9:12] / 4
            return np.array([*kernel(*x[:12], 1.0, scale), square])

        return along

    return integrate(rates, flight, np.append(start_of(flight), 0.0), times)


def target_by_kepler(scaled: Scaled, time: float) -> Array:
    """R and V of the target after a time, (6,), from Kepler's equation, in the axes eta of t0."""
    e = scaled.eccentricity
    true = float(kepler.true_anomaly_after(scaled.anomaly, time, 1.0, e))
    sin, cos = math.sin(true), math.cos(true)
    place = np.array([cos, sin, 0.0]) / (1 + e * cos)
    velocity = np.array([-sin, e + cos, 0.0])
    return np.concatenate([rotated(place, scaled.orientation), rotated(velocity, scaled.orientation)])


def separation(flight: Flight) -> Array:
    """R and V of the craft minus those of the target at t_k, (6,); axes and units as in `fly_cartesian`."""
    end = fly_cartesian(flight, np.array([flight.duration]))[0, :6]
    return end - target_by_kepler(flight.scaled, flight.duration)
