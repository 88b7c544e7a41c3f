"""Newton's law in the rotating axes eta of the craft, (2) and (3); the target's motion, (5) and (6).

paper          here            meaning
-------------  --------------  ----------------------------------------------------------------
r, v1, c       r, v1, c        distance, radial velocity, areal constant |R x V|
lambda         attitude        quaternion of eta (eta1 along R, eta3 along R x V) in inertial axes
omega_eta      -               angular velocity of eta, in eta
p_eta          thrust          acceleration by thrust, in eta
fM             gravity         gravitational parameter
phi*           anomaly         the target's true anomaly
p*, e*, c*     parameter, eccentricity, areal    of the target's orbit; c*^2 = fM p*
Lambda*        orientation     quaternion of the target's orbit (its pericentre on the first axis)
"""

from functools import cache

import sympy as sp

from pontryagin.rendezvous.derivation.quaternion import conjugate, product, rotated, turn, vect
from pontryagin.rendezvous.derivation.symbols import Symbol

r, c, gravity = sp.symbols("r c fM", positive=True)
v1 = sp.Symbol("v1", real=True)
attitude = sp.Matrix(sp.symbols("lambda0:4", real=True))
thrust = sp.Matrix(sp.symbols("p1:4", real=True))

anomaly = Symbol("phi", real=True)
parameter, areal = Symbol("p_star", positive=True), Symbol("c_star", positive=True)
eccentricity = Symbol("e_star", nonnegative=True)
orientation = sp.Matrix(sp.symbols("Lambda0:4", real=True))

EX, EY, EZ = (sp.Matrix([int(k == j) for k in range(3)]) for j in range(3))
GAUSS = areal**2 / parameter
"""fM = c*^2/p*, by the parameter and the areal constant of the target's orbit."""


def derivative_in_rotating_axes(vector: sp.Matrix, rates: sp.Matrix, omega: sp.Matrix) -> sp.Matrix:
    """dx/dt in rotating axes: the derivative of the components plus omega x x."""
    return vector.jacobian([r, v1, c]) * rates + omega.cross(vector)


@cache
def motion() -> tuple[sp.Matrix, sp.Matrix]:
    """Rates (r', v1', c') and angular velocity of eta, from Newton's law: (2) and omega_eta of (3).

    That eta1 lies along R and eta3 along R x V means R = r i1, V = v1 i1 + (c/r) i2. R' = V and
    V' = -fM R/r^3 + p are six linear equations for the six unknowns.
    """
    rates, omega = sp.Matrix(sp.symbols("r_dot v_dot c_dot")), sp.Matrix(sp.symbols("omega1:4"))
    position, velocity = r * EX, v1 * EX + c / r * EY
    newton = [
        *(derivative_in_rotating_axes(position, rates, omega) - velocity),
        *(derivative_in_rotating_axes(velocity, rates, omega) + gravity * position / r**3 - thrust),
    ]
    unknowns = [*rates, *omega]
    (solution,) = sp.linsolve(newton, unknowns)
    values = [sp.expand(value) for value in solution]
    return sp.Matrix(values[:3]), sp.Matrix(values[3:])


@cache
def attitude_rate() -> sp.Matrix:
    """lambda' = lambda o omega_eta / 2, (3): the derivative by h of lambda followed by a rotation omega h."""
    h = sp.Symbol("h", positive=True)
    speed = sp.Symbol("w", positive=True)
    omega = motion()[1]
    small_turn = sp.Matrix([sp.cos(speed * h / 2), *(sp.sin(speed * h / 2) / speed * omega)])
    return product(attitude, small_turn.diff(h).subs(h, 0))


@cache
def conic() -> tuple[sp.Expr, sp.Expr]:
    """1/r* as a function of the anomaly, and fM/c*^2, from Binet's equation u'' + u = fM/c*^2.

    The pericentre is at the anomaly 0; the eccentricity is the relative amplitude of u about its mean.
    """
    inverse = sp.Function("u")
    mean = gravity / areal**2
    start = {inverse(0): mean * (1 + eccentricity), inverse(anomaly).diff(anomaly).subs(anomaly, 0): 0}
    orbit = sp.dsolve(inverse(anomaly).diff(anomaly, 2) + inverse(anomaly) - mean, ics=start)
    return sp.factor(orbit.rhs), mean


def target_radius() -> sp.Expr:
    """r* = p*/(1 + e* cos phi*), (5), with p* = c*^2/fM."""
    inverse, _ = conic()
    return sp.factor(1 / inverse.subs(gravity, GAUSS))


def anomaly_rate() -> sp.Expr:
    """phi*' = c*/r*^2, (3)."""
    return areal / target_radius() ** 2


def target_radial_velocity() -> sp.Expr:
    """v1* = dr*/dt, (5)."""
    return sp.simplify(target_radius().diff(anomaly) * anomaly_rate())


def target_attitude() -> sp.Matrix:
    """lambda* = Lambda* o [cos(phi*/2) + i3 sin(phi*/2)], (6): the orbit's axes rotated by the anomaly."""
    return product(orientation, turn(EZ, anomaly))


def orientation_from_angles(node: sp.Expr, inclination: sp.Expr, pericentre: sp.Expr) -> sp.Matrix:
    """Lambda* of the node, the inclination and the pericentre's argument: rotations about axes 3, 1, 3."""
    return product(turn(EZ, node), turn(EX, inclination), turn(EZ, pericentre))


def cartesian() -> tuple[sp.Matrix, sp.Matrix]:
    """Position and velocity in inertial axes, as functions of r, v1, c and lambda."""
    return rotated(r * EX, attitude), rotated(v1 * EX + c / r * EY, attitude)


def attitude_mismatch() -> sp.Matrix:
    """vect(lambda~ o lambda*) of (6) at the meeting, three components."""
    return vect(product(conjugate(attitude), target_attitude()))


def boundary() -> sp.Matrix:
    """r - r*, v1 - v1* and c - c* of (5)."""
    return sp.Matrix([r - target_radius(), v1 - target_radial_velocity(), c - areal])
