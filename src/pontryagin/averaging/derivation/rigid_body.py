"""Example 3, a symmetric rigid body: from Euler's equations to the averaged system (Akulenko 1977, (3.10)).

here            meaning
--------------  ----------------------------------------------------------------------------
w               angular rate (w_x, w_y, w_z) in the principal axes; I its moments of inertia
u               control torques over the moments of inertia, per epsilon
d               I_z / I_x of the symmetric body
a, c, psi       a = sqrt(w_x^2 + w_y^2), c = w_z, and the angle of (w_x, w_y): the phase
p_a, p_c, p_psi their costates; the costate of the cost is -1
lx, ly, lz      semi-axes of the ellipsoid of controls; l, h radius and half-height of the cylinder

Rates of the slow variables are per epsilon; psi' = (d - 1) c + epsilon F.
"""

from functools import cache

import sympy as sp

w = sp.Matrix(sp.symbols("omega_x omega_y omega_z", real=True))
u = sp.Matrix(sp.symbols("u_x u_y u_z", real=True))
moments = sp.Matrix(sp.symbols("I_x I_y I_z", positive=True))
d = sp.Symbol("d", positive=True)
epsilon = sp.Symbol("epsilon", positive=True)
a = sp.Symbol("a", positive=True)
c, psi, p_a, p_c, p_psi = sp.symbols("c psi p_a p_c p_psi", real=True)
semiaxes = lx, ly, lz = sp.symbols("l_x l_y l_z", positive=True)
l, h = sp.symbols("l h", positive=True)
alpha, beta = sp.symbols("alpha beta", real=True)

POLAR = {w[0]: a * sp.cos(psi), w[1]: a * sp.sin(psi), w[2]: c}
SYMMETRIC = {moments[1]: moments[0], moments[2]: d * moments[0]}
NEARLY_SYMMETRIC = {
    moments[0]: moments[2] / d * (1 + epsilon * alpha),
    moments[1]: moments[2] / d * (1 + epsilon * beta),
}
"""Equatorial moments whose relative differences from I_z / d are epsilon alpha and epsilon beta."""


@cache
def euler_rates() -> sp.ImmutableMatrix:
    """w' in the principal axes of any body, from (I w)' + w x I w = epsilon I u."""
    inertia = sp.diag(*moments)
    return sp.ImmutableMatrix((epsilon * u - inertia.inv() * w.cross(inertia * w)).applyfunc(sp.simplify))


@cache
def symmetric_rates() -> sp.ImmutableMatrix:
    """w' for I_x = I_y, I_z = d I_x."""
    return euler_rates().subs(SYMMETRIC).applyfunc(lambda rate: sp.expand(sp.simplify(rate)))


def in_polar(rates: sp.Matrix) -> sp.Matrix:
    """(a', c', psi') of given w'."""
    unit, across = sp.Matrix([sp.cos(psi), sp.sin(psi)]), sp.Matrix([-sp.sin(psi), sp.cos(psi)])
    equatorial = sp.Matrix(rates[:2]).subs(POLAR)
    polar = sp.Matrix([equatorial.dot(unit), rates[2].subs(POLAR), equatorial.dot(across) / a])
    return polar.applyfunc(lambda rate: sp.expand(sp.simplify(sp.expand(rate))))


@cache
def polar_rates() -> sp.ImmutableMatrix:
    """(a', c', psi') of the symmetric body."""
    return sp.ImmutableMatrix(in_polar(symmetric_rates()))


def slow_rates() -> sp.Matrix:
    """(a', c') per epsilon: the f of (1.1)."""
    return sp.expand(sp.Matrix(polar_rates()[:2, :]) / epsilon)


def anomaly_rate() -> sp.Expr:
    """psi' at epsilon = 0, (d - 1) c: the frequency, of either sign."""
    return sp.factor(polar_rates()[2].subs(epsilon, 0))


def phase_rate() -> sp.Expr:
    """F: psi' - (d - 1) c per epsilon."""
    return sp.expand((polar_rates()[2] - anomaly_rate()) / epsilon)


@cache
def asymmetry() -> sp.ImmutableMatrix:
    """Terms that asymmetry adds to (a', c', psi'), per epsilon as epsilon -> 0, without control."""
    free = euler_rates().subs(NEARLY_SYMMETRIC).subs(dict.fromkeys(u, 0))
    return sp.ImmutableMatrix(in_polar(free.diff(epsilon).subs(epsilon, 0)).applyfunc(sp.simplify))


