"""Section 4, (4.7) to (4.10): pulses, impulses and their amplitudes."""

from typing import Any

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Consequence,
    Equality,
    Evidence,
    LinearSystem,
    Misprint,
    RightSides,
    Sides,
    Steps,
    vanishes,
)
from pontryagin.triple_integrator.claims.chebyshev import F
from pontryagin.triple_integrator.claims.cramer import ROOM, element, room
from pontryagin.triple_integrator.derivation import channel, chebyshev
from pontryagin.triple_integrator.derivation.channel import drive, kick, required_moments, tau
from pontryagin.triple_integrator.derivation.chebyshev import impulses_for, sign, three_impulses
from pontryagin.triple_integrator.derivation.duality import dual_function_of
from pontryagin.triple_integrator.derivation.model import T, c, s

claim = Page("Gorelov & Morozova 2012")

R = sp.Rational
c1, c2, c3 = c
x10, x20, x30 = channel.initial
a0, am, aT = chebyshev.impulses
width0, widthT, widthm = sp.symbols("epsilon_0 epsilon_T epsilon_m", positive=True)


@claim(
    "(4.7)",
    "max ∫h0 u = 1 over u in L_1 with ∫|u| = 1/ρ0",
    verdict="conditional",
    remark="True as a supremum, and as a maximum for impulses. No integrable u attains it: |h0| = ρ0 at "
    "three instants only.",
)
def conditions_on_the_optimum() -> Evidence:
    def argument() -> Steps:
        moments = dict(zip(c, three_impulses((a0, -am, aT), T), strict=True))
        values = [element().subs(tau, at).subs(moments) for at in (0, T / 2, T)]
        paired = a0 * values[0] - am * values[1] + aT * values[2]
        yield "impulses a0, −am, aT at 0, T/2, T have ∫ h0 u = 1", vanishes(paired - 1)
        yield (
            "|h0| there is 1/(a0 + am + aT), so that positive ones have the norm 1/ρ0",
            vanishes(values[0] * (a0 + am + aT) - 1),
        )
        width = sp.Symbol("epsilon", positive=True)
        pulse = sp.integrate(sp.expand(element()), (tau, 0, width)) / width
        yield (
            "a pulse of weight 1 on [0, ε] has ∫ h0 u → ρ~0 as ε → 0",
            vanishes(sp.limit(sp.cancel(pulse), width, 0) - T**2 / F),
        )

    def counterexample() -> Steps:
        yield "ρ0² − h0² = 16τ(T − τ)(T − 2τ)²/F² is positive except at 0, T/2, T", vanishes(room() - ROOM)
        h = dual_function_of(sp.Matrix([1, -R(1, 2), R(1, 16)]))
        reached = 64 * (sp.integrate(h, (s, R(7, 8), 1)) + sp.integrate(h, (s, 0, R(1, 8))))
        yield (
            "so ∫ h0 u < 1 for every integrable u: 64 on [0, 1/8] and [7/8, 1] (unit turn) gives 13/24",
            (reached == R(13, 24)),
        )

    return Conditional(
        argument,
        counterexample=counterexample,
        display=r"\max_{u(\cdot)} \int_0^T h_0(\tau)u(\tau)\,d\tau = 1;\quad \int_0^T \left| u(\tau) "
        r"\right| d\tau "
        r"= \frac{1}{\rho_0}",
    )


