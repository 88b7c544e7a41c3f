"""Jobs of a build, several at a time, the longest first; how long each took is kept for the next build."""

import json
import threading
import time
from collections.abc import Callable, Collection, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from typing import TypeVar, cast

from pontryagin.io import files
from pontryagin.report.workspace import Workspace

SECONDS = {
    "41-rendezvous-cases": 80.0,
    "32-averaging-beyond": 65.0,
    "43-rendezvous-elements": 60.0,
    "00-overview": 45.0,
    "21-orbit-correction-beyond": 30.0,
    "pontryagin.rendezvous.playback": 25.0,
    "42-rendezvous-false-meetings": 22.0,
    "31-averaging-examples": 20.0,
    "10-triple-integrator": 20.0,
    "40-rendezvous": 15.0,
}
"""How long jobs took once: what a first build sorts them by."""
UNKNOWN = 15.0
"""Seconds that a job is expected to take when nothing is known about it."""

T = TypeVar("T")


def run_all(
    workspace: Workspace,
    jobs: Mapping[str, Callable[[], T]],
    workers: int,
    first: Collection[str] = (),
    last: Collection[str] = (),
) -> dict[str, T]:
    """Run jobs, `workers` at a time, in the order of the time that they are expected to take.

    Parameters
    ----------
    workspace : Workspace
        Where durations are kept.
    jobs : mapping of str to callable
        Each job by its name.
    workers : int
        How many run at a time.
    first, last : collection of str
        Jobs that are begun before all others, and those that wait for what these make.

    Returns
    -------
    dict
        What each job returned, in the order of `jobs`. When one raises, those that run are finished, no other
        is begun, and the error of the first of them in this order is raised.
    """
    expected = SECONDS | _durations(workspace)
    order = sorted(jobs, key=lambda name: (name not in first, name in last, -expected.get(name, UNKNOWN)))
    taken: dict[str, float] = {}
    failed = threading.Event()

    def timed(name: str) -> T | None:
        if failed.is_set():
            return None
        started = time.perf_counter()
        try:
            result = jobs[name]()
        except BaseException:
            failed.set()
            raise
        taken[name] = time.perf_counter() - started
        return result

    pool = ThreadPoolExecutor(max_workers=workers)
    try:
        running = {name: pool.submit(timed, name) for name in order}
        found = {name: running[name].result() for name in jobs}
    finally:
        pool.shutdown(cancel_futures=True)
        _keep(workspace, taken)
    return cast(dict[str, T], found)


IDLE = 1.0
"""A job that takes less found nothing to do: that is no measure of the time that it needs."""


def _durations(workspace: Workspace) -> dict[str, float]:
    with suppress(OSError, ValueError):
        kept: dict[str, float] = json.loads((workspace.cache / "durations.json").read_text(encoding="utf-8"))
        return kept
    return {}


def _keep(workspace: Workspace, taken: Mapping[str, float]) -> None:
    measured = {name: round(seconds, 1) for name, seconds in taken.items() if seconds > IDLE}
    known = _durations(workspace) | measured
    files.write(workspace.cache / "durations.json", json.dumps(dict(sorted(known.items())), indent=1))
