"""The fourth paper's benchmark: the forms define one problem, peers solve it, false meetings are detected."""

from dataclasses import replace

import numpy as np
import pytest
from benchmarks.rendezvous import (
    aims,
    figures,
    forms,
    integrators,
    problems,
    pykep_peer,
    solves,
    stacks,
    starts,
    systems,
)
from benchmarks.rendezvous.collocation import collocate, cost
from benchmarks.rendezvous.systems import EIGHT, PROBLEMS, REDUCED
from benchmarks.taylor import has_heyoka
from matplotlib.container import BarContainer

from pontryagin.rendezvous import solve
from pontryagin.rendezvous.problem.cases import cases

LABELS = [problem.name for problem in PROBLEMS]


@pytest.fixture(scope="module")
def extremal():
    return solve(problems.leap(20))


@pytest.mark.slow
@pytest.mark.parametrize("problem", PROBLEMS, ids=LABELS)
def test_the_residual_of_every_form_vanishes_at_the_extremal_and_its_jacobian_is_exact(problem, extremal):
    scaled, duration, h = extremal.problem.scaled, extremal.flight.duration, 1e-6
    at = problem.start(extremal.flight.costates)
    if problem.name == EIGHT:  # (16) contains Phi*, and the gauge nu0 is arbitrary
        size = np.linalg.norm(problem.residual(scaled, at, duration)[0])
        at, _ = starts.newton(problem, scaled, extremal.flight.costates, duration)
        assert size > 1e-3
    residual, jacobian = problem.residual(scaled, at, duration)
    assert np.abs(residual).max() < 1e-9
    shifted = at + 0.01
    _, jacobian = problem.residual(scaled, shifted, duration)
    there, back = (
        [problem.residual(scaled, shifted + x * unit, duration)[0] for unit in np.eye(len(at))]
        for x in (h, -h)
    )
    slopes = (np.array(there) - np.array(back)).T / (2 * h)
    np.testing.assert_allclose(jacobian, slopes, rtol=1e-5, atol=1e-5)


def test_the_gauge_and_the_missing_condition_give_null_directions(extremal):
    zeros = {}
    for problem in PROBLEMS:
        values = starts.singular_values(problem, extremal)
        zeros[problem.name] = int(np.sum(values < starts.ZERO * values[0]))
    assert zeros == {name: int(name in (EIGHT, REDUCED)) for name in LABELS}


def test_16_14_and_11_equations_define_one_map(extremal):
    scaled, six = extremal.problem.scaled, problems.deviations(1, 0.05)[0]
    sizes = [np.linalg.norm(p.residual(scaled, six, 3.0)[0]) for p in PROBLEMS[1:4]]
    np.testing.assert_allclose(sizes, sizes[0], rtol=1e-10)


@pytest.mark.slow
def test_the_meetings_of_the_ten_equations_are_false(extremal):
    found = starts.ends(extremal, problems.deviations(2, 0.03))
    assert found[REDUCED].true == 0 and found[REDUCED].false > 0
    for name in LABELS[1:4]:
        assert found[name].true == found[LABELS[1]].true > 0 and found[name].false == 0
        assert found[name].flights == pytest.approx(found[LABELS[1]].flights, rel=0.1)
    assert starts.is_meeting(extremal, extremal.flight.costates)
    assert not starts.is_meeting(extremal, extremal.flight.costates + 1e-5)


@pytest.mark.slow
def test_fewer_equations_take_fewer_operations():
    for derivatives in (False, True):
        counts = [forms.operations(size, "unsaturated", derivatives) for size in systems.SYSTEMS]
        assert counts == sorted(counts, reverse=True) and len(set(counts)) == 4


@pytest.mark.slow
@pytest.mark.skipif(not has_heyoka(), reason="heyoka, a peer, is not installed: make bench")
def test_the_integrators_give_the_same_derivatives():
    table = integrators.table(quick=True)
    assert table["ours against heyoka"][0] < 1e-11 and table["SciPy against heyoka"][0] < 1e-9
    assert table["SciPy, times ours"][0] > 1


