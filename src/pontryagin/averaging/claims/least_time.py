"""Section 3, example 1 continued: least time of the rotor, with and without a mean force."""

import sympy as sp

from pontryagin.averaging.claims.rotor import TURN
from pontryagin.averaging.derivation import rotor
from pontryagin.averaging.derivation.rotor import FORCE, MASS, a, epsilon, u, v, x
from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Consequence,
    Equality,
    Evidence,
    Misprint,
    Proof,
    RightSides,
    Slip,
    Steps,
    vanishes,
)

claim = Page("Akulenko 1977")

R = sp.Rational
a0, a1, xi, u0, mu, y = sp.symbols("a_0 a_1 xi u_0 mu y", positive=True)
tau, sense = sp.symbols("tau s", real=True)
force = sp.Symbol("f_0", real=True)

FREE = {"mass": sp.S.One, "potential": sp.S.Zero}
"""The rotor without mass variation or potential: a = v^2/2."""

OMEGA, BY_ANGLE = sp.symbols("omega fbar", real=True)
BY_PHASE = sp.Symbol(r"\langle{f}\rangle", real=True)
"""Symbol for the mean of f over the phase; `OMEGA` is omega(xi), `BY_ANGLE` the mean over the angle."""

UNEVEN = sp.Function("r", positive=True)(x)
"""Square root of a mass that varies with the angle, 1 + cos(x)/2 in the example below."""

TILTED = sp.cos(x) - R(1, 4)
"""A force whose mean over the phase is 0 for the mass (1 + cos(x)/2)^2, and over the angle -1/4."""


def named(quantity: sp.Expr) -> sp.Expr:
    """A quantity with its integrals over a turn replaced by `OMEGA`, `BY_PHASE` and `BY_ANGLE`."""
    turns = {
        rotor.over_a_turn(1 / rotor.speed()): 2 * sp.pi / OMEGA,
        rotor.mean(FORCE) * 2 * sp.pi / rotor.frequency(): 2 * sp.pi * BY_PHASE / OMEGA,
        rotor.over_a_turn(FORCE.subs(v, rotor.speed())): 2 * sp.pi * BY_ANGLE,
    }
    return sp.expand(quantity.subs(turns))


@claim(
    "example 1: mean force",
    "the case without mean force is that of ⟨f⟩ = 0 over a turn",
    verdict="conditional",
    remark="True of the mean over the angle x, ⟨x'f⟩/ω. If the mean over the phase (over time) is meant, as "
    "⟨ ⟩ is in section 2, the condition is not the right one: for m = (1 + ½cos x)², V = 0, f = cos x "
    "− ¼ that mean is 0, but the averaged rate is ω(u − ¼).",
)
def mean_of_the_force() -> Evidence:
    def argument() -> Steps:
        yield (
            "dξ/dτ = ω(u + mean of f over the angle)",
            vanishes(named(rotor.averaged_rate()) - OMEGA * (u + BY_ANGLE)),
        )

    def counterexample() -> Steps:
        def value(quantity: sp.Expr) -> sp.Expr:
            return sp.simplify(quantity.subs(UNEVEN, 1 + sp.cos(x) / 2).doit())

        ends = (UNEVEN**2, sp.S.Zero)
        yield "for √m = 1 + ½cos x: ω = √(2a)", vanishes(value(rotor.frequency(*ends)) - sp.sqrt(2 * a))
        yield "f = cos x − ¼ has the mean 0 over the phase", value(rotor.mean(TILTED, *ends)) == 0
        yield "and −¼ over the angle", value(rotor.mean_over_angle(TILTED, *ends)) == -R(1, 4)
        rate = value(rotor.averaged_rate(*ends, TILTED, u))
        yield "dξ/dτ = √(2ξ)(u − ¼)", vanishes(rate - sp.sqrt(2 * a) * (u - R(1, 4)))

    return Conditional(argument, counterexample=counterexample, display=r"\langle f(\xi)\rangle \equiv 0")


