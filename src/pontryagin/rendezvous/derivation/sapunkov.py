"""Sapunkov's (1) from Newton's law, by the Kustaanheimo-Stiefel regularisation.

A quaternion u represents the place, R = u~ o i1 o u, so that r = |u|^2; the fictitious time tau is defined by
dt = r d tau. While the energy h is negative, u is a harmonic oscillation of frequency 1 in the half-angle phi
with d phi/d tau = sqrt(-h/2); its amplitudes A and B are the elements. Lengths and times are such that
fM = 1; epsilon is the unit of the thrust in units of gravity.

paper       here            meaning
----------  --------------  --------------------------------------------------------------
u           u               place: R = u~ o i1 o u; u^2 = |u|^2 = r
w           w               du/d phi on the osculating ellipse
A, B        A, B            elements; u = A cos phi + B sin phi
phi         half_anomaly    half the osculating eccentric anomaly, up to a constant
Q           Q               A^2 + B^2 = -1/h, twice the semi-axis
p, epsilon  force, epsilon  thrust and its unit
q = P(u) p  lifted_force    -i1 o u o p
F1          driving         u^2 q + (w, q) w
"""

from functools import cache

import sympy as sp

from pontryagin.rendezvous.derivation.quaternion import I1, conjugate, product, pure, scal, vect

u, w = sp.Matrix(sp.symbols("u0:4", real=True)), sp.Matrix(sp.symbols("w0:4", real=True))
A, B = sp.Matrix(sp.symbols("A0:4", real=True)), sp.Matrix(sp.symbols("B0:4", real=True))
force, velocity = sp.Matrix(sp.symbols("p1:4", real=True)), sp.Matrix(sp.symbols("V1:4", real=True))
half_anomaly = sp.Symbol("varphi", real=True)
epsilon, Q = sp.symbols("epsilon Q", positive=True)


def place(spinor: sp.Matrix = u) -> sp.Matrix:
    """R = u~ o i1 o u, whose length is |u|^2."""
    return vect(product(conjugate(spinor), I1, spinor))


def radius(spinor: sp.Matrix = u) -> sp.Expr:
    """r = |u|^2."""
    return spinor.dot(spinor)


def spinor_rate() -> sp.Matrix:
    """du/d tau = -i1 o u o V/2 of a velocity V, the solution with scal(u~ o i1 o u') = 0."""
    return product(-I1, u, pure(velocity)) / 2


def place_rate() -> sp.Matrix:
    """dR/d tau by `spinor_rate`, which must be r V."""
    return (place().jacobian(u) * spinor_rate()).applyfunc(sp.expand)


def bilinear(first: sp.Matrix = u, second: sp.Matrix = w) -> sp.Expr:
    """scal(u~ o i1 o w), which stays 0 at any thrust if it is 0 at the start."""
    return scal(product(conjugate(first), I1, second))


def lifted_force() -> sp.Matrix:
    """q = P(u) p = -i1 o u o p; the page does not define P(u)."""
    return product(-I1, u, pure(force))


def lifting() -> sp.Matrix:
    """The matrix P(u), 4 x 3."""
    return lifted_force().jacobian(force)


def energy() -> sp.Expr:
    """h = V^2/2 - 1/r."""
    return velocity.dot(velocity) / 2 - 1 / radius()


@cache
def spinor_acceleration() -> sp.Matrix:
    """d^2u/d tau^2 by Newton's law V' = -R/r^3 + epsilon p, in u and V."""
    rate, r = spinor_rate(), radius()
    fall = r * (-place() / r**3 + epsilon * force)
    return rate.jacobian(u) * rate + rate.jacobian(velocity) * fall


def oscillator() -> sp.Matrix:
    """d^2u/d tau^2 as a forced oscillation: (h/2) u + (r/2) epsilon q."""
    return energy() / 2 * u + radius() / 2 * epsilon * lifted_force()


def size_of_the_orbit() -> sp.Expr:
    """Q = -1/h in terms of u and w, from h = V^2/2 - 1/r, r V^2 = 4 |u'|^2 and |u'|^2 = (-h/2) |w|^2."""
    h = sp.Symbol("h", real=True)
    kinetic = 2 * (-h / 2) * w.dot(w) / radius()
    (solution,) = sp.solve(kinetic - 1 / radius() - h, h)
    return sp.simplify(-1 / solution)


def slowness() -> sp.Expr:
    """d tau/d phi = 1/sqrt(-h/2), with h = -1/Q."""
    return 1 / sp.sqrt(1 / Q / 2)


def time_rate() -> sp.Expr:
    """dt/d phi = r d tau/d phi."""
    return radius() * slowness()


def energy_rate() -> sp.Expr:
    """dh/d phi = epsilon (V, p) dt/d phi, with r V = dR/d tau and du/d tau = w d phi/d tau."""
    displacement = place().jacobian(u) * w
    return sp.expand(epsilon * displacement.dot(force))


def size_rate() -> sp.Expr:
    """dQ/d phi, with Q = -1/h."""
    return Q**2 * energy_rate()


def oscillation_rate() -> sp.Matrix:
    """dw/d phi with w = (d tau/d phi) du/d tau: by the acceleration and the change of d tau/d phi."""
    acceleration = -1 / Q / 2 * u + radius() / 2 * epsilon * lifted_force()
    return slowness() ** 2 * acceleration + slowness().diff(Q) * size_rate() / slowness() * w


@cache
def element_rates() -> tuple[sp.Matrix, sp.Matrix]:
    """dA/d phi and dB/d phi, with A = u cos phi - w sin phi and B = u sin phi + w cos phi."""
    cos, sin = sp.cos(half_anomaly), sp.sin(half_anomaly)
    pair = sp.Matrix([u * cos - w * sin, u * sin + w * cos])
    rates = pair.jacobian([*u, *w]) * sp.Matrix([*w, *oscillation_rate()]) + pair.diff(half_anomaly)
    factored = rates.applyfunc(lambda part: sp.factor(sp.expand(part)))
    return factored[:4, :], factored[4:, :]


def oscillation() -> dict[sp.Symbol, sp.Expr]:
    """u and w in terms of A, B, phi: the inverse of A = u cos phi - w sin phi, B = u sin phi + w cos phi."""
    cos, sin = sp.cos(half_anomaly), sp.sin(half_anomaly)
    ahead = sp.Matrix([[cos, -sin], [sin, cos]])
    back = sp.simplify(ahead.inv())
    return {
        x: value
        for k, pair in enumerate((u, w))
        for x, value in zip(pair, back[k, 0] * A + back[k, 1] * B, strict=True)
    }


def bilinear_rate() -> sp.Expr:
    """d/d phi of scal(u~ o i1 o w), at any thrust."""
    rates = sp.Matrix([*w, *oscillation_rate()])
    return sp.expand((sp.Matrix([bilinear()]).jacobian([*u, *w]) * rates)[0])


def spinor_of(direction: sp.Matrix) -> sp.Matrix:
    """A unit u with u~ o i1 o u equal to a given unit vector other than -i1; exp(i1 s) o u is another."""
    first, second, third = direction
    return sp.Matrix([1 + first, 0, third, -second]) / sp.sqrt(2 * (1 + first))
