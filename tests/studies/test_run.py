"""A study goes on where it stopped, and its table depends on the finished chunks alone, to the byte."""

import json
import random
import signal
import subprocess
import sys
import time
from dataclasses import replace

import pytest
from studies.part import Part, Study
from studies.records import AtWork, Records
from studies.run import run

from pontryagin.io import files
from studies import table

CHUNKS = 12


def study(work=lambda: None):
    """Two parts that draw random numbers; `work` is done in each chunk."""

    def draw(rng, number):
        work()
        return {"sum": float(rng.standard_normal(50).sum())}

    parts = [Part(name, [f"studies.{name}"], CHUNKS, draw) for name in ("left", "right")]
    return Study("toy", "Toy", "Sums.", 3, parts, row, cases)


def row(part, found):
    return {"chunks": len(found), "worst": max(one["sum"] for one in found)}


def cases(part, found):
    return [{"sum": one["sum"].hex()} for one in found if one["sum"] > 0]


@pytest.fixture
def root(tmp_path):
    """A checkout with a module for each part."""
    for name in ("left", "right"):
        files.write(tmp_path / "studies" / f"{name}.py", "from pontryagin import steps\n")
    files.write(tmp_path / "studies" / "__init__.py", "")
    for name in ("__init__", "steps", "others"):
        files.write(tmp_path / "src" / "pontryagin" / f"{name}.py", "")
    return tmp_path


def written(records):
    """The bytes of the table and of the cases."""
    folder = records.root / "table"
    table.write(records, [folder])
    return (folder / table.FOUND).read_bytes(), (folder / table.CASES).read_bytes()


def all_at_once(root):
    records = Records(study(), root)
    run(study(), records, 60.0)
    return written(records)


class Stopped(Exception):
    """Stands for the end of the process."""


def test_a_run_that_is_stopped_anywhere_goes_on_and_gives_the_same_bytes(root, tmp_path_factory):
    whole = all_at_once(root)
    again = tmp_path_factory.mktemp("again")
    for path in root.glob("s*/**/*.py"):
        files.write(again / path.relative_to(root), path.read_bytes())
    luck = random.Random(4)
    chances = iter(lambda: luck.random() < 0.3, None)

    def stops():
        if next(chances):
            raise Stopped

    done, stops_seen = 0, 0
    while done < 2 * CHUNKS:
        records = Records(study(stops), again)
        try:
            run(records.study, records, 60.0)
        except Stopped:
            stops_seen += 1
        before, done = done, sum(len(records.done(part)) for part in records.study.parts)
        assert done >= before
    assert stops_seen > 3
    assert written(records) == whole


SCRIPT = """
import sys, time
from pathlib import Path
from test_run import Records, run, study
ours = study(lambda: time.sleep(0.03))
records = Records(ours, Path(sys.argv[1]))
print("ready", flush=True)
with records.alone():
    run(ours, records, 60.0)
"""


@pytest.mark.slow
def test_a_run_that_is_killed_loses_one_chunk_at_most(root):
    luck = random.Random(5)
    records = Records(study(), root)
    folder = str(files.repository() / "tests" / "studies")
    for _ in range(3):
        process = subprocess.Popen(
            [sys.executable, "-c", f"import sys; sys.path.append({folder!r})\n{SCRIPT}", str(root)],
            stdout=subprocess.PIPE,
        )
        process.stdout.readline()
        time.sleep(luck.uniform(0.03, 0.2))
        process.send_signal(signal.SIGKILL)
        process.communicate()
    done = {part.name: records.done(part) for part in records.study.parts}
    assert all(numbers == set(range(len(numbers))) for numbers in done.values()), "chunks are done in order"
    assert 0 < sum(map(len, done.values())) < 2 * CHUNKS, "it was killed in the middle"
    run(records.study, records, 60.0)
    again = written(records)
    for path in records.folder.rglob("*.json"):
        path.unlink()
    assert all_at_once(root) == again


def test_a_damaged_record_is_done_again(root):
    whole = all_at_once(root)
    records = Records(study(), root)
    broken = records.place(records.study.parts[0]) / "000003.json"
    broken.write_text(broken.read_text()[:10])
    run(records.study, records, 60.0)
    assert written(records) == whole
    assert json.loads(broken.read_text())["chunk"] == 3


def test_what_does_not_hold_any_more_is_done_again(root):
    whole, times = all_at_once(root), []
    plain = study(lambda: times.append(1))
    doubted = [replace(part, holds=lambda found: found["sum"] > 0) for part in plain.parts]
    records = Records(replace(plain, parts=doubted), root)
    left = sum(len(records.read(part)) for part in doubted)
    assert 0 < left < 2 * CHUNKS
    run(records.study, records, 60.0)
    assert len(times) == 2 * CHUNKS - left
    assert written(Records(study(), root)) == whole


class Clock:
    """A clock that work moves on."""

    def __init__(self):
        self.now = 0.0

    def __call__(self):
        return self.now

    def work(self, seconds):
        def done(rng, number):
            self.now += seconds
            return {"sum": 0.0}

        return done


def test_time_is_shared_and_a_chunk_that_does_not_fit_is_not_begun(root, monkeypatch):
    clock = Clock()
    monkeypatch.setattr("studies.run.monotonic", clock)
    quick = Part("left", ["studies.left"], 1000, clock.work(1.0))
    slow = Part("right", ["studies.right"], 1000, clock.work(20.0), share=2.0)
    ours = Study("toy", "Toy", "", 1, [quick, slow], row, cases)
    records = Records(ours, root)
    run(ours, records, 150.0)
    assert (len(records.done(quick)), len(records.done(slow))) == (50, 5)
    run(ours, records, 19.0)
    assert (len(records.done(quick)), len(records.done(slow))) == (69, 5)
    run(ours, records, 60.0)
    assert (len(records.done(quick)), len(records.done(slow))) == (89, 7), "the slow one was behind"


def test_a_second_run_of_the_same_study_is_refused(root):
    records = Records(study(), root)
    with (
        records.alone(),
        pytest.raises(AtWork, match="another process runs the study 'toy'"),
        records.alone(),
    ):
        pass


def test_a_part_starts_anew_when_a_source_of_it_changes_and_only_then(root):
    all_at_once(root)
    first = Records(study(), root)
    left, right = first.study.parts
    files.write(root / "src" / "pontryagin" / "others.py", "# not imported\n")
    assert Records(study(), root).keys == first.keys
    files.write(root / "studies" / "left.py", "from pontryagin import steps, others\n")
    changed = Records(study(), root)
    assert not changed.done(left) and len(changed.done(right)) == CHUNKS
    files.write(root / "src" / "pontryagin" / "steps.py", "# another method\n")
    assert not Records(study(), root).done(right)
    files.write(root / "src" / "pontryagin" / "steps.py", "")
    assert len(Records(study(), root).done(right)) == CHUNKS
