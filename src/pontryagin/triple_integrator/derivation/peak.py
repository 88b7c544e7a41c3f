"""Least peak: one convex equation for the level of the control (3.4), which the paper does not give.

The optimum is v outside [b, a] and -v inside (in the time to go, scaled to s in [0, 1]), because the dual
function is a quadratic and changes sign at most twice. Its three moments, scaled so that a constant
control has all three equal to its level,

    k = (6 c1 / T^3, 2 c2 / T^2, c3 / T),

determine v, m = a + b and d = a - b. Eliminating m and d leaves one equation in t = 1/v which is convex:
a quadratic over a positive linear function, plus a cube of that linear function. A convex function that
is negative at zero has at most one root on either side, and the optimum is the root nearer to zero. Proof: a
nearer root on the other side would belong to a function with the same moments and a larger level w, which is
-w on one interval of the whole line and w elsewhere. Its difference from the optimum would change sign at
most twice and yet be orthogonal to 1, s and s^2, which is impossible.
"""

import sympy as sp

from pontryagin.triple_integrator.derivation import model

v, a, b, d, m, t, y = sp.symbols("v a b d m t y", real=True)
k1, k2, k3, e2, w = sp.symbols("k1 k2 k3 e2 w", real=True)


def scaled_moments(control_on: list[tuple[sp.Expr, sp.Expr, sp.Expr]]) -> sp.Matrix:
    """(6 c1, 2 c2, c3) of a piecewise constant control given as (level, from, to) over s in [0, 1]."""
    response = model.impulse_response()
    total = sum(
        (
            level * response.applyfunc(lambda h, lo=lo, hi=hi: sp.integrate(h, (model.s, lo, hi)))
            for level, lo, hi in control_on
        ),
        sp.zeros(3, 1),
    )
    return sp.diag(6, 2, 1) * total


def bang_bang_moments() -> sp.Matrix:
    """Scaled moments of the control that is v on [0, b], -v on [b, a] and v on [a, 1]."""
    return scaled_moments([(v, 0, b), (-v, b, a), (v, a, 1)]).applyfunc(sp.factor)


def centred_moments() -> sp.Matrix:
    """`bang_bang_moments` by m = a + b, d = a - b: v(1 - 2d(3m^2 + d^2)/4), v(1 - 2md), v(1 - 2d)."""
    return bang_bang_moments().subs({a: (m + d) / 2, b: (m - d) / 2}).applyfunc(sp.simplify)


def switches() -> dict[sp.Symbol, sp.Expr]:
    """d and m for a given level, from the last two moments."""
    _, second, third = centred_moments()
    width = sp.solve(sp.Eq(third, k3), d)[0]
    return {d: width, m: sp.solve(sp.Eq(second, k2).subs(d, width), m)[0]}


def level_equation() -> sp.Expr:
    """G(t), zero where t = 1/v: the first moment with m and d eliminated.

    G = k1 t - 1 + 3 (1 - k2 t)^2 / (4 (1 - k3 t)) + (1 - k3 t)^3 / 16.
    """
    first = centred_moments()[0]
    eliminated = sp.together(((k1 - first) / v).subs(switches()).subs(v, 1 / t))
    quotient = 1 - k3 * t
    square = sp.Rational(3, 4) * (1 - k2 * t) ** 2 / quotient
    rest = sp.factor(sp.simplify(eliminated - square - k1 * t + 1))
    return k1 * t - 1 + square + rest


def near_constant_equation() -> sp.Expr:
    """`level_equation` in y = 1 - k3 t, accurate also if the control is constant except for a narrow flip.

    With e2 = k2 - k3 and w = k1 - k3 - 3 e2/2 no terms of size one cancel when y is small:
    G = w t - y/4 + 3 e2^2 t^2 / (4 y) + y^3 / 16.
    """
    inverse = {k1: w + sp.Rational(3, 2) * e2 + k3, k2: e2 + k3}
    return sp.expand(sp.expand(level_equation().subs(inverse)).subs(k3, (1 - y) / t).simplify())


def near_constant_start() -> sp.Expr:
    """Positive root in y of `near_constant_equation` without its cube, at t = 1/k3."""
    quadratic = sp.expand(near_constant_equation().subs(t, 1 / k3) - y**3 / 16) * y
    return max(sp.solve(sp.expand(quadratic), y), key=lambda root: root.subs({w: 0, e2: 1, k3: 1}))


def quartic() -> sp.Expr:
    """P(v), whose real root of largest modulus is the least peak (in the moments, T = 1)."""
    in_level = sp.numer(sp.together(level_equation().subs(t, 1 / v)))
    polynomial = sp.Poly(sp.expand(in_level), v)
    return (polynomial.as_expr() * 3 / polynomial.LC()).expand()


def second_derivative() -> sp.Expr:
    """G'' = 3 (k2 - k3)^2 / (2 (1 - k3 t)^3) + 3 k3^2 (1 - k3 t) / 8, positive where 1 - k3 t is."""
    second = sp.diff(level_equation(), t, 2)
    from_cube = sp.factor(sp.diff((1 - k3 * t) ** 3 / 16, t, 2))
    return sp.factor(sp.simplify(second - from_cube)) + from_cube


def dual_bound() -> sp.Expr:
    """The lower bound on the peak by the dual function (s - a)(s - b), with the sign of its pairing."""
    h = (model.s - a) * (model.s - b)
    coefficients = [sp.Poly(sp.expand(h), model.s).coeff_monomial(model.s**i) for i in range(3)]
    value = coefficients[2] * k1 / 3 + coefficients[1] * k2 / 2 + coefficients[0] * k3
    return value / absolute_integral()


def absolute_integral() -> sp.Expr:
    """Integral over [0, 1] of |(s - a)(s - b)| for 0 <= b <= a <= 1."""
    h = (model.s - a) * (model.s - b)
    pieces = [(h, 0, b), (-h, b, a), (h, a, 1)]
    return sp.expand(sum(sp.integrate(part, (model.s, lo, hi)) for part, lo, hi in pieces))
