"""The first variation of J with the end and its time free, which gives (16), (17) and dJ*/dt_k.

Let motions, costates, thrusts and the time of the meeting depend on a number s besides t. Where the motions
obey x' = f, J is the integral of (psi, x') - H from 0 to t_k. Its derivative by s is the integral of a total
derivative by t, which leaves a term at t_k since the start is fixed, and of a remainder. With dx_k the
displacement of the end itself, not that at a fixed time,

    dJ/ds = (psi, dx_k) - H dt_k - integral of (dH/dp, dp) dt,

and under the optimal thrust the integral vanishes to first order: within the bound dH/dp = 0; on the bound
dH/dp lies along p, and dp is orthogonal to it.

At a meeting dx_k is tangent to the curve of meetings. No thrust changes phi*, so that dphi*_k = phi*' dt_k
and Phi* drops out of dJ. Its constant C_phi may therefore be chosen such that the factor of dphi*_k is 0,
which is (16). Then the factor of dt_k is 0 as well, which is (17).
"""

from functools import cache

import sympy as sp

from pontryagin.rendezvous.derivation import forms, model, principle, reduction, transversality
from pontryagin.rendezvous.derivation.model import thrust
from pontryagin.rendezvous.derivation.principle import COSTATE, STATE

t, s = sp.symbols("t s", real=True)
anomaly_shift, delay = sp.symbols("dphi_k dt_k", real=True)
FAMILY = {x: sp.Function(f"{x}_")(t, s) for x in (*STATE, *COSTATE, *thrust)}
"""Every variable as a function of t and s."""


@cache
def rest_of_the_variation() -> sp.Expr:
    """d/ds of (psi, x') - H minus d/dt of (psi, dx/ds), along the 16 equations: the remainder."""
    states, costates = ([FAMILY[x] for x in names] for names in (STATE, COSTATE))
    lagrangian = sum(m * x.diff(t) for m, x in zip(costates, states, strict=True))
    lagrangian -= principle.hamiltonian().subs(FAMILY)
    product = sum(m * x.diff(s) for m, x in zip(costates, states, strict=True))
    rates = (*principle.state_rates(), *principle.costate_rates())
    equations = zip((*states, *costates), rates, strict=True)
    remainder = sp.expand(lagrangian.diff(s) - product.diff(t))
    return sp.expand(remainder.subs({x.diff(t): rate.subs(FAMILY) for x, rate in equations}))


def gradient_by_thrust() -> sp.Matrix:
    """dH/dp, as functions of t and s."""
    return sp.Matrix([principle.hamiltonian().diff(p).subs(FAMILY) for p in thrust])


def boundary_term(displacement: sp.Matrix, later: sp.Expr) -> sp.Expr:
    """The term of dJ/ds at t_k: (psi, dx/ds) at a fixed time, plus the integrand times the delay.

    The displacement of the end is that at a fixed time plus the motion during the delay `later`.
    """
    rates, costate = principle.state_rates(), sp.Matrix(COSTATE)
    at_fixed_time = displacement - rates * later
    integrand = costate.dot(rates) - principle.hamiltonian()
    return sp.expand(costate.dot(at_fixed_time) + integrand * later)


@cache
def of_a_meeting() -> sp.Expr:
    """dJ/ds if the meeting moves by dphi*_k along the curve of meetings and by dt_k in time."""
    return principle.in_nu(boundary_term(transversality.tangent() * anomaly_shift, delay))


@cache
def cost_slope() -> sp.Expr:
    """dJ*/dt_k of the meetings of prescribed duration, with dphi*_k = phi*' dt_k, at any thrust."""
    arrival = {anomaly_shift: model.anomaly_rate() * delay}
    slope = sp.expand(of_a_meeting().subs(arrival) / delay)
    at_the_end = slope.subs(transversality.end_values()).subs(model.gravity, model.GAUSS)
    return principle.by_powers_of_thrust(at_the_end)


def energy_rate(mode: principle.Mode) -> sp.Expr:
    """dH/dt along the ten equations; the optimal thrust is substituted before H is differentiated."""
    optimal, n = forms.thrust(mode), principle.switching()
    energy = reduction.hamiltonian().subs(optimal)
    rates = zip(reduction.REDUCED, reduction.rates().subs(optimal), strict=True)
    rate = sp.Add(*(energy.diff(x) * change for x, change in rates)).subs(
        principle.size(n), principle.switching_length
    )
    numerator, denominator = sp.fraction(sp.together(rate))
    return sp.rem(sp.expand(numerator), n.dot(n) - principle.switching_length**2, principle.s1) / denominator
