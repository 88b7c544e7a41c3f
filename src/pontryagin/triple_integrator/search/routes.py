"""The paper's own numerical methods ("routes") for the least peak, (3.6) to (3.19), and whether they find it.

The routes look for the zeros t1 < t2 of the dual function. F = S1 - S2 + S3 is the integral of its modulus
if 0 <= t1 < t2 <= T and the curvature alpha is positive; elsewhere F has no such meaning, and where c0 of
(3.5) vanishes it is infinite. Within that domain |F| is stationary at the optimum only, because the norm is
convex on the plane l'c = 1; a search that fails has therefore left the domain, or met its boundary or a
pole. Where t1 > t2 there are points with F = 0 for every c, so that (3.6) without its bounds has no
meaningful minimum, and an unconstrained search is right only if it stays near its start.
"""

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from types import ModuleType
from typing import Any

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, minimize, minimize_scalar

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentValueError
from pontryagin.triple_integrator.norms.peak import minimum_peak
from pontryagin.triple_integrator.problem.maneuver import Maneuver
from pontryagin.value import value_class

ROUTES = ("zeros", "zeros within", "multiplier", "multiplier modulus", "multiplier within")
"""The routes. "zeros" and "zeros within" minimise |F| over t1 and t2 from T/4 and 3T/4, unconstrained (BFGS)
or within 0 <= t1 <= t2 <= T (SLSQP). "multiplier" and "multiplier modulus" minimise F as printed, or |F|,
over lambda~ by Brent's method from 0. "multiplier within" minimises |F| over all lambda~ that put both zeros
within the manoeuvre, on a grid and then from its best three points."""

REASONS = ("singular", "sign", "crossed", "outside", "boundary", "early")
"""Why a search fails; the first reason that applies. "singular": it runs to c0 = 0. "sign": the curvature has
the wrong sign, on the other side of c0 = 0. "crossed": t1 > t2. "outside": a zero lies outside the manoeuvre.
"boundary": a zero lies at an end, or both zeros agree. "early": it stopped before the minimum."""

AGREES = 1e-6
"""A level found counts as the least peak if it differs from the certified one by at most this share."""

GRID = 201
"""Number of points of the grid of "multiplier within"."""


@value_class
@dataclass(frozen=True, eq=False)
class SearchResult:
    """The point at which a route ends.

    Attributes
    ----------
    route : str
        One of ``ROUTES``.
    peak : float
        1/|F|, the route's u0; nan where F is infinite.
    switch_times : (2,) array
        The route's t1 and t2.
    switch_offsets : (2,) array
        Those as times since the start, which a clock far from zero cannot carry.
    curvature : float
        The route's alpha_m by (3.13), which makes l'c = 1.
    curvature_by_multiplier : float
        The route's alpha_m by the corrected (3.16) for the routes over lambda~; else nan. It equals
        `curvature` at the least peak, unless F does not depend on lambda~ (c2 = c3 = 0, as in example 2):
        then lambda~ is arbitrary, and so is this number.
    evaluations : int
        How often F was evaluated; a value and its gradient together count once.
    reason : str
        Empty if `peak` is the least peak, as certified by `minimum_peak`; else one of ``REASONS``.
    """

    route: str
    peak: float
    switch_times: Array
    switch_offsets: Array
    curvature: float
    curvature_by_multiplier: float
    evaluations: int
    reason: str

    @property
    def right(self) -> bool:
        """Whether the level found is the least peak."""
        return not self.reason


@value_class
@dataclass(frozen=True, eq=False)
class Survey:
    """The results of the routes over directions of the moments.

    Attributes
    ----------
    directions : (n, 3) array
        Unit vectors (6 c1/T^3, 2 c2/T^2, c3/T).
    results : dict of str to tuple of SearchResult
        For each route, by its name, one result for each direction.
    """

    directions: Array
    results: dict[str, tuple[SearchResult, ...]]

    def share_right(self, route: str) -> float:
        """Share of the directions on which a route finds the least peak."""
        return float(np.mean([result.right for result in self.results[route]]))

    def table(self) -> dict[str, list[Any]]:
        """One row for each route: shares of the directions by outcome, and the mean number of evaluations."""
        counts = {route: Counter(result.reason for result in found) for route, found in self.results.items()}
        total = len(self.directions)
        columns: dict[str, list[Any]] = {"route": list(counts)}
        for reason in ("", *REASONS):
            columns[reason or "right"] = [count[reason] / total for count in counts.values()]
        columns["evaluations"] = [
            float(np.mean([result.evaluations for result in found])) for found in self.results.values()
        ]
        return columns


