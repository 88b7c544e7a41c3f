"""Introduction and section 1 up to (1.3): the problem."""

import sympy as sp

from pontryagin.averaging.derivation import averaged, kepler, principle, ripple, smooth
from pontryagin.averaging.derivation.principle import epsilon, psi
from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Evidence,
    Slip,
    Steps,
    vanishes,
)

claim = Page("Akulenko 1977")

R = sp.Rational
t, tau = principle.t, averaged.tau
k, gap = sp.symbols("k Delta", positive=True)
n = sp.Symbol("n", integer=True, positive=True)


@claim.proof("introduction: dimension", "averaging gives a two-point problem of smaller dimension")
def smaller_dimension() -> Steps:
    order = averaged.order(n)
    yield (
        "2n equations for ξ and η in the place of 2n + 2",
        order["canonical"] - order["averaged, the phase apart"] == 2,
    )
    forward, backward = averaged.rates()
    yield (
        "which contain neither ψ nor q",
        not any(rate.has(psi, principle.q) for rate in (*forward, *backward)),
    )


@claim.proof(
    "(1.1)",
    "the standard system has slow variables and a rotating phase with ω ≥ ω0 > 0; all is 2π-periodic "
    "in the phase",
    remark="The smooth example of section 3 and its rippled form, which this ledger uses throughout, are of "
    "this form with a = (v, b), ψ = x and ω = v.",
    display=r"\dot a = \varepsilon f(a, \psi, u, \varepsilon),\quad \dot\psi = \omega(a) + \varepsilon "
    r"F(a, \psi, u, \varepsilon)",
)
def standard_system() -> Steps:
    rates = smooth.slow_rates(ripple.c * sp.cos(smooth.x))
    turned = rates.subs(smooth.x, smooth.x + 2 * sp.pi)
    yield "v' and b' per ε have the period 2π in x", vanishes(rates - turned)
    yield "x' = v does not depend on x", smooth.anomaly_rate() == smooth.v
    still = principle.rates().subs(epsilon, 0)
    yield "at ε = 0 the slow variables rest", vanishes(still[:2, :])
    yield "and the phase turns at the rate ω(a) > 0", still[2] == principle.omega


@claim.proof(
    "(1.2)",
    "1 ≤ r ≤ n − 1 conditions are imposed on the slow variables at the end",
    display=r"M(a, \varepsilon)|_{t_1} = 0,\quad M = (M_1, \dots, M_r)",
)
def target() -> Steps:
    step = sp.Matrix(sp.symbols("da1:3"))
    normals = sp.Matrix(2, 2, sp.symbols("M11 M12 M21 M22"))
    moved = list(sp.linsolve(list(normals * step), list(step)))
    yield "n independent conditions leave the end no room: M'da = 0 has da = 0 only", moved == [(0, 0)]
    gradient = sp.Matrix([principle.g.diff(x) for x in principle.a])
    yield "and nothing of g to be minimised: g'da = 0", gradient.dot(sp.Matrix(moved[0])) == 0
    one = list(sp.linsolve([(normals * step)[0]], list(step)))
    yield "n − 1 conditions leave one direction", len(one[0].free_symbols & set(step)) == 1


@claim.proof(
    "(1.3)",
    "the terminal cost g(a(t1)) covers integral costs",
    display=r"J = g(a, \varepsilon)|_{t_1} \to \min,\quad u \in U",
)
def terminal_cost() -> Steps:
    paid = sp.integrate(k + sp.Function("u")(tau) ** 2, (tau, 0, sp.Symbol("T")))
    rate = smooth.slow_rates()[1].subs(smooth.u, sp.Function("u")(tau))
    own = sp.integrate(rate.subs(smooth.k, k), (tau, 0, sp.Symbol("T")))
    yield "a slow variable b with b' = ε(k + u²), b(0) = 0 ends at ∫(k + u²)dτ", vanishes(paid - own)
    yield "least time is b' = ε", sp.integrate(sp.S.One, (tau, 0, k)) == k


@claim.proof(
    "section 1: phase",
    "where ω depends on a, averaging leaves the phase with an error that does not tend to zero",
)
def phase_is_known_to_the_order_of_one() -> Steps:
    a0 = sp.Symbol("a_0", positive=True)
    bound, slope, end = sp.symbols("C omega_1 L", positive=True)
    error = sp.integrate(slope * epsilon * bound, (t, 0, end / epsilon))
    yield "∫ω'δa dt over L/ε with |δa| ≤ Cε is at most ω'CL, of the order of one", not error.has(epsilon)
    speed = sp.sqrt(a0**2 + 2 * epsilon * (sp.sin(psi) - 1))
    acceleration = sp.simplify(speed.diff(psi) * speed)
    yield (
        "a' = ε cos ψ, ψ' = a from ψ = π/2: a² = a0² + 2ε(sin ψ − 1)",
        vanishes(acceleration - epsilon * sp.cos(psi)) and vanishes(speed.subs(psi, sp.pi / 2) - a0),
    )
    late = sp.integrate((1 / speed).diff(epsilon).subs(epsilon, 0), (psi, 0, 2 * sp.pi))
    yield "a turn takes 2π/a0 + 2πε/a0³ + O(ε²), averaged 2π/a0", vanishes(late - 2 * sp.pi / a0**3)
    turns = end * a0 / (2 * sp.pi * epsilon)
    lag = sp.simplify(turns * late * epsilon * a0)
    yield "after the slow time L the phase lags by L/a0 for every small ε", vanishes(lag - end / a0)


