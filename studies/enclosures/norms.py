"""Least norms of the triple integrator: the interval between a dual bound and a completed control.

A control with the moments c + r proves value(c) <= value(c + r) + value(-r), since the least norm is a norm
of the moments. The last term is at most the norm of the parabola with the moments -r.
"""

from collections.abc import Sequence
from math import inf
from typing import Any

from flint import arb

from pontryagin.triple_integrator import Maneuver
from studies.enclosures.ball import Enclosure, dot, exact, greatest, row, solved
from studies.enclosures.powers import exponential_moments, power_moments, quadratic


def required(maneuver: Maneuver) -> tuple[list[arb], arb]:
    """The moments (1.10) of a manoeuvre under a constant force or none, and its duration."""
    x0, xf = row(maneuver.x0), row(maneuver.xf)
    T = exact(maneuver.tf) - exact(maneuver.t0)
    x3 = x0[2] + exact(maneuver.disturbance or 0.0)
    return [xf[0] - x0[0] - T * (x0[1] + T * x3 / 2), xf[1] - x0[1] - T * x3, xf[2] - x0[2]], T


def from_shares(moments: Sequence[arb], T: arb) -> list[arb]:
    """The moments (1.9) from the integrals over [0, 1] of u times 1, x and x^2, where x is s/T."""
    return [moments[2] * T**3 / 2, moments[1] * T**2, moments[0] * T]


def polynomial_moments(u: Sequence[arb]) -> list[arb]:
    """The integrals over [0, 1] of the polynomial times 1, x and x^2."""
    return [dot(u, [arb(1) / (i + j + 1) for i in range(3)]) for j in range(3)]


def scaled_response(l: Sequence[arb], T: arb) -> list[arb]:
    """Coefficients of l'h in powers of x = s/T."""
    return [l[2], l[1] * T, l[0] * T**2 / 2]


def completion(missing: Sequence[arb], T: arb) -> arb:
    """A bound on the modulus of the parabola that has the missing moments."""
    scaled = [missing[2] / T, missing[1] / T**2, 2 * missing[0] / T**3]
    hilbert = [[arb(1) / (i + j + 1) for i in range(3)] for j in range(3)]
    return sum((abs(a) for a in solved(hilbert, scaled)), arb(0))


def _enclosure(solution: Any, q: float, norm: arb, reached: Sequence[arb], bound: arb) -> Enclosure:
    """The interval from a control's norm and its moments, and from a lower bound."""
    c, T = required(solution.maneuver)
    missing = completion([x - y for x, y in zip(c, reached, strict=True)], T)
    spread = missing if q == inf else missing * T ** (1 / exact(q))
    return Enclosure(float(solution.norm), bound, norm + spread)


def energy(solution: Any) -> Enclosure:
    """The least L2 norm."""
    c, T = required(solution.maneuver)
    u0, u1, u2 = row(solution.coefficients)
    u = [u0, u1 * T, u2 * T**2]
    own = polynomial_moments(u)
    l = row(solution.multipliers)
    h = scaled_response(l, T)
    bound = abs(dot(l, c)) / (T * dot(h, polynomial_moments(h))).sqrt()
    return _enclosure(solution, 2.0, (T * dot(u, own)).sqrt(), from_shares(own, T), bound)


def peak(solution: Any) -> Enclosure:
    """The least peak; the dual function is (s - aT)(s - bT)."""
    c, T = required(solution.maneuver)
    v, (a, b) = exact(solution.levels), row(solution.shares)
    own = [v * (1 - 2 * (a**j - b**j)) / j for j in (1, 2, 3)]
    pairing = 2 * c[0] - (a + b) * T * c[1] + a * b * T**2 * c[2]
    area = T**3 * (arb(1) / 3 - (a + b) / 2 + a * b + (a - b) ** 3 / 3)
    return _enclosure(solution, inf, abs(v), from_shares(own, T), abs(pairing) / area)


def impulse(solution: Any) -> Enclosure:
    """The least total impulse."""
    c, T = required(solution.maneuver)
    amplitudes, places = row(solution.amplitudes), [arb(1), exact(solution.inner), arb(0)]
    own = [dot(amplitudes, [place**j for place in places]) / T for j in range(3)]
    l = row(solution.multipliers)
    total = sum((abs(a) for a in amplitudes), arb(0))
    bound = abs(dot(l, c)) / largest(scaled_response(l, T))
    return _enclosure(solution, 1.0, total, from_shares(own, T), bound)


def largest(h: Sequence[arb]) -> arb:
    """The greatest modulus of a quadratic on [0, 1]."""
    candidates = [abs(h[0]), abs(quadratic(h, arb(1)))]
    if not h[2].is_zero():
        place = -h[1] / (2 * h[2])
        if not (place <= 0 or place >= 1):
            candidates.append(abs(quadratic(h, place)))
    return greatest(candidates)


def power(solution: Any) -> Enclosure:
    """The least L_q norm: of peak |h|^(p-1) sign h, which has the power (p - 1) q = p of |h|."""
    c, T = required(solution.maneuver)
    q = exact(solution.q)
    p = q / (q - 1)
    h, top = row(solution.shape.coefficients), exact(solution.peak)
    whole = power_moments(h, p - 1)
    mean = T * dot(h, whole)
    pairing = h[0] * c[2] + h[1] * c[1] / T + 2 * h[2] * c[0] / T**2
    reached = from_shares([top * m for m in whole], T)
    return _enclosure(
        solution, solution.q, abs(top) * mean ** (1 / q), reached, abs(pairing) / mean ** (1 / p)
    )


def entropy(solution: Any) -> Enclosure:
    """The greatest entropy of a density on [0, 1] with the moments of |u|/|c3|; its errors are absolute.

    It is at most the log of the integral of exp(k) less k at the moments, for every k. It is at least that of
    the density exp(k), completed by a parabola d to have the moments: as x log x is convex, this lowers the
    entropy by at most the integral of |d| (1 + |log(density + d)|).
    """
    c, T = required(solution.maneuver)
    means = [arb(1), c[1] / T / c[2], 2 * c[0] / T**2 / c[2]]
    k = row(solution.exponent.coefficients)
    own = exponential_moments(k)
    whole = own[0]
    upper = whole.log() - dot(k, means)
    reached = [m / whole for m in own]
    missing = completion(from_shares([x - y for x, y in zip(means, reached, strict=True)], arb(1)), arb(1))
    logarithm = largest(k) + abs(whole.log())
    share = missing * logarithm.exp()
    if not share < 0.5:
        raise ValueError("the density is too small somewhere to be completed")
    lower = whole.log() - dot(k, reached) - missing * (1 + logarithm - (1 - share).log())
    return Enclosure(float(solution.entropy), lower, upper, size=1.0)
