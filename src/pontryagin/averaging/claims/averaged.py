"""Section 2, (2.3) to (2.9): the averaged problem and what it leaves open."""

import numpy as np
import sympy as sp

from pontryagin.averaging.claims import instances, worked
from pontryagin.averaging.claims.family import kappa_at
from pontryagin.averaging.claims.principle import cost_costate
from pontryagin.averaging.derivation import averaged, principle, ripple, rotor, smooth
from pontryagin.averaging.derivation.averaged import alpha, eta, g, h0, kappa, omega, xi
from pontryagin.evidence import Conditional, Consequence, Equality, Misprint, Proof, Steps, vanishes
from pontryagin.ledger import Page

claim = Page("Akulenko 1977")

R = sp.Rational
PRINTED_RATE = -omega.diff(xi[0]) / omega * h0 - h0.diff(xi[0])
"""deta1/dtau as printed in (2.3)."""


def smooth_instance(expression: sp.Expr, at: dict[sp.Symbol, sp.Expr]) -> sp.Expr:
    """A general expression for the smooth example with k = 1, at a state (v, b) and a costate."""
    example = smooth.averaged_hamiltonian().subs(smooth.k, 1)
    concrete = expression.replace(h0.func, lambda *z: example.subs(smooth.eta, z[2]))
    return concrete.subs(omega, xi[0]).doit().subs(at)


@claim(
    "(2.3)",
    "averaged system of the first approximation",
    verdict="misprint",
    remark="Printed: dη/dτ = −ω'ω⁻¹(ηf0) − (η∂f0/∂ξ). Right: +ω'ω⁻¹(ηf0), as in (2.1). With the print "
    "ω(ηf0) would be constant and not (2.10), which the paper derives from it.",
)
def averaged_system():
    forward, backward = r"\frac{d\xi_1}{d\tau}", r"\frac{d\eta_1}{d\tau}"

    def derived():
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


@claim(
    "after (2.3): mean",
    "f0 is the mean of f0* over ψ at fixed ξ and η",
    verdict="holds",
    remark="The mean of the costate's rate is then a derivative of (ηf0), as averaging at fixed ψ and "
    "differentiation commute. With another anomaly x the weight dψ/dx must be in the mean before it is "
    "differentiated.",
)
def mean_rates():
    def argument() -> Steps:
        for variable, rest in zip((*xi, *eta), averaged.mean_and_derivative_commute(), strict=True):
            yield f"∂⟨h*⟩/∂{variable} = ⟨∂h*/∂{variable}⟩", rest == 0
        yield "h* is of degree one in η: (η∂h0/∂η) = h0", averaged.homogeneity() == 0

    return Proof(argument)


@claim(
    "(2.4)",
    "initial and end conditions of the averaged problem",
    verdict="misprint",
    remark="Printed: η(τ1) = −(αM0'). Right: η(τ1) = −(g0' + αM0'), see (1.6).",
)
def end_conditions():
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
        lambda: {key: averaged.end_costates()[1]},
        defect={key: g.diff(xi[1])},
        consequence=shown,
        display=r"\xi(0) = a_0,\quad M_0(\xi)_{\tau_1} = 0,\quad \eta(\tau_1) = -(\alpha M_0')_{\tau_1}",
    )


@claim(
    "(2.5): a, p",
    "a = ξ + O(ε) and p = η + O(ε) for a given t1",
    verdict="conditional",
    remark="True where the averaged problem's solution moves by O(ε) when its data do, as is assumed. Not in "
    "the paper's example 1, least time: p(t1) = 1/x' at the anomaly where the motion ends, η(τ1) = 1/ω, and "
    "with the mass (1 + cos(x)/2)² they are as 3 to 2 for ε as small as one likes.",
)
def closeness():
    def argument() -> Steps:
        for eps in worked.EPSILONS:
            scan = worked.in_window(eps)
            off = np.abs(scan.costate - worked.averaged(2 * ripple.A1, kappa_at(scan))).max()
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
def phase_costate():
    key = r"q/\varepsilon"
    first = principle.leading_h()

    def shown() -> Consequence:
        example = smooth.maximum().subs(smooth.k, 1)
        level = example.subs(smooth.eta, R(3, 2))
        return Consequence("q/ε in the smooth example at ξ = 1, η = 3/2, k = 1", level, -level)

    return Misprint(
        {key: first / principle.omega},
        lambda: {key: principle.phase_costate()[0]},
        defect={key: 2 * first / principle.omega},
        consequence=shown,
        display=r"q = \varepsilon\omega^{-1}(\xi)(\eta f_0^*(\xi, \psi, \eta)) + O(\varepsilon^2)",
    )


