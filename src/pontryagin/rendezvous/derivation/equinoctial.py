"""Motion in modified equinoctial elements, which are constant without thrust and regular for circles.

The rates under thrust follow from those of the angular momentum, R x p, and of the eccentricity vector,
p x C + V x (R x p), with fM = 1. With s as the independent variable, where dt/ds is that of the longitude on
the undisturbed orbit, H becomes a function that is autonomous in s and vanishes along extremals.

symbol     here       meaning
---------  ---------  --------------------------------------------------------------------------------
p          parameter  semi-latus rectum
f, g       f, g       eccentricity vector in the axes of the orbit's plane
h, k       h, k       tan(i/2) times cosine and sine of the node; singular at an inclination of 180 degrees
L          longitude  true longitude
"""

from functools import cache

import sympy as sp

parameter = sp.Symbol("p", positive=True)
f, g, h, k, longitude = sp.symbols("f g h k L", real=True)
ELEMENTS = (parameter, f, g, h, k, longitude)
COSTATES = sp.symbols("l_p l_f l_g l_h l_k l_L", real=True)
thrust = sp.Matrix(sp.symbols("p1:4", real=True))
gain, price = sp.symbols("gain price", real=True)
factors = sp.Matrix(sp.symbols("m0:3", real=True))


def plane() -> tuple[sp.Matrix, sp.Matrix, sp.Matrix]:
    """Axes of the orbit's plane, from which the longitude is counted, and its normal."""
    size = 1 + h**2 + k**2
    first = sp.Matrix([1 + h**2 - k**2, 2 * h * k, -2 * k]) / size
    second = sp.Matrix([2 * h * k, 1 - h**2 + k**2, 2 * h]) / size
    return first, second, sp.Matrix([2 * k, -2 * h, 1 - h**2 - k**2]) / size


def nearness() -> sp.Expr:
    """p/r = 1 + f cos L + g sin L."""
    return 1 + f * sp.cos(longitude) + g * sp.sin(longitude)


def place(near: sp.Expr | None = None) -> tuple[sp.Matrix, sp.Matrix]:
    """R and V, with p/r as a symbol if one is given."""
    first, second, _ = plane()
    cos, sin = sp.cos(longitude), sp.sin(longitude)
    position = parameter / (near or nearness()) * (cos * first + sin * second)
    velocity = (-(sin + g) * first + (cos + f) * second) / sp.sqrt(parameter)
    return position, velocity


def axes() -> sp.Matrix:
    """The radial, transverse and normal axes as columns."""
    first, second, normal = plane()
    cos, sin = sp.cos(longitude), sp.sin(longitude)
    return sp.Matrix.hstack(cos * first + sin * second, cos * second - sin * first, normal)


def reduced(expression: sp.Expr) -> sp.Expr:
    """An expression as a fraction in lowest terms, with sin^2 written as 1 - cos^2."""
    root, cos, sin = sp.symbols("root cos sin", positive=True)
    names = {sp.cos(longitude): cos, sp.sin(longitude): sin, parameter: root**2}
    upper, lower = sp.fraction(sp.together(expression.subs(names)))
    upper, lower = (sp.rem(sp.expand(part), sin**2 + cos**2 - 1, sin) for part in (upper, lower))
    back = {cos: sp.cos(longitude), sin: sp.sin(longitude), root: sp.sqrt(parameter)}
    return sp.factor(sp.cancel(upper / lower)).subs(back)


def _in_plane_axes(vector: sp.Matrix) -> sp.Matrix:
    """Components of a vector along the axes of the plane and its normal."""
    return sp.Matrix([reduced(vector.dot(axis)) for axis in plane()])


def coasting_rate() -> sp.Expr:
    """dL/dt without thrust."""
    return nearness() ** 2 / parameter ** sp.Rational(3, 2)


@cache
def rates() -> sp.Matrix:
    """Rates of the six elements under the thrust p, given in radial, transverse and normal components."""
    first, second, normal = plane()
    near = sp.Symbol("w", positive=True)
    position, velocity = place(near)
    force = axes() * thrust
    of_p, of_f, of_g, of_h, of_k, of_L = unknown = sp.symbols("r_p r_f r_g r_h r_k r_L", real=True)

    def rate(vector: sp.Matrix) -> sp.Matrix:
        return vector.diff(parameter) * of_p + vector.diff(h) * of_h + vector.diff(k) * of_k

    momentum = sp.sqrt(parameter) * normal
    turning = position.cross(force)
    found = sp.solve([*_in_plane_axes(rate(momentum) - turning)], [of_p, of_h, of_k], dict=True)[0]
    pull = force.cross(momentum) + velocity.cross(turning)
    eccentric = of_f * first + of_g * second + f * rate(first) + g * rate(second)
    found |= sp.solve([*_in_plane_axes(eccentric - pull)[:2]], [of_f, of_g], dict=True)[0]
    found[of_L] = near**2 / parameter ** sp.Rational(3, 2) - rate(first).dot(second)
    each = sp.Matrix([_by_thrust(one.subs(found).subs(found)) for one in unknown])
    return each.subs(near, nearness())


def _by_thrust(rate: sp.Expr) -> sp.Expr:
    """A rate, which is linear in the thrust, with each coefficient reduced."""
    constant = rate.subs(dict.fromkeys(thrust, 0))
    return reduced(constant) + sum(reduced(rate.diff(part)) * part for part in thrust)


@cache
def switching() -> sp.Matrix:
    """n, the factor of the thrust in H, in radial, transverse and normal components."""
    return (sp.Matrix([COSTATES]) * rates().jacobian(thrust)).T


def regular_hamiltonian() -> sp.Expr:
    """K = (S(|n|^2) + c) dt/ds + l_L, zero along extremals; c is minus the value of H, less alpha1.

    S is the largest value of (n, p) - alpha2 p^2 over the admissible thrusts.
    """
    return (gain + price) / coasting_rate() + COSTATES[-1]


def slopes(expression: sp.Expr) -> dict[int, sp.Expr]:
    """First derivatives of an expression in elements and costates that do not vanish, by the index."""
    found = {i: expression.diff(x) for i, x in enumerate([*ELEMENTS, *COSTATES])}
    return {i: slope for i, slope in found.items() if slope != 0}


def curvatures(expression: sp.Expr) -> dict[tuple[int, int], sp.Expr]:
    """Second derivatives in elements and costates that do not vanish, by both indices in ascending order."""
    firsts = slopes(expression)
    return {(i, j): second for i in firsts for j, second in slopes(firsts[i]).items() if i <= j}


def switching_curvatures() -> dict[tuple[int, int], sp.Expr]:
    """Second derivatives of (m, n) for a constant m."""
    return curvatures(factors.dot(switching()))
