"""The oracle of the L_q norms and of the entropy: Gauss's rule on panels that shrink towards every kink."""

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any

import mpmath as mp
import numpy as np

from pontryagin.arrays import Array
from studies.soak.exactly import DIGITS, mpf, required

NODES, WEIGHTS = np.polynomial.legendre.leggauss(14)
SHRINKING = 4.0 ** -np.arange(1.0, 27.0)
"""Ends of the panels beside a kink, as shares of half the distance to the next one."""
PLACES = np.array([0.07, 0.31, 0.52, 0.78, 0.94])
"""Shares of the duration at which the control that a solution gives is compared."""


def rule(kinks: Sequence[float]) -> tuple[Array, Array]:
    """Nodes and weights on [0, 1] for functions that are smooth between the kinks."""
    inside = sorted({0.0, 1.0, *(float(k) for k in kinks if 0 < k < 1)})
    ends = [np.array(inside)]
    for a, b in pairwise(inside):
        half = (b - a) / 2
        ends += [a + half * SHRINKING, b - half * SHRINKING, np.array([a + half])]
    edges = np.unique(np.concatenate(ends))
    half, middle = np.diff(edges)[:, None] / 2, (edges[1:] + edges[:-1])[:, None] / 2
    return (middle + half * NODES).ravel(), (half * WEIGHTS).ravel()


def kinks_of(p: Array) -> list[float]:
    """Real zeros and the vertex of p0 + p1 x + p2 x^2, those of the leading terms where p2 is tiny."""
    found = [complex(z) for z in np.roots(np.trim_zeros(p[::-1], "f"))]
    vertex = [-p[1] / (2 * p[2])] if p[2] else []
    return [z.real for z in found if abs(z.imag) <= 1e-9 * abs(z)] + vertex


def miss(shape: Array, weights: Array, sigma: Array, row: Array, total: float) -> tuple[float, float]:
    """What the moments of norm * shape miss, relative to the sizes of their terms; norm is fitted to `total`.

    `shape` is a control on the nodes sigma (time to go as a share of T) up to a factor; `total` is what its
    integral against the weights must be, in units of the required moments' own scale.
    """
    with mp.workdps(DIGITS):
        c, sizes, T = required(row)
        scaled = [c[0] / T**3, c[1] / T**2, c[2] / T]
        bounds = [sizes[0] / T**3, sizes[1] / T**2, sizes[2] / T]
        unit = max(map(abs, scaled))
        k, size = (np.array([float(x / unit) for x in part]) for part in (scaled, bounds))
    h = np.stack([sigma**2 / 2, sigma, np.ones_like(sigma)])
    made, whole = (h * (weights * shape)).sum(axis=1), (h * (weights * np.abs(shape))).sum(axis=1)
    factor = total / float(unit)
    return float(np.max(np.abs(factor * made - k) / (size + abs(factor) * whole))), float(size.max())


def power_disagreement(solution: Any, row: Array, q: float) -> float:
    """How far a solution of least L_q norm is from optimal: moments, dual value, control."""
    T, p = float(row[6] - row[7]), q / (q - 1)
    l = np.asarray(solution.multipliers)
    if not l.any():
        return float(solution.norm)
    scale = np.array([l[2], l[1] * T, l[0] * T * T / 2])
    scale = scale / np.abs(scale).max()
    sigma, weights = rule(kinks_of(scale))
    h = scale[0] + sigma * (scale[1] + sigma * scale[2])
    h = h / np.abs(h).max()
    u = np.sign(h) * np.abs(h) ** (p - 1)
    own = float((weights * np.abs(h) ** p).sum())
    norm = float(solution.norm)
    missed, _ = miss(u, weights, sigma, row, norm * T ** (-1 / q) * own ** (-1 / q))
    with mp.workdps(DIGITS):
        c, sizes, exact_T = required(row)
        exact_l = [mpf(x) for x in l]
        sides = [exact_l[2], exact_l[1] * exact_T, exact_l[0] * exact_T**2 / 2]
        largest = max(map(abs, sides))
        top = largest * mpf(np.abs(scale[0] + sigma * (scale[1] + sigma * scale[2])).max())
        pairing = mp.fsum(a * b for a, b in zip(exact_l, c, strict=True))
        bound = pairing / (top * mpf(own) ** (1 / mpf(p)) * exact_T ** (1 / mpf(p)))
        moved = mp.fsum(abs(a) * b for a, b in zip(exact_l, sizes, strict=True)) / abs(pairing)
        gap = float(abs(mpf(norm) - bound) / mpf(norm) / max(mp.mpf(1), moved))
    return max(missed, gap, _control_misses(solution, row, scale, p))


def _control_misses(solution: Any, row: Array, scale: Array, p: float) -> float:
    """The distance of the control at a few places from |h|^(p-1) sign h, relative to its largest value."""
    T = float(row[6] - row[7])
    times = row[7] + PLACES * T
    sigma = (row[6] - times) / T
    given = np.asarray(solution.control(times)) / float(solution.peak)
    h = scale[0] + sigma * (scale[1] + sigma * scale[2])
    ends = [0.0, 1.0, *(k for k in kinks_of(scale) if 0 < k < 1)]
    h = h / max(abs(scale[0] + k * (scale[1] + k * scale[2])) for k in ends)
    amplified = max(1.0, p - 1) * max(1.0, abs(row[6]) / T)
    return float(np.abs(given - np.sign(h) * np.abs(h) ** (p - 1)).max() / amplified)


def entropy_disagreement(solution: Any, row: Array) -> float:
    """How far a control of greatest entropy is from its moments; its form makes it the optimum."""
    T = float(row[6] - row[7])
    k = np.asarray(solution.coefficients) * [1, T, T * T]
    if not np.isfinite(k[0]):
        return float(solution.norm)
    vertex: list[float] = [-k[1] / (2 * k[2])] if k[2] else []
    sigma, weights = rule(vertex)
    exponent = sigma * (k[1] + sigma * k[2])
    top = exponent.max()
    sign = float(np.sign(solution.peak))
    missed, _ = miss(sign * np.exp(exponent - top), weights, sigma, row, float(np.exp(k[0] + top)))
    sizes = max(1.0, float(np.abs(k).max()))
    control: Callable[[Array], Array] = solution.control
    times = row[7] + PLACES * T
    given = np.abs(np.asarray(control(times)))
    s = (row[6] - times) / T
    own = np.exp(k[0] + s * (k[1] + s * k[2]))
    form = float(np.abs(given - own).max() / abs(float(solution.peak)))
    total = abs(float(solution.norm) - abs(row[5] - row[2])) / abs(row[5] - row[2])
    return max(missed / sizes, form / sizes, total)
