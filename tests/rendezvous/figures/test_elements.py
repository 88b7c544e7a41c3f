"""Solutions in the elements beside those in the axes eta."""

import csv

import pytest

from pontryagin.io.files import figures_folder
from pontryagin.rendezvous.case_solutions import solved
from pontryagin.rendezvous.figures import elements
from pontryagin.rendezvous.problem.cases import (
    cases,
)


@pytest.mark.slow
def test_the_start_of_each_case_is_described():
    assert elements._with_start("circle-energy")[1] == "cold"
    assert elements._with_start("ellipse-mixed")[1] == "carried (cold: 0.0393)"
    for name in ("circle-energy", "ellipse-mixed"):
        assert elements.in_elements(name).cost == pytest.approx(solved(name).cost, rel=1e-10)


@pytest.mark.checkout
def test_the_solutions_in_both_sets_of_variables_agree_in_all_cases():
    with (figures_folder() / "43-rendezvous-elements" / "agreement.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [row["case"] for row in rows] == list(cases())
    columns = ("difference of $J$", "of $t_k$", "of $|p(0)|$", "residual")
    assert max(float(row[name]) for row in rows for name in columns) < 1e-9
    assert {row["start"].split()[0] for row in rows} == {"cold", "carried"}
