"""Example 1, (2.4) and (2.5): the least-energy turn from rest to rest."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Equality, Evidence, Proof, Steps, vanishes
from pontryagin.triple_integrator.claims.turn import EXAMPLE_1, turn
from pontryagin.triple_integrator.derivation import channel, energy
from pontryagin.triple_integrator.derivation.channel import tau
from pontryagin.triple_integrator.derivation.model import T, s

claim = Page("Gorelov & Morozova 2012")


@claim("(2.4)", "ends of example 1: a turn by γ_T from rest to rest, so c = (γ_T, 0, 0)", verdict="holds")
def ends_of_example_1() -> Evidence:
    ends = {
        **dict(zip(channel.initial, (0, 0, 0), strict=True)),
        **dict(zip(channel.final, (turn, 0, 0), strict=True)),
    }

    return Equality(
        {"c_1": turn, "c_2": sp.S.Zero, "c_3": sp.S.Zero},
        lambda: channel.required_moments().subs(ends),
        display=r"x_{10} = 0;\; x_{1f} = \gamma_T;\; x_{20} = x_{2f} = x_{30} = x_{3f} = 0 \;\Rightarrow\; "
        r"c_1 = \gamma_T;\; c_2 = 0;\; c_3 = 0",
    )


def programme_of_example_1() -> sp.Expr:
    """The derived programme of example 1 in the paper's time, t0 = 0."""
    return energy.minimum_energy_control().subs(EXAMPLE_1).subs(s, T - tau)


@claim("(2.5), first form", "programme of example 1 in powers of T − τ", verdict="holds")
def example_1_in_time_to_go() -> Evidence:
    lag = T - tau
    printed = 360 / T**5 * (lag**2 - lag * T + T**2 / 6) * turn
    return Equality(
        {r"\tilde u^*(\tau)": printed},
        programme_of_example_1,
        display=r"\tilde u^*(\tau) = \frac{360}{T^5}\left[(T - \tau)^2 - (T - \tau)T + "
        r"\tfrac16T^2\right]\gamma_T",
    )


@claim("(2.5)", "programme of example 1", verdict="holds")
def example_1_programme() -> Evidence:
    printed = 360 / T**5 * (tau**2 - T * tau + T**2 / 6) * turn
    return Equality(
        {r"\tilde u^*(\tau)": printed},
        programme_of_example_1,
        display=r"\tilde u^*(\tau) = \frac{360}{T^5}\left(\tau^2 - T\tau + \tfrac16T^2\right)\gamma_T",
    )


@claim("after (2.5): symmetry", "the programme of example 1 is symmetric about τ = T/2", verdict="holds")
def symmetry_of_example_1() -> Evidence:
    return Equality(
        {r"\tilde u^*(T - \tau)": programme_of_example_1()},
        lambda: programme_of_example_1().subs(tau, T - tau),
        display=r"\tilde u^*(T - \tau) = \tilde u^*(\tau)",
    )


@claim(
    "after (2.5): ends", "the maximum of the programme is 60γ_T/T³, its value at both ends", verdict="holds"
)
def end_values_of_example_1() -> Evidence:
    def argument() -> Steps:
        program = programme_of_example_1()
        inside = sp.factor(program.subs(tau, 0) - program)
        yield "u(0) − u(τ) = 360γ τ(T − τ)/T⁵ ≥ 0", vanishes(inside - 360 * turn * tau * (T - tau) / T**5)

    return Proof(
        argument,
        Equality(
            dict.fromkeys((r"\tilde u^*(0)", r"\tilde u^*(T)"), 60 * turn / T**3),
            lambda: [programme_of_example_1().subs(tau, end) for end in (0, T)],
        ),
    )


@claim("after (2.5): middle", "the minimum of the programme is −30γ_T/T³, its value at T/2", verdict="holds")
def middle_value_of_example_1() -> Evidence:
    def argument() -> Steps:
        program = programme_of_example_1()
        above = program - program.subs(tau, T / 2)
        yield (
            "u(τ) − u(T/2) = 360γ (τ − T/2)²/T⁵ ≥ 0",
            vanishes(above - 360 * turn * (tau - T / 2) ** 2 / T**5),
        )

    return Proof(
        argument,
        Equality({r"\tilde u^*(T/2)": -30 * turn / T**3}, lambda: programme_of_example_1().subs(tau, T / 2)),
    )
