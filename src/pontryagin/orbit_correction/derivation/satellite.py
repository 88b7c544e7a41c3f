"""From the satellite's equations of motion to the regrouped system (12) and its summands, section 7.

In the units used, radius, speed and angular rate of the circle are 1; z = (dr, dv_R, dv_T).
"""

import functools

import sympy as sp

t = sp.Symbol("t", real=True)
interval = sp.Symbol("Delta", positive=True)
r, v_radial, v_transverse = sp.symbols("r v_R v_T", real=True)
RADIAL, TRANSVERSE = sp.Matrix([0, 1, 0]), sp.Matrix([0, 0, 1])


def equations_of_motion() -> sp.Matrix:
    """(r', v_R', v_T') in the field 1/r^2, from the acceleration in polar coordinates."""
    radius, angle = sp.Function("r")(t), sp.Function("theta")(t)
    place = radius * sp.Matrix([sp.cos(angle), sp.sin(angle)])
    along = sp.Matrix([sp.cos(angle), sp.sin(angle)])
    across = sp.Matrix([-sp.sin(angle), sp.cos(angle)])
    speed = place.diff(t)
    acceleration = -place / radius**3
    components = {radius.diff(t): v_radial, angle.diff(t): v_transverse / radius}
    rates = [(speed.diff(t) - acceleration).dot(direction).simplify() for direction in (along, across)]
    second = sp.solve(rates, [radius.diff(t, 2), angle.diff(t, 2)], dict=True)[0]
    radial_rate = second[radius.diff(t, 2)].subs(components)
    transverse_rate = (radius.diff(t) * angle.diff(t) + radius * second[angle.diff(t, 2)]).subs(components)
    return sp.Matrix([v_radial, radial_rate, transverse_rate]).subs(radius, r).applyfunc(sp.simplify)


def angular_rate() -> sp.Expr:
    """theta' in terms of the transverse speed, the component of the velocity across the radius."""
    radius, angle = sp.Function("r")(t), sp.Function("theta")(t)
    place = radius * sp.Matrix([sp.cos(angle), sp.sin(angle)])
    across = sp.Matrix([-sp.sin(angle), sp.cos(angle)])
    speed = sp.simplify(place.diff(t).dot(across))
    return sp.solve(sp.Eq(speed, v_transverse), angle.diff(t))[0].subs(radius, r)


def linearised() -> sp.Matrix:
    """A: the derivative of the equations of motion on the circle r = 1, v_R = 0, v_T = 1."""
    circle = {r: 1, v_radial: 0, v_transverse: 1}
    return equations_of_motion().jacobian([r, v_radial, v_transverse]).subs(circle)


@functools.cache
def transition(time: sp.Expr = t) -> sp.ImmutableMatrix:
    """e^{A t} = I + sin t A + (1 - cos t) A^2, since A^3 = -A."""
    A = linearised()
    if A**3 != -A:
        raise ArithmeticError("the linearised system does not satisfy A^3 = -A")
    return sp.ImmutableMatrix(sp.eye(3) + sp.sin(time) * A + (1 - sp.cos(time)) * A**2)


def impulse_directions() -> list[sp.Matrix]:
    """The effects of a radial and a transverse impulse after one interval: the columns of B~."""
    return [transition(interval) * unit for unit in (RADIAL, TRANSVERSE)]


def step_matrix(k: int) -> sp.Matrix:
    """A(k) of (12): the transition over two intervals for even k, over one for odd k."""
    return sp.Matrix(transition(interval)) ** (2 if k % 2 == 0 else 1)


def step_inputs(k: int) -> sp.Matrix:
    """B(k) of (12): the three impulse components of step k, carried to its end."""
    once = sp.Matrix(transition(interval))
    radial, transverse = impulse_directions()
    if k % 2 == 0:
        return sp.Matrix.hstack(once * radial, once * transverse, radial)
    return sp.Matrix.hstack(once * transverse, radial, transverse)


def schedule(k: int) -> list[tuple[int, int]]:
    """(interval, component) of the three impulse components of step k; component 0 is radial."""
    return [divmod(3 * k + i, 2) for i in range(3)]


def factor_columns(k: int) -> sp.Matrix:
    """G_k of Lemma 1 for a peak of 1, without inverses: e^{-A j Delta} e for the components of step k."""
    columns = []
    for j, component in schedule(k):
        columns.append(transition(-j * interval) * (TRANSVERSE if component else RADIAL))
    return sp.Matrix.hstack(*columns)
