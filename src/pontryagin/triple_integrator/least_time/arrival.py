"""The least time under |u| <= U: the least admissible root of two quartics in the time, and its proof.

The problem is solved in units with U = 1 and the typical time of the transfer as the unit of time. If
c3 = x3f - x30 is negative, the signs of x, u and f are changed, so that c3 >= 0. The unknown is
z = T - c3 >= 0, since x3 alone needs the time c3.
"""

from math import fabs, inf, nan, sqrt

from pontryagin.numerics.jit import batched
from pontryagin.triple_integrator.kernels import (
    bang_bang_moments,
    moments,
    opposite_branch,
    same_branch,
    small_parts,
)
from pontryagin.triple_integrator.least_time.quartic import (
    LEADING,
    THIRD,
    quartic,
    root_between,
    sign_changes,
    stationary_points,
    upper_bound,
)
from pontryagin.triple_integrator.norms.peak import EDGE, place_switches
from pontryagin.validation import TINY

ACCEPT = 2e-15
"""Largest residual of the moments, relative to the size of the data, with which a root is accepted."""

ILL_POSED = 1e-12
"""Largest residual accepted if no root passes `ACCEPT`.

Rounding of the data may remove a double root.
"""

NEARLY_DOUBLE = 1e-9
"""Largest residual accepted if no root passes `ILL_POSED` either.

Nearly equal roots lose half of their digits.
"""

TOUCHING = 1e-2
"""A stationary point whose value, relative to the quartic's terms, is this small is tried as a double root.

The data may have had a root there before they were rounded.
"""

NEVER = 1e300
"""The value of z where no root is accepted."""


def control_of(
    level: float, z: float, ends: tuple[float, ...], f: float, c3: float, edge: float
) -> tuple[float, ...]:
    """Switches a, b, time T and residual of the control that belongs to a root z of one branch.

    Pieces shorter than the share `edge` are left out.
    """
    d1, x20, x30, x2f, x3f, place = ends
    T = c3 + z
    p3 = level * T - c3
    r2 = 2.0 * (x2f - x20) - (x3f + x30 + 2.0 * f) * T
    m = 1.0 - r2 / (T * p3) if p3 != 0.0 else 1.0
    a, b = place_switches(min(1.0, 0.5 * fabs(p3) / T), m, edge)
    k1, k2, k3 = bang_bang_moments(level, a, b)
    c1, c2, _ = moments(0.0, x20, x30, d1, x2f, x3f, T, 0.5 * f * T * T, f * T)
    rate, drift = fabs(x20) + fabs(x2f), fabs(x30) + fabs(f)
    size1 = T * T * T + 6.0 * (place + rate * T) + 3.0 * drift * T * T
    size2 = T * T + 2.0 * rate + 2.0 * drift * T
    residual = max(
        fabs(k1 * T * T * T - 6.0 * c1) / size1,
        fabs(k2 * T * T - 2.0 * c2) / size2,
        fabs(k3 * T - c3) / (T + fabs(x30) + fabs(x3f)),
    )
    return a, b, T, residual


def refine(
    level: float, z: float, r20: float, r21: float, w0: float, w1: float, w2: float, c3: float
) -> float:
    """Two Newton steps on p3^2 (4 T^2 - p3^2) + 8 p3 w - 12 r2^2, without its coefficients in z.

    The coefficients lose digits to cancellation; p3, r2 and w do not.
    """
    for _ in range(2):
        T = c3 + z
        p3, p3_slope = (z, 1.0) if level > 0.0 else (-(z + 2.0 * c3), -1.0)
        r2, w = r20 + r21 * z, w0 + z * (w1 + z * w2)
        rest = (2.0 * T - p3) * (2.0 * T + p3)
        value = p3 * (p3 * rest + 8.0 * w) - 12.0 * r2 * r2
        slope = 2.0 * p3 * p3_slope * rest + p3 * p3 * (8.0 * T - 2.0 * p3 * p3_slope)
        slope += 8.0 * (p3_slope * w + p3 * (w1 + 2.0 * z * w2)) - 24.0 * r2 * r21
        step = value / slope if slope != 0.0 else 0.0
        if fabs(step) > 1e-6 * z:
            break
        z -= step
    return z


def least_root(
    level: float,
    limit: float,
    accept: float,
    ends: tuple[float, ...],
    f: float,
    c3: float,
    small: tuple[float, ...],
    q0: float,
    q1: float,
    q2: float,
    q3: float,
) -> tuple[float, ...]:
    """z, a, b and residual of the least accepted root below `limit`; z = limit if there is none."""
    top = min(limit, upper_bound(q0, q1, q2, q3) * (1.0 + 1e-9))
    low, low_value = 0.0, q0
    if level > 0.0 and c3 > 0.0:
        a, b, _, residual = control_of(level, 0.0, ends, f, c3, EDGE)
        if residual <= 4e-15:
            return 0.0, a, b, residual
    changes = sign_changes(q0, q1, q2, q3)
    if changes == 0:
        return limit, 0.0, 0.0, 1.0
    first, second, third = (top, top, top) if changes == 1 else stationary_points(top, q1, q2, q3)
    for k in range(4):
        high = first if k == 0 else second if k == 1 else third if k == 2 else top
        if not low < high:
            continue
        value = quartic(high, q0, q1, q2, q3, LEADING)
        size = fabs(q0) + high * (fabs(q1) + high * (fabs(q2) + high * (fabs(q3) + 3.0 * high)))
        crosses = (low_value > 0.0) != (value > 0.0)
        touches = high < top and fabs(value) <= TOUCHING * size
        if crosses or touches:
            z = root_between(low, high, q0, q1, q2, q3, LEADING) if crosses else high
            z = refine(level, z, small[0], small[1], small[2], small[3], small[4], c3)
            _, _, _, residual = control_of(level, z, ends, f, c3, 0.0)
            if residual <= accept:
                a, b, _, residual = control_of(level, z, ends, f, c3, EDGE)
                return z, a, b, residual
        low, low_value = high, value
    return limit, 0.0, 0.0, 1.0


