"""Recordings are valid and hold the states and torques of the solutions."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

from pontryagin.triple_integrator import (
    Maneuver,
    minimum_energy,
    minimum_impulse,
    minimum_norm,
    minimum_peak,
    minimum_time,
    playback,
)
from pontryagin.triple_integrator.attitude import turn
from pontryagin.triple_integrator.coupling import couple
from recording_files import assert_described, verified

pytestmark = pytest.mark.extra(name="recording")

AXIS = [1, 2, 2]
NORMS = {"energy": minimum_energy, "peak": minimum_peak, "impulse": minimum_impulse}


@pytest.fixture(scope="module")
def three_norms(tmp_path_factory):
    path = tmp_path_factory.mktemp("recordings") / "three-norms.rrd"
    playback.recordings()["three-norms"](path)
    return verified(path)


def test_every_recording_has_a_title_and_a_description():
    assert_described(playback.recordings())


@pytest.mark.slow
@pytest.mark.parametrize("norm", NORMS)
def test_the_three_norms_hold_the_solver_s_states(three_norms, norm):
    solution = NORMS[norm](Maneuver([0, 0, 0], [np.pi / 2, 0, 0], tf=6.0))
    t = three_norms[f"/angle/{norm}"]["time"]
    x = solution.state(t)
    assert_allclose(three_norms[f"/angle/{norm}"]["scalars"], x[:, 0], atol=1e-8)
    assert_allclose(three_norms[f"/rate/{norm}"]["scalars"], x[:, 1], atol=1e-8)
    attitude = three_norms[f"/turn/{norm}"]["quaternion"]
    turned = Rotation.from_quat(attitude, scalar_first=True).as_rotvec()
    assert_allclose(turned, np.outer(x[:, 0], [0, 0, 1]), atol=1e-6)


def test_the_control_is_that_of_the_solver_away_from_switches(three_norms):
    for norm in ("energy", "peak"):
        solution = NORMS[norm](Maneuver([0, 0, 0], [np.pi / 2, 0, 0], tf=6.0))
        curve = three_norms[f"/control/{norm}"]
        smooth = np.min(np.abs(curve["time"][:, None] - [-1, *solution.breakpoints]), axis=1) > 1e-6
        assert_allclose(curve["scalars"][smooth], solution.control(curve["time"][smooth]), atol=1e-7)


def test_both_sides_of_an_acceleration_jump_are_held(three_norms):
    curve = three_norms["/acceleration/impulse"]
    middle = curve["scalars"][np.abs(curve["time"] - 3.0) < 3e-9]
    assert_allclose([middle.min(), middle.max()], np.array([-1, 1]) * np.pi / 18, atol=1e-12)


def test_impulses_are_spikes_arrows_and_events(three_norms):
    solution = minimum_impulse(Maneuver([0, 0, 0], [np.pi / 2, 0, 0], tf=6.0))
    curve = three_norms["/control/impulse"]
    assert (np.diff(curve["time"]) > 0).all(), "the player averages values of one time"
    assert np.interp([1.5, 4.5], curve["time"], curve["scalars"]).tolist() == [0.0, 0.0]
    for time, jump in zip(solution.impulse_times, solution.impulses, strict=True):
        near = np.abs(curve["time"] - time) <= 0.03001
        heights = curve["scalars"][near]
        assert heights[np.argmax(np.abs(heights))] == pytest.approx(jump)
        arrow = three_norms["/turn/impulse-impulse"]
        shown = arrow["vectors"][np.argmin(np.abs(arrow["time"] - time))]
        assert np.sign(shown[2]) == np.sign(jump)
    events = three_norms["/events"]
    told = [text for text in events["text"] if text.startswith("impulse:")]
    assert told == [f"impulse: impulse {jump:+.4g} rad/s²" for jump in solution.impulses]
    switches = minimum_peak(Maneuver([0, 0, 0], [np.pi / 2, 0, 0], tf=6.0)).switch_times
    assert_allclose(events["time"], np.sort([*solution.impulse_times, *switches]), atol=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("norm", NORMS)
def test_the_real_turn_holds_the_simulated_attitudes_and_torques(tmp_path, norm):
    path = tmp_path / "turn.rrd"
    playback.recordings()[f"real-turn-{norm}"](path)
    held = verified(path)
    programme = NORMS[norm](Maneuver([0, 0, 0], [2.0, 0, 0], tf=6.0))
    t = held["/error/without"]["time"]
    keep = np.min(np.abs(t[:, None] - [-1, *programme.breakpoints, 0, 6]), axis=1) > 1e-6
    for label, feedforward in (("with-feedforward", True), ("without", False)):
        made = turn(playback.SPACECRAFT, AXIS, programme, feedforward)
        assert_allclose(held[f"/turn/{label}"]["quaternion"], made.attitude(t), atol=1e-6)
        assert_allclose(held[f"/error/{label}"]["scalars"], np.linalg.norm(made.error(t), axis=1), atol=1e-8)
        assert_allclose(held[f"/rate/{label}-2"]["scalars"], made.rate(t)[:, 1], atol=1e-8)
        assert any(f"{made.attitude_miss:.3g} rad" in text for text in held["/events"]["text"])
        for i in range(3):
            channel = held[f"/torque/channel/{i + 1}"]["scalars"]
            assert_allclose(channel[keep], made.channel_torque(t[keep])[:, i], atol=1e-7)
            gyroscopic = held[f"/torque/gyroscopic/{i + 1}"]["scalars"]
            assert_allclose(gyroscopic, made.gyroscopic_torque(t)[:, i], atol=1e-7)


@pytest.mark.slow
def test_the_coupled_channels_hold_what_was_coupled(tmp_path):
    coupled = couple(
        playback.SPACECRAFT,
        [Maneuver([0, 0, 0], [end, 0, 0], tf=6.0) for end in (0.1, -0.2, 0.15)],
        minimum_energy,
    )
    path = tmp_path / "coupled.rrd"
    playback.record_coupled(path, coupled)
    held = verified(path)
    t = held["/angle/1"]["time"]
    for i in range(3):
        assert_allclose(held[f"/angle/{i + 1}"]["scalars"], coupled.state(t)[i, :, 0], atol=1e-9)
        assert_allclose(held[f"/coupling/{i + 1}"]["scalars"], coupled.coupling(t)[i], atol=1e-9)
        assert_allclose(held[f"/control/{i + 1}"]["scalars"], coupled.control(t)[i], atol=1e-9)
    assert_allclose(held["/turn/coupled"]["quaternion"], coupled.attitude(t), atol=1e-6)
    assert held["/left/coupled"]["scalars"][-1] < 1e-9
    assert held["/left/uncoupled"]["scalars"][-1] > 1e-3
    assert len(held["/events"]["text"]) == coupled.misses.size


@pytest.mark.slow
@pytest.mark.parametrize(
    "solution",
    [
        minimum_norm(Maneuver([0, 0, 0], [1, 0, 0], tf=2.0), 1.5),
        minimum_time([0, 0, 0], [1, 0.2, 0], peak=3.0),
        minimum_impulse(Maneuver([0, 1, 0], [1, 0, 0.5], tf=5.0, t0=4.0, disturbance=np.sin)),
        minimum_impulse(Maneuver([0, 0, 0], [0, 0, 0], tf=1.0)),
    ],
)
def test_any_solution_can_be_recorded(tmp_path, solution):
    playback.record_solution(solution, tmp_path / "one.rrd")
    held = verified(tmp_path / "one.rrd")
    t = held["/angle/programme"]["time"]
    first, last = float(solution.maneuver.t0), float(solution.maneuver.tf)
    assert_allclose([t[0], t[-1]], [first, last], atol=1e-8)
    inside = np.clip(t, first, last)
    assert_allclose(held["/angle/programme"]["scalars"], solution.state(inside)[:, 0], atol=1e-7)


def test_impulses_of_a_short_manoeuvre_are_spikes_too(tmp_path):
    solution = minimum_impulse(Maneuver([0, 0, 0], [1, 0, 0], tf=1e-5))
    playback.record_solution(solution, tmp_path / "short.rrd")
    heights = verified(tmp_path / "short.rrd")["/control/programme"]["scalars"]
    assert_allclose([heights.min(), heights.max()], [solution.impulses.min(), solution.impulses.max()])


def test_a_stack_cannot_be_recorded(tmp_path):
    stack = minimum_energy(Maneuver(np.zeros((2, 3)), np.ones((2, 3)), tf=1.0))
    with pytest.raises(ValueError, match=r"^solution must be the solution of one manoeuvre"):
        playback.record_solution(stack, tmp_path / "one.rrd")
    assert not list(tmp_path.iterdir())
