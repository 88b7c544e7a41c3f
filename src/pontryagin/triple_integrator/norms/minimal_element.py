"""The minimal element (1.13) in L_p, 1 < p < infinity: a smooth convex problem in two unknowns, by Newton.

N(h) = (integral of |h|^p)^(1/p) is minimised over the quadratics with <h, moments> = 1. Its derivative along
that plane is the error of the moments of |h|^(p-1) sign h, so that at the minimum this control has the
required moments. The moments are scaled to length one in a basis of polynomials orthonormal on [-1/2, 1/2].

The kernel solves one problem, first by coarse rules for exponents that end with p, then by a fine rule.
"""

from math import copysign, fabs, hypot, inf, sqrt

from pontryagin.triple_integrator.norms.power_integrals import HEAD, Rule, power_integrals
from pontryagin.triple_integrator.problem.scales import in_range, level_unit

R5, R12 = sqrt(5.0), sqrt(12.0)
"""The polynomials 1, sqrt(12) y and sqrt(5) (6 y^2 - 1/2) are orthonormal on [-1/2, 1/2]."""

COARSE_SIZE, FINE_SIZE = HEAD + 33, HEAD + 65
"""Sizes of the rules in the table, see `power_rules`."""

STAGE_BELOW, STAGE_ABOVE, LAST_STAGE = 0.3, 0.1, 3e-3
"""Residuals at which a stage ends, for p < 2 and for p > 2, and at which the last of them does."""

FINISH = 1e-7
"""Residual from which one more step of Newton's method reaches rounding; for p > 10 less by 10/p."""

EXACT, FINER, REPEATS = 3e-15, 0.01, 4
"""Residual of the moments, over 20 + p, above which the fine steps are repeated; by which factor the
tolerance is lower then; and how often they are made."""

RADIUS = 3.0
"""Longest step, over max |h| / p: where |h|^p changes by much more, its expansion says little."""

SINGULAR = 1e-9
"""Ratio of the determinant of the Hessian to its squared trace below which rounding decides its sign. Then
this share of the trace is added to both curvatures."""

SMALL = 1e-3
"""Relative change of the coefficients from which the discriminant is computed anew."""

STEPS = 1000
"""Largest number of evaluations at one stage."""


def tangents(w0: float, w1: float, w2: float) -> tuple[float, ...]:
    """Two orthonormal vectors across the unit vector w."""
    s = copysign(1.0, w2)
    a = -1.0 / (s + w2)
    b = w0 * w1 * a
    return 1.0 + s * w0 * w0 * a, s * b, -s * w0, b, s + w1 * w1 * a, -w1


def largest(b0: float, b1: float, b2: float, discriminant: float) -> float:
    """max |h| on [-1/2, 1/2]."""
    top = max(fabs(b0 - 0.5 * b1 + 0.25 * b2), fabs(b0 + 0.5 * b1 + 0.25 * b2))
    return max(top, fabs(0.25 * discriminant / b2)) if fabs(b1) < fabs(b2) else top


def slopes(
    b0: float, b1: float, b2: float, discriminant: float,
    e0: float, e1: float, e2: float, f0: float, f1: float, f2: float, rule: Rule, at: int,
) -> tuple[float, ...]:  # fmt: skip
    """max |h|, N, and along the tangents e and f the gradient and the Hessian of N over N for h / max |h|."""
    p = rule[at]
    top = largest(b0, b1, b2, discriminant)
    s = 1.0 / top
    whole, g0, g1, g2, a0, a1, a2, a3, a4 = power_integrals(
        b0 * s, b1 * s, b2 * s, discriminant * s * s, rule, at
    )
    g0, g1, g2 = g0 / whole, R12 * g1 / whole, R5 * (6.0 * g2 - 0.5 * g0) / whole
    m01, m02, m11 = R12 * a1, R5 * (6.0 * a2 - 0.5 * a0), 12.0 * a2
    m12, m22 = R12 * R5 * (6.0 * a3 - 0.5 * a1), 5.0 * (36.0 * a4 - 6.0 * a2 + 0.25 * a0)
    u, v = e0 * g0 + e1 * g1 + e2 * g2, f0 * g0 + f1 * g1 + f2 * g2
    x0, x1, x2 = a0 * e0 + m01 * e1 + m02 * e2, m01 * e0 + m11 * e1 + m12 * e2, m02 * e0 + m12 * e1 + m22 * e2
    y0, y1, y2 = a0 * f0 + m01 * f1 + m02 * f2, m01 * f0 + m11 * f1 + m12 * f2, m02 * f0 + m12 * f1 + m22 * f2
    uu = (p - 1.0) * ((e0 * x0 + e1 * x1 + e2 * x2) / whole - u * u)
    uv = (p - 1.0) * ((f0 * x0 + f1 * x1 + f2 * x2) / whole - u * v)
    vv = (p - 1.0) * ((f0 * y0 + f1 * y1 + f2 * y2) / whole - v * v)
    return top, top * whole ** (1.0 / p), u, v, uu, uv, vv


