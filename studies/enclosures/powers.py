"""Integrals over [0, 1] of powers of the modulus of a quadratic, and of exponentials, as balls."""

from collections.abc import Callable, Sequence
from itertools import pairwise

from flint import acb, arb

TOLERANCE = 2.0**-90
"""The integrals' radius that is aimed at; the balls hold whatever is reached."""

HALF_GAP = 2.0**-110
"""Half the width of the pieces round the zeros of the quadratic, which are bounded and not integrated."""


def quadratic(h: Sequence[arb], x: arb | acb) -> arb | acb:
    """h0 + h1 x + h2 x^2."""
    return h[0] + x * (h[1] + x * h[2])


def zeros(h: Sequence[arb]) -> list[arb]:
    """The real zeros of a quadratic, in order.

    Raises
    ------
    ValueError
        If the balls do not tell whether there are any.
    """
    a, b, c = h[2], h[1], h[0]
    if a.is_zero():
        return [] if b.is_zero() else [-c / b]
    discriminant = b * b - 4 * a * c
    if discriminant < 0:
        return []
    if not discriminant > 0:
        raise ValueError(f"the discriminant {discriminant} of the quadratic may be zero")
    root = discriminant.sqrt()
    far = (-b - root) / 2 if b > 0 else (root - b) / 2
    first, second = far / a, c / far
    return [first, second] if first < second else [second, first]


def power_moments(h: Sequence[arb], power: arb) -> list[arb]:
    """The integrals over [0, 1] of |h|^power sign(h) x^j for j = 0, 1, 2; the power is positive."""
    edges, gaps = [arb(0)], arb(0)
    for zero in zeros(h):
        low, high = ((zero.mid() + side * HALF_GAP).mid() for side in (-1, 1))
        if high <= 0 or low >= 1:
            continue
        low, high = low.max(arb(0)), high.min(arb(1))
        gaps += (high - low) * quadratic(h, low.union(high)).abs_upper() ** power
        edges += [low, high]
    edges.append(arb(1))
    totals = [arb(0, gaps.abs_upper()) for _ in range(3)]
    for low, high in list(pairwise(edges))[::2]:
        if not low < high:
            continue
        sign = 1 if quadratic(h, (low + high) / 2) > 0 else -1
        for j in range(3):
            totals[j] += sign * integral(_piece([sign * c for c in h], power, j), low, high)
    return totals


def _piece(h: Sequence[arb], power: arb, j: int) -> Callable[[acb, bool], acb]:
    """The integrand h^power x^j where h is positive."""
    return lambda x, analytic: quadratic(h, x).pow(acb(power), analytic=analytic) * x**j


def integral(function: Callable[[acb, bool], acb], low: arb, high: arb) -> arb:
    """The integral of a function that is real on the way."""
    return acb.integral(function, acb(low), acb(high), rel_tol=TOLERANCE, abs_tol=TOLERANCE).real


def exponential_moments(k: Sequence[arb]) -> list[arb]:
    """The integrals over [0, 1] of exp(k0 + k1 x + k2 x^2) x^j for j = 0, 1, 2."""
    zero, one = arb(0), arb(1)
    return [integral(lambda x, _, j=j: quadratic(k, x).exp() * x**j, zero, one) for j in range(3)]
