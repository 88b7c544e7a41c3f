"""The command line as the tests call it: answers, refusals in one line, plots, tables and examples."""

import csv
import io
import json
import re

import numpy as np
from typer.testing import CliRunner

from pontryagin.cli import app


def run(*arguments, **given):
    """The outcome of a command; an unexpected exception is raised."""
    return CliRunner().invoke(app, [str(argument) for argument in arguments], catch_exceptions=False, **given)


def assert_refused(result, begins, status=2):
    """One line on standard error that begins with `begins`, and nothing on standard output."""
    assert (result.exit_code, result.stdout) == (status, "")
    assert result.stderr.startswith(f"Error: {begins}"), result.stderr
    assert result.stderr.count("\n") == 1
    assert result.stderr.strip().isprintable()
    assert not set("│╭─┌") & set(result.stderr)


def assert_plots(folder, *command):
    """The command draws a file of each format, and says so in one line."""
    for name, start in {"a.svg": b"<?xml", "a.pdf": b"%PDF", "a.png": b"\x89PNG"}.items():
        result = run(*command, "--plot", folder / name)
        assert (result.exit_code, result.stderr) == (0, f"wrote {folder / name}\n")
        assert (folder / name).read_bytes().startswith(start)


def assert_examples_run(count, *helps):
    """The helps of these commands have `count` examples, and each of them succeeds."""
    texts = [run(*command, "--help").stdout for command in helps]
    examples = re.findall(r"^ +pontryagin (.*)$", "\n".join(texts), re.MULTILINE)
    assert len(examples) == count
    for example in examples:
        result = CliRunner().invoke(app, example)
        assert result.exit_code == 0, (example, result.stderr)


def as_json(value):
    """Arrays as lists, and null where there is no finite number."""
    array = np.asarray(value)
    if array.dtype.kind != "f":
        return array.tolist()
    return np.where(np.isfinite(array), array, None).tolist()


def assert_numbers(shown, value):
    """Each number of a part of the answer is that of the attribute of its name, to the last digit."""
    for name, number in shown.items():
        assert number == as_json(getattr(value, name)), name


def answer(*command):
    """What a command prints as JSON."""
    result = run(*command, "--json")
    assert result.exit_code == 0, result.stderr
    return json.loads(result.stdout)


def write_table(path, header, rows):
    """Write a CSV file and return its path."""
    path.write_text("\n".join(",".join(row) for row in [header, *rows]) + "\n")
    return path


def read_table(text):
    """The rows of a CSV table by column."""
    return list(csv.DictReader(io.StringIO(text)))
