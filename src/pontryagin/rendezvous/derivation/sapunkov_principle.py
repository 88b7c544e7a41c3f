"""The maximum principle in Sapunkov's elements, for both functionals.

The independent variable is the half-angle phi, the time one more state: so coasting leaves A and B where
they are, and equal steps of phi are short in time where the orbit is bent. phi at the meeting is free. The
running cost L(p), alpha1 + alpha2 p^2 or alpha1 + alpha2 |p|, enters by a symbol: neither the equations nor
what is conserved depends on which it is.

Three redundancies come with four numbers u for three of the place, and a shooting method must know them:

turn      u -> exp(i1 s) o u moves no craft. Its momentum (a, i1 o A) + (b, i1 o B) is constant, and zero,
          because the set on which the flight ends is turned into itself.
relation  scal(A~ o i1 o B) = 0 always, so its gradient may be added to the costates and changes no thrust.
phase     the origin of phi is free: (a, B) - (b, A) is the costate of phi.

Left over are six numbers: the costates across the turn and the relation, which are across each other.

symbol      here            meaning
----------  --------------  -----------------------------------------------------------
a, b        a, b            costates of A and B
z, y        z, y            a cos phi + b sin phi, -a sin phi + b cos phi: costates of u and w
theta       time_costate    costate of the time; H = -theta
L           running_cost    alpha1 + alpha2 p^2, or alpha1 + alpha2 |p|
n           switching       what the thrust lies along, in inertial axes
kappa       phase_costate   costate of phi
"""

from functools import cache

import sympy as sp

from pontryagin.rendezvous.derivation import sapunkov
from pontryagin.rendezvous.derivation.quaternion import I1, conjugate, product, vect
from pontryagin.rendezvous.derivation.sapunkov import A, B, Q, force, half_anomaly, u, w

a, b = sp.Matrix(sp.symbols("a0:4", real=True)), sp.Matrix(sp.symbols("b0:4", real=True))
z, y = sp.Matrix(sp.symbols("z0:4", real=True)), sp.Matrix(sp.symbols("y0:4", real=True))
time_costate = sp.Symbol("theta", real=True)
running_cost = sp.Symbol("L", real=True)

SIN, COS = sp.sin(half_anomaly), sp.cos(half_anomaly)
SIZE = {Q: u.dot(u) + w.dot(w)}


def written_out(expression):
    """An expression of u, w, z, y and Q in A, B, a, b and phi."""
    names = sapunkov.oscillation() | {Q: A.dot(A) + B.dot(B)}
    names |= dict(zip(z, a * COS + b * SIN, strict=True)) | dict(zip(y, b * COS - a * SIN, strict=True))
    return expression.subs(names, simultaneous=True)


def driving() -> sp.Matrix:
    """Q F1 of (1), epsilon = 1: dA/d phi = -driving sin phi, dB/d phi = driving cos phi."""
    lifted = sapunkov.lifted_force()
    return Q * (sapunkov.radius() * lifted + w.dot(lifted) * w)


def power() -> sp.Expr:
    """(a, dA/d phi) + (b, dB/d phi), linear in the thrust."""
    return driving().dot(y)


def hamiltonian() -> sp.Expr:
    """K, what is maximised over the thrust, phi being the independent variable."""
    return (time_costate - running_cost) * sapunkov.time_rate() + power()


def phase_costate() -> sp.Expr:
    """kappa = (a, B) - (b, A), in z, y, w and u."""
    return z.dot(w) - y.dot(u)


def state_rates() -> sp.Matrix:
    """Rates of A, B and t by phi, (1)."""
    return sp.Matrix([*(-driving() * SIN), *(driving() * COS), sapunkov.time_rate()])


def _gradients() -> tuple[sp.Matrix, sp.Matrix]:
    """Of K by u and by w, with Q = u^2 + w^2 moving along and the thrust held still."""
    K = hamiltonian()
    return tuple(sp.Matrix([K]).jacobian(list(x)).T + 2 * x * K.diff(Q) for x in (u, w))  # type: ignore[return-value]


def costate_rates() -> sp.Matrix:
    """Rates of a and b: minus the gradient of K by A and B."""
    by_u, by_w = _gradients()
    return sp.Matrix([*(by_w * SIN - by_u * COS), *(-by_u * SIN - by_w * COS)])


def oscillation_rates() -> sp.Matrix:
    """Rates of u, w, z and y by phi: (1) and the costates, in axes that turn with phi."""
    by_u, by_w = _gradients()
    return sp.Matrix([*w, *(driving() - u), *(y - by_u), *(-z - by_w)])


def rate_of(quantity: sp.Expr) -> sp.Expr:
    """d/d phi of a function of u, w, z and y, under any constant thrust; Q = u^2 + w^2."""
    whole = sp.Matrix([quantity.subs(SIZE)]).jacobian([*u, *w, *z, *y]) * oscillation_rates().subs(SIZE)
    return whole[0]


