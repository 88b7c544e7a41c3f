"""CSV files: numbers by column, answers beside what was read, errors with the number of the line."""

import numpy as np
import pytest

from pontryagin.io import rows


def test_rows_come_back_with_their_answers(tmp_path):
    path = tmp_path / "in.csv"
    path.write_text("name, E ,free\na,1/4,x\n\nb,-2e-1,y\n")
    read = rows.read(path, ["E"], ["K"])
    assert list(read.columns) == ["E"] and read.columns["E"].tolist() == [0.25, -0.2]
    text = rows.to_csv(read, {"cost": np.array([1 / 3, np.nan]), "count": np.array([1, 2])})
    assert text == f"name,E,free,cost,count\na,1/4,x,{1 / 3!r},1\nb,-2e-1,y,,2\n"


def test_vectors_become_columns_and_truth_values_words(tmp_path):
    path = tmp_path / "in.csv"
    path.write_text("x1,x2\n1,2\n\n3,4\n")
    read = rows.read(path, ["x1", "x2"])
    assert read.stack(["x2", "x1"]).tolist() == [[2.0, 1.0], [4.0, 3.0]]
    assert read.lines == [2, 4]
    text = rows.to_csv(read, {"u": np.array([[0.5, np.nan], [1.0, 2.0]]), "unique": np.array([True, False])})
    assert text == "x1,x2,u_1,u_2,unique\n1,2,0.5,,yes\n3,4,1.0,2.0,no\n"


def test_a_file_without_rows_names_what_a_row_holds(tmp_path):
    path = tmp_path / "in.csv"
    path.write_text("E\n")
    with pytest.raises(ValueError, match="line 2: the file holds no state"):
        rows.read(path, ["E"], holds="state")


def test_a_possible_column_is_read_if_it_is_there(tmp_path):
    path = tmp_path / "in.csv"
    path.write_text("E,K\n1,2\n")
    assert rows.read(path, ["E"], ["K"]).columns["K"].tolist() == [2.0]


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
def test_an_error_names_its_line(tmp_path, text, words):
    path = tmp_path / "in.csv"
    path.write_text(text)
    with pytest.raises(ValueError, match=words):
        rows.read(path, ["E", "K"])
