"""The maximum principle in Sapunkov's elements, for both functionals.

The independent variable is the half-angle phi, and the time is one more state: A and B are constant without
thrust, and equal steps of phi are short in time where the orbit is strongly curved. phi at the meeting is
free. The running cost L(p), alpha1 + alpha2 p^2 or alpha1 + alpha2 |p|, enters as a symbol: the equations and
the integrals hold for both.

Since u has four components and the place three, a shooting method must remove three redundancies:

turn      u -> exp(i1 s) o u does not change R. Its momentum (a, i1 o A) + (b, i1 o B) is constant, and 0
          because the set of admissible ends is invariant under this change of u.
relation  scal(A~ o i1 o B) = 0 always, so its gradient may be added to the costates without changing
          the thrust.
phase     the origin of phi is arbitrary: (a, B) - (b, A) is the costate of phi.

Six numbers remain: the costates orthogonal to the directions of the turn and of the relation, which are
orthogonal to each other.

symbol      here            meaning
----------  --------------  -----------------------------------------------------------
a, b        a, b            costates of A and B
z, y        z, y            a cos phi + b sin phi, -a sin phi + b cos phi: costates of u and w
theta       time_costate    costate of the time; H = -theta
L           running_cost    alpha1 + alpha2 p^2, or alpha1 + alpha2 |p|
n           switching       the vector along which the thrust lies, in inertial axes
kappa       phase_costate   costate of phi
"""

from functools import cache
from typing import TypeVar, cast

import sympy as sp

from pontryagin.rendezvous.derivation import sapunkov
from pontryagin.rendezvous.derivation.quaternion import I1, conjugate, product, vect
from pontryagin.rendezvous.derivation.sapunkov import A, B, Q, force, half_anomaly, u, w

a, b = sp.Matrix(sp.symbols("a0:4", real=True)), sp.Matrix(sp.symbols("b0:4", real=True))
z, y = sp.Matrix(sp.symbols("z0:4", real=True)), sp.Matrix(sp.symbols("y0:4", real=True))
time_costate = sp.Symbol("theta", real=True)
running_cost = sp.Symbol("L", real=True)

T = TypeVar("T", sp.Expr, sp.Matrix)

SIN, COS = sp.sin(half_anomaly), sp.cos(half_anomaly)
SIZE = {Q: u.dot(u) + w.dot(w)}


def written_out(expression: T) -> T:
    """An expression (or a matrix) in u, w, z, y and Q in terms of A, B, a, b and phi."""
    names = sapunkov.oscillation() | {Q: A.dot(A) + B.dot(B)}
    names |= dict(zip(z, a * COS + b * SIN, strict=True)) | dict(zip(y, b * COS - a * SIN, strict=True))
    return cast(T, expression.subs(names, simultaneous=True))


def driving() -> sp.Matrix:
    """Q F1 of (1), epsilon = 1: dA/d phi = -driving sin phi, dB/d phi = driving cos phi."""
    lifted = sapunkov.lifted_force()
    return Q * (sapunkov.radius() * lifted + w.dot(lifted) * w)


def power() -> sp.Expr:
    """(a, dA/d phi) + (b, dB/d phi), linear in the thrust."""
    return driving().dot(y)


def hamiltonian() -> sp.Expr:
    """K, which is maximised over the thrust; phi is the independent variable."""
    return (time_costate - running_cost) * sapunkov.time_rate() + power()


def phase_costate() -> sp.Expr:
    """kappa = (a, B) - (b, A) in terms of z, y, w and u."""
    return z.dot(w) - y.dot(u)


def state_rates() -> sp.Matrix:
    """d/dphi of A, B and t, (1)."""
    return sp.Matrix([*(-driving() * SIN), *(driving() * COS), sapunkov.time_rate()])


def _gradients() -> tuple[sp.Matrix, sp.Matrix]:
    """Gradients of K by u and by w, with Q = u^2 + w^2 and a constant thrust."""
    K = hamiltonian()
    by_u, by_w = (sp.Matrix([K]).jacobian(list(x)).T + 2 * x * K.diff(Q) for x in (u, w))
    return by_u, by_w


def costate_rates() -> sp.Matrix:
    """d/dphi of a and b: minus the gradient of K by A and B."""
    by_u, by_w = _gradients()
    return sp.Matrix([*(by_w * SIN - by_u * COS), *(-by_u * SIN - by_w * COS)])


def oscillation_rates() -> sp.Matrix:
    """d/dphi of u, w, z and y: (1) and the costates' equations in these variables."""
    by_u, by_w = _gradients()
    return sp.Matrix([*w, *(driving() - u), *(y - by_u), *(-z - by_w)])


def rate_of(quantity: sp.Expr) -> sp.Expr:
    """d/dphi of a function of u, w, z and y, at any constant thrust; Q = u^2 + w^2."""
    gradient = sp.Matrix([quantity.subs(SIZE)]).jacobian([*u, *w, *z, *y])
    return (gradient * oscillation_rates().subs(SIZE))[0]


