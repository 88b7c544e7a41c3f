"""The soak finds what is wrong with a solver, and a line of Python that it keeps shows it again."""

import json
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest
from studies.part import generator
from studies.soak import averaged, cartesian, corrections, meetings, systems, triple
from studies.soak.exactly import disagreement
from studies.soak.outcome import Outcome, attempt
from studies.soak.study import STUDY, cases, row

from pontryagin.averaging import solve_averaged
from pontryagin.certificate import Certificate
from pontryagin.rendezvous import solve
from pontryagin.triple_integrator import minimum_energy, minimum_impulse, minimum_norm, minimum_peak

WRONG = 1e-6
SCALED = {"energy": "coefficients", "peak": None, "impulse": "impulses"}
SOLVERS = {"energy": minimum_energy, "peak": minimum_peak, "impulse": minimum_impulse}


class Forged:
    """A solution with some attributes replaced; the others are its own."""

    def __init__(self, solution, **replaced):
        self.__dict__.update(replaced, _solution=solution)

    def __getattr__(self, name):
        return getattr(self._solution, name)


def forged(solution, name, wrong, *scaled):
    """A solution whose value is wrong by a share, with a certificate that holds for the wrong value."""
    value = getattr(solution, name) * (1 + wrong)
    others = {other: getattr(solution, other) * (1 + wrong) for other in scaled}
    none = np.zeros(np.shape(value))
    return Forged(solution, certificate=Certificate(none, value, value), **{name: value}, **others)


def certified_by_itself(found):
    return all(case["what"].startswith("the oracle disagrees") for case in found["kept"])


@pytest.mark.parametrize("scaled", [False, True], ids=["norm", "norm and control"])
@pytest.mark.parametrize("name", SOLVERS)
def test_a_norm_that_is_wrong_by_a_millionth_is_found_by_the_oracle(name, scaled):
    others = [SCALED[name]] if scaled and SCALED[name] else []

    def chunk(wrong):
        solver = lambda m: forged(SOLVERS[name](m), "norm", wrong, *others)  # noqa: E731
        rng = np.random.default_rng(2)
        return triple.stacks(solver, partial(disagreement, name), "minimum({})", triple.STRATA, 60, rng, 0)

    assert chunk(0.0)["failures"] == 0
    found = chunk(WRONG)
    assert found["compared"] == 6 and found["failures"] == 6 and certified_by_itself(found)
    assert found["worst"]["disagreement"]["value"] == pytest.approx(WRONG, rel=1e-3)


def test_a_wrong_norm_q_least_time_and_entropy_are_found(monkeypatch):
    monkeypatch.setattr(triple, "CHUNK", 60)

    def wrong_norm(m, q):
        return forged(minimum_norm(m, q), "norm", WRONG)

    monkeypatch.setattr(triple, "minimum_norm", wrong_norm)
    found = triple.norms(np.random.default_rng(2), 5)
    assert found["failures"] == found["compared"] == 6 and certified_by_itself(found)
    honest = triple.minimum_time
    monkeypatch.setattr(triple, "minimum_time", lambda *a, **k: forged(honest(*a, **k), "duration", WRONG))
    found = triple.times(np.random.default_rng(2), 0)
    assert found["failures"] == found["compared"] == 5 and certified_by_itself(found)


def test_a_wrong_gauge_is_found_by_the_cone_programme(monkeypatch):
    pytest.importorskip("clarabel")
    monkeypatch.setattr(corrections, "CHUNK", 8)
    honest = corrections.correct
    assert corrections.chunk("disc", np.random.default_rng(1), 1)["failures"] == 0
    monkeypatch.setattr(corrections, "correct", lambda *a, **k: forged(honest(*a, **k), "gauge", -WRONG))
    found = corrections.chunk("disc", np.random.default_rng(1), 1)
    assert found["compared"] == found["failures"] == 1
    assert found["kept"][0]["what"].startswith("Clarabel disagrees by 1.0e-06")


def test_without_the_peer_nothing_is_compared_and_the_table_says_so(monkeypatch):
    monkeypatch.setattr(corrections, "installed", lambda name: None)
    monkeypatch.setattr(corrections, "CHUNK", 8)
    found = corrections.chunk("disc", np.random.default_rng(1), 1)
    assert found["compared"] == 0 and found["failures"] == 0
    assert row(STUDY.parts[0], [found])["peers not installed"] == "clarabel"


