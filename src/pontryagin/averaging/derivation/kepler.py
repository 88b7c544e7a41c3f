"""From Newton's equations to osculating elements (Akulenko 1977, section 3, example 2), in SymPy.

In the units used the gravitational parameter is 1. The state is (r, phi, v_r, v_phi); the control is the
radial and transverse thrust (u_r, u_phi), which enters multiplied by epsilon.

    paper       here                  meaning
    E, K        energy, momentum      energy < 0 and angular momentum > 0
    e, gamma    e, gamma              eccentricity and direction of the pericentre
    p           parameter()           focal parameter K^2
    x, xi, psi  anomaly, eccentric,   true, eccentric and mean anomaly; psi is the rotating phase
                mean_anomaly()
"""

import functools
from typing import NamedTuple

import sympy as sp

t, phi, gamma, anomaly, eccentric = sp.symbols("t phi gamma x xi", real=True)
r, e, epsilon = sp.symbols("r e epsilon", positive=True)
v_radial, v_transverse = sp.symbols("v_r v_phi", real=True)
u_radial, u_transverse = sp.symbols("u_r u_phi", real=True)
energy = sp.Symbol("E", negative=True)
momentum = sp.Symbol("K", positive=True)

STATE = sp.ImmutableMatrix([r, phi, v_radial, v_transverse])
CONTROL = sp.ImmutableMatrix([u_radial, u_transverse])


@functools.cache
def equations_of_motion() -> sp.ImmutableMatrix:
    """(r', phi', v_r', v_phi') under gravity and thrust, (3.3), from Newton's law in the plane."""
    radius, angle = sp.Function("r")(t), sp.Function("phi")(t)
    along = sp.Matrix([sp.cos(angle), sp.sin(angle)])
    across = sp.Matrix([-sp.sin(angle), sp.cos(angle)])
    place = radius * along
    velocity = place.diff(t)
    force = -place / radius**3 + epsilon * (u_radial * along + u_transverse * across)
    speeds = [sp.simplify(velocity.dot(direction)) for direction in (along, across)]
    first = sp.solve(
        [speeds[0] - v_radial, speeds[1] - v_transverse], [radius.diff(t), angle.diff(t)], dict=True
    )[0]
    balance = [sp.simplify((velocity.diff(t) - force).dot(direction)) for direction in (along, across)]
    second = sp.solve(balance, [radius.diff(t, 2), angle.diff(t, 2)], dict=True)[0]
    rates = [first[radius.diff(t)], first[angle.diff(t)]]
    rates += [speed.diff(t).subs(second).subs(first) for speed in speeds]
    return sp.ImmutableMatrix([sp.expand(sp.simplify(rate.subs({radius: r, angle: phi}))) for rate in rates])


def along_the_motion(quantity: sp.Expr) -> sp.Expr:
    """Rate of a function of the state along the motion under thrust."""
    gradient = sp.Matrix([quantity]).jacobian(STATE)
    return sp.simplify((gradient * equations_of_motion())[0])


def energy_of_state() -> sp.Expr:
    """E of (3.4): the kinetic energy minus 1/r."""
    return (v_radial**2 + v_transverse**2) / 2 - 1 / r


def momentum_of_state() -> sp.Expr:
    """K of (3.4): r times the transverse speed."""
    return r * v_transverse


def laplace_in_the_orbit() -> sp.Matrix:
    """Laplace's vector v x K - r/|r| along and across the radius."""
    speed, K = sp.Matrix([v_radial, v_transverse]), momentum_of_state()
    return sp.Matrix([speed[1] * K - 1, -speed[0] * K])


def laplace() -> sp.Matrix:
    """Laplace's vector in fixed axes; it points to the pericentre and is constant without thrust."""
    return sp.rot_ccw_axis3(phi)[:2, :2] * laplace_in_the_orbit()


@functools.cache
def conic() -> sp.Dict:
    """r, v_r and v_phi as functions of K, e and x: the orbit of (3.4).

    Laplace's vector, of length e and at the angle -x to the radius, is solved for r, v_r and v_phi.
    """
    vector = laplace_in_the_orbit()
    conditions = [
        vector[0] - e * sp.cos(anomaly),
        vector[1] + e * sp.sin(anomaly),
        momentum_of_state() - momentum,
    ]
    found = sp.solve(conditions, [r, v_radial, v_transverse], dict=True)
    return sp.Dict({left: sp.simplify(right) for left, right in found[0].items()})


def parameter() -> sp.Expr:
    """The focal parameter p = K^2: the radius at a right angle from the pericentre."""
    return conic()[r].subs(anomaly, sp.pi / 2)


def on_the_orbit(quantity: sp.Expr) -> sp.Expr:
    """A function of the state in terms of K, e, x and gamma."""
    return sp.simplify(quantity.subs(phi, gamma + anomaly).subs(conic()))


@functools.cache
def eccentricity() -> sp.Expr:
    """e in terms of E and K, from the energy on the orbit."""
    solutions = sp.solve(on_the_orbit(energy_of_state()) - energy, e**2)
    return sp.sqrt(sp.expand(solutions[0]))


def in_slow_variables(expression: sp.Expr) -> sp.Expr:
    """An expression with e replaced by its value in terms of E and K."""
    return expression.subs(e, eccentricity())


def affine(rate: sp.Expr) -> sp.Expr:
    """A rate under thrust, with factored coefficients of the control and cos^2 x in place of 1 - sin^2 x."""
    coefficients = [sp.expand_trig(sp.expand(rate).coeff(u)) for u in CONTROL]
    square = {sp.sin(anomaly) ** 2: 1 - sp.cos(anomaly) ** 2}
    return sum(
        (sp.factor(sp.expand(c).subs(square)) * u for c, u in zip(coefficients, CONTROL, strict=True)),
        sp.S.Zero,
    )


