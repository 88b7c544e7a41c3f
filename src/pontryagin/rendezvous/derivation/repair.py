"""The part of (6) that (15) loses, and one quadrature that restores it.

A rotation of lambda about nu* does not change nu* = lambda o nu o lambda~, so (15) does not determine the
attitude. Let T(nu) be the shortest rotation that carries i3 to nu/|nu|, and S the one that carries i3 to
nu*/|nu*|. Then S~ o lambda o T(nu) leaves i3 fixed: it is the rotation by an angle chi about i3, and

    lambda = S o [cos(chi/2) + i3 sin(chi/2)] o T(nu)~.

chi is the coordinate of the attitude that the ten equations do not contain; its rate is the eleventh
equation. T is singular at nu3 = -|nu|. The second chart starts from -i3 in place of i3 and is singular at
nu3 = |nu|.

paper   here      meaning
------  --------  ---------------------------------------------------------------------
|nu|    length    length of the vector nu, constant
-       chi       angle about nu*
-       chart     +1, regular except at nu3 = -|nu|; -1, except at nu3 = |nu|
"""

from functools import cache
from typing import Literal

import sympy as sp

from pontryagin.rendezvous.derivation import model, principle, reduction
from pontryagin.rendezvous.derivation.model import EZ, attitude
from pontryagin.rendezvous.derivation.principle import nu
from pontryagin.rendezvous.derivation.quaternion import conjugate, product, pure, turn, vect
from pontryagin.rendezvous.derivation.symbols import Symbol

Chart = Literal[1, -1]

chi = sp.Symbol("chi", real=True)
length = Symbol("|nu|", positive=True)
small_turn = sp.Matrix(sp.symbols("theta1:4", real=True))


def nearby(attitude_: sp.Matrix = attitude) -> sp.Matrix:
    """lambda followed by a small rotation, to first order."""
    return product(attitude_, sp.Matrix([1, *(small_turn / 2)]))


@cache
def change_of_mismatch() -> sp.Matrix:
    """Derivative of vect(lambda~ o lambda*) of (6) by a small rotation away from lambda = lambda*, 3 x 3."""
    mismatch = vect(product(conjugate(nearby()), attitude))
    return mismatch.jacobian(small_turn).applyfunc(principle.in_nu)


@cache
def change_of_invariant() -> sp.Matrix:
    """Derivative of lambda o nu o lambda~ of (15) by a small rotation, components in eta, 3 x 3."""
    inertial = product(nearby(), pure(nu), conjugate(nearby()))
    in_eta = vect(product(conjugate(attitude), inertial, attitude))
    return in_eta.jacobian(small_turn).subs(dict.fromkeys(small_turn, 0)).applyfunc(_with_unit_attitude)


def _with_unit_attitude(expression: sp.Expr) -> sp.Expr:
    """An expression that has |lambda|^2 or a power of it as a factor, at |lambda| = 1."""
    return sp.factor(expression).subs(attitude.dot(attitude), 1)


def shortest_turn(chart: Chart = 1) -> sp.Matrix:
    """T(nu), with a symbol for |nu|; with nu* in place of nu it is S."""
    halfway = length + chart * nu[2]
    return sp.Matrix([halfway, *(chart * EZ.cross(nu))]) / sp.sqrt(2 * length * halfway)


def attitude_of(frame: sp.Matrix, chart: Chart = 1) -> sp.Matrix:
    """lambda as a function of S, chi and nu."""
    return product(frame, turn(EZ, chi), conjugate(shortest_turn(chart)))


def chi_of(frame: sp.Matrix, attitude_: sp.Matrix = attitude) -> sp.Expr:
    """chi of S and lambda modulo 2 pi: twice the argument of the scalar part and the i3 part of S~ o lambda.

    T~ has a positive scalar part and no part along i3, so it does not change the argument.
    """
    relative = product(conjugate(frame), attitude_)
    return 2 * sp.atan2(relative[3], relative[0])


def with_length(expression: sp.Expr) -> sp.Expr:
    """An expression with |nu| written out."""
    return expression.subs(length, principle.size(nu))


@cache
def angular_velocity(chart: Chart = 1) -> sp.Matrix:
    """T~ o omega_eta o T - 2 (T~)' o T, which must equal i3 chi' at any thrust.

    It is omega_eta = 2 lambda~ o lambda' in the axes carried along by T, with lambda of `attitude_of`.
    """
    shortest, omega = shortest_turn(chart), model.motion()[1]
    rates = dict(zip(reduction.REDUCED, reduction.rates(), strict=True))
    shortest_rate = shortest.jacobian(nu) * sp.Matrix([rates[part] for part in nu])
    relative = product(conjugate(shortest), pure(omega), shortest)
    relative -= 2 * product(conjugate(shortest_rate), shortest)
    sphere = nu.dot(nu) - length**2

    def reduced(part: sp.Expr) -> sp.Expr:
        numerator, denominator = sp.fraction(sp.cancel(part))
        return sp.cancel(sp.rem(numerator, sphere, nu[1]) / denominator)

    return relative.applyfunc(reduced)


def chi_rate(chart: Chart = 1) -> sp.Expr:
    """chi' at any thrust, the eleventh equation."""
    rate, p3 = angular_velocity(chart)[3], model.thrust[2]
    return sp.factor(rate.subs(p3, 0)) + p3 * sp.factor(rate.diff(p3))
