"""What is kept in files belongs to the cases of today: direct costs, and what small weights of time do."""

import csv
from dataclasses import replace

import numpy as np
import pytest

from pontryagin.io.files import figures_folder
from pontryagin.rendezvous import (
    small_weight,
    solve,
)
from pontryagin.rendezvous.figures.solved import solved
from pontryagin.rendezvous.figures.tables import excess, nearest
from pontryagin.rendezvous.judge import table as judge
from pontryagin.rendezvous.problem.cases import (
    FuelCase,
    case,
    cases,
    fuel_cases,
)

KEPT = judge.verdicts()
SQUARE = {name: KEPT[name] for name in cases()}
FUEL = {name: KEPT[name] for name in fuel_cases()}
QUICK = ("circle-energy", "ellipse-mixed", "mixed")
UNEVEN = {"ellipse"}
"""The error of its direct cost has changed sign between the meshes."""


def allowed(mesh: int) -> float:
    """Relative error of a direct cost: of an order between two and three in the length of an interval."""
    return 5e-6 * (40 / mesh) ** 2.5


def published() -> dict[str, float]:
    """Our costs in the report's table."""
    with (figures_folder() / "41-rendezvous-cases" / "solutions.csv").open() as file:
        return {row["case"]: float(row["$J$"]) for row in csv.DictReader(file)}


def test_there_is_a_row_for_every_case_and_it_is_of_that_problem():
    known = judge.judged_cases()
    assert list(KEPT) == list(known) == [*SQUARE, *FUEL]
    assert {name: one.checksum for name, one in KEPT.items()} == {
        name: judge.checksum(one.problem, isinstance(one, FuelCase)) for name, one in known.items()
    }


@pytest.mark.parametrize("name", ["mixed-bounded", "circle-energy"])
def test_the_checksum_changes_with_every_number(name):
    problem = case(name).problem
    changed = [
        replace(problem, chaser=replace(problem.chaser, r=1.001)),
        replace(problem, chaser=replace(problem.chaser, v1=0.001)),
        replace(problem, target=replace(problem.target, anomaly=0.601)),
        replace(problem, target=replace(problem.target, attitude=[0.6, 0, 0, 0.8])),
        replace(problem, energy_weight=1.001),
        replace(problem, peak=0.0801),
        replace(problem, gravity=1.001),
        replace(problem, duration=9.5),
    ]
    sums = {judge.checksum(one) for one in [problem, *changed]} | {judge.checksum(problem, fuel=True)}
    assert len(sums) == len(changed) + 2


def test_the_fine_mesh_agrees_with_the_report_s_costs_to_its_error():
    ours, fine = published(), judge.MESHES[1]
    assert list(ours) == list(SQUARE)
    apart = {name: one.costs[1] / ours[name] - 1 for name, one in SQUARE.items()}
    assert max(abs(value) for value in apart.values()) < allowed(fine)


def test_the_coarse_error_is_larger_where_it_is_the_same_extremal():
    ours = published()
    apart = {name: [abs(cost / ours[name] - 1) for cost in one.costs] for name, one in SQUARE.items()}
    same = {name: errors for name, errors in apart.items() if errors[0] < allowed(judge.MESHES[0])}
    assert len(same) >= len(SQUARE) - 1
    assert all(coarse > 4 * fine for name, (coarse, fine) in same.items() if name not in UNEVEN)


def test_direct_costs_of_least_fuel_come_nearer_with_the_mesh_and_are_not_lower_by_more_than_that():
    """Case by case the error depends on where the switches fall in their intervals; the largest shrinks."""
    with (figures_folder() / "43-rendezvous-elements" / "fuel.csv").open() as file:
        ours = [float(row["$J_2$"]) for row in csv.DictReader(file)]
    apart = np.array([one.costs for one in FUEL.values()]) / np.array(ours)[:, None] - 1
    coarse, fine = np.abs(apart).max(axis=0)
    assert coarse < 5e-4 and fine < 1.2e-4 and coarse > 3 * fine
    assert apart.min() > -1e-4


@pytest.mark.parametrize("name", QUICK)
def test_a_direct_cost_is_that_of_an_extremal_and_not_lower_by_more_than_its_error(name):
    best = solved(name)
    for mesh, cost, duration in zip(judge.MESHES, KEPT[name].costs, KEPT[name].durations, strict=True):
        assert abs(excess(best, cost)) < allowed(mesh)
        assert cost > best.cost * (1 - allowed(mesh))
        assert nearest(best, cost).duration == pytest.approx(duration, rel=1e-3)


def test_the_file_is_read_as_it_was_written(tmp_path, monkeypatch):
    monkeypatch.setattr(judge, "FILE", tmp_path / "judge.csv")
    judge.write(KEPT)
    assert judge.verdicts() == KEPT


def test_the_judge_judges_anew():
    """One case, where CasADi is installed."""
    pytest.importorskip("casadi")
    again = judge.judged(case("circle-energy"))
    assert np.allclose(again.costs, KEPT["circle-energy"].costs, rtol=1e-9)


@pytest.mark.parametrize("weight", [1e-1, 1e-2, 1e-3])
def test_the_rows_of_small_weights_are_what_is_found(weight):
    kept = next(one for one in small_weight.rows() if one.time_weight == weight)
    again = small_weight.row(solve(small_weight.problem(weight)))
    assert (again.duration, again.cost) == pytest.approx((kept.duration, kept.cost), rel=1e-9)
    assert again.condition == pytest.approx(kept.condition, rel=1e-2)


def test_the_condition_number_grows_as_the_weight_of_time_falls_and_the_residual_with_it():
    rows = small_weight.rows()[2:]
    condition, residual = (
        np.array([getattr(one, name) for one in rows]) for name in ("condition", "residual")
    )
    assert np.all(condition[1:] > 5 * condition[:-1]) and np.all(residual[1:] > residual[:-1])
    assert np.all(residual < 1e-14 * condition)


def test_the_file_of_small_weights_is_read_as_it_was_written(tmp_path, monkeypatch):
    kept = small_weight.rows()
    monkeypatch.setattr(small_weight, "FILE", tmp_path / "small_weight.csv")
    small_weight.write(kept)
    assert small_weight.rows() == kept
