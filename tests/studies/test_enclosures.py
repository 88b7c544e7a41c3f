"""Proved intervals of optima in ball arithmetic: how many digits, and that wrong answers have none."""

import json
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("flint", reason="the extra dev has python-flint")

from flint import arb, ctx
from studies.enclosures import gauges, norms
from studies.enclosures.ball import Enclosure, exact, precise
from studies.enclosures.examples import EXAMPLES
from studies.enclosures.least_time import candidates, time
from studies.enclosures.powers import exponential_moments, power_moments
from studies.enclosures.sample import SOLVERS
from studies.enclosures.study import STUDY
from studies.part import generator

from independent import exact_bang_bang_times
from pontryagin.orbit_correction import DiscreteSystem, correct, gauge
from pontryagin.triple_integrator import (
    Maneuver,
    maximum_entropy,
    minimum_energy,
    minimum_impulse,
    minimum_norm,
    minimum_peak,
    minimum_time,
)

DIGITS = {
    "least energy": 13,
    "least peak": 13,
    "least total impulse": 12.5,
    "least norm": 12,
    "greatest entropy": 12,
    "least time": 15,
    "gauge of ellipsoids": 12,
    "correction: ball": 14.5,
    "correction: disc": 14,
    "correction: box": 14.5,
}
"""Digits that are proved for every problem of the sample below."""
COUNTS = {"least norm": 6, "gauge of ellipsoids": 30, "correction: disc": 30}
UNIT = Maneuver([0, 0, 0], [1, 0, 0], tf=1.0)
SKEW = Maneuver([0.3, -0.2, 0.5], [1.1, 0.4, -0.7], tf=1.3, t0=0.2, disturbance=0.4)
CASES = {
    "energy": (norms.energy, minimum_energy),
    "peak": (norms.peak, minimum_peak),
    "impulse": (norms.impulse, minimum_impulse),
    "q = 3": (norms.power, lambda m: minimum_norm(m, 3.0)),
}


@pytest.fixture(autouse=True)
def balls():
    """The precision of the studies."""
    with precise():
        yield


def test_every_solver_has_its_digits_here():
    assert list(DIGITS) == list(SOLVERS)


@pytest.mark.parametrize("name", SOLVERS)
def test_the_proven_digits_of_random_problems(name):
    rng = np.random.default_rng([1, *name.encode()])
    found = [SOLVERS[name](rng)[1] for _ in range(COUNTS.get(name, 60))]
    proved = [enclosure.digits for enclosure in found if enclosure is not None]
    assert len(proved) >= 0.95 * len(found)
    assert min(proved) >= DIGITS[name]


@pytest.mark.parametrize("name", EXAMPLES)
def test_the_proven_digits_of_the_worked_examples(name):
    assert EXAMPLES[name]().digits >= 13


@pytest.mark.parametrize(
    ("name", "value"), [("energy", arb(720).sqrt()), ("peak", arb(32)), ("impulse", arb(16))]
)
def test_the_intervals_hold_the_optima_of_the_turn(name, value):
    enclose, solve = CASES[name]
    found = enclose(solve(UNIT))
    assert not found.lower > value and not found.upper < value


def test_two_ways_to_enclose_the_least_energy_overlap():
    one, other = norms.energy(minimum_energy(SKEW)), norms.power(minimum_norm(SKEW, 2.0))
    assert not one.lower > other.upper and not other.lower > one.upper


def test_a_constant_density_has_entropy_zero():
    found = norms.entropy(maximum_entropy(Maneuver([0, 0, 0], [4.0, 6.0, 6.0], tf=2.0)))
    assert not found.lower > 0 and not found.upper < 0 and found.error < 1e-12


@pytest.mark.parametrize("name", CASES)
def test_a_value_that_is_wrong_in_the_tenth_digit_has_no_more_digits(name):
    enclose, solve = CASES[name]
    found = enclose(solve(SKEW))
    assert 9.9 < replace(found, value=found.value * (1 + 1e-10)).digits < 10.1


@pytest.mark.parametrize(
    ("name", "changed"),
    [("energy", "coefficients"), ("peak", "shares"), ("impulse", "amplitudes"), ("energy", "multipliers")],
)
def test_what_is_wrong_in_the_control_or_the_multipliers_widens_the_interval(name, changed):
    """The optimum stays inside: a control is completed, and any multipliers bound from below."""
    enclose, solve = CASES[name]
    solution = solve(SKEW)
    right = enclose(solution)
    numbers = np.array(getattr(solution, changed))
    numbers[0] *= 1 + 1e-6
    solution.__dict__[changed] = numbers
    wrong = enclose(solution)
    assert wrong.digits < 12.9 < right.digits
    assert not wrong.lower > right.upper and not wrong.upper < right.lower


