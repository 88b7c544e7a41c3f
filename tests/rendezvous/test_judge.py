"""The judge's file belongs to the cases of today, and its costs to our extremals."""

import csv
from dataclasses import replace

import numpy as np
import pytest

from pontryagin.files import figures_folder
from pontryagin.rendezvous import judge
from pontryagin.rendezvous.cases import case, cases
from pontryagin.rendezvous.figures.solved import solved
from pontryagin.rendezvous.figures.tables import excess, nearest

KEPT = judge.verdicts()
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
    assert list(KEPT) == list(cases())
    assert {name: one.checksum for name, one in KEPT.items()} == {
        name: judge.checksum(one.problem) for name, one in cases().items()
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
    sums = {judge.checksum(one) for one in [problem, *changed]}
    assert len(sums) == len(changed) + 1


def test_the_fine_mesh_agrees_with_the_report_s_costs_to_its_error():
    ours, fine = published(), judge.MESHES[1]
    assert list(ours) == list(KEPT)
    apart = {name: one.costs[1] / ours[name] - 1 for name, one in KEPT.items()}
    assert max(abs(value) for value in apart.values()) < allowed(fine)


def test_the_coarse_error_is_larger_where_it_is_the_same_extremal():
    ours = published()
    apart = {name: [abs(cost / ours[name] - 1) for cost in one.costs] for name, one in KEPT.items()}
    same = {name: errors for name, errors in apart.items() if errors[0] < allowed(judge.MESHES[0])}
    assert len(same) >= len(KEPT) - 1
    assert all(coarse > 4 * fine for name, (coarse, fine) in same.items() if name not in UNEVEN)


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
