"""The maximum principle in Cartesian coordinates and inertial axes, independent of the rotating axes.

H = -(alpha1 + alpha2 p^2) + (psi_R, V) + (psi_V, p - fM R/r^3). Neither eta nor lambda nor a chart is used,
and only the centre of attraction is singular.

paper   here                meaning
------  ------------------  --------------------------------------------------
R, V    position, velocity  three components each, in inertial axes
-       position_costate    psi_R
n       velocity_costate    psi_V, Lawden's primer vector; the thrust lies along it
"""

from functools import cache

import sympy as sp

from pontryagin.rendezvous.derivation import principle
from pontryagin.rendezvous.derivation.forms import Form
from pontryagin.rendezvous.derivation.model import gravity
from pontryagin.rendezvous.derivation.principle import Mode

position, velocity = sp.Matrix(sp.symbols("x y z", real=True)), sp.Matrix(sp.symbols("u v w", real=True))
position_costate = sp.Matrix(sp.symbols("psi_x psi_y psi_z", real=True))
velocity_costate = sp.Matrix(sp.symbols("psi_u psi_v psi_w", real=True))
force = sp.Matrix(sp.symbols("f_x f_y f_z", real=True))
gain, price = sp.symbols("gain price", real=True)
factors = sp.Matrix(sp.symbols("m0:3", real=True))


def attraction() -> sp.Matrix:
    """The acceleration without thrust."""
    return -gravity * position / principle.size(position) ** 3


def coasting() -> sp.Expr:
    """H without thrust and without costs."""
    return position_costate.dot(velocity) + velocity_costate.dot(attraction())


def hamiltonian() -> sp.Expr:
    """H without the term of phi*, at any thrust."""
    cost = principle.time_weight + principle.energy_weight * force.dot(force)
    return -cost + position_costate.dot(velocity) + velocity_costate.dot(force + attraction())


def pace() -> sp.Expr:
    """dt/ds of an independent variable s that runs by one radian in the time of a circle at this distance."""
    return principle.size(position) ** sp.Rational(3, 2) / sp.sqrt(gravity)


def regular_hamiltonian() -> sp.Expr:
    """K = (S(|n|^2) + c + `coasting`) dt/ds, zero along extremals; c is minus the value of H, less alpha1.

    S is the largest value of (n, p) - alpha2 p^2 over the admissible thrusts.
    """
    return (gain + price + coasting()) * pace()


def slopes(value: sp.Expr) -> list[sp.Expr]:
    """Derivatives in x, y and z."""
    return [value.diff(x) for x in position]


def curvatures(value: sp.Expr) -> list[sp.Expr]:
    """Second derivatives in x, y and z: xx, xy, xz, yy, yz, zz."""
    return [value.diff(position[i], position[j]) for i in range(3) for j in range(i, 3)]


def thrust(mode: Mode) -> sp.Matrix:
    """The thrust that maximises H: psi_V/(2 alpha2), or p_max psi_V/|psi_V|."""
    if mode == "unsaturated":
        return velocity_costate / (2 * principle.energy_weight)
    return principle.peak * velocity_costate / principle.size(velocity_costate)


@cache
def cartesian(mode: Mode) -> Form:
    """The canonical equations of the 12 variables, with the optimal thrust."""
    states, costates = [*position, *velocity], [*position_costate, *velocity_costate]
    rates = [*(hamiltonian().diff(x) for x in costates), *(-hamiltonian().diff(x) for x in states)]
    optimal = dict(zip(force, thrust(mode), strict=True))
    scale = principle.energy_weight if mode == "unsaturated" else principle.peak
    return Form((*states, *costates), tuple(rate.subs(optimal) for rate in rates), (gravity, scale))