@claim(
    "(4.8)",
    "pulses that approximate the impulses, and their intervals",
    verdict="misprint",
    remark="Printed: I_m = [−ε_m, +ε_m]. Right: [T/2 − ε_m, T/2 + ε_m], as the sign h0(T/2) in the same "
    "line and the middle impulse of (4.9) show. As printed, the middle pulse lies about τ = 0 and "
    "only half of it is applied: example 1 (γ = T = 1) would end at (0, 0, 4) instead of (1, 0, "
    "0).",
)
def approximating_pulses() -> Evidence:
    printed = {
        r"\inf I_m": -widthm,
        r"\sup I_m": widthm,
        r"\lvert\hat u\rvert_{I_0}": a0 / width0,
        r"\lvert\hat u\rvert_{I_f}": aT / widthT,
        r"\lvert\hat u\rvert_{I_m}": am / (2 * widthm),
    }

    def derived() -> RightSides:
        centre = sp.solve(element().diff(tau), tau)[0]
        heights = (a0 / width0, aT / widthT, am / ((centre + widthm) - (centre - widthm)))
        return centre - widthm, centre + widthm, *heights

    def consequence() -> Consequence:
        # In the limit of zero widths the impulses are 4 and half of -8 at the start, and 4 at the end.
        return Consequence(
            "state reached in the limit for the unit turn",
            three_impulses((sp.Integer(4) - 4, sp.S.Zero, sp.Integer(4))),
            three_impulses(impulses_for(sp.Matrix([1, 0, 0]))),
        )

    return Misprint(
        printed,
        derived,
        defect={r"\inf I_m": -T / 2, r"\sup I_m": -T / 2},
        consequence=consequence,
        display=r"\hat u_\varepsilon(\tau) = \frac{a_0}{\varepsilon_0}\operatorname{sign} h_0(0),\ \tau \in "
        r"[0, "
        r"\varepsilon_0];\quad \frac{a_T}{\varepsilon_T}\operatorname{sign} h_0(T),\ \tau \in [T - "
        r"\varepsilon_T, T];"
        r"\quad \frac{a_m}{2\varepsilon_m}\operatorname{sign} h_0(\tfrac12 T),\ \tau \in [-\varepsilon_m, "
        r"+\varepsilon_m];\quad 0\ \text{elsewhere}",
    )


@claim.proof(
    "after (4.8)",
    "impulses away from the extremes of h0 do not attain the maximum",
    remark="True for the h0 of (4.4). Where the minimal element is a constant, it is extreme at every "
    "instant.",
)
def only_at_the_extremes() -> Steps:
    yield "|h0| < ρ0 except at 0, T/2, T", vanishes(room() - ROOM)
    h = dual_function_of(sp.Matrix([16, -8, 1]) / 16)
    weight = h.subs(s, R(3, 4)) / h.subs(s, 1)
    yield "the same impulse at T/4 instead of 0 contributes less", abs(weight) < 1


@claim(
    "(4.9)",
    "the limit of the pulses: impulses s0 a0, −s0 am, s0 aT at 0, T/2, T",
    verdict="holds",
    remark="True if δ(τ + 0) and δ(τ − T − 0) are read as impulses wholly inside [0, T]; a shift by that "
    "sign would put them outside. (4.8) is taken with its middle pulse at T/2.",
)
def limit_of_the_pulses() -> Evidence:
    printed = three_impulses((sign * a0, -sign * am, sign * aT), T)

    def derived() -> RightSides:
        width = sp.Symbol("epsilon", positive=True)
        middle = chebyshev.spike(T / 2 - width, T / 2 + width, -sign * am)
        pulses = chebyshev.spike(sp.S.Zero, width, sign * a0) + middle
        pulses += chebyshev.spike(T - width, T, sign * aT)
        return [sp.limit(sp.expand(x), width, 0) for x in pulses]

    return Equality(
        dict(zip(("x_1(T)", "x_2(T)", "x_3(T)"), printed, strict=True)),
        derived,
        display=r"u_\delta(\tau) = s_0\left[a_0\delta(\tau + 0) - a_m\delta(\tau - \tfrac12 T) + "
        r"a_T\delta(\tau - T - 0)\right]",
    )


@claim.proof("after (4.9): L_1", "the impulsive control is not an element of L_1")
def impulses_are_not_integrable() -> Steps:
    width, bound = sp.symbols("epsilon U", positive=True)
    yield (
        "over [0, ε] an impulse adds a0 to x3, however small ε",
        vanishes(sp.limit(drive(kick(sp.zeros(3, 1), a0), width, sp.S.Zero)[2], width, 0) - a0),
    )
    grown = drive(sp.zeros(3, 1), width, bound)[2]
    yield "a bounded u at most U ε, and bounded u are dense in L_1", sp.limit(grown, width, 0) == 0


