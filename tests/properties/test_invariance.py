"""Invariances of every solver: units, sign, time reversal, the origin of time, and the free motion."""

from functools import partial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from pontryagin.triple_integrator import Maneuver, minimum_energy, minimum_impulse, minimum_norm, minimum_peak
from strategies import maneuver_with, maneuvers, moments, states

EXPONENT = {
    minimum_energy: 2.0,
    minimum_peak: np.inf,
    minimum_impulse: 1.0,
    partial(minimum_norm, q=1.3): 1.3,
    partial(minimum_norm, q=4.0): 4.0,
}
every_solver = pytest.mark.parametrize("solve", EXPONENT, ids=lambda solve: f"q = {EXPONENT[solve]}")
factors = st.integers(-40, 40).map(lambda k: 2.0**k)


def sampled(solution, shares):
    m = solution.maneuver
    return solution.control(m.t0 + shares * m.duration)


SHARES = np.linspace(0.013, 0.987, 40)


@every_solver
@given(c=moments(), factor=factors)
def test_amplitude(solve, c, factor):
    """Powers of two change no digit: the scaled problem has the scaled solution bit by bit."""
    base, scaled = solve(maneuver_with(c)), solve(maneuver_with(factor * c))
    assert scaled.norm == base.norm * factor
    assert_array_equal(sampled(scaled, SHARES), factor * sampled(base, SHARES))


@every_solver
@given(c=moments())
def test_sign(solve, c):
    base, other = solve(maneuver_with(c)), solve(maneuver_with(-c))
    assert_allclose(other.norm, base.norm, rtol=1e-13)
    if EXPONENT[solve] in (1.0, 2.0, np.inf):
        assert_array_equal(sampled(other, SHARES), -sampled(base, SHARES))


@every_solver
@given(c=moments(), factor=factors)
def test_unit_of_time(solve, c, factor):
    """T -> kT with c -> (k^3, k^2, k) c stretches u(t) to u(t/k): the L_q norm gains k^(1/q)."""
    base = solve(maneuver_with(c))
    stretched = solve(maneuver_with(c * factor ** np.array([3, 2, 1]), factor))
    if solve is minimum_impulse:
        stretched_norm = stretched.norm / factor
    else:
        stretched_norm = stretched.norm / factor ** (1 / EXPONENT[solve])
        assert_allclose(sampled(stretched, SHARES), sampled(base, SHARES), rtol=1e-9, atol=1e-9 * base.norm)
    assert_allclose(stretched_norm, base.norm, rtol=1e-14)


@every_solver
@given(c=moments())
def test_time_reversal(solve, c):
    """u(T - s) has the moments c with s replaced by T - s, and the same norm."""
    c1, c2, c3 = c
    reversed_c = np.array([c1 - c2 + c3 / 2, c3 - c2, c3])
    there, back = solve(maneuver_with(c)), solve(maneuver_with(reversed_c))
    assert_allclose(back.norm, there.norm, rtol=1e-9, atol=1e-12 * np.abs(c).max())


@every_solver
@given(maneuver=maneuvers(), shift=st.integers(-8, 8))
def test_origin_of_time(solve, maneuver, shift):
    later = Maneuver(maneuver.x0, maneuver.xf, maneuver.tf + shift, maneuver.t0 + shift, maneuver.disturbance)
    base, moved = solve(maneuver), solve(later)
    assert_allclose(moved.norm, base.norm, rtol=1e-11, atol=1e-11)


@every_solver
@given(maneuver=maneuvers(), start=states())
def test_both_ends_may_move_with_the_free_motion(solve, maneuver, start):
    """Adding a free motion to the state changes neither the moments nor the control."""
    free = Maneuver(start, [0, 0, 0], maneuver.tf, maneuver.t0)
    shifted = Maneuver(
        maneuver.x0 + start,
        maneuver.xf + free.drift(maneuver.tf)[0],
        maneuver.tf,
        maneuver.t0,
        maneuver.disturbance,
    )
    base, moved = solve(maneuver), solve(shifted)
    size = 1 + np.abs(shifted.xf).max()
    assert_allclose(moved.norm, base.norm, rtol=1e-9, atol=1e-8 * size)


@every_solver
@given(first=moments(), second=moments())
def test_the_least_norm_is_a_norm_of_the_moments(solve, first, second):
    """norm(c + d) <= norm(c) + norm(d), as the sum of the two controls has the moments c + d."""
    a, b, both = (float(solve(maneuver_with(c)).norm) for c in (first, second, first + second))
    assert both <= (a + b) * (1 + 1e-12)


@given(c=moments())
def test_hoelder_orders_the_norms(c):
    """For T = 1, |u|_1 <= |u|_2 <= |u|_inf holds for every u, hence for the least norms."""
    one, two, most = (
        float(solve(maneuver_with(c)).norm) for solve in (minimum_impulse, minimum_energy, minimum_peak)
    )
    assert one <= two * (1 + 1e-12)
    assert two <= most * (1 + 1e-12)


@given(c=moments(), q=st.sampled_from([1.3, 3.0]))
def test_the_family_lies_between_its_ends(c, q):
    if np.abs(c).max() < 1e-3:
        return
    low, middle, high = (
        float(s.norm)
        for s in (
            minimum_impulse(maneuver_with(c)),
            minimum_norm(maneuver_with(c), q),
            minimum_peak(maneuver_with(c)),
        )
    )
    assert low * (1 - 1e-9) <= middle <= high * (1 + 1e-9)
