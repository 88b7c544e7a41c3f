"""Section 3 up to (3.4): the dual problem in L1, the bang-bang programme, and time against peak."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Consequence,
    Equality,
    Evidence,
    Misprint,
    Proof,
    RightSides,
    Steps,
    vanishes,
)
from pontryagin.triple_integrator.claims.energy import gramian_is_definite
from pontryagin.triple_integrator.derivation import channel, parabola
from pontryagin.triple_integrator.derivation.channel import drive, t, tau, tf
from pontryagin.triple_integrator.derivation.duality import (
    area_of,
    dual_function_of,
    peak_bound,
    piecewise_moments,
    root_multipliers,
)
from pontryagin.triple_integrator.derivation.model import INPUT, T, multipliers, s, transition

claim = Page("Gorelov & Morozova 2012")

R = sp.Rational
l1, l2, l3 = multipliers
v = sp.Symbol("v", positive=True)
first, second = sp.symbols("a b", positive=True)


def two_switches(level: sp.Expr, earlier: sp.Expr, later: sp.Expr, duration: sp.Expr) -> sp.Matrix:
    """Moments of the control that is level, -level, level, with switches at two instants tau."""
    return piecewise_moments(
        [(earlier, level), (later - earlier, -level), (duration - later, level)]
    ).applyfunc(sp.expand)


def area_with_two_zeros() -> sp.Expr:
    """Integral over [0, T] of |(tau - a)(tau - b)| for 0 <= a <= b <= T."""
    h = (tau - first) * (tau - second)
    cuts = [(h, 0, first), (-h, first, second), (h, second, T)]
    return sp.expand(sum(sp.integrate(part, (tau, lo, hi)) for part, lo, hi in cuts))


def paired_with(moments: sp.Matrix) -> sp.Expr:
    """l'c for h = (tau - a)(tau - b), that is (s - (T - a))(s - (T - b))."""
    return sp.expand((root_multipliers(T - first, T - second).T * moments)[0])


@claim.proof(
    "before (3.1)",
    "the least L1 norm of h on l'c = 1 is ρ0",
    display=r"\min_{h(\cdot) \in P} \lVert h(\cdot) \rVert_{L_1} = \min_{l^T c = 1} \int_{t_0}^{t_f} "
    r"\left| \boldsymbol{\psi}^T(\tau)\mathbf{b} \right| d\tau = \rho_0",
)
def dual_norm_in_l1() -> Steps:
    yield (
        "every control with two switches meets its bound: l'c = v ∫|h| for h = (τ − a)(τ − b)",
        vanishes(paired_with(two_switches(v, first, second, T)) - v * area_with_two_zeros()),
    )
    sample = {v: 3, first: R(1, 5), second: R(2, 3), T: 1}
    moments = two_switches(v, first, second, T).subs(sample)
    others = [sp.Matrix([1, 0, 0]), sp.Matrix([3, -2, R(1, 4)]), root_multipliers(R(1, 3), R(1, 2))]
    yield "no h has a smaller norm than 1/v", all(peak_bound(l, moments, sp.S.One) < 3 for l in others)


@claim("(3.1)", "the dual problem is to minimise ∫|ψ3| on l'c = 1, where ψ3 = h", verdict="holds")
def dual_problem() -> Evidence:
    printed = ((transition(tf - tau).T * multipliers).T * INPUT)[0]
    return Equality(
        {r"\psi_3(\tau)": printed},
        parabola.parabola,
        display=r"\min_{l^T c=1} \int_{t_0}^{t_f} \left| \psi_3(\tau) \right| d\tau = \rho_0,\quad "
        r"\psi_3(\tau) = h(\tau)",
    )


@claim("before (3.2)", "ψ3 from the adjoint equation and its end values", verdict="holds")
def third_costate() -> Evidence:
    end = sp.symbols("psi_1f psi_2f psi_3f", real=True)
    printed = (tf - tau) ** 2 / 2 * end[0] + (tf - tau) * end[1] + end[2]

    def derived() -> RightSides:
        # Integrate (1.15) backwards from tf.
        clock = sp.Dummy("t")
        middle = end[1] + sp.integrate(end[0], (clock, tau, tf))
        return end[2] + sp.integrate(middle.subs(tau, clock), (clock, tau, tf))

    return Equality(
        {r"\psi_3(\tau)": printed},
        derived,
        display=r"\psi_3(\tau) = \tfrac12(t_f - \tau)^2\psi_1(t_f) + (t_f - \tau)\psi_2(t_f) + \psi_3(t_f)",
    )