@claim("(2.5): ψ", "ψ = (1/ε)∫ω(ξ)dτ + O(1)", verdict="holds")
def phase():
    def argument() -> Steps:
        for eps in worked.EPSILONS:
            scan = worked.in_window(eps)
            off = np.abs(scan.phase - worked.averaged(ripple.turned(), kappa_at(scan)) / eps).max()
            yield (
                f"rippled example, ε = {eps}: ψ(t1) of all members within {off:.2f} of it, out of "
                f"{scan.phase.max():.0f}",
                off < 0.3,
            )

    return Proof(
        argument,
        display=r"\psi = \frac{1}{\varepsilon}\int_0^{\tau} \omega(\xi(\tau', \tau_1))d\tau' + O(1)",
    )


@claim(
    "(2.6)",
    "with (2.5) put in, (2.2) does not fix τ1 as closely as needed, the phase being known to O(1)",
    verdict="holds",
)
def approximate_condition():
    def argument() -> Steps:
        for eps in worked.EPSILONS:
            scan = worked.in_window(eps)
            off = np.abs(scan.phase - worked.averaged(ripple.turned(), kappa_at(scan)) / eps).max()
            yield f"rippled example, ε = {eps}: the phase at the end is off by up to {off:.2f}", off > 0.1
            levels = worked.roots(eps).level + swing_off(eps)
            yield (
                f"at the exact roots (2.6) leaves up to {np.abs(levels).max():.2f} of h*",
                (np.abs(levels).max() > 0.05),
            )

    return Proof(
        argument,
        display=r"h^*(\xi + O(\varepsilon), \frac{1}{\varepsilon}\int_0^{\tau_1}\omega d\tau + O(1), \eta + "
        r"O(\varepsilon), O(\varepsilon), \varepsilon) = 0",
    )


def approximate_level(member: np.ndarray, eps: float) -> np.ndarray:
    """h* of (2.6) without the errors, for the averaged members kappa."""
    costate = worked.averaged(2 * ripple.A1, member)
    return worked.level(worked.averaged(ripple.turned(), member) / eps, costate)


def swing_off(eps: float) -> np.ndarray:
    """h* of (2.6) at the exact roots' durations."""
    return approximate_level(worked.kappa_of(worked.roots(eps).duration), eps)


def approximate_roots(eps: float) -> np.ndarray:
    """Durations that solve (2.6) without the errors, by sign changes on a fine grid of kappa."""
    low, high = worked.window()
    member = np.linspace(low, high, int(200 / eps))
    value = approximate_level(member, eps)
    left = np.flatnonzero(value[1:] * value[:-1] < 0)
    share = value[left] / (value[left] - value[left + 1])
    return worked.averaged(ripple.duration(), member[left] + share * (member[left + 1] - member[left]))


