"""Recordings hold the arrays that were written, and their layout."""

import subprocess
import sys
from importlib import util
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from pontryagin.display import recording
from pontryagin.display.recording import Events, Plot, Scene, record

pytestmark = pytest.mark.extra(name="recording")

LAYOUT = [[Scene("the turn", "turn")], [Plot("angle", "angle"), Events("events", "events")]]
T = np.linspace(0.0, 2.0, 21)
ATTITUDE = np.stack([np.cos(T), np.sin(T), 0 * T, 0 * T], axis=-1)


@pytest.fixture
def target(tmp_path):
    return tmp_path / "turn.rrd"


def layout_batches(path):
    """The batches of columns that describe the layout in a recording."""
    from rerun.chunk import RrdReader

    reader = RrdReader(str(path))
    (layout,) = reader.blueprints()
    return [chunk.to_record_batch() for chunk in reader.stream(store=layout).to_chunks()]


def write_turn(path):
    with record(path, "turn", LAYOUT) as turn:
        turn.body("turn/craft", T, ATTITUDE, size=(2.0, 1.2, 0.6), position=np.outer(T, [1, 2, 3]))
        turn.arrow("turn/axis", T, np.outer(T, [0, 0, 1]), "black", label="axis")
        turn.ellipsoid("turn/bound", T, np.ones((21, 3)), np.zeros((21, 3)), ATTITUDE, "green")
        turn.path("turn/trace", np.outer(T, [1, 0, 0]), "red")
        turn.curve("angle/energy", T, np.sin(T), "least energy", "#0072B2")
        turn.event("events", 1.5, "second impulse")
        turn.event("events", 0.5, "first impulse")


@pytest.mark.slow
def test_a_trail_is_written_segment_by_segment(target):
    points = np.outer(T, [1.0, 2.0, 3.0])
    layout = [[Scene("way", "way", share=2.0, trails=("way/flown",), grid=False)]]
    layout.append([Plot("u", "u", span=(0.0, 1.0), whole=True, legend="LeftTop")])
    with record(target, "way", layout, speed=2.0, shares=(2, 1)) as recording_:
        recording_.trail("way/flown", T, points, "red")
    found = recording.read_back(target)["/way/flown"]
    pieces = found["strips"].reshape(-1, 2, 3)
    np.testing.assert_allclose(pieces[:, 0], points[:-1], atol=1e-6)
    np.testing.assert_allclose(pieces[:, 1], points[1:], atol=1e-6)
    np.testing.assert_allclose(found["time"], T[1:], atol=1e-9)


def test_a_panel_of_another_kind_is_refused(target):
    with pytest.raises(TypeError, match="columns"), record(target, "none", [[recording.View("a", "a")]]):
        pass
    assert not target.exists()


@pytest.mark.slow
@settings(max_examples=15, deadline=None)
@given(arrays(float, st.integers(1, 30), elements=st.floats(-1e6, 1e6)))
def test_a_curve_is_read_back_to_the_last_bit(tmp_path_factory, values):
    path = tmp_path_factory.mktemp("recording") / "curve.rrd"
    t = np.arange(values.size) / 8
    with record(path, "a curve", [[Plot("curve", "curve")]]) as written:
        written.curve("curve/u", t, values, "u", "red")
    read = recording.read_back(path)["/curve/u"]
    np.testing.assert_array_equal(read["scalars"], values)
    np.testing.assert_array_equal(read["time"], t)


def test_a_recording_holds_the_arrays_that_were_written(target):
    write_turn(target)
    read = recording.read_back(target)
    np.testing.assert_allclose(read["/turn/craft"]["quaternion"], ATTITUDE, atol=1e-7)
    np.testing.assert_allclose(read["/turn/craft"]["translation"], np.outer(T, [1, 2, 3]), rtol=1e-7)
    np.testing.assert_allclose(read["/turn/craft"]["time"], T, atol=1e-9)
    np.testing.assert_allclose(read["/turn/axis"]["vectors"], np.outer(T, [0, 0, 1]), rtol=1e-7)
    np.testing.assert_allclose(read["/turn/bound"]["quaternions"], ATTITUDE, atol=1e-7)
    np.testing.assert_allclose(read["/turn/trace"]["strips"][0], np.outer(T, [1, 0, 0]), rtol=1e-7)
    assert read["/events"]["time"].tolist() == [0.5, 1.5]
    assert read["/events"]["text"].tolist() == ["first impulse", "second impulse"]


