"""Sapunkov's first page: the claims of its abstract, and (1)."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Conditional,
    Equality,
    Proof,
    RightSides,
    Sides,
    Steps,
    vanishes,
)
from pontryagin.rendezvous.derivation import sapunkov
from pontryagin.rendezvous.derivation.quaternion import conjugate, product, vect
from pontryagin.rendezvous.derivation.sapunkov import A, B, Q, epsilon, force, half_anomaly, u, velocity, w

claim = Page("Sapunkov")

sin, cos = sp.sin(half_anomaly), sp.cos(half_anomaly)
square = sapunkov.radius()
FREE = dict.fromkeys(force, 0)


def driving(lifted: sp.Matrix) -> sp.Matrix:
    """F1 as printed, as a function of q."""
    return square * lifted + w.dot(lifted) * w


def in_elements(expression: sp.Expr) -> sp.Expr:
    """An expression with u and w in terms of A, B and phi."""
    return expression.subs(sapunkov.oscillation(), simultaneous=True)


@claim(
    "abstract: results",
    "results of calculations for the optimal rendezvous in space",
    verdict="not checked",
    remark="The text at hand ends after (1); it contains no results to compare the project's with.",
)
def results() -> None:
    return None


@claim.proof("abstract: target", "the target moves on an ellipse under attraction to a centre alone")
def target() -> Steps:
    still = [rates.subs(FREE) for rates in sapunkov.element_rates()]
    yield "for p = 0, A and B are constant", all(part.is_zero_matrix for part in still)
    # A and B are orthogonal, and A is the shorter: the pericentre is at phi = 0, on the first axis.
    half, share = sp.symbols("a e", positive=True)
    short, long = sp.sqrt(half * (1 - share)), sp.sqrt(half * (1 + share))
    at = dict(zip([*A, *B], [short, 0, 0, 0, 0, 0, 0, -long], strict=True))
    place = sapunkov.place(u).applyfunc(in_elements).subs(at).applyfunc(sp.simplify)
    anomaly = 2 * half_anomaly
    ellipse = sp.Matrix([half * (sp.cos(anomaly) - share), half * sp.sqrt(1 - share**2) * sp.sin(anomaly), 0])
    yield (
        "their R is an ellipse about the centre in its focus, 2φ the eccentric anomaly",
        vanishes((place - ellipse).applyfunc(lambda part: sp.simplify(sp.expand_trig(part)))),
    )
    time = in_elements(sapunkov.time_rate()).subs(at).subs(Q, 2 * half) / 2
    kepler = half ** sp.Rational(3, 2) * (1 - share * sp.cos(anomaly))
    yield "with Kepler's equation for the time", vanishes(sp.simplify(sp.expand_trig(time - kepler)))
    yield "A² + B² = 2a", vanishes(sp.simplify((A.dot(A) + B.dot(B)).subs(at)) - 2 * half)


@claim.proof(
    "abstract: elements",
    "quaternion or vector elements of the orbit are used",
    remark="(1) uses the quaternion elements A and B. The vector elements are not on the page; the classical "
    "ones, R × V and Laplace's vector, are quadratic in A and B.",
)
def elements() -> Steps:
    still = [rates.subs(FREE) for rates in sapunkov.element_rates()]
    yield "A and B are elements: constant without thrust", all(part.is_zero_matrix for part in still)
    swing = sapunkov.slowness() * sapunkov.spinor_rate()
    size = {Q: -1 / sapunkov.energy()}
    moment = sapunkov.place().cross(velocity)
    pair = -2 * vect(product(conjugate(u), swing)) / sapunkov.slowness()
    yield "R × V = −√(2/Q) vect(ũ∘w)", vanishes((moment - pair).applyfunc(sp.expand))
    laplace = velocity.cross(moment) - sapunkov.place() / square
    both = -(sapunkov.place() + sapunkov.place(swing)) / Q
    rest = (laplace - both.subs(size)).applyfunc(sp.simplify)
    yield "V × (R × V) − R/r = −(ũ∘i1∘u + w̃∘i1∘w)/Q", vanishes(rest)
    pairs = (
        (vect(product(conjugate(u), w)), vect(product(conjugate(A), B))),
        (sapunkov.place(u) + sapunkov.place(w), sapunkov.place(A) + sapunkov.place(B)),
    )
    for name, (moving, constant) in zip(("first", "second"), pairs, strict=True):
        rest = (in_elements(moving) - constant).applyfunc(lambda part: sp.simplify(sp.expand(part)))
        yield f"the {name} is the same in A and B, at any φ", vanishes(rest)


@claim(
    "abstract: regular",
    "the equations of motion in the elements are regular",
    verdict="conditional",
    remark="True while the osculating orbit is an ellipse, Q > 0: the equations have no denominators, and "
    "the centre of attraction is included. On a parabola Q is infinite; on a hyperbola Q is negative, "
    "and dt/dφ is not real.",
)
def regular() -> Conditional:
    def argument() -> Steps:
        rates = sapunkov.element_rates()
        yield (
            "dA/dφ and dB/dφ are polynomials in u, w, p, Q, sin φ, cos φ",
            all(
                part.is_polynomial(*u, *w, *force, Q, epsilon) and sp.denom(sp.together(part)) == 1
                for part in (*rates[0], *rates[1])
            ),
        )
        yield "without a denominator in dt/dφ", sp.denom(sapunkov.time_rate()) == 1
        centre = dict.fromkeys(u, 0)
        inner = sapunkov.element_rates()[0].subs(centre)
        yield "at the centre, u = 0, the elements stand still", inner.applyfunc(sp.expand).is_zero_matrix
        yield "and dt/dφ = 0, no infinity", sapunkov.time_rate().subs(centre) == 0

    def counterexample() -> Steps:
        fast = dict(zip([*u, *velocity], [1, 0, 0, 0, 0, sp.sqrt(3), 0], strict=True))
        h = sapunkov.energy().subs(fast)
        yield f"r = 1, V² = 3: h = {h}", h == sp.Rational(1, 2)
        yield f"Q = −1/h = {-1 / h} < 0", -1 / h == -2
        rate = sp.sqrt(2 * Q).subs(Q, -2)
        yield f"√(2Q) = {rate} is not real", rate.is_real is False

    return Conditional(argument, counterexample=counterexample)


@claim(
    "abstract: structure",
    "the equations in the elements have a structure that suits numerical solution",
    verdict="not checked",
    remark="This is a judgement. What can be shown is shown in other entries: the equations are regular on "
    "ellipses, and A and B are constant without thrust. `solve_in_elements` solves all of the "
    "report's cases in them, four of them from the costates of `solve`; the three redundancies of the "
    "four numbers u must be taken out of the shooting first.",
)
def structure() -> None:
    return None


@claim(
    "abstract: functionals",
    "two functionals are considered",
    verdict="not checked",
    remark="The text at hand gives no formula for them. The project reads them as ∫(α1 + α2p²)dt and "
    "∫(α1 + α2|p|)dt, and solves both: `solve_in_elements`, `least_fuel`.",
)
def functionals() -> None:
    return None


@claim.proof(
    "section 1: both craft",
    "(1) describes the motion of the controlled and of the uncontrolled craft",
    remark="Each craft has its own φ: a meeting compares the two craft at one t, where their φ differ. The "
    "page does not define ε (the unit of thrust in units of gravity), P(u), (·,·), u² = |u|², nor the "
    "condition on the start, scal(ũ∘i1∘w) = 0.",
)
def both_craft() -> Steps:
    moved = sapunkov.place_rate() - square * velocity
    yield "R = ũ∘i1∘u and du/dτ = −i1∘u∘V/2 give dR/dτ = r V", vanishes(moved.applyfunc(sp.expand))
    length = sapunkov.place().dot(sapunkov.place())
    yield "|R| = |u|²", vanishes(sp.expand(length - square**2))
    rest = sapunkov.spinor_acceleration() - sapunkov.oscillator()
    yield "Newton's law is d²u/dτ² = (h/2)u + (r/2)εq", vanishes(rest.applyfunc(sp.simplify))
    share = sp.cancel(sp.expand(sapunkov.bilinear_rate()) / sapunkov.bilinear())
    yield "scal(ũ∘i1∘w) stays 0: its rate is a multiple of it", sp.denom(share) == 1
    start = sapunkov.bilinear(u, sapunkov.spinor_rate())
    yield "and 0 it is for that du/dτ, at any V", vanishes(sp.expand(start))


@claim("(1): dA/dφ, dB/dφ", "rates of the elements", verdict="holds")
def element_rates() -> Equality:
    F1 = driving(sapunkov.lifted_force())
    printed = {
        r"\frac{dA}{d\varphi}": -epsilon * Q * F1 * sin,
        r"\frac{dB}{d\varphi}": epsilon * Q * F1 * cos,
    }
    return Equality(
        printed,
        sapunkov.element_rates,
        display=r"\frac{dA}{d\varphi} = -\varepsilon Q F_1\sin\varphi,\quad \frac{dB}{d\varphi} = "
        r"\varepsilon Q F_1\cos\varphi",
    )


@claim(
    "(1): dt/dφ",
    "rate of the time",
    verdict="holds",
    remark="This holds in units with fM = 1, which “dimensionless” must mean.",
)
def time_rate() -> Equality:
    return Equality(
        {r"\frac{dt}{d\varphi}": square * sp.sqrt(2 * Q)},
        sapunkov.time_rate,
        display=r"\frac{dt}{d\varphi} = u^2\sqrt{2Q}",
    )


@claim("(1): Q", "Q = A² + B²", verdict="holds", remark="Q is −1/h, twice the semi-major axis.")
def size_of_the_orbit() -> Proof:
    def argument() -> Steps:
        speed = sapunkov.spinor_rate()
        kinetic = square * velocity.dot(velocity) - 4 * speed.dot(speed)
        yield "r V² = 4|du/dτ|²", vanishes(sp.expand(kinetic))
        pair = A.dot(A) + B.dot(B) - (in_elements(u.dot(u)) + in_elements(w.dot(w)))
        yield "A² + B² = u² + w²", vanishes(sp.simplify(pair))

    return Proof(
        argument,
        Equality({"Q": A.dot(A) + B.dot(B)}, lambda: sp.simplify(in_elements(sapunkov.size_of_the_orbit()))),
        display="Q = A^2 + B^2",
    )


@claim.proof(
    "(1): q",
    "q = P(u) p",
    remark="P(u) is not defined on the page. What (1) needs is P(u)p = −i1∘u∘p.",
    display=r"q = P(u)\,p",
)
def lifted_force() -> Steps:
    unknown = sp.Matrix(4, 3, sp.symbols("P0:12"))
    acceleration = sapunkov.spinor_acceleration() - sapunkov.spinor_acceleration().subs(FREE)
    equations = acceleration - square / 2 * epsilon * unknown * force
    conditions = [part.diff(p) for part in equations for p in force]
    (found,) = sp.linsolve(conditions, list(unknown))
    only = sp.Matrix(4, 3, found) - sapunkov.lifting()
    yield "d²u/dτ² = (h/2)u + (r/2)εP(u)p with one P(u): −i1∘u∘p", vanishes(only)
    matrix = sapunkov.lifting()
    yield (
        "P'P = u²: q has the length |u||p|",
        vanishes((matrix.T * matrix - square * sp.eye(3)).applyfunc(sp.expand)),
    )
    work = sapunkov.energy_rate() - 2 * epsilon * w.dot(sapunkov.lifted_force())
    yield "dh/dφ = 2ε(w, q)", vanishes(sp.expand(work))


@claim("(1): F1", "the quantity F1, which drives the elements", verdict="holds")
def driving_force() -> Equality:
    def derived() -> RightSides:
        whole = (sapunkov.oscillation_rate() + u) / (epsilon * Q)
        return whole.applyfunc(sp.expand)

    printed = driving(sapunkov.lifted_force()).applyfunc(sp.expand)
    return Equality({"F_1": printed}, derived, display=r"F_1 = u^2 q + (w, q)w")


@claim("(1): u, w", "u = A cos φ + B sin φ, w = −A sin φ + B cos φ", verdict="holds")
def oscillation() -> Proof:
    keys = ("u", "w")

    def derived() -> Sides:
        found = sapunkov.oscillation()
        return {key: sp.Matrix([found[x] for x in of]) for key, of in zip(keys, (u, w), strict=True)}

    def argument() -> Steps:
        place = A * cos + B * sin
        swing = -A * sin + B * cos
        yield "w = du/dφ at constant A and B", vanishes(place.diff(half_anomaly) - swing)
        yield (
            "and at any thrust: cos φ dA/dφ + sin φ dB/dφ = 0",
            vanishes(
                (sapunkov.element_rates()[0] * cos + sapunkov.element_rates()[1] * sin).applyfunc(sp.expand)
            ),
        )

    return Proof(
        argument,
        Equality({"u": A * cos + B * sin, "w": -A * sin + B * cos}, derived),
        display=r"u = A\cos\varphi + B\sin\varphi,\quad w = -A\sin\varphi + B\cos\varphi",
    )
