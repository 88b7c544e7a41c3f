"""The gauge for impulses in a disc: of a sum of flat ellipses in space, G_k (3, m).

The support function S(psi) = sum |G_k'psi| has a kink where psi is orthogonal to a flat G_j, and step j need
not be at its bound there. If Newton's method stops before the optimum, the optimum is at such a psi: the
steps with G_j'psi = 0 supply what the other steps leave of b.
"""

from math import sqrt

import numpy as np

from pontryagin.arrays import Array
from pontryagin.orbit_correction.gauges.ellipsoids import GAP, bounds, continuation, gauge_of, support
from pontryagin.orbit_correction.gauges.zonotope import cross, dot

CANDIDATES = 8
"""Number of steps whose kinks are tried, in the order of their distance from psi."""


def flat_gauge(
    factors: Array, gram_factor: Array, b: Array, psi: Array, controls: Array
) -> tuple[float, float]:
    """Lower bound on the gauge of b, and the peak of controls w_k with sum of G_k w_k = b.

    ``psi`` is overwritten by the costate and ``controls`` (steps, m) by the controls.
    """
    lower, upper = gauge_of(factors, gram_factor, b, psi, controls)
    if upper - lower <= GAP * upper:
        return lower, upper
    if at_a_kink(factors, b, psi, controls):
        return bounds_at(factors, b, psi, controls)
    continuation(factors, gram_factor, b, psi)
    if at_a_kink(factors, b, psi, controls):
        return bounds_at(factors, b, psi, controls)
    return bounds(factors, gram_factor, b, psi, controls)


def at_a_kink(factors: Array, b: Array, psi: Array, controls: Array) -> bool:
    """Whether the optimum is at the kink of one of the steps; if so, psi is moved there."""
    steps = factors.shape[0]
    sizes = np.empty(steps)
    for k in range(steps):
        sizes[k] = length_along(factors, k, psi)
    order = np.argsort(sizes)
    normal = np.empty(3)
    for place in range(min(steps, CANDIDATES)):
        normal_of(factors, order[place], normal)
        alpha, peak = kink(factors, b, normal, controls)
        if peak <= alpha * (1.0 + GAP):
            for i in range(3):
                psi[i] = normal[i]
            return True
    return False


def bounds_at(factors: Array, b: Array, psi: Array, controls: Array) -> tuple[float, float]:
    """The lower bound that psi proves, and the peak of the controls."""
    upper = 0.0
    for k in range(factors.shape[0]):
        square = 0.0
        for j in range(factors.shape[2]):
            square += controls[k, j] * controls[k, j]
        upper = max(upper, square)
    return dot(b, psi) / support(factors, psi, 0.0), sqrt(upper)


def length_along(factors: Array, k: int, psi: Array) -> float:
    """|G_k'psi|."""
    square = 0.0
    for j in range(factors.shape[2]):
        part = dot(factors[k, :, j], psi)
        square += part * part
    return sqrt(square)


def normal_of(factors: Array, k: int, normal: Array) -> None:
    """Write the normal of the plane of the two most independent columns of G_k to ``normal``."""
    best = -1.0
    trial = np.empty(3)
    for j in range(factors.shape[2]):
        for l in range(j):
            cross(factors[k, :, j], factors[k, :, l], trial)
            size = dot(trial, trial)
            if size > best:
                best = size
                for i in range(3):
                    normal[i] = trial[i]


def kink(factors: Array, b: Array, psi: Array, controls: Array) -> tuple[float, float]:
    """The lower bound by a psi at which G_k'psi = 0 for some steps, and the peak of the controls.

    The other steps are at their bounds. The steps with G_k'psi = 0 supply what is left of b with the least
    energy, which is also the least peak if they act in the same plane.
    """
    steps, _, m = factors.shape
    pairing = dot(b, psi)
    if pairing < 0.0:
        pairing = -pairing
        for i in range(3):
            psi[i] = -psi[i]
    scale = sqrt(dot(psi, psi))
    total = 0.0
    rest, gram, idle = np.zeros(3), np.zeros((3, 3)), np.zeros(steps)
    for k in range(steps):
        length, size = length_along(factors, k, psi), 0.0
        for j in range(m):
            size += dot(factors[k, :, j], factors[k, :, j])
        if length <= 1e-13 * scale * sqrt(size):
            idle[k] = 1.0
            for j in range(m):
                for i in range(3):
                    for l in range(3):
                        gram[i, l] += factors[k, i, j] * factors[k, l, j]
            continue
        total += length
        for j in range(m):
            controls[k, j] = dot(factors[k, :, j], psi) / length
            for i in range(3):
                rest[i] += factors[k, i, j] * controls[k, j]
    if total == 0.0 or pairing == 0.0 or not idle.any():
        return 0.0, 1e300
    alpha = pairing / total
    for i in range(3):
        rest[i] = b[i] / alpha - rest[i]
    share = in_plane(gram, psi, rest)
    peak = 1.0
    for k in range(steps):
        square = 0.0
        for j in range(m):
            if idle[k] > 0.0:
                controls[k, j] = dot(factors[k, :, j], share)
            square += controls[k, j] * controls[k, j]
            controls[k, j] *= alpha
        peak = max(peak, sqrt(square))
    return alpha, alpha * peak


def in_plane(gram: Array, normal: Array, target: Array) -> Array:
    """The x orthogonal to the normal with gram x = target, where gram maps the normal to 0."""
    first, second, result = np.zeros(3), np.empty(3), np.empty(3)
    axis = 0
    for i in range(3):
        if abs(normal[i]) < abs(normal[axis]):
            axis = i
    first[axis] = 1.0
    cross(normal, first, second)
    cross(second, normal, first)
    a, h, c = form(gram, first, first), form(gram, first, second), form(gram, second, second)
    p, q = dot(first, target), dot(second, target)
    volume = a * c - h * h
    for i in range(3):
        result[i] = ((c * p - h * q) * first[i] + (a * q - h * p) * second[i]) / volume
    return result


def form(matrix: Array, left: Array, right: Array) -> float:
    """left' matrix right."""
    total = 0.0
    for i in range(3):
        for j in range(3):
            total += left[i] * matrix[i, j] * right[j]
    return total
