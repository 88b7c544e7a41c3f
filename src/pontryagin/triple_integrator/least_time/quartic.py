"""Roots of 3 z^4 + q3 z^3 + q2 z^2 + q1 z + q0 on z > 0: isolated by its stationary points, then Newton."""

from math import fabs, sqrt

QUADRATIC = 1e-9
"""A Newton step this small (relative) leaves an error of its square: below rounding."""

THIRD = 1.0 / 3.0


def quartic(z, q0, q1, q2, q3):
    """3 z^4 + q3 z^3 + q2 z^2 + q1 z + q0."""
    return q0 + z * (q1 + z * (q2 + z * (q3 + 3.0 * z)))


def quartic_slope(z, q1, q2, q3):
    """Its derivative."""
    return q1 + z * (2.0 * q2 + z * (3.0 * q3 + 12.0 * z))


def root_between(low, high, q0, q1, q2, q3):
    """The root of the quartic between two points of opposite sign: Newton, kept in the bracket."""
    rising = quartic(high, q0, q1, q2, q3) > 0.0
    z = 0.5 * (low + high)
    for _ in range(200):
        value, slope = quartic(z, q0, q1, q2, q3), quartic_slope(z, q1, q2, q3)
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


def slope_root_between(low, high, q1, q2, q3):
    """The root of the quartic's derivative between two points of opposite sign."""
    rising = quartic_slope(high, q1, q2, q3) > 0.0
    z = 0.5 * (low + high)
    for _ in range(200):
        value, slope = quartic_slope(z, q1, q2, q3), 2.0 * q2 + z * (6.0 * q3 + 36.0 * z)
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


def stationary_points(top, q1, q2, q3):
    """The quartic's stationary points in (0, top), ascending; `top` where there are fewer than three."""
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
        end_value = quartic_slope(end, q1, q2, q3)
        if (start_value > 0.0) != (end_value > 0.0):
            point = slope_root_between(start, end, q1, q2, q3)
            if found == 0:
                first = point
            elif found == 1:
                second = point
            else:
                third = point
            found += 1
        start, start_value = end, end_value
    return first, second, third


def sign_changes(q0, q1, q2, q3):
    """Sign changes among the coefficients: no positive root if 0, exactly one if 1 (Descartes)."""
    changes, last = 0, 1.0
    for q in (q3, q2, q1, q0):
        if q * last < 0.0:
            changes += 1
            last = -last
    return changes


def upper_bound(q0, q1, q2, q3):
    """No root is larger (Fujiwara)."""
    return 2.0 * max(
        fabs(q3) / 3.0, sqrt(fabs(q2) / 3.0), (fabs(q1) / 3.0) ** THIRD, sqrt(sqrt(fabs(q0) / 3.0))
    )
