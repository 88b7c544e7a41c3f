"""The closed solution of the averaged problem of example 2 (Akulenko 1977, (3.9)), and its consequences.

paper       here                              meaning
E0, K0, E1  energy0, momentum0, energy1       E and K at the start, E at the end
tau, tau1   tau, duration                     slow time epsilon t, and its value at the end
rho         rho                               -p_E(tau1)
"""

import functools

import sympy as sp

from pontryagin.averaging.derivation.kepler import CONTROL, conic, e, eccentric, energy, mean_motion, momentum
from pontryagin.averaging.derivation.kepler_phase import mean_anomaly, true_from_eccentric
from pontryagin.averaging.derivation.kepler_principle import (
    averaged_hamiltonian,
    averaged_rates,
    costate_energy,
    costate_momentum,
    kappa,
    maximised,
    maximiser,
    over_a_turn,
    running_cost,
)

tau = sp.Symbol("tau", real=True)
duration = sp.Symbol("tau_1", positive=True)
rho = sp.Symbol("rho", real=True, nonzero=True)
energy0, energy1 = sp.symbols("E_0 E_1", negative=True)
momentum0 = sp.Symbol("K_0", positive=True)
direction = sp.Symbol("sigma", real=True, nonzero=True)

OPTIMUM = {costate_momentum: 0, kappa: 0}
"""p_K = 0 at the end, where K is free, hence always, as its rate has the factor p_K; kappa = 0 is optimal."""


def optimal_rates() -> dict[sp.Symbol, sp.Expr]:
    """dE/dtau, dK/dtau and dp_E/dtau on the optimum."""
    rates = averaged_rates()
    return {s: rates[s].subs(OPTIMUM) for s in (energy, momentum, costate_energy)}


@functools.cache
def solution() -> sp.Dict:
    """p_E, E, K as functions of tau, tau1, rho: the rates integrated one after the other, (3.9)."""
    rates = optimal_rates()
    p, E, K = (sp.Function(name)(tau) for name in ("p_E", "E", "K"))
    riccati = sp.Eq(p.diff(tau), rates[costate_energy].subs(costate_energy, p))
    costate = sp.factor(sp.dsolve(riccati, p, ics={p.subs(tau, duration): -rho}).rhs)
    found = {costate_energy: costate}
    for slow, path, start in ((energy, E, energy0), (momentum, K, momentum0)):
        rate = rates[slow].subs({slow: path, costate_energy: costate})
        linear = sp.dsolve(sp.Eq(path.diff(tau), rate), path, ics={path.subs(tau, 0): start})
        found[slow] = sp.factor(sp.simplify(linear.rhs))
    return sp.Dict(found)


@functools.cache
def shrinkage() -> sp.Expr:
    """1 - rho tau1/2 in terms of E0 and E1, from E(tau1) = E1.

    It is positive, since the denominator of p_E runs from this value to 1 and must not vanish in between.
    """
    left = sp.Symbol("z", positive=True)
    end = solution()[energy].subs(tau, duration).subs(rho, 2 * (1 - left) / duration)
    return sp.solve(sp.factor(end) - energy1, left)[0]


@functools.cache
def costate_size() -> sp.Expr:
    """|rho|, from h0 = 0 at the end."""
    level = averaged_hamiltonian().subs(OPTIMUM).subs({costate_energy: -rho, energy: energy1})
    return sp.sqrt(sp.solve(level, rho**2)[0])


def terminal_costate() -> sp.Expr:
    """rho, whose sign is that of rho tau1/2 = 1 - (E0/E1)^(1/2)."""
    return costate_size() * sp.sign(1 - shrinkage())


def optimal_duration() -> sp.Expr:
    """tau1 = 2 |1 - (E0/E1)^(1/2)|/|rho|, with the factor |E1|^(1/2) moved into the modulus."""
    root = sp.sqrt(-energy1)
    return sp.simplify(2 / (costate_size() * root)) * sp.Abs(sp.expand(root * (1 - shrinkage())))


def optimal_cost() -> sp.Expr:
    """J0: tau1 times the mean of l + u^2 over a turn, which is constant on the optimum, where h0 = 0."""
    squared = {costate_energy**2: sp.solve(averaged_hamiltonian().subs(OPTIMUM), costate_energy**2)[0]}
    mean = over_a_turn(running_cost().subs(maximiser()).subs(OPTIMUM).subs(conic()))
    return sp.simplify(mean.subs(squared)) * optimal_duration()


@functools.cache
def thrust_on_the_way() -> sp.ImmutableMatrix:
    """(u_r, u_phi) on the optimum in terms of l, e, x and sigma = sign(E1 - E0); tau does not enter."""
    costate = direction * sp.sqrt(sp.solve(averaged_hamiltonian().subs(OPTIMUM), costate_energy**2)[0])
    control = [maximiser()[u].subs(OPTIMUM).subs(conic()).subs(costate_energy, costate) for u in CONTROL]
    level = {energy: (e**2 - 1) / (2 * momentum**2)}
    return sp.ImmutableMatrix([sp.simplify(u.subs(level)) for u in control])


def ending_slope() -> sp.Expr:
    """Derivative in kappa, at kappa = 0, of the phase passed per unit of |E|^(1/2), (2.15).

    It is positive, so that kappa = 0 is a minimum. With s = |E|^(1/2), h0 + omega kappa = 0 and p_K = 0 the
    phase passed is the integral of omega ds/|s'|.
    """
    root = sp.Symbol("s", positive=True)
    motion = mean_motion().subs(energy, -(root**2))
    whole = averaged_hamiltonian().subs(costate_momentum, 0) + mean_motion() * kappa
    squared = sp.solve(whole.subs(energy, -(root**2)), costate_energy**2)[0]
    speed = sp.sqrt(squared) * sp.Abs(averaged_rates()[energy].subs(OPTIMUM).coeff(costate_energy))
    speed = sp.simplify(speed.subs(energy, -(root**2)) / (2 * root))
    return sp.simplify((motion / speed).diff(kappa).subs(kappa, 0))


@functools.cache
def ripple() -> sp.Expr:
    """The zero-mean primitive in psi of h* - h0 on the optimum, as a function of l, e and xi."""
    squared = sp.solve(averaged_hamiltonian().subs(OPTIMUM), costate_energy**2)[0]
    level = {energy: (e**2 - 1) / (2 * momentum**2)}
    excess = (maximised() - averaged_hamiltonian()).subs(OPTIMUM).subs(costate_energy**2, squared).subs(level)
    integrand = sp.simplify(excess.subs(true_from_eccentric()) * mean_anomaly().diff(eccentric))
    primitive = sp.integrate(sp.expand(integrand), eccentric)
    mean = sp.integrate(sp.expand(primitive * mean_anomaly().diff(eccentric)), (eccentric, 0, 2 * sp.pi))
    return sp.factor(primitive - mean / (2 * sp.pi))


def first_correction(kind: int = 1) -> sp.Expr:
    """J1 with J = J0 + epsilon J1 + O(epsilon^2), for a start at the eccentric anomaly xi.

    J1 is ripple/omega at the start minus ripple/omega at the end. The phase at the end is free: there the
    ripple is largest for the minima of the cost (`kind` 1) and least for the maxima (-1), both at an end of
    the minor axis.
    """
    at_the_end = ripple().subs(eccentric, kind * sp.pi / 2) / mean_motion().subs(energy, energy1)
    at_the_start = ripple() / mean_motion().subs(energy, energy0)
    return sp.simplify(at_the_start) - sp.simplify(at_the_end)
