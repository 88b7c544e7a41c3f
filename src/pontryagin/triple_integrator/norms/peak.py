"""Least peak (L-infinity): the level from one convex equation, then both switches of (3.4).

The moments are scaled, k = (6 c1/T^3, 2 c2/T^2, c3/T), so that those of a constant control all equal its
level v. The control is v outside [b, a] and -v inside, where a >= b are times to go as shares of T.
"""

from dataclasses import dataclass
from math import copysign, fabs, sqrt
from typing import Any

import numpy as np

from pontryagin.arrays import Array
from pontryagin.certificate import Certificate
from pontryagin.numerics.jit import batched
from pontryagin.triple_integrator.kernels import (
    bang_bang_moments,
    level_equation,
    near_constant_equation,
    peak_bound,
)
from pontryagin.triple_integrator.problem.bang_bang import BangBang
from pontryagin.triple_integrator.problem.maneuver import Maneuver
from pontryagin.triple_integrator.problem.programme import numbers_of, over_stack
from pontryagin.triple_integrator.problem.scales import level_unit
from pontryagin.value import Packed, value_class

EDGE = 1e-14
"""Pieces of the control shorter than this share of T are left out: the rounded moments do not show them."""

QUADRATIC = 1e-9
"""Newton's method ends after a relative step this small: the error left, its square, is below rounding."""


def solve_level(k1: float, k2: float, k3: float) -> tuple[float, ...]:
    """t = 1/v and y = 1 - k3 t of the optimum, for moments whose largest modulus is 1."""
    bound = fabs(peak_bound(k1, k2, k3, 0.75, 0.25))
    reach = 1.0 / max(1.0, bound, 2.0 * fabs(k2 - k3))
    side = copysign(1.0, k1 - 1.5 * k2 + 0.5625 * k3)
    t, y = root_on_side(side, reach, k1, k2, k3)
    if t != 0.0 and 1.0 + k3 * t > 0.25:
        opposite, _ = level_equation(-t, k1, k2, k3)
        if opposite <= 0.0:
            return t, y
    other, other_y = root_on_side(-side, reach, k1, k2, k3)
    if t == 0.0 or (other != 0.0 and fabs(other) < fabs(t)):
        return other, other_y
    return t, y


def root_on_side(side: float, reach: float, k1: float, k2: float, k3: float) -> tuple[float, ...]:
    """The root t of the level equation with the sign `side`, |t| <= reach, and y; t = 0 if there is none."""
    y = 1.0 - side * reach * k3
    if side * k3 > 0.9:
        return narrow_root(side, reach, k1, k2, k3)
    t = side * reach * (1.0 + 1e-12)
    g, slope = level_equation(t, k1, k2, k3)
    if g < 0.0:
        return 0.0, y
    for _ in range(60):
        step = g / slope
        t -= step
        if fabs(step) <= QUADRATIC * fabs(t):
            break
        g, slope = level_equation(t, k1, k2, k3)
    return t, 1.0 - k3 * t


def narrow_root(side: float, reach: float, k1: float, k2: float, k3: float) -> tuple[float, ...]:
    """The root of `root_on_side` near the pole y = 0, found in terms of y: exact for a flip of any width."""
    e2 = k2 - k3
    w = k1 - k3 - 1.5 * e2
    if e2 == 0.0 and w == 0.0:
        return 1.0 / k3, 0.0
    half = 2.0 * w / k3
    root = sqrt(half * half + 3.0 * (e2 / k3) * (e2 / k3))
    y = half + root if half > 0.0 else 3.0 * (e2 / k3) * (e2 / k3) / (root - half)
    low, high = 0.0, 1.0
    if y <= 0.0:
        return 0.0, y
    y = min(y, 0.5)
    for _ in range(100):
        g, slope = near_constant_equation(y, k3, w, e2)
        if g > 0.0:
            low = y
        else:
            high = y
        following = y - g / slope
        converged = fabs(following - y) <= QUADRATIC * y
        if not converged and not low < following < high:
            following = 0.5 * (low + high) if low > 0.0 else 0.25 * y
        y = following
        if converged or y < 1e-300:
            break
    t = (1.0 - y) / k3
    if fabs(t) > reach * (1.0 + 1e-9):
        return 0.0, y
    return t, y