@claim(
    "example 1: solution",
    "without mean force: u* = u₀sign(a₁ − a₀), u₀τ sign(a₁ − a₀) = ∫dξ/ω, ω = ⟨x'⟩; this solution is "
    "the only one",
    verdict="holds",
    remark="ξ and u do not depend on κ, so that (2.13) and (2.15) say nothing here: ∫ω dτ is the same for "
    "all κ. When the energy is raised, full thrust is exactly optimal for every ε. When it is "
    "lowered, the exact optimum may start with an arc of acceleration over an angle of order 1 (its "
    "costate passes through 0 once, from above): this changes τ₁ by order ε.",
)
def least_time_without_mean_force() -> Evidence:
    keys = (r"u_0\tau\,\mathrm{sign}(a_1 - a_0)", r"\langle x'\rangle")

    def derived() -> RightSides:
        rate = rotor.averaged_rate(force=sp.S.Zero, control=sense * u0)
        integrand = sp.cancel(sense * u0 / rate).subs(a, y)
        return sp.Integral(integrand, (y, a0, xi)), rotor.mean(v)

    def argument() -> Steps:
        eta = sp.Symbol("eta", real=True, nonzero=True)
        omega = sp.Function("omega", positive=True)(xi)
        h0 = omega * u0 * sp.Abs(eta) - 1
        held = sp.solve(h0.subs(sp.Abs(eta), mu), mu)[0]
        yield "h0 = u₀ω|η| − 1 = 0 leaves |η| = 1/(u₀ω)", vanishes(held - 1 / (u0 * omega))
        moved = (omega * sp.Symbol("kappa") + h0).diff(eta)
        yield "dξ/dτ = u₀ω sign η, whatever κ is", vanishes(moved - u0 * omega * sp.sign(eta))
        share = sp.Symbol("u/u_0", real=True)
        slack = sp.expand((omega * u0 - omega * u0 * share).subs(share, 1 - mu))
        yield "any smaller |u| moves ξ slower: no other control is as fast", slack.is_positive
        yield "exactly: da/dx = ε(u + f), largest for u = u₀", rotor.rate_by_angle().diff(u) == epsilon
        faster = rotor.speed().diff(a)
        yield (
            "and x' grows with a, so that the larger a gains time",
            vanishes(faster * MASS * rotor.speed() - 1),
        )
        costate = rotor.costate_rate(force=sp.Function("f", real=True)(x))
        yield (
            "p' < 0 on exact extremals (f of x alone): one switch at most, from + to −",
            vanishes(costate + epsilon / (MASS * v**2)),
        )
        yield "τ = 0 at ξ = a₀", printed[0].subs(xi, a0).doit() == 0

    printed = (sp.Integral((1 / TURN).subs(a, y), (y, a0, xi)), TURN)
    return Proof(
        argument,
        Equality(dict(zip(keys, printed, strict=True)), derived),
        display=r"u^* = u_0\,\mathrm{sign}(a_1 - a_0),\quad u_0\tau\,\mathrm{sign}(a_1 - a_0) = "
        r"\int_{a_0}^{\xi}\frac{d\xi'}{\omega(\xi')},\quad \omega(\xi) = \langle x'(\xi)\rangle,\quad "
        r"\tau_1 = \tau(a_1, a_0)",
    )


@claim(
    "example 1: special case",
    "if ψ' = const, √ξ is a linear function of τ from √a₀ to √a₁",
    verdict="misprint",
    remark="Printed: ψ' = const. Meant: V = const, taken as 0: then ω = √(2a)/⟨√m⟩, d√ξ/dτ = ±u₀*, with u₀* "
    "= u₀/(√2⟨√m⟩), a symbol that the paper does not explain. A rotor's frequency always grows with "
    "its energy, so ψ' = const does not happen; if ω were constant, ξ itself would be linear in τ. If "
    "the constant V is not 0, ξ − V takes the place of ξ.",
)
def square_root_of_the_energy() -> Evidence:
    rate = sp.Symbol("u_0*", positive=True)
    keys = (r"\xi^{1/2}", r"\tau_1")
    end = sp.Symbol("tau_1", positive=True)
    printed = (
        sp.sqrt(a0) + (sp.sqrt(a1) - sp.sqrt(a0)) * tau / end,
        sp.Abs(sp.sqrt(a1) - sp.sqrt(a0)) / rate,
    )

    def derived() -> RightSides:
        speed = sp.Symbol("C", real=True)
        line = sp.sqrt(a0) + sp.integrate(speed, (tau, 0, tau))
        met = sp.solve(line.subs(tau, end) - sp.sqrt(a1), speed)[0]
        return line.subs(speed, met), sp.Abs(met) * end / rate

    def argument() -> Steps:
        uneven = (UNEVEN**2, sp.S.Zero)
        mean_root = rotor.over_a_turn(UNEVEN) / (2 * sp.pi)
        omega = rotor.frequency(*uneven)
        yield "V = 0: ω = √(2a)/⟨√m⟩", vanishes(omega - sp.sqrt(2 * a) / mean_root)
        slope = rotor.averaged_rate(*uneven, sp.S.Zero, u0) / (2 * sp.sqrt(a))
        yield "d√ξ/dτ = u₀/(√2⟨√m⟩), a constant", vanishes(slope - u0 / (sp.sqrt(2) * mean_root))

    def counterexample() -> Steps:
        cube = sp.Integral(1 / (MASS * rotor.speed() ** 3), (x, 0, 2 * sp.pi))
        yield "2π/ω falls with a, by ∮dx/(mx'³): ψ' = ω is no constant", vanishes(rotor.period_slope() - cube)
        linear = a0 + (a1 - a0) * tau / end
        yield "and for a constant ω, ξ is linear", linear.diff(tau, 2) == 0
        numbers = {a0: 1, a1: 4, tau: end / 2}
        yield (
            "half-way from 1 to 4 that is 5/2; the printed ξ is 9/4",
            linear.subs(numbers) == R(5, 2) and sp.expand(printed[0].subs(numbers) ** 2) == R(9, 4),
        )

    return Slip(
        argument,
        Equality(dict(zip(keys, printed, strict=True)), derived),
        counterexample=counterexample,
        display=r"\dot\psi = \mathrm{const}:\quad \xi^{1/2} = a_0^{1/2} + (a_1^{1/2} - a_0^{1/2})\tau"
        r"\tau_1^{-1},\quad \tau_1 = |a_1^{1/2} - a_0^{1/2}|u_0^{*-1}",
    )


