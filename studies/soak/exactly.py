"""The oracle of the triple integrator: moments and dual values in fifty digits, from the inputs as floats.

Nothing of a solution is taken for granted but its control and its multipliers. The control's moments are
integrated anew, and l'c over the dual norm of l'h is a lower bound on the norm for whatever l is given.
"""

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from typing import Any

import mpmath as mp
import numpy as np

from pontryagin.arrays import Array

DIGITS = 50


def mpf(value: float) -> Any:
    """A float as an mpmath number, without rounding."""
    ratio = Fraction(float(value))
    return mp.mpf(ratio.numerator) / ratio.denominator


def required(row: Sequence[float]) -> tuple[list[Any], list[Any], Any]:
    """The moments that a row of `draws.COLUMNS` asks for, the sizes of their terms, and the duration."""
    a1, a2, a3, b1, b2, b3, tf, t0, f = map(mpf, row)
    T = tf - t0
    terms = [[b1, -a1, -T * a2, -T * T * a3 / 2, -T * T * f / 2], [b2, -a2, -T * a3, -T * f], [b3, -a3]]
    return [mp.fsum(t) for t in terms], [mp.fsum(map(abs, t)) for t in terms], T


def response(s: Any) -> list[Any]:
    """h(s) = (s^2/2, s, 1)."""
    return [s * s / 2, s, mp.mpf(1)]


def antiderivative(s: Any) -> list[Any]:
    """The integral of h from 0 to s."""
    return [s**3 / 6, s**2 / 2, s]


def zeros(l: Sequence[Any], T: Any) -> list[Any]:
    """Zeros in (0, T) of l'h(s), in order."""
    a, b, c = l[0] / 2, l[1], l[2]
    if a == 0:
        found = [-c / b] if b != 0 else []
    else:
        under = b * b - 4 * a * c
        if under <= 0:
            return []
        q = -(b + (mp.sqrt(under) if b >= 0 else -mp.sqrt(under))) / 2
        found = [q / a, *([c / q] if q != 0 else [])]
    return sorted(s for s in found if 0 < s < T)


def dot(l: Sequence[Any], h: Sequence[Any]) -> Any:
    """The sum of products."""
    return mp.fsum(x * y for x, y in zip(l, h, strict=True))


def dual_norm(name: str, l: Sequence[Any], T: Any) -> Any:
    """The norm of l'h on [0, T] that is dual to that of the control: L2, L1 for the peak, L-infinity."""
    if name == "energy":
        h = [mp.mpf(1) / 2, mp.mpf(1), mp.mpf(1)]
        terms = [
            l[i] * l[j] * h[i] * h[j] * T ** (5 - i - j) / (5 - i - j) for i in range(3) for j in range(3)
        ]
        return mp.sqrt(max(mp.fsum(terms), mp.mpf(0)))
    if name == "peak":
        ends = [mp.mpf(0), *zeros(l, T), T]
        return mp.fsum(abs(dot(l, antiderivative(b)) - dot(l, antiderivative(a))) for a, b in pairwise(ends))
    vertex = [-l[1] / l[0]] if l[0] != 0 and 0 < -l[1] / l[0] < T else []
    return max(abs(dot(l, response(s))) for s in [mp.mpf(0), T, *vertex])


def produced(name: str, solution: Any, row: Sequence[float]) -> tuple[list[Any], list[Any], Any]:
    """The moments of a solution's control, the sizes of their terms, and the norm of the control."""
    tf, T = mpf(row[6]), mpf(row[6]) - mpf(row[7])
    if name == "energy":
        u = [mpf(x) for x in solution.coefficients]
        powers = [T ** (k + 1) / (k + 1) for k in range(5)]
        h = [[u[k] * powers[k + j] / max(j, 1) for k in range(3)] for j in (2, 1, 0)]
        square = mp.fsum(u[i] * u[j] * powers[i + j] for i in range(3) for j in range(3))
        return [mp.fsum(t) for t in h], [mp.fsum(map(abs, t)) for t in h], mp.sqrt(max(square, mp.mpf(0)))
    if name == "peak":
        level = mpf(solution.norm) * int(solution.first_sign)
        ends = [T, *(tf - mpf(t) for t in solution.switch_times if not np.isnan(t)), mp.mpf(0)]
        pieces = [
            [(-1) ** k * level * (x - y) for x, y in zip(antiderivative(a), antiderivative(b), strict=True)]
            for k, (a, b) in enumerate(pairwise(ends))
        ]
        whole = [abs(level) * x for x in antiderivative(T)]
        return [mp.fsum(piece[i] for piece in pieces) for i in range(3)], whole, abs(level)
    acting = [(mpf(t), mpf(a)) for t, a in zip(solution.impulse_times, solution.impulses, strict=True) if a]
    parts = [[a * x for x in response(tf - t)] for t, a in acting]
    total = mp.fsum(abs(a) for _, a in acting)
    whole = [total * x for x in response(T)]
    return [mp.fsum(p[i] for p in parts) for i in range(3)], whole, total


def disagreement(name: str, solution: Any, row: Array) -> float:
    """How far a solution of "energy", "peak" or "impulse" is from optimal, by fifty-digit arithmetic.

    The largest of: what its control's moments miss, relative to the sizes of their terms; the distance of its
    norm from that of its control; and from the dual value of its multipliers. The last is relative to the
    norm, and where rounding of the given ends moves the norm by more than that, to what it moves it by.
    """
    with mp.workdps(DIGITS):
        c, sizes, T = required(row)
        norm = mpf(solution.norm)
        made, whole, own = produced(name, solution, row)
        miss = [
            abs(m - x) / (s + w) if s + w else mp.mpf(0)
            for m, x, s, w in zip(made, c, sizes, whole, strict=True)
        ]
        l = [mpf(x) for x in solution.multipliers]
        if not any(l):
            return float(max([*miss, norm]))
        bound = dot(l, c) / dual_norm(name, l, T)
        moved = max(mp.mpf(1), dot([abs(x) for x in l], sizes) / abs(dot(l, c)))
        return float(max(*miss, abs(norm - own) / norm, abs(norm - bound) / norm / moved))
