"""The tables hold the numbers of the solutions."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pontryagin.rendezvous.case_solutions import solved
from pontryagin.rendezvous.figures import tables


@pytest.mark.slow
def test_the_tables_hold_the_numbers_of_the_solutions():
    found = {name: solved(name) for name in ("mixed-bounded", "ellipse-mixed")}
    rows = tables.solutions(found)
    assert rows["arcs"] == ["SU", "U"]
    assert_allclose([float(value) for value in rows["$J$"]], [one.cost for one in found.values()], rtol=1e-9)
    assert_allclose(np.array(rows["direct $J$"], float), np.array(rows["$J$"], float), rtol=1e-6)
    residuals = tables.certificates(found)
    assert residuals.pop("case") == list(found)
    assert all(1 < float(value) < 1e4 for value in residuals.pop("condition"))
    largest = np.max([[float(value) for value in column] for column in residuals.values()], axis=0)
    wanted = [float(one.certificate.residual) for one in found.values()]
    assert_allclose(largest, wanted, rtol=0.5)
    assert largest.max() < 1e-10
    direct = tables.judge(found)
    assert direct["direct/J − 1, 40"][1].endswith("(another)")
    several = {name: 1 + len(best.others) for name, best in found.items() if best.others}
    assert {name: tables.others(found)["case"].count(name) for name in several} == several
    assert rows["others"] == [len(best.others) for best in found.values()]
    assert len(tables.titles()["case"]) == 15
