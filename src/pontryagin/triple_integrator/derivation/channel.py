"""The channel of the paper: rotation about an axis, state equations and transfers, (0.1) to (1.10).

Times are the paper's: t runs from t0 to tf, tau is the time of integration, T = tf - t0.
"""

from functools import cache

import sympy as sp

from pontryagin.triple_integrator.derivation.energy import minimum_energy_control
from pontryagin.triple_integrator.derivation.model import CHAIN, INPUT, T, c, s, transition

t, t0, tf, tau = sp.symbols("t t_0 t_f tau", real=True)
initial = sp.Matrix(sp.symbols("x_10 x_20 x_30", real=True))
final = sp.Matrix(sp.symbols("x_1f x_2f x_3f", real=True))
gamma, omega, epsilon, torque, disturbance, control = (
    sp.Function(name) for name in ("gamma", "omega", "varepsilon", "m", "f", "u")
)


def skew(v: sp.Matrix) -> sp.Matrix:
    """[v], the matrix with [v] b = v x b."""
    return sp.Matrix([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def rotation(angle: sp.Expr, axis: sp.Matrix) -> sp.Matrix:
    """Rotation by an angle about a unit axis (Rodrigues)."""
    k = skew(axis)
    return sp.eye(3) + sp.sin(angle) * k + (1 - sp.cos(angle)) * k**2


def rate_of_rotation() -> sp.Expr:
    """Angular velocity along a fixed axis, from the attitude matrix, (0.1): R' dR/dt = omega [e]."""
    lean = sp.symbols("theta", real=True)
    axis = sp.Matrix([sp.cos(lean), sp.sin(lean), 0])
    attitude = rotation(gamma(t), axis)
    spin = attitude.T * attitude.diff(t)
    vector = sp.Matrix([spin[2, 1], spin[0, 2], spin[1, 0]])
    return sp.simplify((axis.T * vector)[0])


def euler_acceleration(applied: sp.Expr, external: sp.Expr) -> sp.Expr:
    """The first channel's angular acceleration (0.3), from Euler's equations about principal axes."""
    inertia = sp.diag(*sp.symbols("J_1:4", positive=True))
    rates = sp.Matrix(sp.symbols("omega_1:4", real=True))
    moment = sp.Matrix([applied + external, 0, 0])
    return sp.expand((inertia.inv() * (moment - rates.cross(inertia * rates)))[0])


def drive(state: sp.Matrix, duration: sp.Expr, program: sp.Expr, force: sp.Expr = sp.S.Zero) -> sp.Matrix:
    """The state after a duration under the control `program` of `tau`, which runs from 0, by (0.6)."""
    clock = sp.Dummy("t", positive=True)

    def integral(rate: sp.Expr) -> sp.Expr:
        return sp.integrate(sp.expand(rate), (tau, 0, clock)).subs(clock, tau)

    third = state[2] + integral(program)
    second = state[1] + integral(third + force)
    first = state[0] + integral(second)
    return sp.Matrix([first, second, third]).subs(tau, duration)


def kick(state: sp.Matrix, impulse: sp.Expr) -> sp.Matrix:
    """The state after an impulse of the control."""
    return state + impulse * INPUT


def required_moments(force: sp.Expr = sp.S.Zero) -> sp.Matrix:
    """c = x_f - Phi x_0 - g in terms of the ends, from the motion without control; (1.7), (1.10)."""
    return (final - drive(initial, T, sp.S.Zero, force)).applyfunc(sp.expand)


@cache
def transfer(force: sp.Expr = sp.S.Zero) -> sp.Matrix:
    """The state at the time tau after t0 under the least-energy programme between the ends (0.2), (0.5)."""
    program = minimum_energy_control().subs(s, T - tau)
    clock = sp.Dummy("t", positive=True)
    state = drive(initial, clock, program, force).subs(clock, tau)
    return state.subs(dict(zip(c, required_moments(force), strict=True)))


def cauchy(moment: sp.Expr = t) -> sp.Matrix:
    """The state as a sum of free and forced motion, unevaluated integrals of u and f; (1.3)."""
    forcing = INPUT * control(tau) + sp.Matrix([0, disturbance(tau), 0])
    kernel = transition(moment - tau) * forcing
    return transition(moment - t0) * initial + kernel.applyfunc(lambda k: sp.Integral(k, (tau, t0, moment)))


def right_hand_side(state: sp.Matrix) -> sp.Matrix:
    """A x + b u + f at the time t; (1.1)."""
    return CHAIN * state + INPUT * control(t) + sp.Matrix([0, disturbance(t), 0])
