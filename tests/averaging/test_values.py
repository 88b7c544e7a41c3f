"""Problems and solutions are values: they pickle, copy, compare and hash, and their arrays are read-only."""

import copy
import pickle

import numpy as np
import pytest
import sympy as sp

from pontryagin.averaging import (
    Box,
    Custom,
    PhaseSystem,
    kepler,
    rotor,
    smooth_example,
    solve_averaged,
    spin_down,
)

x = sp.Symbol("x", real=True)
a, u = sp.symbols("a u", real=True)


def pushed(target, control_set):
    return PhaseSystem([u], sp.exp(a), control_set, slow=[a], control=[u], phase=x, target=[a - target])


SOLVERS = {
    "smooth": lambda v1: smooth_example(1.0, v1, ripple=0.5),
    "kepler": lambda K0: kepler(-0.5, K0 - 1.05, -0.35, 0.1),
    "rotor": lambda a1: rotor(3.0, a1 + 3, potential=sp.cos(x), k=1.0),
    "spin_down": lambda w: spin_down([1.0, 0.4, w], [1.0, 0.5, 0.7], 1.6),
    "system": lambda v1: solve_averaged(pushed(v1, Box([1])), [0.5]),
}


@pytest.mark.parametrize("name", SOLVERS)
def test_a_solution_is_a_value(name):
    solution, same, other = (SOLVERS[name](number) for number in (2.0, 2.0, 1.9))
    loaded = pickle.loads(pickle.dumps(solution))
    for twin in (same, loaded, copy.deepcopy(solution)):
        assert twin == solution and hash(twin) == hash(solution)
        assert twin.system == solution.system and hash(twin.system) == hash(solution.system)
    assert other != solution and solution != "solution"
    np.testing.assert_array_equal(loaded.slow([0.1]), solution.slow([0.1]))
    with pytest.raises(ValueError, match="read-only"):
        loaded.duration[...] = 0


@pytest.mark.slow
@pytest.mark.parametrize("name", ["smooth", "spin_down"])
def test_extremals_are_values(name):
    exact = SOLVERS[name](2.0).exact(0.1)
    loaded = pickle.loads(pickle.dumps(exact))
    assert loaded == exact and hash(loaded) == hash(exact)
    assert loaded[0].certificate == exact[0].certificate
    np.testing.assert_array_equal(loaded[0].phase([0.0]), exact[0].phase([0.0]))


def test_an_argument_of_a_system_is_named():
    with pytest.raises(ValueError) as error:
        PhaseSystem([u], sp.exp(a), Box([-1]), slow=[a], control=[u], phase=x, target=[a])
    assert error.value.argument == "control_set"
    with pytest.raises(TypeError) as error:
        PhaseSystem(["u"], sp.exp(a), Box([1]), slow=[a], control=[u], phase=x, target=[a])
    assert error.value.argument == "f"


def test_a_custom_set_compares_by_its_function():
    def support(s):
        return 2 * sp.Abs(s[0])

    assert pushed(1, Custom(support)) == pushed(1, Custom(support)) != pushed(1, Custom(lambda s: support(s)))
