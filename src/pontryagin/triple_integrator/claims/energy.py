"""Section 2, (2.1) to (2.3): the least-energy programme."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Consequence,
    Equality,
    Evidence,
    Misprint,
    RightSides,
    Steps,
    Unreadable,
    vanishes,
)
from pontryagin.triple_integrator.derivation import channel, energy
from pontryagin.triple_integrator.derivation.channel import drive, tau, tf
from pontryagin.triple_integrator.derivation.model import T, c, impulse_response, moments_of, multipliers, s

claim = Page("Gorelov & Morozova 2012")

R = sp.Rational
c1, c2, c3 = c
to_go = tf - tau


def inverse_form() -> sp.Expr:
    """c' D^-1 c."""
    return sp.expand((c.T * energy.gramian().inv() * c)[0])


def gramian_is_definite() -> bool:
    """Whether l'Dl > 0 for every l other than 0: the leading minors of D are positive."""
    return all(energy.gramian()[:k, :k].det().is_positive for k in (1, 2, 3))


def silent_control() -> sp.Expr:
    """A control whose moments are 0: a quartic in the time to go, with two free coefficients."""
    coefficients = sp.symbols("n_0:5", real=True)
    control = sum(n * s**k for k, n in enumerate(coefficients))
    silent = sp.solve(list(moments_of(control)), coefficients[:3], dict=True)[0]
    return sp.expand(control.subs(silent))


def in_paper_time(program: sp.Expr) -> sp.Expr:
    """A function of the time to go as a function of tau."""
    return program.subs(s, to_go)


@claim(
    "before (2.1): dual problem",
    "the least L2 norm of h on l'c = 1 is the least (l'Dl)^(1/2)",
    verdict="holds",
)
def dual_norm_in_l2() -> Evidence:
    def derived() -> RightSides:
        h = sp.expand((multipliers.T * impulse_response())[0] ** 2)
        return sp.integrate(h, (s, 0, T))

    printed = sp.expand((multipliers.T * energy.gramian() * multipliers)[0])
    return Equality(
        {r"\lVert h(\cdot) \rVert_{L_2}^2": printed},
        derived,
        display=r"\min_{h(\cdot) \in P} \lVert h(\cdot) \rVert_{L_2} = "
        r"\min_{l^T c=1} \left[l^T D l\right]^{1/2} = \rho_0",
    )


@claim.proof(
    "before (2.1): Gramian",
    "D = W(tf, t0), the integral of Φbb'Φ', is the controllability Gramian",
    display=r"D = W(t_f, t_0) = \int_{t_0}^{t_f} \Phi(t_f, \tau) b b^T \Phi^T(t_f, \tau)\,d\tau",
)
def definition_of_the_gramian() -> Steps:
    candidate = energy.gramian()
    yield "it solves dW/dT = AW + WA' + bb'", vanishes(energy.lyapunov_residual(candidate))
    yield "D is zero at T = 0", vanishes(candidate.subs(T, 0))
    program = energy.minimum_energy_control()
    end = drive(sp.zeros(3, 1), T, program.subs(s, T - tau))
    yield "b'Φ'D⁻¹c takes the channel from rest to c", vanishes(end - c)


@claim(
    "(2.1)",
    "the Gramian in powers of T",
    verdict="unreadable",
    remark="The scan has shuffled the entries: its first row and column cannot be read (it shows T⁵/6, T⁴/2, "
    "T³/2; 20/8; T⁴/8), and what it shows is not symmetric. The lower right block can be read and is right. "
    "Derived: D = [[T⁵/20, T⁴/8, T³/6], [T⁴/8, T³/3, T²/2], [T³/6, T²/2, T]].",
)
def gramian_in_powers() -> Evidence:
    keys = [f"D_{{{i}{j}}}" for i in (1, 2, 3) for j in (1, 2, 3)]
    seen = [T**5 / 6, T**4 / 2, T**3 / 2, R(20, 8), T**3 / 3, T**2 / 2, T**4 / 8, T**2 / 2, T]
    return Unreadable(
        dict(zip(keys, seen, strict=True)),
        energy.gramian,
        legible=("D_{22}", "D_{23}", "D_{32}", "D_{33}"),
        display=r"D = \begin{bmatrix} \frac{T^5}{6} & \frac{T^4}{2} & \frac{T^3}{2} \\ \frac{20}{8} & "
        r"\frac{T^3}{3} & "
        r"\frac{T^2}{2} \\ \frac{T^4}{8} & \frac{T^2}{2} & T \end{bmatrix}",
    )


