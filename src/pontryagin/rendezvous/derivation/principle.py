"""The maximum principle in 16 dimensions: Hamiltonian, costates and the optimal thrust, (7) to (10).

paper            here                           meaning
---------------  -----------------------------  --------------------------------------------------
alpha1, alpha2   time_weight, energy_weight     weights of the functional (7)
p_max            peak                           bound on |p|, (1)
rho, s1, e       rho, s1, e                     costates of r, v1 and c (the eccentricity is e*)
Phi*             anomaly_costate                costate of phi*
mu               mu                             costate of lambda, a quaternion
nu               nu0, nu                        lambda~ o mu; its vector part nu1, nu2, nu3
n_eta            switching                      what multiplies p_eta in H
psi0             -1                             costate of the running value g of the functional

H is maximised: H = -(alpha1 + alpha2 p^2) + (costates, rates).
"""

from functools import cache
from typing import Literal, get_args

import sympy as sp

from pontryagin.rendezvous.derivation import model
from pontryagin.rendezvous.derivation.model import anomaly, attitude, c, r, thrust, v1
from pontryagin.rendezvous.derivation.quaternion import product

Mode = Literal["unsaturated", "saturated", "time-optimal"]
MODES: tuple[Mode, ...] = get_args(Mode)

time_weight, energy_weight = sp.symbols("alpha1 alpha2", nonnegative=True)
peak = sp.Symbol("p_max", positive=True)
rho, s1, e, anomaly_costate, nu0 = sp.symbols("rho s1 e Phi nu0", real=True)
mu = sp.Matrix(sp.symbols("mu0:4", real=True))
nu = sp.Matrix(sp.symbols("nu1:4", real=True))

STATE = (r, v1, c, anomaly, *attitude)
COSTATE = (rho, s1, e, anomaly_costate, *mu)


def state_rates() -> sp.Matrix:
    """Rates of r, v1, c, phi* and lambda, (2) and (3)."""
    rates, _ = model.motion()
    ordered = rates[0], rates[1], rates[2], model.anomaly_rate()
    return sp.Matrix([*ordered, *model.attitude_rate()])


def running_cost() -> sp.Expr:
    """alpha1 + alpha2 p^2, the integrand of (7)."""
    return time_weight + energy_weight * thrust.dot(thrust)


@cache
def hamiltonian() -> sp.Expr:
    """H of the 16-dimensional problem, for any thrust."""
    return -running_cost() + sp.Matrix(COSTATE).dot(state_rates())


@cache
def costate_rates() -> sp.Matrix:
    """-dH/dx for rho, s1, e, Phi* and mu, at a thrust that is given in eta."""
    return sp.Matrix([-hamiltonian().diff(x) for x in STATE])


def in_nu(expression: sp.Expr) -> sp.Expr:
    """An expression in lambda and mu in terms of nu = lambda~ o mu: mu = lambda o nu, and |lambda| = 1."""
    values = product(attitude, sp.Matrix([nu0, *nu]))
    first, *others = attitude
    written = sp.expand(expression.subs(dict(zip(mu, values, strict=True))))
    return sp.expand(written.subs(first**2, 1 - sum(q**2 for q in others)))


@cache
def switching() -> sp.Matrix:
    """n_eta of (9): the gradient of H + alpha1 + alpha2 p^2 by p_eta."""
    return sp.Matrix([in_nu((hamiltonian() + running_cost()).diff(p)) for p in thrust])


def size(vector: sp.Matrix) -> sp.Expr:
    """Euclidean length."""
    return sp.sqrt(vector.dot(vector))


@cache
def stationary_magnitude() -> sp.Expr:
    """The p at which -alpha2 p^2 + |n| p is largest among all p >= 0, for alpha2 > 0: first case of (10)."""
    p, length = sp.symbols("p n", nonnegative=True)
    (best,) = sp.solve((-energy_weight * p**2 + length * p).diff(p), p)
    return best.subs(length, size(switching()))


def optimal_thrust(mode: Mode) -> sp.Matrix:
    """p_eta that maximises H, (8) and (10), in the mode that holds.

    Unsaturated, n/(2 alpha2); saturated, p_max n/|n|. With alpha2 = 0, "time-optimal", it is always the
    latter.
    """
    n = switching()
    if mode == "unsaturated":
        return (stationary_magnitude() / size(n) * n).applyfunc(sp.simplify)
    return peak / size(n) * n
