"""Integrals of powers of a quadratic by Gauss's rules on panels, one quadratic at a time.

For h(y) = b0 + b1 y + b2 y^2 on [-1/2, 1/2], with y = s/T - 1/2, the integrals of |h|^p, of |h|^(p-1) sign h
times 1, y, y^2, and of |h|^(p-2) times 1, ..., y^4. They all come from the same nodes, one power for each.

[-1/2, 1/2] is cut at the vertex and at the zeros. On each piece |h| = e + t (R + k t) rises with the distance
t from an origin: the zero, or the vertex, or else the lower end. Panels are cut off from the top, each so
short that h changes by a fixed factor. The panel next to a zero, where |h|^(p-1) = t^(p-1) times a smooth
factor, takes the rule with the weight t^(p-1).
"""

from collections.abc import Sequence
from math import fabs, log, sqrt

Rule = Sequence[float]
"""A rule within a table, see `power_rules`: the numbers of `HEAD`, then nodes and weights."""

HEAD = 6
"""Numbers at the head of a rule: p, the number n of nodes, the factor by which h changes over a panel, the
range of log h that counts, and how far the rule for zeros reaches: over convex pieces in distances of the
zeros, and over concave ones in distances of zero and vertex.

There follow n Gauss-Legendre nodes and their weights on [0, 1], n nodes for the weight t^(p-1) and their
weights over the nodes, and the weight of the node 0 that completes them for the weight t^(p-2).
"""

FAR = 2.0
"""Where a piece begins farther from its zero or vertex than this many of its lengths, its lower end is the
origin: there h has lost no digits."""

AT_VERTEX = 1e-3
"""A piece that begins with a smaller slope, relative to b2, begins at the vertex but for rounding: there h
follows from the discriminant, since the rounded coefficients contradict it next to a double zero."""

NEVER = 1e300
"""The distance of a zero that there is not."""

PANELS = 80
"""Largest number of panels on a piece."""


def sum_of(a: Sequence[float], b: Sequence[float]) -> tuple[float, ...]:
    """The integrals over two pieces together."""
    first = a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]
    return (*first, a[4] + b[4], a[5] + b[5], a[6] + b[6], a[7] + b[7], a[8] + b[8])


def difference_of(a: Sequence[float], b: Sequence[float]) -> tuple[float, ...]:
    """The integrals over a piece without those over a part of it."""
    first = a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]
    return (*first, a[4] - b[4], a[5] - b[5], a[6] - b[6], a[7] - b[7], a[8] - b[8])


def smooth_panel(
    low: float,
    high: float,
    origin: float,
    side: float,
    e: float,
    R: float,
    k: float,
    sign: float,
    rule: Rule,
    at: int,
) -> tuple[float, ...]:
    """The integrals over t in [low, high] of a piece, y = origin + side t, by Gauss-Legendre nodes."""
    power, n, first = rule[at] - 2.0, int(rule[at + 1]), at + HEAD
    width = high - low
    whole = g0 = g1 = g2 = a0 = a1 = a2 = a3 = a4 = 0.0
    for i in range(first, first + n):
        t = low + width * rule[i]
        h = e + t * (R + k * t)
        y = origin + side * t
        f = width * rule[i + n] * h**power
        yy = y * y
        g = f * h
        a0, a1, a2, a3, a4 = a0 + f, a1 + f * y, a2 + f * yy, a3 + f * y * yy, a4 + f * yy * yy
        g0, g1, g2, whole = g0 + g, g1 + g * y, g2 + g * yy, whole + g * h
    return whole, sign * g0, sign * g1, sign * g2, a0, a1, a2, a3, a4


def zero_panel(
    high: float, origin: float, side: float, R: float, k: float, sign: float, rule: Rule, at: int
) -> tuple[float, ...]:
    """The integrals over t in [0, high] next to a zero, |h| = t (R + k t), by the nodes for t^(p-1).

    With the node 0, which only |h|^(p-2) needs, they are those of Gauss and Radau for t^(p-2).
    """
    power, n = rule[at] - 2.0, int(rule[at + 1])
    first, y = at + HEAD + 2 * n, origin
    a0 = high * rule[first + 2 * n] * (high * R) ** power
    a1, a2, a3, a4 = a0 * y, a0 * y * y, a0 * y * y * y, a0 * y * y * y * y
    whole = g0 = g1 = g2 = 0.0
    for i in range(first, first + n):
        share = rule[i]
        t = high * share
        base = high * (R + k * t)
        y = origin + side * t
        f = high * rule[i + n] * base**power
        yy = y * y
        h = share * base
        g = f * h
        a0, a1, a2, a3, a4 = a0 + f, a1 + f * y, a2 + f * yy, a3 + f * y * yy, a4 + f * yy * yy
        g0, g1, g2, whole = g0 + g, g1 + g * y, g2 + g * yy, whole + g * h
    return whole, sign * g0, sign * g1, sign * g2, a0, a1, a2, a3, a4