@claim.proof(
    "section 1: constants of motion",
    "energy, angular momentum, eccentricity and parameter of an orbit, and energy and angular momentum of a "
    "free rigid body, are constant at ε = 0",
)
def constants_of_motion() -> Steps:
    for name, quantity in (("E", kepler.energy_of_state()), ("K", kepler.momentum_of_state())):
        rate = kepler.along_the_motion(quantity)
        yield f"Kepler: the rate of {name} vanishes at ε = 0", vanishes(rate.subs(kepler.epsilon, 0))
    own = [kepler.parameter().free_symbols, kepler.eccentricity().free_symbols]
    yield (
        "and with them p = K² and e = √(1 + 2EK²)",
        (own == [{kepler.momentum}, {kepler.energy, kepler.momentum}]),
    )
    inertia = sp.diag(*sp.symbols("I_x I_y I_z", positive=True))
    spin = sp.Matrix(sp.symbols("omega_x:z", real=True))
    momentum = inertia * spin
    turning = -inertia.inv() * spin.cross(momentum)
    yield "Euler: the rate of ω·Iω vanishes", vanishes(2 * momentum.dot(turning))
    yield "and that of |Iω|²", vanishes(2 * momentum.dot(inertia * turning))


@claim(
    "section 1: duration",
    "t1 is of the order of 1/ε",
    verdict="conditional",
    remark="t1 is never shorter, as |a'| ≤ εC. It is not longer where the averaged problem, at ε = 0, has an "
    "optimum. But f, M and g may depend on ε, and then it can be longer: the smooth example with k = "
    "ε² has its only optimum at t1 = |Δv|/ε².",
)
def duration_of_the_order_of_one_over_epsilon() -> Evidence:
    def argument() -> Steps:
        rate, distance = sp.symbols("C d", positive=True)
        shortest = sp.solve(epsilon * rate * t - distance, t)[0]
        yield "with |f| ≤ C a distance d takes t1 ≥ d/(Cε)", vanishes(shortest - distance / (rate * epsilon))
        whole = smooth.duration().subs(smooth.k, k) / epsilon
        yield "smooth example, k fixed: t1 = |Δv|/(ε√k)", not sp.simplify(whole * epsilon).has(epsilon)

    def counterexample() -> Steps:
        T, small = sp.symbols("T epsilon", positive=True)
        cost = small**2 * T + gap**2 / T
        yield (
            "k = ε²: among all controls b ≥ ε²τ1 + Δv²/τ1, with u constant equal",
            vanishes(cost - 2 * small * gap - (small * T - gap) ** 2 / T),
        )
        best = sp.solve(cost.diff(T), T)
        yield "least at τ1 = |Δv|/ε alone, J = 2ε|Δv|", best == [gap / small]
        slow = (best[0] / small).subs({gap: 1, small: R(1, 100)})
        yield "so t1 = |Δv|/ε²: for Δv = 1 and ε = 1/100, 10000 and not of the order of 100", slow == 10**4

    return Conditional(argument, counterexample=counterexample, display=r"t_1 \sim \varepsilon^{-1}")


@claim(
    "section 1: range of ε",
    "the optimum exists and is unique for every ε of the range",
    verdict="misprint",
    remark="Printed: for every ε in [0, ε0]. At ε = 0 the slow variables rest, and only a start that lies on "
    "the target reaches it. Meant: (0, ε0].",
)
def range_of_epsilon() -> Evidence:
    def argument() -> Steps:
        cost = k * tau + gap**2 / tau
        optimum = sp.solve(cost.diff(tau), tau)
        yield (
            "smooth example: for every ε > 0 one optimum, τ1 = |Δv|/√k, which does not depend on ε",
            any(vanishes(root - gap / sp.sqrt(k)) for root in optimum) and not optimum[0].has(epsilon),
        )

    def counterexample() -> Steps:
        at_zero = principle.rates()[:2, :].subs(epsilon, 0)
        yield "at ε = 0 the rates of the slow variables are 0", vanishes(at_zero)
        moved = R(1) + sp.integrate(at_zero[0], (t, 0, 10**6))
        yield "so v stays at 1 for ever and never is 2", moved != 2

    return Slip(argument, counterexample=counterexample, display=r"\varepsilon \in [0, \varepsilon_0]")
