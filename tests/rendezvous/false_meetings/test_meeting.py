"""A false meeting satisfies the printed conditions and violates (6) by the given angle."""

import math

import numpy as np
import pytest

from pontryagin.errors import NotConverged
from pontryagin.numerics.rotation import about_third, conjugate, product, rotated
from pontryagin.rendezvous import Chaser, Orbit, Rendezvous, solve
from pontryagin.rendezvous.false_meetings.family import false_meeting
from pontryagin.rendezvous.false_meetings.meeting import RotatedMeeting
from pontryagin.rendezvous.false_meetings.rotated_target import leading_equations, rotated_equations
from pontryagin.rendezvous.reduced.conditions import Setting, equations
from pontryagin.rendezvous.reduced.shooting import meet
from pontryagin.rendezvous.reduced.solution import Extremal

CRAFT = Chaser(1.0, 0.0, 1.0, [math.cos(0.2), 0.0, math.sin(0.2), 0.0])


def meeting(degrees, duration=6.0):
    """A true meeting in fixed time; craft and target are coplanar where the inclination is 0."""
    relative = Orbit.from_angles(1.5, 0.1, 0.3, math.radians(degrees), 0.0, 0.6)
    target = Orbit(1.5, 0.1, product(CRAFT.attitude, relative.attitude), 0.3)
    problem = Rendezvous(CRAFT, target, time_weight=0, energy_weight=1, peak=math.inf, duration=duration)
    return solve(problem)


@pytest.fixture(scope="module", params=[0, 20])
def true(request):
    return meeting(request.param)


def turn_of(extremal):
    """lambda o lambda*~ at t_k in inertial axes, from the sampled state."""
    end = extremal.state([extremal.duration])[0]
    target = product(extremal.problem.target.attitude, about_third(end[3]))
    relative = product(end[4:], conjugate(target))
    return relative if relative[0] >= 0 else -relative


def residual_and_distance(extremal):
    """The largest residual of the printed conditions, and the distance missed."""
    meeting = RotatedMeeting(extremal, math.nan)
    return meeting.printed, meeting.distance


@pytest.mark.parametrize("degrees", [0.0, 15.0, 40.0])
def test_the_attitude_at_t_k_is_that_of_the_target_rotated_about_nu_star(true, degrees):
    """In the plane it is rotated about the normal of the target's orbit, which is parallel to nu*."""
    found = false_meeting(true.problem, math.radians(degrees), true)
    assert residual_and_distance(found)[0] < 1e-10
    assert found.certificate.maximality < 1e-10 and found.certificate.agreement < 1e-10
    turn = turn_of(found)
    angle = 2 * math.atan2(np.linalg.norm(turn[1:]), turn[0])
    assert angle == pytest.approx(math.radians(degrees), abs=1e-10)
    assert found.certificate.holds(1e-10) == (degrees == 0)
    if degrees:
        normal = rotated(np.array([0.0, 0.0, 1.0]), true.problem.target.attitude)
        axis = rotated(found.initial_costate[3:], np.array(CRAFT.attitude))
        if np.linalg.norm(np.cross(normal, axis)) < 1e-12 * np.linalg.norm(axis):
            axis = normal
        assert turn[1:] / np.linalg.norm(turn[1:]) == pytest.approx(axis / np.linalg.norm(axis), abs=1e-10)


def test_the_distance_missed_is_that_by_newton_s_law_and_kepler_s_equation(true):
    """The certificate holds the largest coordinate of the same difference."""
    found = false_meeting(true.problem, math.radians(30), true)
    assert residual_and_distance(true)[1] < 1e-10
    gap = residual_and_distance(found)[1] / true.problem.scaled.length
    assert 0.1 < gap < 2 * math.sin(math.radians(15)) * 1.5
    assert found.certificate.cartesian > gap / 4


@pytest.mark.parametrize("rotated_equations", [rotated_equations, leading_equations])
@pytest.mark.parametrize("free", [True, False])
def test_the_jacobian_and_the_slope_are_the_derivatives_of_the_rotated_equations(free, rotated_equations):
    extremal = meeting(20)
    scaled, h = extremal.problem.scaled, 1e-6
    setting = Setting(scaled, 0.004 if free else 0.0, math.inf, duration=None if free else scaled.duration)
    point = extremal.root.unknowns
    point = np.append(point, extremal.flight.duration) if free else point
    exact, by_angle = rotated_equations(setting, point, 0.3)

    def residual(unknowns, angle=0.3):
        return rotated_equations(setting, unknowns, angle)[0].residual

    steps = h * np.eye(len(point))
    columns = [(residual(point + step) - residual(point - step)) / (2 * h) for step in steps]
    assert np.allclose(np.array(columns).T, exact.jacobian, rtol=1e-5, atol=1e-6)
    slope = (residual(point, 0.3 + h) - residual(point, 0.3 - h)) / (2 * h)
    assert np.allclose(slope, by_angle, atol=1e-8)
    unrotated = rotated_equations(setting, point, 0.0)[0]
    assert np.array_equal(unrotated.residual, equations(setting, point).residual)


def test_a_false_meeting_can_cost_less_than_the_optimum():
    true = meeting(20)
    found = false_meeting(true.problem, math.radians(-20), true)
    residual, distance = residual_and_distance(found)
    assert residual < 1e-10 and distance > 0.3
    assert found.cost < true.cost


def test_the_error_of_a_curve_that_turns_back_names_where_it_ends():
    true = meeting(20)
    with pytest.raises(
        NotConverged, match=r"the curve of false meetings ends at -?\d.* rad, before it reaches -2.967"
    ):
        false_meeting(true.problem, math.radians(-170), true)


def test_an_angle_that_is_not_a_number_is_refused(true):
    with pytest.raises(ValueError, match=r"^angle must be a number and finite, got nan"):
        false_meeting(true.problem, math.nan, true)


def test_newton_s_method_on_the_repaired_equations_leads_from_a_false_meeting_to_a_true_one(true):
    found = false_meeting(true.problem, math.radians(5), true)
    scaled = true.problem.scaled
    setting = Setting(scaled, scaled.ratio, scaled.peak, duration=scaled.duration)
    assert Extremal(true.problem, meet(setting, found.root.unknowns)).certificate.holds(1e-10)
