"""The printed conditions hold all along the curve of false meetings, but (6) only at whole turns."""

import functools
import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pontryagin import NotConverged
from pontryagin.rendezvous import Chaser, Extremal, Orbit, Rendezvous
from pontryagin.rendezvous.claims import meetings as ledger
from pontryagin.rendezvous.false_meetings.family import false_curve, false_family, false_meeting
from pontryagin.rendezvous.false_meetings.printed_conditions import (
    printed_conditions,
    printed_jacobian,
    reduced_variables,
)
from pontryagin.rendezvous.false_meetings.rotated_target import rotated_target_family
from pontryagin.rendezvous.reduced.conditions import Setting, equations
from pontryagin.rendezvous.reduced.shooting import meet
from pontryagin.rendezvous.witness.cartesian import (
    fly_cartesian,
    target_by_kepler,
)

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
    return Extremal(problem, meet(setting, start[: 6 if changes else 7]))


@functools.cache
def family(degrees: int):
    return false_family(true_meeting(degrees), TURNS[degrees])


def axis_of(nu: np.ndarray, problem: Rendezvous) -> np.ndarray:
    """The axis of the rotation: nu*, or the normal of the target's orbit where the orbits are coplanar."""
    normal = Rotation.from_quat(problem.target.attitude, scalar_first=True).apply([0, 0, 1])
    return normal if normal[2] == pytest.approx(1, abs=1e-15) else nu / np.linalg.norm(nu)


@pytest.mark.parametrize("degrees", DEGREES)
class TestFamily:
    @pytest.mark.slow
    def test_every_member_satisfies_the_printed_conditions(self, degrees):
        assert family(degrees).printed.max() < 1e-12

    def test_the_attitude_differs_by_the_angle_modulo_whole_turns(self, degrees):
        turns = np.abs((family(degrees).angles + math.pi) % (2 * math.pi) - math.pi)
        assert np.allclose(family(degrees).mismatches, turns, atol=1e-9)

    def test_the_rotation_by_the_angle_carries_the_target_to_the_craft(self, degrees):
        """This holds for the attitudes, and for the states by Newton's law and Kepler's equation."""
        problem = true_meeting(degrees).problem
        for member in family(degrees).members:
            axis = axis_of(member.flight.costates[3:], problem)
            angle = 2 * math.atan2(member.turn[1:] @ axis, member.turn[0])
            assert math.remainder(angle - member.angle, 2 * math.pi) == pytest.approx(0, abs=1e-9)
            end = fly_cartesian(member.flight, np.array([member.flight.duration]))[0, :6].reshape(2, 3)
            target = target_by_kepler(problem.scaled, member.flight.duration).reshape(2, 3)
            assert np.allclose(Rotation.from_rotvec(member.angle * axis).apply(target), end, atol=1e-9)

    @pytest.mark.slow
    def test_false_meeting_finds_the_member_of_the_family(self, degrees):
        for member in family(degrees).members[1:]:
            alone = false_meeting(member.problem, member.angle, true_meeting(degrees))
            assert alone.duration == pytest.approx(member.duration, rel=1e-9)
            assert np.allclose(alone.flight.costates, member.flight.costates, atol=1e-8)

    def test_the_target_is_missed_except_at_whole_turns(self, degrees):
        true = np.isclose(family(degrees).angles % (2 * math.pi), 0)
        assert family(degrees).distances[true].max() < 1e-10
        assert family(degrees).distances[~true].min() > 0.2

    def test_only_the_jacobian_of_the_printed_conditions_is_singular(self, degrees):
        printed, repaired = family(degrees).printed_singular_values, family(degrees).repaired_singular_values
        assert printed.shape == (8,) and repaired.shape == (7,)
        assert printed[-1] < 1e-14 * printed[0] < 1e-8 * printed[-2]
        assert repaired[-1] > 1e-4 * repaired[0]

    def test_the_printed_jacobian_agrees_with_central_differences(self, degrees):
        extremal = true_meeting(degrees)
        problem = extremal.problem
        setting, h = Setting(problem.scaled, problem.scaled.ratio, math.inf), 1e-6

        def residual(unknowns):
            flight = equations(setting, unknowns[:7]).flight
            return printed_conditions(flight, flight.end[:10], flight.costates[3:], unknowns[7])

        start = np.append(extremal.root.unknowns, 0.3)
        columns = [(residual(start + h * x) - residual(start - h * x)) / (2 * h) for x in np.eye(8)]
        exact = printed_jacobian(extremal.flight)
        assert np.allclose(np.array(columns).T, exact, rtol=1e-6, atol=1e-7)

    def test_the_curve_is_tangent_to_the_null_vector_of_the_printed_jacobian(self, degrees):
        near = false_family(true_meeting(degrees), [-1e-4, 1e-4]).members
        change = np.subtract(*[[*one.flight.costates, one.flight.duration] for one in near])
        jacobian = printed_jacobian(true_meeting(degrees).flight)
        null = np.linalg.svd(jacobian)[2][-1][:7]
        cosine = change @ null / np.linalg.norm(change) / np.linalg.norm(null)
        assert abs(cosine) == pytest.approx(1, abs=1e-6)


