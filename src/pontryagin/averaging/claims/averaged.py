"""Section 2, (2.3) to (2.5): the averaged problem."""

import numpy as np
import sympy as sp

from pontryagin.averaging.claims import instances, worked
from pontryagin.averaging.claims.principle import cost_costate
from pontryagin.averaging.derivation import averaged, principle, rotor, smooth
from pontryagin.averaging.derivation.averaged import alpha, eta, g, h0, omega, xi
from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Consequence,
    Evidence,
    Misprint,
    Steps,
    vanishes,
)

claim = Page("Akulenko 1977")

R = sp.Rational
PRINTED_RATE = -omega.diff(xi[0]) / omega * h0 - h0.diff(xi[0])
"""deta1/dtau as printed in (2.3)."""


def smooth_instance(expression: sp.Expr, at: dict[sp.Symbol, sp.Expr]) -> sp.Expr:
    """Value of a general expression in the smooth example with k = 1, at a state (v, b) and a costate."""
    example = smooth.averaged_hamiltonian().subs(smooth.k, 1)
    concrete = expression.replace(h0.func, lambda *z: example.subs(smooth.eta, z[2]))
    return concrete.subs(omega, xi[0]).doit().subs(at)


@claim(
    "(2.3)",
    "averaged system of the first approximation",
    verdict="misprint",
    remark="Printed: dη/dτ = −ω'ω⁻¹(ηf0) − (η∂f0/∂ξ). Right: +ω'ω⁻¹(ηf0), as in (2.1). With the printed sign "
    "ω(ηf0) would be constant, and not (2.10), which the paper derives from (2.3).",
)
def averaged_system() -> Evidence:
    forward, backward = r"\frac{d\xi_1}{d\tau}", r"\frac{d\eta_1}{d\tau}"

    def derived() -> dict[str, sp.Expr]:
        rates = averaged.standard_rates()
        return {forward: rates[0][0], backward: rates[1][0]}

    def shown() -> Consequence:
        at = {xi[0]: 1, eta[0]: R(3, 2)}
        motion = {xi[0]: averaged.rates()[0][0], eta[0]: PRINTED_RATE}
        drift = sum(averaged.integral().diff(x) * rate for x, rate in motion.items())
        return Consequence(
            "dκ/dτ in the smooth example at ξ = 1, η = 3/2, k = 1", smooth_instance(drift, at), sp.S.Zero
        )

    return Misprint(
        {forward: h0.diff(eta[0]), backward: PRINTED_RATE},
        derived,
        defect={backward: -2 * omega.diff(xi[0]) / omega * h0},
        consequence=shown,
        display=r"\frac{d\xi}{d\tau} = f_0(\xi, \eta),\quad \frac{d\eta}{d\tau} = "
        r"-\frac{\omega'(\xi)}{\omega(\xi)}(\eta f_0) - \left(\eta\frac{\partial f_0}{\partial \xi}\right)",
    )


@claim.proof(
    "after (2.3): mean",
    "f0 is the mean of f0* over ψ at fixed ξ and η",
    remark="The mean of the costate's rate is then a derivative of (ηf0), as averaging at fixed ψ and "
    "differentiation commute. With another anomaly x the mean has to include the weight dψ/dx before "
    "it is differentiated.",
)
def mean_rates() -> Steps:
    for variable, rest in zip((*xi, *eta), averaged.mean_and_derivative_commute(), strict=True):
        yield f"∂⟨h*⟩/∂{variable} = ⟨∂h*/∂{variable}⟩", rest == 0
    yield "h* is of degree one in η: (η∂h0/∂η) = h0", averaged.homogeneity() == 0


@claim(
    "(2.4)",
    "initial and end conditions of the averaged problem",
    verdict="misprint",
    remark="Printed: η(τ1) = −(αM0'). Right: η(τ1) = −(g0' + αM0'), see (1.6).",
)
def end_conditions() -> Evidence:
    key = r"\eta_2(\tau_1)"
    printed = -alpha * averaged.M.diff(xi[1])

    def shown() -> Consequence:
        back = dict(zip(xi, principle.a, strict=True))
        right = averaged.end_costates()[1].subs(back, simultaneous=True).doit()
        wrong = printed.subs(back, simultaneous=True).doit()
        return Consequence(
            "costate of the cost b in the smooth example, g = b", cost_costate(wrong), cost_costate(right)
        )

    return Misprint(
        {key: printed},
        lambda: averaged.end_costates()[1],
        defect={key: g.diff(xi[1])},
        consequence=shown,
        display=r"\xi(0) = a_0,\quad M_0(\xi)_{\tau_1} = 0,\quad \eta(\tau_1) = -(\alpha M_0')_{\tau_1}",
    )


