"""Rows split at commas are those that the module csv reads, with the same numbers of lines."""

import csv
import io

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from pontryagin.io import csv_lines


def read_by_csv(text):
    """The rows that are not empty, with the lines at which they end, and the words of an error."""
    reader, found = csv.reader(io.StringIO(text, newline="")), []
    try:
        found += [(row, reader.line_num) for row in reader if row]
    except csv.Error as reason:
        return found, f"near line {reader.line_num}: {reason}"
    return found, ""


@given(
    st.text('a,1" \n', max_size=40), st.sampled_from(["\n", "\r\n", "\r"]), st.sampled_from([1, 2, 3, None])
)
@example('1,2\n\n3\n"a\nb",4\n\n5', "\n", 2)
@example("1,2\n3\n", "\r\n", 2)
@example('1\n"2', "\n", 1)
def test_rows_are_those_of_the_module_csv_with_the_same_lines(text, end, size):
    text = text.replace("\n", end)
    file = io.StringIO(text, newline="")
    header, number = csv_lines.header_of(file)
    found, error = [], ""
    try:
        for rows, lines in csv_lines.rows_of(file, number, size):
            assert size is None or len(rows) <= size
            found += zip(rows, lines, strict=True)
    except ValueError as reason:
        error = str(reason)
    known, wrong = read_by_csv(text)
    assert error == wrong
    expected = known[1:] if header else known
    assert found == (expected[: len(found)] if error else expected)


def test_a_text_that_is_no_utf_8_is_refused_near_its_line(tmp_path):
    path = tmp_path / "in.csv"
    path.write_bytes(b"a,b\n1,2\n" + b"3,\xff\n")
    with path.open(encoding="utf-8", newline="") as file, pytest.raises(ValueError, match=r"^near line \d: "):
        list(csv_lines.rows_of(file, *csv_lines.header_of(file)[1:], 1))
