"""What (16) and (17) say together at a meeting: a law for the thrust there, without C_phi.

With (5), C_phi of (16) cancels every term of (17) but those of the thrust and the cost:

    (n, p) = alpha1 + alpha2 p^2    at t_k.

It fixes the scale of the costates. In place of (16), (17) and the unknown C_phi it leaves seven equations
for seven unknowns: rho, s1, e, nu1, nu2, nu3 at the start, and t_k.
"""

from functools import cache

import sympy as sp

from pontryagin.rendezvous.derivation import model, principle, reduction, transversality, variation
from pontryagin.rendezvous.derivation.model import thrust
from pontryagin.rendezvous.derivation.principle import (
    Mode,
    energy_weight,
    peak,
    switching_length,
    thrust_magnitude,
    time_weight,
)


@cache
def hamiltonian_at_a_meeting() -> sp.Expr:
    """H of (17) with (5) and with C_phi of (16), at any thrust; fM = c*^2/p*."""
    constant = {reduction.anomaly_constant: transversality.anomaly_constant_at_the_end()}
    ends = transversality.end_values()
    whole = reduction.hamiltonian().subs(constant).subs(ends).subs(model.gravity, model.GAUSS)
    return principle.by_powers_of_thrust(whole)


def switching_at_a_meeting() -> sp.Matrix:
    """n_eta of (9) with (5)."""
    return principle.switching().subs(transversality.end_values())


def law() -> sp.Expr:
    """(n, p) - alpha1 - alpha2 p^2 at any thrust: zero at a meeting at a free time."""
    return principle.switching().dot(thrust) - principle.running_cost()


@cache
def law_in_lengths(mode: Mode) -> sp.Expr:
    """The same in |n|, at the optimal thrust of the mode."""
    size = {
        "unsaturated": switching_length / (2 * energy_weight),
        "saturated": peak,
        "time-optimal": peak,
    }[mode]
    whole = switching_length * size - time_weight - energy_weight * size**2
    return sp.expand(whole.subs(energy_weight, 0) if mode == "time-optimal" else whole)


def residual(mode: Mode) -> sp.Expr:
    """The same in the reduced variables: the seventh equation of the shooting."""
    return law_in_lengths(mode).subs(switching_length, principle.size(principle.switching()))


def end_thrust() -> sp.Expr:
    """p(t_k) of an unsaturated end: sqrt(alpha1/alpha2)."""
    in_thrust = law_in_lengths("unsaturated").subs(switching_length, 2 * energy_weight * thrust_magnitude)
    positive = sp.Dummy(positive=True)
    weight = sp.Dummy(positive=True)
    solved = sp.solve(in_thrust.subs({time_weight: positive, energy_weight: weight}), thrust_magnitude)
    return solved[0].subs({positive: time_weight, weight: energy_weight})


@cache
def cost_slope(mode: Mode) -> sp.Expr:
    """dJ*/dt_k of the extremals of fixed duration, with a free anomaly at the end, in |n| at the end.

    By the first variation; unsaturated it is alpha1 - alpha2 p(t_k)^2, zero exactly where the law holds.
    """
    ends = transversality.end_values()
    put_in = dict(zip(thrust, principle.optimal_thrust(mode).subs(ends), strict=True))
    whole = variation.cost_slope().subs(put_in)
    if mode == "time-optimal":
        whole = whole.subs(energy_weight, 0)
    return principle.in_switching_length(whole, switching_at_a_meeting())


def scale_of_saturated() -> sp.Expr:
    """Factor from the costates of the time-optimal problem with alpha1 = 1 to those of the mixed one.

    All rates of the state are of degree 0 in the costates, all rates of the costates of degree 1, where the
    thrust is p_max n/|n|. So a scale is all that the law at the end can tell apart.
    """
    time_optimal = sp.solve(law_in_lengths("time-optimal").subs(time_weight, 1), switching_length)[0]
    mixed = sp.solve(law_in_lengths("saturated"), switching_length)[0]
    return sp.expand(sp.cancel(mixed / time_optimal))
