"""A rendezvous as a nonlinear programme, by collocation with CasADi and Ipopt.

It uses neither costates nor the axes eta, but Newton's law in inertial axes, Radau collocation of the third
degree on equal intervals with the thrust free at every collocation point, and Kepler's equation for the
target. The start is cold: a path of evenly changing angle, and almost no thrust. As the mesh is refined, the
cost approaches the true one from either side; two meshes show how closely. CasADi is an extra:
``pip install casadi``.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.rotation import about_third, conjugate, product, rotated, twist
from pontryagin.rendezvous.problem.rendezvous import Rendezvous
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.witness.cartesian import (
    cartesian_of,
    target_by_kepler,
)

DEGREE = 3
"""Degree of the collocation polynomials."""


@dataclass(frozen=True)
class Direct:
    """A solution of the nonlinear programme.

    Attributes
    ----------
    duration, cost : float
        t_k and J in the user's units.
    intervals : int
        Number of intervals of the mesh.
    iterations : int
        Number of Ipopt's iterations.
    violation : float
        Largest violation of the constraints, in the solver's units.
    """

    duration: float
    cost: float
    intervals: int
    iterations: int
    violation: float


def direct(
    problem: Rendezvous, guess: float, revolutions: float = 0.5, intervals: int = 60, fuel: bool = False
) -> Direct:
    """Solve a rendezvous as a nonlinear programme, from a cold start.

    Parameters
    ----------
    problem : Rendezvous
        The problem.
    guess : float
        A duration to start from, in the user's unit of time; not used where the duration is prescribed.
    revolutions : float
        Approximate number of revolutions of the initial path; the nearest one that ends at the target
        is used.
    intervals : int
        Number of intervals of the mesh.
    fuel : bool
        Whether alpha2 is the weight of |p| in place of p^2.

    Raises
    ------
    ModuleNotFoundError
        If CasADi is not installed.
    NotConverged
        If Ipopt does not converge.
    """
    import casadi as ca

    scaled = problem.scaled
    opti = ca.Opti()
    fixed = scaled.duration
    start = fixed if fixed is not None else guess / scaled.time
    end_time = opti.variable() if fixed is None else ca.DM(fixed)
    eccentric = opti.variable()
    states, inner, controls = _guess(scaled, start, revolutions, intervals)
    points = ca.collocation_points(DEGREE, "radau")
    slopes, ends, weights = (np.array(ca.DM(matrix)) for matrix in ca.collocation_coeff(points))
    nodes = opti.variable(6, intervals + 1)
    inside = opti.variable(6, intervals * DEGREE)
    thrust = opti.variable(3, intervals * DEGREE)
    size = opti.variable(1, intervals * DEGREE) if fuel else None
    rates = _rates(ca).map(intervals * DEGREE)(inside, thrust)
    step = end_time / intervals
    (alpha1, alpha2), value = scaled.weights, scaled.value
    if fuel:
        alpha1, value = alpha1 * scaled.acceleration, value / scaled.acceleration
    cost = alpha1 * end_time
    opti.subject_to(nodes[:, 0] == cartesian_of(scaled.start, np.array([1.0, 0, 0, 0])))
    for k in range(intervals):
        part = slice(k * DEGREE, (k + 1) * DEGREE)
        whole = ca.horzcat(nodes[:, k], inside[:, part])
        opti.subject_to(whole @ slopes == step * rates[:, part])
        opti.subject_to(nodes[:, k + 1] == whole @ ends)
        if alpha2:
            spent = ca.sum1(thrust[:, part] ** 2) if size is None else size[0, part]
            cost += alpha2 * step * (spent @ weights)
    opti.subject_to(nodes[:, -1] == _target(ca, scaled, eccentric))
    opti.subject_to(
        eccentric - scaled.eccentricity * ca.sin(eccentric) == _mean(scaled) + _motion(scaled) * end_time
    )
    if size is not None:
        opti.subject_to(ca.sum1(thrust**2) / scaled.peak**2 <= (size / scaled.peak) ** 2)
        opti.subject_to(opti.bounded(0, size, scaled.peak))
        opti.set_initial(size, scaled.peak / 2)
    elif scaled.peak < math.inf:
        opti.subject_to(ca.sum1(thrust**2) / scaled.peak**2 <= 1)
    if fixed is None:
        opti.subject_to(opti.bounded(0.2 * start, end_time, 5 * start))
        opti.set_initial(end_time, start)
    opti.set_initial(nodes, states.T)
    opti.set_initial(inside, inner.T)
    opti.set_initial(thrust, controls.T)
    opti.set_initial(eccentric, _mean(scaled) + _motion(scaled) * start)
    opti.minimize(cost)
    options: dict[str, Any] = {"print_level": 0, "sb": "yes", "tol": 1e-10, "max_iter": 2000}
    if fuel:  # Ipopt relaxes bounds by 1e-8, which allows a thrust of 1e-4 at no cost on coasting arcs.
        options["bound_relax_factor"] = 0.0
    opti.solver("ipopt", {"print_time": False, "detect_simple_bounds": True}, options)
    try:
        answer = opti.solve()
    except RuntimeError:
        raise NotConverged(
            f"Ipopt did not converge: {opti.return_status()}", float(opti.stats()["iterations"]["inf_pr"][-1])
        ) from None
    statistics = answer.stats()
    return Direct(
        float(answer.value(end_time)) * scaled.time,
        float(answer.value(cost)) * value,
        intervals,
        int(statistics["iter_count"]),
        float(statistics["iterations"]["inf_pr"][-1]),
    )


def _rates(ca: Any) -> Any:
    """R' = V, V' = -R/r^3 + p, as a CasADi function."""
    x, p = ca.SX.sym("x", 6), ca.SX.sym("p", 3)
    return ca.Function("rates", [x, p], [ca.vertcat(x[3:], p - x[:3] / ca.norm_2(x[:3]) ** 3)])


def _motion(scaled: Scaled) -> float:
    """Mean motion of the target."""
    return float((1 - scaled.eccentricity**2) ** 1.5)


def _mean(scaled: Scaled) -> float:
    """Mean anomaly of the target at t0."""
    e, half = scaled.eccentricity, scaled.anomaly / 2
    begin = 2 * math.atan2(math.sqrt(1 - e) * math.sin(half), math.sqrt(1 + e) * math.cos(half))
    return begin - e * math.sin(begin)


def _target(ca: Any, scaled: Scaled, eccentric: Any) -> Any:
    """R and V of the target at an eccentric anomaly."""
    e = scaled.eccentricity
    axis = 1 / (1 - e**2)
    minor, pace = axis * math.sqrt(1 - e**2), _motion(scaled) / (1 - e * ca.cos(eccentric))
    axes = [rotated(unit, scaled.orientation) for unit in np.eye(3)[:2]]
    place = axes[0] * axis * (ca.cos(eccentric) - e) + axes[1] * minor * ca.sin(eccentric)
    velocity = (-axes[0] * axis * ca.sin(eccentric) + axes[1] * minor * ca.cos(eccentric)) * pace
    return ca.vertcat(place, velocity)


def _guess(scaled: Scaled, duration: float, revolutions: float, intervals: int) -> tuple[Array, Array, Array]:
    """A path of evenly changing angle and inclination at nodes and inner points, and a nearly zero thrust."""
    goal = target_by_kepler(scaled, duration)
    place, velocity = goal[:3], goal[3:]
    normal = np.cross(place, velocity)
    axes = np.column_stack([place / np.linalg.norm(place), np.zeros(3), normal / np.linalg.norm(normal)])
    axes[:, 1] = np.cross(axes[:, 2], axes[:, 0])
    from scipy.spatial.transform import Rotation

    x, y, z, w = Rotation.from_matrix(axes).as_quat()
    relative = np.array([w, x, y, z])
    angle = twist(relative)
    tilt = product(relative, conjugate(about_third(angle)))
    sweep = angle + 2 * math.pi * round(revolutions - angle / (2 * math.pi))
    size = float(np.linalg.norm(tilt[1:]))
    half = math.atan2(size, abs(tilt[0]))
    axis = np.sign(tilt[0] or 1) * tilt[1:] / (size or 1.0)

    def states(share: Array) -> Array:
        attitude = np.column_stack([np.cos(share * half), np.sin(share * half)[:, None] * axis])
        attitude = product(attitude, about_third(share * sweep))
        r = scaled.start[0] + share * (np.linalg.norm(place) - scaled.start[0])
        still = np.zeros_like(r)
        return cartesian_of(np.column_stack([r, still, r**2 * sweep / duration]), attitude)

    import casadi as ca

    shares = np.linspace(0, 1, intervals + 1)
    points = np.array(ca.collocation_points(DEGREE, "radau"))
    inner = (np.arange(intervals)[:, None] + points).ravel() / intervals
    return states(shares), states(inner), np.full((len(inner), 3), 1e-3 * min(scaled.peak, 1.0))