def first_arrival(accept: float, ends: tuple[float, ...], f: float, c3: float) -> tuple[float, ...]:
    """Level, z, a, b and residual of the least accepted root of both branches."""
    d1, x20, x30, x2f, x3f, _ = ends
    small = small_parts(0.0, x20, x30, d1, x2f, x3f, f, c3)
    r20, r21, w0, w1, w2 = small
    q0, q1, q2, q3, _ = same_branch(r20, r21, w0, w1, w2, c3)
    z, a, b, residual = least_root(1.0, NEVER, accept, ends, f, c3, small, q0, q1, q2, q3)
    q0, q1, q2, q3, _ = opposite_branch(r20, r21, w0, w1, w2, c3)
    other, other_a, other_b, other_residual = least_root(-1.0, z, accept, ends, f, c3, small, q0, q1, q2, q3)
    if other < z:
        return -1.0, other, other_a, other_b, other_residual
    return 1.0, z, a, b, residual


def square_root(number: float, unit: float) -> float:
    """Square root of number / unit, which need not be in the range of double precision."""
    ratio = number / unit
    return sqrt(ratio) if TINY <= ratio < inf else sqrt(number) / sqrt(unit)


def cube_root(number: float, unit: float) -> float:
    """Cube root of number / unit, which need not be in the range of double precision."""
    ratio = number / unit
    root: float = ratio**THIRD if TINY <= ratio < inf else number**THIRD / unit**THIRD
    return root


def solve_time(
    x10: float, x20: float, x30: float, x1f: float, x2f: float, x3f: float, f: float, U: float
) -> tuple[float, ...]:
    """Duration, signed level, switches a >= b (shares of T to go), scaled residual, lower bound on T.

    The duration is infinite where no root is accepted, and where U is not positive. It is nan where double
    precision does not hold the motion.
    """
    if not U > 0.0:
        return inf, 0.0, 0.0, 0.0, 1.0, 0.0
    d1, d2, c3 = x1f - x10, x2f - x20, x3f - x30
    x30, x3f, f = x30 + f, x3f + f, 0.0
    if d1 == 0.0 and d2 == 0.0 and c3 == 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    sign = -1.0 if c3 < 0.0 else 1.0
    unit = max(
        fabs(c3) / U,
        square_root(max(fabs(d2), min(fabs(x20), fabs(x2f))), U),
        cube_root(fabs(d1), U),
        min(fabs(x30 + f), fabs(x3f + f)) / U,
    )
    if not (TINY <= unit < inf and TINY <= U * unit * unit * unit <= 1.0 / TINY):
        return nan, 0.0, 0.0, 0.0, 1.0, 0.0
    e3 = sign / (U * unit)
    e2 = e3 / unit
    e1 = e2 / unit
    ends = (d1 * e1, x20 * e2, x30 * e3, x2f * e2, x3f * e3, (fabs(x10) + fabs(x1f)) * fabs(e1))
    force, height = f * e3, fabs(c3) * fabs(e3)
    level, z, a, b, residual = first_arrival(ACCEPT, ends, force, height)
    if z == NEVER:
        level, z, a, b, residual = first_arrival(ILL_POSED, ends, force, height)
    if z == NEVER:
        level, z, a, b, residual = first_arrival(NEARLY_DOUBLE, ends, force, height)
    if z == NEVER:
        return inf, 0.0, 0.0, 0.0, residual, 0.0
    T = height + z
    bound = lower_bound(level, a, b, T, ends, force, height)
    return T * unit, sign * level * U, a, b, residual, bound * unit


def lower_bound(
    level: float, a: float, b: float, T: float, ends: tuple[float, ...], f: float, c3: float
) -> float:
    """The time just before which a separating functional proves the target out of reach; |c3| if none does.

    For a control with two switches the functional is (s - aT)(s - bT). For a single switch the functional
    whose other zero lies at the other end of the manoeuvre is tried too, for a constant control also those
    without a zero inside.
    """
    found = max(
        separation(level, a, b, T, ends, f, c3),
        separation(-level, 1.0, a, T, ends, f, c3),
        separation(-level, b, 0.0, T, ends, f, c3),
    )
    return max(c3, found if a > b else max(found, separation(level, 1.0, 1.0, T, ends, f, c3)))


def separation(
    level: float, a: float, b: float, T: float, ends: tuple[float, ...], f: float, c3: float
) -> float:
    """The time at which phi falls to zero, by one Newton step from T; 0 where phi does not fall.

    phi(T') = l'c(T') - integral of |l'h| over [0, T'] for l'h = level (s - aT)(s - bT): the target is out
    of reach in the time T' if phi(T') > 0.
    """
    d1, x20, x30, x2f, x3f, _ = ends
    c1, c2, _ = moments(0.0, x20, x30, d1, x2f, x3f, T, 0.5 * f * T * T, f * T)
    m, product = T * (a + b), T * T * a * b
    pairing = level * (2.0 * c1 - m * c2 + product * c3)
    d = T * (a - b)
    reach = T * T * T / 3.0 - 0.5 * m * T * T + product * T + d * d * d / 3.0
    rise = level * (m * (x30 + f) - 2.0 * (x20 + T * (x30 + f))) - (T - T * a) * (T - T * b)
    return T - fabs(pairing - reach) / -rise if rise < 0.0 else 0.0


solve_stack = batched(solve_time, outputs=6, groups=(3, 3, 1, 1))
