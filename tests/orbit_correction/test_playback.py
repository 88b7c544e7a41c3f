"""Recordings hold the solver's arrays, and their sets are those of the remaining impulses."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import expm
from scipy.optimize import linprog

from pontryagin.display.recording import Scene, read_back, record
from pontryagin.orbit_correction import correct, playback, sets
from pontryagin.orbit_correction.flight import fly_plan
from pontryagin.orbit_correction.playback import scene
from pontryagin.orbit_correction.playback.remaining import remaining
from pontryagin.orbit_correction.printed import Z0
from pontryagin.orbit_correction.system.satellite import LINEAR
from recording_files import assert_described, verified

pytestmark = [pytest.mark.slow, pytest.mark.extra(name="recording")]

PLANS = {"orbit-correction": correct(Z0), "orbit-correction-square": correct(Z0, thrust="box")}


@pytest.fixture(scope="module", params=PLANS)
def played(request, tmp_path_factory):
    path = tmp_path_factory.mktemp("recordings") / f"{request.param}.rrd"
    playback.recordings()[request.param](path)
    return PLANS[request.param], verified(path)


def test_every_recording_has_a_title_and_a_description():
    assert_described(playback.recordings())


@pytest.mark.slow
def test_the_flight_is_the_true_one(played):
    plan, recorded = played
    flight = fly_plan(plan)
    times, states, angles = flight.path(scene.SAMPLES)
    for name, values in zip(("dr", "dvR", "dvT"), states.T, strict=True):
        shown = recorded[f"/state/{name}"]["time"]
        assert np.all(np.diff(shown) > 0.9 * scene.BLINK)
        after_a_jump = np.append(False, np.diff(times) == 0)
        assert_allclose(shown, scene.PACE * times + scene.BLINK * after_a_jump, atol=1e-8)
        assert_allclose(recorded[f"/state/{name}"]["scalars"], 1e3 * values, atol=1e-12)
    radii = scene.RADIUS * (1 + scene.magnification(plan) * states[:, 0])
    places = radii[:, None] * np.column_stack([np.cos(angles), np.sin(angles), np.zeros(len(angles))])
    assert_allclose(recorded["/orbit/satellite"]["translation"], places, atol=1e-5)


def test_impulses_are_curves_arrows_and_events(played):
    plan, recorded = played
    for side, name in enumerate(("radial", "transverse")):
        curve = recorded[f"/impulse/{name}"]
        for shift, share in ((0.0, 0.0), (scene.HOLD, 1.0), (scene.HOLD + 2 * scene.BLINK, 0.0)):
            drawn = np.interp(2.5 * np.arange(plan.impulse_count) + shift, curve["time"], curve["scalars"])
            assert_allclose(drawn, share * plan.impulses[:, side] / 0.0035, atol=1e-7)
    arrows = recorded["/orbit/impulse"]["vectors"][1 :: scene.SAMPLES]
    assert_allclose(
        np.linalg.norm(arrows, axis=1),
        scene.LENGTH * np.linalg.norm(plan.impulses, axis=1) / 0.0035,
        rtol=1e-5,
    )
    events = recorded["/events"]
    assert len(events["text"]) == plan.impulse_count + 1
    assert_allclose(events["time"], 2.5 * np.arange(plan.impulse_count + 1), atol=1e-8)
    assert f"{fly_plan(plan).residual:.2e}" in events["text"][-1]


def test_the_gauge_stays(played):
    plan, recorded = played
    alpha = recorded["/gauge/alpha"]["scalars"]
    assert len(alpha) == 3 + scene.SAMPLES * (int(plan.impulse_count) - 1)
    assert_allclose(alpha[:-2], plan.gauge, rtol=1e-9)
    assert alpha[-2:].tolist() == [0, 0]
    assert recorded["/gauge/alpha"]["time"][-1] == pytest.approx(2.5 * float(plan.impulse_count))


def test_the_nets_and_the_state_are_those_of_the_linear_motion(played):
    plan, recorded = played
    square = plan.thrust.name == "box"
    frame = sets.frame_of(plan.thrust.factors(int(plan.steps)), square)
    times = recorded["/sets/state"]["time"]
    state = np.array(Z0)
    for j, impulse in enumerate(plan.impulses):
        row = 0 if j == 0 else 1 + (j - 1) * scene.SAMPLES + scene.SAMPLES - 1
        assert times[row] == pytest.approx(2.5 * j, abs=1e-8)
        assert_allclose(recorded["/sets/state"]["vectors"][row], frame.points(state), atol=1e-5)
        net = recorded["/sets/meridians"]["strips"][row]
        inside = frame.points(state) / plan.gauge
        assert _within_hull(0.9 * inside, net.reshape(-1, 3))
        assert not _within_hull(1.01 * inside, net.reshape(-1, 3))
        state = expm(LINEAR * 0.25) @ (state + np.append(0.0, impulse))
    assert_allclose(state, 0, atol=1e-15)


def _within_hull(point, corners):
    """Whether a point is a convex combination of corners."""
    equal = np.vstack([corners.T, np.ones(len(corners))])
    answer = linprog(
        np.zeros(len(corners)), A_eq=equal, b_eq=np.append(point, 1), bounds=[(0, None)] * len(corners)
    )
    return answer.status == 0


@pytest.mark.parametrize("fired", range(6))
def test_what_remains_has_the_state_on_its_boundary(fired):
    """From each instant the remaining controls, and no smaller ones, bring the state back."""
    plan = PLANS["orbit-correction"]
    left = remaining(plan, fired)
    recorded = np.array(Z0)
    for j in range(fired):
        recorded = recorded + expm(-LINEAR * 0.25 * j) @ [0, *plan.impulses[j]]
    reached = plan.gauge * left.boundary(-plan.initial_costate, square=False)
    assert_allclose(reached, recorded, atol=1e-15)


def test_a_net_is_held_line_by_line(tmp_path):
    strips = np.arange(2 * 3 * 4 * 3, dtype=float).reshape(2, 3, 4, 3)
    with record(tmp_path / "net.rrd", "net", [[Scene("net", "net")]]) as recording:
        recording.net("net", [0.0, 1.0], strips, "#0072B2")
    assert_allclose(read_back(tmp_path / "net.rrd")["/net"]["strips"], strips)


def test_what_has_nothing_to_show_is_refused(tmp_path):
    for plan, words in (
        (correct([0.0, 0.0, 0.0]), "must have an impulse"),
        (correct([Z0, Z0]), "of one state"),
    ):
        with pytest.raises(ValueError, match=words):
            playback.record_plan(plan, tmp_path / "a.rrd")
    assert not list(tmp_path.iterdir())
