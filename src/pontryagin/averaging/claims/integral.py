"""Section 2, (2.10) to (2.13): the first integral, and kappa as the parameter of the family."""

import numpy as np
import sympy as sp

from pontryagin.arrays import Array
from pontryagin.averaging.claims import instances, worked
from pontryagin.averaging.derivation import averaged, ripple, rotor, smooth
from pontryagin.averaging.derivation.averaged import eta, h0, kappa, omega, xi
from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Equality,
    Evidence,
    Proof,
    Steps,
    vanishes,
)

claim = Page("Akulenko 1977")

R = sp.Rational


@claim(
    "(2.10)",
    "κ = −(ηf0)/ω is constant along (2.3)",
    verdict="holds",
    remark="This holds with (2.3) as corrected.",
)
def integral() -> Evidence:
    def argument() -> Steps:
        yield "its rate along (2.3) is 0", averaged.along(averaged.integral(), averaged.standard_rates()) == 0

    return Proof(
        argument,
        Equality({r"\kappa": -h0 / omega}, averaged.integral),
        display=r"\kappa = -(\eta f_0(\xi, \eta))\omega^{-1}(\xi)",
    )


@claim.proof(
    "after (2.10): identity",
    "∂(ηf0)/∂η = f0, which makes dκ/dτ = 0",
    remark="f0 itself depends on η; the identity is that of the envelope, or Euler's for functions of degree "
    "one.",
    display=r"\partial(\eta f_0)/\partial\eta = f_0",
)
def envelope() -> Steps:
    product = sum(y * h0.diff(y) for y in eta)
    for i, y in enumerate(eta):
        rest = averaged.homogeneous(product.diff(y) - h0.diff(y))
        yield f"∂(ηf0)/∂η{i + 1} − f0 = (η∂f0/∂η{i + 1}) = 0", rest == 0


@claim.proof(
    "after (2.10): mean of q", "the mean of q is εκ, constant up to O(ε²) over times of the order of 1/ε"
)
def mean_of_q() -> Steps:
    for eps in worked.EPSILONS:
        means = turn_means(eps)
        spread = float(np.ptp(means))
        member = float(worked.kappa_of(worked.optimum(eps)["tau"][-1]))
        off = float(np.abs(means - member).max())
        yield (
            f"rippled example, ε = {eps}: over {means.size} turns the mean of q/ε stays within "
            f"{spread / eps:.2f}ε, and is κ up to {off / eps:.2f}ε",
            spread < eps and off < 1.5 * eps,
        )


