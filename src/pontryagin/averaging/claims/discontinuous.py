"""End of section 2: discontinuous controls, the theorem of [12] on averaging and the sharper estimate."""

import numpy as np
import sympy as sp
from scipy.integrate import solve_ivp

from pontryagin.averaging import smooth_example
from pontryagin.averaging.claims import worked
from pontryagin.averaging.derivation import correction, principle, ripple, smooth
from pontryagin.averaging.derivation.principle import psi
from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Evidence,
    Steps,
    vanishes,
)

claim = Page("Akulenko 1977")

R = sp.Rational
t, T, epsilon, x, c, r = sp.symbols("t T epsilon x c r", positive=True)
tau, phi, p, q = sp.symbols("tau phi p q", real=True)

WAVE = sp.acos(sp.cos(phi))
"""G: the triangular wave between 0 and π, whose slope is sign(sin φ)."""

CHIRP = sp.sin(t + x * sp.sqrt(t))
"""S(t, x) of the counterexample to the sharper estimate: X = ∂S/∂t."""


@claim.proof(
    "end of section 2: discontinuous controls",
    "the approach can be used where u* jumps, with a number of jumps of the order of 1/ε",
    remark="Shown on the example a' = εu cos ψ, ψ' = 1, |u| ≤ 1, least time.",
)
def jumping_controls() -> Steps:
    mean = sp.integrate(sp.cos(phi), (phi, -sp.pi / 2, sp.pi / 2)) / sp.pi
    yield "u* = sign(p cos ψ), h* = |p cos ψ| − 1, and ⟨|cos ψ|⟩ = 2/π", mean == 2 / sp.pi
    lead = sp.sin(phi) - mean * phi
    top = sp.acos(mean)
    yield "∫|cos ψ|dψ leads 2ψ/π most at cos ψ = 2/π", vanishes(lead.diff(phi).subs(phi, top))
    worst = float(lead.subs(phi, top))
    for eps in (0.1, 0.01, 0.001):
        half, rest = divmod(1 / eps, np.pi)
        passed = 2 * half + (np.sin(rest) if rest <= np.pi / 2 else 2 - np.sin(rest))
        off, jumps = abs(eps * passed - 2 / np.pi), int((1 / eps + np.pi / 2) // np.pi)
        yield (
            f"ε = {eps}: {jumps} jumps in the slow time 1, and a is off by {off / eps:.3f}ε",
            (off <= worst * eps and abs(jumps * eps - 1 / np.pi) < eps),
        )


@claim.proof(
    "end of section 2: small q",
    "a costate q of the order ε changes control and cost by the order of ε",
    remark="Where the control jumps, the instants of the jumps move, by the order of ε in the phase.",
)
def small_phase_costate() -> Steps:
    yield "q enters h as qF", principle.small_part().coeff(principle.q) == principle.F
    switching = p * sp.cos(psi) + q * sp.sin(psi)
    moved = sp.pi / 2 + sp.atan(q / p)
    yield (
        "a' = εu cos ψ, ψ' = 1 + εu sin ψ: the switch at π/2 moves by atan(q/p), of the order of q",
        vanishes(switching.subs(psi, moved)) and vanishes(sp.atan(q / p).diff(q).subs(q, 0) - 1 / p),
    )
    turned = sp.sqrt(p**2 + q**2)
    yield "and ⟨h*⟩ = (2/π)√(p² + q²) − 1 by the order of q²", turned.diff(q).subs(q, 0) == 0


@claim.proof(
    "end of section 2: division",
    "ψ and t correspond one to one, and division by ψ' gives a standard system",
    display=r"\dot x = \varepsilon X(t, x) + O(\varepsilon^2)",
)
def division() -> Steps:
    bound, floor = sp.symbols("C omega_0", positive=True)
    slowest = (floor - epsilon * bound).subs(epsilon, floor / (2 * bound))
    yield "ψ' ≥ ω0 − εC, which is ω0/2 for ε = ω0/(2C): ψ rises with t", vanishes(slowest - floor / 2)
    small = principle.epsilon
    rate = principle.rates()[0] / principle.rates()[2]
    yield "da/dψ vanishes at ε = 0", rate.subs(small, 0) == 0
    first = rate.diff(small).subs(small, 0).doit()
    yield (
        "and its part of the order ε is f/ω",
        vanishes(first - principle.f[0].subs(small, 0) / principle.omega),
    )


def near_identity() -> sp.Expr:
    """y' + ε²W_x X − εX0 for y = x − εW(t, x), W_t = X − X0, x' = εX: vanishes."""
    path = sp.Function("x")(t)
    X, X0, slope = sp.symbols("X X_0 W_x")
    W = sp.Function("W")(t, path)
    rate = (path - epsilon * W).diff(t).subs(W.diff(path), slope).subs(path.diff(t), epsilon * X)
    at_rest = next(iter(rate.atoms(sp.Subs)))
    return sp.expand(rate.subs(at_rest, X - X0) + epsilon**2 * slope * X - epsilon * X0)


def gronwall() -> sp.Expr:
    """de/dtau − λe − s for e = s (exp(λτ) − 1)/λ: vanishes."""
    rate, source = sp.symbols("lambda s", positive=True)
    grown = source * (sp.exp(rate * tau) - 1) / rate
    return sp.simplify(grown.diff(tau) - rate * grown - source)


@claim(
    "end of section 2: theorem [12]",
    "averaging theorem for discontinuous X: |x − ξ| < η up to t = L/ε for ε small enough",
    verdict="conditional",
    remark="True where the second limit is uniform in r_k too. If it is taken for each r_k by itself, it "
    "follows from the first limit and adds nothing, and the theorem fails: X = sign(sin tx) has X0 = "
    "0, while x moves from 2 to about √3 by t = 1/ε, as x² + τ² − 2εG(tx) is constant. X periodic in "
    "t, as division by ψ' gives, has the uniform limit if ∫(X − X0)dt is Lipschitz in x.",
)
def averaging_theorem() -> Evidence:
    def argument() -> Steps:
        yield "y = x − εW, W = ∫(X − X0)dt, has y' = εX0 − ε²W_xX", near_identity() == 0
        yield (
            "(W(x + r) − W(x))/(rT) → 0 uniformly makes εW_x small up to t = L/ε: Gronwall's bound tends "
            "to 0",
            (gronwall() == 0),
        )

    def counterexample() -> Steps:
        slope = WAVE.diff(phi)
        yield (
            "G = arccos(cos φ): 0 ≤ G ≤ π, G'² = 1",
            vanishes(slope**2 - 1) and WAVE.subs(phi, 3 * sp.pi) == sp.pi,
        )
        yield (
            "∫X dt = (G((t0 + T)x) − G(t0x))/x ≤ π for x ≥ 1: the first limit is 0, uniformly",
            (vanishes(sp.diff(WAVE.subs(phi, t * x), t) / x - slope.subs(phi, t * x))),
        )
        quotient = 2 * sp.pi / (T * r)
        yield "the second is at most 2π/(Tr_k), and 0 for each r_k", sp.limit(quotient, T, sp.oo) == 0
        inner = (WAVE.subs(phi, t * x) - WAVE.subs(phi, t * c)) / t
        yield (
            "∫∫X dx dt has the continuous derivatives (G(tx) − G(tc))/t, x − c at t = 0, and G(tx)/x",
            (sp.limit(inner.subs({x: 2, c: 1}), t, 0) == 1),
        )
        g = sp.Symbol("g")
        change = 2 * x * g + 2 * tau - 2 * g * (x + tau * g)
        yield (
            "dx/dτ = g: d(x² + τ² − 2εG(xτ/ε))/dτ = 2τ(1 − g²) = 0",
            vanishes(sp.expand(change - 2 * tau * (1 - g**2))),
        )
        yield (
            "x² = 4 − τ² + 2εG lies between 3 and 5 up to τ = 1, ε ≤ 1/(2π); tx rises, so x is unique",
            (sp.sqrt(3) - 1 > 0 and 4 + 2 * R(1, 2) == 5),
        )
        for small in (R(1, 100), R(1, 10**6)):
            off = 2 - sp.sqrt(3 + 2 * sp.pi * small)
            yield f"ε = {small}: at t = 1/ε ξ − x is at least {float(off):.4f}", off > R(6, 25)

    return Conditional(
        argument,
        counterexample=counterexample,
        display=r"\lim_{T \to \infty}\frac{1}{T}\int_{t_0}^{t_0+T} X(t, x)dt = X_0(x),\quad \lim_{T \to "
        r"\infty}\frac{1}{T}\int_{t_0}^{t_0+T}[Z(t, x_1, \dots, x_i + r_k, \dots, x_n) - Z(t, "
        r"x)]r_k^{-1}dt = "
        r"0,\quad Z \equiv X - X_0",
    )


@claim.proof("end of section 2: no order", "the theorem does not show that |x − ξ| is of the order ε")
def no_order() -> Steps:
    moved = sp.integrate(1 / sp.sqrt(1 + t), (t, 0, T))
    yield "X = (1 + t)^(−1/2) has X0 = 0", sp.limit(moved / T, T, sp.oo) == 0
    off = epsilon * moved.subs(T, 1 / epsilon)
    yield "x − ξ = 2ε(√(1 + 1/ε) − 1) at t = 1/ε tends to 0", sp.limit(off, epsilon, 0, "+") == 0
    yield "as 2√ε", sp.limit(off / sp.sqrt(epsilon), epsilon, 0, "+") == 2


@claim(
    "end of section 2: sharper estimate",
    "if ∫Z dt is differentiable in x and |N| ≤ d0/T, then |x − ξ| ≤ dε",
    verdict="conditional",
    remark="True where the derivative of ∫Z dt with respect to x is bounded, as it is for X periodic in t. "
    "It need not be bounded: X = ∂S/∂t, S = sin(t + x√t), satisfies all the conditions, those of the "
    "theorem uniformly in r_k, and |x − ξ| is of the order √ε.",
)
def sharper_estimate() -> Evidence:
    def argument() -> Steps:
        yield "y = x − εW has y' = εX0 − ε²W_xX", near_identity() == 0
        d0, B, C, rate, L = sp.symbols("d_0 B C lambda L", positive=True)
        whole = d0 + (rate * d0 + B * C) * (sp.exp(rate * L) - 1) / rate
        yield (
            "|W| ≤ d0, |W_x| ≤ B, |X| ≤ C: |x − ξ| ≤ ε(d0 + (λd0 + BC)(exp λL − 1)/λ)",
            (gronwall() == 0 and not whole.has(epsilon)),
        )

    def counterexample() -> Steps:
        X, slope = CHIRP.diff(t), CHIRP.diff(x)
        yield (
            "X = cos(t + x√t)(1 + x/(2√t)) is bounded for t ≥ 1; |N| ≤ 2/T, as |S| ≤ 1",
            vanishes(X - sp.cos(t + x * sp.sqrt(t)) * (1 + x / (2 * sp.sqrt(t)))),
        )
        yield (
            "∂S/∂x = √t cos(t + x√t) is continuous; over T it tends to 0 uniformly, so the limits are "
            "uniform",
            (
                vanishes(slope - sp.sqrt(t) * sp.cos(t + x * sp.sqrt(t)))
                and sp.limit(sp.sqrt(1 + T) / T, T, sp.oo) == 0
            ),
        )
        drift = -slope * X
        square = sp.cos(t + x * sp.sqrt(t)) ** 2 * (sp.sqrt(t) + x / 2)
        yield (
            "x − εS has the rate −ε²cos²(t + x√t)(√t + x/2), never positive: about −ε²√t/2",
            vanishes(sp.simplify(drift + square)),
        )
        expected = sp.integrate(sp.sqrt(t) / 2, (t, 0, 1 / epsilon)) * epsilon**2
        yield "which is −√ε/3 by t = 1/ε", vanishes(sp.simplify(expected - sp.sqrt(epsilon) / 3))
        for small in (1e-2, 1e-3, 3e-4):
            off = drifted(small)
            yield f"ε = {small}: ξ − x = {off / small:.1f}ε = {off / small**0.5:.3f}√ε", off > small**0.5 / 6

    return Conditional(argument, counterexample=counterexample)


def drifted(small: float) -> float:
    """ξ − x at t = 1/ε for X = ∂S/∂t from x = 2 at t = 1, by SciPy."""
    field = sp.lambdify((t, x), CHIRP.diff(t))
    end = solve_ivp(
        lambda time, y: small * field(time, y), (1, 1 / small), [2.0], "DOP853", rtol=1e-9, atol=1e-11
    )  # fmt: skip
    return float(2 - end.y[0, -1])


@claim.proof(
    "end of section 2: higher approximations",
    "canonical averaging gives further approximations in powers of ε",
)
def higher_approximations() -> Steps:
    h = ripple.maximum().subs(smooth.x, correction.x)
    k1, k2 = correction.anomaly_hamiltonian(h, sp.S.Zero, smooth.v)
    left = correction.transformed(k1, k2, [smooth.v], [smooth.eta])
    yield (
        "rippled example: a canonical change of variables removes the phase up to ε²",
        vanishes(sp.simplify(left)),
    )
    first = float(smooth_example(worked.START, worked.END, ripple=worked.RIPPLE).correction())
    for eps in worked.EPSILONS:
        off = abs(worked.roots(eps).cost[worked.best(eps)] - 2 - eps * first)
        yield f"ε = {eps}: J* is J0 + εJ1 with J1 = {first:.3f} within {off / eps**2:.1f}ε²", off < 3 * eps**2
