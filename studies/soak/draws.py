"""Random manoeuvres and transfers of the triple integrator, in strata that are hard in different ways.

A row has the columns of `COLUMNS`. Every stratum is a part of each chunk, so that the first problems of each
make a stratified sample.
"""

import numpy as np

from pontryagin.arrays import Array

COLUMNS = ("x10", "x20", "x30", "x1f", "x2f", "x3f", "tf", "t0", "force")
"""Ends, times and a constant disturbance."""


def moments_only(c: Array, duration: Array) -> Array:
    """Rows from rest at zero to the moments themselves."""
    zero = np.zeros(len(duration))
    return np.column_stack([np.zeros((len(duration), 3)), c, duration, zero, zero])


def usual(rng: np.random.Generator, count: int) -> Array:
    """Ends and force of size one, durations over four decades, starts of the clock between -10 and 10."""
    start = rng.uniform(-10, 10, count)
    ends, force = rng.standard_normal((count, 6)), rng.standard_normal(count)
    return np.column_stack([ends, start + 10.0 ** rng.uniform(-2, 2, count), start, force])


def wide(rng: np.random.Generator, count: int) -> Array:
    """Moments over forty decades, durations over twelve."""
    c = 10.0 ** rng.uniform(-20, 20, (count, 3)) * rng.choice([-1, 1], (count, 3))
    return moments_only(c, 10.0 ** rng.uniform(-6, 6, count))


def far_scales(rng: np.random.Generator, count: int) -> Array:
    """Moments of one size, that of each row within two hundred decades, times within sixty."""
    T, size = 10.0 ** rng.uniform(-30, 30, count), 10.0 ** rng.uniform(-100, 100, count)
    k = rng.standard_normal((count, 3)) * size[:, None]
    return moments_only(k * np.stack([T**3, T**2, T], axis=1), T)


def lattice(rng: np.random.Generator, count: int) -> Array:
    """Moments and durations on a lattice: zeros, ties, boundaries of regimes."""
    return moments_only(rng.integers(-4, 5, (count, 3)) / 4.0, rng.integers(1, 4, count).astype(float))


def narrow_flips(rng: np.random.Generator, count: int) -> Array:
    """Moments of a control that is constant except for a reversal of width 1e-1 to 1e-14, T = 1."""
    width = 10.0 ** rng.uniform(-14, -1, count)
    b = rng.random(count) * (1 - width)
    a, level = b + width, rng.choice([-1.0, 1.0], count)
    c = [(1 - 2 * (a**3 - b**3)) / 6, (1 - 2 * (a**2 - b**2)) / 2, 1 - 2 * width]
    return moments_only(level[:, None] * np.stack(c, axis=1), np.ones(count))


def edges(rng: np.random.Generator, count: int) -> Array:
    """Moments of one or two impulses, moved off the boundary of a regime by 0 or 1e-16 to 1e-3."""
    s = np.where(rng.random((count, 2)) < 0.25, rng.integers(0, 2, (count, 2)), rng.random((count, 2)))
    a = rng.standard_normal((count, 2)) * rng.integers(0, 2, (count, 2))
    h = np.stack([s**2 / 2, s, np.ones_like(s)], axis=-1)
    c = (a[..., None] * h).sum(axis=1)
    off = 10.0 ** rng.uniform(-16, -3, (count, 1)) * rng.integers(0, 2, (count, 1))
    return moments_only(c + off * rng.standard_normal((count, 3)), np.ones(count))


STRATA = (usual, wide, far_scales, lattice, narrow_flips, edges)
"""The manoeuvres of fixed duration."""


def rest_to_rest(rng: np.random.Generator, count: int) -> Array:
    """Turns from rest to rest over six decades of angle, bound 10^-2 to 10^2."""
    ends = np.zeros((count, 6))
    ends[:, 3] = rng.choice([-1, 1], count) * 10.0 ** rng.uniform(-3, 3, count)
    return np.column_stack([ends, 10.0 ** rng.uniform(-2, 2, count), np.zeros(count)])


def any_ends(rng: np.random.Generator, count: int) -> Array:
    """Ends, force and bound of size one."""
    return np.column_stack(
        [rng.standard_normal((count, 6)), rng.uniform(0.2, 5.0, count), rng.standard_normal(count)]
    )


def wide_ends(rng: np.random.Generator, count: int) -> Array:
    """Ends and force over six decades each, bound over six."""
    size = 10.0 ** rng.uniform(-3, 3, (count, 7)) * rng.choice([-1, 1], (count, 7))
    return np.column_stack([size[:, :6], 10.0 ** rng.uniform(-3, 3, count), size[:, 6]])


def lattice_ends(rng: np.random.Generator, count: int) -> Array:
    """Ends and force on a lattice, bound a power of two."""
    ends = rng.integers(-2, 3, (count, 7)).astype(float)
    return np.column_stack([ends[:, :6], 2.0 ** rng.integers(-3, 4, count), ends[:, 6]])


def bangs(rng: np.random.Generator, count: int) -> Array:
    """Ends of a control |u| = 1 with pieces of lengths 1 to 1e-10, some of them zero: narrow flips."""
    pieces = 10.0 ** rng.uniform(-10, 0, (count, 3)) * (rng.random((count, 3)) < 0.8)
    pieces[:, 0] += 1e-3
    start, level = rng.standard_normal((count, 3)), rng.choice([-1.0, 1.0], count)
    x = start.copy()
    for k, sign in enumerate((1.0, -1.0, 1.0)):
        t, u = pieces[:, k], sign * level
        x = np.stack(
            [
                x[:, 0] + t * (x[:, 1] + t * (x[:, 2] / 2 + t * u / 6)),
                x[:, 1] + t * (x[:, 2] + t * u / 2),
                x[:, 2] + t * u,
            ],
            axis=1,
        )
    return np.column_stack([start, x, np.ones(count), np.zeros(count)])


TRANSFERS = (rest_to_rest, any_ends, wide_ends, lattice_ends, bangs)
"""The transfers of least time: columns ends (6), bound, force."""


def positive_controls(rng: np.random.Generator, count: int) -> Array:
    """Moments of three to five impulses of one sign, inside the cone; T over six decades."""
    s, a = rng.random((count, 5)), rng.random((count, 5))
    a[:, 3:] *= rng.integers(0, 2, (count, 2))
    T, sign = 10.0 ** rng.uniform(-3, 3, count), rng.choice([-1.0, 1.0], count)
    s = s * T[:, None]
    h = np.stack([s**2 / 2, s, np.ones_like(s)], axis=-1)
    return moments_only(sign[:, None] * (a[..., None] * h).sum(axis=1), T)


def drawn(rng: np.random.Generator, strata: tuple, count: int) -> tuple[Array, list[int]]:
    """About `count` rows of all strata in equal parts, and the numbers of a stratified hundredth."""
    each = count // len(strata)
    rows = np.concatenate([stratum(rng, each) for stratum in strata])
    first = [k * each + i for k in range(len(strata)) for i in range(-(-each // 100))]
    return rows, first