def place_switches(d: float, m: float, edge: float) -> tuple[float, ...]:
    """a and b in [0, 1] from their difference d, which is kept exactly, and their sum m.

    Pieces of the control shorter than the share `edge` are left out.
    """
    if d <= edge:
        return 0.0, 0.0
    a, b = 0.5 * (m + d), 0.5 * (m - d)
    if a >= 1.0 - edge:
        a, b = 1.0, 1.0 - d
    if b <= edge:
        a, b = min(d, 1.0) if a < 1.0 else 1.0, 0.0
    return a, b


def solve_peak(c1: float, c2: float, c3: float, T: float) -> tuple[float, ...]:
    """Signed level v, switches a >= b (shares of T to go; 1 or 0 if none), scaled residual, lower bound."""
    if c1 == 0.0 and c2 == 0.0 and c3 == 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0
    k1, k2, k3 = 6.0 * (c1 / T / T), 2.0 * (c2 / T), c3
    scale = max(fabs(k1), fabs(k2), fabs(k3))
    level = level_unit(scale, T)
    k1, k2, k3 = k1 / scale, k2 / scale, k3 / scale
    t, y = solve_level(k1, k2, k3)
    v = 1.0 / t
    a, b = place_switches(0.5 * y, 1.0 - (k2 - k3) * t / y if y > 0.0 else 1.0, EDGE)
    if a - b >= 1.0:
        a = b = 0.0
        v = -v
    r1, r2, r3 = bang_bang_moments(v, a, b)
    residual = max(fabs(r1 - k1), fabs(r2 - k2), fabs(r3 - k3))
    return v * level, a, b, residual, fabs(peak_bound(k1, k2, k3, a, b)) * level


solve_stack = batched(solve_peak, outputs=5, groups=(4,), packed=True)


@value_class
@dataclass(frozen=True, eq=False)
class PeakSolution(Packed, BangBang):
    """Control of least peak: |u| constant, at most two switches.

    Attributes
    ----------
    maneuver : Maneuver
        The problem that is solved.
    levels : (...) array
        Signed level v of the control near both ends of a two-switch programme.
    shares : (..., 2) array
        Both switches a >= b as shares of T to go. A switch that does not happen is 1 (a) or 0 (b); a = b if
        neither happens.
    certificate : Certificate
        Residual of the moments, relative to the largest; the peak; and the bound by the dual function.
    """

    maneuver: Maneuver
    levels: Array
    shares: Array
    certificate: Certificate

    def _unpacked(self, numbers: Array) -> dict[str, Any]:
        return _answer(numbers[4:])


def _answer(result: Array) -> dict[str, Any]:
    """The fields of a solution from the results of `solve_peak`, (..., 5)."""
    levels = result[..., 0]
    certificate = Certificate(result[..., 3], np.abs(levels), result[..., 4])
    return {"levels": levels, "shares": result[..., 1:3], "certificate": certificate}


def minimum_peak(maneuver: Maneuver) -> PeakSolution:
    """Control of least peak max |u| that performs the manoeuvre, problem 2, (1.19).

    Parameters
    ----------
    maneuver : Maneuver
        One manoeuvre or a stack of them.

    Returns
    -------
    PeakSolution
        The solution is exact to rounding. The dual value of its certificate is |2 c1 - (a+b) c2 + ab c3| over
        the integral of |(s - a)(s - b)|, which is a lower bound for any a and b, by (3.1) and (3.2).

    Examples
    --------
    >>> s = minimum_peak(Maneuver([0, 0, 0], [1, 0, 0], tf=2.0))
    >>> float(s.norm.round(12)), s.switch_times.round(12).tolist(), s.certificate.holds(1e-12)
    (4.0, [0.5, 1.5], True)
    """
    numbers = solve_stack.call(numbers_of(maneuver))
    if numbers is not None:
        solution = PeakSolution.from_numbers(numbers)
        solution.__dict__["maneuver"] = maneuver
        return solution
    return PeakSolution(maneuver, **_answer(over_stack(solve_stack, maneuver)))