@claim(
    "(3.2)",
    "ρ0 as the least integral of the quadratic",
    verdict="misprint",
    remark="Printed: square brackets around the integrand. Right: the modulus, as in (3.1) and (3.6). "
    "Without it the integral is linear in l and has no minimum (the scan may have read bars as brackets).",
)
def dual_problem_written_out() -> Evidence:
    key = r"\text{integrand}"
    quadratic = (tf - tau) ** 2 / 2 * l1 + (tf - tau) * l2 + l3

    def consequence() -> Consequence:
        least = dict(zip(multipliers, (1, -R(1, 2), R(3, 32)), strict=True))
        h = quadratic.subs(least).subs(tf, 1)
        return Consequence(
            "ρ0 of the unit turn in unit time", sp.integrate(sp.expand(h), (tau, 0, 1)), R(1, 32)
        )

    return Misprint(
        {key: quadratic},
        lambda: sp.Abs(parabola.parabola()),
        defect={key: quadratic - sp.Abs(parabola.parabola())},
        consequence=consequence,
        display=r"\rho_0 = \min_{l_1 c_1 + l_2 c_2 + l_3 c_3 = 1} \int_{t_0}^{t_f} "
        r"\left[\frac12 (t_f - \tau)^2 l_1 + (t_f - \tau) l_2 + l_3\right] d\tau",
    )


@claim("(3.3)", "the minimising ψ3* with the coefficients l10, l20, l30", verdict="holds")
def minimising_costate() -> Evidence:
    printed = (tf - t) ** 2 / 2 * l1 + (tf - t) * l2 + l3
    return Equality(
        {r"\psi_3^*(t)": printed},
        lambda: (transition(tf - t).T * multipliers)[2],
        display=r"\psi_3^*(t) = \tfrac12 (t_f - t)^2 l_{10} + (t_f - t) l_{20} + l_{30}",
    )


@claim("after (3.3): end values", "l10, l20, l30 are the end values of ψ1*, ψ2*, ψ3*", verdict="holds")
def end_values_of_the_costate() -> Evidence:
    return Equality(
        {rf"\psi_{k}^*(t_f)": l for k, l in enumerate(multipliers, start=1)},
        lambda: (transition(tf - t).T * multipliers).subs(t, tf),
        display=r"l_{10} = \psi_1^*(t_f),\; l_{20} = \psi_2^*(t_f),\; l_{30} = \psi_3^*(t_f)",
    )


@claim("before (3.4): conditions", "max ∫h0 u = 1 with max |u| = 1/ρ0, and u0 = 1/ρ0", verdict="holds")
def conditions_on_the_optimum() -> Evidence:
    def derived() -> RightSides:
        # The level of a control with two switches, from its moments and the h with the same zeros.
        moments = two_switches(v, first, second, T)
        return sp.cancel(paired_with(moments) / area_with_two_zeros())

    def argument() -> Steps:
        norm = area_with_two_zeros() / paired_with(two_switches(v, first, second, T))
        yield "ρ0 = ∫|h|/l'c is 1/v for the control of level v", vanishes(norm - 1 / v)
        yield "∫h0 u = l'c/l'c = 1", vanishes(norm * v - 1)

    return Proof(
        argument,
        Equality({"u_0": v}, derived),
        display=r"\max_{u(\cdot)} \int_{t_0}^{t_f} h_0(\tau)u(\tau)\,d\tau = 1;\quad "
        r"\max_{\tau} \left| u(\tau) \right| = \frac{1}{\rho_0};\quad u_0 = \frac{1}{\rho_0}",
    )


@claim.proof(
    "before (3.4): uniqueness",
    "the maximum is attained only by u = sign h0 / ρ0",
    display=r"u(\tau) = \frac{1}{\rho_0} \operatorname{sign} h_0(\tau)",
)
def only_the_sign_attains_it() -> Steps:
    yield (
        "h0 is a polynomial and not zero, so it vanishes at two instants at most",
        (sp.Poly(parabola.parabola(), tau).degree() == 2),
    )
    loss, weight = sp.symbols("delta h", positive=True)
    bound = sp.Symbol("U", positive=True)
    short = weight * bound - weight * (bound - loss)
    yield "wherever u is less than U sign h0 by δ, the integral loses h δ > 0", short.expand().is_positive


@claim.proof(
    "(3.4)",
    "least-peak programme u* = sign ψ3* / ρ0",
    remark="ψ3*/|ψ3*| is 0/0 at the one or two switching instants, where the value of u does not matter.",
    display=r"u^*(t) = \frac{1}{\rho_0} \frac{\psi_3^*(t)}{\left| \psi_3^*(t) \right|} = "
    r"\frac{1}{\rho_0} \operatorname{sign} \psi_3^*(t)",
)
def least_peak_programme() -> Steps:
    x = sp.Symbol("x", real=True, nonzero=True)
    yield "ψ/|ψ| is the sign where ψ is not zero", vanishes(sp.simplify(x / sp.Abs(x) - sp.sign(x)))
    sample = {v: 3, first: R(1, 5), second: R(2, 3), T: 1}
    moments = two_switches(v, first, second, T).subs(sample)
    l = root_multipliers(R(4, 5), R(1, 3))
    scale = (l.T * moments)[0]
    h = dual_function_of(l / scale)
    rho = area_of(h, sp.S.One)
    levels = [sp.sign(h.subs(s, 1 - x)) / rho for x in (R(1, 10), R(1, 2), R(9, 10))]
    pieces = list(zip((R(1, 5), R(7, 15), R(1, 3)), levels, strict=True))
    yield "sign h0 / ρ0 has the moments c of that h0", piecewise_moments(pieces) == moments
    yield "no control with these moments has a smaller peak", peak_bound(l, moments, sp.S.One) == 1 / rho


