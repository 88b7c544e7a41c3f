"""Section 2 up to the 16 equations: costates and the optimal thrust, (8) to (10)."""

import sympy as sp

from pontryagin.evidence import Equality, Proof, Steps, vanishes
from pontryagin.ledger import Page
from pontryagin.rendezvous.derivation import forms, primer, principle, reduction, transversality
from pontryagin.rendezvous.derivation.model import attitude, c, r, thrust
from pontryagin.rendezvous.derivation.principle import energy_weight, mu, nu, peak, rho, s1, time_weight
from pontryagin.rendezvous.derivation.quaternion import conjugate, product

claim = Page("Pimkina & Chelnokov")

e = principle.e
nu1 = nu[0]
magnitude = sp.Symbol("p^0", nonnegative=True)
length = sp.Symbol("|n|", nonnegative=True)
multiplier = sp.Symbol("kappa", positive=True)


@claim("section 2: costates", "μ, ρ, s1, e, Φ*, ψ0 belong to λ, r, v1, c, φ*, g", verdict="holds")
def costates():
    def argument() -> Steps:
        whole = principle.hamiltonian()
        pairs = zip(principle.COSTATE, principle.state_rates(), strict=True)
        yield (
            "the factor of each in H is the rate of its partner",
            all(vanishes(whole.diff(costate) - rate) for costate, rate in pairs),
        )
        running = sp.Symbol("g", real=True)
        yield "H does not hold g: ψ0 is constant, and taken as −1", not whole.has(running)
        yield (
            "the factor of −1 is g' = α1 + α2p²",
            vanishes(whole.subs(dict.fromkeys(principle.COSTATE, 0)) + principle.running_cost()),
        )

    return Proof(argument, display=r"\dot g = \alpha_1 + \alpha_2 p^2,\quad g(t_0) = 0")


@claim("(8)", "the thrust lies along n", verdict="holds", remark="Where n ≠ 0.")
def direction():
    key = r"\bar p_\eta^0"

    def derived():
        n = principle.switching()
        found = sp.solve([*(n - 2 * multiplier * thrust)], list(thrust), dict=True)[0]
        stationary = thrust.subs(found)
        size = principle.size(stationary.subs({e: 0, nu1: 0, s1: length}))
        scale = sp.solve(size - magnitude, multiplier)[0]
        return {key: stationary.subs(multiplier, scale).subs(length, principle.size(n))}

    def argument() -> Steps:
        n, other = principle.switching(), thrust
        gap = n.dot(n) * other.dot(other) - n.dot(other) ** 2
        yield (
            "|n|²|p|² − (n, p)² = |n × p|²: no thrust of the same size has a larger (n, p)",
            vanishes(gap - n.cross(other).dot(n.cross(other))),
        )

    n = sp.Matrix([s1, e * r, r * nu1 / (2 * c)])
    printed = {key: magnitude * n / sp.sqrt(n.dot(n))}
    return Proof(argument, Equality(printed, derived), display=r"\bar p_\eta^0 = p^0\bar n_\eta/|\bar n|")


@claim(
    "(9)",
    "n = s1 i1 + e r i2 + [r ν1/(2c)] i3, and its length",
    verdict="holds",
    remark="The scan prints ν like v; that ν1 is meant, the line after (10) says.",
)
def switching_vector():
    keys = (r"\bar n_\eta", r"|\bar n|")

    def derived():
        return dict(zip(keys, (principle.switching(), principle.size(principle.switching())), strict=True))

    printed = (
        sp.Matrix([s1, e * r, r * nu1 / (2 * c)]),
        sp.sqrt(s1**2 + r**2 * (e**2 + nu1**2 / (4 * c**2))),
    )
    return Equality(dict(zip(keys, printed, strict=True)), derived)


