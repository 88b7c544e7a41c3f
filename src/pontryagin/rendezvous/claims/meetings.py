"""True and false meetings of one problem: costates whose residuals are computed when a claim is checked.

The craft leaves the unit circle (fM = 1) for a target on an ellipse with p* = 3/2 and e* = 1/10, in the same
plane or in one inclined to it by 20 degrees. Each meeting is given by six costates and a duration. The 14
equations with the attitude are integrated; then every condition of the paper is evaluated, and the place of
the craft is compared with that of the target.
"""

import functools
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import sympy as sp

from pontryagin.arrays import Array
from pontryagin.ledger.evidence import Steps
from pontryagin.numerics import compile as compiler
from pontryagin.numerics.flow import flow
from pontryagin.rendezvous.derivation import forms, model, principle, reduction, terminal, transversality
from pontryagin.rendezvous.derivation.quaternion import conjugate, product, pure, vect

GRAVITY, PARAMETER, ECCENTRICITY, ANOMALY = 1.0, 1.5, 0.1, 0.6
TIME_WEIGHT, ENERGY_WEIGHT, PEAK = 0.0036, 1.0, 0.25
START = [1.0, 0.0, 1.0]
"""Values of r, v1 and c at t0."""

ROUNDING = 1e-11
"""Largest residual of a meeting that counts as rounding, for quantities of the order 1."""


@dataclass(frozen=True)
class Meeting:
    """A meeting: rho, s1, e, nu1, nu2, nu3 at t0, the duration, and the target's inclination in degrees."""

    name: str
    costates: tuple[float, float, float, float, float, float]
    duration: float
    inclination: int = 0


def _coplanar(name: str, rho: float, s1: float, e: float, nu3: float, duration: float) -> Meeting:
    return Meeting(name, (rho, s1, e, 0.0, 0.0, nu3), duration)


COPLANAR = (
    _coplanar(
        "the true meeting",
        0.04954624540358917,
        0.2197891524524313,
        0.3515766173387952,
        -0.1435836802738231,
        5.406142860948114,
    ),
    _coplanar(
        "20° ahead",
        -0.032955839810023764,
        0.03647224953516254,
        0.19812848902063368,
        -0.017513776611949323,
        5.8828616121508714,
    ),
    _coplanar(
        "30° behind",
        -0.024272140728771815,
        0.04027592924159651,
        0.21322596956580547,
        -0.03270237594223348,
        12.405597338617827,
    ),
    _coplanar(
        "90° behind",
        -0.018790458665617543,
        0.01771371881510154,
        0.17920657242421262,
        -0.022000337432964066,
        15.867241430081396,
    ),
    _coplanar(
        "opposite",
        -0.016239296092169706,
        0.00836442493569105,
        0.17572958414018236,
        -0.019635288799525318,
        19.4582843581068,
    ),
)
"""Solutions of (5), (15), (16) and (17), of which only the first meets the target.

The others are named by the angle by which the craft is ahead of the target or behind it.
"""

INCLINED = (
    Meeting(
        "the true meeting, inclined",
        (
            -0.012118117110626266,
            0.1024648889487188,
            0.27256197857723163,
            0.14886874157099816,
            0.05999346581830427,
            -0.06572784772931807,
        ),
        8.029701571530842,
        20,
    ),
    Meeting(
        "turned by 20° about ν*",
        (
            -0.053325142922776174,
            0.03238556059018296,
            0.22960937151603564,
            0.2862795877341336,
            0.0053500711191528825,
            -0.02428933421015846,
        ),
        8.794481182441816,
        20,
    ),
    Meeting(
        "turned by 180° about ν*",
        (
            -0.0305450057153423,
            0.06934439136146117,
            0.07239972228154355,
            0.09333905126650328,
            0.041989251089220615,
            0.01500552093892265,
        ),
        22.871446273136986,
        20,
    ),
)
NODE = sp.Rational(3, 10)


@functools.cache
def _integrator() -> Callable[..., Array]:
    """The flow of the 14 equations."""
    form = forms.with_attitude("unsaturated")
    return flow(form.states, form.rates, form.parameters)


def trajectory(meeting: Meeting, times: Array) -> Array:
    """r, v1, c, phi*, rho, s1, e, nu, lambda at the times, (k, 14)."""
    start = [*START, ANOMALY, *meeting.costates, 1.0, 0.0, 0.0, 0.0]
    return _integrator()(start, times, [GRAVITY, PARAMETER, ECCENTRICITY, np.sqrt(PARAMETER), ENERGY_WEIGHT])


def values() -> dict[sp.Symbol, sp.Expr]:
    """The problem's parameters as exact numbers."""
    parameter = sp.Rational(3, 2)
    return {
        model.gravity: sp.Integer(1),
        model.parameter: parameter,
        model.eccentricity: sp.Rational(1, 10),
        model.areal: sp.sqrt(parameter),
        principle.time_weight: sp.Rational(9, 2500),
        principle.energy_weight: sp.Integer(1),
    }


def target_attitude(inclination: int) -> sp.Matrix:
    """lambda* at phi*, four components."""
    angle = sp.rad(inclination)
    orbit = dict(zip(model.orientation, model.orientation_from_angles(NODE, angle, -NODE), strict=True))
    return model.target_attitude().subs(orbit)


