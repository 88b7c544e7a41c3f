"""(16) and (17) at a meeting combined into a law for the thrust at t_k, without C_phi.

With (5), C_phi of (16) cancels all terms of (17) except those of the thrust and the cost:

    (n, p) = alpha1 + alpha2 p^2    at t_k.

This law determines the scale of the costates. It replaces (16), (17) and the unknown C_phi, which leaves
seven equations for seven unknowns: rho, s1, e, nu1, nu2, nu3 at t0, and t_k.
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
    energy = reduction.hamiltonian().subs(constant).subs(ends).subs(model.gravity, model.GAUSS)
    return principle.by_powers_of_thrust(energy)


def switching_at_a_meeting() -> sp.Matrix:
    """n_eta of (9) with (5)."""
    return principle.switching().subs(transversality.end_values())


def law() -> sp.Expr:
    """(n, p) - alpha1 - alpha2 p^2 at any thrust, which is 0 at t_k if t_k is free."""
    return principle.switching().dot(thrust) - principle.running_cost()


@cache
def law_in_lengths(mode: Mode) -> sp.Expr:
    """`law` at the optimal thrust of a mode, as a function of |n|."""
    size = {
        "unsaturated": switching_length / (2 * energy_weight),
        "saturated": peak,
        "time-optimal": peak,
    }[mode]
    value = switching_length * size - time_weight - energy_weight * size**2
    return sp.expand(value.subs(energy_weight, 0) if mode == "time-optimal" else value)


def residual(mode: Mode) -> sp.Expr:
    """`law_in_lengths` in the reduced variables, the seventh equation of the shooting method."""
    return law_in_lengths(mode).subs(switching_length, principle.size(principle.switching()))


def end_thrust() -> sp.Expr:
    """p(t_k) = sqrt(alpha1/alpha2), if the last arc is unsaturated."""
    in_thrust = law_in_lengths("unsaturated").subs(switching_length, 2 * energy_weight * thrust_magnitude)
    positive = sp.Dummy(positive=True)
    weight = sp.Dummy(positive=True)
    solved = sp.solve(in_thrust.subs({time_weight: positive, energy_weight: weight}), thrust_magnitude)
    return solved[0].subs({positive: time_weight, weight: energy_weight})


@cache
def cost_slope(mode: Mode) -> sp.Expr:
    """dJ*/dt_k along the extremals of prescribed duration and free phi*_k, as a function of |n(t_k)|.

    It follows from the first variation. With an unsaturated end it is alpha1 - alpha2 p(t_k)^2, which
    vanishes where `law` does.
    """
    ends = transversality.end_values()
    optimal = dict(zip(thrust, principle.optimal_thrust(mode).subs(ends), strict=True))
    slope = variation.cost_slope().subs(optimal)
    if mode == "time-optimal":
        slope = slope.subs(energy_weight, 0)
    return principle.in_switching_length(slope, switching_at_a_meeting())


def scale_of_saturated() -> sp.Expr:
    """Factor from the costates of the time-optimal problem with alpha1 = 1 to those of the mixed one.

    With the thrust p_max n/|n| the rates of the state are homogeneous of degree 0 in the costates, and those
    of the costates of degree 1. So the solutions of both problems differ only by a scale, which `law` fixes.
    """
    time_optimal = sp.solve(law_in_lengths("time-optimal").subs(time_weight, 1), switching_length)[0]
    mixed = sp.solve(law_in_lengths("saturated"), switching_length)[0]
    return sp.expand(sp.cancel(mixed / time_optimal))