def search(maneuver: Maneuver, route: str) -> SearchResult:
    """Run one of the paper's routes to the least peak of one manoeuvre, and judge its result.

    Parameters
    ----------
    maneuver : Maneuver
        One manoeuvre with c other than 0.
    route : str
        One of ``ROUTES``.

    Raises
    ------
    ValueError
        If the route is unknown, c = 0, or the manoeuvre is a stack.

    Examples
    --------
    >>> found = search(Maneuver([0, 0, 0], [1, 0, 0], tf=2.0), "zeros")
    >>> round(found.peak, 9), found.switch_times.round(6).tolist(), found.right
    (4.0, [0.5, 1.5], True)
    """
    if route not in ROUTES:
        raise ArgumentValueError(f"route must be one of {', '.join(ROUTES)}, got {route!r}", "route")
    if maneuver.shape:
        raise ArgumentValueError(
            f"maneuver must be a single manoeuvre, got a stack of shape {maneuver.shape}", "maneuver"
        )
    T = float(maneuver.duration)
    k = maneuver.moments * np.array([6.0, 2.0, 1.0]) / T ** np.array([3.0, 2.0, 1.0])
    size = float(np.abs(k).max())
    if size == 0.0:
        raise ArgumentValueError("maneuver must have moments c other than 0, got c = 0", "maneuver")
    unit = k / size / np.array([6.0, 2.0, 1.0])
    follow = _by_zeros if route.startswith("zeros") else _by_multiplier
    zeros, by_multiplier, evaluations = follow(unit, route)
    with np.errstate(all="ignore"):
        area, _, _, c0 = (float(part) for part in _formulas().area_from_zeros()(*zeros, *unit, 1.0))
        alpha, by_multiplier = (part / (size * T**3) for part in (0.5 / np.float64(c0), by_multiplier))
    certified = minimum_peak(Maneuver([0, 0, 0], unit, tf=1.0))
    peak = size / abs(area) if area and np.isfinite(area) else np.nan
    reason = _judge(zeros, area, float(certified.norm), float(certified.multipliers[0]), c0)
    times, offsets = float(maneuver.t0) + T * zeros, T * zeros
    return SearchResult(route, peak, times, offsets, float(alpha), by_multiplier, evaluations, reason)