@claim(
    "(2.5): a, p",
    "a = ξ + O(ε) and p = η + O(ε) for a given t1",
    verdict="conditional",
    remark="True where the solution of the averaged problem moves by O(ε) when its data do, as is assumed. "
    "False in the paper's example 1, least time: p(t1) = 1/x' at the anomaly where the motion ends, "
    "while η(τ1) = 1/ω, and with the mass (1 + cos(x)/2)² the two are in the ratio 3 to 2 for ε as "
    "small as one likes.",
)
def closeness() -> Evidence:
    def argument() -> Steps:
        for eps in worked.EPSILONS:
            off = worked.deviations(eps)["costate"]
            yield f"rippled example, ε = {eps}, all members: p(t1) − η1 at most {off / eps:.2f}ε", off < eps
            motion = worked.optimum(eps)
            start = worked.roots(eps).start[worked.best(eps)]
            member = worked.kappa_of(motion["tau"][-1])
            expected = 2 * np.sqrt(worked.PAY - member * motion["v"])
            whole = np.abs(motion["p"] - expected).max()
            yield (
                f"its optimum: p − η at the same v at most {whole / eps:.2f}ε",
                whole < 2 * eps and start > 0,
            )

    def counterexample() -> Steps:
        exact, mean = instances.uneven_end_costates()
        travelled = sp.integrate(1, (rotor.a, instances.a0, instances.a1)) / principle.epsilon
        yield (
            "rotor, u = 1: x(t1) = (a1 − a0)/ε, which is 2πN for ε = (a1 − a0)/(2πN)",
            vanishes(travelled * principle.epsilon - (instances.a1 - instances.a0)),
        )
        ratio = sp.simplify((exact / mean).subs(rotor.x, 0))
        yield "there p(t1)/η(τ1) = ω/x' = 3/2", ratio == R(3, 2)
        other = sp.simplify((exact / mean).subs(rotor.x, sp.pi))
        yield "and half a turn later 1/2", other == R(1, 2)

    return Conditional(
        argument,
        counterexample=counterexample,
        display=r"a(t, t_1, \varepsilon) = \xi(\tau, \tau_1) + O(\varepsilon),\quad p(t, t_1, \varepsilon) = "
        r"\eta(\tau, \tau_1) + O(\varepsilon)",
    )


@claim(
    "(2.5): q",
    "the phase's costate of the first approximation",
    verdict="misprint",
    remark="Printed: q = +εω⁻¹(ηf0*). Right: q = −εω⁻¹(ηf0*), as the paper has after (2.1).",
)
def phase_costate() -> Evidence:
    key = r"q/\varepsilon"
    first = principle.leading_h()

    def shown() -> Consequence:
        example = smooth.maximum().subs(smooth.k, 1)
        level = example.subs(smooth.eta, R(3, 2))
        return Consequence("q/ε in the smooth example at ξ = 1, η = 3/2, k = 1", level, -level)

    return Misprint(
        {key: first / principle.omega},
        lambda: principle.phase_costate()[0],
        defect={key: 2 * first / principle.omega},
        consequence=shown,
        display=r"q = \varepsilon\omega^{-1}(\xi)(\eta f_0^*(\xi, \psi, \eta)) + O(\varepsilon^2)",
    )


@claim.proof(
    "(2.5): ψ",
    "ψ = (1/ε)∫ω(ξ)dτ + O(1)",
    display=r"\psi = \frac{1}{\varepsilon}\int_0^{\tau} \omega(\xi(\tau', \tau_1))d\tau' + O(1)",
)
def phase() -> Steps:
    for eps in worked.EPSILONS:
        scan, off = worked.in_window(eps), worked.deviations(eps)["phase"]
        yield (
            f"rippled example, ε = {eps}: ψ(t1) of all members within {off:.2f} of it, out of "
            f"{scan.phase.max():.0f}",
            off < 0.3,
        )
