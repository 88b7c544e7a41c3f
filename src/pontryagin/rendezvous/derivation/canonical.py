"""A second derivation of the 16 equations: the costates are transformed from Cartesian coordinates.

R and V together are a function X of x = (r, v1, c, lambda). The costate of x for which (psi, dX) is invariant
is (dX/dx)' psi; its rate follows from Newton's law for x and the canonical equations for psi. Here too the
thrust is given by its components in eta, whose axes are functions of R and V, so both problems have the same
controls. nu0 is 0, since X does not depend on a scalar factor of lambda.

The equations are compared at rational points r, v1, c, lambda with |lambda| = 1, so that no roots occur; psi
and the thrust remain symbols.

paper     here                    meaning
--------  ----------------------  -----------------------------------------------------------
R, V      position, velocity      of `inertial`, with psi_R and psi_V; together X
eta       axes                    matrix of eta1, eta2, eta3, as functions of R and V
"""

from functools import cache

import sympy as sp

from pontryagin.rendezvous.derivation import forms, inertial, model, principle
from pontryagin.rendezvous.derivation.inertial import force, position, position_costate, velocity
from pontryagin.rendezvous.derivation.model import attitude, c, r, thrust, v1

Point = dict[sp.Symbol, sp.Rational]

PSI = sp.Matrix([*position_costate, *inertial.velocity_costate])
MOVING = (r, v1, c, *attitude)
"""The state x without phi*."""
step = sp.Symbol("h", real=True)


def axes(place: sp.Matrix) -> sp.Matrix:
    """eta1 along R, eta3 along R x V and eta2 = eta3 x eta1 as columns, functions of X."""
    radius, normal = place[:3, :], place[:3, :].cross(place[3:, :])
    first, third = radius / principle.size(radius), normal / principle.size(normal)
    return sp.Matrix.hstack(first, third.cross(first), third)


def hamiltonian(place: sp.Matrix) -> sp.Expr:
    """H at X in terms of psi, without the term of phi*, at a thrust with given components in eta."""
    names = dict(zip((*position, *velocity, *force), (*place, *(axes(place) * thrust)), strict=True))
    return inertial.hamiltonian().subs(names)


@cache
def place_and_velocity() -> sp.Matrix:
    """X as a function of r, v1, c and lambda, (6,); it does not depend on the length of lambda."""
    return sp.Matrix([part for vector in model.cartesian() for part in vector]) / attitude.dot(attitude)


@cache
def costates() -> sp.Matrix:
    """rho, s1, e and mu as functions of psi_R and psi_V, (7,)."""
    return place_and_velocity().jacobian(MOVING).T * PSI


def in_psi(expressions: sp.Matrix, point: Point) -> sp.Matrix:
    """Functions of x and its costates at a point, in terms of psi."""
    names = (principle.rho, principle.s1, principle.e, *principle.mu)
    return expressions.subs(point).subs(dict(zip(names, costates().subs(point), strict=True)))


def _moving(rates: sp.Matrix) -> sp.Matrix:
    """The rates of r, v1, c and lambda among the eight of the state, or those of their costates."""
    return sp.Matrix([*rates[:3], *rates[4:]])


def _along(expressions: sp.Matrix, point: Point, rates: sp.Matrix) -> sp.Matrix:
    """d/dt of functions of x at a point where x has the given rates."""
    shifted = {x: point[x] + step * rate for x, rate in zip(MOVING, rates, strict=True)}
    return expressions.subs(shifted, simultaneous=True).diff(step).subs(step, 0)


def state_gap(point: Point) -> sp.Matrix:
    """X' by (2) and (3) minus dH/dpsi, (6,)."""
    energy = hamiltonian(place_and_velocity().subs(point))
    newton = sp.Matrix([energy.diff(x) for x in PSI])
    rates = _moving(principle.state_rates()).subs(point)
    return (_along(place_and_velocity(), point, rates) - newton).applyfunc(sp.expand)


def costate_gap(point: Point) -> sp.Matrix:
    """d/dt of (dX/dx)' psi along the canonical equations in R and V, minus -dH/dx in 16 dimensions, (7,)."""
    place = place_and_velocity().subs(point)
    nearby = [hamiltonian(place + step * sp.eye(6)[:, k]) for k in range(6)]
    psi_rates = -sp.Matrix(nearby).diff(step).subs(step, 0)
    carried = place_and_velocity().jacobian(MOVING).subs(point).T * psi_rates
    transported = _along(costates(), point, _moving(principle.state_rates()).subs(point))
    return (transported + carried - in_psi(_moving(principle.costate_rates()), point)).applyfunc(sp.expand)


def hamiltonian_gap(point: Point) -> sp.Expr:
    """H in 16 dimensions minus H in R and V: the term of phi*, which is Phi* phi*'."""
    energy = in_psi(sp.Matrix([principle.hamiltonian()]), point)[0]
    return sp.expand(energy - hamiltonian(place_and_velocity().subs(point)))


def optimal_gap(mode: principle.Mode, point: Point, psi: Point) -> sp.Matrix:
    """Rates of X and of (dX/dx)' psi by `forms.full`, minus those by `inertial.cartesian`, (13,).

    Each system has its own optimal thrust. `psi` must have a rational |psi_V|.
    """
    sixteen, twelve = forms.full(mode), inertial.cartesian(mode)
    rates = in_psi(sp.Matrix(sixteen.rates), point).subs(psi)
    names = dict(zip((*position, *velocity), place_and_velocity().subs(point), strict=True)) | psi
    newton = sp.Matrix(twelve.rates).subs(names)
    moving = _moving(rates[:8, :])
    carried = place_and_velocity().jacobian(MOVING).subs(point).T * newton[6:, :]
    transported = _along(costates().subs(psi), point, moving)
    states = _along(place_and_velocity(), point, moving) - newton[:6, :]
    gap = sp.Matrix([*states, *(transported + carried - _moving(rates[8:, :]))])
    return gap.applyfunc(sp.expand)
