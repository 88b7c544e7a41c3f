"""Jobs run the longest first, and how long they took is known to the next build."""

import threading
import time

import pytest

from pontryagin.report import schedule
from pontryagin.report.schedule import run_all


def logged(log, jobs):
    """Jobs that note their names when they begin."""
    return {name: lambda name=name: log.append(name) or name.upper() for name in jobs}


def test_the_longest_job_begins_first_and_results_are_in_the_given_order(checkout, monkeypatch):
    monkeypatch.setattr(schedule, "SECONDS", {"short": 1.0, "long": 100.0})
    log = []
    found = run_all(checkout.workspace, logged(log, ["short", "unknown", "long"]), 1)
    assert log == ["long", "unknown", "short"]
    assert list(found.items()) == [("short", "SHORT"), ("unknown", "UNKNOWN"), ("long", "LONG")]


def test_what_others_wait_for_is_begun_first_and_they_are_begun_last(checkout, monkeypatch):
    monkeypatch.setattr(schedule, "SECONDS", {"long": 100.0})
    log = []
    jobs = logged(log, ["short", "long", "dear", "middle"])
    run_all(checkout.workspace, jobs, 1, first=["dear", "none of them"], last=["long"])
    assert log == ["dear", "short", "middle", "long"]


def test_a_measured_duration_takes_the_place_of_the_stated_one(checkout, monkeypatch):
    monkeypatch.setattr(schedule, "SECONDS", {"a": 2.0, "b": 1.0})
    monkeypatch.setattr(schedule, "IDLE", 0.05)
    run_all(checkout.workspace, {"a": lambda: time.sleep(0.1), "b": lambda: time.sleep(0.3)}, 1)
    log = []
    run_all(checkout.workspace, logged(log, "ab"), 1)
    assert log == ["b", "a"]
    run_all(checkout.workspace, logged(log, "ab"), 1)
    assert log == ["b", "a"] * 2, "a job that finds nothing to do leaves the record as it is"


def test_several_jobs_run_at_a_time(checkout):
    together = threading.Barrier(2, timeout=10)
    assert run_all(checkout.workspace, dict.fromkeys("ab", together.wait), 2).keys() == {"a", "b"}


def test_after_an_error_no_job_begins(checkout, monkeypatch):
    monkeypatch.setattr(schedule, "SECONDS", {"bad": 100.0, "late": 1.0})
    log = []

    def bad():
        time.sleep(0.05)
        raise ValueError("bad")

    jobs = {"late": lambda: log.append(1), "meanwhile": lambda: time.sleep(0.2), "bad": bad}
    with pytest.raises(ValueError, match="bad"):
        run_all(checkout.workspace, jobs, 2)
    assert log == []
