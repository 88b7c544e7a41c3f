"""Contestants in processes of their own: what dies loses its own times, and what raises raises here."""

import math
import os
import signal

import pytest
from benchmarks.apart import Apart, Died, answer
from benchmarks.clock import one_call, take_turns

from benchmarks import apart


def killed():
    """A call of which no result comes back."""
    os.kill(os.getpid(), signal.SIGKILL)


def test_a_contestant_that_dies_loses_its_own_times_alone(capsys):
    timings = take_turns({"lives": one_call(lambda: sum(range(1000)), 2), "dies": killed}, 3)
    assert timings["lives"].least > 0 and timings["lives"].count == 2
    assert math.isnan(timings["dies"].typical) and math.isnan(timings["dies"].least)
    assert capsys.readouterr().out == "dies died (exit status -9): its times are empty\n"


def test_an_answer_of_a_peer_that_dies_is_the_other_one(capsys):
    assert answer("a peer", lambda: 7, None) == 7 and capsys.readouterr().out == ""
    assert answer("a peer", killed, "none") == "none"
    assert capsys.readouterr().out == "a peer died (exit status -9): its rows are empty\n"


def test_what_a_call_raises_is_raised_and_the_process_goes_on():
    calls = iter([1, 0, 2])
    with Apart(lambda: 6 / next(calls)) as process:
        assert process() == 6
        with pytest.raises(ZeroDivisionError):
            process()
        assert process() == 3


def test_a_process_that_does_not_answer_counts_as_dead(monkeypatch):
    monkeypatch.setattr(apart, "PATIENCE", 0.2)
    with Apart(lambda: os.read(os.pipe()[0], 1)) as process, pytest.raises(Died, match="did not answer"):
        process()