def discriminant_after(
    b0: float, b1: float, b2: float, discriminant: float, d0: float, d1: float, d2: float
) -> float:
    """The discriminant after a change of the coefficients: after a small one by its change, else anew."""
    if d0 * d0 + d1 * d1 + d2 * d2 > SMALL * SMALL * (b0 * b0 + b1 * b1 + b2 * b2):
        return (b1 + d1) * (b1 + d1) - 4.0 * (b0 + d0) * (b2 + d2)
    return discriminant + 2.0 * (b1 * d1 - 2.0 * (b0 * d2 + b2 * d0)) + (d1 * d1 - 4.0 * d0 * d2)


def following_share(share: float, low: float, high: float, at_low: float, at_high: float) -> float:
    """Where a line search tries next: where a line through the slopes at both ends has none."""
    split = at_low / (at_low - at_high)
    return low + min(max(split, 0.02), 0.98) * (high - low) if high > low else share


def newton(
    b0: float, b1: float, b2: float, discriminant: float, w0: float, w1: float, w2: float, rule: Rule,
    at: int, tolerance: float,
) -> tuple[float, ...]:  # fmt: skip
    """Newton's method for the minimum of N, whose last step starts from a residual within the tolerance.

    N is convex, so that its slope grows along a step. Where the slope at the end of a step is positive and
    more than half of that at the start, the step goes too far; then the zero of the slope is bracketed.
    """
    e0, e1, e2, f0, f1, f2 = tangents(w0, w1, w2)
    top, norm, u, v, uu, uv, vv = slopes(b0, b1, b2, discriminant, e0, e1, e2, f0, f1, f2, rule, at)
    left = STEPS
    while left > 0:
        trace, determinant = uu + vv, uu * vv - uv * uv
        if not trace > 0.0:
            break
        if determinant <= SINGULAR * trace * trace:
            uu, vv = uu + SINGULAR * trace, vv + SINGULAR * trace
            determinant = uu * vv - uv * uv
        du, dv = -top * (vv * u - uv * v) / determinant, -top * (uu * v - uv * u) / determinant
        s2 = du * e2 + dv * f2
        d0, d1, d2 = du * e0 + dv * f0 - 0.5 * R5 * s2, R12 * (du * e1 + dv * f1), 6.0 * R5 * s2
        size = rule[at] * hypot(du, dv) / top
        if hypot(u, v) <= tolerance and size <= RADIUS:
            changed = discriminant_after(b0, b1, b2, discriminant, d0, d1, d2)
            return b0 + d0, b1 + d1, b2 + d2, changed
        first = norm * (u * du + v * dv) / top
        share, low, high, at_low, at_high = RADIUS / max(size, RADIUS), 0.0, 0.0, first, 0.0
        while left > 0:
            left -= 1
            c0, c1, c2 = b0 + share * d0, b1 + share * d1, b2 + share * d2
            changed = discriminant_after(b0, b1, b2, discriminant, share * d0, share * d1, share * d2)
            top, norm, u, v, uu, uv, vv = slopes(c0, c1, c2, changed, e0, e1, e2, f0, f1, f2, rule, at)
            slope = norm * (u * du + v * dv) / top
            if fabs(slope) <= 0.5 * fabs(first) or (slope <= 0.0 and high == 0.0):
                break
            if slope <= 0.0:
                low, at_low, at_high = share, slope, 0.5 * at_high
            else:
                at_low = 0.5 * at_low if high > 0.0 else at_low
                high, at_high = share, slope
            share = following_share(share, low, high, at_low, at_high)
        b0, b1, b2, discriminant = c0, c1, c2, changed
    return b0, b1, b2, discriminant


