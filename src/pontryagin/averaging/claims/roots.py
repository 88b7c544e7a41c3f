"""Section 2 after (2.2): the number of roots, Figures 1 and 2, and the error of the method."""

import numpy as np
import sympy as sp

from pontryagin.averaging import smooth_example
from pontryagin.averaging.claims import instances, worked
from pontryagin.averaging.derivation import optimum, ripple, smooth
from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Evidence,
    Steps,
    vanishes,
)

claim = Page("Akulenko 1977")

R = sp.Rational
KAPPA = smooth.kappa


@claim(
    "after (2.2): number of roots",
    "for small ε the equation has many roots, of the order of 1/ε, since h* oscillates with t1",
    verdict="conditional",
    remark="True where h* depends on the phase: the number of roots is |Ψ(κ'') − Ψ(κ')|/(πε), where Ψ = ∫ω "
    "dτ, and κ' and κ'' are the ends of the range in which h* takes both signs over a turn. The "
    "paper's smooth example has one root for every ε, and so has the least time of its example 1.",
)
def number_of_roots() -> Evidence:
    def argument() -> Steps:
        for eps in worked.EPSILONS:
            found, expected = worked.roots(eps), worked.predicted_roots(eps)
            yield (
                f"rippled example, ε = {eps}: {len(found.cost)} roots, predicted {expected:.2f}, h* at most "
                f"{np.abs(found.level).max():.0e}",
                abs(len(found.cost) - expected) < 1 and np.abs(found.level).max() < worked.RESIDUAL,
            )
        many = smooth_example(worked.START, worked.END, ripple=worked.RIPPLE).exact(0.01, 0.0)
        left = max(float(one.certificate.residual) for one in many)
        yield (
            f"ε = 0.01: {len(many)} roots, predicted {worked.predicted_roots(0.01):.2f}, residuals at most "
            f"{left:.0e}",
            abs(len(many) - worked.predicted_roots(0.01)) < 2 and left < 1e-9,
        )
        shares = [len(worked.roots(eps).cost) * eps for eps in worked.EPSILONS]
        yield "ε times their number stays", max(shares) < 1.25 * min(shares)

    def counterexample() -> Steps:
        end = smooth.maximum().subs(smooth.eta, ripple.costate().subs(ripple.rise, 1))
        flat = sp.simplify(end.subs(smooth.v, smooth.v1))
        yield (
            "smooth example without ripple: h* at the end is −κv1 for every ε",
            vanishes(flat + KAPPA * smooth.v1),
        )
        yield "with the one root κ = 0", sp.solve(flat, KAPPA) == [0]
        level = sp.Symbol("p") * instances.uneven_speed() - 1
        yield (
            "rotor, least time: h* = px' − 1 is of degree 1 in p, 1 root",
            sp.degree(level, sp.Symbol("p")) == 1,
        )

    return Conditional(argument, counterexample=counterexample)


@claim.proof(
    "after (2.2): mean",
    "the mean of h* changes slowly with t1: d⟨h*⟩/dt1 ~ ε",
    display=r"d\langle h^* \rangle/dt_1 \sim \varepsilon",
)
def mean_is_slow() -> Steps:
    T = ripple.of_kappa(ripple.duration()).subs({**worked.NUMBERS, ripple.rise: 1})
    slope = sp.simplify((-2 / T.diff(KAPPA)).subs(KAPPA, 0))
    yield (
        "rippled example: ⟨h*⟩ = −κv1, and d⟨h*⟩/dτ1 = −8/3 at κ = 0, so by t1 it is −8ε/3",
        (slope == R(-8, 3)),
    )
    for eps in worked.EPSILONS[1:]:
        means = [(mean, kappa) for _, mean, _, kappa in turns(eps)]
        steps = np.abs(np.diff([mean for mean, _ in means]))
        yield (
            f"ε = {eps}: from turn to turn of the end's phase it changes by at most {steps.max() / eps:.1f}ε",
            bool(steps.max() < 40 * eps),
        )