def over_piece(
    low: float, high: float, origin: float, side: float, e: float, R: float, k: float, sign: float,
    reach: float, rule: Rule, at: int,
) -> tuple[float, ...]:  # fmt: skip
    """The integrals over a piece on which |h| = e + t (R + k t) rises from t = low to t = high.

    Where e = 0, the rule for zeros takes over as soon as t <= reach.
    """
    sums: tuple[float, ...] = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    if high <= low:
        return sums
    factor = rule[at + 2]
    bottom, h = e + low * (R + k * low), e + high * (R + k * high)
    least = log(h) - rule[at + 3]
    for _ in range(PANELS):
        following = factor * h
        if bottom >= following:
            return sum_of(sums, smooth_panel(low, high, origin, side, e, R, k, sign, rule, at))
        if high <= reach:
            sums = sum_of(sums, zero_panel(high, origin, side, R, k, sign, rule, at))
            if low > 0.0:
                sums = difference_of(sums, zero_panel(low, origin, side, R, k, sign, rule, at))
            return sums
        t = 2.0 * (following - e) / (R + sqrt(max(R * R + 4.0 * k * (following - e), 0.0)))
        sums = sum_of(sums, smooth_panel(t, high, origin, side, e, R, k, sign, rule, at))
        high, h = t, following
        if h <= 0.0 or log(h) < least:
            return sums
    return sums


def towards_zero(
    start: float, side: float, length: float, h: float, slope: float, bend: float, root: float, sign: float,
    rule: Rule, at: int,
) -> tuple[float, ...]:  # fmt: skip
    """The integrals from y = start, where |h| has the given slopes, over a length on which it first falls."""
    zero = 2.0 * h / (slope + root)
    place, reach = start + side * zero, zero * rule[at + 5]
    if zero > (1.0 + FAR) * length:
        bottom = h - length * (slope + bend * length)
        steep = slope + 2.0 * bend * length
        return over_piece(
            0.0, length, start + side * length, -side, bottom, steep, -bend, sign, -1.0, rule, at
        )
    if zero > length:
        return over_piece(zero - length, zero, place, -side, 0.0, root, -bend, sign, reach, rule, at)
    before = over_piece(0.0, zero, place, -side, 0.0, root, -bend, sign, reach, rule, at)
    reach = rule[at + 4] * root / bend if bend > 0.0 else NEVER
    after = over_piece(0.0, length - zero, place, side, 0.0, root, bend, -sign, reach, rule, at)
    return sum_of(before, after)


def from_vertex(
    start: float,
    side: float,
    length: float,
    h: float,
    slope: float,
    bend: float,
    discriminant: float,
    rule: Rule,
    at: int,
) -> tuple[float, ...]:
    """The integrals from y = start over a length in the direction that leads away from the vertex.

    h, slope and bend are h, its slope in that direction, and half its second derivative there; slope and bend
    have one sign.
    """
    root = sqrt(discriminant) if discriminant > 0.0 else 0.0
    outward = bend if bend != 0.0 else slope
    sign = 1.0 if h > 0.0 or (h == 0.0 and outward > 0.0) else -1.0
    h, slope, bend = fabs(h), fabs(slope), fabs(bend)
    if h > 0.0 and sign * outward < 0.0:
        return towards_zero(start, side, length, h, slope, bend, root, sign, rule, at)
    if root > 0.0:
        zero = 2.0 * h / (slope + root)
        if zero < FAR * length:
            reach = rule[at + 4] * root / bend if bend > 0.0 else NEVER
            place = start - side * zero
            return over_piece(zero, zero + length, place, side, 0.0, root, bend, sign, reach, rule, at)
    elif slope < 2.0 * FAR * bend * length:
        vertex, least = 0.5 * slope / bend, -0.25 * discriminant / bend
        place = start - side * vertex
        return over_piece(vertex, vertex + length, place, side, least, 0.0, bend, sign, -1.0, rule, at)
    return over_piece(0.0, length, start, side, h, slope, bend, sign, -1.0, rule, at)


def power_integrals(
    b0: float, b1: float, b2: float, discriminant: float, rule: Rule, at: int
) -> tuple[float, ...]:
    """The nine integrals of h = b0 + b1 y + b2 y^2, whose largest modulus should be about 1.

    The discriminant b1^2 - 4 b0 b2 is given because next to a double zero the rounded coefficients do not
    determine it.
    """
    if fabs(b1) < fabs(b2):
        vertex, extreme = -0.5 * b1 / b2, -0.25 * discriminant / b2
        left = from_vertex(vertex, -1.0, 0.5 + vertex, extreme, 0.0, b2, discriminant, rule, at)
        right = from_vertex(vertex, 1.0, 0.5 - vertex, extreme, 0.0, b2, discriminant, rule, at)
        return sum_of(left, right)
    side = -1.0 if b1 * b2 < 0.0 else 1.0
    start = -0.5 * side
    h, slope = b0 + start * (b1 + start * b2), side * (b1 + 2.0 * start * b2)
    if fabs(slope) < AT_VERTEX * fabs(b2):
        h = 0.25 * (slope * slope - discriminant) / b2
    return from_vertex(start, side, 1.0, h, slope, b2, discriminant, rule, at)
