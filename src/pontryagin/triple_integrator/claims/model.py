"""The introduction, (0.1) to (0.9): the channel and its ends."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Equality,
    Evidence,
    Proof,
    RightSides,
    Sides,
    Steps,
    vanishes,
)
from pontryagin.triple_integrator.claims.turn import BANG_BANG, PEAK_DUAL, TURN, unit_turn
from pontryagin.triple_integrator.derivation import channel, energy
from pontryagin.triple_integrator.derivation.channel import (
    control,
    disturbance,
    epsilon,
    gamma,
    omega,
    t,
    tau,
    torque,
)
from pontryagin.triple_integrator.derivation.duality import peak_bound, piecewise_moments
from pontryagin.triple_integrator.derivation.model import T, s

claim = Page("Gorelov & Morozova 2012")

x10, x20, x30 = channel.initial
x1f, x2f, x3f = channel.final
x1, x2, x3 = (sp.Function(f"x_{k}") for k in (1, 2, 3))
kappa = sp.Symbol("kappa", real=True)


@claim("(0.1)", "rotation about a fixed axis: dγ/dt = ω, dω/dt = ε", verdict="holds")
def rotation_about_an_axis() -> Evidence:
    def derived() -> Sides:
        # Rodrigues' matrix gives the rate; along a fixed axis its derivative is the angular acceleration.
        rate = sp.solve(sp.Eq(channel.rate_of_rotation(), omega(t)), gamma(t).diff(t))[0]
        axis = sp.Matrix([sp.cos(kappa), sp.sin(kappa), 0])
        along = sp.simplify((axis.T * (omega(t) * axis).diff(t))[0])
        return {
            r"\dot\gamma(t)": rate,
            r"\dot\omega(t)": sp.solve(sp.Eq(along, epsilon(t)), omega(t).diff(t))[0],
        }

    return Equality(
        {r"\dot\gamma(t)": omega(t), r"\dot\omega(t)": epsilon(t)},
        derived,
        display=r"\frac{d\gamma(t)}{dt} = \omega(t);\quad \frac{d\omega(t)}{dt} = \varepsilon(t)",
    )


@claim("(0.2)", "ends of the turn: angle and rate at t0 and tf", verdict="holds")
def ends_of_the_turn() -> Evidence:
    g0, w0, gf, wf = sp.symbols("gamma_0 omega_0 gamma_f omega_f", real=True)
    names = {x10: g0, x20: w0, x1f: gf, x2f: wf}

    def derived() -> Sides:
        state = channel.transfer(kappa).subs(names)
        start, end = state.subs(tau, 0), state.subs(tau, T)
        return {
            r"\gamma(t_0)": start[0],
            r"\omega(t_0)": start[1],
            r"\gamma(t_f)": end[0],
            r"\omega(t_f)": end[1],
        }

    printed = {r"\gamma(t_0)": g0, r"\omega(t_0)": w0, r"\gamma(t_f)": gf, r"\omega(t_f)": wf}
    return Equality(printed, derived)


@claim.proof(
    "after (0.2)",
    "γ0 = 0, 0 < γf ≤ π, ω0 = ωf = 0 is a turn by the angle γf about the body axis, and not a trivial one",
)
def turn_by_an_angle() -> Steps:
    angle = sp.Symbol("gamma_f", real=True)
    axis = sp.Matrix([0, 0, 1])
    turned = channel.rotation(angle, axis)
    yield "the attitude at γf keeps the axis", vanishes(turned * axis - axis)
    yield "its trace is 1 + 2 cos γf: it is a turn by γf", vanishes(turned.trace() - 1 - 2 * sp.cos(angle))
    back = channel.rotation(angle - 2 * sp.pi, axis)
    yield "an angle beyond π is the turn by 2π − γf the other way round", vanishes(turned - back)
    rest = channel.drive(sp.zeros(3, 1), T, sp.S.Zero)
    yield "left to itself at rest, the craft does not turn", vanishes(rest)


@claim(
    "(0.3)", "angular acceleration = control torque + disturbances, cross-couplings included", verdict="holds"
)
def acceleration_is_torque_and_disturbance() -> Evidence:
    applied, external = sp.symbols("M_1 M_d", real=True)
    inertia = sp.Symbol("J_1", positive=True)
    acceleration = channel.euler_acceleration(applied, external)
    rest = acceleration.subs(applied, 0)

    def derived() -> RightSides:
        in_relative_torque = acceleration.subs(applied, inertia * torque(t))
        return in_relative_torque - rest + disturbance(t)

    def argument() -> Steps:
        rates = sp.symbols("omega_2:4", real=True)
        yield "the rest of the acceleration does not depend on the control torque", not rest.has(applied)
        yield "it holds the product of the other two rates", rest.diff(*rates) != 0
        yield "it holds the external torque", vanishes(rest.diff(external) - 1 / inertia)

    return Proof(argument, Equality({r"\varepsilon(t)": torque(t) + disturbance(t)}, derived))


@claim("after (0.3)", "(0.1) and (0.3) make a double integrator: d²γ/dt² = m + f", verdict="holds")
def double_integrator() -> Evidence:
    def derived() -> RightSides:
        rate = {gamma(t).diff(t): omega(t), omega(t).diff(t): torque(t) + disturbance(t)}
        return gamma(t).diff(t).subs(rate).diff(t).subs(rate)

    return Equality({r"\ddot\gamma(t)": torque(t) + disturbance(t)}, derived)


@claim("(0.4)", "the control u is the rate of the control torque", verdict="holds")
def rate_of_the_torque() -> Evidence:
    def derived() -> RightSides:
        built_up = sp.Symbol("m_0") + sp.Integral(control(tau), (tau, channel.t0, t))
        return built_up.diff(t)

    return Equality(
        {r"\dot m(t)": control(t)},
        derived,
        display=r"\frac{dm(t)}{dt} = u(t)",
    )


@claim(
    "before (0.4)",
    "electromechanical actuators: the torque m(t) is continuous",
    verdict="conditional",
    remark="True for every integrable u. The impulsive programme (4.9), the paper's own answer to "
    "problem 3, makes m jump: in example 1 the first jump is 4γ/T².",
)
def torque_is_continuous() -> Evidence:
    def argument() -> Steps:
        instant, bound = sp.symbols("delta U", positive=True)
        grown = channel.drive(sp.zeros(3, 1), instant, bound)[2]
        yield (
            "over a time δ the torque changes by at most the integral of |u|",
            vanishes(grown - bound * instant),
        )
        yield "that bound goes to zero with δ", sp.limit(grown, instant, 0) == 0

    def counterexample() -> Steps:
        rest = sp.zeros(3, 1)
        first, middle = 4 * kappa / T**2, -8 * kappa / T**2
        state = channel.drive(channel.kick(rest, first), T / 2, sp.S.Zero)
        state = channel.drive(channel.kick(state, middle), T / 2, sp.S.Zero)
        end = channel.kick(state, first)
        yield "(4.9) performs the turn of example 1", vanishes(end - sp.Matrix([kappa, 0, 0]))
        yield "(4.9) starts with a jump of m from 0 to 4γ/T²", channel.kick(rest, first)[2] == first

    return Conditional(argument, counterexample=counterexample)


@claim("(0.5)", "ends of the control torque", verdict="holds")
def ends_of_the_torque() -> Evidence:
    m0, mf = sp.symbols("m_0 m_f", real=True)

    def derived() -> Sides:
        third = channel.transfer(kappa)[2].subs({x30: m0, x3f: mf})
        return {"m(t_0)": third.subs(tau, 0), "m(t_f)": third.subs(tau, T)}

    return Equality({"m(t_0)": m0, "m(t_f)": mf}, derived)


@claim(
    "(0.6)", "the channel is a triple integrator with the disturbance in the second equation", verdict="holds"
)
def triple_integrator() -> Evidence:
    names = {gamma(t): x1(t), omega(t): x2(t), torque(t): x3(t)}

    def derived() -> Sides:
        acceleration = torque(t) + disturbance(t)
        return {
            r"\dot x_1(t)": omega(t).subs(names),
            r"\dot x_2(t)": epsilon(t).subs(epsilon(t), acceleration).subs(names),
            r"\dot x_3(t)": control(t),
        }

    printed = {
        r"\dot x_1(t)": x2(t),
        r"\dot x_2(t)": x3(t) + disturbance(t),
        r"\dot x_3(t)": control(t),
    }
    return Equality(
        printed,
        derived,
        display=r"\frac{dx_1(t)}{dt} = x_2(t);\quad \frac{dx_2(t)}{dt} = x_3(t) + f(t);\quad "
        r"\frac{dx_3(t)}{dt} = u(t)",
    )


@claim.proof("(0.7)", "the control may be bounded: |u| ≤ u0", display=r"\lvert u(t) \rvert \le u_0")
def bound_on_the_control() -> Steps:
    yield "the turn by 1 in unit time can be made with u0 = 32", piecewise_moments(BANG_BANG) == TURN
    yield "no smaller u0 suffices: the bound by a dual function", peak_bound(PEAK_DUAL, TURN, sp.S.One) == 32
    least_energy = energy.minimum_energy_control().subs(unit_turn())
    yield "the least-energy programme of that turn breaks the bound", least_energy.subs(s, 1) == 60


@claim("(0.8)", "the state at t0", verdict="holds")
def initial_state() -> Evidence:
    def derived() -> Sides:
        start = channel.transfer(kappa).subs(tau, 0)
        return {f"x_{k}(t_0)": start[k - 1] for k in (1, 2, 3)}

    return Equality({"x_1(t_0)": x10, "x_2(t_0)": x20, "x_3(t_0)": x30}, derived)


@claim("(0.9)", "the state at tf", verdict="holds")
def final_state() -> Evidence:
    def derived() -> Sides:
        end = channel.transfer(kappa).subs(tau, T)
        return {f"x_{k}(t_f)": end[k - 1] for k in (1, 2, 3)}

    return Equality({"x_1(t_f)": x1f, "x_2(t_f)": x2f, "x_3(t_f)": x3f}, derived)


@claim.proof(
    "after (0.9)", "the manoeuvre is not trivial where c ≠ 0: the free motion misses the target by c"
)
def nontrivial() -> Steps:
    gap = channel.final - channel.drive(channel.initial, T, sp.S.Zero, kappa)
    yield "what the free motion misses is c of (1.10)", vanishes(gap - channel.required_moments(kappa))
    yield "every gap occurs: its derivative by xf is the identity", gap.jacobian(channel.final) == sp.eye(3)
