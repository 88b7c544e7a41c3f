"""What (15) loses of (6), and one quadrature that restores it.

nu* = lambda o nu o lambda~ stays as it is when lambda is turned about nu*: (15) cannot fix the attitude. Let
T(nu) be the shortest turn that carries i3 to nu/|nu|, and S the one that carries i3 to nu*/|nu*|. Then
S~ o lambda o T(nu) leaves i3 where it is: it is the turn by an angle chi about i3, and

    lambda = S o [cos(chi/2) + i3 sin(chi/2)] o T(nu)~.

chi is the one coordinate of the attitude that the ten equations do not have; its rate is the eleventh.
T is singular at nu3 = -|nu|. The second chart starts from -i3 in place of i3 and is singular at nu3 = |nu|.

paper   here      meaning
------  --------  ---------------------------------------------------------------------
|nu|    length    length of the vector nu, constant
-       chi       angle about nu*
-       chart     +1, regular off nu3 = -|nu|; -1, regular off nu3 = |nu|
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
    """lambda followed by a small turn, to first order."""
    return product(attitude_, sp.Matrix([1, *(small_turn / 2)]))


@cache
def change_of_mismatch() -> sp.Matrix:
    """How vect(lambda~ o lambda*) of (6) changes with a small turn away from lambda = lambda*: 3 x 3."""
    mismatch = vect(product(conjugate(nearby()), attitude))
    return mismatch.jacobian(small_turn).applyfunc(principle.in_nu)


@cache
def change_of_invariant() -> sp.Matrix:
    """How lambda o nu o lambda~ of (15) changes with a small turn, seen in eta: 3 x 3."""
    there = product(nearby(), pure(nu), conjugate(nearby()))
    back = vect(product(conjugate(attitude), there, attitude))
    return back.jacobian(small_turn).subs(dict.fromkeys(small_turn, 0)).applyfunc(_with_unit_attitude)


def _with_unit_attitude(expression: sp.Expr) -> sp.Expr:
    """A multiple of |lambda|^4, at |lambda| = 1."""
    return sp.factor(expression).subs(attitude.dot(attitude), 1)


def shortest_turn(chart: Chart = 1) -> sp.Matrix:
    """T(nu), with |nu| a symbol of its own; for nu* in place of nu it is S."""
    halfway = length + chart * nu[2]
    return sp.Matrix([halfway, *(chart * EZ.cross(nu))]) / sp.sqrt(2 * length * halfway)


def attitude_of(frame: sp.Matrix, chart: Chart = 1) -> sp.Matrix:
    """lambda of S, chi and nu."""
    return product(frame, turn(EZ, chi), conjugate(shortest_turn(chart)))


def chi_of(frame: sp.Matrix, attitude_: sp.Matrix = attitude) -> sp.Expr:
    """chi = 2 arg(S~ o lambda), the argument of its scalar part and its part along i3; modulo 2 pi.

    T~ has a positive scalar part and no part along i3, and does not enter.
    """
    relative = product(conjugate(frame), attitude_)
    return 2 * sp.atan2(relative[3], relative[0])


def with_length(expression: sp.Expr) -> sp.Expr:
    """|nu| written out."""
    return expression.subs(length, principle.size(nu))


@cache
def turning(chart: Chart = 1) -> sp.Matrix:
    """T~ o omega_eta o T - 2 (T~)' o T: what must be i3 chi', for any thrust.

    It is 2 lambda~ o lambda' = omega_eta, with lambda of `attitude_of`, seen through T.
    """
    shortest, omega = shortest_turn(chart), model.motion()[1]
    rates = dict(zip(reduction.REDUCED, reduction.rates(), strict=True))
    changing = shortest.jacobian(nu) * sp.Matrix([rates[part] for part in nu])
    whole = product(conjugate(shortest), pure(omega), shortest) - 2 * product(conjugate(changing), shortest)
    sphere = nu.dot(nu) - length**2

    def reduced(part: sp.Expr) -> sp.Expr:
        numerator, denominator = sp.fraction(sp.cancel(part))
        return sp.cancel(sp.rem(numerator, sphere, nu[1]) / denominator)

    return whole.applyfunc(reduced)


def chi_rate(chart: Chart = 1) -> sp.Expr:
    """chi' at any thrust, the eleventh equation."""
    rate, p3 = turning(chart)[3], model.thrust[2]
    return sp.factor(rate.subs(p3, 0)) + p3 * sp.factor(rate.diff(p3))
