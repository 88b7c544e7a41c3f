"""Where the printed least-impulse solution (4.10) holds, and the cost of its impulses elsewhere.

Directions of c are points of the unit sphere of (6 c1, 2 c2, c3) for T = 1. The direction of a constant
control is (1, 1, 1)/sqrt(3).
"""

import sympy as sp

from pontryagin.triple_integrator.derivation import impulse

sigma = impulse.sigma


def direction(place: sp.Expr) -> sp.Matrix:
    """(6 c1, 2 c2, c3) of a unit impulse at sigma: (3 sigma^2, 2 sigma, 1)."""
    return sp.Matrix([3 * place**2, 2 * place, 1])


def chebyshev_edges() -> list[sp.Matrix]:
    """Edges of the cone in which the impulses at 0, T/2, T have the signs +, -, + of the polynomial."""
    half = sp.Rational(1, 2)
    return [direction(sp.Integer(0)), -direction(half), direction(sp.Integer(1))]


def solid_angle(edges: list[sp.Matrix]) -> sp.Expr:
    """Solid angle of a cone with three edges (van Oosterom and Strackee)."""
    first, second, third = edges
    lengths = [edge.norm() for edge in edges]
    triple = sp.Abs(sp.Matrix.hstack(*edges).det())
    denominator = (
        sp.prod(lengths)
        + first.dot(second) * lengths[2]
        + first.dot(third) * lengths[1]
        + second.dot(third) * lengths[0]
    )
    return 2 * sp.atan2(triple, denominator)


def share_of_directions() -> sp.Expr:
    """Share of all directions for which (4.10) is optimal: the cone and its mirror image, over 4 pi."""
    return sp.simplify(2 * solid_angle(chebyshev_edges()) / (4 * sp.pi))


def overpayment() -> sp.Expr:
    """Total of the three impulses (4.10) for the moments of a unit impulse at sigma <= 1/2.

    The total is a norm of c, and the least total impulse is the gauge of the convex hull of the unit
    impulses, so that the ratio of the two is largest at a unit impulse. There it is the Lebesgue function of
    interpolation at 0, 1/2, 1.
    """
    moments = dict(zip((impulse.m0, impulse.m1, impulse.m2), (1, sigma, sigma**2), strict=True))
    amplitudes = impulse.chebyshev_amplitudes().subs(moments)
    signs = [sp.sign(amplitude.subs(sigma, sp.Rational(1, 4))) for amplitude in amplitudes]
    return sp.expand(sum(sign * amplitude for sign, amplitude in zip(signs, amplitudes, strict=True)))


def worst_overpayment() -> tuple[sp.Expr, sp.Expr]:
    """The sigma in [0, 1/2] of the largest overpayment, and this overpayment: (1/4, 5/4)."""
    total = overpayment()
    place = sp.solve(sp.diff(total, sigma), sigma)[0]
    return place, total.subs(sigma, place)
