"""CSV files: numbers by column, answers beside what was read, errors with the number of the line."""

import numpy as np
import pytest

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
    ],
)
def test_an_error_names_its_line(read, text, words):
    with pytest.raises(ValueError, match=words):
        read(text, ["E", "K"])