@claim.proof(
    "Figure 1",
    "h* against τ1 oscillates about ⟨h*⟩, with an amplitude of the order of one and a frequency of 1/ε",
    remark="The paper names no system; the one used here is its smooth example with the ripple cos(x)/2 in "
    "the force, since without a ripple nothing oscillates.",
)
def first_figure() -> Steps:
    for eps in (0.05, 0.02):
        for turn, mean, amplitude, kappa in turns(eps):
            swing = float(worked.averaged(2 * ripple.A1 * ripple.c, kappa))
            yield (
                f"ε = {eps}, turn {turn} of the end's phase: mean {mean:.3f} and amplitude "
                f"{amplitude:.3f}; "
                f"−κv1 = {-kappa * worked.END:.3f}, cη1 = {swing:.3f}",
                abs(mean + kappa * worked.END) < 2 * eps and abs(amplitude - swing) < 2 * eps,
            )


def turns(eps: float) -> list[tuple[int, float, float, float]]:
    """(turn, mean, amplitude, kappa) of h* at the end, for each whole turn of the phase at the end."""
    scan = worked.in_window(eps)
    found = []
    for turn in range(int(scan.phase.min() // (2 * np.pi)) + 1, int(scan.phase.max() // (2 * np.pi))):
        inside = scan.phase // (2 * np.pi) == turn
        phase = scan.phase[inside]
        basis = np.stack([np.ones_like(phase), np.cos(phase), np.sin(phase)], axis=1)
        mean, even, odd = np.linalg.lstsq(basis, scan.level[inside], rcond=None)[0]
        kappa = worked.kappa_of(scan.duration[inside].mean())
        found.append((turn, float(mean), float(np.hypot(even, odd)), float(kappa)))
    return found


@claim.proof(
    "Figure 2",
    "J against τ1 has ripples on a curve with one minimum",
    remark="The system is the one used for Figure 1. The paper refers to section 3, example 1, which does "
    "not show this: J of the smooth example has no ripples. On H* = 0, dJ = q(t1)dψ(t1), so that J is "
    "stationary at every root of (2.2), and minima and maxima alternate.",
)
def second_figure() -> Steps:
    yield "d(p Da + q Dψ)/dt = 0 along extremals with H* = 0 and one start", optimum.exact_identity() == 0
    for eps in worked.EPSILONS:
        step = 1e-3 * eps
        near = worked.members([1.9 - step, 1.9, 1.9 + step], eps)
        slope = (near.cost[2] - near.cost[0]) / (near.phase[2] - near.phase[0])
        q1 = eps * near.phase_costate[1]
        yield f"ε = {eps}: dJ/dψ(t1) = {slope:.5f} = q(t1)", abs(slope - q1) < 1e-3 * eps
        rise = np.sign(np.diff(worked.roots(eps).cost))
        yield "J rises and falls in turn from root to root", bool(np.all(rise[1:] == -rise[:-1]))
        off = worked.deviations(eps)["cost"]
        yield f"and stays within {off / eps:.2f}ε of J0(τ1)", off < eps
    J = ripple.of_kappa(ripple.cost()).subs({**worked.NUMBERS, ripple.rise: 1})
    values = [float(J.subs(KAPPA, value)) for value in (-0.4, 0, 0.2)]
    yield (
        "J0 is least at κ = 0: 2, against " + ", ".join(f"{v:.3f}" for v in values[::2]),
        (values[1] == min(values)),
    )


@claim.proof(
    "after Figure 2: error",
    "the approach gives slow variables and cost with an error of the order ε",
    remark="The costates have such an error too where (2.13) holds; see (2.5).",
)
def errors() -> Steps:
    for eps in worked.EPSILONS:
        motion, found = worked.optimum(eps), worked.roots(eps)
        cost = abs(found.cost[worked.best(eps)] - 2)
        slow = np.abs(motion["v"] - (1 + motion["tau"])).max()
        yield (
            f"rippled example, ε = {eps}: J* − J0 = {cost / eps:.2f}ε in size, v − ξ at most "
            f"{slow / eps:.2f}ε",
            cost < eps and slow < 2.5 * eps,
        )
        best = found.cost[worked.best(eps)]
        yield "and no other root costs less", bool(best == found.cost.min())