def time_costate_by_phase() -> sp.Expr:
    """theta from K + kappa = 0, which eliminates the weights from the equations."""
    return running_cost - (power() + phase_costate()) / sapunkov.time_rate()


def closed_costate_rates() -> sp.Matrix:
    """`costate_rates` without theta: functions of A, B, a, b, phi and the thrust."""
    return costate_rates().subs(time_costate, time_costate_by_phase())


def turn_direction(first: sp.Matrix = u, second: sp.Matrix = w) -> sp.Matrix:
    """Derivative of u and w, or of A and B, under u -> exp(i1 s) o u at s = 0."""
    return sp.Matrix([*product(I1, first), *product(I1, second)])


def turn_momentum() -> sp.Expr:
    """(z, i1 o u) + (y, i1 o w) = (a, i1 o A) + (b, i1 o B)."""
    return sp.Matrix([*z, *y]).dot(turn_direction())


def relation_gradient(first: sp.Matrix = u, second: sp.Matrix = w) -> sp.Matrix:
    """Gradient of scal(u~ o i1 o w) = scal(A~ o i1 o B) by u and w, or by A and B."""
    return sp.Matrix([sapunkov.bilinear(first, second)]).jacobian([*first, *second]).T


def switching() -> sp.Matrix:
    """n, the gradient of K/t' + L with respect to p."""
    return sp.Matrix([power().diff(p) for p in force]) / sapunkov.time_rate()


def switching_of_the_relation() -> sp.Matrix:
    """The change of n when `relation_gradient` is added to the costates: a multiple of the relation."""
    along = dict(zip([*z, *y], relation_gradient(), strict=True))
    return switching().subs(along, simultaneous=True)


def energy() -> sp.Expr:
    """H = -L + (n, p) + kappa/t', with t as the independent variable; it is constant and equals -theta."""
    return -running_cost + switching().dot(force) + phase_costate() / sapunkov.time_rate()


def transversality() -> sp.Expr:
    """theta t' + kappa, which is 0 at a free t_k: along the target's orbit only t and phi change."""
    return time_costate * sapunkov.time_rate() + phase_costate()


def terminal_law() -> sp.Expr:
    """(K + kappa)/t' with `transversality`: (n, p) - L, as for Pimkina & Chelnokov in `terminal`."""
    at_meeting = sp.solve(transversality(), time_costate)[0]
    value = (hamiltonian() + phase_costate()).subs(time_costate, at_meeting)
    return sp.expand(value / sapunkov.time_rate())


def place() -> tuple[sp.Matrix, sp.Matrix]:
    """R and V as functions of u, w and Q."""
    swing = vect(product(conjugate(u), I1, w))
    return sapunkov.place(), 2 * swing / (sapunkov.radius() * sapunkov.slowness())


def spinor_behind(direction: sp.Matrix) -> sp.Matrix:
    """A unit u with u~ o i1 o u equal to a given unit vector other than i1; see `sapunkov.spinor_of`."""
    first, second, third = direction
    return sp.Matrix([third, second, 1 - first, 0]) / sp.sqrt(2 * (1 - first))


def oscillation_of(position: sp.Matrix, velocity: sp.Matrix, ahead: bool) -> tuple[sp.Matrix, sp.Matrix]:
    """u and w as functions of R and V; they are A and B where phi = 0."""
    r = sp.sqrt(position.dot(position))
    unit = (sapunkov.spinor_of if ahead else spinor_behind)(position / r)
    spinor = sp.sqrt(r) * unit
    values = dict(zip([*u, *sapunkov.velocity], [*spinor, *velocity], strict=True))
    size = -1 / (velocity.dot(velocity) / 2 - 1 / r)
    rate = sapunkov.spinor_rate().subs(values, simultaneous=True)
    return spinor, rate * sapunkov.slowness().subs(Q, size)


@cache
def smoothed_throttle() -> tuple[sp.Expr, sp.Expr]:
    """The share v of the peak that maximises S v - (width/2)(v log v + (1-v) log(1-v)), and that maximum.

    S = |n|/alpha2 - 1. The entropy keeps v smooth and between 0 and 1; as the width goes to 0, v tends to a
    jump at S = 0, and the maximum to max(S, 0).
    """
    S, width = sp.symbols("S width", positive=True)
    logit = sp.Symbol("x", real=True)
    share = 1 / (1 + sp.exp(-logit))
    slope = S - width / 2 * sp.simplify(sp.log(share / (1 - share)))
    (solution,) = sp.solve(sp.expand_log(slope, force=True), logit)
    best = share.subs(logit, solution)
    entropy = best * sp.log(best) + (1 - best) * sp.log(1 - best)
    return best, S * best - width / 2 * entropy
