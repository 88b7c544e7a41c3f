"""Section 2, (2.6) to (2.9): the roots predicted by the averaged problem, and the interval of tau_1."""

import numpy as np
import sympy as sp

from pontryagin.averaging.claims import instances, worked
from pontryagin.averaging.derivation import averaged, ripple, smooth
from pontryagin.averaging.derivation.averaged import h0, kappa
from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Equality,
    Evidence,
    Steps,
    vanishes,
)

claim = Page("Akulenko 1977")

R = sp.Rational


@claim.proof(
    "(2.6)",
    "with (2.5) inserted, (2.2) does not determine τ1 as closely as needed, since the phase is known "
    "to O(1) only",
    display=r"h^*(\xi + O(\varepsilon), \frac{1}{\varepsilon}\int_0^{\tau_1}\omega d\tau + O(1), \eta + "
    r"O(\varepsilon), O(\varepsilon), \varepsilon) = 0",
)
def approximate_condition() -> Steps:
    for eps in worked.EPSILONS:
        off = worked.deviations(eps)["phase"]
        yield f"rippled example, ε = {eps}: the phase at the end is off by up to {off:.2f}", off > 0.1
        levels = worked.roots(eps).level + swing_off(eps)
        yield (
            f"at the exact roots (2.6) leaves up to {np.abs(levels).max():.2f} of h*",
            (np.abs(levels).max() > 0.05),
        )


def approximate_level(member: np.ndarray, eps: float) -> np.ndarray:
    """h* of (2.6) without its error terms, for members of the averaged family given by kappa."""
    costate = worked.averaged(2 * ripple.A1, member)
    return worked.level(worked.averaged(ripple.turned(), member) / eps, costate)


def swing_off(eps: float) -> np.ndarray:
    """h* of (2.6) without its error terms, at the durations of the exact roots."""
    return approximate_level(worked.kappa_of(worked.roots(eps).duration), eps)


def approximate_roots(eps: float) -> np.ndarray:
    """Durations that solve (2.6) without its error terms, by sign changes on a fine grid of kappa."""
    low, high = worked.window()
    member = np.linspace(low, high, int(200 / eps))
    value = approximate_level(member, eps)
    left = np.flatnonzero(value[1:] * value[:-1] < 0)
    share = value[left] / (value[left] - value[left + 1])
    return worked.averaged(ripple.duration(), member[left] + share * (member[left + 1] - member[left]))


@claim(
    "after (2.6): neighbourhood",
    "every root of (2.6) without the errors has a root of (2.2) in its ε-neighbourhood; for this "
    "(2.7) and (2.8) suffice",
    verdict="conditional",
    remark="True where h* takes both signs over a turn of the phase, as it does near a root of (2.7) if h* "
    "depends on the phase at all. If it does not, (2.7) and (2.8) do not suffice: v' = εu, s' = ε, ω "
    "= 1, b' = ε(k(s) − ε + u²) has a double root at ε = 0, and no root near it for ε > 0.",
)
def neighbourhood() -> Evidence:
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


@claim.proof(
    "(2.7)",
    "the roots lie around the root of ⟨h*⟩ = 0",
    display=r"\langle h_0(\xi(\tau_1, \tau_1), \eta(\tau_1, \tau_1)) \rangle = 0",
)
def mean_condition() -> Steps:
    level = averaged.averaged_hamiltonian()
    yield "h0 = −ωκ at the end, so (2.7) is κ = 0", sp.solve(level.subs(h0, 0), kappa) == [0]
    T = ripple.of_kappa(ripple.duration()).subs({ripple.rise: 1, smooth.kappa: 0})
    yield "smooth example: τ1* = (v1 − v0)/√k", vanishes(T - (smooth.v1 - smooth.v0) / sp.sqrt(smooth.k))
    low, high = worked.window()
    yield f"rippled: the window from κ = {low:.3f} to {high:.3f} has κ = 0 inside", low < 0 < high


@claim(
    "(2.8)", "the phase at the end changes with τ1: derivative of ∫ω dτ with respect to τ1", verdict="holds"
)
def phase_runs() -> Evidence:
    end, time = sp.symbols("tau_1 tau", positive=True)
    w, path = sp.Function("omega"), sp.Function("xi")(time, end)
    named = sp.Symbol("omega'")

    def printed() -> sp.Expr:
        slope = sp.Derivative(w(path), path).doit()
        return w(path).subs(time, end) + sp.Integral(slope * path.diff(end), (time, 0, end))

    return Equality(
        {r"\frac{d}{d\tau_1}\int_0^{\tau_1}\omega d\tau": printed()},
        lambda: sp.Integral(w(path), (time, 0, end)).diff(end),
        display=rf"\omega(\xi(\tau_1^*, \tau_1^*)) + \int_0^{{\tau_1^*}} {named}(\xi(\tau, \tau_1^*))"
        r"\frac{\partial \xi(\tau, \tau_1^*)}{\partial \tau_1^*}d\tau \ne 0",
    )


@claim.proof(
    "(2.9)",
    "to the first order τ1 may be taken from an interval, and the optimal τ1 is the one for which "
    "J0(τ1) is least",
    remark="True where h* takes both signs over a turn. The exact optimal τ1 differs by O(ε), with a factor "
    "that jumps from one ε to another as the best root changes.",
    display=r"J_0 = g_0(\xi(\tau_1, \tau_1)) \to \min_{\tau_1}",
)
def interval() -> Steps:
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