@claim("after (4.9): s0", "s0 = sign h0(0)", verdict="holds")
def sign_of_the_polynomial() -> Evidence:
    number = sp.Symbol("F", real=True, nonzero=True)

    def derived() -> RightSides:
        start = sp.cancel(element().subs(tau, 0) / T**2)
        return sp.sign(start.subs(c1, (number + 8 * T * c2 - T**2 * c3) / 16).simplify())

    # rho~0 = s0 rho0 = T^2/F with rho0 > 0, so that s0 = sign F.
    return Equality({"s_0": sp.sign(1 / number)}, derived, display=r"s_0 = \operatorname{sign} h_0(0)")


@claim("before (4.10): states", "the end state under the three impulses, f = 0", verdict="holds")
def end_state_under_impulses() -> Evidence:
    printed = {
        "x_{3f}": x30 + sign * (a0 - am + aT),
        "x_{2f}": x20 + (x30 + sign * a0) * T - sign * am * T / 2,
        "x_{1f}": x10 + x20 * T + (x30 + sign * a0) * T**2 / 2 - sign * am * T**2 / 8,
    }

    def derived() -> Sides:
        first, second, third = chebyshev.impulse_transfer()
        return {"x_{3f}": third, "x_{2f}": second, "x_{1f}": first}

    return Equality(
        printed,
        derived,
        display=r"x_{3f} = x_{30} + s_0[a_0 - a_m + a_T];\quad x_{2f} = x_{20} + (x_{30} + s_0a_0)T - "
        r"\tfrac12s_0a_mT;\quad "
        r"x_{1f} = x_{10} + x_{20}T + \tfrac12(x_{30} + s_0a_0)T^2 - \tfrac18s_0a_mT^2",
    )


@claim.proof("before (4.10): disturbance", "with f ≠ 0 the same holds with c corrected by (1.10)")
def with_a_disturbance() -> Steps:
    force = sp.symbols("f_0", real=True) * (1 + tau)
    start, impulses = channel.initial, (sign * a0, -sign * am, sign * aT)
    later = force.subs(tau, tau + T / 2)
    state = drive(kick(start, impulses[0]), T / 2, sp.S.Zero, force)
    end = kick(drive(kick(state, impulses[1]), T / 2, sp.S.Zero, later), impulses[2])
    needed = required_moments(force).subs(dict(zip(channel.final, end, strict=True)))
    yield (
        "the impulses have the moments c of (1.10), f included",
        vanishes(needed - three_impulses(impulses, T)),
    )


@claim("before (4.10): system", "linear system for a0, am, aT with c~ = s0 c", verdict="holds")
def system_for_the_impulses() -> Evidence:
    wanted = sp.symbols(r"\tilde{c}_1:4", real=True)
    printed = [
        a0 * T**2 / 2 - am * T**2 / 8 - wanted[0],
        a0 * T - am * T / 2 - wanted[1],
        a0 - am + aT - wanted[2],
    ]

    def derived() -> list[Any]:
        reached = three_impulses((a0, -am, aT), T)
        return [x - w for x, w in zip(reached, wanted, strict=True)]

    return LinearSystem(
        printed,
        derived,
        [a0, aT, am],
        display=r"\tfrac12a_0T^2 - \tfrac18a_mT^2 = \tilde c_1;\quad a_0T - \tfrac12a_mT = \tilde c_2;\quad "
        r"a_0 - a_m + a_T = \tilde c_3",
    )


@claim(
    "(4.10)",
    "the impulses a0, am, aT",
    verdict="holds",
    remark="They reach the target for every c; where one of them is negative they are not optimal.",
)
def impulses() -> Evidence:
    printed = {
        "a_0": sign * (4 * c1 - T * c2) / T**2,
        "a_m": sign * (8 * c1 - 4 * T * c2) / T**2,
        "a_T": sign * (4 * c1 - 3 * T * c2 + T**2 * c3) / T**2,
    }

    def derived() -> Sides:
        found = chebyshev.amplitudes()
        return {"a_0": found[a0], "a_m": found[am], "a_T": found[aT]}

    return Equality(
        printed,
        derived,
        display=r"a_0 = s_0\frac{4c_1 - Tc_2}{T^2};\quad a_m = s_0\frac{8c_1 - 4Tc_2}{T^2};\quad "
        r"a_T = s_0\frac{4c_1 - 3Tc_2 + T^2c_3}{T^2}",
    )
