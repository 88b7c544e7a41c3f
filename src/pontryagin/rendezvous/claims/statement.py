"""Section 1 up to the functional: the statement of the problem, (1), (2), (3), (4), (5), (6)."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Equality,
    Proof,
    RightSides,
    Steps,
    vanishes,
)
from pontryagin.rendezvous.claims import meetings
from pontryagin.rendezvous.derivation import forms, model, principle, transversality
from pontryagin.rendezvous.derivation.model import (
    EX,
    EY,
    EZ,
    GAUSS,
    anomaly,
    areal,
    attitude,
    c,
    eccentricity,
    gravity,
    orientation,
    parameter,
    r,
    thrust,
    v1,
)
from pontryagin.rendezvous.derivation.quaternion import conjugate, product, rotated

claim = Page("Pimkina & Chelnokov")

p1, p2, p3 = thrust
growth = 1 + eccentricity * sp.cos(anomaly)
omega = sp.Matrix([r * p3 / c, 0, c / r**2])
lam = attitude


def at_unit_norm(expression: sp.Expr, quaternion: sp.Matrix = attitude) -> sp.Expr:
    """A polynomial in the components of a unit quaternion, reduced by the condition that its norm is 1."""
    first, *others = quaternion
    remainder = sp.rem(sp.expand(expression), quaternion.dot(quaternion) - 1, first)
    return sp.simplify(remainder.subs(first**2, 1 - sum(part**2 for part in others)))


@claim.proof(
    "abstract",
    "nonlinear transformations lower the dimension of the boundary value problem",
    remark="The dimension falls to that of ten equations and one quadrature, which the paper does not have: "
    "see the entry on the conclusion.",
)
def lower_dimension() -> Steps:
    counts = [len(form("unsaturated").states) for form in (forms.full, forms.repaired)]
    yield "16 equations become 11 with the angle χ about ν*", counts == [16, 11]
    found = meetings.singular_values(meetings.INCLINED[0], repaired=True)
    yield (
        "seven conditions (5), (6), (n, p) = α1 + α2p² fix seven unknowns: at a meeting their Jacobian "
        f"has singular values from {found[0]:.0f} to {found[-1]:.4f}",
        len(found) == 7 and found[-1] > 1e-3,
    )
    yield from meetings.true_meeting(meetings.INCLINED)


@claim.proof(
    "(1)", "the thrust is bounded: 0 ≤ p ≤ p_max", display=r"0 \le p \le p_{\max} < \infty,\quad p = |\bar p|"
)
def bound() -> Steps:
    excess = sp.Symbol("k", positive=True)
    reached = {principle.switching_length: 2 * principle.energy_weight * principle.peak + excess}
    within, beyond, _ = principle.best_magnitudes()
    free = within.subs(reached) - principle.peak
    yield (
        "where |n| = 2α2 p_max + k, H is largest at p_max + k/(2α2): the bound is felt",
        vanishes(free - excess / (2 * principle.energy_weight)),
    )
    yield "among 0 ≤ p ≤ p_max it is then largest at p_max", beyond == principle.peak
    saturated = principle.optimal_thrust("saturated")
    yield "and the thrust of (8) has that size", vanishes(saturated.dot(saturated) - principle.peak**2)
    yield (
        "both cases of (10) meet at |n| = 2α2 p_max",
        vanishes((within - beyond).subs(reached).subs(excess, 0)),
    )


@claim("(2)", "v1' = c²/r³ − fM/r² + p1, r' = v1, c' = r p2", verdict="holds")
def translation() -> Equality:
    def derived() -> RightSides:
        rates = model.motion()[0]
        return rates[1], rates[0], rates[2]

    printed = {r"\dot v_1": c**2 / r**3 - gravity / r**2 + p1, r"\dot r": v1, r"\dot c": r * p2}
    return Equality(printed, derived)


@claim("(3)", "2λ' = λ∘ω, ω = (r p3/c) i1 + (c/r²) i3, φ*' = c*(1 + e* cos φ*)²/p*²", verdict="holds")
def attitude_and_anomaly() -> Equality:
    printed = {
        r"2\dot{\bar\lambda}": product(lam, sp.Matrix([0, *omega])),
        r"\bar\omega_\eta": omega,
        r"\dot\varphi^*": areal * growth**2 / parameter**2,
    }

    return Equality(
        printed,
        lambda: (2 * model.attitude_rate(), model.motion()[1], model.anomaly_rate()),
        display=r"2\dot{\bar\lambda} = \bar\lambda\circ\bar\omega_\eta,\quad \bar\omega_\eta = "
        r"(rp_3/c)\bar i_1 + (c/r^2)\bar i_3,\quad \dot\varphi^* = c^*(1 + e^*\cos\varphi^*)^2/p^{*2}",
    )


@claim.proof(
    "(4)",
    "the initial state is given by r, v1, c, λ and φ*",
    display=r"r(0) = r^0,\ v_1(0) = v_1^0,\ c(0) = c^0,\ \bar\lambda(0) = \bar\lambda^0,\ "
    r"\varphi^*(0) = \varphi_0^*",
)
def initial_state() -> Steps:
    place, velocity = model.cartesian()
    yield "|R| = r", vanishes(at_unit_norm(place.dot(place)) - r**2)
    yield "(R, V) = r v1", vanishes(at_unit_norm(place.dot(velocity)) - r * v1)
    moment = place.cross(velocity) - c * rotated(EZ, lam)
    yield "R × V = c η3", all(vanishes(at_unit_norm(part)) for part in moment)
    other = dict(zip(lam, -lam, strict=True))
    same = (place - place.subs(other, simultaneous=True)).applyfunc(sp.expand)
    yield "λ and −λ are one place and one velocity", same.is_zero_matrix


@claim("(5)", "r, v1 and c of the target at its true anomaly", verdict="holds")
def ends() -> Equality:
    printed = {
        "r^*": parameter / growth,
        "v_1^*": eccentricity * areal * sp.sin(anomaly) / parameter,
        "c^*": areal,
    }

    return Equality(printed, lambda: transversality.meeting()[:3])


@claim("(6)", "the attitude of the target, and vect(λ~∘λ*) = 0 for the same attitude", verdict="holds")
def attitude_at_the_end() -> Proof:
    turned = sp.Matrix([sp.cos(anomaly / 2), 0, 0, sp.sin(anomaly / 2)])

    def argument() -> Steps:
        relative = sp.Matrix(sp.symbols("q0:4", real=True))
        pair = product(conjugate(lam), product(lam, relative))
        same = all(vanishes(at_unit_norm(a - b)) for a, b in zip(pair, relative, strict=True))
        yield "for λ* = λ∘q, λ~∘λ* is q, a unit quaternion", same
        alone = sp.solve([relative[0] ** 2 - 1], [relative[0]])
        yield "vect q = 0 leaves q = 1 and q = −1: λ* = ±λ, one attitude", set(alone) == {(-1,), (1,)}
        place = rotated(EX, model.target_attitude())
        in_orbit = rotated(sp.cos(anomaly) * EX + sp.sin(anomaly) * EY, orientation)
        difference = (place - in_orbit).applyfunc(lambda part: sp.simplify(sp.expand(part)))
        yield "η1* is the axis of the pericentre turned by φ* in the orbit", vanishes(difference)

    return Proof(
        argument,
        Equality({r"\bar\lambda^*": product(orientation, turned)}, model.target_attitude),
        display=r"\operatorname{vect}(\tilde{\bar\lambda}(t_k)\circ\bar\lambda^*(t_k)) = 0,\quad "
        r"\bar\lambda^* = \bar\Lambda^*\circ[\cos(\varphi_k^*/2) + \bar i_3\sin(\varphi_k^*/2)]",
    )


@claim.proof("section 1: c*", "R* × V* is constant")
def constant_area() -> Steps:
    free = dict.fromkeys(thrust, 0)
    yield "without thrust c' = 0", vanishes(model.motion()[0][2].subs(free))
    normal = rotated(EZ, lam)
    change = normal.jacobian(lam) * model.attitude_rate().subs(free)
    yield "and η3 stays where it is", vanishes(change.applyfunc(sp.expand))


@claim.proof("section 1: η*", "η1* points along R* and η3* along c*, and v1* is the projection of V* on η1*")
def axes_of_the_target() -> Steps:
    place, velocity = model.cartesian()
    yield "R lies along η1", vanishes((place - r * rotated(EX, lam)).applyfunc(sp.expand))
    moment = place.cross(velocity)
    yield "R × V has nothing along η1", vanishes(at_unit_norm(moment.dot(rotated(EX, lam))))
    yield "and nothing along η2", vanishes(at_unit_norm(moment.dot(rotated(EY, lam))))
    yield "(V, η1) = v1", vanishes(at_unit_norm(velocity.dot(rotated(EX, lam))) - v1)


@claim.proof("section 1: Λ*", "Λ* follows from the node, the inclination and the pericentre's argument")
def orientation_by_angles() -> Steps:
    node, tilt, pericentre = angles = sp.symbols("Omega I omega", real=True)

    def rational(vector: sp.Matrix) -> sp.Matrix:
        """A vector of trigonometric functions as rational functions of the tangents of half-angles."""
        halves = {angle: 2 * sp.atan(sp.Symbol(f"x_{angle}", real=True)) for angle in angles}
        return vector.subs(halves).applyfunc(lambda part: sp.cancel(sp.expand_trig(part)))

    found = model.orientation_from_angles(node, tilt, pericentre)
    normal = rotated(EZ, found)
    expected = sp.Matrix([sp.sin(tilt) * sp.sin(node), -sp.sin(tilt) * sp.cos(node), sp.cos(tilt)])
    yield "the orbit's normal has the inclination and the node", vanishes(rational(normal - expected))
    line = sp.Matrix([sp.cos(node), sp.sin(node), 0])
    back = rotated(sp.cos(pericentre) * EX - sp.sin(pericentre) * EY, found)
    yield "the pericentre is ω past the line of nodes", vanishes(rational(back - line))
    yield "|Λ*| = 1", vanishes(sp.simplify(found.dot(found)) - 1)


@claim(
    "section 1: given",
    "p*, e*, c*, Λ* and φ0* are given",
    verdict="conditional",
    remark="One of p* and c* follows from the other: c*² = fM p*. Otherwise (5) does not describe the motion "
    "of a coasting craft.",
)
def given_quantities() -> Conditional:
    def left_over() -> sp.Expr:
        radius, speed = model.target_radius(), model.target_radial_velocity()
        fall = areal**2 / radius**3 - gravity / radius**2
        return sp.simplify(speed.diff(anomaly) * model.anomaly_rate() - fall)

    def argument() -> Steps:
        yield "(5) obeys (2) without thrust if fM = c*²/p*", vanishes(left_over().subs(gravity, GAUSS))
        yield (
            "and p* = c*²/fM is what Newton's law gives",
            vanishes(model.conic()[1].subs(gravity, GAUSS) - 1 / parameter),
        )

    def counterexample() -> Steps:
        wrong = {areal: sp.Rational(11, 10), parameter: 1, gravity: 1, eccentricity: 0, anomaly: 0}
        found = left_over().subs(wrong)
        yield (
            f"fM = p* = 1, e* = 0, c* = 1.1: v1*' − (c*²/r*³ − fM/r*²) = {found}",
            found == -sp.Rational(21, 100),
        )
        yield "and not 0: r* = 1 is no orbit of that c*", found != 0

    return Conditional(argument, counterexample=counterexample)


@claim.proof(
    "section 1: moving end",
    "φ*_k is not fixed: the right end of the trajectory moves on the manifold (5), (6)",
    remark="The manifold consists of two curves, λ = λ* and λ = −λ*, which are the same attitudes.",
)
def moving_end() -> Steps:
    curve = transversality.meeting()
    tangent = curve.diff(anomaly)
    yield "φ* alone runs along the manifold, in eight variables", curve.shape == (8, 1)
    yield "its tangent is nowhere 0: φ* changes at the rate 1", tangent[3] == 1
    carried = transversality.tangent()[4:, :].subs(dict(zip(lam, model.target_attitude(), strict=True)))
    yield "λ* changes by λ*∘i3/2", vanishes((tangent[4:, :] - carried).applyfunc(sp.expand))
    eight = (r, v1, c, anomaly, *lam)
    whole = sp.Matrix([*model.boundary(), *model.attitude_mismatch(), lam.dot(lam)]).jacobian(eight)
    on_it = dict(zip((r, v1, c, *lam), (*curve[:3], *curve[4:]), strict=True))
    left = (whole.subs(on_it) * tangent).applyfunc(sp.simplify)
    half = sp.Rational(1, 2)
    unit = dict.fromkeys(orientation, half)
    yield "(5), (6) and |λ|² do not change along it", all(vanishes(part.subs(unit)) for part in left)
    place = {anomaly: sp.pi / 2, parameter: 2, areal: 3, eccentricity: half} | unit
    yield "and do in every other direction: rank 7 of 8", whole.subs(on_it).subs(place).rank() == 7
