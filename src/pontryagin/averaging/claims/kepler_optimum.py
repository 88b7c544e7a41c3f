"""Section 3, example 2, (3.9): the solution of the averaged problem."""

import sympy as sp

from pontryagin.averaging.derivation import kepler_optimum
from pontryagin.averaging.derivation import kepler_principle as principle
from pontryagin.averaging.derivation.kepler import (
    energy,
    momentum,
)
from pontryagin.averaging.derivation.kepler_optimum import (
    OPTIMUM,
    duration,
    energy0,
    energy1,
    momentum0,
    rho,
    solution,
    tau,
)
from pontryagin.averaging.derivation.kepler_principle import costate_energy, price
from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Consequence,
    Equality,
    Evidence,
    Misprint,
    Proof,
    Steps,
    vanishes,
)

claim = Page("Akulenko 1977")

R = sp.Rational
DESCENT = {energy0: -1, energy1: -4, price: 2, momentum0: R(1, 2)}
"""A transfer from E0 = -1 to E1 = -4 with l = 2, for which rho = 1 and tau1 = 1."""
SPENT = {**DESCENT, rho: 1, duration: 1}

PRINTED_ENERGY = energy0 * (1 + rho * tau / (2 - rho * duration))
PRINTED_COSTATE = -2 * rho / (2 - (duration - tau) * rho)
PRINTED_MOMENTUM = momentum0 * (1 - rho * duration / 2) * (1 - rho * (duration - tau) / 2) ** -1


def left_over(variable: sp.Symbol, path: sp.Expr) -> sp.Expr:
    """Residual of the averaged equation of one variable on a path, with the costate of (3.9) as printed."""
    rates = kepler_optimum.optimal_rates()
    return sp.simplify(
        path.diff(tau) - rates[variable].subs({variable: path, costate_energy: PRINTED_COSTATE})
    )


@claim.proof(
    "before (3.9)",
    "an explicit solution of the boundary value problem, and with it the controls (3.8)",
    remark="True with E(τ) corrected. J0 = 2lτ1, and by the Cauchy–Schwarz inequality no control of the "
    "averaged system costs less: the extremal is its global minimum.",
)
def explicit_solution() -> Steps:
    found = solution()
    for name, variable in (("E", energy), ("K", momentum), ("p_E", costate_energy)):
        yield f"{name}(τ) satisfies its averaged equation", vanishes(left_over(variable, found[variable]))
    start = [found[energy].subs(tau, 0) - energy0, found[momentum].subs(tau, 0) - momentum0]
    yield "E(0) = E0, K(0) = K0", all(map(vanishes, start))
    ratio = kepler_optimum.shrinkage()
    end = found[energy].subs(tau, duration).subs(rho, 2 * (1 - ratio) / duration)
    yield "E(τ1) = E1", vanishes(end - energy1)
    along = {energy: found[energy], costate_energy: found[costate_energy]}
    level = principle.averaged_hamiltonian().subs(OPTIMUM).subs(along)
    yield "h0 is the same for all τ", vanishes(level.diff(tau))
    ending = sp.sqrt(energy0 / energy1)
    at_the_end = sp.simplify(level.subs(duration, 2 * (1 - ratio) / rho))
    yield "and 0 with |ρ| = (2l/|E1|)^(1/2)", vanishes(at_the_end.subs(rho, kepler_optimum.costate_size()))
    yield "1 − ½ρτ1 = (E0/E1)^(1/2)", vanishes(ratio - ending)
    cost = kepler_optimum.optimal_cost() / kepler_optimum.optimal_duration()
    yield "J0 = 2lτ1", vanishes(cost - 2 * price)
    yield (
        "the second derivative (2.15), an integral over |E|^(1/2), is positive",
        kepler_optimum.ending_slope().is_positive is True,
    )
    power = principle.averages()[sp.Symbol("v^2")]
    yield (
        "|dE/dτ| = |⟨vu⟩| ≤ (2|E|⟨u²⟩)^(1/2), so |d|E|^(1/2)/dτ| ≤ (½⟨u²⟩)^(1/2)",
        vanishes(power / (4 * sp.Abs(energy)) - R(1, 2)),
    )
    w = sp.Symbol("w", nonnegative=True)
    yield (
        "l + w² ≥ 2 l^(1/2) w then bounds every J0 from below by 2lτ1",
        vanishes(price + w**2 - 2 * sp.sqrt(price) * w - (sp.sqrt(price) - w) ** 2)
        and vanishes(
            2 * sp.sqrt(2 * price) * sp.Abs(sp.sqrt(-energy0) - sp.sqrt(-energy1))
            - kepler_optimum.optimal_cost()
        ),
    )


