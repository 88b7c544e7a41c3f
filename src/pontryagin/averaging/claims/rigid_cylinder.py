"""Section 3, example 3 continued: controls in a cylinder, to the end of the paper."""

import sympy as sp

from pontryagin.averaging.derivation import rigid_body
from pontryagin.averaging.derivation.rigid_body import a, c, epsilon, h, l, p_a, p_c, p_psi, psi, u
from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Consequence,
    Equality,
    Evidence,
    Misprint,
    Proof,
    RightSides,
    Steps,
    vanishes,
)

claim = Page("Akulenko 1977")

R = sp.Rational
a0, a1 = sp.symbols("a_0 a_1", positive=True)
c0, c1 = sp.symbols("c_0 c_1", real=True)
tau = sp.Symbol("tau", real=True)
T, switch = sp.symbols("tau_1 tau_s", positive=True)
SIGN_P, SIGN_Q = sp.symbols("sigma_p sigma_q", real=True)
"""sign p and sign q, each 1 or -1; p and q are the costates of a and c here."""


def without_phase_costate() -> sp.Matrix:
    """The maximiser on the cylinder at p_psi = 0, with the signs of p and q replaced by symbols."""
    best = rigid_body.cylinder_maximiser().subs(p_psi, 0)
    return best.subs({sp.Abs(p_a): p_a / SIGN_P, sp.sign(p_c): SIGN_Q})


def exact_rates(control: sp.Matrix) -> sp.Matrix:
    """(a', c') per epsilon under a control, not averaged."""
    return rigid_body.slow_rates().subs(dict(zip(u, control, strict=True))).applyfunc(sp.simplify)


@claim.proof(
    "example 3: thrusters",
    "fixed engines bound the moment about z; two vernier engines on the z axis bound the other two by a "
    "circle",
    remark="The bound is a circle of u because I_x = I_y.",
    display=r"u_x^2 + u_y^2 \le l^2,\quad |u_z| \le h",
)
def thrusters() -> Steps:
    arm, thrust = sp.symbols("L f", positive=True)
    heading = sp.Symbol("theta", real=True)
    force = thrust * sp.Matrix([sp.cos(heading), sp.sin(heading), 0])
    place = sp.Matrix([0, 0, arm])
    moment = place.cross(force) + (-place).cross(-force)
    yield "the pair's forces cancel, its moments add", force + (-force) == sp.zeros(3, 1)
    yield "no moment about z", moment[2] == 0
    size = sp.simplify(moment[0] ** 2 + moment[1] ** 2)
    yield "M_x² + M_y² = (2Lf)² whatever its direction", vanishes(size - (2 * arm * thrust) ** 2)
    inertia = rigid_body.moments
    scaled = sum((moment[i] / inertia[i]) ** 2 for i in (0, 1)).subs(rigid_body.SYMMETRIC)
    yield "and u_x² + u_y² = (2Lf/I_x)²", vanishes(scaled - (2 * arm * thrust / inertia[0]) ** 2)


@claim(
    "example 3: controls on the cylinder",
    "u_x = cos ψ sign p, u_y = sin ψ sign p, u_z = sign q",
    verdict="misprint",
    remark="The print lacks the factors: right are l cos ψ sign p, l sin ψ sign p, h sign q. As printed the "
    "control is on its set for l = h = 1 only, and a' = ε sign p, so that the integral of sign p "
    "would be a₁ − a₀, not the printed (a₁ − a₀)/l. The conditions and τ₁ below belong to the right "
    "control.",
)
def controls_on_the_cylinder() -> Evidence:
    keys = ("u_x", "u_y", "u_z")
    printed = sp.Matrix([sp.cos(psi) * SIGN_P, sp.sin(psi) * SIGN_P, SIGN_Q])

    def consequence() -> Consequence:
        rates = [exact_rates(control)[0] for control in (printed, without_phase_costate())]
        numbers = {SIGN_P: -1, l: 3}
        return Consequence("a' per ε for l = 3, sign p = −1", *(rate.subs(numbers) for rate in rates))

    return Misprint(
        dict(zip(keys, printed, strict=True)),
        without_phase_costate,
        defect={
            "u_x": (1 - l) * sp.cos(psi) * SIGN_P,
            "u_y": (1 - l) * sp.sin(psi) * SIGN_P,
            "u_z": (1 - h) * SIGN_Q,
        },
        consequence=consequence,
        display=r"u_x = \cos\psi\,\mathrm{sign}\,p,\quad u_y = \sin\psi\,\mathrm{sign}\,p,\quad u_z = "
        r"\mathrm{sign}\,q",
    )


def constant_costates() -> Steps:
    """On the cylinder the exact costates are constant, p_psi is 0, and H equals the averaged Hamiltonian."""
    whole = rigid_body.cylinder_hamiltonian()
    yield "H does not contain ψ: its costate is constant, and 0 at the end", not whole.has(psi)
    yield "then p' = −∂H/∂a = 0", sp.simplify(whole.diff(a).subs(p_psi, 0)) == 0
    yield "and q' = −∂H/∂c = 0", whole.diff(c).subs(p_psi, 0) == 0