def turn_means(eps: float) -> Array:
    """Time means of q/epsilon = -h*/v over the whole turns of the optimal motion."""
    motion = worked.optimum(eps)
    rate = -worked.level(motion["x"], motion["p"]) / motion["v"]
    steps = np.diff(motion["tau"])
    total = np.concatenate([[0.0], np.cumsum((rate[1:] + rate[:-1]) / 2 * steps)])
    turns = 2 * np.pi * np.arange(int(motion["x"][-1] // (2 * np.pi)) + 1)
    work, time = (np.interp(turns, motion["x"], values) for values in (total, motion["tau"]))
    return np.asarray(np.diff(work) / np.diff(time))


@claim("(2.11)", "averaged system with κ as a parameter", verdict="holds")
def with_kappa() -> Evidence:
    forward, backward = r"\frac{d\xi_1}{d\tau}", r"\frac{d\eta_1}{d\tau}"
    return Equality(
        {forward: h0.diff(eta[0]), backward: -omega.diff(xi[0]) * kappa - h0.diff(xi[0])},
        lambda: {forward: averaged.rates()[0][0], backward: averaged.rates()[1][0]},
        display=r"\frac{d\xi}{d\tau} = f_0(\xi, \eta),\quad \frac{d\eta}{d\tau} = -\omega'(\xi)\kappa - "
        r"\frac{\partial}{\partial\xi}(\eta f_0)",
    )


@claim.proof("after (2.10): equivalent", "(2.3) is equivalent to (2.11) with (2.12)")
def equivalent() -> Steps:
    backward = averaged.rates()[1].subs(kappa, averaged.integral())
    yield "(2.11) with κ from (2.10) is (2.3)", vanishes(backward - averaged.standard_rates()[1])
    level = averaged.averaged_hamiltonian()
    yield "ωκ + (ηf0) is constant along (2.11)", averaged.along(level, averaged.rates()) == 0
    yield (
        "so (2.12), its value 0 at the end, is (2.10) all along",
        vanishes(sp.solve(level, kappa)[0] - averaged.integral()),
    )


@claim("(2.12)", "the condition ωκ + (ηf0) = 0 at τ1 relates κ to τ1", verdict="holds")
def end_level() -> Evidence:
    rising = {ripple.rise: 1}

    def argument() -> Steps:
        xi_of, eta_of = smooth.averaged_solution()
        level = smooth.v1 * kappa + smooth.averaged_hamiltonian().subs(
            smooth.eta, eta_of.subs(smooth.tau, smooth.T)
        )
        length = ripple.of_kappa(ripple.duration()).subs(rising)
        numbers = {smooth.gap: -1, smooth.v0: 1, smooth.v1: 2, smooth.k: 1, smooth.v1: 2}
        tried = level.subs(smooth.T, length).subs(numbers).subs(kappa, R(7, 32))
        yield (
            "smooth example, v from 1 to 2, κ = 7/32: the level at τ1(κ) is 0",
            vanishes(sp.nsimplify(tried)),
        )
        start = xi_of.subs(smooth.tau, 0).subs(numbers)
        yield "and the motion starts at v = 1", vanishes(start - 1)

    closed = 2 * (smooth.v1 - smooth.v0) / (ripple.A0 + ripple.A1)
    return Proof(
        argument,
        Equality({r"\tau_1(\kappa)": closed}, lambda: ripple.duration().subs(rising)),
        display=r"[\omega(\xi)\kappa + (\eta f_0(\xi, \eta))]_{\tau_1} = 0",
    )


@claim(
    "(2.13)",
    "where dΨ/dκ ≠ 0, Ψ = ∫ω dτ, an ε-neighbourhood of every κ about 0 has a root of (2.2)",
    verdict="conditional",
    remark="True where h* depends on the phase, in the window between κ' and κ''. The smooth example has "
    "dΨ/dκ > 0 and one root only. In the paper's example 1, least time, (2.13) itself fails: the "
    "motion does not depend on κ, Ψ = (a1 − a0)/u0, and κ cannot serve as a parameter.",
)
def roots_near_every_kappa() -> Evidence:
    def argument() -> Steps:
        Psi = ripple.of_kappa(ripple.turned()).subs(worked.NUMBERS)
        low, high = worked.window()
        slopes = [float(Psi.diff(kappa).subs(kappa, value)) for value in np.linspace(low, high, 5)]
        yield (
            "rippled example: dΨ/dκ from " + " to ".join(f"{s:.2f}" for s in slopes[:: len(slopes) - 1]),
            (min(slopes) > 0.3),
        )
        for eps in worked.EPSILONS:
            found = np.sort(worked.kappa_of(worked.roots(eps).duration))
            gaps = np.diff(np.concatenate([[low], found, [high]]))
            yield (
                f"ε = {eps}: every κ from {low:.2f} to {high:.2f} has a root within {gaps.max() / eps:.1f}ε",
                (gaps.max() < 16 * eps),
            )

    def counterexample() -> Steps:
        Psi = ripple.of_kappa(ripple.turned()).subs({**worked.NUMBERS, ripple.rise: 1})
        slope = sp.simplify(Psi.diff(kappa)).subs(kappa, R(7, 32))
        yield f"smooth example at κ = 7/32: dΨ/dκ = {sp.N(slope, 4)}", slope.is_positive
        flat = (
            smooth.maximum().subs(smooth.eta, ripple.costate().subs(ripple.rise, 1)).subs(smooth.v, smooth.v1)
        )
        left = sp.simplify(flat).subs({kappa: R(7, 32), smooth.v1: 2})
        yield f"but h* at the end is {left} for every ε, and 0 at κ = 0 alone", left == R(-7, 16)
        turned = sp.integrate(1, (rotor.a, instances.a0, instances.a1))
        yield (
            "rotor, least time, dξ/dτ = ω: Ψ = ∫ω dτ = ∫dξ = a1 − a0, dΨ/dκ = 0",
            (turned == instances.a1 - instances.a0 and turned.diff(kappa) == 0),
        )

    return Conditional(
        argument,
        counterexample=counterexample,
        display=r"\frac{d}{d\kappa}\int_0^{\tau_1(\kappa)} \omega(\xi(\tau, \tau_1(\kappa), \kappa))d\tau "
        r"\ne 0",
    )


@claim(
    "after (2.13): minimisation",
    "to minimise J0 over τ1 is to minimise it over κ with (2.12)",
    verdict="conditional",
    remark="True where τ1(κ) is a single-valued function. (2.12) can have several branches with a root κ = 0 "
    "on each: the system v' = εu, s' = ε, ω = 1, b' = ε(k(s) + u²) with κ(τ1) = (τ1 − 1)(τ1 − 2)(τ1 − "
    "3)(6 + 11τ1)/(36τ1²) has three such roots.",
)
def over_kappa() -> Evidence:
    def argument() -> Steps:
        rising = {ripple.rise: 1}
        T = ripple.of_kappa(ripple.duration()).subs(rising)
        slope = T.diff(kappa).subs({smooth.v0: 1, smooth.v1: 2, smooth.k: 1})
        yield "smooth example: dτ1/dκ > 0, at κ = 0 it is 3/4", vanishes(slope.subs(kappa, 0) - R(3, 4))
        J, Psi = (ripple.of_kappa(form()).subs(rising) for form in (ripple.cost, ripple.turned))
        numbers = {smooth.v0: 1, smooth.v1: 2, smooth.k: 1}
        yield (
            "and dJ0/dτ1 = κ(dΨ/dκ)/(dτ1/dκ) is 0 where dJ0/dκ is",
            vanishes(sp.simplify((J.diff(kappa) - kappa * Psi.diff(kappa)).subs(numbers))),
        )

    def counterexample() -> Steps:
        clock = instances.Clock(instances.THREE)
        end = instances.T
        zeros = sp.Poly(sp.numer(sp.together(clock.kappa)), end).real_roots()
        yield "κ = 0 at τ1 = 1, 2 and 3", [zero for zero in zeros if zero.is_positive] == [1, 2, 3]
        yield "and dJ/dτ1 = κ", vanishes(sp.simplify(clock.cost.diff(end) - clock.kappa))
        turning = sp.Poly(sp.numer(sp.together(clock.kappa.diff(end))), end)
        yield (
            "between them κ(τ1) turns: no function τ1(κ) goes from 1 to 3",
            (turning.count_roots(1, 2) == 1 and turning.count_roots(2, 3) == 1),
        )
        costs = [clock.cost.subs(end, value) for value in (1, 2, 3)]
        yield "J there is " + ", ".join(f"{sp.N(cost, 4)}" for cost in costs), len(set(costs)) == 3

    return Conditional(argument, counterexample=counterexample)
