"""The build: notebooks, figures, recordings, report; each step does only what its inputs call for."""

import argparse
import os
import threading
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path

from pontryagin.io import files
from pontryagin.report import assemble, front, player, progress, publish, recordings, result_keys
from pontryagin.report.execute import CellFailure, Executed, execute_all
from pontryagin.report.execute import publish as publish_figures
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
    except KeyboardInterrupt:
        progress.failure("stopped; the same command goes on from here")
        return 130
    progress.step("done", f"in {watch}")
    return 0


def build(workspace: Workspace, stage: str, workers: int) -> None:
    """Take the steps up to `stage`, `workers` notebooks or recordings at a time."""
    result_keys.hand_down(workspace)
    if stage != "recordings":
        executed = _notebooks(workspace, workers)
        changed = publish_figures(workspace, executed)
        progress.step("figures", f"figures/: {'as they were' if not changed else f'{changed} files changed'}")
    if stage in ("recordings", "report"):
        clips = _recordings(workspace, workers)
    if stage == "report":
        entries = front.ledger_entries(workspace)
        progress.step("ledger", f"{len(entries)} entries")
        publish.write_report(workspace, executed, clips, entries)


def _notebooks(workspace: Workspace, workers: int) -> list[Executed]:
    watch, lock, tasks = progress.Stopwatch(), threading.Lock(), {}
    with progress.bars() as bars:

        def advance(name: str, done: int, total: int) -> None:
            with lock:
                if name not in tasks:
                    progress.step("notebook", f"{name}: executing {total} cells")
                    tasks[name] = bars.add_task(name, total=total)
                bars.update(tasks[name], completed=done)

        results = execute_all(workspace, workspace.notebooks, workers, advance)
    executed = [result for result in results if isinstance(result, Executed)]
    for result in executed:
        how = f"executed in {result.seconds} s" if result.fresh else "nothing changed since it was executed"
        progress.step("notebook", f"{result.name}: {how}")
        for warning in assemble.warnings(result):
            progress.note(warning)
    failures = [result for result in results if isinstance(result, CellFailure)]
    for failure in failures:
        progress.failure(str(failure))
    if failures:
        raise Stopped
    progress.step("notebooks", f"{len(executed)} in {watch}")
    return executed


def _recordings(workspace: Workspace, workers: int) -> list[recordings.Clip]:
    if find_spec("rerun") is None:
        progress.note("rerun-sdk is not installed here: no recordings and no players")
        return []

    def done(clip: recordings.Clip, fresh: bool) -> None:
        how = "written" if fresh else "nothing changed since it was written"
        progress.step("recording", f"{clip.name}: {how}")

    clips = recordings.record_all(workspace, workers, done)
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
