"""JSON that is printed holds every digit, and JSON that is read names its mistakes."""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pontryagin.io.json_io import from_json, plain, to_json


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False)))
def test_every_digit_is_read_back(values):
    text = to_json({"solution": {"norm": np.array(values), "count": np.int64(len(values))}})
    assert from_json(text) == {"solution": {"norm": values, "count": len(values)}}


def test_what_is_not_finite_is_null_at_every_depth():
    value = {"a": [np.nan, (np.inf, -np.inf)], "b": np.array([[1.0, np.nan]]), "c": np.float64("nan")}
    assert plain(value) == {"a": [None, [None, None]], "b": [[1.0, None]], "c": None}


def test_text_truth_values_and_none_stay_as_they_are():
    value = {"name": "λ", "unique": np.True_, "remark": None, "path": b"x"}
    assert json.loads(to_json({"problem": value}))["problem"] == {
        "name": "λ",
        "unique": True,
        "remark": None,
        "path": "b'x'",
    }


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('{"a": 1,\n "b" 2}', "line 2, column 6: Expecting ':' delimiter"),
        ('{"a": {"b": 1, "b": 2}}', "b occurs twice in one object"),
        ("[" * 100_000, "nested too deeply"),
    ],
)
def test_a_text_that_is_not_json_is_refused(text, words):
    with pytest.raises(ValueError, match=words):
        from_json(text)
