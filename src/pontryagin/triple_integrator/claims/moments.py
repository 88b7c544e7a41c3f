"""Section 1, (1.1) to (1.10): state equations, Cauchy's formula, the moments."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import Equality, Evidence, Proof, RightSides, Sides, Steps, vanishes
from pontryagin.triple_integrator.derivation import channel
from pontryagin.triple_integrator.derivation.channel import control, disturbance, t, t0, tau, tf
from pontryagin.triple_integrator.derivation.model import INPUT, T, moments_of, s, transition

claim = Page("Gorelov & Morozova 2012")

x10, x20, x30 = channel.initial
x1f, x2f, x3f = channel.final
to_go = tf - tau


@claim("(1.1)", "state equations in matrix form, with A, b and f(t)", verdict="holds")
def matrix_form() -> Evidence:
    def derived() -> Sides:
        x = sp.Matrix([sp.Function(f"x_{k}")(t) for k in (1, 2, 3)])
        rates = sp.Matrix([x[1], x[2] + disturbance(t), control(t)])
        # The matrices are the derivatives of the right-hand sides of (0.6).
        forcing = rates.subs(dict.fromkeys(x, 0)).subs(control(t), 0)
        return {
            r"\mathbf{A}": rates.jacobian(x),
            r"\mathbf{b}": rates.diff(control(t)),
            r"\mathbf{f}(t)": forcing,
        }

    printed = {
        r"\mathbf{A}": sp.Matrix([[0, 1, 0], [0, 0, 1], [0, 0, 0]]),
        r"\mathbf{b}": sp.Matrix([0, 0, 1]),
        r"\mathbf{f}(t)": sp.Matrix([0, disturbance(t), 0]),
    }
    return Equality(printed, derived)


@claim("(1.2)", "ends as vectors: x(t0) = x0, x(tf) = xf", verdict="holds")
def vector_ends() -> Evidence:
    def derived() -> Sides:
        path = channel.transfer(sp.Symbol("kappa", real=True))
        return {r"\mathbf{x}(t_0)": path.subs(tau, 0), r"\mathbf{x}(t_f)": path.subs(tau, T)}

    return Equality({r"\mathbf{x}(t_0)": channel.initial, r"\mathbf{x}(t_f)": channel.final}, derived)


@claim.proof(
    "(1.3)",
    "Cauchy's formula solves (1.1) with x(t0) = x0",
    display=r"\mathbf{x}(t) = \Phi(t, t_0)\mathbf{x}_0 + \int_{t_0}^t \Phi(t, \tau)"
    r"[\mathbf{b}u(\tau) + \mathbf{f}(\tau)]\,d\tau",
)
def cauchy_formula() -> Steps:
    path = channel.cauchy()
    residual = path.diff(t) - channel.right_hand_side(path)
    yield "it satisfies the state equations, for any u and f", vanishes(residual.applyfunc(sp.expand).doit())
    empty = {
        part: 0 for part in path.subs(t, t0).atoms(sp.Integral) if part.limits[0][1] == part.limits[0][2]
    }
    yield "and starts from x0", vanishes(path.subs(t, t0).subs(empty) - channel.initial)


@claim("(1.4)", "transition matrix", verdict="holds")
def transition_matrix() -> Evidence:
    lapse = t - t0
    printed = sp.Matrix([[1, lapse, lapse**2 / 2], [0, 1, lapse], [0, 0, 1]])
    return Equality(
        {r"\Phi(t, t_0)": printed},
        lambda: transition(lapse),
        display=r"\Phi(t, t_0) = \begin{bmatrix} 1 & t - t_0 & \tfrac12(t - t_0)^2 \\ 0 & 1 & t - t_0 \\ 0 "
        r"& 0 & 1 \end{bmatrix}",
    )


@claim("(1.5)", "response to the control, Φ(tf, τ) b", verdict="holds")
def response() -> Evidence:
    printed = sp.Matrix([to_go**2 / 2, to_go, 1])
    return Equality(
        {r"\Phi(t_f, \tau)\mathbf{b}": printed},
        lambda: transition(to_go) * INPUT,
        display=r"\Phi(t_f, \tau)\mathbf{b} = \begin{bmatrix} \tfrac12(t_f - \tau)^2 \\ t_f - \tau \\ 1 "
        r"\end{bmatrix}",
    )


@claim("(1.6)", "the components h1, h2, h3 of this response", verdict="holds")
def response_components() -> Evidence:
    printed = {r"h_1(\tau)": to_go**2 / 2, r"h_2(\tau)": to_go, r"h_3(\tau)": sp.S.One}

    def derived() -> RightSides:
        # From rest: an impulse at tau, followed by the free motion.
        return channel.drive(channel.kick(sp.zeros(3, 1), sp.S.One), s, sp.S.Zero).subs(s, to_go)

    return Equality(
        printed,
        derived,
        display=r"h_1(\tau) = \tfrac12(t_f - \tau)^2;\quad h_2(\tau) = t_f - \tau;\quad h_3(\tau) = 1",
    )


def ramp() -> tuple[sp.Expr, list[sp.Symbol]]:
    """A disturbance that is any quadratic in the time after t0, and its coefficients."""
    coefficients = list(sp.symbols("f_0:3", real=True))
    return sum(f * tau**k for k, f in enumerate(coefficients)), coefficients


@claim("(1.7)", "c = xf − Φ x0 − g", verdict="holds")
def moments_of_the_manoeuvre() -> Evidence:
    force, _ = ramp()
    g = channel.drive(sp.zeros(3, 1), T, sp.S.Zero, force)
    printed = channel.final - transition(T) * channel.initial - g
    return Equality(
        {r"\mathbf{c}": printed},
        lambda: channel.required_moments(force),
        display=r"\mathbf{c} = \mathbf{x}_f - \Phi(t_f, t_0)\mathbf{x}_0 - \mathbf{g}(t_f)",
    )


@claim("after (1.7): g", "g(t), the integral of Φ(t, τ) f(τ), is what the disturbance adds", verdict="holds")
def forced_motion() -> Evidence:
    force, _ = ramp()
    kernel = transition(T - tau) * sp.Matrix([0, force, 0])
    printed = kernel.applyfunc(lambda entry: sp.integrate(sp.expand(entry), (tau, 0, T)))
    return Equality(
        {r"\mathbf{g}(t_f)": printed},
        lambda: channel.drive(sp.zeros(3, 1), T, sp.S.Zero, force),
        display=r"\mathbf{g}(t) = \int_{t_0}^t \Phi(t, \tau)\mathbf{f}(\tau)\,d\tau",
    )


@claim("(1.8)", "what the disturbance adds: g1, g2, g3", verdict="holds")
def effect_of_the_disturbance() -> Evidence:
    lag = sp.Integral((t - tau) * disturbance(tau), (tau, t0, t))
    printed = {"g_1(t)": lag, "g_2(t)": sp.Integral(disturbance(tau), (tau, t0, t)), "g_3(t)": sp.S.Zero}

    def derived() -> Sides:
        kernel = transition(t - tau) * sp.Matrix([0, disturbance(tau), 0])
        return {f"g_{k + 1}(t)": sp.Integral(kernel[k], (tau, t0, t)).doit(deep=False) for k in range(3)}

    def argument() -> Steps:
        force, coefficients = ramp()
        moved = channel.drive(sp.zeros(3, 1), T, sp.S.Zero, force)
        first = sp.integrate(sp.expand((T - tau) * force), (tau, 0, T))
        yield "g1 is where a quadratic disturbance takes the channel from rest", vanishes(moved[0] - first)
        yield "g2 likewise", vanishes(moved[1] - sp.integrate(force, (tau, 0, T)))
        yield "this holds for each of its three coefficients", all(moved[0].has(f) for f in coefficients)

    return Proof(argument, Equality(printed, derived))


@claim.proof(
    "(1.9)",
    "the control steers x0 to xf exactly when its moments are c",
    display=r"\int_{t_0}^{t_f} \Phi(t_f, \tau)\mathbf{b}\,u(\tau)\,d\tau = \mathbf{c}",
)
def moment_equation() -> Steps:
    coefficients = sp.symbols("u_0:5", real=True)
    program = sum(u * tau**k for k, u in enumerate(coefficients))
    force, _ = ramp()
    end = channel.drive(channel.initial, T, program, force)
    missed = channel.final - end
    moments = moments_of(program.subs(tau, T - s))
    gap = channel.required_moments(force) - moments
    yield "xf − x(tf) = c − moments, for any quartic control and quadratic f", vanishes(missed - gap)
    solved = sp.solve(list(gap), coefficients[:3], dict=True)
    yield "controls with the moments c exist", len(solved) == 1


@claim("(1.10)", "the components of c", verdict="holds")
def moment_components() -> Evidence:
    force, coefficients = ramp()
    g1 = sum(f * sp.integrate((T - tau) * tau**k, (tau, 0, T)) for k, f in enumerate(coefficients))
    g2 = sum(f * sp.integrate(tau**k, (tau, 0, T)) for k, f in enumerate(coefficients))
    printed = {
        "c_1": x1f - x10 - T * x20 - T**2 * x30 / 2 - g1,
        "c_2": x2f - x20 - T * x30 - g2,
        "c_3": x3f - x30,
    }
    return Equality(
        printed,
        lambda: channel.required_moments(force),
        display=r"c_1 = x_{1f} - x_{10} - (t_f - t_0)x_{20} - \tfrac12 (t_f - t_0)^2 x_{30} - g_1(t_f),\quad "
        r"c_2 = x_{2f} - x_{20} - (t_f - t_0)x_{30} - g_2(t_f),\quad c_3 = x_{3f} - x_{30}",
    )
