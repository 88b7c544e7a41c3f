"""The build: notebooks, figures, recordings, report; each step does only what its inputs call for."""

import argparse
import os
import threading
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from rich.progress import Progress as Bars
from rich.progress import TaskID

from pontryagin.io import files
from pontryagin.report import (
    ahead,
    assemble,
    front,
    player,
    progress,
    publish,
    recordings,
    result_keys,
    snapshot,
)
from pontryagin.report.execute import CellFailure, Executed, Progress, attempt
from pontryagin.report.execute import publish as publish_figures
from pontryagin.report.schedule import run_all
from pontryagin.report.workspace import Workspace, alone

STAGES = ("notebooks", "figures", "recordings", "report")


class Stopped(RuntimeError):
    """A step failed and has said why."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Build up to a stage.

    Parameters
    ----------
    arguments : sequence of str, optional
        Command line; by default that of the process.

    Returns
    -------
    int
        Exit status: 0 done, 1 a step failed and said why, 2 bad command line, 130 stopped by the user.
    """
    chosen = _parser().parse_args(arguments)
    workspace = Workspace(chosen.root.resolve() if chosen.root else files.repository())
    watch = progress.Stopwatch()
    try:
        with alone(workspace):
            for folder in (workspace.build, workspace.figures):
                files.remove_drafts(folder)
            build(workspace, chosen.stage, chosen.workers)
    except Stopped:
        return 1
    except (RuntimeError, ValueError) as reason:
        progress.failure(str(reason))
        return 1
    except OSError as reason:
        place = f"{reason.filename}: " if reason.filename else ""
        progress.failure(f"{place}{reason.strerror or reason}; the same command goes on from here")
        return 1
    except KeyboardInterrupt:
        progress.failure("stopped; the same command goes on from here")
        return 130
    progress.step("done", f"in {watch}")
    return 0


def build(workspace: Workspace, stage: str, workers: int) -> None:
    """Take the steps up to `stage`, `workers` notebooks or papers' recordings at a time."""
    if snapshot.is_current(workspace, stage):
        progress.step(stage, "nothing changed since the last build")
        return
    snapshot.forget(workspace)
    named = snapshot.named_by_notebooks(workspace)
    read = snapshot.inputs(workspace, named)
    _make(workspace, stage, workers)
    snapshot.remember(workspace, stage, read, named)


def _make(workspace: Workspace, stage: str, workers: int) -> None:
    keys = result_keys.hand_down(workspace)
    watch = progress.Stopwatch()
    dear = ahead.modules(workspace, keys) if stage != "recordings" else []
    with progress.bars() as bars:
        jobs = _jobs(workspace, stage, _Bars(bars))
        jobs |= {module: partial(ahead.compute, workspace, module, keys[module]) for module in dear}
        made = run_all(workspace, jobs, workers, first=dear, last=ahead.users(workspace, dear))
    executed = _executed(made)
    if stage != "recordings":
        progress.step("notebooks", f"{len(executed)} in {watch}")
        changed = publish_figures(workspace, executed)
        progress.step("figures", f"figures/: {'as they were' if not changed else f'{changed} files changed'}")
    recorded = [made[name] for name in recordings.modules(workspace) if name in made]
    clips = _played(workspace, [pair for of_paper in recorded for pair in of_paper])
    if stage == "report":
        entries = made["ledger"]
        progress.step("ledger", f"{len(entries)} entries")
        publish.write_report(workspace, executed, clips, entries)


def _jobs(workspace: Workspace, stage: str, advance: Progress) -> dict[str, Callable[[], Any]]:
    """What there is to do before anything is put together."""
    jobs: dict[str, Callable[[], Any]] = {}
    if stage != "recordings":
        jobs |= {path.stem: partial(attempt, workspace, path, advance) for path in workspace.notebooks}
    if stage in ("recordings", "report") and _has_rerun():
        jobs |= {name: partial(recordings.record, workspace, name) for name in recordings.modules(workspace)}
        jobs["viewer"] = partial(_viewer, workspace)
    if stage == "report":
        jobs["ledger"] = partial(front.ledger_entries, workspace)
    return jobs


class _Bars:
    """A bar for each notebook that is executed."""

    def __init__(self, bars: Bars) -> None:
        self._bars, self._lock = bars, threading.Lock()
        self._tasks: dict[str, TaskID] = {}

    def __call__(self, name: str, done: int, total: int) -> None:
        with self._lock:
            if name not in self._tasks:
                progress.step("notebook", f"{name}: executing {total} cells")
                self._tasks[name] = self._bars.add_task(name, total=total)
            self._bars.update(self._tasks[name], completed=done)


def _executed(made: Mapping[str, Any]) -> list[Executed]:
    executed = [result for result in made.values() if isinstance(result, Executed)]
    for result in executed:
        how = f"executed in {result.seconds} s" if result.fresh else "nothing changed since it was executed"
        progress.step("notebook", f"{result.name}: {how}")
        for warning in assemble.warnings(result):
            progress.note(warning)
    failures = [result for result in made.values() if isinstance(result, CellFailure)]
    for failure in failures:
        progress.failure(str(failure))
    if failures:
        raise Stopped
    return executed


def _has_rerun() -> bool:
    if find_spec("rerun") is None:
        progress.note("rerun-sdk is not installed here: no recordings and no players")
        return False
    return True


def _viewer(workspace: Workspace) -> None:
    """Make the viewer that the players share; why there is none is told where they are written."""
    with suppress(player.NoViewer):
        player.viewer_script(workspace)


def _played(workspace: Workspace, recorded: Sequence[tuple[recordings.Clip, bool]]) -> list[recordings.Clip]:
    for clip, fresh in recorded:
        how = "written" if fresh else "nothing changed since it was written"
        progress.step("recording", f"{clip.name}: {how}")
    clips = [clip for clip, _ in recorded]
    if not clips:
        return []
    try:
        pages = player.write_players(workspace, clips)
    except player.NoViewer as reason:
        progress.note(f"{reason}: no players; the recordings open with `rerun build/recordings/NAME.rrd`")
        return []
    progress.step("players", f"{len(pages)} pages in build/report/play/")
    return clips


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m pontryagin.report",
        description="Execute the notebooks, write figures and recordings, and render the report "
        "into build/report/: index.html, pontryagin.pdf and play/. Only what changed is made again.",
    )
    parser.add_argument(
        "stage", nargs="?", choices=STAGES, default="report", help="how far to go (default: report)"
    )
    parser.add_argument(
        "--workers",
        type=int,
        default=min(2, os.cpu_count() or 1),
        metavar="N",
        help="notebooks and recordings made at a time (default: %(default)s)",
    )
    parser.add_argument("--root", type=Path, metavar="DIR", help="checkout to build (default: this one)")
    return parser
