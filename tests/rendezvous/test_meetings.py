"""The curve of false meetings: all that is printed holds along it; the target is met at whole turns alone."""

import functools
import math

import numpy as np
import pytest

from pontryagin import NotConverged
from pontryagin.rendezvous import Chaser, Extremal, Orbit, Rendezvous
from pontryagin.rendezvous.claims import meetings as ledger
from pontryagin.rendezvous.homotopy import newton
from pontryagin.rendezvous.meetings import false_curve, false_family
from pontryagin.rendezvous.printed import printed_conditions, printed_jacobian, reduced
from pontryagin.rendezvous.shooting import Setting, equations

DEGREES = (0, 20)
TURNS = {0: (-2 * math.pi, -1.5, -0.4, 0.0, 0.7, 2.0), 20: (-0.6, -0.2, 0.0, 0.3)}


@functools.cache
def true_meeting(degrees: int, **changes: float) -> Extremal:
    """The meeting of the ledger's counterexample, by Newton's method from the ledger's costates."""
    known = (ledger.COPLANAR if degrees == 0 else ledger.INCLINED)[0]
    node = float(ledger.NODE)
    target = Orbit.from_angles(1.5, 0.1, node, math.radians(degrees), -node, 0.6)
    weights = {"time_weight": ledger.TIME_WEIGHT, "energy_weight": ledger.ENERGY_WEIGHT}
    problem = Rendezvous(Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]), target, peak=math.inf, **weights, **changes)
    scaled = problem.scaled
    start = np.append(np.array(known.costates) / scaled.costate_units, known.duration / scaled.time)
    setting = Setting(scaled, scaled.ratio, scaled.peak, duration=scaled.duration)
    return Extremal(problem, newton(setting, start[: 6 if changes else 7]))


@functools.cache
def family(degrees: int):
    return false_family(true_meeting(degrees), TURNS[degrees])


@pytest.mark.parametrize("degrees", DEGREES)
class TestFamily:
    def test_every_member_leaves_nothing_of_what_is_printed(self, degrees):
        assert family(degrees).printed.max() < 1e-12

    def test_the_attitude_is_off_by_the_angle_and_right_at_whole_turns_alone(self, degrees):
        turns = np.abs((family(degrees).angles + math.pi) % (2 * math.pi) - math.pi)
        assert np.allclose(family(degrees).mismatches, turns, atol=1e-9)

    def test_the_place_is_another_but_at_whole_turns(self, degrees):
        whole = np.isclose(family(degrees).angles % (2 * math.pi), 0)
        assert family(degrees).distances[whole].max() < 1e-10
        assert family(degrees).distances[~whole].min() > 0.2

    def test_the_printed_conditions_are_one_short_and_the_repaired_ones_are_not(self, degrees):
        printed, repaired = family(degrees).printed_singular_values, family(degrees).repaired_singular_values
        assert printed.shape == (8,) and repaired.shape == (7,)
        assert printed[-1] < 1e-14 * printed[0] < 1e-8 * printed[-2]
        assert repaired[-1] > 1e-4 * repaired[0]

    def test_the_jacobian_is_the_derivative_of_the_conditions(self, degrees):
        """By central differences of flights, the end conditions evaluated at each."""
        extremal = true_meeting(degrees)
        problem = extremal.problem
        setting, h = Setting(problem.scaled, problem.scaled.ratio, math.inf), 1e-6

        def left(unknowns):
            flight = equations(setting, unknowns[:7]).flight
            return printed_conditions(flight, flight.end[:10], flight.costates[3:], unknowns[7])

        start = np.append(extremal.root.unknowns, 0.3)
        columns = [(left(start + h * x) - left(start - h * x)) / (2 * h) for x in np.eye(8)]
        exact = printed_jacobian(extremal.flight)
        assert np.allclose(np.array(columns).T, exact, rtol=1e-6, atol=1e-7)

    def test_the_curve_runs_along_the_null_vector(self, degrees):
        near = false_family(true_meeting(degrees), [-1e-4, 1e-4]).members
        change = np.subtract(*[[*one.flight.costates, one.flight.duration] for one in near])
        jacobian = printed_jacobian(true_meeting(degrees).flight)
        null = np.linalg.svd(jacobian)[2][-1][:7]
        cosine = change @ null / np.linalg.norm(change) / np.linalg.norm(null)
        assert abs(cosine) == pytest.approx(1, abs=1e-6)


def test_the_ledger_s_false_meetings_lie_on_the_curve():
    """Found there by themselves; 20 degrees ahead costs less than the true one."""
    ahead = next(one for one in ledger.COPLANAR if one.name.startswith("20°"))
    both = false_family(true_meeting(0), np.radians([-20, 20])).members
    found = min(both, key=lambda one: abs(one.duration - ahead.duration))
    costates = found.flight.costates * found.problem.scaled.costate_units
    assert found.duration == pytest.approx(ahead.duration, abs=1e-9)
    assert np.allclose(costates, ahead.costates, atol=1e-9)
    assert found.cost < true_meeting(0).cost


def test_the_curve_keeps_its_order_and_ends_where_asked():
    curve = false_curve(true_meeting(0), -0.8, 0.5)
    assert curve.angles[0] == -0.8 and curve.angles[-1] == 0.5 and 0.0 in curve.angles
    assert np.all(np.diff(curve.angles) > 0)
    assert curve.printed.max() < 1e-12


def test_where_the_conditions_are_one_member_fails_them_when_flown_amiss():
    """The residual can fail: with a costate changed by 1e-6 it is far above rounding."""
    member = family(0).members[1]
    setting = Setting(member.problem.scaled, member.problem.scaled.ratio, math.inf)
    amiss = np.append(member.flight.costates * (1 + 1e-6), member.flight.duration)
    flight = equations(setting, amiss).flight
    left = printed_conditions(flight, flight.end[:10], flight.costates[3:], 0.0)
    assert np.abs(left[:3]).max() > 1e-8


def test_the_ten_variables_of_the_sixteen():
    row = np.array([1, 0, 1, 0.5, 1, 0, 0, 0, 0.1, 0.2, 0.3, 2.0, 0, 0.4, 0.5, 0.6])
    wanted = [1, 0, 1, 0.5, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 2 * (1 + 0.1 * math.cos(0.5)) ** 2]
    assert np.allclose(reduced(row, 0.1), wanted)


def test_bad_input_is_named():
    with pytest.raises(TypeError, match="solution must be of type Extremal"):
        false_family(None, [0.1])
    with pytest.raises(ValueError, match="angles"):
        false_family(true_meeting(0), [math.nan])
    with pytest.raises(ValueError, match=r"angles must be of shape \(k,\)"):
        false_family(true_meeting(0), [[0.1]])
    with pytest.raises(ValueError, match="first and last must be below and above 0"):
        false_curve(true_meeting(0), 0.2, 0.5)
    with pytest.raises(ValueError, match="solution must have a free duration"):
        false_family(true_meeting(0, duration=5.406142860948114), [0.1])


def test_a_curve_that_ends_says_so():
    with pytest.raises(NotConverged, match="the curve of meetings ends before the angle"):
        false_family(true_meeting(20), [3.0, -3.0])
