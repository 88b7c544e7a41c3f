"""A stack has the same results as its members, bit by bit, compiled or not, and raises no exceptions."""

from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from pontryagin.numerics import jit
from pontryagin.triple_integrator import (
    Maneuver,
    maximum_entropy,
    minimum_energy,
    minimum_impulse,
    minimum_norm,
    minimum_peak,
    minimum_time,
)
from pontryagin.triple_integrator.least_time import arrival
from pontryagin.triple_integrator.norms import energy, impulse, peak
from strategies import maneuvers, signs, stacked, states, wide

COUNT = 100_000
KERNELS = {
    "energy": (energy.solve_energy, energy.solve_stack),
    "peak": (peak.solve_peak, peak.solve_stack),
    "impulse": (impulse.solve_impulse, impulse.solve_stack),
    "time": (arrival.solve_time, arrival.solve_stack),
}


def narrow_flips(rng, count):
    """Moments of controls that are constant except for a reversal of width 1e-1 to 1e-14."""
    width = 10.0 ** rng.uniform(-14, -1, count)
    b = rng.random(count) * (1 - width)
    a, level = b + width, rng.choice([-1.0, 1.0], count)
    return np.stack(
        [level * (1 - 2 * (a**3 - b**3)) / 6, level * (1 - 2 * (a**2 - b**2)) / 2, level * (1 - 2 * width)]
    )


def problems(count):
    """Moments and durations (4, count): of size one, over forty decades, on a lattice, nearly constant u."""
    rng = np.random.default_rng(7)
    part = count // 4
    usual = rng.standard_normal((3, part))
    wide = 10.0 ** rng.uniform(-20, 20, (3, part)) * rng.choice([-1, 1], (3, part))
    lattice = rng.integers(-4, 5, (3, part)) / 4
    c = np.concatenate([usual, wide, lattice, narrow_flips(rng, part)], axis=1)
    duration = np.concatenate([10.0 ** rng.uniform(-6, 6, 2 * part), rng.integers(1, 4, part), np.ones(part)])
    return np.vstack([c, duration])


def transfers(count):
    """Ends, force and bound (8, count): of size one, over six decades, and on a lattice."""
    rng = np.random.default_rng(8)
    part = count // 4
    usual = rng.standard_normal((7, 2 * part))
    wide = 10.0 ** rng.uniform(-3, 3, (7, part)) * rng.choice([-1, 1], (7, part))
    lattice = rng.integers(-2, 3, (7, part))
    ends = np.concatenate([usual, wide, lattice], axis=1)
    return np.vstack([ends, 10.0 ** rng.uniform(-3, 3, ends.shape[1])])


@pytest.mark.slow
@pytest.mark.parametrize("name", KERNELS)
def test_compiled_and_plain_agree_to_the_bit(name):
    kernel, stack = KERNELS[name]
    columns = (transfers if name == "time" else problems)(COUNT)
    compiled = stack(*columns)
    step = 7
    plain = np.array([kernel(*row) for row in columns[:, ::step].T.tolist()])
    assert_array_equal(compiled[::step], plain)


@pytest.mark.parametrize("name", ["energy", "peak", "impulse"])
def test_residual_and_gap_of_a_hundred_thousand(name):
    solution = {"energy": minimum_energy, "peak": minimum_peak, "impulse": minimum_impulse}[name](
        Maneuver(np.zeros(3), *maneuver_columns(problems(COUNT)))
    )
    c = solution.certificate
    assert np.abs(c.primal_residual).max() <= 1e-13
    size = np.where(c.primal_value == 0, 1.0, c.primal_value)
    assert np.abs((c.primal_value - c.dual_value) / size).max() <= 1e-13, (
        "relative to the value, however small"
    )


def maneuver_columns(columns):
    return columns[:3].T, columns[3]


