"""CSV files: numbers by column, answers beside what was read, errors with the number of the line."""

import csv
import io
import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pontryagin.io import rows


@pytest.fixture
def read(tmp_path):
    """The function that reads a text as a file."""

    def of_text(text, *columns, **options):
        path = tmp_path / "in.csv"
        path.write_text(text)
        return rows.read(path, *columns, **options)

    return of_text


def test_rows_come_back_with_their_answers(read):
    table = read("name, E ,free\na,1/4,x\n\nb,-2e-1,y\n", ["E"], ["K"])
    assert list(table.columns) == ["E"] and table.columns["E"].tolist() == [0.25, -0.2]
    text = rows.to_csv(table, {"cost": np.array([1 / 3, np.nan]), "count": np.array([1, 2])})
    assert text == f"name,E,free,cost,count\na,1/4,x,{1 / 3!r},1\nb,-2e-1,y,,2\n"


def test_vectors_become_columns_and_truth_values_words(read):
    table = read("x1,x2\n1,2\n\n3,4\n", ["x1", "x2"])
    assert table.stack(["x2", "x1"]).tolist() == [[2.0, 1.0], [4.0, 3.0]]
    assert table.lines == [2, 4]
    text = rows.to_csv(table, {"u": np.array([[0.5, np.nan], [1.0, 2.0]]), "unique": np.array([True, False])})
    assert text == "x1,x2,u_1,u_2,unique\n1,2,0.5,,yes\n3,4,1.0,2.0,no\n"


def test_a_file_without_rows_names_what_a_row_holds(read):
    with pytest.raises(ValueError, match="line 2: the file holds no state"):
        read("E\n", ["E"], holds="state")


def test_a_possible_column_is_read_if_it_is_there(read):
    assert read("E,K\n1,2\n", ["E"], ["K"]).columns["K"].tolist() == [2.0]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "line 1: column E is missing, needs E, K"),
        ("E\n1\n", "line 1: column K is missing"),
        ("E,K\n", "line 2: the file holds no problem"),
        ("E,K\n1,2\n1\n", "line 3: has 1 entries, but the header has 2"),
        ("E,K\n1,much\n", "line 2: K takes a number, got 'much'"),
        ("E,K, E\n1,2,3\n", "line 1: column 'E' is there twice"),
        ("E,K,free,free\n1,2,3,4\n", "line 1: column 'free' is there twice"),
        ("E,K,,\n1,2,,\n", "line 1: column '' is there twice"),
        ("E;K\n1;2\n", "line 1: columns are separated by ';', but must be by ','"),
        ("x;E;K, y\n1;2\n", "line 1: columns are separated by ';'"),
        ("x\tE\tK\n1\t2\n", r"line 1: columns are separated by '\\t'"),
        ("E|K\n1|2\n", "line 1: columns are separated by '|'"),
        ('E,K\n1,2\n"' + "3" * 140_000, "near line 3: field larger than field limit"),
    ],
)
def test_an_error_names_its_line(read, text, words):
    with pytest.raises(ValueError) as error:
        read(text, ["E", "K"])
    assert words.replace("\\\\", "\\") in str(error.value)


def test_whatever_wrote_the_file_the_rows_are_kept(tmp_path):
    path = tmp_path / "in.csv"
    path.write_bytes('\ufeffE,kept,more\r\n\r\n1,"a, ""b""",x\r\n pi/2 ,"two\nlines",\r\n'.encode())
    table = rows.read(path, ["E"])
    assert (table.lines, table.columns["E"].tolist()) == ([3, 5], [1.0, np.pi / 2])
    text = rows.to_csv(table, {"u": np.array([0.1, np.inf])})
    assert text == 'E,kept,more,u\n1,"a, ""b""",x,0.1\n pi/2 ,"two\nlines",,inf\n'


@pytest.mark.parametrize("texts", [["x", ""], ['"', "x"], ["a,b", "c"], ["\n", "x"], ["\r", "x"], [" ", "x"]])
def test_kept_texts_are_quoted_as_the_csv_module_does(tmp_path, texts):
    path, written = tmp_path / "in.csv", io.StringIO()
    csv.writer(written).writerows([["E", "kept"], *([i, text] for i, text in enumerate(texts))])
    path.write_text(written.getvalue(), newline="")
    with path.open(newline="") as file:
        known = [[*row, "0.5"] for row in csv.reader(file)][1:]
    expected = io.StringIO()
    csv.writer(expected, lineterminator="\n").writerows([["E", "kept", "u"], *known])
    assert rows.to_csv(rows.read(path, ["E"]), {"u": np.full(len(known), 0.5)}) == expected.getvalue()


