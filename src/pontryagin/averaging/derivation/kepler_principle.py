"""The maximum principle of (3.7) and its average over a turn (Akulenko 1977, section 3, example 2).

    paper               here                            meaning
    l                   price                           price of a unit of slow time tau = epsilon t
    p_E, p_K            costate_energy, costate_momentum
    p_gamma, p_psi      costate_pericentre, costate_phase

The costate of the cost is -1, so that H is maximised.
"""

import functools

import sympy as sp

from pontryagin.averaging.derivation.kepler import (
    CONTROL,
    along_the_motion,
    conic,
    e,
    eccentricity,
    element_rates,
    energy,
    energy_of_state,
    epsilon,
    gamma,
    mean_motion,
    momentum,
    momentum_of_state,
    r,
    v_radial,
    v_transverse,
)
from pontryagin.averaging.derivation.kepler_phase import (
    average,
    eccentricity_rate,
    mean_anomaly_rate,
    pericentre_rate,
)

price = sp.Symbol("l", positive=True)
costate_energy, costate_momentum = costates = sp.symbols("p_E p_K", real=True)
costate_pericentre, costate_phase, kappa = sp.symbols("p_gamma p_psi kappa", real=True)

SLOW = (energy, momentum)


def running_cost() -> sp.Expr:
    """The rate of J of (3.7) in slow time: l + u_r^2 + u_phi^2."""
    return price + sum(u**2 for u in CONTROL)


@functools.cache
def control_hamiltonian() -> sp.Expr:
    """The function that the control maximises, at p_gamma = p_psi = 0, in terms of the state."""
    rates = [along_the_motion(element()) / epsilon for element in (energy_of_state, momentum_of_state)]
    return sp.expand(sum(p * rate for p, rate in zip(costates, rates, strict=True)) - running_cost())


@functools.cache
def maximiser() -> sp.Dict:
    """u* in terms of the state and the costates, (3.8): H is strictly concave in the control."""
    return sp.Dict(sp.solve([control_hamiltonian().diff(u) for u in CONTROL], list(CONTROL)))


@functools.cache
def maximised() -> sp.Expr:
    """h*, the maximum over u, as a function of K, e and the anomaly x."""
    return sp.expand(sp.expand(control_hamiltonian().subs(maximiser())).subs(conic()))


@functools.cache
def hamiltonian() -> sp.Expr:
    """The Hamiltonian of (3.7) for E, K, gamma and psi before maximisation, expressed by K, e and x."""
    rates = element_rates()
    phase = mean_anomaly_rate().subs({eccentricity_rate: rates[e], pericentre_rate: rates[gamma]})
    slow = costate_energy * rates[energy] + costate_momentum * rates[momentum]
    return slow + costate_pericentre * rates[gamma] + costate_phase * phase - epsilon * running_cost()


@functools.cache
def averages() -> sp.Dict:
    """Means over a turn of v^2, v_phi r and r^2 in terms of E and K; the keys are as printed."""
    means = {"v^2": v_radial**2 + v_transverse**2, "v_phi r": v_transverse * r, "r^2": r**2}
    return sp.Dict({sp.Symbol(name): over_a_turn(q.subs(conic())) for name, q in means.items()})


def over_a_turn(quantity: sp.Expr) -> sp.Expr:
    """Mean over a turn, in terms of E and K, of a function of K, e and x."""
    return sp.factor(sp.simplify(average(quantity).subs(e, eccentricity())))


@functools.cache
def averaged_hamiltonian() -> sp.Expr:
    """h0(E, K, p_E, p_K), the mean of h* over a turn."""
    whole = sp.Poly(maximised(), *costates)
    return sp.expand(
        sum(
            sp.prod([p**k for p, k in zip(costates, powers, strict=True)]) * over_a_turn(term)
            for powers, term in whole.terms()
        )
    )


@functools.cache
def averaged_rates() -> sp.Dict:
    """dE/dtau, dK/dtau, dp_E/dtau and dp_K/dtau: Hamilton's equations of omega kappa + h0, (2.11)."""
    whole = mean_motion() * kappa + averaged_hamiltonian()
    rates = {slow: whole.diff(p) for slow, p in zip(SLOW, costates, strict=True)}
    rates |= {p: -whole.diff(slow) for slow, p in zip(SLOW, costates, strict=True)}
    return sp.Dict({left: sp.expand(rate) for left, rate in rates.items()})
