"""``python -m pontryagin.rendezvous.generate``: write `kernels.py` from the derivation."""

from collections.abc import Iterable
from pathlib import Path

import sympy as sp

from pontryagin.io.files import write
from pontryagin.numerics.compile import source
from pontryagin.rendezvous.derivation import (
    equinoctial,
    forms,
    inertial,
    model,
    primer,
    principle,
    reduction,
    repair,
    sapunkov,
    sapunkov_principle,
    terminal,
    transversality,
)
from pontryagin.rendezvous.derivation.quaternion import conjugate, product, turn, vect

HEADER = '''"""Numeric kernels of the rendezvous.

Generated from the derivation by `make kernels`; do not edit.
"""

from numpy import cos, sin, sqrt
'''

ORBIT = (model.gravity, model.parameter, model.eccentricity, model.areal)
chart = sp.Symbol("chart", real=True)
start_nu = sp.Matrix(sp.symbols("nu1_0 nu2_0 nu3_0", real=True))
goal = sp.Matrix(sp.symbols("r_goal v_goal c_goal", real=True))
goal_attitude = sp.Matrix(sp.symbols("q0_goal q1_goal q2_goal q3_goal", real=True))


def kernels() -> str:
    """The text of `kernels.py`."""
    parts = [*_rates(), *_attitude(), *_ends(), *_principle(), *_cartesian(), *_elements(), *_equinoctial()]
    return HEADER + "\n\n" + "\n\n\n".join(parts) + "\n"


def in_any_chart(expression: sp.Expr) -> sp.Expr:
    """An expression of the first chart with the chart (+1 or -1) as a parameter: |nu| becomes chart |nu|."""
    return expression.subs(repair.length, chart * repair.length)


def _named(prefix: str, values: Iterable[sp.Expr]) -> dict[str, sp.Expr]:
    """Expressions named by a common prefix and their number."""
    return {f"{prefix}{i}": value for i, value in enumerate(values)}


def _rates() -> list[str]:
    texts = []
    for mode in ("unsaturated", "saturated"):
        form = forms.repaired(mode)
        chi_rate = repair.with_length(in_any_chart(repair.chi_rate())).subs(forms.thrust(mode))
        arguments = [*form.states, *form.parameters, chart]
        doc = f"Rates of (11), (12), (13), (14), phi* and chi, {mode}."
        texts.append(source(mode, arguments, _named("d", [*form.rates[:-1], chi_rate]), doc))
        full = forms.full(mode)
        doc = f"Rates of the 16 equations, {mode}."
        texts.append(source(f"full_{mode}", [*full.states, *full.parameters], _named("d", full.rates), doc))
    return texts


def shortest_turn(nu: sp.Matrix) -> sp.Matrix:
    """T(nu) with |nu| written out and the chart as a parameter."""
    values = dict(zip(principle.nu, nu, strict=True)) | {repair.length: principle.size(nu)}
    return repair.shortest_turn(chart).subs(values)


def relative_attitude() -> sp.Matrix:
    """lambda0~ o lambda: with S = lambda0 o T(nu0), the angle chi starts from 0."""
    return product(
        shortest_turn(start_nu), turn(model.EZ, repair.chi), conjugate(shortest_turn(principle.nu))
    )


def _attitude() -> list[str]:
    arguments = [*start_nu, *principle.nu, repair.chi, chart]
    return [
        source("attitude", arguments, _named("q", relative_attitude()), "lambda0~ o lambda of nu and chi.")
    ]