LEVEL = {a0: 2, a1: 1, c0: 1, c1: 2, l: 1, h: 1}
"""Ends at which a and c have equally far to go: a from 2 to 1, c from 1 to 2, with l = h = 1."""

SHORT = {a0: 3, a1: 1, c0: 1, c1: 2, l: 1, h: 1}
"""Ends at which a has farther to go than c: a from 3 to 1, c from 1 to 2, with l = h = 1."""


@claim(
    "example 3: singular controls",
    "the problem with a and c given at the end leads to singular controls",
    verdict="conditional",
    remark="True where |a₁ − a₀|/l ≠ |c₁ − c₀|/h: the costate of the variable that has time to spare is 0 "
    "throughout, and its control may be any that reaches the given value in time, such as a constant "
    "one. Where the two are equal no control is singular: both thrust fully all the time, and both "
    "costates may differ from 0.",
)
def singular_controls() -> Evidence:
    def argument() -> Steps:
        yield from constant_costates()
        kept = sp.Symbol("q", nonzero=True, real=True)
        forced = h * sp.Abs(sp.sign(kept))
        yield "were q ≠ 0, u_z = ±h all the time", forced == h
        spare = (h * T - sp.Abs(c1 - c0)).subs(T, sp.Abs(a1 - a0) / l).subs(SHORT)
        yield (
            "which goes too far where |a₁ − a₀|/l > |c₁ − c₀|/h, as for 2 > 1: so q ≡ 0",
            spare == 1 and spare.is_positive,
        )
        yield "with q ≡ 0, u_z drops out of H", rigid_body.switching()[2].subs(p_c, 0) == 0
        whole = rigid_body.cylinder_hamiltonian().subs({p_psi: 0, p_c: 0})
        yield "H = 0 is met by |p| = 1/l", vanishes(whole.subs(p_a, 1 / l))
        gentle = (c1 - c0) / T
        yield (
            "a constant u_z = (c₁ − c₀)/τ₁ arrives",
            vanishes(c0 + sp.integrate(exact_rates(sp.Matrix([0, 0, gentle]))[1], (tau, 0, T)) - c1),
        )

    def counterexample() -> Steps:
        times = [(sp.Abs(a1 - a0) / l).subs(LEVEL), (sp.Abs(c1 - c0) / h).subs(LEVEL)]
        yield "a from 2 to 1 and c from 1 to 2, l = h = 1: both need τ₁ = 1", times == [1, 1]
        half = {p_psi: 0, p_a: -R(1, 2), p_c: R(1, 2), l: 1, h: 1}
        yield "p = −1/2, q = 1/2 meet H = 0", rigid_body.cylinder_hamiltonian().subs(half) == 0
        control = rigid_body.cylinder_maximiser().subs(half).applyfunc(sp.simplify)
        yield (
            "no switching function vanishes: u = (−cos ψ, −sin ψ, 1)",
            control == sp.Matrix([-sp.cos(psi), -sp.sin(psi), 1]),
        )
        moved = exact_rates(control)
        yield "and it arrives at τ = 1", (2 + moved[0], 1 + moved[1]) == (1, 2)

    return Conditional(argument, counterexample=counterexample)


@claim(
    "example 3: sign p, sign q",
    "sign p and sign q are piecewise constant functions of τ with finitely many jumps",
    verdict="conditional",
    remark="True of one choice of the controls: for a singular control one jump is enough, and its time is "
    "determined. Not true of the signs of the costates, which are constants: they do not jump, and "
    "the one that belongs to the singular control is 0. The jumps are not needed either: a constant "
    "u_z serves as well.",
)
def jumps_of_the_signs() -> Evidence:
    def argument() -> Steps:
        reached = sp.solve(h * (switch - (T - switch)) - (c1 - c0), switch)[0]
        yield (
            "+h up to τ_s, then −h, reaches c₁ for τ_s = (τ₁ + (c₁ − c₀)/h)/2",
            vanishes(reached - (T + (c1 - c0) / h) / 2),
        )
        share = sp.Symbol("sigma", real=True)
        place = (reached / T).subs(c1, c0 + share * h * T)
        yield (
            "which lies in [0, τ₁] where |c₁ − c₀| ≤ hτ₁",
            (place.simplify().subs(share, -1) == 0 and place.simplify().subs(share, 1) == 1),
        )

    def counterexample() -> Steps:
        yield from constant_costates()
        axial = rigid_body.cylinder_maximiser()[2].subs({p_c: 0, h: 1})
        yield "a from 3 to 1, c from 1 to 2, l = h = 1: q ≡ 0, and h sign q = 0", axial == 0
        need = ((c1 - c0) / h).subs(SHORT)
        yield "its integral is 0, where 1 is required", need == 1 and sp.integrate(axial, (tau, 0, 2)) != need

    return Conditional(argument, counterexample=counterexample)


