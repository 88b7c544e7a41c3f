"""Slow tests that passed are left out while nothing that they depend on has changed: a plugin for pytest.

``-p tests.house.kept`` notes in ``build/kept-tests`` on which contents of its files each slow test passed; a
test that fails loses its notes. With ``--kept``, tests that passed on today's contents are left out.
"""

import os
import platform
import sys
import time
from pathlib import Path

import pytest
from tests.house import dependence

from pontryagin.report import dependencies, syntax

STATES = 10
"""How many contents are remembered for each test: those of a few branches."""


def pytest_addoption(parser):
    parser.addoption(
        "--kept",
        action="store_true",
        help="leave out slow tests while nothing that they depend on has changed",
    )


def pytest_configure(config):
    config.pluginmanager.register(Kept(config), "kept-tests")


class Kept:
    """What passed before, as pairs of a test's name and a key of all that it depends on.

    With pytest-xdist, the controller reads and writes the notes, and each worker is handed what was read: all
    of them then choose the same tests.
    """

    def __init__(self, config):
        self.root = config.rootpath
        self.notes = self.root / "build" / "kept-tests"
        self.leaves_out = config.getoption("kept")
        self.is_worker = hasattr(config, "workerinput")
        self.passed = set(config.workerinput["kept"] if self.is_worker else self._read())
        self.project = dependence.Project(self.root / "src" / "pontryagin")
        self.start = time.time()
        self.files = {}
        self.keys = {}
        self.failed = set()
        self.count = 0

    def _read(self):
        return [f"{note.name} {key}" for note in self.notes.glob("*") for key in note.read_text().split()]

    @pytest.hookimpl(optionalhook=True)
    def pytest_configure_node(self, node):
        node.workerinput["kept"] = sorted(self.passed)

    @pytest.hookimpl(trylast=True)
    def pytest_collection_modifyitems(self, config, items):
        slow = [item for item in items if item.get_closest_marker("slow")]
        self.files = {test: sorted(self.project.files(test)) for test in {item.path for item in slow}}
        keys = {test: self._key(test) for test in self.files}
        self.keys = {item.nodeid: keys[item.path] for item in slow}
        if self.leaves_out:
            kept = {item for item in slow if f"{_name(item.nodeid)} {keys[item.path]}" in self.passed}
            items[:] = [item for item in items if item not in kept]
            config.hook.pytest_deselected(items=kept)
            self.count = len(kept)

    def _key(self, test):
        settings = sorted([self.root / "pyproject.toml", *self.root.glob("requirements*.lock")])
        parts = (dependence, dependencies, syntax)
        machinery = (Path(__file__), *(Path(part.__file__) for part in parts))
        environment = (sys.version, platform.machine(), os.environ.get("HYPOTHESIS_PROFILE", ""))
        return dependencies.digest(*self.files[test], *settings, *machinery, *environment, root=self.root)

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_makereport(self, item, call):
        report = yield
        if item.nodeid in self.keys and not self._changed_since(item.path):
            report.kept_key = self.keys[item.nodeid]
        return report

    def _changed_since(self, test):
        """Whether a file changed after its content was read: the test may have run on either."""
        return any(not path.is_file() or path.stat().st_ctime > self.start for path in self.files[test])

    def pytest_runtest_logreport(self, report):
        if self.is_worker:
            return
        note = self.notes / _name(report.nodeid)
        if not report.passed or hasattr(report, "wasxfail"):
            self.failed.add(report.nodeid)
            note.unlink(missing_ok=True)
        elif report.when == "teardown" and report.nodeid not in self.failed and hasattr(report, "kept_key"):
            before = note.read_text().split() if note.is_file() else []
            keys = [*(key for key in before if key != report.kept_key), report.kept_key]
            self.notes.mkdir(parents=True, exist_ok=True)
            note.write_text("\n".join(keys[-STATES:]))

    def pytest_sessionfinish(self, session):
        if self.is_worker:
            session.config.workeroutput["kept"] = self.count

    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodedown(self, node):
        self.count = max(self.count, getattr(node, "workeroutput", {}).get("kept", 0))

    def pytest_terminal_summary(self, terminalreporter):
        if self.count:
            tests = "slow test" if self.count == 1 else "slow tests"
            terminalreporter.write_line(f"{self.count} {tests} kept: nothing that they depend on has changed")


def _name(nodeid):
    return dependencies.digest(nodeid)