def test_bounds_that_contradict_each_other_are_no_interval():
    with pytest.raises(AssertionError, match="contradict"):
        _ = Enclosure(1.0, arb(2), arb(1)).digits


def test_a_bound_of_unknown_size_proves_nothing():
    assert Enclosure(1.0, arb("nan"), arb(1)).digits < 0


@pytest.mark.parametrize("power", [0.1, 1.0, 3.7])
@pytest.mark.parametrize("zero", [-0.2, 0.0, 0.3, 1.0, 1.4])
def test_integrals_of_powers_are_their_closed_forms(power, zero):
    """Of |x - z|^p sign(x - z)."""
    p, z = exact(power), exact(zero)
    (found, *_) = power_moments([-z, arb(1), arb(0)], p)
    ends = [abs(end - z) ** (p + 1) / (p + 1) for end in (arb(1), arb(0))]
    assert found.overlaps(ends[0] - ends[1]) and found.rad() < 1e-20


def test_integrals_of_exponentials_are_their_closed_forms():
    found = exponential_moments([arb(0.5), arb(2), arb(0)])
    assert found[0].overlaps(arb(0.5).exp() * (arb(2).exp() - 1) / 2) and found[0].rad() < 1e-20


def test_the_roots_of_the_least_time_are_those_of_an_independent_solver():
    solution = minimum_time(SKEW.x0, SKEW.xf, 2.0, 0.4)
    ours = sorted(float(T.mid()) for T, _ in candidates(solution))
    others = sorted(float(T) for _, T in exact_bang_bang_times(SKEW.x0, SKEW.xf, 2.0, 0.4))
    assert ours == pytest.approx(others, rel=1e-14)


def test_a_least_time_on_the_border_of_two_structures_is_left_open():
    """From rest under a constant control the switches are at the ends: balls cannot decide."""
    assert time(minimum_time([0, 0, 0], [8 / 6, 2, 2], 1.0)) is None


def test_a_later_root_is_no_least_time():
    solution = minimum_time(SKEW.x0, SKEW.xf, 2.0, 0.4)
    later = replace(solution, duration=solution.duration * 1.01)
    assert time(solution).digits > 15 and time(later).digits < 3


@pytest.mark.parametrize("thrust", ["ball", "disc", "box"])
def test_that_one_step_less_does_not_suffice_is_proved(thrust):
    rng = np.random.default_rng(4)
    for z0 in 0.02 * rng.standard_normal((10, 3)):
        plan = correct(z0, thrust=thrust)
        assert gauges.correction(plan).upper < 1
        shorter = plan.thrust.gauges(plan.z0[None], np.array([int(plan.steps) - 1]))
        assert gauges.fewest(plan, shorter.costates[0])


def test_a_gauge_in_closed_form_is_enclosed():
    system = DiscreteSystem(np.array([np.eye(2)] * 10), np.array([np.eye(2)] * 10))
    found = gauges.gauge(system, [3.0, 4.0], 10, gauge(system, [3.0, 4.0], 10))
    assert found.digits > 15 and not found.lower > 0.5 and not found.upper < 0.5


def test_a_wrong_costate_widens_the_interval_of_a_gauge():
    rng = np.random.default_rng(2)
    system = DiscreteSystem(
        np.array([np.eye(3)] * 4), np.array([np.diag([1.0, 2.0, 3.0 + k]) for k in range(4)])
    )
    x0 = rng.standard_normal(3)
    found = gauge(system, x0, 4)
    right = gauges.gauge(system, x0, 4, found)
    wrong = gauges.gauge(system, x0, 4, replace(found, costate=found.costate + np.array([1e-6, 0, 0])))
    assert wrong.digits < 12.5 < right.digits
    assert not wrong.lower > right.upper and not wrong.upper < right.lower


def test_the_study_records_digits_and_what_was_left_open():
    known = {part.name: part for part in STUDY.parts}
    assert known.keys() == {*SOLVERS, *EXAMPLES}
    part = replace(known["least time"], chunks=1)
    found = [part.run(generator(STUDY, part, 0), 0)]
    assert json.loads(json.dumps(found)) == found
    cells = STUDY.row(part, found)
    assert cells["problems"] == 50 and float(cells["least digits"]) >= 15 and cells["optimum"] == ""
    example = known["turn of one radian, least peak"]
    assert STUDY.row(example, [example.run(None, 0)])["optimum"] == "32.00000000000"
    (case,) = STUDY.cases(part, found)
    assert case["digits"] == min(found[0]["digits"])
    solution = eval(case["problem"], {"minimum_time": minimum_time})
    assert round(time(solution).digits, 2) == case["digits"]


def test_precision_is_that_of_the_studies():
    assert ctx.prec == 200 and (exact(0.1) * 10 - 1) != 0
