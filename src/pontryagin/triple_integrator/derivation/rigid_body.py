"""Torques and cross-couplings of a rigid body, which a channel (0.1) to (0.6) leaves out.

here            meaning
--------------  ----------------------------------------------------------------------------
J, w, M         inertia tensor, angular rate and torque, all in body axes; K = J^-1
q               attitude as a unit quaternion (scalar first), body axes to inertial axes
phi, theta      attitude as a rotation vector: a turn by theta = |phi| about phi
m, u            control acceleration m = J^-1 M by channel, and its rate u = dm/dt, (0.4)
f               cross-coupling of the channels phi'' = m + f, the f of (0.3)
"""

from functools import cache

import sympy as sp

from pontryagin.triple_integrator.derivation.channel import skew

inertia = sp.Matrix(3, 3, lambda i, j: sp.Symbol(f"J{min(i, j) + 1}{max(i, j) + 1}", real=True))
inverse_inertia = sp.Matrix(3, 3, lambda i, j: sp.Symbol(f"K{min(i, j) + 1}{max(i, j) + 1}", real=True))
rate = sp.Matrix(sp.symbols("w1:4", real=True))
acceleration = sp.Matrix(sp.symbols("a1:4", real=True))
axis = sp.Matrix(sp.symbols("e1:4", real=True))
quaternion = sp.Matrix(sp.symbols("q0:4", real=True))
rotation_vector = sp.Matrix(sp.symbols("phi1:4", real=True))
rotation_vector_rate = sp.Matrix(sp.symbols("phidot1:4", real=True))
control_acceleration = sp.Matrix(sp.symbols("m1:4", real=True))
x2, x3, f = sp.symbols("x2 x3 f", real=True)
angle = sp.Symbol("theta", positive=True)


def euler_torque() -> sp.Matrix:
    """M of Euler's equations, from d(R J w)/dt = R M and R' = R [w], at the instant when R = 1."""
    attitude = sp.Matrix(3, 3, sp.symbols("r1:10", real=True))
    momentum = attitude * inertia * rate
    attitude_rate = attitude * skew(rate)
    moving_frame = sum(
        (momentum.diff(entry) * change for entry, change in zip(attitude, attitude_rate, strict=True)),
        sp.zeros(3, 1),
    )
    torque = moving_frame + momentum.jacobian(rate) * acceleration
    return torque.subs(dict(zip(attitude, sp.eye(3), strict=True))).applyfunc(sp.expand)


def fixed_axis_torque() -> sp.Matrix:
    """Torque that turns the body about the unit axis e with w = x2 e and w' = (x3 + f) e of (0.6)."""
    motion = dict(zip(rate, x2 * axis, strict=True)) | dict(zip(acceleration, (x3 + f) * axis, strict=True))
    return euler_torque().subs(motion, simultaneous=True).applyfunc(sp.expand)


def gyroscopic_torque() -> sp.Matrix:
    """The part of `fixed_axis_torque` that no channel commands: its value for x3 + f = 0."""
    return fixed_axis_torque().subs(x3, -f).applyfunc(sp.expand)


def product(p: sp.Matrix, q: sp.Matrix) -> sp.Matrix:
    """Hamilton's product of two quaternions."""
    pv, qv = sp.Matrix(p[1:]), sp.Matrix(q[1:])
    return sp.Matrix([p[0] * q[0] - pv.dot(qv), *(p[0] * qv + q[0] * pv + pv.cross(qv))])


def turn_by(vector: sp.Matrix, size: sp.Expr) -> sp.Matrix:
    """Quaternion of the turn by size = |vector| about vector."""
    return sp.Matrix([sp.cos(size / 2), *(sp.sin(size / 2) / size * vector)])


def rotation_matrix(q: sp.Matrix = quaternion) -> sp.Matrix:
    """R with R v = q v q*, for |q| = 1."""
    conjugate = sp.Matrix([q[0], -q[1], -q[2], -q[3]])
    images = [product(product(q, sp.Matrix([0, *unit])), conjugate)[1:] for unit in sp.eye(3).tolist()]
    return sp.Matrix(images).T.applyfunc(sp.expand)


def quaternion_rate() -> sp.Matrix:
    """q' = q w / 2: the derivative of q followed by the turn w h with respect to h, at h = 0."""
    h, speed = sp.symbols("h w", positive=True)
    following = product(quaternion, turn_by(rate * h, speed * h))
    return following.diff(h).applyfunc(lambda entry: sp.limit(entry, h, 0))


def along(expression: sp.Matrix, component: sp.Symbol) -> sp.Matrix:
    """Derivative with respect to one component of phi, on which theta = |phi| also depends."""
    return expression.diff(component) + expression.diff(angle) * component / angle


@cache
def rate_matrix() -> sp.Matrix:
    """B(phi) with w = B phi', from w = 2 q* q' and q = turn_by(phi)."""
    q = turn_by(rotation_vector, angle)
    conjugate = sp.Matrix([q[0], -q[1], -q[2], -q[3]])
    columns = [2 * product(conjugate, along(q, component)) for component in rotation_vector]
    return sp.Matrix.hstack(*[sp.Matrix(column[1:]) for column in columns])


def rate_matrix_in_closed_form() -> sp.Matrix:
    """B = 1 - (1 - cos t)/t^2 [phi] + (t - sin t)/t^3 [phi]^2 with t = theta."""
    cross = skew(rotation_vector)
    return sp.eye(3) - (1 - sp.cos(angle)) / angle**2 * cross + (angle - sp.sin(angle)) / angle**3 * cross**2


def inverse_rate_matrix() -> sp.Matrix:
    """B^-1 = 1 + [phi]/2 + (1 - (t/2) cot(t/2))/t^2 [phi]^2: regular up to a full turn, t < 2 pi."""
    cross = skew(rotation_vector)
    return sp.eye(3) + cross / 2 + (1 - angle / 2 * sp.cot(angle / 2)) / angle**2 * cross**2


def free_acceleration(w: sp.Matrix = rate) -> sp.Matrix:
    """-J^-1 (w x J w), which Euler's equations add to the control acceleration m = J^-1 M in w'."""
    return -inverse_inertia * w.cross(inertia * w)


def cross_coupling(
    phi_rate: sp.Matrix = rotation_vector_rate, m: sp.Matrix = control_acceleration
) -> sp.Matrix:
    """f = phi'' - m of the three channels phi'' = m + f, along the motion (phi, phi', m).

    phi' = B^-1 w gives phi'' = B^-1 (w' - B' phi'), and w' = m - J^-1 (w x J w).
    """
    matrix = rate_matrix_in_closed_form()
    matrix_rate = sum(
        (along(matrix, x) * v for x, v in zip(rotation_vector, phi_rate, strict=True)), sp.zeros(3, 3)
    )
    angular_acceleration = m + free_acceleration(matrix * phi_rate)
    return inverse_rate_matrix() * (angular_acceleration - matrix_rate * phi_rate) - m


def leading_cross_coupling() -> sp.Matrix:
    """The lowest order of f in the size of the motion: (phi x m)/2 - J^-1 (phi' x J phi').

    B^-1 = 1 + [phi]/2 + O(phi^2), and B' phi' = -(phi' x phi')/2 + ... vanishes at second order.
    """
    return rotation_vector.cross(control_acceleration) / 2 + free_acceleration(rotation_vector_rate)
