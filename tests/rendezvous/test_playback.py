"""Recordings hold the solver's arrays, and the recorded craft and target obey Newton's law."""

import math
import subprocess
import sys

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.interpolate import make_interp_spline
from scipy.spatial.transform import Rotation

from pontryagin.display.recording import read_back
from pontryagin.io.files import repository
from pontryagin.rendezvous import Chaser, Orbit, Rendezvous, playback, solve
from pontryagin.rendezvous.false_meetings.family import false_meeting
from pontryagin.rendezvous.false_meetings.meeting import RotatedMeeting
from pontryagin.rendezvous.figures.profile import profile
from pontryagin.rendezvous.playback.motion import (
    EVEN,
    TURN,
    motion_of,
)

pytestmark = pytest.mark.extra(name="recording")

LENGTH, GRAVITY = 7000.0, 398600.0
TIME = math.sqrt(LENGTH**3 / GRAVITY)
START = [math.cos(0.3), 0.0, math.sin(0.3), 0.0]
ENERGY_WEIGHT = 3e5
ANGLE = -25
"""Angle about nu* of the false meeting, in degrees."""


def transfer(peak, duration, revolutions=1.0):
    """From a circle to an inclined ellipse in fixed time, in km and s; arguments in units with fM = r = 1."""
    attitude = Rotation.from_quat(START, scalar_first=True) * Rotation.from_euler("x", 20, degrees=True)
    target = Orbit(1.5 * LENGTH, 0.1, attitude.as_quat(scalar_first=True), 0.6)
    problem = Rendezvous(
        Chaser(LENGTH, 0.0, math.sqrt(GRAVITY * LENGTH), START),
        target,
        time_weight=0.5,
        energy_weight=ENERGY_WEIGHT,
        peak=peak * LENGTH / TIME**2,
        gravity=GRAVITY,
        duration=duration * TIME,
    )
    best = solve(problem)
    return min((best, *best.others), key=lambda one: abs(one.revolutions - revolutions))