def survey(count: int = 200, seed: int = 0, routes: Sequence[str] = ROUTES) -> Survey:
    """Run the routes for random directions of (6 c1/T^3, 2 c2/T^2, c3/T), uniform on the sphere.

    Parameters
    ----------
    count : int
        How many directions.
    seed : int
        Seed of NumPy's default generator.
    routes : sequence of str
        Some of ``ROUTES``.

    Examples
    --------
    >>> survey(count=20, routes=["multiplier within"]).share_right("multiplier within")
    1.0
    """
    directions = np.random.default_rng(seed).normal(size=(count, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    maneuvers = [Maneuver([0, 0, 0], k / np.array([6.0, 2.0, 1.0]), tf=1.0) for k in directions]
    return Survey(directions, {route: tuple(search(m, route) for m in maneuvers) for route in routes})


def _formulas() -> ModuleType:
    """The compiled formulas, imported only when needed because they load SymPy and the derivation."""
    from pontryagin.triple_integrator.search import formulas as route_formulas

    return route_formulas


def _judge(zeros: Array, area: float, least: float, curvature: float, c0: float) -> str:
    """The reason of a `SearchResult`: empty if 1/|area| is the least peak and the zeros lie in [0, 1]."""
    if not np.isfinite(area) or abs(c0) < 1e-6:
        return "singular"
    room = min(zeros[0], 1 - zeros[1], zeros[1] - zeros[0])
    if room >= -1e-9 and abs(abs(area) * least - 1) <= AGREES:
        return ""
    if c0 * curvature < 0:
        return "sign"
    if room < -1e-9:
        return "crossed" if zeros[0] > zeros[1] else "outside"
    return "boundary" if room < 1e-6 else "early"


def _by_zeros(c: Array, route: str) -> tuple[Array, float, int]:
    """Zeros and evaluations of the two-variable minimisation (3.6)."""

    def area(zeros: Array) -> tuple[float, Array]:
        with np.errstate(all="ignore"):
            value, *slopes = (float(part) for part in _formulas().area_from_zeros()(*zeros, *c, 1.0)[:3])
        return abs(value), np.sign(value) * np.array(slopes)

    start = np.array([0.25, 0.75])
    if route == "zeros":
        found = minimize(area, start, jac=True, method="BFGS", options={"gtol": 1e-9})
    else:
        found = minimize(
            area,
            start,
            jac=True,
            method="SLSQP",
            bounds=Bounds([0.0, 0.0], [1.0, 1.0]),
            constraints=LinearConstraint([[-1.0, 1.0]], 0.0, np.inf),
            options={"ftol": 1e-14, "maxiter": 300},
        )
    return np.asarray(found.x, dtype=float), np.nan, int(found.nfev)


def _by_multiplier(c: Array, route: str) -> tuple[Array, float, int]:
    """Zeros, alpha_m and evaluations of the one-variable minimisation (3.15) to (3.19)."""

    def area(multiplier: Array | float) -> Array:
        with np.errstate(all="ignore"):
            t1, t2, _ = _formulas().zeros_from_multiplier()(multiplier, *c, 1.0)
            return np.asarray(_formulas().area_from_zeros()(t1, t2, *c, 1.0)[0])

    if route == "multiplier within":
        multiplier, evaluations = _least_on_a_grid(lambda x: np.abs(area(x)), *multiplier_range(c))
    else:
        value = area if route == "multiplier" else lambda x: np.abs(area(x))
        found = minimize_scalar(lambda x: float(value(x)), bracket=(0.0, 0.01))
        multiplier, evaluations = float(found.x), int(found.nfev)
    with np.errstate(all="ignore"):
        t1, t2, curvature = _formulas().zeros_from_multiplier()(multiplier, *c, 1.0)
    return np.array([float(t1), float(t2)]), float(curvature), evaluations


def multiplier_range(c: Array) -> tuple[float, float]:
    """The interval of lambda~, around 0, that holds the optimum and has 0 <= t1 < t2 <= T, for T = 1.

    The conditions t1 >= 0 and t2 <= T are that two concave quadratics in lambda~, positive at 0, over
    T + lambda~ c3 > 0 are not negative. The optimal |lambda~| is the inverse of the least peak, which is at
    least max |k|.
    """
    reach = 1.0 / float(np.abs(c * np.array([6.0, 2.0, 1.0])).max())
    limits = [-reach, reach]
    if c[2] != 0:
        limits.append(-1.0 / c[2])
    for numerator in _formulas().domain_conditions()(*c, 1.0):
        roots = np.roots(numerator)
        limits += [float(root.real) for root in roots if abs(root.imag) <= 1e-12 * abs(root)]
    return max(x for x in limits if x < 0), min(x for x in limits if x > 0)


def _least_on_a_grid(value: Callable[[Array], Array], low: float, high: float) -> tuple[float, int]:
    """Place of the least value on [low, high], from the grid's three lowest minima, and evaluations used."""
    x = np.linspace(low, high, GRID)
    y = value(x)
    y = np.where(np.isfinite(y), y, np.inf)
    padded = np.concatenate([[np.inf], y, [np.inf]])
    dips = np.flatnonzero((y <= padded[:-2]) & (y <= padded[2:]))
    best, least, evaluations = float(x[np.argmin(y)]), float(y.min()), GRID
    for i in dips[np.argsort(y[dips])][:3]:
        bounds = (x[max(i - 1, 0)], x[min(i + 1, GRID - 1)])
        found = minimize_scalar(
            lambda t: float(value(t)), bounds=bounds, method="bounded", options={"xatol": 1e-12}
        )
        evaluations += int(found.nfev)
        if found.fun < least:
            best, least = float(found.x), float(found.fun)
    return best, evaluations
