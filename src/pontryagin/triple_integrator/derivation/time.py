"""Least time for |u| <= U, as at the end of section 3: a quartic in T for either sign of the control.

In the level equation of the fixed-time problem the level v = +-1 is now given (units with U = 1), and the
moments depend on T. The time is never less than |c3|, which x3 alone needs, so the unknown is
z = T - |c3| >= 0, which loses no digits when the control has a narrow flip.
"""

import sympy as sp

from pontryagin.triple_integrator.derivation import model, peak

T = model.T
sign, z = sp.symbols("v z", real=True)
x10, x20, x30, x1f, x2f, x3f, f = sp.symbols("x10 x20 x30 x1f x2f x3f f", real=True)
p3, r2, w, base = sp.symbols("p3 r2 w base", real=True)


def moments() -> sp.Matrix:
    """c(T) of (1.10) under a constant disturbance f."""
    start, end = sp.Matrix([x10, x20, x30]), sp.Matrix([x1f, x2f, x3f])
    push = model.transition(model.s) * sp.Matrix([0, f, 0])
    return end - model.transition(T) * start - push.applyfunc(lambda g: sp.integrate(g, (model.s, 0, T)))


def scaled_moments() -> sp.Matrix:
    """(6 c1/T^3, 2 c2/T^2, c3/T)."""
    return sp.diag(6 / T**3, 2 / T**2, 1 / T) * moments()


def quartic() -> sp.Expr:
    """G(1/v) for v = +-1 without fractions: a quartic in T, whose roots include the least time."""
    k = scaled_moments()
    equation = peak.level_equation().subs(peak.t, sign)
    equation = equation.subs(dict(zip((peak.k1, peak.k2, peak.k3), k, strict=True)))
    polynomial = sp.numer(sp.together(equation))
    expanded = sp.expand(polynomial)
    for power in (6, 5, 4, 3, 2):
        expanded = expanded.subs(sign**power, sign ** (power % 2))
    factored = sp.factor_list(sp.expand(expanded), T)[1]
    quartic_factor = next(part for part, _ in factored if sp.degree(part, T) == 4)
    poly = sp.Poly(quartic_factor, T)
    return sp.expand(3 * poly.as_expr() / poly.LC())


def stable_form() -> sp.Expr:
    """`quartic` in p3 = v T - c3, r2 and w, which are all small where the control is nearly constant.

    p3^2 (4 T^2 - p3^2) + 8 p3 w - 12 r2^2 with
    r2 = 2 (x2f - x20) - (x3f + x30 + 2 f) T and w = 6 (x2f + x20) T - 12 (x1f - x10) - (x3f - x30) T^2.
    """
    return p3**2 * (4 * T**2 - p3**2) + 8 * p3 * w - 12 * r2**2


def small_parts() -> dict[sp.Symbol, sp.Expr]:
    """p3, r2 and w of `stable_form`, from the moments: T^2 (k2 - k3) and -2 T^3 (k1 - k3 - 3 (k2 - k3)/2)."""
    k1, k2, k3 = scaled_moments()
    return {
        p3: sp.expand(T * (sign - k3)),
        r2: sp.expand(sp.simplify(T**2 * (k2 - k3))),
        w: sp.expand(sp.simplify(-2 * T**3 * (k1 - k3 - sp.Rational(3, 2) * (k2 - k3)))),
    }


def in_excess_time() -> dict[str, list[sp.Expr]]:
    """Coefficients of `stable_form` in z = T - c3, constant term first, for c3 >= 0 and either sign.

    Here r2 = r20 + r21 z and w = w0 + w1 z + w2 z^2; the branch "same" has v = 1 = sign c3 and p3 = z.
    """
    r20, r21, w0, w1, w2, c3 = coefficient_symbols()
    parts = {r2: r20 + r21 * z, w: w0 + w1 * z + w2 * z**2}
    branches = {}
    for name, level in (("same", 1), ("opposite", -1)):
        form = stable_form().subs(parts).subs({p3: level * T - c3}).subs(T, c3 + z)
        poly = sp.Poly(sp.expand(form), z)
        branches[name] = [sp.factor(poly.coeff_monomial(z**i)) for i in range(5)]
    return branches


def coefficient_symbols() -> tuple[sp.Symbol, ...]:
    """r20, r21, w0, w1, w2 and c3 of `in_excess_time`."""
    return tuple(sp.symbols("r20 r21 w0 w1 w2 c3", real=True))


def small_part_coefficients() -> list[sp.Expr]:
    """r20, r21, w0, w1, w2 from the ends, for c3 = x3f - x30 >= 0."""
    c3 = coefficient_symbols()[-1]
    parts = small_parts()
    shifted = [sp.Poly(sp.expand(parts[key].subs(T, c3 + z)), z) for key in (r2, w)]
    wanted = [(0, 0), (0, 1), (1, 0), (1, 1), (1, 2)]
    return [sp.factor(shifted[i].coeff_monomial(z**power)) for i, power in wanted]
