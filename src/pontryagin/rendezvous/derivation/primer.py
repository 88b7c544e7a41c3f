"""The problem in Cartesian coordinates, where n is Lawden's primer vector.

With H = -(alpha1 + alpha2 p^2) + (psi_R, V) + (psi_V, p - fM R/r^3) + Phi* phi*', psi_R = -psi_V' and
psi_V'' = G psi_V, where G is the gradient of gravity. The thrust lies along psi_V, so psi_V is n in inertial
axes. `carried` is the derivative of n in inertial axes along the reduced equations; with the thrust along n
it does not depend on the thrust, and the second derivative is G n.

The rotating axes eta depend on the state, so a thrust given by its components in eta is another function of
the state than one given in inertial axes: for thrusts not along n the two sets of costates differ.

paper   here            meaning
------  --------------  --------------------------------------------------------------
n_eta   switching       psi_V, in eta
-       carried         psi_V' = -psi_R, in eta
nu*     -               2 (R x psi_R + V x psi_V), the integral due to the symmetry under rotations
"""

from functools import cache

import sympy as sp

from pontryagin.rendezvous.derivation import model, principle, reduction, transversality
from pontryagin.rendezvous.derivation.model import EX, EY, c, gravity, r, v1

size = sp.Symbol("k", nonnegative=True)


def thrust_along_primer() -> dict[sp.Symbol, sp.Expr]:
    """p_eta = k n_eta with any function k of time."""
    return dict(zip(model.thrust, size * principle.switching(), strict=True))


def rate_at_any_thrust(vector: sp.Matrix) -> sp.Matrix:
    """d/dt in inertial axes of a vector given by its components in eta, at any thrust."""
    change = vector.jacobian(list(reduction.REDUCED)) * reduction.rates()
    return change + model.motion()[1].cross(vector)


def inertial_rate(vector: sp.Matrix) -> sp.Matrix:
    """`rate_at_any_thrust` with the thrust along n."""
    return rate_at_any_thrust(vector).subs(thrust_along_primer()).applyfunc(sp.expand)


@cache
def carried() -> sp.Matrix:
    """psi_V' in eta."""
    return inertial_rate(principle.switching())


@cache
def second_rate() -> sp.Matrix:
    """psi_V'' in eta."""
    return inertial_rate(carried())


def gravity_gradient() -> sp.Matrix:
    """d(-fM R/r^3)/dR in eta, at R = r i1."""
    place = sp.Matrix(sp.symbols("x y z", real=True))
    field = -gravity * place / sp.sqrt(place.dot(place)) ** 3
    return field.jacobian(place).subs(dict(zip(place, r * EX, strict=True)))


def hamiltonian() -> sp.Expr:
    """H of the Cartesian problem, with vectors by their components in eta, in terms of C_phi."""
    velocity = v1 * EX + c / r * EY
    fall = model.thrust - gravity / r**2 * EX
    anomaly = reduction.anomaly_costate_of() * model.anomaly_rate()
    return -principle.running_cost() - carried().dot(velocity) + principle.switching().dot(fall) + anomaly


def turning_invariant(position_costate: sp.Matrix, velocity_costate: sp.Matrix) -> sp.Matrix:
    """The integral nu* = 2 (R x psi_R + V x psi_V), by its components in eta."""
    velocity = v1 * EX + c / r * EY
    moment = (r * EX).cross(position_costate) + velocity.cross(velocity_costate)
    return (2 * moment).applyfunc(sp.expand)


def transversality_condition() -> sp.Expr:
    """(psi_R, dR*/dphi*) + (psi_V, dV*/dphi*) + Phi* at a meeting, in terms of C_phi; 0 by (16).

    Along the orbit d/dphi* is d/dt divided by phi*', with R*' = V* and V*' = -fM R*/r^3.
    """
    velocity, fall = v1 * EX + c / r * EY, -gravity / r**2 * EX
    along = -carried().dot(velocity) + principle.switching().dot(fall)
    condition = along / model.anomaly_rate() + reduction.anomaly_costate_of()
    return condition.subs(transversality.end_values()).subs(gravity, model.GAUSS)


def costates(position_costate: sp.Matrix, velocity_costate: sp.Matrix) -> dict[sp.Symbol, sp.Expr]:
    """rho, s1, e, nu in terms of psi_R and psi_V in eta: from (9), from psi_V' and from the integral nu*."""
    along_radius = sp.Dummy("psi_R1")
    rho = sp.solve(carried()[0] + along_radius, principle.rho)[0]
    s1, e = velocity_costate[0], velocity_costate[1] / r
    nu = turning_invariant(position_costate, velocity_costate)
    return {
        principle.rho: sp.expand(
            rho.subs({along_radius: position_costate[0], principle.e: e}, simultaneous=True)
        ),
        principle.s1: s1,
        principle.e: e,
        **dict(zip(principle.nu, nu, strict=True)),
    }