@claim("after (2.1): λ", "Lagrange multiplier λ = −2 (c'D⁻¹c)⁻¹", verdict="holds")
def lagrange_multiplier() -> Evidence:
    return Equality(
        {r"\lambda": -2 / inverse_form()},
        lambda: energy.stationary()[0],
        display=r"\lambda = -2(\mathbf{c}^T \mathbf{D}^{-1} \mathbf{c})^{-1}",
    )


@claim("after (2.1): l0", "l0 = (c'D⁻¹c)⁻¹ D⁻¹c", verdict="holds")
def minimal_multipliers() -> Evidence:
    printed = energy.gramian().inv() * c / inverse_form()
    return Equality(
        {r"\mathbf{l}_0": printed},
        lambda: energy.stationary()[1],
        display=r"\mathbf{l}_0 = (\mathbf{c}^T \mathbf{D}^{-1} \mathbf{c})^{-1} \mathbf{D}^{-1} \mathbf{c}",
    )


@claim("after (2.1): ρ0", "ρ0 = (c'D⁻¹c)^(−1/2)", verdict="holds")
def least_dual_norm() -> Evidence:
    return Equality(
        {r"\rho_0^2": 1 / inverse_form()},
        lambda: energy.dual_norm() ** 2,
        display=r"\rho_0 = (\mathbf{c}^T \mathbf{D}^{-1} \mathbf{c})^{-1/2}",
    )


@claim("after (2.1): h0", "h0(τ) = (c'D⁻¹c)⁻¹ c'D⁻¹ Φ(tf, τ)b", verdict="holds")
def minimal_element() -> Evidence:
    printed = (c.T * energy.gramian().inv() * impulse_response())[0] / inverse_form()
    return Equality(
        {r"h_0(\tau)": in_paper_time(printed)},
        lambda: in_paper_time(energy.minimal_element()),
        display=r"h_0(\tau) = (\mathbf{c}^T \mathbf{D}^{-1} \mathbf{c})^{-1} \mathbf{c}^T \mathbf{D}^{-1} "
        r"\Phi(t_f, \tau)\mathbf{b}",
    )


@claim.proof(
    "before (2.2): conditions",
    "max ∫h0 u = 1 with ‖u‖ = 1/ρ0 is met by u = μ h0, μ > 0",
    display=r"\max_{u(\cdot)} \int_{t_0}^{t_f} h_0(\tau)u(\tau)\,d\tau = 1,\quad "
    r"\left(\int_{t_0}^{t_f} u^2(\tau)\,d\tau\right)^{1/2} = \frac{1}{\rho_0}",
)
def conditions_on_the_optimum() -> Steps:
    square = sp.Symbol("H", positive=True)
    # For u = mu h0 + n with n orthogonal to h0, |u|^2 = mu^2 H + N and the pairing is mu H.
    factor, rest = sp.symbols("mu N", nonnegative=True)
    pairing = factor * square
    norm = factor**2 * square + rest
    yield (
        "the pairing is largest for a given norm when n = 0",
        sp.diff(norm, rest) == 1 and not pairing.has(rest),
    )
    program = energy.minimum_energy_control()
    ratio = sp.cancel(program / energy.minimal_element())
    yield "the programme is a multiple of h0", not ratio.has(s)
    yield "the factor is c'D⁻¹c, which is positive", vanishes(ratio - inverse_form())