@claim("(10)", "the size of the thrust for α2 > 0: |n|/(2α2), at most p_max", verdict="holds")
def thrust_size():
    keys = (r"p^0", r"p^0_{\max}")
    p = sp.Symbol("p", nonnegative=True)
    share = -energy_weight * p**2 + length * p

    def derived():
        n = {s1: length, e: 0, nu1: 0}
        inside = principle.stationary_magnitude().subs(n)
        saturated = principle.optimal_thrust("saturated").subs(n)
        return dict(zip(keys, (sp.simplify(inside), sp.simplify(principle.size(saturated))), strict=True))

    def argument() -> Steps:
        yield (
            "in p, H is −α2p² + |n|p and what has no p: strictly concave",
            vanishes(share.diff(p, 2) + 2 * energy_weight),
        )
        top = length / (2 * energy_weight)
        yield "largest at |n|/(2α2)", vanishes(share.diff(p).subs(p, top))
        below = peak + sp.Symbol("k", positive=True)
        slope = share.diff(p).subs({length: 2 * energy_weight * below, p: peak})
        yield (
            "and still rising at p_max where |n| > 2α2 p_max",
            vanishes(slope - 2 * energy_weight * (below - peak)),
        )

    return Proof(
        argument,
        Equality(dict(zip(keys, (length / (2 * energy_weight), peak), strict=True)), derived),
        display=r"\alpha_2 > 0:\ p^0 = \begin{cases} (2\alpha_2)^{-1}|\bar n|, & (2\alpha_2)^{-1}|\bar n| "
        r"\le p_{\max} \\ p_{\max}, & (2\alpha_2)^{-1}|\bar n| > p_{\max} \end{cases}",
    )


@claim(
    "(10), α2 = 0",
    "without α2 the thrust is always p_max",
    verdict="holds",
    remark="But for instants with n = 0. That n cannot stay 0 is not shown there; for α1 > 0 it cannot.",
)
def no_singular_arcs():
    def argument() -> Steps:
        p = sp.Symbol("p", nonnegative=True)
        yield "H rises with p at the rate |n|, so p = p_max where n ≠ 0", (length * p).diff(p) == length
        n, carried = principle.switching(), primer.carried()
        second = primer.second_rate() - primer.gravity_gradient() * n
        yield "n'' = G n in inertial axes, linear in n", vanishes(second.applyfunc(sp.simplify))
        unknowns = [rho, s1, e, *nu]
        (only,) = sp.linsolve([*n, *carried], unknowns)
        yield "n = n' = 0 at an instant makes ρ, s1, e, ν all 0", all(value == 0 for value in only)
        nothing = dict.fromkeys(unknowns, 0)
        constant = transversality.anomaly_constant_at_the_end().subs(nothing)
        yield "then (16) gives C_φ = 0", constant == 0
        nothing |= {reduction.anomaly_constant: constant, energy_weight: 0}
        energy = reduction.hamiltonian().subs(nothing)
        yield "and (17) says −α1 = 0", vanishes(energy + time_weight)

    return Proof(argument, display=r"\alpha_2 = 0:\ p^0 = p_{\max}")


@claim("after (10): ν", "ν1 is a component of ν = λ~∘μ", verdict="holds")
def variable_nu():
    key = r"\nu_1"

    def derived():
        gradient = (principle.hamiltonian() + principle.running_cost()).diff(thrust[2])
        return {key: sp.expand(2 * c / r * gradient)}

    return Equality(
        {key: product(conjugate(attitude), mu)[1]},
        derived,
        display=r"\bar\nu = \nu_0 + \nu_1\bar i_1 + \nu_2\bar i_2 + \nu_3\bar i_3 = "
        r"\tilde{\bar\lambda}\circ\bar\mu",
    )


@claim("section 2: 16", "the problem comes to 16 differential equations", verdict="holds")
def sixteen():
    def argument() -> Steps:
        form = forms.full("unsaturated")
        yield "eight for r, v1, c, φ*, λ and eight for their costates", len(form.rates) == 16
        outside = set().union(*(rate.free_symbols for rate in form.rates)) - set(form.states)
        yield "with the optimal thrust they hold nothing else that changes", outside <= set(form.parameters)
        flow = [principle.hamiltonian().diff(x) for x in principle.COSTATE]
        yield "they are Hamilton's equations of H", vanishes(sp.Matrix(flow) - principle.state_rates())

    return Proof(argument)
