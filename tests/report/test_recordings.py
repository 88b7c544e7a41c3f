import re
from base64 import b64decode
from html import unescape

import pytest

from pontryagin.papers import PAPERS
from pontryagin.report import player, recordings
from pontryagin.report.recordings import Clip

PLAYBACK = '''
import os
from pathlib import Path
from pontryagin.names import CURVE

def wave(path):
    """A wave & more.

    It goes up <and> down,
    for ever.

    What it proves is another matter.
    """
    print("said")
    if CURVE == "broken":
        Path(path).write_text("half")
        raise ArithmeticError("no wave today")
    Path(path).write_text(CURVE)

def plain_one(path):
    Path(path).write_text(os.environ["PYTHONHASHSEED"])

def recordings():
    return {"wave": wave, "plain-one": plain_one}
'''


@pytest.fixture
def paper(checkout):
    package = PAPERS[0].package
    checkout.package()
    checkout.modules(
        {f"{package}/__init__.py": "", f"{package}/playback.py": PLAYBACK, "names.py": "CURVE = 'sine'"}
    )
    return checkout


def record(checkout):
    of_papers = [recordings.record(checkout.workspace, m) for m in recordings.modules(checkout.workspace)]
    told = [pair for of_paper in of_papers for pair in of_paper]
    return [clip for clip, _ in told], {clip.name: fresh for clip, fresh in told}


def test_recordings_are_titled_by_their_writers_and_written_once(paper):
    clips, told = record(paper)
    assert clips == [
        Clip(PAPERS[0].package, "wave", "A wave & more", "It goes up <and> down, for ever."),
        Clip(PAPERS[0].package, "plain-one", "Plain one", ""),
    ]
    assert told == {"wave": True, "plain-one": True}
    assert (paper.workspace.recordings / "wave.rrd").read_text() == "sine"
    assert (paper.workspace.recordings / "plain-one.rrd").read_text() == "0"
    paper.module("unused.py", "x = 1")
    assert record(paper)[1] == {"wave": False, "plain-one": False}
    paper.module("names.py", "CURVE = 'cosine'")
    assert record(paper)[1]["wave"]
    assert (paper.workspace.recordings / "wave.rrd").read_text() == "cosine"


def test_a_writer_that_raises_is_named_and_the_old_recording_stays(paper):
    record(paper)
    paper.module("names.py", "CURVE = 'broken'")
    with pytest.raises(recordings.RecordingFailure, match=r"recording wave .*ArithmeticError: no wave today"):
        record(paper)
    assert (paper.workspace.recordings / "wave.rrd").read_text() == "sine"
    assert len(list(paper.workspace.recordings.iterdir())) == 2


def test_a_paper_without_playback_has_no_recordings(checkout):
    checkout.module(f"{PAPERS[0].package}/__init__.py")
    assert record(checkout) == ([], {})


def test_only_what_is_missing_is_written_again(paper):
    clips, _ = record(paper)
    (paper.workspace.recordings / "wave.rrd").unlink()
    assert record(paper) == (clips, {"wave": True, "plain-one": False})
    assert (paper.workspace.recordings / "wave.rrd").read_text() == "sine"


def test_a_player_page_holds_its_recording_and_may_load_only_the_viewer():
    clip = Clip("p", "wave", "A wave & more", "It goes up <and> down.")
    page = player.player_page(clip, b"\x00rrd@FILE@")
    assert b64decode(re.search(r'octet-stream">([^<]*)<', page)[1]) == b"\x00rrd@FILE@"
    assert re.findall(r'\b(?:src|href)="([^"]*)"', page) == ["../index.html#recordings", "viewer.js"]
    policy = dict(
        part.strip().split(" ", 1)
        for part in unescape(re.search(r'Content-Security-Policy" content="([^"]*)"', page)[1]).split(";")
    )
    assert policy["default-src"] == "'none'" and policy["connect-src"] == "data: blob:"
    assert "://" not in page and "<and>" not in page and "A wave &amp; more" in page


def test_players_of_recordings_that_are_gone_are_removed(checkout, monkeypatch):
    monkeypatch.setattr(player, "viewer_script", lambda workspace: b"viewer")
    clips = [Clip("p", name, name, "") for name in ("one", "two")]
    checkout.workspace.recordings.mkdir(parents=True)
    for clip in clips:
        (checkout.workspace.recordings / f"{clip.name}.rrd").write_bytes(b"rrd")
    assert len(player.write_players(checkout.workspace, clips)) == 2
    player.write_players(checkout.workspace, clips[:1])
    folder = checkout.workspace.report / "play"
    assert sorted(path.name for path in folder.iterdir()) == ["one.html", "viewer.js"]


def test_without_rerun_the_players_say_so(checkout, monkeypatch):
    def absent(package):
        raise player.metadata.PackageNotFoundError(package)

    monkeypatch.setattr(player.metadata, "version", absent)
    with pytest.raises(player.NoViewer, match="rerun-sdk is not installed"):
        player.viewer_script(checkout.workspace)
