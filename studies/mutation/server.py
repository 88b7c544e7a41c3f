"""A process that has loaded what all tests load, and runs tests in forks of itself.

It reads requests from standard input, one a line in JSON, and answers each in a line. A fork imports the
package anew, so that it meets the source as it is then. Its processor time and its memory are bounded.
"""

import json
import os
import resource
import signal
import sys
from collections import defaultdict
from collections.abc import Iterator
from contextlib import suppress
from importlib import import_module
from time import process_time
from typing import Any

import coverage
import pytest

LOADED = (
    "hypothesis.extra.numpy",
    "hypothesis.strategies",
    "matplotlib.figure",
    "mpmath",
    "numpy.testing",
    "scipy.integrate",
    "scipy.interpolate",
    "scipy.optimize",
    "scipy.special",
    "sympy",
    "typer.testing",
)
MEMORY = 8 << 30
"""Bytes that a fork may ask for; more is a `MemoryError` in its tests."""
WALL = 10
"""A fork that sleeps ends after so many times its processor time."""
SLOW = 10
"""Seconds after which a test is left out: its kernels need their native code."""
ALL = "*"
"""Stands for every test of a file: what a fixture of the file does is done for all of them."""


def main() -> None:
    """Answer requests until standard input ends."""
    for name in LOADED:
        import_module(name)
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    for line in sys.stdin:
        print(json.dumps(_answer(json.loads(line))), file=answers, flush=True)


def _answer(request: dict[str, Any]) -> dict[str, Any]:
    reading, writing = os.pipe()
    child = os.fork()
    if not child:
        os.close(reading)
        _serve(request, writing)
    os.close(writing)
    with os.fdopen(reading) as said:
        text = said.read()
    _, status = os.waitpid(child, 0)
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(child, signal.SIGKILL)
    if text:
        return dict(json.loads(text))
    ended = os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0
    return {"outcome": "timed out" if ended in {signal.SIGXCPU, signal.SIGALRM} else "crashed"}


def _serve(request: dict[str, Any], writing: int) -> None:
    """Run the tests of a request, write the answer, and end the fork."""
    status = 1
    try:
        os.setsid()
        seconds = int(request["seconds"]) + 1
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))
        signal.alarm(WALL * seconds)
        os.set_inheritable(writing, False)
        silent = os.open(os.devnull, os.O_WRONLY)
        os.dup2(silent, 1)
        os.dup2(silent, 2)
        answer = _traced(request) if request.get("trace") else _tried(request)
        with os.fdopen(writing, "w") as said:
            json.dump(answer, said)
        status = 0
    finally:
        os._exit(status)


def _run(tests: list[str], *options: str, plugin: object) -> int:
    """Pytest on the quick tests, with kernels in plain Python as far as they are not compiled yet."""
    from pontryagin.numerics import jit

    jit.has_numba = lambda: False
    marks = "not slow and not checkout"
    return int(pytest.main(["-p", "no:cacheprovider", "-m", marks, *options, *tests], plugins=[plugin]))


class _First:
    """The first test that fails, and how many passed before."""

    def __init__(self) -> None:
        self.failed, self.passed = "", 0

    def pytest_collectreport(self, report: Any) -> None:
        if report.failed and not self.failed:
            self.failed = report.nodeid

    def pytest_runtest_logreport(self, report: Any) -> None:
        if report.failed and not self.failed:
            self.failed = report.nodeid
        self.passed += report.when == "call" and report.passed


def _tried(request: dict[str, Any]) -> dict[str, Any]:
    """Whether one of the tests fails."""
    first, start = _First(), process_time()
    try:
        status = _run(request["tests"], "-x", plugin=first)
    except Exception as reason:  # the package cannot be imported
        return {
            "outcome": "failed",
            "by": f"import: {type(reason).__name__}",
            "seconds": process_time() - start,
        }
    outcome = "passed" if status == 0 else "failed"
    return {"outcome": outcome, "by": first.failed, "passed": first.passed, "seconds": process_time() - start}


class _Tracer:
    """Which lines each test reaches, and how long it takes."""

    def __init__(self, measured: coverage.Coverage) -> None:
        self.measured, self.test = measured, ""
        self.seconds: dict[str, float] = defaultdict(float)
        self.failed: set[str] = set()

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: Any) -> Iterator[None]:
        self.test = item.nodeid
        self.measured.switch_context(self.test)
        start = process_time()
        result = yield
        self.seconds[self.test] += process_time() - start
        return result

    @pytest.hookimpl(wrapper=True)
    def pytest_fixture_setup(self, fixturedef: Any, request: Any) -> Iterator[None]:
        shared = fixturedef.scope != "function"
        if shared:
            self.measured.switch_context(ALL)
        result = yield
        if shared:
            self.measured.switch_context(self.test)
        return result

    def pytest_runtest_logreport(self, report: Any) -> None:
        if not report.passed:
            self.failed.add(report.nodeid)


def _traced(request: dict[str, Any]) -> dict[str, Any]:
    """Seconds and lines of the tests that pass: {test: [seconds, {file: lines}]}.

    A test that reaches a file also reaches what ran when the file was imported.
    """
    os.environ |= request["environment"]
    measured = coverage.Coverage(data_file=None, include=request["trace"], config_file=False)
    tracer = _Tracer(measured)
    measured.start()
    _run(request["tests"], f"--timeout={SLOW}", "--timeout-method=signal", plugin=tracer)
    measured.stop()
    data = measured.get_data()
    lines: dict[str, dict[str, list[int]]] = defaultdict(lambda: defaultdict(list))
    for file in data.measured_files():
        for line, contexts in data.contexts_by_lineno(file).items():
            for context in contexts:
                lines[context][file].append(line)
    shared, imported = lines.pop(ALL, {}), lines.pop("", {})
    found = {}
    for test, seconds in tracer.seconds.items():
        if test not in tracer.failed:
            files = {*lines[test], *shared}
            own = {
                file: {*lines[test].get(file, ()), *shared.get(file, ()), *imported.get(file, ())}
                for file in files
            }
            found[test] = [round(seconds, 3), {file: sorted(numbers) for file, numbers in own.items()}]
    return {"outcome": "traced", "tests": found}


if __name__ == "__main__":
    main()
