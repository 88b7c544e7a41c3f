"""The kept results of the direct method belong to the present cases."""

import csv
from dataclasses import replace

import numpy as np
import pytest

from pontryagin.io.files import figures_folder
from pontryagin.rendezvous.case_solutions import solved
from pontryagin.rendezvous.figures.tables import excess, nearest
from pontryagin.rendezvous.judge import table as judge
from pontryagin.rendezvous.problem.cases import (
    FuelCase,
    case,
    cases,
    fuel_cases,
)

KEPT = judge.direct_results()


ENERGY = {name: KEPT[name] for name in cases()}


FUEL = {name: KEPT[name] for name in fuel_cases()}


QUICK = ("circle-energy", "ellipse-mixed", "mixed")


SIGN_CHANGES = {"ellipse"}
"""Cases in which the error of the direct cost changes sign between the meshes."""


def allowed(mesh: int) -> float:
    """Relative error allowed for a direct cost, of the order 2.5 in the length of an interval."""
    return 5e-6 * (40 / mesh) ** 2.5


def published() -> dict[str, float]:
    """The costs in the report's table of solutions."""
    with (figures_folder() / "41-rendezvous-cases" / "solutions.csv").open() as file:
        return {row["case"]: float(row["$J$"]) for row in csv.DictReader(file)}


def test_there_is_a_row_with_the_checksum_of_every_case():
    known = judge.all_cases()
    assert list(KEPT) == list(known) == [*ENERGY, *FUEL]
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


@pytest.mark.checkout
def test_the_costs_on_the_fine_mesh_agree_with_those_of_the_report():
    indirect, fine = published(), judge.MESHES[1]
    assert list(indirect) == list(ENERGY)
    errors = {name: one.costs[1] / indirect[name] - 1 for name, one in ENERGY.items()}
    assert max(abs(value) for value in errors.values()) < allowed(fine)


@pytest.mark.checkout
def test_the_error_on_the_coarse_mesh_is_larger_where_both_meshes_find_the_same_extremal():
    indirect = published()
    both = {name: [abs(cost / indirect[name] - 1) for cost in one.costs] for name, one in ENERGY.items()}
    same = {name: errors for name, errors in both.items() if errors[0] < allowed(judge.MESHES[0])}
    assert len(same) >= len(ENERGY) - 1
    assert all(coarse > 4 * fine for name, (coarse, fine) in same.items() if name not in SIGN_CHANGES)


@pytest.mark.checkout
def test_the_largest_error_of_the_direct_costs_of_least_fuel_shrinks_with_the_mesh():
    """In a single case the error depends on where the switches fall in their intervals."""
    with (figures_folder() / "43-rendezvous-elements" / "fuel.csv").open() as file:
        indirect = [float(row["$J_2$"]) for row in csv.DictReader(file)]
    errors = np.array([one.costs for one in FUEL.values()]) / np.array(indirect)[:, None] - 1
    coarse, fine = np.abs(errors).max(axis=0)
    assert coarse < 5e-4 and fine < 1.2e-4 and coarse > 3 * fine
    assert errors.min() > -1e-4


@pytest.mark.parametrize("name", QUICK)
def test_a_direct_cost_is_that_of_an_extremal_and_not_below_the_best_by_more_than_its_error(name):
    best = solved(name)
    for mesh, cost, duration in zip(judge.MESHES, KEPT[name].costs, KEPT[name].durations, strict=True):
        assert abs(excess(best, cost)) < allowed(mesh)
        assert cost > best.cost * (1 - allowed(mesh))
        assert nearest(best, cost).duration == pytest.approx(duration, rel=1e-3)


def test_direct_results_are_read_as_they_were_written(tmp_path, monkeypatch):
    monkeypatch.setattr(judge, "FILE", tmp_path / "judge.csv")
    judge.write(KEPT)
    assert judge.direct_results() == KEPT


@pytest.mark.slow
@pytest.mark.extra(name="bench")
def test_the_direct_method_reproduces_a_kept_result():
    again = judge.solve_directly(case("circle-energy"))
    assert np.allclose(again.costs, KEPT["circle-energy"].costs, rtol=1e-9)
