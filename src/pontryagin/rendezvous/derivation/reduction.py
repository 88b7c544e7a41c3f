"""From 16 equations to ten: the integrals, the variable nu, and (11), (12), (13), (14) at any thrust.

paper     here              meaning
--------  ----------------  ---------------------------------------------------------------
nu*       invariant         mu o lambda~, a quaternion that is constant
nu        nu_of; nu0, nu    lambda~ o mu = lambda~ o nu* o lambda
C_phi     anomaly_constant  Phi* (1 + e* cos phi*)^2, constant
"""

from functools import cache

import sympy as sp

from pontryagin.rendezvous.derivation import principle
from pontryagin.rendezvous.derivation.model import anomaly, attitude, c, eccentricity, r, v1
from pontryagin.rendezvous.derivation.principle import anomaly_costate, e, mu, nu, rho, s1
from pontryagin.rendezvous.derivation.quaternion import conjugate, product
from pontryagin.rendezvous.derivation.symbols import Symbol

anomaly_constant = Symbol("C_phi", real=True)

REDUCED = (r, v1, c, anomaly, rho, s1, e, *nu)
"""The ten variables of (11), (12), (13), (14) and of phi*'."""


def along(expression: sp.Expr) -> sp.Expr:
    """d/dt along the 16 equations, at any thrust."""
    variables = (*principle.STATE, *principle.COSTATE)
    rates = (*principle.state_rates(), *principle.costate_rates())
    return sp.Add(*(expression.diff(x) * rate for x, rate in zip(variables, rates, strict=True)))


def invariant() -> sp.Matrix:
    """nu* = mu o lambda~."""
    return product(mu, conjugate(attitude))


def nu_of() -> sp.Matrix:
    """nu = lambda~ o mu, four components, in terms of lambda and mu."""
    return product(conjugate(attitude), mu)


def anomaly_integral() -> sp.Expr:
    """C_phi = Phi* (1 + e* cos phi*)^2. Since Phi*' = -Phi* d(phi*')/d phi*, Phi* phi*' is constant."""
    growth = 1 + eccentricity * sp.cos(anomaly)
    return anomaly_costate * growth**2


def norms() -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    """Further integrals: |lambda|^2, the gauge nu0 = (lambda, mu), and the square of the length of nu."""
    scalar, *vector = nu_of()
    return attitude.dot(attitude), scalar, sum(part**2 for part in vector)


@cache
def rates() -> sp.Matrix:
    """Rates of `REDUCED` at any thrust: (11), (12), (13), (14), and phi*' of (3)."""
    state = dict(zip(principle.STATE, principle.state_rates(), strict=True))
    costate = dict(zip(principle.COSTATE, principle.costate_rates(), strict=True))
    values = [
        *(state[x] for x in (r, v1, c, anomaly)),
        *(principle.in_nu(costate[x]) for x in (rho, s1, e)),
        *(principle.in_nu(along(part)) for part in nu_of()[1:]),
    ]
    return sp.Matrix(values)


def gauge_rate() -> sp.Expr:
    """d nu0/dt, which is 0; no rate and no condition contains nu0."""
    return principle.in_nu(along(nu_of()[0]))


@cache
def hamiltonian() -> sp.Expr:
    """H of (17) in the reduced variables and C_phi, at any thrust."""
    in_nu = principle.in_nu(principle.hamiltonian())
    return sp.expand(sp.simplify(in_nu.subs(anomaly_costate, anomaly_costate_of())))


def lifted() -> sp.Matrix:
    """mu = lambda o nu as a function of lambda and nu, in the gauge nu0 = 0."""
    return product(attitude, sp.Matrix([0, *nu]))


def anomaly_costate_of() -> sp.Expr:
    """Phi* as a function of C_phi and phi*."""
    return sp.solve(anomaly_integral() - anomaly_constant, anomaly_costate)[0]
