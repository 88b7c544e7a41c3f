"""The committed kernels and systems equal what the derivations generate; solving does not import SymPy."""

import ast
import inspect
import subprocess
import sys
from pathlib import Path

import pytest

from pontryagin.averaging import generate, kernels
from pontryagin.averaging.system import derived_systems, generated_systems


@pytest.mark.slow
@pytest.mark.parametrize(
    ("module", "text"), [(kernels, generate.kernels), (generated_systems, generate.systems)]
)
def test_the_committed_text_is_regenerated_to_the_letter(module, text):
    assert Path(module.__file__).read_text() == text()


@pytest.mark.slow
@pytest.mark.parametrize("name", derived_systems.EXAMPLES)
def test_the_generated_systems_are_the_derived_ones(name):
    derived = derived_systems.EXAMPLES[name]().system
    assert getattr(generated_systems, name)(*derived.numbers.values()) == derived


def test_they_are_arithmetic_and_elementary_functions_alone():
    tree = ast.parse(inspect.getsource(kernels))
    called = {node.func.id for node in ast.walk(tree) if isinstance(node, ast.Call)}
    assert called <= {"sqrt", "sin", "cos"}
    imports = [node for node in ast.walk(tree) if isinstance(node, ast.Import | ast.ImportFrom)]
    assert [node.module for node in imports] == ["numpy"]


def test_each_says_where_it_comes_from():
    functions = [value for value in vars(kernels).values() if inspect.isfunction(value)]
    assert len(functions) == 18
    assert all(function.__doc__ for function in functions)


def test_the_examples_solve_without_sympy():
    program = (
        "import sys\n"
        "from pontryagin.averaging import kepler, smooth_example, spin_down\n"
        "costs = [smooth_example(1.0, 2.0).cost, kepler(-0.5, 0.95, -0.35, 0.1).cost,\n"
        "         spin_down([3, 4, 2], [1, 1, 1], 0.5).cost]\n"
        "heavy = sorted({'sympy', 'scipy', 'numba'} & set(sys.modules))\n"
        "print(*(f'{float(cost):.10f}' for cost in costs), heavy)"
    )
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    cost = 0.2 * 20**0.5 * (0.5**0.5 - 0.35**0.5)
    assert run.stdout.split() == ["2.0000000000", f"{cost:.10f}", "5.0000000000", "[]"]