def _ends() -> list[str]:
    place = [model.anomaly, model.parameter, model.eccentricity, model.areal]
    radius, radial = model.target_radius(), model.target_radial_velocity()
    target = {"r_goal": radius, "v_goal": radial, "c_goal": model.areal, "rate": model.anomaly_rate()}
    target |= _named("q", model.target_attitude())
    mismatch = [
        *(sp.Matrix([model.r, model.v1, model.c]) - goal),
        *vect(product(conjugate(relative_attitude()), goal_attitude)),
    ]
    ends = [model.r, model.v1, model.c, *principle.nu, repair.chi, *start_nu, chart, *goal, *goal_attitude]
    constant = transversality.anomaly_constant_at_the_end()
    return [
        source("target", [*place, *model.orientation], target, "r*, v1*, c* of (5), phi*', lambda* of (6)."),
        source("mismatch", ends, _named("f", mismatch), "(5), and (6) by nu and chi, towards any goal."),
        source(
            "anomaly_constant",
            [principle.rho, principle.s1, principle.nu[2], *place],
            {"constant": constant},
            "C_phi at a meeting, (16).",
        ),
    ]


def _principle() -> list[str]:
    n = principle.switching()
    visible = [model.r, model.c, principle.s1, principle.e, principle.nu[0]]
    reduced = [model.r, model.v1, model.c, principle.rho, principle.s1, principle.e, *principle.nu]
    weights = [principle.time_weight, principle.energy_weight]
    thrust = [*model.thrust]
    return [
        source("switching", visible, _named("n", n), "n_eta of (9)."),
        source("switching_square", visible, {"square": n.dot(n)}, "|n_eta|^2."),
        source(
            "hamiltonian",
            [
                *reduced,
                *thrust,
                reduction.anomaly_constant,
                model.gravity,
                model.parameter,
                model.areal,
                *weights,
            ],
            {"value": reduction.hamiltonian()},
            "H of (17) at any thrust.",
        ),
        source(
            "terminal_law",
            [*visible, *thrust, *weights],
            {"value": terminal.law()},
            "(n, p) - alpha1 - alpha2 p^2.",
        ),
    ]


def _cartesian() -> list[str]:
    texts = []
    for mode in ("unsaturated", "saturated"):
        form = inertial.cartesian(mode)
        arguments = [*form.states, *form.parameters]
        doc = f"Rates of R, V, psi_R and psi_V, {mode}."
        texts.append(source(f"cartesian_{mode}", arguments, _named("d", form.rates), doc))
    position, velocity = model.cartesian()
    place = [model.r, model.v1, model.c, *model.attitude]
    texts.append(
        source("cartesian", place, _named("x", [*position, *velocity]), "R and V of r, v1, c and lambda.")
    )
    costate = [*(-primer.carried()), *principle.switching()]
    reduced = [model.r, model.v1, model.c, principle.rho, principle.s1, principle.e, *principle.nu]
    texts.append(source("primer", reduced, _named("psi", costate), "psi_R and psi_V, seen in eta."))
    return [*texts, *_cartesian_slopes()]


def _cartesian_slopes() -> list[str]:
    place, factors = [*inertial.position], inertial.factors
    pull = inertial.attraction().subs(model.gravity, 1)
    turns = [part.diff(x) for part, x in _upper(pull, inertial.position)]
    bends = inertial.curvatures(factors.dot(pull))
    weight = inertial.pace().subs(model.gravity, 1)
    return [
        source(
            "attraction",
            [*place, *factors],
            _named("g", pull) | _named("s", turns) | _named("c", bends),
            "g = -R/r^3, its derivatives gx_x, gx_y, gx_z, gy_y, gy_z, gz_z, and the second ones of (m, g).",
        ),
        source(
            "cartesian_pace",
            place,
            {"weight": weight}
            | _named("s", inertial.slopes(weight))
            | _named("c", inertial.curvatures(weight)),
            "dt/ds, its slopes, and its second derivatives xx, xy, xz, yy, yz, zz.",
        ),
    ]


def _upper(rows: sp.Matrix, columns: sp.Matrix) -> list[tuple[sp.Expr, sp.Expr]]:
    """The pairs of a row and a column of three that are on or above the diagonal."""
    return [(rows[i], columns[j]) for i in range(3) for j in range(i, 3)]


