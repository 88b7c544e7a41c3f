"""Section 2 after (2.16), and (2.17): the optimum, the reduced order, and the first approximation."""

import numpy as np
import sympy as sp
from scipy.integrate import solve_ivp

from pontryagin.averaging.claims import instances, worked
from pontryagin.averaging.claims.optimum import closed
from pontryagin.averaging.derivation import averaged, principle, ripple, smooth
from pontryagin.averaging.derivation.averaged import kappa
from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Evidence,
    Steps,
    vanishes,
)

claim = Page("Akulenko 1977")

R = sp.Rational
n = sp.Symbol("n", integer=True, positive=True)


@claim.proof(
    "after (2.16): Hamiltonian",
    "(2.11) is a Hamiltonian system, along which ωκ + (ηf0) is constant",
    display=r"\omega(\xi)\kappa + (\eta f_0) = \mathrm{const}",
)
def averaged_hamiltonian() -> Steps:
    H = averaged.averaged_hamiltonian()
    forward, backward = averaged.rates()
    own = [H.diff(y) for y in averaged.eta] + [-H.diff(x) for x in averaged.xi]
    yield (
        "its rates are the derivatives of ωκ + h0",
        vanishes(sp.Matrix([*forward, *backward]) - sp.Matrix(own)),
    )
    yield "along which that is constant", averaged.along(H, (forward, backward)) == 0


@claim(
    "after (2.16): optimal κ",
    "the optimal κ is 0, and τ1(0) is the root of (2.12) at κ = 0",
    verdict="conditional",
    remark="True where (2.15) and (2.16) hold, as in the smooth example. But κ = 0 may be a local maximum, "
    "and (2.12) may have several roots at κ = 0, only one of them optimal: the example after (2.13) "
    "has τ1 = 1, 2 and 3, the second a maximum.",
)
def optimal_kappa() -> Evidence:
    def argument() -> Steps:
        J, T = closed(ripple.cost()), closed(ripple.duration())
        yield "smooth example: κ = 0 has J0 = 2, τ1 = 1", J.subs(kappa, 0) == 2 and T.subs(kappa, 0) == 1
        least, gap = sp.symbols("k Delta", positive=True)
        time = sp.Symbol("T", positive=True)
        roots = sp.solve((least * time + gap**2 / time).diff(time), time)
        yield "which is the least of kT + Δv²/T, the one positive root", roots == [gap / sp.sqrt(least)]

    def counterexample() -> Steps:
        clock, end = instances.Clock(instances.THREE), instances.T
        slopes = [sp.simplify(1 / clock.kappa.diff(end).subs(end, value)) for value in (1, 2, 3)]
        yield (
            "dΨ/dκ = dτ1/dκ at κ = 0 is " + ", ".join(map(str, slopes)) + " for τ1 = 1, 2, 3",
            ([slope > 0 for slope in slopes] == [True, False, True]),
        )
        costs = [clock.cost.subs(end, value) for value in (1, 2, 3)]
        yield (
            "J0 there is " + ", ".join(map(str, costs)) + ": the second is not optimal",
            costs[1] > max(costs[0], costs[2]),
        )
        yield "and of the minima one is not", costs[0] != costs[2]

    return Conditional(argument, counterexample=counterexample)


@claim.proof(
    "after (2.16): (ηf0)",
    "at the optimum (ηf0) = 0 along the whole motion",
    display=r"(\eta f_0(\xi, \eta)) = 0",
)
def zero_level() -> Steps:
    yield "h0 = −ωκ along a member", vanishes(averaged.h0 + averaged.omega * averaged.integral())
    rate = averaged.along(averaged.h0, tuple(part.subs(kappa, 0) for part in averaged.rates()))
    yield "and constant at κ = 0", rate == 0


@claim.proof(
    "after (2.16): order",
    "(2.10) lowers the order by one; in all, the order 2n + 2 is lowered by three",
    remark="q is removed by H* = 0, ψ by averaging, and one more variable by (ηf0) = 0.",
)
def order() -> Steps:
    sizes = averaged.order(n)
    listed = list(sizes.values())
    yield "2n + 2, 2n + 1, 2n, 2n − 1", listed == [2 * n + 2, 2 * n + 1, 2 * n, 2 * n - 1]
    costate = sp.solve(smooth.v * kappa + smooth.averaged_hamiltonian(), smooth.eta)
    yield (
        "smooth example: (2.10) gives η as a function of v",
        len(costate) == 2 and not any(root.has(smooth.eta) for root in costate),
    )


@claim.proof(
    "after (2.16): quadrature",
    "with one degree of freedom a quadrature and an equation for τ1(0) are left",
    remark="One degree of freedom means one slow variable and the cost, on which no rate depends.",
)
def quadrature() -> Steps:
    yield "the cost's costate is constant", averaged.cyclic_costate() == 0
    force = smooth.averaged_hamiltonian().diff(smooth.eta)
    rate = force.subs(smooth.eta, ripple.costate()).subs({kappa: 0, ripple.rise: 1})
    T = sp.integrate(1 / rate, (smooth.v, smooth.v0, smooth.v1))
    yield (
        "smooth example: τ1(0) = ∫dv/f0 = (v1 − v0)/√k",
        vanishes(
            T
            - ripple.duration().subs(
                {ripple.A0: sp.sqrt(smooth.k), ripple.A1: sp.sqrt(smooth.k), ripple.rise: 1}
            )
        ),
    )


@claim.proof("after (2.16): slow time", "the slow variables are found apart from the phase, in slow time")
def apart_from_the_phase() -> Steps:
    forward, backward = averaged.rates()
    yield (
        "their rates contain neither ψ nor ε",
        not any(part.has(averaged.psi, principle.epsilon) for part in (*forward, *backward)),
    )


@claim.proof(
    "(2.17)",
    "u = u0*(a, ψ, η*), with ψ the phase of the actual motion, is the first approximation, and J* = J0(0)",
    remark="The control needs the true phase ψ. The phase of (2.5) is off by O(1) and cannot replace it "
    "where u0* depends on it.",
    display=r"u = u_0^*(a, \psi, \eta^*),\quad J^* = J_0(0),\quad \xi^* = \xi(\tau, \tau_1(0), 0),\quad "
    r"\eta^* = \eta(\tau, \tau_1(0), 0)",
)
def first_approximation() -> Steps:
    for eps in worked.EPSILONS:
        speed, phase = flown(eps)
        off = abs(speed - 2)
        yield (
            f"rippled example, ε = {eps}: u = 1 for the slow time 1 costs J0 = 2 and ends at v = 2 "
            f"within "
            f"{off / eps:.2f}ε",
            off < eps,
        )
        work = speed**2 / 2 - R(1, 2) - eps * (phase + np.sin(phase) / 2)
        yield "v²/2 − ε(x + sin(x)/2) is kept", abs(work) < 1e-8


def flown(eps: float) -> tuple[float, float]:
    """Speed and phase after the slow time 1 under u = 1, the rippled example flown by SciPy."""

    def rates(_: float, y: np.ndarray) -> list[float]:
        return [1 + worked.RIPPLE * np.cos(y[1]), y[0] / eps]

    end = solve_ivp(rates, (0, 1), [worked.START, 0.0], "DOP853", rtol=1e-11, atol=1e-11).y[:, -1]
    return float(end[0]), float(end[1])