@functools.cache
def element_rates() -> sp.Dict:
    """E', K', e', gamma' under thrust, (3.6) and below it; p' is 2 K K'. Keys: E, K, e, gamma.

    Of the rate of Laplace's vector the component along the vector is e', the component across it e gamma'.
    Both are found in the axes along and across the radius, which turn at the rate phi'.
    """
    motion, vector = equations_of_motion(), laplace_in_the_orbit()
    rate = vector.jacobian(STATE) * motion + motion[1] * sp.Matrix([-vector[1], vector[0]])
    integrals = sp.Matrix([energy_of_state(), momentum_of_state()]).jacobian(STATE) * motion
    rates = {
        energy: integrals[0],
        momentum: integrals[1],
        e: vector.dot(rate) / e,
        gamma: (vector[0] * rate[1] - vector[1] * rate[0]) / e**2,
    }
    return sp.Dict({element: affine(sp.cancel(rate.subs(conic()))) for element, rate in rates.items()})


@functools.cache
def anomaly_rate() -> sp.Expr:
    """x' = phi' - gamma' without thrust: K/r^2."""
    return on_the_orbit(equations_of_motion()[1])


@functools.cache
def eccentric_anomaly() -> sp.Expr:
    """cos xi as a function of e and x, from the two forms of r in (3.4)."""
    xi_cosine = sp.Symbol("c")
    ring = ellipse_radius().subs(sp.cos(eccentric), xi_cosine)
    semi_major = (1 - e**2) / momentum**2
    condition = ring.subs(energy, -semi_major / 2) - conic()[r]
    return sp.factor(sp.solve(condition, xi_cosine)[0])


@functools.cache
def ellipse_radius() -> sp.Expr:
    """r as a function of E, e and xi, (3.4): linear in cos xi, with v_r = 0 at cos xi = 1 and at -1."""
    turning = sp.solve((energy_of_state() - energy).subs({v_radial: 0, v_transverse: momentum / r}), r)
    ends = [sp.simplify(root.subs(momentum, sp.sqrt((e**2 - 1) / (2 * energy)))) for root in turning]
    near, far = sorted(ends, key=lambda end: end.subs({energy: -1, e: sp.Rational(1, 2)}))
    return sp.simplify((near + far) / 2 - (far - near) / 2 * sp.cos(eccentric))


@functools.cache
def time_of_flight() -> sp.Expr:
    """t + delta as a function of E, e and xi, (3.4): the integral of dr/v_r from the pericentre."""
    square = 2 * (energy + 1 / r) - (momentum / r) ** 2
    square = square.subs(momentum, sp.sqrt((e**2 - 1) / (2 * energy))).subs(r, ellipse_radius())
    slope_squared = sp.simplify(ellipse_radius().diff(eccentric) ** 2 / sp.factor(sp.simplify(square)))
    slope = ellipse_radius() / sp.sqrt(-2 * energy)
    if sp.simplify(slope_squared - slope**2) != 0:
        raise ArithmeticError("dt/dxi is not r (2|E|)^(-1/2)")
    return sp.integrate(sp.expand(slope), (eccentric, 0, eccentric))


def period() -> sp.Expr:
    """The period T(E), in which xi and x grow by 2 pi."""
    return sp.simplify(time_of_flight().subs(eccentric, 2 * sp.pi))


def mean_motion() -> sp.Expr:
    """omega(E) = 2 pi/T, the rate of psi without thrust."""
    return sp.simplify(2 * sp.pi / period())


@functools.cache
def weight() -> sp.Expr:
    """dpsi/dx at fixed elements, the mean motion divided by x', as a function of e and x."""
    motion = mean_motion().subs(energy, (e**2 - 1) / (2 * momentum**2))
    return sp.powsimp(sp.simplify(motion / anomaly_rate()))


class OrbitModel(NamedTuple):
    """Example 2 as a system in (E, K) and the true anomaly x: what `model` returns."""

    slow: tuple[sp.Symbol, ...]
    control: tuple[sp.Symbol, ...]
    anomaly: sp.Symbol
    rates: sp.ImmutableMatrix
    mean_motion: sp.Expr
    weight: sp.Expr
    anomaly_rate: sp.Expr
    phase_rate: sp.Expr


@functools.cache
def model() -> OrbitModel:
    """E' = eps rates, x' = mean_motion/weight + eps phase_rate: example 2 as `PhaseSystem` takes it.

    The symbols are `slow` = (E < 0, K > 0), `control` = (u_r, u_phi) and `anomaly` = x, real, the true
    anomaly; psi, the mean anomaly, has dpsi/dx = `weight`. `rates` (2, 1) and `phase_rate` = -gamma'/eps
    are affine in the control; `anomaly_rate` is x' without thrust, the same as mean_motion/weight. The
    eccentricity is written as sqrt(1 + 2 E K^2); where it vanishes, on the circle, `phase_rate` is undefined.
    """
    rates = element_rates()
    slow = sp.Matrix([affine(rates[energy] / epsilon), affine(rates[momentum] / epsilon)])
    return OrbitModel(
        slow=(energy, momentum),
        control=(u_radial, u_transverse),
        anomaly=anomaly,
        rates=sp.ImmutableMatrix(slow.applyfunc(in_slow_variables)),
        mean_motion=mean_motion(),
        weight=in_slow_variables(weight()),
        anomaly_rate=in_slow_variables(anomaly_rate()),
        phase_rate=in_slow_variables(affine(-rates[gamma] / epsilon)),
    )
