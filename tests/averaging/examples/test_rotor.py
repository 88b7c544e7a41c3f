"""The rotor refuses invalid arguments by name, and takes symbols by name."""

import numpy as np
import pytest
import sympy as sp

from pontryagin.averaging import rotor

X, V = sp.symbols("x v")


NAN, INFINITE = float("nan"), float("inf")


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


@pytest.mark.parametrize(
    "kinked",
    [
        sp.Abs(sp.sin(X)),
        sp.Max(sp.sin(X), 0),
        sp.sign(sp.sin(X)),
        sp.Heaviside(sp.sin(X)),
        sp.Piecewise((1, sp.sin(X) > 0), (0, True)),
    ],
    ids=str,
)
def test_masses_and_potentials_with_kinks_have_the_least_time_of_their_means(kinked):
    """With u = 1 the energy grows by the angle: the time of a1 - a0 is its mean period over 2 pi."""
    heavier = rotor(2.0, 4.0, mass=2 + kinked, peak=1.0)
    half = (np.arange(4000) + 0.5) * np.pi / 4000
    at = sp.lambdify(X, kinked, modules="numpy")
    values = np.concatenate([at(half), at(half + np.pi)])
    expected = np.mean(np.sqrt(2 + values)) * (np.sqrt(8) - 2)
    np.testing.assert_allclose(float(heavier.duration), expected, rtol=1e-7)
    deeper = rotor(2.0, 4.0, potential=kinked, peak=1.0)
    expected = np.mean(np.sqrt(8 - 2 * values) - np.sqrt(4 - 2 * values))
    np.testing.assert_allclose(float(deeper.duration), expected, rtol=1e-7)
