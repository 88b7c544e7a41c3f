import signal
import subprocess
import sys
import time

import nbformat
import pytest

from pontryagin.io import files
from pontryagin.report import assemble
from pontryagin.report.execute import (
    CellFailure,
    UncountedImport,
    attempt,
    execute,
    notebook_key,
    publish,
    read_notebook,
)

COUNT = "open('../../runs', 'a').write('x')"
SLOW_AT_FIRST = "import time; time.sleep(60 if len(open('../../runs').read()) < 2 else 0)"
DRAW = """
from pontryagin.display.plotting import show, show_table, styled, subplots
@styled
def line():
    figure, axes = subplots(height=2)
    axes.plot([0, 1], [0, hash("a string") % 7])
    return figure
show(line())
"""
HIDE = "exec('import pontryagin.' + 'hidden')"
TABLE = "import numpy as np; show_table({'x': np.random.default_rng(3).normal(size=4)}, 'sample')"


def runs(checkout):
    path = checkout.root.parent / "runs"
    return len(path.read_text()) if path.is_file() else 0


def key(checkout, path):
    return notebook_key(checkout.workspace, read_notebook(path))


@pytest.mark.slow
def test_a_failing_cell_is_named_with_its_notebook_and_error(checkout):
    good = checkout.notebook("01-good", "# Good", "1 + 1")
    bad = checkout.notebook("02-bad", "# Bad", "x = 3", "x / 0")
    results = [attempt(checkout.workspace, path) for path in (good, bad)]
    assert results[0].name == "01-good"
    assert isinstance(results[1], CellFailure)
    assert "notebooks/02-bad.ipynb, cell 3 of 3: ZeroDivisionError: division by zero" in str(results[1])
    assert "    x / 0" in str(results[1])
    assert not list((checkout.workspace.cache / "notebooks" / "02-bad").glob("[!.]*"))


@pytest.mark.slow
def test_code_runs_again_when_it_changes_and_not_when_the_text_around_it_does(checkout):
    path = checkout.notebook("01-count", "# Title", COUNT, "6 * 7")
    assert execute(checkout.workspace, path).fresh
    checkout.notebook("01-count", "# Another title", "# more text", COUNT, "6 * 7")
    again = execute(checkout.workspace, path)
    assert not again.fresh and runs(checkout) == 1
    assert again.notebook.cells[0].source == "# Another title"
    assert again.notebook.cells[3].outputs[0].data["text/plain"] == "42"
    checkout.notebook("01-count", "# Title", COUNT, "6 * 8")
    assert execute(checkout.workspace, path).notebook.cells[2].outputs[0].data["text/plain"] == "48"
    assert runs(checkout) == 2


def test_the_key_changes_with_what_the_notebook_depends_on_and_with_nothing_else(checkout):
    used = "from pontryagin import deeper"
    checkout.modules({"__init__.py": "", "used.py": used, "deeper.py": "x = 1", "unused.py": "x = 1"})
    (checkout.root / "notebooks" / "ends.csv").write_text("1")
    path = checkout.notebook("01", "# Title", "from pontryagin import used", "open('ends.csv')")
    keys = [key(checkout, path)]
    checkout.module("unused.py", "x = 2")
    assert key(checkout, path) == keys[0]
    for change in (
        lambda: checkout.module("deeper.py", "x = 2"),
        lambda: (checkout.root / "notebooks" / "ends.csv").write_text("2"),
        lambda: (checkout.root / "requirements.lock").write_text("numpy==3\n"),
    ):
        change()
        keys.append(key(checkout, path))
    assert len(set(keys)) == len(keys)


@pytest.mark.slow
def test_a_notebook_that_loads_what_its_key_does_not_count_is_refused(checkout):
    checkout.modules({"__init__.py": "", "hidden.py": "x = 1", "seen.py": ""})
    path = checkout.notebook(
        "01-hides", "# Hides", "from pontryagin import seen", "exec('import pontryagin.' + 'hidden')"
    )
    with pytest.raises(UncountedImport, match=r"notebooks/01-hides\.ipynb loads pontryagin\.hidden, but"):
        execute(checkout.workspace, path)
    assert not list((checkout.workspace.cache / "notebooks" / "01-hides").glob("[!.]*"))
    checkout.notebook(
        "01-hides", "# Hides", "from pontryagin import hidden", "exec('import pontryagin.' + 'hidden')"
    )
    assert len(execute(checkout.workspace, path).notebook.cells) == 3


@pytest.mark.slow
def test_two_executions_give_the_same_bytes(checkout, another_checkout):
    made = []
    for place in (checkout, another_checkout):
        path = place.notebook("01-figures", "# Figures", DRAW, TABLE, "{'b', 'a', 'c'}, id(1) > 0")
        result = execute(place.workspace, path)
        publish(place.workspace, [result])
        drawn = {p.relative_to(place.root): p.read_bytes() for p in place.workspace.figures.rglob("*.*")}
        made.append((nbformat.writes(result.notebook), drawn))
    assert made[0] == made[1]
    assert {path.name for path in made[0][1]} == {"line.svg", "sample.csv"}


@pytest.mark.slow
def test_a_killed_execution_leaves_nothing_and_the_next_completes(checkout):
    checkout.notebook("01-slow", "# Slow", COUNT, SLOW_AT_FIRST)
    command = [sys.executable, "-m", "pontryagin.report", "figures", "--root", str(checkout.root)]
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    deadline = time.monotonic() + 120
    while runs(checkout) == 0 and time.monotonic() < deadline:
        time.sleep(0.1)
    child.send_signal(signal.SIGKILL)
    child.wait()
    entries = checkout.workspace.cache / "notebooks" / "01-slow"
    assert not list(entries.glob("[!.]*"))
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
    assert len(list(entries.iterdir())) == len(list(entries.glob("[!.]*"))) == 1
    assert runs(checkout) == 2


@pytest.mark.slow
def test_publishing_removes_what_the_notebook_no_longer_draws(checkout):
    path = checkout.notebook("01-figures", "# Figures", DRAW)
    stale = checkout.workspace.figures / "01-figures" / "old.svg"
    other = checkout.workspace.figures / "benchmarks" / "speed.svg"
    files.write(stale, "<svg/>")
    files.write(other, "<svg/>")
    result = execute(checkout.workspace, path)
    assert publish(checkout.workspace, [result]) == 2
    assert publish(checkout.workspace, [result]) == 0
    assert not stale.exists() and other.exists()
    assert (stale.parent / "line.svg").read_text().startswith("<?xml")
    assert [item.file for item in assemble.items([result])] == ["figures/01-figures/line.svg"]


@pytest.mark.slow
def test_what_a_cell_writes_to_stderr_is_told_and_not_shown(checkout):
    path = checkout.notebook(
        "01-warns", "# Warns", "import sys; print('out'); print('careful', file=sys.stderr)"
    )
    result = execute(checkout.workspace, path)
    assert assemble.warnings(result) == ["notebooks/01-warns.ipynb, cell 2 wrote to stderr: careful"]
    shown = assemble.chapter(checkout.workspace, result)
    assert "out" in shown and "careful" not in shown.split("```")[-2]


@pytest.mark.slow
@pytest.mark.parametrize("cell", ["object()", "print(object())"])
def test_a_printed_address_fails_the_build_at_its_cell(checkout, cell):
    result = execute(checkout.workspace, checkout.notebook("01", "# Title", cell))
    with pytest.raises(assemble.Unprintable, match=r"notebooks/01\.ipynb, cell 2: prints a memory address"):
        assemble.chapter(checkout.workspace, result)