@claim(
    "(3.9): E",
    "the energy on the optimum",
    verdict="misprint",
    remark="Right: E0 (1 + ρτ/(2 − ρτ1))²; the print lacks the square. As printed E(τ1) is −(E0E1)^(1/2), "
    "not E1, and neither dE/dτ = −p_E E nor EK² = const is satisfied. τ1, ρ, p_E, K and the controls "
    "belong to the formula with the square.",
)
def energy_on_the_optimum() -> Evidence:
    def consequence() -> Consequence:
        ends = [path.subs(tau, duration).subs(SPENT) for path in (PRINTED_ENERGY, solution()[energy])]
        if ends[1] != DESCENT[energy1]:
            raise ArithmeticError("the derived solution does not end at E1")
        return Consequence("E(τ1) for E0 = −1, E1 = −4, l = 2, where ρ = τ1 = 1", *ends)

    factor = rho * tau / (2 - rho * duration)
    return Misprint(
        {r"E(\tau)": PRINTED_ENERGY},
        lambda: solution()[energy],
        defect={r"E(\tau)": -energy0 * factor * (1 + factor)},
        consequence=consequence,
        display=r"E(\tau) = E_0\left(1 + \frac{\rho\tau}{2 - \rho\tau_1}\right)",
    )


@claim("(3.9): p_E", "the costate of the energy on the optimum", verdict="holds")
def costate_on_the_optimum() -> Evidence:
    def argument() -> Steps:
        yield "dp_E/dτ = ½ p_E²", vanishes(left_over(costate_energy, PRINTED_COSTATE))
        yield "p_E(τ1) = −ρ", vanishes(PRINTED_COSTATE.subs(tau, duration) + rho)

    formula = Equality({r"p_E(\tau)": PRINTED_COSTATE}, lambda: solution()[costate_energy])
    return Proof(argument, formula, display=r"p_E(\tau) = \frac{-2\rho}{2 - (\tau_1 - \tau)\rho}")


@claim("(3.9): K", "the angular momentum on the optimum", verdict="holds")
def momentum_on_the_optimum() -> Evidence:
    def argument() -> Steps:
        yield "dK/dτ = ½ p_E K", vanishes(left_over(momentum, PRINTED_MOMENTUM))
        yield "K(0) = K0", vanishes(PRINTED_MOMENTUM.subs(tau, 0) - momentum0)

    formula = Equality({r"K(\tau)": PRINTED_MOMENTUM}, lambda: solution()[momentum])
    return Proof(
        argument,
        formula,
        display=r"K(\tau) = K_0(1 - \tfrac12\rho\tau_1)[1 - \tfrac12\rho(\tau_1 - \tau)]^{-1}",
    )


@claim("(3.9): τ1", "the duration of the optimum in slow time", verdict="holds")
def duration_of_the_optimum() -> Evidence:
    printed = sp.sqrt(2) * sp.Abs(sp.Abs(energy1) ** R(1, 2) - sp.Abs(energy0) ** R(1, 2)) * price ** R(-1, 2)
    return Equality(
        {r"\tau_1": printed},
        kepler_optimum.optimal_duration,
        display=r"\tau_1 = \sqrt{2}\,\bigl||E_1|^{1/2} - |E_0|^{1/2}\bigr|\, l^{-1/2}",
    )


@claim(
    "(3.9): ρ",
    "the constant ρ with its sign",
    verdict="holds",
    remark="True for E1 ≠ E0. Where the energy falls (|E1| > |E0|), ρ > 0 and p_E < 0: the thrust brakes.",
)
def rho_with_its_sign() -> Evidence:
    def argument() -> Steps:
        ending = 1 - kepler_optimum.terminal_costate() * kepler_optimum.optimal_duration() / 2
        for E0, E1, size in ((-1, -4, 1), (-4, -1, -2)):
            at = {energy0: E0, energy1: E1, price: 2}
            found = kepler_optimum.terminal_costate().subs(at)
            yield f"from {E0} to {E1} with l = 2: ρ = {found}", found == size
            yield "and 1 − ½ρτ1 = (E0/E1)^(1/2) > 0", vanishes(ending.subs(at) - sp.sqrt(R(E0, E1)))

    size = (2 * price / sp.Abs(energy1)) ** R(1, 2)
    formula = Equality(
        {r"\rho": size * sp.sign(1 - (energy0 / energy1) ** R(1, 2))},
        kepler_optimum.terminal_costate,
    )
    return Proof(
        argument,
        formula,
        display=r"\rho = (2l/|E_1|)^{1/2}\operatorname{sign}[1 - (E_0/E_1)^{1/2}]",
    )