def switching() -> sp.Matrix:
    """s, the coefficient of u in p_a a' + p_c c' + p_psi psi', per epsilon."""
    slow, phase = slow_rates(), phase_rate()
    return sp.Matrix([(p_a * slow[0] + p_c * slow[1] + p_psi * phase).diff(control) for control in u])


def ellipsoid_maximiser(s: sp.Matrix) -> sp.Matrix:
    """The u that maximises s.u on the ellipsoid: L L s/|L s|, L = diag(lx, ly, lz), by Cauchy and Schwarz."""
    stretched = sp.diag(*semiaxes) * s
    return sp.diag(*semiaxes) * stretched / sp.sqrt(stretched.dot(stretched))


def ellipsoid_support(s: sp.Matrix) -> sp.Expr:
    """The maximum of s.u over the ellipsoid."""
    stretched = sp.diag(*semiaxes) * s
    return sp.sqrt(stretched.dot(stretched))


def in_ellipsoid(control: sp.Matrix) -> sp.Expr:
    """u_x^2/l_x^2 + u_y^2/l_y^2 + u_z^2/l_z^2, at most 1 for an admissible control."""
    return sum(((part / axis) ** 2 for part, axis in zip(control, semiaxes, strict=True)), sp.S.Zero)


def braking() -> sp.Matrix:
    """The feedback control that lowers a fastest (p_a < 0, p_c = p_psi = 0), as a function of w."""
    s = switching().subs({p_a: -1, p_c: 0, p_psi: 0})
    feedback = {sp.cos(psi): w[0] / a, sp.sin(psi): w[1] / a}
    control = ellipsoid_maximiser(s).subs(feedback).subs(a, sp.Symbol("A", positive=True))
    return control.applyfunc(sp.simplify)


def deceleration() -> sp.Expr:
    """R(psi) = -a' per epsilon under `braking`."""
    return sp.simplify(ellipsoid_support(switching().subs({p_a: -1, p_c: 0, p_psi: 0})))


def mean_of_root(square: sp.Expr) -> sp.Expr:
    """Mean over a turn of sqrt(A (1 - k sin^2 psi)) by the complete elliptic integral E of parameter k."""
    first = square.subs(psi, 0)
    parameter = sp.factor(1 - square.subs(psi, sp.pi / 2) / first)
    if sp.simplify(square - first * (1 - parameter * sp.sin(psi) ** 2)) != 0:
        raise ArithmeticError(f"{square} is not of the form A (1 - k sin^2 psi)")
    return 2 / sp.pi * sp.sqrt(first) * sp.elliptic_e(parameter)


def mean_deceleration() -> sp.Expr:
    """<R>, real for every l_y; the parameter 1 - l_y^2/l_x^2 is between 0 and 1 where l_y <= l_x."""
    return mean_of_root(deceleration() ** 2)


def mean_deceleration_turned() -> sp.Expr:
    """<R> with psi from the y axis; the parameter 1 - l_x^2/l_y^2 is between 0 and 1 where l_x <= l_y."""
    return mean_of_root((deceleration() ** 2).subs(psi, sp.pi / 2 - psi))


def mean(quantity: sp.Expr) -> sp.Expr:
    """Average over the phase."""
    return sp.simplify(sp.integrate(sp.expand(quantity), (psi, 0, 2 * sp.pi)) / (2 * sp.pi))


def with_free_motion(rates: sp.Matrix, angle: sp.Expr) -> sp.Matrix:
    """Rate of (w_x, w_y) seen in axes turned by an angle that grows with (d - 1) w_z."""
    back = sp.Matrix([[sp.cos(angle), sp.sin(angle)], [-sp.sin(angle), sp.cos(angle)]])
    turning = (d - 1) * w[2] * back.diff(angle) * sp.Matrix(w[:2])
    return (turning + back * sp.Matrix(rates[:2])).applyfunc(sp.simplify)


def cylinder_maximiser() -> sp.Matrix:
    """u that maximises s.u over the cylinder u_x^2 + u_y^2 <= l^2, |u_z| <= h, where s does not vanish."""
    s = switching()
    across = sp.sqrt(sp.simplify(s[0] ** 2 + s[1] ** 2))
    return sp.Matrix([l * s[0] / across, l * s[1] / across, h * sp.sign(s[2])])


def cylinder_hamiltonian() -> sp.Expr:
    """H of the exact problem maximised over the cylinder, with the cost epsilon t."""
    s = switching()
    support = l * sp.sqrt(sp.simplify(s[0] ** 2 + s[1] ** 2)) + h * sp.Abs(s[2])
    return p_psi * anomaly_rate() + epsilon * (support - 1)