@claim(
    "example 1: with mean force",
    "with a mean force: dξ/dτ = u₀ω sign(a₁ − a₀) + ⟨f⟩",
    verdict="misprint",
    remark="Printed: ⟨f⟩. Right: ⟨x'f⟩, which is ω times the mean of f over the angle: the power of the "
    "force, not the force. The print is wrong with either reading of ⟨f⟩, as a constant force shows: "
    "v' = ε(u + f₀) with u₀ = 1, f₀ = ½ takes v from 1 to 2 in τ₁ = 2/3; by the print τ₁ is 1 − "
    "½ln(5/3) = 0.745. For f₀ = −1, u₀ = ½ the print would let the energy rise above ξ = 2, where no "
    "control can raise it. The remark that a solution need not exist is not affected.",
)
def least_time_with_mean_force() -> Evidence:
    key = r"d\xi/d\tau"

    def consequence() -> Consequence:
        omega = rotor.frequency(**FREE).subs(a, v**2 / 2)
        best = rotor.averaged_rate(**FREE, force=force, control=u0).subs(a, v**2 / 2)
        wrong = u0 * omega + force
        numbers = {u0: 1, force: R(1, 2)}
        times = [sp.integrate(sp.cancel((v / rate).subs(numbers)), (v, 1, 2)) for rate in (wrong, best)]
        return Consequence("τ₁ for m = 1, V = 0, f = ½, u₀ = 1 and v from 1 to 2", *times)

    return Misprint(
        {key: u0 * OMEGA * sense + BY_PHASE},
        lambda: named(rotor.averaged_rate(control=u0 * sense)),
        defect={key: BY_PHASE - OMEGA * BY_ANGLE},
        consequence=consequence,
        display=r"d\xi/d\tau = u_0\omega(\xi)\,\mathrm{sign}(a_1 - a_0) + \langle f(\xi)\rangle,\quad "
        r"\xi(0) = a_0,\quad \xi(\tau_1) = a_1",
    )


@claim.proof(
    "example 1: existence",
    "this problem does not always have a solution",
    remark="There is a solution exactly where u₀ + s f̄(ξ) > 0 for all ξ from a₀ to a₁, with f̄ the mean of "
    "f over the angle and s = sign(a₁ − a₀).",
)
def no_solution_against_a_strong_force() -> Steps:
    best = rotor.averaged_rate(**FREE, force=-sp.S.One, control=R(1, 2))
    yield (
        "f = −1, u₀ = ½, m = 1, V = 0: at full thrust dξ/dτ = −√(2ξ)/2 < 0",
        vanishes(best + sp.sqrt(2 * a) / 2) and best.is_negative,
    )
    exact = rotor.rate_by_angle(force=-sp.S.One, control=R(1, 2)) / epsilon
    yield "so does the exact energy: da/dx = −ε/2 at best; no a₁ > a₀ is reached", exact == -R(1, 2)
    printed = sp.sqrt(2 * a) / 2 - 1
    yield "where the printed equation lets ξ rise: by √16/2 − 1 = 1 at ξ = 8", printed.subs(a, 8) == 1
    speeding = sp.factor(rotor.averaged_rate(**FREE, force=-v / 3, control=sp.S.One).subs(a, v**2 / 2) / v)
    yield "friction f = −v/3, u₀ = 1: dv/dτ = 1 − v/3", vanishes(speeding - (1 - v / 3))
    turned = speeding.subs(v, 3 + mu)
    yield "negative above v = 3: no v₁ > 3 is reached from below", turned.is_negative
    rate = named(rotor.averaged_rate(control=u0 * sense))
    yield "in general dξ/dτ = ω(u₀s + f̄)", vanishes(rate - OMEGA * (u0 * sense + BY_ANGLE))