@claim("before (2.2): μ", "μ = 1/ρ0²", verdict="holds")
def multiplier_of_the_optimum() -> Evidence:
    def derived() -> RightSides:
        factor = sp.Symbol("mu")
        reached = moments_of(factor * energy.minimal_element())
        return sp.solve(sp.cancel(reached[0]) - c1, factor)[0]

    return Equality({r"\mu": inverse_form()}, derived, display=r"\mu = \frac{1}{\rho_0^2}")


@claim("(2.2)", "least-energy programme u* = c'D⁻¹ Φ(tf, τ)b", verdict="holds")
def least_energy_programme() -> Evidence:
    printed = (c.T * energy.gramian().inv() * impulse_response())[0]
    return Equality(
        {r"u^*(\tau)": in_paper_time(printed)},
        lambda: in_paper_time(energy.minimum_energy_control()),
        display=r"u^*(\tau) = \mathbf{c}^T \mathbf{D}^{-1} \Phi(t_f, \tau)\mathbf{b}",
    )


@claim("after (2.2): norm", "‖u*‖ = (c'D⁻¹c)^(1/2)", verdict="holds")
def norm_of_the_programme() -> Evidence:
    return Equality(
        {r"\lVert u^* \rVert_{L_2}^2": inverse_form()},
        lambda: sp.integrate(sp.expand(energy.minimum_energy_control() ** 2), (s, 0, T)),
        display=r"\lVert u^*(\cdot) \rVert_{L_2} = (\mathbf{c}^T \mathbf{D}^{-1} \mathbf{c})^{1/2}",
    )


@claim.proof("after (2.2): solution", "this programme solves problem 1 for arbitrary ends")
def general_solution() -> Steps:
    force = sp.Symbol("f_0", real=True)
    end = channel.transfer(force).subs(tau, T)
    yield "it steers any x0 to any xf, with a constant disturbance", vanishes(end - channel.final)
    program = energy.minimum_energy_control()
    cross = sp.integrate(sp.expand(program * silent_control()), (s, 0, T))
    yield "the difference of any other control is orthogonal to it, and adds to the norm", vanishes(cross)


@claim(
    "(2.3)",
    "the least-energy programme written out",
    verdict="misprint",
    remark="Printed: the last bracket has 20c1/T². Right: 20c1/(3T²), as (2.2) gives and as the paper's own "
    "(2.5) uses: with the print, example 1 would have the constant 180γ/T³ instead of 60γ/T³ and overshoot.",
)
def programme_written_out() -> Evidence:
    key = r"u^*(\tau)"
    printed = (
        30 * to_go**2 / T**3 * (12 * c1 / T**2 - 6 * c2 / T + c3)
        - 36 * to_go / T**2 * (10 * c1 / T**2 - 16 * c2 / (3 * T) + c3)
        + 9 / T * (20 * c1 / T**2 - 4 * c2 / T + c3)
    )

    def consequence() -> Consequence:
        turned = printed.subs({c1: 1, c2: 0, c3: 0, T: 1, tf: 1})
        return Consequence(
            "state that it reaches instead of (1, 0, 0) in unit time",
            drive(sp.zeros(3, 1), sp.S.One, turned),
            sp.Matrix([1, 0, 0]),
        )

    return Misprint(
        {key: printed},
        lambda: in_paper_time(energy.minimum_energy_control()),
        defect={key: 120 * c1 / T**3},
        consequence=consequence,
        display=r"u^*(\tau) = \frac{30(t_f - \tau)^2}{T^3}\left(\frac{12c_1}{T^2} - \frac{6c_2}{T} + "
        r"c_3\right) - "
        r"\frac{36(t_f - \tau)}{T^2}\left(\frac{10c_1}{T^2} - \frac{16c_2}{3T} + c_3\right) + "
        r"\frac{9}{T}\left(\frac{20c_1}{T^2} - \frac{4c_2}{T} + c_3\right)",
    )
