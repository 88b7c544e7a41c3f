"""Section 1, the functional (7): its meaning, and when it has a minimum."""

import math

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Equality,
    RightSides,
    Slip,
    Steps,
    vanishes,
)
from pontryagin.rendezvous.claims import meetings, spirals
from pontryagin.rendezvous.derivation import model, principle, terminal
from pontryagin.rendezvous.derivation.model import anomaly, thrust, v1
from pontryagin.rendezvous.derivation.principle import energy_weight, time_weight

claim = Page("Pimkina & Chelnokov")

t, t_k, flow_rate, start_mass, exhaust, power = sp.symbols("t t_k q m0 u N", positive=True)
p, flow_rate_of_any = sp.symbols("p q_any", nonnegative=True)


def r_of_target() -> tuple[sp.Expr, sp.Expr]:
    """r* and c* along the target's orbit."""
    return model.target_radius(), model.areal


@claim(
    "(7)",
    "the functional to be minimised is the integral of α1 + α2p²",
    verdict="holds",
    remark="The condition α1, α2 ≥ 0 admits α1 = α2 = 0 too: every control then costs 0, and there is "
    "nothing to minimise. `Rendezvous` refuses this case.",
)
def functional() -> Equality:
    def derived() -> RightSides:
        at_rest = principle.hamiltonian().subs(dict.fromkeys(principle.COSTATE, 0))
        length = {thrust[0]: p, thrust[1]: 0, thrust[2]: 0}
        return sp.expand(-at_rest.subs(length))

    return Equality(
        {r"\dot g": time_weight + energy_weight * p**2},
        derived,
        display=r"J = \int_0^{t_k}(\alpha_1 + \alpha_2 p^2(t))\,dt,\quad \alpha_1, \alpha_2 = "
        r"\mathrm{const} \ge 0",
    )


@claim(
    "section 1: α1 = 0",
    "any α1 ≥ 0 is admitted, α1 = 0 too, while t_k is free",
    verdict="conditional",
    remark="The page claims no more than α1, α2 ≥ 0. For α1 > 0 a cost bounds the time, t_k ≤ J/α1, and p > "
    "0 at an unsaturated end; that an optimum always exists is not proved here. For α1 = 0, the "
    "problem of least energy, there is no optimum. Slow spirals meet the target with an energy that "
    "falls as 1/t_k: the infimum is 0, and only a coasting craft would attain it. The law at the end "
    "shows it too: it becomes n(t_k) = 0, three conditions in place of one. For α1 = 0 fix t_k "
    "instead.",
)
def least_energy_in_free_time() -> Conditional:
    s, T = spirals.share, spirals.duration

    def argument() -> Steps:
        beyond = principle.running_cost() - time_weight
        yield "α1 + α2p² ≥ α1: t_k ≤ J/α1 for α1 > 0", bool(beyond.is_nonnegative)
        weight = sp.Symbol("w", positive=True)
        radial, across = spirals.energies()
        yield (
            "a spiral costs α1T + a/T³ + b/T, without end as T grows",
            sp.limit(weight * T + radial / T**3 + across / T, T, sp.oo) == sp.oo,
        )
        end = terminal.end_thrust().subs({time_weight: weight, energy_weight: 1})
        yield "an unsaturated end has p(t_k) = √(α1/α2) > 0", end == sp.sqrt(weight)
        yield from meetings.true_meeting(meetings.INCLINED)

    def counterexample() -> Steps:
        radial, across = spirals.needed_thrust()
        yield (
            "r = c², c = 1 + (√1.5 − 1)(3s² − 2s³), s = t/T: the thrust is r'' and c'/r",
            vanishes(radial - spirals.by_time(spirals.by_time(spirals.radius())))
            and vanishes(across - spirals.by_time(spirals.areal()) / spirals.radius()),
        )
        ends = [(spirals.radius().subs(s, k), spirals.radius().diff(s).subs(s, k)) for k in (0, 1)]
        yield (
            "it leads from the circle r = 1 to r = 1.5, r' = 0 at both ends",
            ends == [(1, 0), (spirals.OUTER, 0)],
        )
        yield "its energy is a/T³ + b/T", vanishes((radial * T**2).diff(T)) and vanishes((across * T).diff(T))
        yield from ever_cheaper()
        yield "no thrust at all leaves c = 1, the target has c* = √1.5", spirals.areal().subs(s, 1) != 1
        yield "with α1 = 0 an unsaturated end has p(t_k) = 0", terminal.end_thrust().subs(time_weight, 0) == 0

    return Conditional(argument, counterexample=counterexample)


def ever_cheaper() -> Steps:
    """Spirals that meet the target after 1, 10, 100 and 1000 revolutions more than those of the target."""
    for lap in (1, 10, 100, 1000):
        whole, energy = spirals.duration_of(lap), spirals.energy_of(lap)
        caught = (spirals.sweep() - spirals.target_rate()) * whole
        lead = spirals.LEAD + 2 * math.pi * lap
        yield (
            f"at t = {whole:.1f}, having lapped it {lap} times, the craft meets the target",
            abs(caught - lead) < 1e-9 * lead,
        )
        yield f"with ∫p²dt = {energy:.2e}", 0 < energy < 0.1 / lap