@claim(
    "after (2.6): neighbourhood",
    "in an ε-neighbourhood of every root of (2.6) without the errors lies a root of (2.2); (2.7) and (2.8) "
    "suffice",
    verdict="conditional",
    remark="True where h* takes both signs over a turn of the phase, as it does near a root of (2.7) if it "
    "depends on the phase at all. If it does not, (2.7) and (2.8) do not suffice: v' = εu, s' = ε, ω = 1, "
    "b' = ε(k(s) − ε + u²) has a double root at ε = 0, and no root near it for ε > 0.",
)
def neighbourhood():
    def argument() -> Steps:
        for eps in worked.EPSILONS:
            near, exact = approximate_roots(eps), worked.roots(eps).duration
            off = np.abs(near[:, None] - exact).min(axis=1).max()
            yield (
                f"rippled example, ε = {eps}: each of the {near.size} roots of (2.6) has a root of (2.2) "
                f"within "
                f"{off / eps:.2f}ε",
                off < 2 * eps and near.size > 2,
            )

    def counterexample() -> Steps:
        small, end = sp.Symbol("epsilon", positive=True), instances.T
        flat = instances.Clock(instances.TOUCHING).level
        yield (
            "at ε = 0: h* at the end has a double root τ1 = 1",
            flat.subs(end, 1) == 0 and vanishes(flat.diff(end).subs(end, 1)),
        )
        turned = sp.integrate(sp.S.One, (sp.Symbol("tau"), 0, end))
        yield "with ω = 1 the derivative of (2.8) is 1, not 0", turned.diff(end) == 1
        moved = sp.factor(instances.Clock(instances.TOUCHING, small).kappa)
        numerator = sp.Poly(sp.numer(sp.together(moved)).subs(small, R(1, 100)), end)
        yield "ε = 1/100: no root in 0 < τ1 < 3/2", numerator.count_roots(0, R(3, 2)) == 0
        yield "the next is near the minimum at 2", numerator.count_roots(R(3, 2), R(5, 2)) == 1

    return Conditional(argument, counterexample=counterexample)


@claim("(2.7)", "the roots lie about the root of ⟨h*⟩ = 0", verdict="holds")
def mean_condition():
    def argument() -> Steps:
        level = averaged.averaged_hamiltonian()
        yield "h0 = −ωκ at the end, so (2.7) is κ = 0", sp.solve(level.subs(h0, 0), kappa) == [0]
        T = ripple.of_kappa(ripple.duration()).subs({ripple.rise: 1, ripple.kappa: 0})
        yield "smooth example: τ1* = (v1 − v0)/√k", vanishes(T - (ripple.v1 - ripple.v0) / sp.sqrt(ripple.k))
        low, high = worked.window()
        yield f"rippled: the window from κ = {low:.3f} to {high:.3f} has κ = 0 inside", low < 0 < high

    return Proof(argument, display=r"\langle h_0(\xi(\tau_1, \tau_1), \eta(\tau_1, \tau_1)) \rangle = 0")


@claim("(2.8)", "the phase at the end runs with τ1: derivative of ∫ω dτ by τ1", verdict="holds")
def phase_runs():
    key = r"\frac{d}{d\tau_1}\int_0^{\tau_1}\omega d\tau"
    end, time = sp.symbols("tau_1 tau", positive=True)
    w, path = sp.Function("omega"), sp.Function("xi")(time, end)
    named = sp.Symbol("omega'")

    def printed():
        slope = sp.Derivative(w(path), path).doit()
        return w(path).subs(time, end) + sp.Integral(slope * path.diff(end), (time, 0, end))

    return Equality(
        {key: printed()},
        lambda: {key: sp.Integral(w(path), (time, 0, end)).diff(end)},
        display=rf"\omega(\xi(\tau_1^*, \tau_1^*)) + \int_0^{{\tau_1^*}} {named}(\xi(\tau, \tau_1^*))"
        r"\frac{\partial \xi(\tau, \tau_1^*)}{\partial \tau_1^*}d\tau \ne 0",
    )


@claim(
    "(2.9)",
    "to the first order τ1 may be taken from an interval, and is optimal where J0(τ1) is least",
    verdict="holds",
    remark="Where h* takes both signs over a turn. The optimal τ1 is off by O(ε), with a factor that jumps "
    "from ε to ε as the best root changes.",
)
def interval():
    def argument() -> Steps:
        ends = worked.averaged(ripple.duration(), np.array(worked.window()))
        for eps in worked.EPSILONS:
            found = worked.roots(eps)
            gaps = np.diff(np.sort(np.concatenate([found.duration, ends])))
            yield (
                f"rippled example, ε = {eps}: the roots fill the interval from {ends[0]:.3f} to "
                f"{ends[1]:.3f} "
                f"with gaps of at most {gaps.max() / eps:.1f}ε",
                gaps.max() < 6 * eps,
            )
            off = abs(found.duration[worked.best(eps)] - 1)
            yield f"the best has τ1 = 1 within {off / eps:.2f}ε", off < 2.5 * eps

    return Proof(argument, display=r"J_0 = g_0(\xi(\tau_1, \tau_1)) \to \min_{\tau_1}")