@claim(
    "example 3: integrals",
    "the integrals of sign p and sign q are (a₁ − a₀)/l and (ω_z1 − ω_z0)/h",
    verdict="holds",
    remark="This is exact for every ε: a' = εl sign p, c' = εh sign q without averaging.",
)
def integrals_of_the_signs() -> Evidence:
    def derived() -> RightSides:
        rates = exact_rates(without_phase_costate())
        P, Q = sp.symbols("P Q")
        sums = [(a0 + P * rates[0] / SIGN_P - a1, P), (c0 + Q * rates[1] / SIGN_Q - c1, Q)]
        return [sp.solve(*pair)[0] for pair in sums]

    def argument() -> Steps:
        rates = exact_rates(without_phase_costate())
        yield "a' = εl sign p: ψ drops out", vanishes(rates[0] - l * SIGN_P)
        yield "c' = εh sign q", vanishes(rates[1] - h * SIGN_Q)
        F = rigid_body.phase_rate().subs(dict(zip(u, without_phase_costate(), strict=True)))
        yield "and the control does not touch the phase: F = 0", vanishes(F)

    printed = {
        r"\int_0^{\tau_1}\mathrm{sign}\,p\,d\tau": (a1 - a0) / l,
        r"\int_0^{\tau_1}\mathrm{sign}\,q\,d\tau": (c1 - c0) / h,
    }
    return Proof(argument, Equality(printed, derived))


@claim.proof(
    "example 3: τ1 on the cylinder",
    "τ₁ is the larger of |a₁ − a₀|/l and |ω_z1 − ω_z0|/h",
    remark="This is the exact minimum for every ε, also where ω_z changes its sign on the way: the frequency "
    "vanishes there and averaging would fail, but nothing is averaged.",
    display=r"\tau_1 = \max\{|a_1 - a_0|l^{-1}, |\omega_{z1} - \omega_{z0}|h^{-1}\}",
)
def duration_on_the_cylinder() -> Steps:
    slow = rigid_body.slow_rates()
    across = u[0] * sp.cos(psi) + u[1] * sp.sin(psi)
    aside = u[1] * sp.cos(psi) - u[0] * sp.sin(psi)
    yield "a'/ε = u_x cos ψ + u_y sin ψ", vanishes(slow[0] - across)
    yield "(a'/ε)² = u_x² + u_y² − a square ≤ l²", vanishes(across**2 + aside**2 - u[0] ** 2 - u[1] ** 2)
    yield "c'/ε = u_z, at most h: no control is faster than the larger of the two", slow[1] == u[2]
    share = sp.Symbol("sigma", real=True)
    radial = sp.Matrix([share * l * sp.cos(psi), share * l * sp.sin(psi), u[2]])
    inside = sp.simplify(radial[0] ** 2 + radial[1] ** 2 - share**2 * l**2)
    yield "σl(cos ψ, sin ψ), |σ| ≤ 1, is allowed", inside == 0
    arrival = a0 + sp.integrate(exact_rates(radial)[0], (tau, 0, T)).subs(share, (a1 - a0) / (l * T))
    yield "and with σ = (a₁ − a₀)/(lτ₁) brings a to a₁ at τ₁", vanishes(arrival - a1)
    yield "whatever ω_z does meanwhile", not exact_rates(radial).has(c)


@claim.proof(
    "end of section 3",
    "some other problems of an asymmetric body, for example with viscous friction, can be solved in "
    "the same way",
    remark="Shown on one problem: any body with friction, torques in a ball, brought to rest. The length G "
    "of the angular momentum obeys a closed equation; the solution is exact for every ε.",
)
def other_problems() -> Steps:
    inertia = sp.diag(*rigid_body.moments)
    momentum = inertia * rigid_body.w
    G, friction, start = sp.symbols("G chi G_0", positive=True)
    torque = sp.Matrix(sp.symbols("M_x M_y M_z", real=True))
    applied = torque - friction * momentum
    rates = rigid_body.euler_rates().subs(dict(zip(u, inertia.inv() * applied, strict=True)))
    growth = sp.expand(sp.simplify(momentum.dot(inertia * rates)))
    power = sp.expand(epsilon * (momentum.dot(torque) - friction * momentum.dot(momentum)))
    yield "I_x ≠ I_y ≠ I_z: GG' = ε(K·M − χG²), K = Iω", vanishes(growth - power)
    yield (
        "without torque and friction G is constant",
        power.subs({friction: 0}).subs(dict.fromkeys(torque, 0)) == 0,
    )
    K = sp.Matrix(sp.symbols("K_x K_y K_z", real=True))
    size = sp.sqrt(K.dot(K))
    along = sp.simplify(K.dot(-K / size) / size)
    yield "M = −K/G of the ball |M| ≤ 1 gives G' = −ε(1 + χG)", along == -1
    area = K.cross(torque)
    slack = K.dot(K) * torque.dot(torque) - K.dot(torque) ** 2
    yield "and no other less: (K·M)² ≤ G²M²", vanishes(slack - area.dot(area))
    left = sp.integrate(1 / (1 + friction * G), (G, 0, start))
    yield "at rest after τ₁ = ln(1 + χG₀)/χ", vanishes(left - sp.log(1 + friction * start) / friction)
