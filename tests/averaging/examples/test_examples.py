"""The four examples refuse invalid arguments, with messages that name the argument."""

import numpy as np
import pytest
import sympy as sp

from pontryagin.averaging import kepler, rotor, smooth_example, spin_down

X, V = sp.symbols("x v")
NAN, INFINITE = float("nan"), float("inf")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((-1.0, 2.0), "v0 must be positive, got -1"),
        ((1.0, 0.0), "v1 must be positive, got 0"),
        ((1.0, 2.0, -1.0), "k must be positive"),
        ((1.0, 2.0, 0.0), "k must be positive"),
        ((NAN, 2.0), "v0 must be .* finite"),
        ((1.0, 2.0, 1.0, INFINITE), "ripple must be .* finite"),
        (([1.0, 2.0], [1.0, 2.0, 3.0]), "v1: the leading shapes do not broadcast"),
    ],
)
def test_the_smooth_example_names_what_is_wrong(arguments, message):
    with pytest.raises(ValueError, match=message):
        smooth_example(*arguments)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((0.5, 0.9, -0.3, 0.1), "E0 must be negative"),
        ((-0.5, 0.9, 0.0, 0.1), "E1 must be negative, as the energy of a bound orbit is, got 0"),
        ((-0.5, 0.9, [-0.3, 0.2], 0.1), "E1 must be negative, as the energy of a bound orbit is, got 0.2"),
        ((-0.5, -0.9, -0.3, 0.1), "K0 must be positive"),
        ((-0.5, 1.1, -0.3, 0.1), "K0 must be below that of the round orbit .* = 1, got 1.1"),
        ((-0.5, 1.0, -0.3, 0.1), "K0 must leave an eccentricity above"),
        ((-0.5, 1 - 1e-14, -0.3, 0.1), "K0 must leave an eccentricity above"),
        ((-0.5, 1e-9, -0.3, 0.1), "K0 must leave an eccentricity below 1"),
        ((-0.5, 0.9, -0.3, 0.0), "l must be positive"),
        ((-0.5, 0.9, -0.3, NAN), "l must be .* finite"),
        ((NAN, 0.9, -0.3, 0.1), "E0 must be .* finite"),
        (([-0.5, -0.4], [0.9, 0.8, 0.7], -0.3, 0.1), "K0: the leading shapes do not broadcast"),
    ],
)
def test_kepler_names_what_is_wrong(arguments, message):
    with pytest.raises(ValueError, match=message):
        kepler(*arguments)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([1.0, 2.0], [1, 1, 1], 0.5), r"omega0 must be an array \(\.\.\., 3\)"),
        (([1.0, 2.0, NAN], [1, 1, 1], 0.5), "omega0 must be .* finite"),
        (([1.0, 2.0, 0.0], [1, 1, 1], 0.5), "omega0 must have w_z other than 0"),
        (([1.0, 2.0, 3.0], [1, 0, 1], 0.5), "semiaxes must be positive"),
        (([1.0, 2.0, 3.0], [1, 1], 0.5), r"semiaxes must be an array \(\.\.\., 3\)"),
        (([1.0, 2.0, 3.0], [1, 1, 1], 1.0), "ratio must differ from 1"),
        (([1.0, 2.0, 3.0], [1, 1, 1], -0.5), "ratio must be positive"),
        (([[1.0, 2.0, 3.0]] * 2, [1, 1, 1], [0.5] * 3), "ratio: the leading shapes do not broadcast"),
    ],
)
def test_spin_down_names_what_is_wrong(arguments, message):
    with pytest.raises(ValueError, match=message):
        spin_down(*arguments)


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({}, ValueError, "exactly one of peak and k"),
        ({"peak": 1.0, "k": 1.0}, ValueError, "exactly one of peak and k"),
        ({"peak": 0.0}, ValueError, "peak must be positive"),
        ({"peak": NAN}, ValueError, "peak must be .* finite"),
        ({"k": -1.0}, ValueError, "k must be positive"),
        (
            {"a0": 0.9},
            ValueError,
            "a0 must exceed the potential's maximum 1, .* got 0.9",
        ),
        ({"a1": [2.0, 1.0]}, ValueError, "a1 must exceed the potential's maximum 1, .* got 1"),
        ({"a1": INFINITE}, ValueError, "a1 must be .* finite"),
        ({"a1": [3.0, 4.0], "peak": [1.0] * 3}, ValueError, "peak: the leading shapes do not broadcast"),
        ({"mass": sp.cos(X)}, ValueError, "mass must be positive for every x, got -1"),
        ({"mass": 0}, ValueError, "mass must be positive"),
        ({"mass": "1 + cos(x)"}, TypeError, "mass must be a SymPy expression or a number"),
        ({"mass": NAN}, ValueError, "mass must be finite"),
        ({"mass": sp.Symbol("m")}, ValueError, "mass may hold x only, got unknown symbols m"),
        ({"mass": 2 + V}, ValueError, "mass may hold x only, got unknown symbols v"),
        ({"potential": X / 9}, ValueError, "potential must be 2 pi-periodic in x"),
        ({"potential": object()}, TypeError, "potential must be a SymPy expression or a number"),
        ({"force": sp.sin(X / 2)}, ValueError, "force must be 2 pi-periodic in x"),
        ({"force": sp.Symbol("t") * V}, ValueError, "force may hold x and v only, got unknown symbols t"),
        ({"force": sp.I}, ValueError, "force must be real"),
    ],
)
def test_the_rotor_names_what_is_wrong(arguments, error, message):
    good = {"a0": 2.0, "a1": 3.0, "potential": -sp.cos(X)}
    if not arguments.keys() & {"peak", "k"} and arguments:
        good["peak"] = 1.0
    with pytest.raises(error, match=message):
        rotor(**good | arguments)


def test_the_rotor_takes_symbols_by_name_and_numbers_as_they_are():
    real = sp.Symbol("x", real=True)
    one = rotor(2.0, 3.0, mass=2, potential=-sp.cos(real), force=-sp.Symbol("v", positive=True) / 9, peak=1)
    other = rotor(2.0, 3.0, mass=2.0, potential=-sp.cos(X), force=-V / 9, peak=1.0)
    assert float(one.cost) == pytest.approx(float(other.cost), rel=1e-14)
    assert np.isfinite(float(one.cost))