def time_costate_by_phase() -> sp.Expr:
    """theta from K + kappa = 0: with it no weight is left in the equations."""
    return running_cost - (power() + phase_costate()) / sapunkov.time_rate()


def closed_costate_rates() -> sp.Matrix:
    """`costate_rates` with theta put in: functions of A, B, a, b, phi and the thrust alone."""
    return costate_rates().subs(time_costate, time_costate_by_phase())


def turn_direction(first: sp.Matrix = u, second: sp.Matrix = w) -> sp.Matrix:
    """How u and w, or A and B, move under u -> exp(i1 s) o u."""
    return sp.Matrix([*product(I1, first), *product(I1, second)])


def turn_momentum() -> sp.Expr:
    """(z, i1 o u) + (y, i1 o w) = (a, i1 o A) + (b, i1 o B)."""
    return sp.Matrix([*z, *y]).dot(turn_direction())


def relation_gradient(first: sp.Matrix = u, second: sp.Matrix = w) -> sp.Matrix:
    """Gradient of scal(u~ o i1 o w) = scal(A~ o i1 o B) by u and w, or by A and B."""
    return sp.Matrix([sapunkov.bilinear(first, second)]).jacobian([*first, *second]).T


def switching() -> sp.Matrix:
    """n: K over t' is (n, p) and what does not contain p."""
    return sp.Matrix([power().diff(p) for p in force]) / sapunkov.time_rate()


def switching_of_the_relation() -> sp.Matrix:
    """What adding `relation_gradient` to the costates adds to n: a multiple of the relation."""
    along = dict(zip([*z, *y], relation_gradient(), strict=True))
    return switching().subs(along, simultaneous=True)


def energy() -> sp.Expr:
    """H = -L + (n, p) + kappa/t', t the independent variable; constant, and -theta."""
    return -running_cost + switching().dot(force) + phase_costate() / sapunkov.time_rate()


def transversality() -> sp.Expr:
    """theta t' + kappa at a free meeting: along the target's orbit A, B stand still, t and phi move."""
    return time_costate * sapunkov.time_rate() + phase_costate()


def terminal_law() -> sp.Expr:
    """What that leaves of K + kappa = 0, over t': (n, p) - L, as in the paper before."""
    meeting = sp.solve(transversality(), time_costate)[0]
    whole = (hamiltonian() + phase_costate()).subs(time_costate, meeting)
    return sp.expand(whole / sapunkov.time_rate())


def place() -> tuple[sp.Matrix, sp.Matrix]:
    """R and V of u, w and Q."""
    swing = vect(product(conjugate(u), I1, w))
    return sapunkov.place(), 2 * swing / (sapunkov.radius() * sapunkov.slowness())


def spinor_behind(direction: sp.Matrix) -> sp.Matrix:
    """A unit u with u~ o i1 o u a given unit vector other than i1; beside `sapunkov.spinor_of`."""
    first, second, third = direction
    return sp.Matrix([third, second, 1 - first, 0]) / sp.sqrt(2 * (1 - first))


def oscillation_of(position: sp.Matrix, velocity: sp.Matrix, ahead: bool) -> tuple[sp.Matrix, sp.Matrix]:
    """u and w of R and V: A and B where phi = 0."""
    r = sp.sqrt(position.dot(position))
    unit = (sapunkov.spinor_of if ahead else spinor_behind)(position / r)
    spinor = sp.sqrt(r) * unit
    put_in = dict(zip([*u, *sapunkov.velocity], [*spinor, *velocity], strict=True))
    size = -1 / (velocity.dot(velocity) / 2 - 1 / r)
    rate = sapunkov.spinor_rate().subs(put_in, simultaneous=True)
    return spinor, rate * sapunkov.slowness().subs(Q, size)


@cache
def smoothed_throttle() -> tuple[sp.Expr, sp.Expr]:
    """The share v of the peak that maximises S v - (width/2)(v log v + (1-v) log(1-v)), and that maximum.

    S = |n|/alpha2 - 1. The entropy keeps v between 0 and 1 and smooth; as the width goes to 0 it becomes
    the jump of v at S = 0, and the maximum max(S, 0).
    """
    S, width = sp.symbols("S width", positive=True)
    logit = sp.Symbol("x", real=True)
    share = 1 / (1 + sp.exp(-logit))
    slope = S - width / 2 * sp.simplify(sp.log(share / (1 - share)))
    (found,) = sp.solve(sp.expand_log(slope, force=True), logit)
    best = share.subs(logit, found)
    entropy = best * sp.log(best) + (1 - best) * sp.log(1 - best)
    return best, S * best - width / 2 * entropy
