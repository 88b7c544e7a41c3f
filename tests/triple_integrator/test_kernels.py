"""The committed kernels are those that the derivation generates, in plain arithmetic."""

import ast
import inspect
from pathlib import Path

import pytest

from pontryagin.triple_integrator import generate, kernels


@pytest.mark.slow
def test_the_committed_text_is_regenerated_to_the_letter():
    assert Path(kernels.__file__).read_text() == generate.kernels()


def test_they_are_arithmetic_alone():
    tree = ast.parse(inspect.getsource(kernels))
    assert not [node for node in ast.walk(tree) if isinstance(node, ast.Import | ast.ImportFrom | ast.Call)]


def test_each_says_where_it_comes_from():
    functions = [value for value in vars(kernels).values() if inspect.isfunction(value)]
    assert len(functions) >= 13
    assert all(function.__doc__ for function in functions)