@claim.proof(
    "after (3.4): structure", "for arbitrary ends the least-peak control is bang-bang: ±u0 throughout"
)
def general_structure() -> Steps:
    zeros = sp.Poly(parabola.parabola(), tau).degree()
    yield "h0 changes sign at most twice", zeros == 2
    yield "h0 is not zero, so sign h0 is ±1 almost everywhere", gramian_is_definite()
    determinant = two_switches(v, first, second, T).jacobian([v, first, second]).det()
    yield (
        "level and switches fix the moments one to one: their Jacobian is −2v²(b − a)∫|(τ − a)(τ − b)|",
        (vanishes(determinant - 2 * v**2 * (first - second) * area_with_two_zeros())),
    )


@claim(
    "after (3.4): T and u0",
    "T and u0 correspond one to one, so the problem is the inverse of least time",
    verdict="conditional",
    remark="True where one end is an equilibrium (x2 = 0, x3 + f = 0, f constant): one can wait there, so "
    "u0(T) falls strictly. In general it need not: from (0, 1, 0) to (1, 1, 0) with f = 0, u0(T) = 32|1 − "
    "T|/T³ takes the value 4 at three durations, T = 0.9067..., √5 − 1 and 2. Least time is then the "
    "smallest root.",
)
def one_to_one() -> Evidence:
    force, wait = sp.symbols("f w", real=True)
    positive = sp.Symbol("T", positive=True)

    def moments(start: sp.Matrix, end: sp.Matrix, duration: sp.Expr) -> sp.Matrix:
        return (end - drive(start, duration, sp.S.Zero, force)).applyfunc(sp.expand)

    def argument() -> Steps:
        place = sp.Symbol("x", real=True)
        rest = sp.Matrix([place, 0, -force])
        longer = moments(channel.initial, rest, positive + wait)
        moved = transition(wait) * moments(channel.initial, rest, positive)
        yield (
            "final equilibrium: the control for T, then 0 for the time w, performs the T + w manoeuvre",
            vanishes(longer - moved),
        )
        later = moments(rest, channel.final, positive + wait)
        yield (
            "initial equilibrium: 0 for the time w, then the control, performs the T + w manoeuvre",
            vanishes(later - moments(rest, channel.final, positive)),
        )
        yield (
            "so u0(T + w) ≤ u0(T), and it is less because no h vanishes during the wait: l'c < u0(T) ∫|h|",
            gramian_is_definite(),
        )

    def counterexample() -> Steps:
        start, end = sp.Matrix([0, 1, 0]), sp.Matrix([1, 1, 0])
        level = 32 * (positive - 1) / positive**3
        state = start
        for share, sign in ((R(1, 4), -1), (R(1, 2), 1), (R(1, 4), -1)):
            state = drive(state, share * positive, sign * level)
        yield (
            "from (0, 1, 0) to (1, 1, 0): ∓32(T − 1)/T³ with switches at T/4, 3T/4 reaches the target",
            vanishes(state - end),
        )
        needed = (end - drive(start, positive, sp.S.Zero)).applyfunc(sp.expand)
        l = root_multipliers(R(1, 4) * positive, R(3, 4) * positive)
        area = area_with_two_zeros().subs({first: R(1, 4) * T, second: R(3, 4) * T}).subs(T, positive)
        bound = sp.simplify((l.T * needed)[0] / area)
        yield (
            "h = (τ − T/4)(τ − 3T/4) shows that no peak below 32|T − 1|/T³ does",
            vanishes(bound + level),
        )
        earlier = sp.Poly(4 * positive**3 - 32 * (1 - positive), positive)
        later = sp.Poly(4 * positive**3 - 32 * (positive - 1), positive)
        before = [x for x in earlier.real_roots() if 0 < x < 1]
        after = [x for x in later.real_roots() if x > 1]
        yield "u0 = 4 at one T < 1", len(before) == 1
        yield "u0 = 4 at T = √5 − 1 and at T = 2", set(after) == {sp.sqrt(5) - 1, sp.Integer(2)}

    return Conditional(argument, counterexample=counterexample)