def test_blocks_are_parts_of_the_whole_with_the_lines_of_the_file(tmp_path, monkeypatch):
    monkeypatch.setattr(rows, "BLOCK", 2)
    path = tmp_path / "in.csv"
    path.write_text("E\n1\n\n2\n3\n")
    found = list(rows.blocks(path, ["E"]))
    assert [part.columns["E"].tolist() for part in found] == [[1.0, 2.0], [3.0]]
    assert [part.lines for part in found] == [[2, 4], [5]]


def test_doubles_read_back_and_a_column_that_recurs_is_the_same_text(read):
    values = np.array([0.1, 1e23, 5e-324, -0.0, np.nan])
    table = read("E\n" + "1\n" * 5, ["E"])
    lines = rows.to_csv(table, {"u": values, "v": values, "n": np.arange(5)}).splitlines()[1:]
    cells = [line.split(",") for line in lines]
    assert [one for _, one, _, _ in cells] == ["0.1", "1e+23", "5e-324", "-0.0", ""]
    assert [one == two for _, one, two, _ in cells] == [True] * 5


@given(
    st.lists(st.floats(-1e308, 1e308), min_size=1, max_size=9),
    st.sampled_from([repr, "{:.3e}".format, "{:+.17g}".format, "{:.0f}".format, " {} ".format]),
)
def test_numbers_are_read_to_the_last_bit_however_they_are_written(values, written):
    texts = list(map(written, values))
    assert rows._numbers(texts).tobytes() == np.array(list(map(float, texts))).tobytes()


@pytest.mark.parametrize("text", ["true", "null", '"5"', "[1]", "1,2", "1], [2", "1e400", "nan", ""])
def test_what_only_another_language_reads_as_a_number_is_refused(text):
    for others in ([], ["1", "2.5"]):
        with pytest.raises(ValueError):
            rows._numbers([*others, text])


def test_numbers_are_written_with_the_fewest_digits_that_read_back():
    values = np.random.default_rng(2).standard_normal(2000) * 10.0 ** np.arange(-300, 300, 0.3)
    texts = rows._texts(np.concatenate([values, [np.nan, np.inf, -np.inf, 0.1, 5.0, -0.0]]))
    assert texts[-6:] == ["", "inf", "-inf", "0.1", "5.0", "-0.0"]

    def digits(text):
        return text.split("e")[0].strip("-").replace(".", "").strip("0")

    for value, text in zip(values.tolist(), texts, strict=False):
        assert float(text) == value and digits(text) == digits(repr(value))


def test_a_file_in_another_encoding_is_refused_after_its_last_line_that_was_read(tmp_path):
    path = tmp_path / "in.csv"
    path.write_bytes("E\n1\n".encode("utf-16"))
    with pytest.raises(ValueError, match="near line 0: 'utf-8' codec"):
        rows.read(path, ["E"])


def test_rows_at_fault_are_known_and_the_others_read(tmp_path):
    path = tmp_path / "in.csv"
    path.write_text("E,K\n1,2\n\nmuch,3\n4\n5,6,7\n8,pi\n")
    (block,) = rows.blocks(path, ["E", "K"])
    assert block.faults == {
        1: "E takes a number, got 'much'",
        2: "has 1 entries, but the header has 2",
        3: "has 3 entries, but the header has 2",
    }
    assert block.columns["E"][[0, 4]].tolist() == [1, 8] and block.columns["K"][4] == np.pi
    part = block.part([2, 3, 4])
    assert (part.lines, sorted(part.faults)) == ([5, 6, 7], [0, 1])
    assert part.columns["K"][2] == np.pi
    assert rows.unanswered(part) == ["4,", "5,6", "8,pi"]


def test_an_answer_has_no_name_of_a_column(read):
    table = read("E,u_2,v\n1,2,3\n", ["E"])
    for name, values in {"v": np.ones(1), "u": np.ones((1, 2))}.items():
        with pytest.raises(ValueError, match=r"line 1: column '.*' has the name of an answer"):
            rows.answered(table, {name: values})
    with pytest.raises(ValueError, match="column 'v' has the name"):
        rows.as_json(table, {"v": np.ones(1)}, {})


def test_rows_as_objects_hold_the_numbers_and_null_where_there_is_none(read):
    table = read("name,E\na,1/4\nb,2\n", ["E"])
    answers = {"u": np.array([[0.5, np.nan], [1.0, 2.0]]), "unique": np.array([True, False])}
    first, second = map(json.loads, rows.as_json(table, answers, {1: 'no, "never"'}))
    assert first == {"name": "a", "E": 0.25, "u": [0.5, None], "unique": True}
    assert second == {"name": "b", "E": 2.0, "u": [1.0, 2.0], "unique": False, "error": 'no, "never"'}
