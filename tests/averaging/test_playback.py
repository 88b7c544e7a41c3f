"""Recordings hold the solver's arrays, and their motions obey the laws of motion."""

import subprocess
import sys

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation

from pontryagin.averaging import (
    kepler,
    playback,
    smooth_example,
    spin_down,
)
from pontryagin.averaging.examples import spiral
from pontryagin.averaging.figures.drift import drift
from pontryagin.averaging.playback import attitude
from pontryagin.averaging.playback.pair import Pair
from pontryagin.display.recording import read_back

pytestmark = [pytest.mark.slow, pytest.mark.extra(name="recording")]


def recorded(pair, path):
    playback.record_solution(pair.averaged, pair.exact, path)
    done = subprocess.run(
        [sys.executable, "-m", "rerun", "rrd", "verify", str(path)], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    return read_back(path)


def test_every_recording_has_a_title_and_a_description():
    for writer in playback.recordings().values():
        title, description = writer.__doc__.split("\n\n", 1)
        assert title.endswith(".") and len(description) > 80


def assert_slow_curves(pair, held, tau):
    averaged, exact = pair.averaged.slow(pair.grid), pair.exact.slow(tau)
    for i, name in enumerate(pair.averaged.names):
        assert_allclose(held[f"/slow-{name}/exact"]["time"], tau / pair.epsilon, atol=1e-8)
        assert_allclose(held[f"/slow-{name}/exact"]["scalars"], exact[:, i], atol=1e-12)
        assert_allclose(held[f"/slow-{name}/averaged"]["scalars"], averaged[:, i], atol=1e-12)
        apart = held[f"/difference/{name}"]
        at = held[f"/slow-{name}/averaged"]
        mean = np.interp(apart["time"], at["time"], at["scalars"])
        both = held[f"/slow-{name}/exact"]["scalars"][: len(mean)]
        assert_allclose(pair.epsilon * apart["scalars"], both - mean, atol=1e-4)
    assert held["/cost/averaged"]["scalars"][-1] == pytest.approx(float(pair.averaged.cost), rel=1e-9)
    assert held["/cost/exact"]["scalars"][-1] == pytest.approx(pair.exact.cost, rel=1e-9)
    costate = held["/costate/exact"]["scalars"]
    assert abs(costate[-1]) < 1e-6 * np.abs(costate).max()
    assert len(held["/events"]["text"]) >= 2


@pytest.fixture(scope="module")
def orbit(tmp_path_factory):
    solution = kepler(-0.5, 0.95, -0.35, 0.1)
    pair = Pair(solution, solution.exact(0.02)[0])
    return pair, recorded(pair, tmp_path_factory.mktemp("orbit") / "a.rrd")


class TestOrbit:
    @pytest.fixture
    def pair(self, orbit):
        return orbit[0]

    @pytest.fixture
    def held(self, orbit):
        return orbit[1]

    @pytest.mark.slow
    def test_the_series_are_those_of_both_extremals(self, pair, held):
        flight = spiral.fly(pair.exact)
        assert_slow_curves(pair, held, flight.tau)
        control = pair.exact.control(flight.tau)
        for i, name in enumerate(("along", "across")):
            assert_allclose(held[f"/thrust/{name}"]["scalars"], control[:, i], atol=1e-12)

    def test_newton_s_law_leads_through_the_recorded_places(self, pair, held):
        craft = held["/orbit/spacecraft"]
        t, places = craft["time"], craft["translation"]
        push = CubicSpline(t, np.column_stack([held[f"/thrust/{n}"]["scalars"] for n in ("along", "across")]))

        def rate(time, state):
            place, velocity = state[:2], state[2:]
            along = place / np.hypot(*place)
            thrust = np.array([[along[0], -along[1]], [along[1], along[0]]]) @ push(time)
            return [*velocity, *(-place / np.hypot(*place) ** 3 + 0.02 * thrust)]

        eccentricity = np.sqrt(1 - 0.95**2)
        start = [0.95**2 / (1 + eccentricity), 0.0, 0.0, (1 + eccentricity) / 0.95]
        flown = solve_ivp(rate, (0, t[-1]), start, method="DOP853", t_eval=t, rtol=1e-11, atol=1e-12)
        assert_allclose(flown.y[:2].T, places[:, :2], atol=2e-5)
        assert np.ptp(np.unwrap(np.arctan2(places[:, 1], places[:, 0]))) > 6 * np.pi

    def test_the_spacecraft_is_on_its_osculating_ellipse_which_has_the_centre_as_focus(self, pair, held):
        lines = held["/orbit/osculating"]["strips"]
        lines = lines.reshape(len(lines), -1, 3)[..., :2].astype(float)
        energy = held["/slow-E/exact"]["scalars"]
        second = lines[:, 0] + lines[:, lines.shape[1] // 2]
        places = held["/orbit/spacecraft"]["translation"][:, :2]
        for points in (lines, places[:, None]):
            sums = np.linalg.norm(points, axis=-1) + np.linalg.norm(points - second[:, None], axis=-1)
            assert_allclose(sums, np.broadcast_to(-1 / energy[:, None], sums.shape), atol=1e-5)

    def test_the_arrow_is_the_thrust_and_the_trail_the_way(self, held):
        arrows = np.linalg.norm(held["/orbit/thrust"]["vectors"], axis=1)
        control = np.hypot(*(held[f"/thrust/{name}"]["scalars"] for name in ("along", "across")))
        assert_allclose(arrows / arrows.max(), control / control.max(), rtol=1e-5)
        pieces = held["/orbit/flown"]["strips"].reshape(-1, 2, 3)
        places = held["/orbit/spacecraft"]["translation"]
        assert_allclose(pieces[:, 0], places[:-1], atol=1e-6)
        assert_allclose(pieces[:, 1], places[1:], atol=1e-6)


MOMENTS, SEMIAXES = np.array([1.0, 1.0, 0.5]), np.array([1.0, 0.5, 0.7])


@pytest.fixture(scope="module")
def body(tmp_path_factory):
    solution = spin_down([1.0, 0.2, 2.0], SEMIAXES, 0.5)
    pair = Pair(solution, solution.exact(0.05)[0])
    return pair, recorded(pair, tmp_path_factory.mktemp("body") / "a.rrd")


class TestBody:
    @pytest.fixture
    def pair(self, body):
        return body[0]

    @pytest.fixture
    def held(self, body):
        return body[1]

    @pytest.fixture(params=["synthesis", "exact"])
    def motion(self, pair, held, request):
        make = {"synthesis": attitude.synthesised_motion, "exact": attitude.exact_motion}[request.param]
        return make(pair), request.param

    @pytest.mark.slow
    def test_euler_s_equations_lead_through_the_rates(self, motion):
        motion, _ = motion
        push = CubicSpline(motion.t, motion.control)

        def rate(t, w):
            return 0.05 * push(t) - np.cross(w, MOMENTS * w) / MOMENTS

        whole = motion.t[: -len(motion.t) // 20]
        turned = solve_ivp(
            rate, (0, whole[-1]), [1.0, 0.2, 2.0], method="DOP853", t_eval=whole, rtol=1e-10, atol=1e-11
        )
        assert_allclose(turned.y.T, motion.rate[: len(whole)], atol=1e-5)
        assert np.hypot(*motion.rate[-1, :2]) < 2e-4 and motion.rate[-1, 2] > 1.9

    def test_the_angular_momentum_in_space_changes_by_the_torque(self, motion):
        motion, _ = motion
        torque = 0.05 * motion.in_space(MOMENTS * motion.control)
        gained = CubicSpline(motion.t, torque).antiderivative()(motion.t)
        assert_allclose(motion.angular_momentum[0, :2], 0, atol=1e-12)
        assert_allclose(motion.angular_momentum - motion.angular_momentum[0], gained, atol=1e-5)

    def test_what_is_recorded_is_the_motion(self, motion, held):
        motion, name = motion
        assert_allclose(held[f"/{name}/body"]["quaternion"], motion.attitude, atol=1e-6)
        for i, axis in enumerate("xyz"):
            assert_allclose(held[f"/rate-{axis}/{name}"]["scalars"], motion.rate[:, i], atol=1e-12)
        assert_allclose(held[f"/form/{name}"]["scalars"], 1, atol=1e-9)
        assert_allclose(held[f"/ellipsoid/{name}/control"]["vectors"], motion.control, atol=1e-6)
        turned = Rotation.from_quat(held[f"/{name}/body"]["quaternion"], scalar_first=True)
        velocity = held[f"/{name}/velocity"]["vectors"]
        inside = turned.inv().apply(velocity)
        assert_allclose(inside / np.linalg.norm(inside, axis=1)[:, None], _units(motion.rate), atol=1e-5)

    def test_the_synthesis_takes_little_longer_than_the_optimum(self, pair, held):
        synthesis = held["/rate-x/synthesis"]["time"][-1]
        best = held["/rate-x/exact"]["time"][-1]
        assert 0 < 0.05 * (synthesis - best) < 0.1 * pair.exact.duration
        assert len(held["/events"]["text"]) == 3

    def test_the_figure_shows_the_rates_that_are_recorded(self, pair, held):
        panels = drift(pair.averaged, pair.exact).axes
        for panel, names in zip(panels, (("x", "y"), ("z",)), strict=False):
            tau, shown = panel.lines[-1].get_data()
            rates = [held[f"/rate-{name}/exact"] for name in names]
            known = np.sqrt(sum(rate["scalars"] ** 2 for rate in rates))
            assert_allclose(np.interp(tau, 0.05 * rates[0]["time"], known), shown, atol=1e-3)


def _units(vectors):
    return vectors / np.linalg.norm(vectors, axis=1)[:, None]


class TestWheel:
    @pytest.mark.slow
    def test_the_wheel_turns_by_the_anomaly(self, tmp_path):
        solution = smooth_example(1.0, 2.0, ripple=0.5)
        pair = Pair(solution, solution.exact(0.1)[0])
        held = recorded(pair, tmp_path / "a.rrd")
        tau = 0.1 * held["/wheel/spoke"]["time"]
        tau[-1] = pair.exact.duration
        assert_slow_curves(pair, held, tau)
        angle = pair.exact.anomaly(tau)
        assert_allclose(held["/wheel/spoke"]["translation"][:, 0], np.cos(angle) / 2, atol=1e-5)
        assert_allclose(held["/control/exact"]["scalars"], pair.exact.control(tau)[:, 0], atol=1e-9)

    def test_a_stack_is_refused(self, tmp_path):
        solution = smooth_example(1.0, [2.0, 3.0])
        with pytest.raises(ValueError, match="stack of shape"):
            playback.record_solution(solution, smooth_example(1.0, 2.0).exact(0.1)[0], tmp_path / "a.rrd")
        assert not list(tmp_path.iterdir())