@pytest.mark.slow
def test_without_heyoka_its_columns_are_empty_and_the_others_are_filled(extremal, monkeypatch):
    monkeypatch.setattr(problems, "solved", lambda name: extremal)
    monkeypatch.setattr(integrators, "has_heyoka", lambda: False)
    table = integrators.table(quick=True)
    assert {heading for heading, column in table.items() if "heyoka" in heading and column == [None]} == {
        "heyoka, ms",
        "heyoka, times ours",
        "ours against heyoka",
        "SciPy against heyoka",
    }
    assert table["ours, ms"][0] > 0 and table["SciPy, times ours"][0] > 1


def test_solve_bvp_finds_our_costs(extremal):
    later = replace(extremal.problem, duration=6.1)
    ours = solve(later, extremal)
    assert cost(later, collocate(later, extremal, 1e-6)) == pytest.approx(ours.cost, rel=1e-7)
    given_up = collocate(later, extremal, 1e-6)
    given_up.status = 1
    assert np.isnan(cost(later, given_up))


@pytest.fixture(scope="module")
def fastest():
    return solve(cases()["inclined-10"].problem)


def test_the_certified_least_time_is_one_that_the_peers_reproduce(fastest):
    assert fastest.certificate.holds(1e-9) and fastest.modes == ("saturated",)
    nearby = problems.neighbour("inclined-10")
    ours = solve(nearby, fastest)
    assert cost(nearby, collocate(nearby, fastest, 1e-6)) == pytest.approx(ours.cost, rel=1e-7)
    if line := pykep_peer.absent():
        assert "build/pykep" in line and "\n" not in line
    else:
        found = pykep_peer.solve(nearby, fastest, 1)
        assert found["duration"] == pytest.approx(ours.flight.duration, rel=1e-11)


@pytest.mark.slow
def test_warm_solves_have_a_row_for_every_method(extremal, monkeypatch):
    monkeypatch.setattr(problems, "solved", lambda name: extremal)
    monkeypatch.setattr(problems, "neighbour", lambda name: replace(extremal.problem, duration=6.1))
    monkeypatch.setattr(solves, "MESHES", (20,))
    monkeypatch.setattr(solves, "TOLERANCES", (1e-6,))
    table = solves.table(quick=True)
    assert table["method"][0] == solves.OURS and table["times ours"][0] == 1
    assert len(table["method"]) == (2 if solves.absent("casadi") else 3)
    assert max(table["error"]) < 1e-3
    axes = figures.solve_times(table, aims.WARM_AIM).axes
    assert sum(line.get_linestyle() == "None" for line in axes[0].get_lines()) == len(table["method"])


@pytest.mark.slow
def test_flights_in_one_call_end_where_single_ones_do(extremal, monkeypatch):
    monkeypatch.setattr(problems, "solved_leap", lambda degrees: extremal)
    table = stacks.flights(quick=True)
    assert table["flights"] == list(stacks.ARCS)
    assert max(table["largest difference"]) < 1e-12
    assert table["switches a flight"][2] > 0
    bars = [c for c in figures.stacks(table).axes[0].containers if isinstance(c, BarContainer)]
    assert [bar.get_width() for bar in bars[0]] == pytest.approx(
        [1e6 / value for value in table["one by one, microseconds"]]
    )


def test_shares_of_starts_fill_the_bars():
    table = {
        "inclination": ["0 deg"] * 2,
        "form": ["11, with chi", "10, with (15)"],
        "meetings": [1.0, 0.0],
        "false meetings": [0.0, 0.7],
        "no convergence": [0.0, 0.3],
    }
    (axis,) = figures.starts(table).axes
    assert sum(bar.get_width() for bar in axis.patches) == pytest.approx(200)
    assert sorted(text.get_text() for text in axis.texts) == ["100", "30", "70"]