def recorded(extremal, path, true=None):
    playback.record_extremal(extremal, path, true)
    done = subprocess.run(
        [sys.executable, "-m", "rerun", "rrd", "verify", str(path)], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return read_back(path)


@pytest.fixture(scope="module")
def met(tmp_path_factory):
    extremal = transfer(0.08, 9.0, 0.2)
    assert extremal.certificate.holds(1e-9) and extremal.modes == ("saturated", "unsaturated")
    return extremal, recorded(extremal, tmp_path_factory.mktemp("met") / "a.rrd")


@pytest.fixture(scope="module")
def missed(tmp_path_factory):
    true = transfer(math.inf, 6.0)
    extremal = false_meeting(true.problem, math.radians(ANGLE), true)
    return true, extremal, recorded(extremal, tmp_path_factory.mktemp("missed") / "a.rrd", true)


def curve(held, entity):
    return held[f"/{entity}"]["time"], held[f"/{entity}"]["scalars"]


def within(extremal, t):
    return np.clip(t, 0.0, extremal.duration)


def test_every_recording_has_a_title_and_a_description():
    assert len(playback.recordings()) >= 4
    for writer in playback.recordings().values():
        title, description = writer.__doc__.split("\n\n", 1)
        assert title.endswith(".") and len(description) > 80


@pytest.mark.checkout
def test_every_recording_is_in_the_readme():
    readme = (repository() / "README.md").read_text()
    for name in playback.recordings():
        assert f"| `{name}` |" in readme


@pytest.mark.slow
@pytest.mark.parametrize("which", ["met", "missed"])
def test_the_recorded_series_are_those_of_the_solver(which, request):
    *_, extremal, held = request.getfixturevalue(which)
    problem = extremal.problem
    t, _ = curve(held, "thrust/p1")
    assert len(t) >= EVEN and t[0] == 0 and t[-1] == pytest.approx(extremal.duration, rel=1e-12)
    control = extremal.control(within(extremal, t))
    unit = np.abs(control).max()
    for i, name in enumerate(("p1", "p2", "p3")):
        assert_allclose(curve(held, f"thrust/{name}")[1], control[:, i], atol=1e-9 * unit)
    size = np.linalg.norm(control, axis=1)
    assert_allclose(curve(held, "magnitude/thrust")[1], size, atol=1e-9 * unit)
    primer = curve(held, "switching/primer")[1]
    r, c = extremal.state(within(extremal, t)).T[[0, 2]]
    _, s1, e, nu1, _, _ = extremal.costate(within(extremal, t)).T
    assert_allclose(primer, np.sqrt(s1**2 + (r * e) ** 2 + (r * nu1 / (2 * c)) ** 2), rtol=1e-7)
    free = size < 0.999 * problem.peak
    assert_allclose(size[free], primer[free] / (2 * ENERGY_WEIGHT), rtol=1e-7)
    left = curve(held, "hamiltonian/power")[1]
    assert left.max() < -11
    assert left.max() <= math.log10(2 * extremal.certificate.hamiltonian + 1e-16) + 1


@pytest.mark.slow
def test_the_bound_and_its_threshold_are_recorded_if_the_thrust_is_bounded(met, missed):
    extremal, held = met
    assert_allclose(curve(held, "magnitude/bound")[1], extremal.problem.peak, rtol=1e-12)
    threshold = curve(held, "switching/saturation")[1]
    assert_allclose(threshold, 2 * ENERGY_WEIGHT * extremal.problem.peak, rtol=1e-12)
    t, primer = curve(held, "switching/primer")
    (switch,) = extremal.switch_times
    assert np.array_equal(primer > threshold[0] * (1 + 1e-9), t < switch * (1 - 1e-9))
    assert f"t = {switch:.6g}: the thrust leaves its bound" in held["/events"]["text"]
    assert "/magnitude/bound" not in missed[-1] and "/switching/saturation" not in missed[-1]


def in_scene(problem, vectors):
    """Inertial vectors in the axes of the target's orbit, in units of p*."""
    axes = Rotation.from_quat(problem.target.attitude, scalar_first=True)
    return axes.inv().apply(vectors) / problem.target.parameter


def test_the_recorded_places_and_axes_are_those_of_the_states(met):
    extremal, held = met
    t, craft = held["/orbit/craft"]["time"], held["/orbit/craft"]["translation"]
    flown = t <= extremal.duration * (1 + 1e-12)
    states = extremal.state(within(extremal, t[flown]))
    eta = Rotation.from_quat(states[:, 4:], scalar_first=True)
    places = eta.apply(states[:, :1] * [1.0, 0.0, 0.0])
    assert_allclose(craft[flown], in_scene(extremal.problem, places), atol=1e-6)
    for i, axis in enumerate(np.eye(3), start=1):
        expected = in_scene(extremal.problem, eta.apply(axis)) * extremal.problem.target.parameter
        assert_allclose(held[f"/axes/eta-{i}"]["vectors"][flown], expected, atol=1e-6)
        arrow = held[f"/orbit/eta-{i}"]
        assert_allclose(arrow["origins"], craft, atol=1e-6)
        assert_allclose(_units(arrow["vectors"])[flown], expected, atol=1e-5)


def _units(vectors):
    return vectors / np.linalg.norm(vectors, axis=1)[:, None]


def newton(t, place, velocity, push=lambda t: np.zeros(3)):
    """Places by Newton's law, with lengths in units of p* and times in units of sqrt(p*^3/fM)."""

    def rates(time, state):
        return [*state[3:], *(-state[:3] / np.linalg.norm(state[:3]) ** 3 + push(time))]

    return solve_ivp(rates, t[[0, -1]], [*place, *velocity], "DOP853", t, rtol=1e-10, atol=1e-11).y.T


@pytest.mark.slow
@pytest.mark.parametrize("which", ["met", "missed"])
def test_the_recorded_places_obey_newton_s_law(which, request):
    """The craft moves under the recorded thrust until t_k and coasts afterwards; the target always coasts."""
    *_, extremal, held = request.getfixturevalue(which)
    problem = extremal.problem
    unit = math.sqrt(problem.target.parameter**3 / GRAVITY)
    t, craft = held["/orbit/craft"]["time"] / unit, held["/orbit/craft"]["translation"]
    count = len(held["/thrust/p1"]["time"])
    thrust = np.stack([curve(held, f"thrust/p{i}")[1] for i in (1, 2, 3)], axis=1)
    axes = Rotation.from_quat(held["/orbit/craft"]["quaternion"][:count], scalar_first=True)
    push = make_interp_spline(t[:count], axes.apply(thrust) / (problem.target.parameter / unit**2), k=1)
    start = extremal.state([0.0])[0]
    eta = Rotation.from_quat(start[4:], scalar_first=True)
    speed = in_scene(problem, eta.apply([start[1], start[2] / start[0], 0.0])) * unit
    flown = newton(t[:count], craft[0], speed, push)
    assert_allclose(flown[:, :3], craft[:count], atol=2e-4)
    coasted = newton(t[count - 1 :], flown[-1, :3], flown[-1, 3:])
    assert_allclose(coasted[:, :3], craft[count - 1 :], atol=5e-4)
    goal = held["/orbit/goal"]["translation"]
    e, phi = problem.target.eccentricity, problem.target.anomaly
    led = newton(t, goal[0], [-math.sin(phi), e + math.cos(phi), 0.0])
    assert_allclose(led[:, :3], goal, atol=1e-5)


def test_from_t_k_on_craft_and_target_have_one_place_and_one_attitude(met):
    extremal, held = met
    t, distance = curve(held, "distance/target")
    craft, goal = held["/orbit/craft"], held["/orbit/goal"]
    after = t >= extremal.duration * (1 - 1e-12)
    assert after.sum() > 20 and distance[after].max() < 1e-9 and distance[0] > 0.2
    assert_allclose(distance, np.linalg.norm(craft["translation"] - goal["translation"], axis=1), atol=1e-6)
    for i in (1, 2, 3):
        mine, theirs = held[f"/axes/eta-{i}"]["vectors"], held[f"/axes/eta-star-{i}"]["vectors"]
        assert_allclose(_units(mine)[after], _units(theirs)[after], atol=1e-6)
    assert held["/events"]["text"][-1].endswith(f"the target is met, cost {extremal.cost:.6g}")
    assert "/orbit/phantom" not in held and "/orbit/gap" not in held


def test_the_osculating_orbit_at_t_k_is_that_of_the_target(met):
    _, held = met
    lines = held["/orbit/osculating"]["strips"].reshape(len(held["/thrust/p1"]["time"]), -1, 3)
    assert_allclose(lines[0], held["/orbit/start"]["strips"].reshape(-1, 3), atol=1e-6)
    x, y, z = lines[-1].T
    assert_allclose(z, 0, atol=1e-6)
    assert_allclose(np.hypot(x, y), 1 - 0.1 * x, atol=1e-5)
    x, y, z = held["/orbit/target"]["strips"].reshape(-1, 3).T
    assert_allclose(np.hypot(x, y), 1 - 0.1 * x, atol=1e-6)
    assert_allclose(np.linalg.norm(lines[0], axis=1), 1 / 1.5, atol=1e-6)


def test_the_arrow_is_the_thrust_and_the_trail_is_the_path(met):
    _, held = met
    arrows = held["/orbit/thrust"]
    longest = np.linalg.norm(arrows["vectors"], axis=1)
    size = curve(held, "magnitude/thrust")[1]
    assert_allclose(longest[: len(size)] / longest.max(), size / size.max(), rtol=1e-5)
    assert not longest[len(size) :].any()
    pieces = held["/orbit/flown"]["strips"].reshape(-1, 2, 3)
    places = held["/orbit/craft"]["translation"]
    assert_allclose(arrows["origins"], places, atol=1e-6)
    assert_allclose(pieces[:, 0], places[:-1], atol=1e-6)
    assert_allclose(pieces[:, 1], places[1:], atol=1e-6)


class TestFalseMeeting:
    def test_the_target_is_missed_and_the_rotated_target_is_met(self, missed):
        _, extremal, held = missed
        t, distance = curve(held, "distance/target")
        after = t >= extremal.duration * (1 - 1e-12)
        meeting = RotatedMeeting(extremal, math.radians(ANGLE))
        gap = meeting.distance / extremal.problem.target.parameter
        assert gap > 0.2 and distance[after][0] == pytest.approx(gap, rel=1e-9)
        assert distance[after].min() > 0.2
        assert curve(held, "distance/phantom")[1][after].max() < 1e-9
        assert held["/events"]["text"][-1].endswith(f"the target is {gap:.2f} p* away")
        assert "conditions left" in held["/events"]["text"][-1]

    def test_the_gap_is_the_vector_from_the_craft_to_the_target_from_t_k_on(self, missed):
        _, extremal, held = missed
        gap, goal = held["/orbit/gap"], held["/orbit/goal"]["translation"]
        after = gap["time"] >= extremal.duration * (1 - 1e-12)
        assert_allclose((gap["origins"] + gap["vectors"])[after], goal[after], atol=1e-6)
        assert not gap["vectors"][~after].any()

    def test_the_rotated_target_is_the_target_rotated_about_nu_star_by_the_angle(self, missed):
        _, extremal, held = missed
        goal, phantom = (held[f"/orbit/{name}"]["translation"] for name in ("goal", "phantom"))
        nu = Rotation.from_quat(START, scalar_first=True).apply(extremal.initial_costate[3:])
        axis = in_scene(extremal.problem, nu)
        axis /= np.linalg.norm(axis)
        shown = held["/orbit/nu-star"]["vectors"].reshape(-1, 3)
        assert_allclose(_units(shown)[0], axis, atol=1e-6)
        turn = Rotation.from_rotvec(math.radians(ANGLE) * axis)
        assert_allclose(phantom, turn.apply(goal), atol=1e-6)
        after = held["/orbit/goal"]["time"] >= extremal.duration * (1 - 1e-12)
        for i in (1, 2, 3):
            mine, theirs = held[f"/axes/eta-{i}"]["vectors"], held[f"/axes/eta-star-{i}"]["vectors"]
            assert_allclose(_units(mine)[after], turn.apply(_units(theirs)[after]), atol=1e-5)
        ring = held["/orbit/target"]["strips"].reshape(-1, 3)
        assert_allclose(held["/orbit/phantom-orbit"]["strips"].reshape(-1, 3), turn.apply(ring), atol=1e-6)

    def test_the_path_of_the_true_optimum_is_recorded_too(self, missed):
        true, _, held = missed
        end = true.state([true.duration])[0]
        path = held["/orbit/true"]["strips"].reshape(-1, 3)
        radius = np.linalg.norm(path[[0, -1]], axis=1)
        assert_allclose(radius, [1 / 1.5, end[0] / true.problem.target.parameter], atol=1e-6)
        assert any(text.startswith("grey: the true optimum") for text in held["/events"]["text"])


def test_the_direction_of_the_thrust_changes_little_between_samples():
    """A thrust that nearly vanishes on the way reverses its direction there."""
    motion = motion_of(transfer(math.inf, 4.0))
    directions = _units(motion.thrust[: motion.meeting])
    assert np.linalg.norm(np.diff(directions, axis=0), axis=1).max() < 1.01 * TURN
    even = _units(motion.extremal.control(np.linspace(0, motion.extremal.duration, EVEN)))
    assert np.linalg.norm(np.diff(even, axis=0), axis=1).max() > 1.5 * TURN


@pytest.mark.slow
def test_the_profile_shows_the_series_that_are_recorded(met):
    extremal, held = met
    figure = profile(extremal)
    components, magnitude = figure.axes[2], figure.axes[3]
    for i, line in enumerate(components.lines, start=1):
        assert_allclose(line.get_ydata(), curve(held, f"thrust/p{i}")[1], rtol=1e-12)
    assert_allclose(magnitude.lines[0].get_ydata(), curve(held, "magnitude/thrust")[1], rtol=1e-12)
    assert magnitude.lines[1].get_ydata()[0] == extremal.problem.peak
    assert figure.axes[4].lines[1].get_ydata()[0] == pytest.approx(2 * ENERGY_WEIGHT * extremal.problem.peak)
