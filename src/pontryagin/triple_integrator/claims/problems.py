"""Section 1 from (1.15) on: the costate and the three problems."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Conditional, Equality, Evidence, RightSides, Steps, vanishes
from pontryagin.triple_integrator.claims.turn import BANG_BANG, IMPULSE_DUAL, IMPULSES, PEAK_DUAL, TURN
from pontryagin.triple_integrator.derivation.channel import t, tau, tf
from pontryagin.triple_integrator.derivation.chebyshev import three_impulses
from pontryagin.triple_integrator.derivation.duality import (
    conjugate_norm,
    dual_function_of,
    impulse_bound,
    lengths,
    levels,
    peak_bound,
    piecewise_moments,
)
from pontryagin.triple_integrator.derivation.model import (
    CHAIN,
    INPUT,
    c,
    impulse_response,
    multipliers,
    s,
    transition,
)

claim = Page("Gorelov & Morozova 2012")

R = sp.Rational
v1, v2 = levels
T1, T2 = lengths


@claim(
    "before (1.15)", "ψ(τ) = Φ'(tf, τ) l, whose third component is h; (1.15): dψ/dt = −A'ψ", verdict="holds"
)
def adjoint_vector() -> Evidence:
    def derived() -> RightSides:
        names = sp.symbols("k_1:4")
        # Integrate dpsi/dt = -A' psi backwards from psi(tf) = l: psi1 const, psi2' = -psi1, psi3' = -psi2.
        first = multipliers[0]
        second = names[1] + sp.integrate(-first, tau)
        second = second.subs(names[1], sp.solve(second.subs(tau, tf) - multipliers[1], names[1])[0])
        third = names[2] + sp.integrate(-second, tau)
        third = third.subs(names[2], sp.solve(third.subs(tau, tf) - multipliers[2], names[2])[0])
        return sp.Matrix([first, second, third])

    return Equality(
        {r"\boldsymbol{\psi}(\tau)": transition(tf - tau).T * multipliers},
        derived,
        display=r"\boldsymbol{\psi}(\tau) = \Phi^T(t_f, \tau)\, l",
    )


@claim("(1.15)", "adjoint equation dψ/dt = −A'ψ", verdict="holds")
def adjoint_equation() -> Evidence:
    def derived() -> RightSides:
        psi = transition(tf - t).T * multipliers
        return psi.diff(t)

    printed = -CHAIN.T * transition(tf - t).T * multipliers
    return Equality(
        {r"\dot{\boldsymbol{\psi}}(t)": printed},
        derived,
        display=r"\frac{d\boldsymbol{\psi}(t)}{dt} = -A^T \boldsymbol{\psi}(t)",
    )


@claim("(1.16)", "the final condition of the adjoint equation: ψ'(tf) c = l'c = 1", verdict="holds")
def adjoint_end() -> Evidence:
    def derived() -> RightSides:
        psi = (transition(tf - t).T * multipliers).subs(t, tf)
        third = sp.solve((multipliers.T * c)[0] - 1, multipliers[2])[0]
        return sp.simplify((psi.T * c)[0].subs(multipliers[2], third))

    return Equality({r"\boldsymbol{\psi}^T(t_f)c": sp.S.One}, derived)


@claim("(1.17)", "the dual problem in the costate; ψ'b = ψ3 = h", verdict="holds")
def dual_problem_in_the_costate() -> Evidence:
    psi = transition(tf - t).T * multipliers
    return Equality(
        {r"\boldsymbol{\psi}^T(t)\mathbf{b}": (psi.T * INPUT)[0]},
        lambda: (multipliers.T * impulse_response())[0].subs(s, tf - t),
        display=r"\min_{\psi^T(t_f)c=1} \lVert \psi^T(\cdot)\mathbf{b} \rVert_{L_p} = "
        r"\lVert \psi_0^T(\cdot)\mathbf{b} \rVert_{L_p} = \rho_0,\quad \psi^T(t)\mathbf{b} = \psi_3(t)",
    )


@claim("(1.18)", "problem 1: J = ‖u‖² in L_2, the integral of u²", verdict="holds")
def problem_1() -> Evidence:
    return Equality(
        {"J(u)": T1 * v1**2 + T2 * v2**2},
        lambda: conjugate_norm(sp.S(2)) ** 2,
        display=r"J(u(\cdot)) = \left(\lVert u(\cdot) \rVert_{L_2}\right)^2 = \int_{t_0}^{t_f} "
        r"u^2(\tau)\,d\tau",
    )


@claim("(1.19)", "problem 2: J = ‖u‖ in L_∞, the essential maximum of |u|", verdict="holds")
def problem_2() -> Evidence:
    return Equality(
        {"J(u)": sp.Max(sp.Abs(v1), sp.Abs(v2))},
        lambda: conjugate_norm(sp.oo),
        display=r"J(u(\cdot)) = \lVert u(\cdot) \rVert_{L_\infty} = "
        r"\operatorname{vrai\,max}_{t \in [t_0, t_f]} \left| u(t) \right|",
    )


@claim.proof("after (1.19)", "problem 2 finds the least u0 for which (0.7) can be kept")
def least_bound() -> Steps:
    yield "unit turn: u0 = 32 is enough", piecewise_moments(BANG_BANG) == TURN
    yield "no smaller u0 is: the bound by h", peak_bound(PEAK_DUAL, TURN, sp.S.One) == 32


@claim("(1.20)", "problem 3: J = ‖u‖ in L_1, the total impulse", verdict="holds")
def problem_3() -> Evidence:
    return Equality(
        {"J(u)": T1 * sp.Abs(v1) + T2 * sp.Abs(v2)},
        lambda: conjugate_norm(sp.S.One),
        display=r"J(u(\cdot)) = \lVert u(\cdot) \rVert_{L_1} = \int_{t_0}^{t_f} \left| u(\tau) \right| d\tau",
    )


@claim(
    "after (1.20)",
    "problem 3 has a solution u in L_1 for arbitrary ends",
    verdict="conditional",
    remark="True where a control of one sign has the moments c (c3 ≠ 0 and 2c1c3 > c2², Tc2/c3 > "
    "2c1/c3). Otherwise no integrable control attains the infimum; only impulses do, as already "
    "in example 1.",
)
def minimiser_in_l1() -> Evidence:
    def argument() -> Steps:
        times, sizes = sp.symbols("d_1:4", positive=True), sp.symbols("u_1:4", positive=True)
        pieces = list(zip(times, sizes, strict=True))
        spent = sum(duration * size for duration, size in pieces)
        yield "a control of one sign spends c3 (three pieces)", vanishes(piecewise_moments(pieces)[2] - spent)
        bound = impulse_bound(sp.Matrix([0, 0, 1]), sp.Matrix([0, 0, 1]), sp.S.One)
        yield "h = 1 proves that no control spends less than |c3|", bound == 1

    def counterexample() -> Steps:
        h = dual_function_of(IMPULSE_DUAL)
        room = sp.factor(1 - 256 * h**2)
        yield (
            "example 1: 1 = ∫ h u with |h| < 1/16 except at three instants",
            set(sp.Poly(room, s).real_roots()) == {0, R(1, 2), 1},
        )
        yield "hence ‖u‖ > 16 for every integrable u", min(room.subs(s, R(k, 4)) for k in (1, 3)) > 0
        yield (
            "narrow pulses approach 16",
            three_impulses(IMPULSES) == TURN,
        )

    return Conditional(argument, counterexample=counterexample)