@pytest.mark.parametrize("kept", [ledger.COPLANAR[1], ledger.INCLINED[1]])
def test_the_ledger_s_false_meetings_solve_the_equations_with_the_target_rotated_by_20_degrees(kept):
    """The coplanar one is 20 degrees ahead; the inclined one is rotated by 20 degrees about nu*."""
    true = true_meeting(kept.inclination)
    scaled = true.problem.scaled
    unknowns = np.append(np.array(kept.costates) / scaled.costate_units, kept.duration / scaled.time)
    solution, _ = rotated_target_family(true)(unknowns, math.radians(20))
    assert np.abs(solution.residual).max() < 1e-11


def test_some_false_meetings_cost_less_than_the_true_one():
    """The coplanar one is 20 degrees ahead; the inclined one is rotated by 20 degrees about -nu*."""
    for degrees, angle in ((0, 20), (20, -20)):
        true = true_meeting(degrees)
        (found,) = false_family(true, [math.radians(angle)]).members
        assert found.cost < 0.75 * true.cost


@pytest.mark.slow
def test_the_angles_along_the_curve_increase_between_its_given_ends():
    curve = false_curve(true_meeting(0), -0.8, 0.5)
    assert curve.angles[0] == -0.8 and curve.angles[-1] == 0.5 and 0.0 in curve.angles
    assert np.all(np.diff(curve.angles) > 0)
    assert curve.printed.max() < 1e-12


def test_a_relative_change_of_the_costates_by_1e_6_violates_the_printed_conditions():
    member = family(0).members[1]
    setting = Setting(member.problem.scaled, member.problem.scaled.ratio, math.inf)
    changed = np.append(member.flight.costates * (1 + 1e-6), member.flight.duration)
    flight = equations(setting, changed).flight
    residual = printed_conditions(flight, flight.end[:10], flight.costates[3:], 0.0)
    assert np.abs(residual[:3]).max() > 1e-8


def test_the_ten_variables_and_c_phi_follow_from_the_sixteen():
    row = np.array([1, 0, 1, 0.5, 1, 0, 0, 0, 0.1, 0.2, 0.3, 2.0, 0, 0.4, 0.5, 0.6])
    wanted = [1, 0, 1, 0.5, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 2 * (1 + 0.1 * math.cos(0.5)) ** 2]
    assert np.allclose(reduced_variables(row, 0.1), wanted)


def test_the_errors_name_the_argument():
    with pytest.raises(TypeError, match="solution must be of type Extremal"):
        false_family(None, [0.1])
    with pytest.raises(ValueError, match="angles"):
        false_family(true_meeting(0), [math.nan])
    with pytest.raises(ValueError, match=r"angles must be of shape \(k,\)"):
        false_family(true_meeting(0), [[0.1]])
    with pytest.raises(ValueError, match="first must be below 0 and last above 0, got"):
        false_curve(true_meeting(0), 0.2, 0.5)
    with pytest.raises(ValueError, match="solution must have a free duration"):
        false_family(true_meeting(0, duration=5.406142860948114), [0.1])


@pytest.mark.slow
def test_the_error_of_a_curve_that_ends_names_the_angle_that_is_not_reached():
    with pytest.raises(
        NotConverged, match=r"the curve of false meetings ends at .* rad, before it reaches -?3 rad"
    ):
        false_family(true_meeting(20), [3.0, -3.0])
