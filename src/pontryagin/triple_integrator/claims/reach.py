"""Section 4 after (4.10), and the conclusion: where the three impulses are optimal and where not."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Equality,
    Evidence,
    Proof,
    Refutation,
    RightSides,
    Steps,
    vanishes,
)
from pontryagin.triple_integrator.claims.chebyshev import F
from pontryagin.triple_integrator.claims.turn import BANG_BANG, EXAMPLE_1, in_unit_time, turn
from pontryagin.triple_integrator.derivation import chebyshev
from pontryagin.triple_integrator.derivation.channel import drive
from pontryagin.triple_integrator.derivation.chebyshev import impulses_for, sign, three_impulses
from pontryagin.triple_integrator.derivation.duality import impulse_bound, piecewise_moments
from pontryagin.triple_integrator.derivation.model import T, c

claim = Page("Gorelov & Morozova 2012")

R = sp.Rational
c1, c2, c3 = c
a0, am, aT = chebyshev.impulses

PULSE = [(R(5, 8), 0), (R(1, 4), 4), (R(1, 8), 0)]
"""A control of one sign in unit time: 4 on [5/8, 7/8], else 0; its total impulse is 1."""


def pulse_certificate() -> Steps:
    """A control whose total impulse 1 is the least possible; the impulses (4.10) have the total 59/48."""
    moments = piecewise_moments(PULSE)
    yield (
        "u = 4 on [5/8, 7/8], T = 1, has c = (13/384, 1/4, 1)",
        moments == sp.Matrix([R(13, 384), R(1, 4), 1]),
    )
    yield "its total impulse is 1", sum(duration * abs(level) for duration, level in PULSE) == 1
    yield (
        "no total impulse is smaller: the bound by h = 1",
        impulse_bound(sp.Matrix([0, 0, 1]), moments, sp.S.One) == 1,
    )
    impulses = impulses_for(moments)
    yield "(4.10) reaches the same state", three_impulses(impulses) == moments
    yield "at the price 59/48", sum(abs(a) for a in impulses) == R(59, 48)


@claim(
    "after (4.10): sum",
    "the sum of the impulses is 1/ρ0, so ρ0 = T²/(s0 F)",
    verdict="conditional",
    remark="True where a0, am, aT ≥ 0. The moments of u = 4 on [5/8, 7/8], T = 1, have F = −11/24: the "
    "impulses of (4.10) cost 59/48, and the least cost is 1/ρ0 = 1. No control attains |F|/T² = "
    "11/24.",
)
def sum_of_the_impulses() -> Evidence:
    def argument() -> Steps:
        yield "a0 + am + aT = s0 F/T²", vanishes(chebyshev.total() - sign * F / T**2)
        bound = 1 / chebyshev.minimal_multipliers()[chebyshev.signed_norm]
        yield (
            "that is the bound by h0, and their cost where none is negative",
            vanishes(bound - F / T**2),
        )

    def counterexample() -> Steps:
        yield from pulse_certificate()
        moments = piecewise_moments(PULSE)
        claimed = abs(F.subs(in_unit_time(moments)))
        yield "|F|/T² = 11/24 is below both", claimed == R(11, 24)

    return Conditional(
        argument,
        Equality({r"\rho_0": T**2 / (sign * F)}, lambda: 1 / chebyshev.total()),
        counterexample=counterexample,
        display=r"\rho_0 = \frac{T^2}{s_0 F}",
    )


@claim(
    "after (4.10): sign",
    "the sign of F is the sign of the first impulse",
    verdict="conditional",
    remark="True where a0 > 0. For c = (0, 1, 20), T = 1, F = 12 > 0, but the first impulse of (4.10) is −1.",
)
def sign_of_the_first_impulse() -> Evidence:
    def argument() -> Steps:
        weight = sp.Symbol("a", positive=True)
        for s0 in (1, -1):
            yield f"the first impulse s0 a0 has the sign s0 = {s0} for a0 > 0", sp.sign(s0 * weight) == s0
        first = chebyshev.amplitudes()[a0]
        yield "a0 = s0 (4c1 − Tc2)/T²", vanishes(first - sign * (4 * c1 - T * c2) / T**2)

    def counterexample() -> Steps:
        moments = sp.Matrix([0, 1, 20])
        impulses = impulses_for(moments)
        yield "c = (0, 1, 20), T = 1: (4.10) gives −1, 4, 17", impulses == (-1, 4, 17)
        yield "those impulses reach the target", three_impulses(impulses) == moments
        yield "with F = 12 > 0", F.subs(in_unit_time(moments)) == 12

    return Conditional(argument, counterexample=counterexample)


@claim(
    "after (4.10): F = 0",
    "if F = 0, the free motion u = 0 meets the boundary conditions",
    verdict="false",
    remark="u = 0 does so only where c = 0. F = 0 is a plane of c on which the manoeuvre is no easier "
    "than elsewhere: for c = (1, 2, 0), T = 1, F is 0, but the free motion stays at 0 and every "
    "control costs at least 2. On this plane a0 + am + aT = 0, so the three cannot all be "
    "positive, and other families of impulses are optimal.",
)
def free_motion_where_f_is_zero() -> Evidence:
    def counterexample() -> Steps:
        target = sp.Matrix([1, 2, 0])
        yield "c = (1, 2, 0), T = 1: F = 0", F.subs(in_unit_time(target)) == 0
        free = drive(sp.zeros(3, 1), sp.S.One, sp.S.Zero)
        yield "from rest at 0 the free motion ends at 0, not at (1, 2, 0)", free == sp.zeros(3, 1) != target
        yield (
            "every control costs at least 2: h = s",
            impulse_bound(sp.Matrix([0, 1, 0]), target, sp.S.One) == 2,
        )
        yield "impulses 2 at 0 and −2 at T reach it", three_impulses((sp.S(2), sp.S.Zero, sp.S(-2))) == target

    return Refutation(counterexample, display=r"F = 0 \;\Rightarrow\; u(\tau) \equiv 0")


@claim(
    "after (4.10): solution",
    "this completes the solution of problem 3 for arbitrary ends",
    verdict="false",
    remark="The three impulses are optimal only where a0, am, aT ≥ 0. For the moments of u = 4 on [5/8, "
    "7/8], T = 1, they cost 59/48, while this u costs 1. The complete solution has three cases: in the "
    "moment cone any u ≥ 0 with these moments is optimal, on the Chebyshev cone impulses at 0, "
    "T/2 and T are, and for all other c two impulses, one of them at an end.",
)
def complete_solution() -> Evidence:
    return Refutation(pulse_certificate)


@claim(
    "end of section 4: R",
    "for the ends of example 1 the total impulse is R = 1/ρ0 = 16γ_T/T²",
    verdict="holds",
)
def impulse_of_the_turn() -> Evidence:
    turned = {**EXAMPLE_1, sign: 1}

    def argument() -> Steps:
        amplitudes = [chebyshev.amplitudes()[a].subs(turned) for a in (a0, am, aT)]
        yield "all three impulses are positive", all(value.is_positive for value in amplitudes)
        reached = three_impulses((amplitudes[0], -amplitudes[1], amplitudes[2]), T)
        yield "they make the turn", vanishes(reached - sp.Matrix([turn, 0, 0]))
        bound = impulse_bound(sp.Matrix([16, -8, 1]), sp.Matrix([1, 0, 0]), sp.S.One)
        yield "16 is a lower bound for γ = T = 1", bound == 16

    return Proof(
        argument,
        Equality(
            {"R": 16 * turn / T**2},
            lambda: sp.expand(sum(sp.Abs(value.subs(turned)) for value in chebyshev.amplitudes().values())),
        ),
    )


@claim(
    "end of section 4: half",
    "this is half of the total impulse of the programme of example 2",
    verdict="holds",
)
def half_of_example_2() -> Evidence:
    def derived() -> RightSides:
        bang_bang = sum(duration * abs(level) for duration, level in BANG_BANG)
        impulses = sum(abs(a) for a in impulses_for(sp.Matrix([1, 0, 0])))
        return impulses / bang_bang

    return Equality({"R_3/R_2": R(1, 2)}, derived)


@claim(
    "conclusion",
    "general solutions for arbitrary ends have been obtained for q = 1, 2 and ∞",
    verdict="false",
    remark="It is not true for q = 1: for the moments of u = 4 on [5/8, 7/8], T = 1, (4.10) costs 59/48, "
    "while this u costs 1. It is true for q = 2, with (2.3) corrected, and for q = ∞, as a structure "
    "and an equation to solve. For q = 1 the paper's solution is right only on the cone a0, am, "
    "aT ≥ 0.",
)
def general_solutions() -> Evidence:
    return Refutation(pulse_certificate)
