"""Tables as CSV and Markdown keep their entries."""

import csv
import io

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pontryagin.display.tables import csv_table, markdown_table

finite = st.floats(allow_nan=False, allow_infinity=False)


@given(st.lists(finite, min_size=1))
def test_a_csv_table_keeps_twelve_digits(values):
    header, *rows = csv.reader(io.StringIO(csv_table({"norm": values})))
    assert header == ["norm"]
    np.testing.assert_allclose([float(cell) for (cell,) in rows], values, rtol=1e-11)


@given(st.lists(st.text(alphabet='ab,"|$ \n'), min_size=1))
def test_a_csv_table_keeps_every_text(values):
    rows = list(csv.reader(io.StringIO(csv_table({"word": values, "n": range(len(values))}))))[1:]
    assert [row[0] for row in rows] == values


@given(st.lists(st.text(alphabet="ab|$\\ "), min_size=1, max_size=4), st.integers(1, 4))
def test_every_row_of_a_markdown_table_has_as_many_cells_as_the_header(words, columns):
    table = markdown_table({f"h{i}": words for i in range(columns)})
    for line in table.splitlines():
        bars = line.replace(r"\\", "").replace(r"\|", "").count("|")
        assert bars == columns + 1


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (-2, "−2"),
        (0.5, "0.5"),
        (-0.0, "0"),
        (1.25e-14, r"$1.25\times 10^{-14}$"),
        (float("nan"), "—"),
        (float("-inf"), "−∞"),
        (np.float64(3), "3"),
        (np.True_, "yes"),
        (None, ""),
        ("$|u|$ | v", r"$\vert{}u\vert{}$ \vert{} v"),
        ("a | b", r"a \| b"),
    ],
)
def test_cells_are_written_as_a_reader_expects(value, shown):
    assert markdown_table({"x": [value]}).splitlines()[-1] == f"| {shown} |"


@pytest.mark.parametrize("columns", [{}, {"a": [1], "b": [1, 2]}])
def test_columns_that_make_no_table_are_refused_by_name(columns):
    for table in (csv_table, markdown_table):
        with pytest.raises(ValueError, match="columns: got"):
            table(columns)