def _elements() -> list[str]:
    A, B, a, b = sapunkov.A, sapunkov.B, sapunkov_principle.a, sapunkov_principle.b
    phi, thrust = sapunkov.half_anomaly, [*sapunkov.force]
    written_out = sapunkov_principle.written_out
    rates = written_out(
        sp.Matrix([*sapunkov_principle.state_rates(), *sapunkov_principle.closed_costate_rates()])
    )
    clock, moving = rates[8], [*rates[:8], *rates[9:]]
    n = written_out(sapunkov_principle.switching())
    place = written_out(sp.Matrix([part for vector in sapunkov_principle.place() for part in vector]))
    kappa = written_out(sapunkov_principle.phase_costate() / sapunkov.time_rate())
    texts = [
        source(
            "element_rates",
            [*A, *B, *a, *b, phi, *thrust],
            _named("d", moving) | {"clock": clock},
            "Rates of A, B, a and b by phi at any thrust, (1), and dt/dphi.",
        ),
        source("element_switching", [*A, *B, *a, *b, phi], _named("n", n), "n in inertial axes."),
        source("element_phase", [*A, *B, *a, *b, phi], {"value": kappa}, "kappa over dt/dphi."),
        source("element_place", [*A, *B, phi], _named("x", place), "R, V."),
    ]
    for ahead, name in ((True, "oscillation_ahead"), (False, "oscillation_behind")):
        spinor, swing = sapunkov_principle.oscillation_of(inertial.position, inertial.velocity, ahead)
        doc = f"u and w of R and V, fM = 1; R may not lie along {'-' if ahead else '+'}i1."
        arguments = [*inertial.position, *inertial.velocity]
        texts.append(source(name, arguments, _named("u", spinor) | _named("w", swing), doc))
    return texts


def _equinoctial() -> list[str]:
    x, costates = [*equinoctial.ELEMENTS], [*equinoctial.COSTATES]
    place = [part for vector in equinoctial.place() for part in vector]
    weight = {"weight": 1 / equinoctial.coasting_rate()}
    n = _named("n", equinoctial.switching())
    return [
        source("equinoctial_place", x, _named("x", place), "R, V of equinoctial elements, fM = 1."),
        source("equinoctial_switching", x + costates, n, "n in radial, transverse and normal components."),
        source("equinoctial_weight", x[:3] + x[5:], weight, "dt/ds."),
        *_equinoctial_slopes(),
    ]


def _equinoctial_slopes() -> list[str]:
    x = [*equinoctial.ELEMENTS, *equinoctial.COSTATES]
    n = equinoctial.switching()
    by_element = {(i, j): slope for i, part in enumerate(n) for j, slope in equinoctial.slopes(part).items()}
    bends = equinoctial.switching_curvatures()
    weight = 1 / equinoctial.coasting_rate()
    slopes, curvatures = equinoctial.slopes(weight), equinoctial.curvatures(weight)
    return [
        f'SWITCHING_SLOPES = {tuple(by_element)}\n"""Component and variable of each slope of n."""',
        source(
            "equinoctial_switching_slopes",
            x,
            _named("n", n) | _named("s", by_element.values()),
            "n and its slopes in elements and costates that do not vanish.",
        ),
        f'SWITCHING_CURVATURES = {tuple(bends)}\n"""Both variables of each second derivative of n."""',
        source(
            "equinoctial_switching_curvatures",
            [*x, *equinoctial.factors],
            _named("c", bends.values()),
            "Second derivatives of (m, n) in elements and costates that do not vanish.",
        ),
        f"WEIGHT_SLOPES, WEIGHT_CURVATURES = {tuple(slopes)}, {tuple(curvatures)}\n"
        '"""The variables of the derivatives of dt/ds."""',
        source(
            "equinoctial_weight_slopes",
            [*x[:3], x[5]],
            {"weight": weight} | _named("s", slopes.values()) | _named("c", curvatures.values()),
            "dt/ds with its first and second derivatives that do not vanish.",
        ),
    ]


def main() -> None:
    """Write `kernels.py` beside this module."""
    write(Path(__file__).with_name("kernels.py"), kernels())


if __name__ == "__main__":
    main()
