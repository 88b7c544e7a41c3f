"""The smooth example of section 3, (3.2): a rotor of unit mass with the running cost k + u^2 (Akulenko 1977).

here            meaning
--------------  ----------------------------------------------------------------------------
x               the phase (psi = x, weight 1), x' = v
v, b            slow variables: rate of turning, from v0 to v1, and the cost paid so far
u, force        control, and a zero-mean force of x (none in the paper)
xi, eta         averaged v and its costate; kappa the averaged costate of x
T               tau_1, the end of slow time; gap = v0 - v1

The costate of b is -1. With s = tau - T every averaged function is a polynomial in s.
"""

from functools import cache

import sympy as sp

from pontryagin.averaging.derivation import rotor

x, v, u, eta = rotor.x, rotor.v, rotor.u, sp.Symbol("eta", real=True)
tau, kappa = sp.symbols("tau kappa", real=True)
k, T = sp.symbols("k tau_1", positive=True)
v0, v1 = sp.symbols("v_0 v_1", positive=True)
gap = sp.Symbol("Delta_v", real=True)


def slow_rates(force: sp.Expr = sp.S.Zero) -> sp.Matrix:
    """(v', b') per epsilon: (3.1) with m = 1 and a constant V, and the running cost k + u^2."""
    speeding = rotor.acceleration(sp.S.One, sp.Symbol("V_0", real=True), force) / rotor.epsilon
    return sp.Matrix([sp.simplify(speeding), k + u**2])


def anomaly_rate() -> sp.Expr:
    """x' = v; the phase is x itself, and its rate has no part of order epsilon."""
    return v


def maximiser() -> sp.Expr:
    """The u that maximises eta v' - b', which is strictly concave in u."""
    hamiltonian = sp.Matrix([[eta, -1]]).dot(slow_rates())
    if not hamiltonian.diff(u, 2).is_negative:
        raise ArithmeticError("the Hamiltonian is not concave in the control")
    return sp.solve(hamiltonian.diff(u), u)[0]


def maximum(force: sp.Expr = sp.S.Zero) -> sp.Expr:
    """h*, the maximum of eta v' - b' over u."""
    return sp.expand(sp.Matrix([[eta, -1]]).dot(slow_rates(force)).subs(u, maximiser()))


def averaged_hamiltonian() -> sp.Expr:
    """h0: the mean of h* over x, to which a zero-mean force adds nothing."""
    return sp.expand(sp.integrate(maximum(), (x, 0, 2 * sp.pi)) / (2 * sp.pi))


@cache
def averaged_solution() -> tuple[sp.Expr, sp.Expr]:
    """xi(tau) and eta(tau) of (2.11) with omega = xi, xi(0) = v0 and xi(T) = v1, in terms of gap and v1."""
    speed = sp.Symbol("xi", real=True)
    whole = anomaly_rate().subs(v, speed) * kappa + averaged_hamiltonian()
    end = sp.Symbol("eta_1", real=True)
    costate = end + sp.integrate(-whole.diff(speed), (tau, T, tau))
    state = v1 + sp.integrate(whole.diff(eta).subs(eta, costate), (tau, T, tau))
    ending = sp.solve(state.subs(tau, 0) - (v1 + gap), end)[0]
    return sp.expand(state.subs(end, ending)), sp.expand(costate.subs(end, ending))


@cache
def cost() -> sp.Expr:
    """b(T) as a function of independent T and kappa, before (2.12) relates them."""
    control = maximiser().subs(eta, averaged_solution()[1])
    return sp.expand(sp.integrate(sp.expand(slow_rates()[1].subs(u, control)), (tau, 0, T)))


@cache
def transversality() -> sp.Expr:
    """omega kappa + h0 at the end, (2.12): vanishes."""
    return sp.expand(v1 * kappa + averaged_hamiltonian().subs(eta, averaged_solution()[1].subs(tau, T)))


def turned() -> sp.Expr:
    """Integral of omega = xi over slow time: epsilon times the phase passed."""
    return sp.expand(sp.integrate(averaged_solution()[0], (tau, 0, T)))


def duration() -> sp.Expr:
    """tau_1(0), the positive root of (2.12) at kappa = 0."""
    return sp.sqrt(gap**2) / sp.sqrt(k)


def duration_slope() -> sp.Expr:
    """d tau_1 / d kappa along (2.12)."""
    return -transversality().diff(kappa) / transversality().diff(T)


def along(quantity: sp.Expr) -> sp.Expr:
    """Total derivative in kappa of a function of T and kappa, with T(kappa) from (2.12)."""
    return quantity.diff(kappa) + quantity.diff(T) * duration_slope()


def at_optimum(quantity: sp.Expr) -> sp.Expr:
    """A quantity at kappa = 0 in terms of tau_1 and gap; (2.12) is k = gap^2/tau_1^2 there."""
    return sp.simplify(quantity.subs(kappa, 0).subs(k, gap**2 / T**2))


def optimal_slope() -> sp.Expr:
    """d tau_1 / d kappa at kappa = 0 in terms of k, with gap^2 = k tau_1^2 in its denominator."""
    by_kappa, by_duration = (transversality().diff(part).subs(kappa, 0) for part in (kappa, T))
    return sp.factor(-by_kappa / by_duration.subs(gap**2, k * T**2))
