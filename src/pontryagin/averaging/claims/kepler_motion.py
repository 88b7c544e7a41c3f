"""Section 3, example 2, up to (3.5): motion in the central field and its phase."""

import sympy as sp

from pontryagin.averaging.derivation import kepler, kepler_phase
from pontryagin.averaging.derivation.kepler import (
    anomaly,
    e,
    eccentric,
    energy,
    epsilon,
    gamma,
    momentum,
    parameter,
    phi,
    r,
    t,
    u_radial,
    u_transverse,
    v_radial,
    v_transverse,
)
from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Equality,
    Evidence,
    Proof,
    Steps,
    vanishes,
)

claim = Page("Akulenko 1977")

R = sp.Rational
p = parameter()
COAST = {u_radial: 0, u_transverse: 0}
PRINTED_ENERGY = (v_radial**2 + v_transverse**2) / 2 - r**-1
PRINTED_ECCENTRICITY = sp.sqrt(1 + 2 * energy * momentum**2)
PRINTED_PERIOD = 2 * sp.pi * (2 * sp.Abs(energy)) ** R(-3, 2)
PRINTED_TIME = (2 * sp.Abs(energy)) ** R(-3, 2) * (eccentric - e * sp.sin(eccentric))
CIRCLE = {energy: -R(1, 2), momentum: 1}


@claim(
    "(3.3)", "controlled motion in the plane of a gravitating centre, in polar coordinates", verdict="holds"
)
def equations_of_motion() -> Evidence:
    printed = {
        r"\dot r": v_radial,
        r"\dot\varphi": v_transverse * r**-1,
        r"\dot v_r": v_transverse**2 * r**-1 - r**-2 + epsilon * u_radial,
        r"\dot v_\varphi": -v_radial * v_transverse * r**-1 + epsilon * u_transverse,
    }
    return Equality(printed, kepler.equations_of_motion)


@claim.proof("after (3.3): ε = 0", "for ε = 0 the system is integrable")
def integrable() -> Steps:
    coast = [kepler.along_the_motion(part).subs(COAST) for part in kepler.laplace()]
    yield "both components of Laplace's vector are constant without thrust", all(map(vanishes, coast))
    kept = sp.Matrix([kepler.energy_of_state(), kepler.momentum_of_state(), *kepler.laplace()])
    point = {r: 1, phi: 0, v_radial: R(1, 5), v_transverse: R(6, 5)}
    rank = kept.jacobian(kepler.STATE).subs(point).rank()
    yield "with E and K three of the four constants are independent: the orbit is known", rank == 3
    slope = kepler.ellipse_radius() / sp.sqrt(-2 * energy)
    yield (
        "time along it is the quadrature of (3.4)",
        vanishes(kepler.time_of_flight().diff(eccentric) - slope),
    )


@claim("(3.4): E and K", "the energy and the angular momentum as integrals", verdict="holds")
def integrals() -> Evidence:
    def argument() -> Steps:
        for name, integral in (("½(v_r² + v_φ²) − 1/r", PRINTED_ENERGY), ("r v_φ", r * v_transverse)):
            yield (
                f"{name} is constant without thrust",
                vanishes(kepler.along_the_motion(integral).subs(COAST)),
            )

    printed = {"E": PRINTED_ENERGY, "K": r * v_transverse}
    formula = Equality(printed, lambda: {"E": kepler.energy_of_state(), "K": kepler.momentum_of_state()})
    return Proof(argument, formula)


@claim("(3.4): orbit", "the orbit as a conic in the true anomaly", verdict="holds")
def conic() -> Evidence:
    return Equality(
        {"r": p * (1 + e * sp.cos(anomaly)) ** -1},
        lambda: kepler.conic()[r],
        display=r"r = p(1 + e\cos x)^{-1}",
    )


@claim("(3.4): ξ", "the radius in the eccentric anomaly", verdict="holds")
def radius_in_the_eccentric_anomaly() -> Evidence:
    return Equality(
        {"r": R(1, 2) * sp.Abs(energy) ** -1 * (1 - e * sp.cos(eccentric))},
        kepler.ellipse_radius,
        display=r"r = \tfrac12 |E|^{-1}(1 - e\cos\xi)",
    )


@claim("(3.4): time", "Kepler's equation: the time in the eccentric anomaly", verdict="holds")
def kepler_equation() -> Evidence:
    return Equality(
        {r"t + \delta": PRINTED_TIME},
        kepler.time_of_flight,
        display=r"t + \delta = (2|E|)^{-3/2}(\xi - e\sin\xi)",
    )


@claim("after (3.4): p", "the focal parameter is K²", verdict="holds")
def focal_parameter() -> Evidence:
    return Equality({"p": momentum**2}, parameter)