def test_residual_and_gap_of_a_hundred_thousand_transfers():
    columns = transfers(COUNT)
    usual = columns[:, : COUNT // 2]
    solution = minimum_time(usual[:3].T, usual[3:6].T, usual[7], disturbance=usual[6])
    assert np.abs(solution.certificate.primal_residual).max() <= 2e-15
    assert np.abs(1 - solution.certificate.dual_value / solution.duration).max() <= 1e-12
    rest = columns[:, COUNT // 2 :]
    others = minimum_time(rest[:3].T, rest[3:6].T, rest[7], disturbance=rest[6])
    assert np.abs(others.certificate.primal_residual).max() <= 1e-13


@pytest.mark.parametrize("name", ["energy", "peak", "impulse"])
def test_special_numbers_raise_nothing_in_plain_python(name):
    """Plain kernels agree with the compiled ones at zeros, halves, near one, and at tiny and huge numbers."""
    kernel, stack = KERNELS[name]
    special = [0.0, 1.0, 0.5, 1 / 6, 1e-8, 1e-20, 1e-160, 1e-300, 1e100, 1 + 2e-16, 1 - 1e-16, 1 / 3]
    special += [-x for x in special]
    grid = np.array(np.meshgrid(special, special, special, [1.0, 3.0])).reshape(4, -1)
    compiled = stack(*grid)
    assert np.isfinite(compiled).all()
    assert_array_equal(compiled[::5], np.array([kernel(*row) for row in grid[:, ::5].T.tolist()]))


def test_a_stack_is_cut_at_no_particular_size():
    """Sizes just below and just above the size from which stacks are compiled give the same results."""
    for count in (1, jit.COMPILE_FROM - 1, jit.COMPILE_FROM, jit.COMPILE_FROM + 1):
        columns = problems(4 * count)[:, :count]
        solution = minimum_peak(Maneuver(np.zeros(3), *maneuver_columns(columns)))
        last = minimum_peak(Maneuver(np.zeros(3), columns[:3, -1], columns[3, -1]))
        assert solution.norm[-1] == last.norm
        assert_array_equal(solution.switch_times[-1], last.switch_times)


@pytest.mark.parametrize("solve", [minimum_energy, minimum_peak, minimum_impulse])
def test_leading_axes_of_any_shape(solve):
    rng = np.random.default_rng(3)
    xf = rng.standard_normal((2, 1, 3, 3))
    durations = np.array([[1.0], [2.0]])
    stack = solve(Maneuver(np.zeros(3), xf, durations[:, :, None]))
    assert stack.norm.shape == (2, 1, 3)
    for index in np.ndindex(2, 1, 3):
        assert stack.norm[index] == solve(Maneuver(np.zeros(3), xf[index], durations[index[0], 0])).norm


@st.composite
def mixtures(draw):
    """Manoeuvres whose units of angle and of time differ by many decades."""
    members = []
    for m in draw(st.lists(maneuvers(), min_size=2, max_size=5)):
        time, angle = 2.0 ** draw(st.integers(-20, 20)), 2.0 ** draw(st.integers(-60, 60))
        units = angle / time ** np.arange(3)
        force = (m.disturbance or 0.0) * units[2]
        members.append(Maneuver(m.x0 * units, m.xf * units, m.tf * time, m.t0 * time, force))
    return members


@pytest.mark.parametrize(
    "solve",
    [minimum_energy, minimum_peak, minimum_impulse, partial(minimum_norm, q=1.3), partial(minimum_norm, q=4)],
    ids=["energy", "peak", "impulse", "q = 1.3", "q = 4"],
)
@given(members=mixtures())
def test_a_stack_of_any_mixture_of_scales_is_its_members(solve, members):
    together = solve(stacked(members))
    for i, member in enumerate(members):
        alone = solve(member)
        assert_allclose(together.norm[i], alone.norm, rtol=1e-13)
        assert_allclose(together.multipliers[i], alone.multipliers, rtol=1e-9)
        assert_allclose(together.certificate.dual_value[i], alone.certificate.dual_value, rtol=1e-13)


@given(members=st.lists(st.tuples(states(wide()), states(wide()), st.floats(-3, 3)), min_size=2, max_size=5))
def test_a_stack_of_transfers_is_its_members(members):
    x0, xf, decades = (np.array(column) for column in zip(*members, strict=True))
    bounds = 10.0**decades
    together = minimum_time(x0, xf, bounds)
    for i in range(len(members)):
        alone = minimum_time(x0[i], xf[i], bounds[i])
        assert together.duration[i] == alone.duration
        assert_array_equal(together.shares[i], alone.shares)


@settings(max_examples=10)
@given(
    members=st.lists(
        st.tuples(
            st.floats(0.2, 0.8), st.floats(0.1, 0.9), st.integers(-60, 60), st.integers(-20, 20), signs
        ),
        min_size=2,
        max_size=5,
    )
)
def test_a_stack_of_entropies_is_its_members(members):
    mean, share, size, time, sign = np.array(members).T
    T = 2.0**time
    square = mean**2 + share * (mean - mean**2)
    c = (sign * 2.0**size)[:, None] * np.stack([T**2 * square / 2, T * mean, np.ones_like(T)], axis=-1)
    together = maximum_entropy(Maneuver(np.zeros(3), c, T))
    for i in range(len(members)):
        alone = maximum_entropy(Maneuver(np.zeros(3), c[i], T[i]))
        assert_allclose(together.entropy[i], alone.entropy, rtol=1e-11, atol=1e-13)
        assert_allclose(together.coefficients[i], alone.coefficients, rtol=1e-8, atol=1e-10)
