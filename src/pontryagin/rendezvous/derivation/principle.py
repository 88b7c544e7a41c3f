"""The maximum principle in 16 dimensions: Hamiltonian, costates and the optimal thrust, (7) to (10).

paper            here                           meaning
---------------  -----------------------------  --------------------------------------------------
alpha1, alpha2   time_weight, energy_weight     weights of the functional (7)
p_max            peak                           bound on |p|, (1)
rho, s1, e       rho, s1, e                     costates of r, v1 and c (the eccentricity is e*)
Phi*             anomaly_costate                costate of phi*
mu               mu                             costate of lambda, a quaternion
nu               nu0, nu                        lambda~ o mu; its vector part nu1, nu2, nu3
n_eta            switching                      coefficient of p_eta in H
p, |n|           thrust_magnitude,              lengths of the thrust and of n
                 switching_length
psi0             -1                             costate of the running value g of the functional

H is maximised: H = -(alpha1 + alpha2 p^2) + (costates, rates).
"""

from functools import cache
from typing import Literal, get_args

import sympy as sp

from pontryagin.rendezvous.derivation import model
from pontryagin.rendezvous.derivation.model import anomaly, attitude, c, r, thrust, v1
from pontryagin.rendezvous.derivation.quaternion import product
from pontryagin.rendezvous.derivation.symbols import Symbol

Mode = Literal["unsaturated", "saturated", "time-optimal"]
MODES: tuple[Mode, ...] = get_args(Mode)

time_weight, energy_weight = sp.symbols("alpha1 alpha2", nonnegative=True)
peak = sp.Symbol("p_max", positive=True)
rho, s1, e, nu0 = sp.symbols("rho s1 e nu0", real=True)
anomaly_costate = Symbol("Phi", real=True)
mu = sp.Matrix(sp.symbols("mu0:4", real=True))
nu = sp.Matrix(sp.symbols("nu1:4", real=True))
thrust_magnitude, switching_length = sp.symbols("p |n|", nonnegative=True)

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
    """H of the 16-dimensional problem, at any thrust."""
    return -running_cost() + sp.Matrix(COSTATE).dot(state_rates())


@cache
def costate_rates() -> sp.Matrix:
    """Rates of rho, s1, e, Phi* and mu: -dH/dx at a thrust whose components in eta are given."""
    return sp.Matrix([-hamiltonian().diff(x) for x in STATE])


def in_nu(expression: sp.Expr) -> sp.Expr:
    """An expression in lambda and mu in terms of nu = lambda~ o mu: mu = lambda o nu, and |lambda| = 1."""
    values = product(attitude, sp.Matrix([nu0, *nu]))
    first, *others = attitude
    substituted = sp.expand(expression.subs(dict(zip(mu, values, strict=True))))
    return sp.expand(substituted.subs(first**2, 1 - sum(q**2 for q in others)))


@cache
def switching() -> sp.Matrix:
    """n_eta of (9): the gradient of H + alpha1 + alpha2 p^2 with respect to p_eta."""
    return sp.Matrix([in_nu((hamiltonian() + running_cost()).diff(p)) for p in thrust])


def size(vector: sp.Matrix) -> sp.Expr:
    """Euclidean length."""
    return sp.sqrt(vector.dot(vector))


def by_powers_of_thrust(expression: sp.Expr) -> sp.Expr:
    """A polynomial in p1, p2, p3 with simplified coefficients."""
    terms = sp.Poly(expression, *thrust).as_dict()
    powers = {key: sp.prod(p**k for p, k in zip(thrust, key, strict=True)) for key in terms}
    return sp.Add(*(sp.simplify(value) * powers[key] for key, value in terms.items()))


def in_switching_length(expression: sp.Expr, n: sp.Matrix) -> sp.Expr:
    """An expression with s1 eliminated in favour of |n|; any other dependence on n remains visible."""
    rest = n.dot(n) - s1**2
    return sp.expand(sp.simplify(expression.subs(s1, sp.sqrt(switching_length**2 - rest))))


@cache
def along_switching() -> sp.Expr:
    """H at the thrust p n/|n| minus H without thrust, in terms of p and |n|."""
    n, energy = switching(), in_nu(hamiltonian())
    with_thrust = energy.subs(dict(zip(thrust, thrust_magnitude / size(n) * n, strict=True)))
    return in_switching_length(sp.expand(with_thrust - energy.subs(dict.fromkeys(thrust, 0))), n)


@cache
def best_magnitudes() -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    """The p in 0 <= p <= p_max at which `along_switching` is largest.

    The three values are those of the two cases of (10) for alpha2 > 0, |n| <= 2 alpha2 p_max and
    |n| > 2 alpha2 p_max, and that for alpha2 = 0. The candidates are both ends of the interval, and the point
    between them where the slope vanishes.
    """
    gain, excess, weight = along_switching(), sp.Symbol("k", positive=True), sp.Symbol("w", positive=True)
    (top,) = sp.solve(gain.diff(thrust_magnitude), thrust_magnitude)
    (reached,) = sp.solve(top - peak, switching_length)
    return (
        _largest(gain, (0, top, peak), {peak: top + excess}, weight),
        _largest(gain, (0, peak), {switching_length: reached + excess}, weight),
        _largest(gain.subs(energy_weight, 0), (0, peak), {switching_length: excess}, weight),
    )


def _largest(
    gain: sp.Expr, candidates: tuple[sp.Expr, ...], case: dict[sp.Symbol, sp.Expr], weight: sp.Symbol
) -> sp.Expr:
    """The candidate at which the gain is largest in a case, with `weight` > 0 in place of alpha2."""

    def lead(one: sp.Expr, other: sp.Expr) -> sp.Expr:
        difference = gain.subs(thrust_magnitude, one) - gain.subs(thrust_magnitude, other)
        return sp.factor(sp.expand(difference.subs(case).subs(energy_weight, weight)))

    (best,) = (
        one for one in candidates if all(lead(one, x).is_nonnegative for x in candidates if x is not one)
    )
    return best


def stationary_magnitude() -> sp.Expr:
    """The first case of (10), with |n| written out."""
    return best_magnitudes()[0].subs(switching_length, size(switching()))


def optimal_thrust(mode: Mode) -> sp.Matrix:
    """p_eta that maximises H, (8) and (10), in a given mode.

    It is n/(2 alpha2) in the mode "unsaturated", and p_max n/|n| in the modes "saturated" and "time-optimal"
    (alpha2 = 0).
    """
    n = switching()
    if mode == "unsaturated":
        return (stationary_magnitude() / size(n) * n).applyfunc(sp.simplify)
    return best_magnitudes()[1] / size(n) * n