def minimal_element(w0: float, w1: float, w2: float, table: Rule) -> tuple[float, ...]:
    """The minimal element for unit moments w by the coarse rules, from that of L_2, which is w itself."""
    b0, b1, b2 = w0 - 0.5 * R5 * w2, R12 * w1, 6.0 * R5 * w2
    discriminant = b1 * b1 - 4.0 * b0 * b2
    at, count = 1, int(table[0])
    for i in range(count):
        tolerance = LAST_STAGE if i == count - 1 else STAGE_BELOW if table[at] < 2.0 else STAGE_ABOVE
        b0, b1, b2, discriminant = newton(b0, b1, b2, discriminant, w0, w1, w2, table, at, tolerance)
        at += COARSE_SIZE
    return b0, b1, b2, discriminant


def measured(
    b0: float,
    b1: float,
    b2: float,
    discriminant: float,
    k1: float,
    k2: float,
    k3: float,
    table: Rule,
    at: int,
) -> tuple[float, ...]:
    """Peak of the control |h|^(p-1) sign h, largest error of its scaled moments, and integral of |h|^p."""
    whole, g0, g1, g2, _, _, _, _, _ = power_integrals(b0, b1, b2, discriminant, table, at)
    m1, m2, m3 = 3.0 * (g2 + g1 + 0.25 * g0), 2.0 * g1 + g0, g0
    peak = (m1 * k1 + m2 * k2 + m3 * k3) / (m1 * m1 + m2 * m2 + m3 * m3)
    return peak, max(fabs(peak * m1 - k1), fabs(peak * m2 - k2), fabs(peak * m3 - k3)), whole


def solve_norm(c1: float, c2: float, c3: float, T: float, table: Rule) -> tuple[float, ...]:
    """h in s/T and its discriminant, peak, scaled residual, norm and bound.

    The moments of the control, its norm and that of h in the bound are integrals by a rule that Newton's
    method does not use. If that fails, the control is 0, which misses the moments entirely.
    """
    if c1 == 0.0 and c2 == 0.0 and c3 == 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    k1, k2, k3 = 6.0 * (c1 / T / T), 2.0 * (c2 / T), c3
    size = max(fabs(k1), fabs(k2), fabs(k3))
    level = level_unit(size, T)
    if not level < inf:
        return 0.0, 0.0, 0.0, 0.0, level, 0.0, level, level
    k1, k2, k3 = k1 / size, k2 / size, k3 / size
    n0, n1, n2 = k3, 0.5 * (k2 - k3), k1 / 3.0 - 0.5 * k2 + 0.25 * k3
    w0, w1, w2 = n0, R12 * n1, R5 * (6.0 * n2 - 0.5 * n0)
    length = sqrt(w0 * w0 + w1 * w1 + w2 * w2)
    w0, w1, w2 = w0 / length, w1 / length, w2 / length
    b0, b1, b2, discriminant = minimal_element(w0, w1, w2, table)
    at = 1 + int(table[0]) * COARSE_SIZE
    p = table[at]
    h0 = h1 = h2 = square = peak = pairing = whole = 0.0
    residual, tolerance = 1.0, FINISH * min(1.0, 10.0 / p)
    for _ in range(REPEATS):
        b0, b1, b2, discriminant = newton(b0, b1, b2, discriminant, w0, w1, w2, table, at, tolerance)
        tolerance *= FINER
        top = largest(b0, b1, b2, discriminant)
        b0, b1, b2, discriminant = b0 / top, b1 / top, b2 / top, discriminant / top / top
        height, missed, power = measured(b0, b1, b2, discriminant, k1, k2, k3, table, at + FINE_SIZE)
        if missed < residual:
            h0, h1, h2, square = b0 - 0.5 * b1 + 0.25 * b2, b1 - b2, b2, discriminant
            peak, residual, whole, pairing = height, missed, power, b0 * n0 + b1 * n1 + b2 * n2
        if residual <= EXACT * (20.0 + p):
            break
    if whole == 0.0 or pairing == 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0
    mean = (T * whole) ** (1.0 / p)
    norm, bound = fabs(peak) * (level * (T * whole / mean)), pairing * (level * (T / mean))
    return h0, h1, h2, square, peak * level, residual, in_range(norm), bound