@functools.cache
def evaluation(inclination: int) -> Callable[..., dict[str, Array]]:
    """The paper's conditions at the end and the separation, as a function of the 14 variables and C_phi."""
    goal = target_attitude(inclination)
    place, velocity = model.cartesian()
    at_target = {**transversality.end_values(), **dict(zip(model.attitude, goal, strict=True))}
    outputs = {
        "ends": model.boundary(),
        "invariant": vect(product(goal, pure(principle.nu), conjugate(goal))),
        "transversality": transversality.condition(),
        "energy": reduction.hamiltonian().subs(forms.thrust("unsaturated")),
        "law": terminal.residual("unsaturated"),
        "mismatch": vect(product(conjugate(model.attitude), goal)),
        "separation": place - place.subs(at_target),
        "drift": velocity - velocity.subs(at_target),
        "switching": principle.size(principle.switching()),
    }
    states = [*forms.with_attitude("unsaturated").states, reduction.anomaly_constant]
    evaluate = compiler.function(
        "conditions", states, {key: value.subs(values()) for key, value in outputs.items()}
    )

    def conditions(row: Array, constant: float) -> dict[str, Array]:
        return {key: np.ravel(part) for key, part in zip(outputs, evaluate(*row, constant), strict=True)}

    return conditions


@dataclass(frozen=True)
class Outcome:
    """Residuals of the conditions of a meeting, the separation from the target, cost and largest thrust."""

    printed_conditions: float
    mismatch: float
    distance: float
    drift: float
    cost: float
    peak: float
    anomaly_constant: float

    @property
    def turn(self) -> float:
        """Angle between the attitude of the craft and that of the target, in degrees."""
        return float(np.degrees(2 * np.arcsin(min(self.mismatch, 1.0))))


@functools.cache
def outcome(meeting: Meeting) -> Outcome:
    """Integrate a meeting and evaluate its residuals, with C_phi by (16) and with (17) at both ends."""
    times = np.linspace(0.0, meeting.duration, 2001)
    path, conditions = trajectory(meeting, times), evaluation(meeting.inclination)
    constant = -float(conditions(path[-1], 0.0)["transversality"][0])
    start, end = conditions(path[0], constant), conditions(path[-1], constant)
    thrust = conditions(path.T, constant)["switching"] / (2 * ENERGY_WEIGHT)
    left = [end["ends"], end["invariant"] - meeting.costates[3:], end["transversality"]]
    return Outcome(
        printed_conditions=float(np.abs(np.concatenate([*left, start["energy"], end["energy"]])).max()),
        mismatch=float(np.linalg.norm(end["mismatch"])),
        distance=float(np.linalg.norm(end["separation"])),
        drift=float(np.linalg.norm(end["drift"])),
        cost=float(np.trapezoid(TIME_WEIGHT + ENERGY_WEIGHT * thrust**2, times)),
        peak=float(thrust.max()),
        anomaly_constant=constant,
    )


def residual_of_16(meeting: Meeting, constant: float) -> float:
    """The residual of (16) with a given C_phi."""
    end = trajectory(meeting, np.array([0.0, meeting.duration]))[-1]
    return float(evaluation(meeting.inclination)(end, constant)["transversality"][0])


def singular_values(meeting: Meeting, repaired: bool) -> Array:
    """Singular values of the conditions' Jacobian at a meeting, by central differences.

    The printed conditions are (5), (15), (16), (17), with the unknowns six costates, t_k and C_phi: 8 x 8.
    The repaired ones are (5), (6) and the law at the end, with the unknowns six costates and t_k: 7 x 7.
    """
    conditions = evaluation(meeting.inclination)

    def residual(unknowns: Array) -> Array:
        costates, duration, constant = unknowns[:6], unknowns[6], unknowns[7] if not repaired else 0.0
        moved = Meeting(meeting.name, tuple(costates), duration, meeting.inclination)
        end = conditions(trajectory(moved, np.array([0.0, duration]))[-1], constant)
        if repaired:
            return np.concatenate([end["ends"], end["mismatch"], end["law"]])
        invariant = end["invariant"] - costates[3:]
        return np.concatenate([end["ends"], invariant, end["transversality"], end["energy"]])

    centre = np.array([*meeting.costates, meeting.duration, outcome(meeting).anomaly_constant])
    steps = 1e-5 * np.eye(7 if repaired else 8, 8)
    columns = [(residual(centre + step) - residual(centre - step)) / 2e-5 for step in steps]
    return np.asarray(np.linalg.svd(np.column_stack(columns), compute_uv=False))


def false_meetings(members: tuple[Meeting, ...]) -> Steps:
    """The members after the first satisfy the printed conditions to rounding and miss the target."""
    for member in members[1:]:
        found = outcome(member)
        yield (
            f"{member.name}: (5), (15), (16) and (17) leave {found.printed_conditions:.1e}",
            found.printed_conditions < ROUNDING and found.peak < PEAK,
        )
        yield (
            f"the attitude is off by {found.turn:.1f}°, the craft {found.distance:.3f} from the target",
            found.turn > 19 and found.distance > 0.4,
        )


def true_meeting(members: tuple[Meeting, ...]) -> Steps:
    """The first member satisfies the printed conditions and (6)."""
    found = outcome(members[0])
    yield (
        f"{members[0].name}: (5), (15), (16) and (17) leave {found.printed_conditions:.1e}",
        found.printed_conditions < ROUNDING and found.peak < PEAK,
    )
    yield (
        f"(6) leaves {found.mismatch:.1e}, the craft is {found.distance:.1e} from the target and "
        f"moves against it with {found.drift:.1e}",
        max(found.mismatch, found.distance, found.drift) < ROUNDING,
    )