def test_the_body_is_a_closed_box_of_the_given_size(target):
    write_turn(target)
    body = recording.read_back(target)["/turn/craft"]
    corners = body["vertex_positions"][0][body["triangle_indices"][0]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    np.testing.assert_allclose(normals.sum(axis=0), 0, atol=1e-6)
    volume = np.einsum("ij,ij->", corners[:, 0], normals) / 3
    assert volume == pytest.approx(2.0 * 1.2 * 0.6, rel=1e-6)
    np.testing.assert_allclose(np.ptp(body["vertex_positions"][0], axis=0), [2.0, 1.2, 0.6], rtol=1e-6)


def test_rerun_verifies_the_file_and_no_damaged_one(target):
    write_turn(target)
    program = Path(util.find_spec("rerun_cli").submodule_search_locations[0]) / "rerun"
    assert subprocess.run([program, "rrd", "verify", target], capture_output=True).returncode == 0
    damaged = target.with_name("damaged.rrd")
    content = bytearray(target.read_bytes())
    # Parts lie in another order in each run: the middle half is never the inside of one array.
    quarter = len(content) // 4
    content[quarter:-quarter] = bytes(len(content) - 2 * quarter)
    damaged.write_bytes(content)
    assert subprocess.run([program, "rrd", "verify", damaged], capture_output=True).returncode != 0


def test_the_layout_travels_in_the_file(target):
    write_turn(target)
    names = [f"ViewBlueprint:{part}" for part in ("class_identifier", "display_name", "space_origin")]
    views = {
        tuple(batch[name].to_pylist()[0][0] for name in names)
        for batch in layout_batches(target)
        if set(names) <= set(batch.schema.names)
    }
    assert views == {
        ("3D", "the turn", "turn"),
        ("TimeSeries", "angle", "angle"),
        ("TextLog", "events", "events"),
    }


def test_a_plot_s_span_and_a_scene_s_eye_travel_too(target):
    eye = ((1.0, 2.0, 3.0), (0.0, 0.5, 0.0))
    with record(target, "turn", [[Scene("the turn", "turn", eye)], [Plot("angle", "angle", span=(-1, 2.5))]]):
        pass
    batches = layout_batches(target)
    found = {name: b[name].to_pylist()[0] for b in batches for name in b.schema.names if ":" in name}
    assert found["ScalarAxis:range"] == [[-1.0, 2.5]]
    assert found["ScalarAxis:zoom_lock"] == [True]
    assert found["EyeControls3D:position"] == [list(eye[0])]
    assert found["EyeControls3D:look_target"] == [list(eye[1])]


def test_a_writer_that_raises_leaves_no_file(target):
    with pytest.raises(ValueError, match="t: got"), record(target, "turn", LAYOUT) as turn:
        turn.curve("angle/energy", [1.0, 0.0], [0.0, 0.0], "u", "red")
    assert list(target.parent.iterdir()) == []


@pytest.mark.parametrize(
    ("write", "argument"),
    [
        (lambda r: r.curve("a", [0.0, 1.0], [0.0], "u", "red"), "values"),
        (lambda r: r.curve("a", [0.0, np.nan], [0.0, 1.0], "u", "red"), "t"),
        (lambda r: r.curve("a", [0.0, 1.0], [0.0, np.inf], "u", "red"), "values"),
        (lambda r: r.body("a", T, ATTITUDE[:, :3], (1, 1, 1)), "attitude"),
        (lambda r: r.body("a", T, ATTITUDE, (1, 1)), "size"),
        (lambda r: r.arrow("a", T, ATTITUDE, "red"), "vector"),
        (lambda r: r.path("a", np.zeros((4, 2)), "red"), "points"),
    ],
)
def test_arrays_of_another_shape_are_refused_by_name(target, write, argument):
    with pytest.raises(ValueError, match=f"^{argument}: got"), record(target, "turn", LAYOUT) as turn:
        write(turn)


def test_without_rerun_the_message_says_what_to_install(target, monkeypatch):
    monkeypatch.setitem(sys.modules, "rerun", None)
    with pytest.raises(RuntimeError, match="rerun-sdk"), record(target, "turn", LAYOUT):
        pass
    assert not target.exists()


def test_a_layout_is_active_since_the_viewer_meets_the_recording_first(tmp_path):
    with record(tmp_path / "a.rrd", "a", [[Plot("x", "x")]]) as recording:
        recording.curve("x/y", [0.0, 1.0], [0.0, 1.0], "y", "#0072B2")
    program = Path(sys.executable).with_name("rerun")
    told = subprocess.run(
        [program, "rrd", "print", tmp_path / "a.rrd"], capture_output=True, text=True
    ).stdout
    assert "make_active: true" in told
