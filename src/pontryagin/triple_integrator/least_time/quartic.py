"""Positive roots of a quartic q4 z^4 + ... + q0: isolated by its stationary points, then Newton's method.

The quartics of the least time have q4 = 3.
"""

from math import fabs, sqrt

QUADRATIC = 1e-9
"""Newton's method ends after a relative step this small: the error left, its square, is below rounding."""

THIRD = 1.0 / 3.0

LEADING = 3.0
"""The leading coefficient q4 of both quartics of the least time."""


def quartic(z: float, q0: float, q1: float, q2: float, q3: float, q4: float) -> float:
    """q4 z^4 + q3 z^3 + q2 z^2 + q1 z + q0."""
    return q0 + z * (q1 + z * (q2 + z * (q3 + q4 * z)))


def quartic_slope(z: float, q1: float, q2: float, q3: float, q4: float) -> float:
    """The derivative of `quartic` by z."""
    return q1 + z * (2.0 * q2 + z * (3.0 * q3 + 4.0 * q4 * z))


def root_between(low: float, high: float, q0: float, q1: float, q2: float, q3: float, q4: float) -> float:
    """The root of the quartic between two points of opposite sign, by Newton's method kept in the bracket."""
    rising = quartic(high, q0, q1, q2, q3, q4) > 0.0
    z = 0.5 * (low + high)
    for _ in range(200):
        value, slope = quartic(z, q0, q1, q2, q3, q4), quartic_slope(z, q1, q2, q3, q4)
        if (value > 0.0) == rising:
            high = z
        else:
            low = z
        following = z - value / slope if slope != 0.0 else low - 1.0
        small = fabs(following - z) <= QUADRATIC * fabs(z)
        if not small and not low < following < high:
            following = 0.5 * (low + high)
            small = following == low or following == high
        z = following
        if small:
            break
    return z


def stationary_points(top: float, q1: float, q2: float, q3: float) -> tuple[float, ...]:
    """The stationary points for q4 = 3 in (0, top), ascending; `top` where there are fewer than three."""
    discriminant = q3 * q3 - 8.0 * q2
    first, second, third = top, top, top
    start, start_value, found = 0.0, q1, 0
    bend1, bend2 = top, top
    if discriminant > 0.0:
        root = sqrt(discriminant)
        half = -(q3 + root) if q3 > 0.0 else root - q3
        one = half / 12.0
        two = q2 / (1.5 * half) if half != 0.0 else 0.0
        bend1, bend2 = min(one, two), max(one, two)
    for k in range(3):
        end = bend1 if k == 0 else bend2 if k == 1 else top
        if not start < end <= top:
            continue
        end_value = quartic_slope(end, q1, q2, q3, LEADING)
        if (start_value > 0.0) != (end_value > 0.0):
            point = root_between(start, end, q1, 2.0 * q2, 3.0 * q3, 4.0 * LEADING, 0.0)
            if found == 0:
                first = point
            elif found == 1:
                second = point
            else:
                third = point
            found += 1
        start, start_value = end, end_value
    return first, second, third


def sign_changes(q0: float, q1: float, q2: float, q3: float) -> int:
    """Sign changes among the coefficients: 0 excludes positive roots, 1 implies exactly one (Descartes)."""
    changes, last = 0, 1.0
    for q in (q3, q2, q1, q0):
        if q * last < 0.0:
            changes += 1
            last = -last
    return changes


def upper_bound(q0: float, q1: float, q2: float, q3: float) -> float:
    """Fujiwara's bound: no root is larger in modulus, for q4 = 3."""
    cube_root: float = (fabs(q1) / 3.0) ** THIRD
    return 2.0 * max(fabs(q3) / 3.0, sqrt(fabs(q2) / 3.0), cube_root, sqrt(sqrt(fabs(q0) / 3.0)))
