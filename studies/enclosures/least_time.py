"""The least time under a bound: the least admissible root of two quartics, isolated with exact coefficients.

A control of least time has the modulus U and at most two switches. Such a control is v outside the interval
[b, a] of times to go and -v inside, v = U or -U. Its three moment equations determine a - b and a + b as
functions of its duration T, which is then a root of a quartic in T. Every root is enclosed; its switches tell
whether it is the duration of a control.
"""

from collections.abc import Iterator, Sequence
from typing import Any

from flint import acb, arb, fmpq, fmpq_poly

from studies.enclosures.ball import Enclosure


def rational(number: Any) -> fmpq:
    """A float as the rational that it is."""
    return fmpq(*float(number).as_integer_ratio())


def candidates(solution: Any) -> Iterator[tuple[arb, arb]]:
    """Positive real roots of both quartics, and by how much their switches leave [0, T], as a share of T.

    With p1, p2 and p3 the differences of the moments of the constant control v from the required ones, times
    6, 2 and 1, the quartic is 16 v^2 p1 p3 - 12 v^2 p2^2 - p3^4.
    """
    start, end = ([rational(x) for x in ends] for ends in (solution.x0, solution.xf))
    k = start[2] + rational(solution.disturbance)
    dx, dv, c3 = end[0] - start[0], end[1] - start[1], end[2] - start[2]
    bound = rational(solution.peak)
    for v in (bound, -bound):
        p1 = fmpq_poly([-6 * dx, 6 * start[1], 3 * k, v])
        p2 = fmpq_poly([-2 * dv, 2 * k, v])
        p3 = fmpq_poly([-c3, v])
        for root, _ in (16 * v * v * p1 * p3 - 12 * v * v * p2 * p2 - p3**4).complex_roots():
            if _is_real(root) and root.real > 0:
                T = root.real
                difference = _at(p3, T) / T
                d = difference / (2 * _ball(v))
                m = 1 - (_at(p2, T) / T**2 - difference) / difference
                yield T, (-d).max((d - m) / 2).max((m + d) / 2 - 1)


def _is_real(root: acb) -> bool:
    return root.imag == 0


def _at(polynomial: fmpq_poly, x: arb) -> arb:
    value = arb(0)
    for coefficient in reversed(polynomial.coeffs()):
        value = value * x + _ball(coefficient)
    return value


def _ball(number: fmpq) -> arb:
    return arb(number)


def time(solution: Any) -> Enclosure | None:
    """The least time; None where the balls do not decide whether a root before it is that of a control."""
    roots: Sequence[tuple[arb, arb]] = list(candidates(solution))
    certain = [T for T, violation in roots if violation < 0]
    if not certain:
        return None
    least = min(certain, key=lambda T: float(T.mid()))
    for T, violation in roots:
        if not (violation > 0 or least <= T or T is least):
            return None
    return Enclosure(float(solution.duration), least, least)