@claim(
    "after (3.4): e",
    "the eccentricity, strictly between 0 and 1 for E < 0, K > 0",
    verdict="conditional",
    remark="True unless E = −1/(2K²), the least energy for the given K. The orbit is then a circle: e = 0, γ "
    "is not defined and (3.6) divides by zero. There e cos γ and e sin γ have to replace e and γ.",
)
def eccentricity() -> Evidence:
    def argument() -> Steps:
        K = momentum
        room = PRINTED_ECCENTRICITY**2
        yield "1 − e² = −2EK² > 0: e < 1 for E < 0, K > 0", (1 - room).expand().is_positive is True
        least = v_radial**2 + (K / r - 1 / K) ** 2
        surplus = 2 * (PRINTED_ENERGY.subs(v_transverse, K / r) + 1 / (2 * K**2)) - least
        yield "2E + 1/K² = v_r² + (K/r − 1/K)² ≥ 0: e is real, and 0 only on a circle", vanishes(surplus)

    def counterexample() -> Steps:
        at = {r: 1, v_radial: 0, v_transverse: 1}
        values = [kepler.energy_of_state().subs(at), kepler.momentum_of_state().subs(at)]
        yield "on the circle r = 1, v_r = 0, v_φ = 1: E = −1/2, K = 1", values == list(CIRCLE.values())
        yield "e = (1 + 2EK²)^(1/2) = 0", PRINTED_ECCENTRICITY.subs(CIRCLE) == 0
        yield "and Laplace's vector vanishes", kepler.laplace().subs(at).is_zero_matrix

    formula = Equality({"e": PRINTED_ECCENTRICITY}, kepler.eccentricity)
    return Conditional(
        argument, formula, counterexample=counterexample, display=r"0 < e = (1 + 2EK^2)^{1/2} < 1"
    )


@claim.proof(
    "after (3.4): γ, δ", "x = φ − γ; γ and δ are arbitrary constants", display=r"x = \varphi - \gamma"
)
def arbitrary_constants() -> Steps:
    rates = kepler.equations_of_motion()
    yield "the equations hold neither φ nor t: an orbit may be turned and delayed", not rates.has(phi, t)
    along = kepler.laplace().applyfunc(kepler.on_the_orbit)
    straight = sp.Matrix([e * sp.cos(gamma), e * sp.sin(gamma)])
    yield (
        "with φ = γ + x Laplace's vector has the direction γ, and is constant",
        vanishes((along - straight).applyfunc(sp.expand_trig)),
    )


@claim.proof(
    "after (3.4): period",
    "the motion is bounded and periodic, and its period depends on the energy only",
    remark="This holds for E < 0.",
)
def bounded_and_periodic() -> Steps:
    radius = kepler.ellipse_radius()
    ends = [radius.subs(eccentric, angle) for angle in (0, sp.pi)]
    yield (
        "r stays between (1 − e)/(2|E|) and (1 + e)/(2|E|)",
        [vanishes(end - (1 + sign * e) / (-2 * energy)) for end, sign in zip(ends, (-1, 1), strict=True)]
        == [True, True],
    )
    slope = kepler.time_of_flight().diff(eccentric)
    yield "time grows with ξ: dt/dξ = r/(2|E|)^(1/2)", vanishes(slope - radius / sp.sqrt(-2 * energy))
    lap = kepler.time_of_flight().subs(eccentric, eccentric + 2 * sp.pi) - kepler.time_of_flight()
    yield "a turn in ξ takes T(E), whatever e", sp.simplify(lap).free_symbols == {energy}


@claim("after (3.4): T(E)", "the period", verdict="holds")
def period() -> Evidence:
    return Equality(
        {"T(E)": PRINTED_PERIOD},
        kepler.period,
        display=r"T(E) = 2\pi(2|E|)^{-3/2}",
    )


@claim.proof("before (3.5): 2π", "φ grows by 2π in a period")
def full_turn() -> Steps:
    psi = kepler_phase.mean_of_true()
    yield "ψ(x) has the slope dψ/dx of (3.5)", vanishes(psi.diff(anomaly) - kepler.weight())
    yield (
        "ψ(x + 2π) = ψ(x) + 2π: the bracket of (3.5) has the mean 0",
        vanishes(psi.subs(anomaly, anomaly + 2 * sp.pi) - psi - 2 * sp.pi),
    )
    yield "and ψ grows by 2π in T", vanishes(kepler.mean_motion() * kepler.period() - 2 * sp.pi)


@claim("(3.5)", "the true anomaly in terms of the mean anomaly ψ", verdict="holds")
def true_and_mean_anomaly() -> Evidence:
    bracket = (1 - e**2) ** R(3, 2) / (1 + e * sp.cos(anomaly)) ** 2 - 1
    printed = {r"d(x - \psi)/dx": -bracket, r"\psi": 2 * sp.pi / PRINTED_PERIOD * PRINTED_TIME}

    def argument() -> Steps:
        psi = kepler_phase.mean_of_true()
        yield (
            "x and ψ vanish together, at the pericentre: the integral starts at 0",
            psi.subs(anomaly, 0) == 0,
        )
        yield "and t + δ with them", kepler.time_of_flight().subs(eccentric, 0) == 0

    return Proof(
        argument,
        Equality(printed, lambda: (1 - kepler.weight(), kepler_phase.mean_anomaly())),
        display=r"x = \psi - \int_0^x \left[\frac{(1 - e^2)^{3/2}}{(1 + e\cos y)^2} - 1\right] dy,\quad "
        r"\psi = \frac{2\pi}{T}(t + \delta)",
    )