@claim(
    "section 1: energy",
    "the functional stands for the energy spent and the time",
    verdict="conditional",
    remark="∫p²dt is the jet's energy up to a factor where the flow of mass is constant and the mass hardly "
    "changes; in general it is not the energy of a craft. At constant exhaust speed the jet's energy "
    "is that of the mass burnt, and depends on ∫p dt; at constant power it is N t_k, and ∫p²dt stands "
    "for the mass.",
)
def energy_spent() -> Conditional:
    def argument() -> Steps:
        speed = start_mass * p / flow_rate
        jet = flow_rate * speed**2 / 2
        yield (
            "flow q, mass m0: the exhaust speed is m0p/q, the jet's power qu²/2 = m0²p²/(2q)",
            vanishes(jet - start_mass**2 / (2 * flow_rate) * p**2),
        )
        share = sp.solve(
            principle.running_cost() - time_weight - jet.subs(p, principle.size(thrust)), energy_weight
        )
        yield (
            "the integrand of (7) less α1 is that power for α2 = m0²/(2q)",
            share == [start_mass**2 / (2 * flow_rate)],
        )

    def counterexample() -> Steps:
        m = sp.Function("m")(t)
        strong, weak = sp.Integer(2), sp.Integer(1)
        left = [
            sp.dsolve(m.diff(t) + push * m, ics={m.subs(t, 0): 1}).rhs.subs(t, time)
            for push, time in ((weak, 1), (strong, sp.Rational(1, 2)))
        ]
        energy = [(1 - mass) / 2 for mass in left]
        yield (
            "exhaust speed 1, m0 = 1, m' = −pm: p = 1 for a time 1, or p = 2 for 1/2 and none for 1/2, leave "
            f"m = {left[0]}",
            left[0] == left[1],
        )
        yield f"the jet's energy is {energy[0]} both times, in the same time", energy[0] == energy[1]
        squares = weak**2, strong**2 / 2
        yield f"and ∫p²dt = {squares[0]} or {squares[1]}", squares == (1, 2)

    return Conditional(argument, counterexample=counterexample)


@claim(
    "section 1: m",
    "m, in the remark on the loss of mass, is the mass of the uncontrolled craft (НКА)",
    verdict="misprint",
    remark="Printed: НКА, the uncontrolled craft, which burns nothing. Meant: УКА, the craft under control.",
)
def whose_mass() -> Slip:
    mass = start_mass - flow_rate * t

    def argument() -> Steps:
        spent = start_mass - mass.subs(t, t_k)
        yield "dm/dt = −q burns q t_k", vanishes(spent - flow_rate * t_k)
        push = flow_rate * exhaust / mass
        yield "and gives the thrust p = q u/m, which the craft under control has", push.subs(t, 0).is_positive

    def counterexample() -> Steps:
        rates = principle.state_rates()
        coasting = rates.subs(dict.fromkeys(thrust, 0))
        radius, areal = r_of_target()
        yield (
            "the uncontrolled craft obeys (2) with p1 = p2 = p3 = 0",
            vanishes(
                radius.diff(anomaly) * model.anomaly_rate()
                - coasting[0].subs(v1, model.target_radial_velocity())
            )
            and vanishes(areal.diff(anomaly) - coasting[2]),
        )
        (burnt,) = sp.solve(sp.Eq(flow_rate_of_any * exhaust / start_mass, 0), flow_rate_of_any)
        yield "and q u/m = 0 leaves q = 0: it burns nothing", burnt == 0

    return Slip(argument, counterexample=counterexample)


@claim(
    "section 1: dm/dt",
    "with dm/dt constant the functional stands for the loss of mass and the time",
    verdict="conditional",
    remark="With dm/dt = const the loss is |dm/dt| t_k, whatever p is: the same loss and time can go with "
    "different J. ∫p²dt stands for the loss at constant jet power (dm/dt = −m²p²/(2N)), or where the "
    "exhaust speed is constant as well as dm/dt, but then p cannot be chosen.",
)
def loss_of_mass() -> Conditional:
    mass = start_mass - flow_rate * t

    def spent_square(acceleration: sp.Expr) -> sp.Expr:
        return sp.simplify(sp.integrate(acceleration**2, t))

    def argument() -> Steps:
        m = sp.Function("m")(t)
        programme = sp.Function("p")(t)
        burning = -(m**2) * programme**2 / (2 * power)
        balance = (2 * power / m).diff(t).subs(m.diff(t), burning)
        yield (
            "at constant power N, d(2N/m)/dt = p²: ∫p²dt = 2N(1/m_k − 1/m0)",
            vanishes(balance - programme**2),
        )
        thrust_power = (m * programme) * (-m * programme / burning) / 2
        yield "the power (m p) u/2 of that jet, u = m p/|m'|, is N", vanishes(thrust_power - power)
        primitive = flow_rate * exhaust**2 / mass
        difference = primitive.diff(t) - (flow_rate * exhaust / mass) ** 2
        yield "at constant q and u, p = q u/m and ∫p²dt = q u²(1/m_k − 1/m0)", vanishes(difference)

    def counterexample() -> Steps:
        numbers = {flow_rate: 1, start_mass: 2}
        one = mass.subs(numbers)
        first = sp.integrate(1 / one**2, (t, 0, 1))
        second = sp.integrate(sp.Integer(1), (t, 0, 1))
        yield "m0 = 2, dm/dt = −1, t_k = 1: the loss is 1", one.subs(t, 0) - one.subs(t, 1) == 1
        yield f"exhaust speed 1: p = 1/m, ∫p²dt = {first}", first == sp.Rational(1, 2)
        yield f"exhaust speed m: p = 1, ∫p²dt = {second}, for the same loss in the same time", second == 1

    return Conditional(argument, counterexample=counterexample)


@claim.proof(
    "section 1: least time",
    "with α1 = 1, α2 = 0 the functional is t_k",
    display=r"\alpha_1 = 1,\ \alpha_2 = 0:\quad J = t_k",
)
def least_time() -> Steps:
    running = principle.running_cost().subs({time_weight: 1, energy_weight: 0})
    yield "the integrand is 1", running == 1
    yield "its integral is t_k", vanishes(sp.integrate(running, (t, 0, t_k)) - t_k)
