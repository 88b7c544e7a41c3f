"""The kept rows of small weights of time are reproduced, and harder the smaller the weight."""

import numpy as np
import pytest

from pontryagin.rendezvous import (
    small_weight,
    solve,
)


@pytest.mark.slow
@pytest.mark.parametrize("weight", [1e-1, 1e-2, 1e-3])
def test_the_rows_of_small_weights_are_reproduced(weight):
    kept = next(one for one in small_weight.rows() if one.time_weight == weight)
    again = small_weight.row(solve(small_weight.problem(weight)))
    assert (again.duration, again.cost) == pytest.approx((kept.duration, kept.cost), rel=1e-9)
    assert again.condition == pytest.approx(kept.condition, rel=1e-2)


def test_condition_number_and_residual_grow_as_the_weight_of_time_falls():
    rows = small_weight.rows()[2:]
    condition, residual = (
        np.array([getattr(one, name) for one in rows]) for name in ("condition", "residual")
    )
    assert np.all(condition[1:] > 5 * condition[:-1]) and np.all(residual[1:] > residual[:-1])
    assert np.all(residual < 1e-14 * condition)


def test_rows_of_small_weights_are_read_as_they_were_written(tmp_path, monkeypatch):
    kept = small_weight.rows()
    monkeypatch.setattr(small_weight, "FILE", tmp_path / "small_weight.csv")
    small_weight.write(kept)
    assert small_weight.rows() == kept