@pytest.mark.slow
def test_a_wrong_averaged_extremal_and_a_wrong_meeting_are_found(monkeypatch):
    problem = systems.drawn(np.random.default_rng([5, 1]))
    solution = solve_averaged(problem.system(), problem.start)
    assert averaged.disagreement(problem, solution) < 1e-9
    for wrong in (
        {"cost": solution.cost * (1 + 1e-5)},
        {"duration": solution.duration * (1 - 1e-5)},
        {"costate": lambda tau: solution.costate(tau) * (1 + 1e-5)},
    ):
        assert averaged.disagreement(problem, Forged(solution, **wrong)) > averaged.ALLOWED
    for free in (False, True):
        given = meetings.drawn(np.random.default_rng([7, 23]), 23, free)
        best = solve(meetings.problem_of(given))
        assert cartesian.disagreement(best) < 1e-9
        if free:
            monkeypatch.setattr(cartesian, "SAMPLES", (40, *cartesian.SAMPLES))
            assert cartesian.disagreement_at(best, 40) > meetings.ALLOWED > cartesian.disagreement(best)
        turned = Forged(best, control=lambda t, best=best: best.control(t) * [1, 1 + 1e-4, 1])
        assert cartesian.disagreement(turned) > meetings.ALLOWED


def test_the_members_that_raise_are_singled_out_and_kept_exactly():
    def solver(numbers):
        if {3, 17} & set(numbers):
            raise FloatingPointError("no")
        return list(numbers)

    outcome = Outcome(lambda given: f"solve({given['x']})")
    inputs = [{"x": 0.1 * i} for i in range(20)]
    solved = attempt(outcome, solver, inputs)
    assert sorted(i for numbers, _ in solved for i in numbers) == [i for i in range(20) if i not in (3, 17)]
    found = outcome.found()
    assert found["failures"] == found["unsolved"] == 2
    assert [float.fromhex(case["input"]["x"]) for case in found["kept"]] == [0.1 * 3, 0.1 * 17]
    assert found["kept"][0]["what"] == "FloatingPointError: no"


def test_a_member_that_differs_from_its_stack_is_found():
    calls = []

    def solver(m):
        solution = minimum_energy(m)
        calls.append(m.shape)
        return solution if m.shape else forged(solution, "norm", 1e-9, "coefficients")

    rng = np.random.default_rng(2)
    found = triple.stacks(solver, lambda *_: 0.0, "minimum_energy({})", triple.STRATA, 60, rng, 0)
    assert found["failures"] == 6 and "alone it differs from its stack" in found["kept"][0]["what"]


def run(line):
    """The names that a line of Python leaves behind."""
    names = {"print": lambda *_: None}
    exec(line, names)
    return SimpleNamespace(**{k: v for k, v in names.items() if k.isidentifier()})


def test_a_line_of_python_solves_the_same_problem_to_the_last_bit():
    rows, _ = triple.drawn(np.random.default_rng(3), triple.STRATA, 12)
    for one in rows:
        again = run(triple.line("minimum_peak({})", triple.given(one)))
        assert again.s.norm == minimum_peak(triple.maneuver(one)).norm
    for one in triple.drawn(np.random.default_rng(3), triple.TRANSFERS, 10)[0]:
        assert run(triple.time_line(triple.ends(one))).s.duration == triple.transfer(one).duration
    states, interval, peak = corrections.drawn(np.random.default_rng(3), 1)
    given = {"z0": states[0], "interval": interval, "peak": peak, "thrust": "box"}
    assert run(corrections.line(given)).p.gauge == corrections.correct(**given).gauge


@pytest.mark.slow
def test_a_line_of_python_solves_the_same_system_and_the_same_meeting():
    for seed in range(6):
        problem = systems.drawn(np.random.default_rng([5, seed]))
        again = run(systems.line(problem.__dict__)).s
        assert again.cost == solve_averaged(problem.system(), problem.start).cost
    for free in (False, True):
        given = meetings.drawn(np.random.default_rng([7, 23]), 23, free)
        assert run(meetings.line(given)).b.cost == solve(meetings.problem_of(given)).cost


@pytest.mark.parametrize("place", [0, 3])
def test_a_chunk_has_the_same_record_whenever_it_is_done(place, monkeypatch):
    monkeypatch.setattr(triple, "CHUNK", 60)
    part = [*triple.parts(), *averaged.parts()][place]
    first, again, other = (json.dumps(part.run(generator(STUDY, part, n), n)) for n in (1, 1, 2))
    assert first == again != other


def test_the_row_adds_up_and_the_worst_cases_are_kept():
    part = STUDY.parts[0]
    one, other = Outcome(str), Outcome(str)
    one.problems, other.problems = 10, 20
    one.measured("gap", 1e-9, {"x": 1.0})
    other.measured("gap", 3e-9, {"x": 2.0})
    other.failed("wrong", {"x": 3.0})
    found = [one.found(), other.found()]
    cells = row(part, found)
    assert cells["problems"] == 30 and cells["failures"] == 1 and cells["worst gap"] == "3e-09"
    kept = cases(part, found)
    assert [case["what"] for case in kept] == ["wrong", "worst gap"]
    assert kept[1]["input"] == {"x": (2.0).hex()}
