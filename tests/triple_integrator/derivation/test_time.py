"""Least time: the quartics in T and in T - c3 are one equation, solved by every bang-bang transfer."""

import pytest
import sympy as sp

from pontryagin.triple_integrator.derivation import model, peak, time

T = model.T
v, z = time.sign, time.z
START = sp.Matrix([time.x10, time.x20, time.x30])
END = sp.Matrix([time.x1f, time.x2f, time.x3f])
K, DX, DV, C3 = time.x30 + time.f, time.x1f - time.x10, time.x2f - time.x20, time.x3f - time.x30


def quartic(level):
    """16 v^2 p1 p3 - 12 v^2 p2^2 - p3^4."""
    p1 = level * T**3 + 3 * K * T**2 + 6 * time.x20 * T - 6 * DX
    p2 = level * T**2 + 2 * K * T - 2 * DV
    p3 = level * T - C3
    return sp.expand(16 * level**2 * p1 * p3 - 12 * level**2 * p2**2 - p3**4)


def flown(level, durations):
    """State after three pieces of the control, level, -level, level, under the constant force f."""
    x = START
    for sign, tau in zip((1, -1, 1), durations, strict=True):
        k, u = x[2] + time.f, sign * level
        x = sp.Matrix(
            [
                x[0] + x[1] * tau + k * tau**2 / 2 + u * tau**3 / 6,
                x[1] + k * tau + u * tau**2 / 2,
                x[2] + u * tau,
            ]
        )
    return x


def test_the_moments_are_what_the_free_motion_leaves_to_do():
    """c = x_f - x(T) for the motion with u = 0, which solves x1' = x2, x2' = x3 + f, x3' = 0."""
    free = END - time.moments()
    assert (free.subs(T, 0) - START).applyfunc(sp.expand).is_zero_matrix
    rates = sp.Matrix([free[1], free[2] + time.f, 0])
    assert (free.diff(T) - rates).applyfunc(sp.expand).is_zero_matrix


@pytest.mark.slow
@pytest.mark.parametrize("level", [1, -1])
def test_the_quartic_is_that_of_the_theory(level):
    derived = time.quartic().subs(v, level)
    assert (
        sp.expand(derived * sp.Poly(quartic(level), T).LC() - quartic(level) * sp.Poly(derived, T).LC()) == 0
    )


@pytest.mark.parametrize("level", [1, -1])
def test_the_stable_form_is_the_quartic(level):
    parts = {key: value.subs(v, level) for key, value in time.small_parts().items()}
    stable = sp.expand(time.stable_form().subs(parts))
    assert sp.expand(stable - quartic(level)) == 0


@pytest.mark.parametrize(("name", "level"), [("same", 1), ("opposite", -1)])
def test_the_quartics_in_the_excess_time_are_the_same_with_T_shifted(name, level):
    symbols = time.coefficient_symbols()
    values = dict(zip(symbols[:5], time.small_part_coefficients(), strict=True)) | {symbols[-1]: C3}
    shifted = (
        sum(c * z**i for i, c in enumerate(time.in_excess_time()[name])).subs(values).subs(symbols[-1], C3)
    )
    assert sp.expand(shifted - quartic(level).subs(T, C3 + z)) == 0


@pytest.mark.parametrize("level", [1, -1])
def test_every_bang_bang_transfer_solves_the_quartic(level):
    first, second, third = sp.symbols("tau1:4", positive=True)
    arrived = flown(level, (first, second, third))
    ends = dict(zip(END, arrived, strict=True)) | {T: first + second + third}
    assert sp.expand(quartic(level).subs(ends, simultaneous=True)) == 0


def test_the_scaled_moments_feed_the_level_equation():
    k = time.scaled_moments()
    assert sp.cancel(k[0] - 6 * time.moments()[0] / T**3) == 0
    equation = peak.level_equation().subs(dict(zip((peak.k1, peak.k2, peak.k3), k, strict=True)))
    difference = sp.together(16 * T**4 * (k[2] - 1) * equation.subs(peak.t, 1) - quartic(1))
    assert sp.expand(sp.numer(difference)) == 0
