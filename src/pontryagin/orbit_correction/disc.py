"""The gauge of a sum of flat ellipses, G_k (3, 2): impulses in a disc, kinks included.

The support function is not smooth where psi is orthogonal to both columns of some G_j: then impulse j does
not matter to first order and need not be at its bound. If Newton's method ends short, the optimum is at
such a psi, and the impulses that vanish there take up whatever the others leave.
"""

from math import sqrt

import numpy as np

from pontryagin.orbit_correction.ellipsoids import bounds, gauge_of, least_energy_start, newton, support
from pontryagin.orbit_correction.zonotope import cross, dot

GAP = 1e-12
CANDIDATES = 8
CONTINUATION = 12


def disc_gauge(factors, gram_factor, b, psi, controls):
    """Lower bound and peak of controls (steps, 2) with sum of G_k w_k = b; psi ends as the costate."""
    lower, upper = gauge_of(factors, gram_factor, b, psi, controls)
    if upper - lower <= GAP * upper:
        return lower, upper
    if at_a_kink(factors, b, psi, controls):
        return bounds_at(factors, b, psi, controls)
    least_energy_start(factors, gram_factor, b, psi)
    smoothing = support(factors, psi, 0.0) / factors.shape[0]
    for _ in range(CONTINUATION):
        smoothing *= 0.1
        newton(factors, b, psi, smoothing)
    newton(factors, b, psi, 0.0)
    if at_a_kink(factors, b, psi, controls):
        return bounds_at(factors, b, psi, controls)
    return bounds(factors, gram_factor, b, psi, controls)


def at_a_kink(factors, b, psi, controls):
    """Whether the optimum is the kink of one of the impulses, the nearest first; then psi is moved there."""
    steps = factors.shape[0]
    sizes = np.empty(steps)
    for k in range(steps):
        x, y = projections(factors, k, psi)
        sizes[k] = x * x + y * y
    order = np.argsort(sizes)
    normal = np.empty(3)
    for place in range(min(steps, CANDIDATES)):
        j = order[place]
        cross(factors[j, :, 0], factors[j, :, 1], normal)
        alpha, peak = kink(factors, b, normal, controls)
        if peak <= alpha * (1.0 + GAP):
            for i in range(3):
                psi[i] = normal[i]
            return True
    return False


def bounds_at(factors, b, psi, controls):
    """What psi proves, and the peak of the controls."""
    upper = 0.0
    for k in range(factors.shape[0]):
        upper = max(upper, controls[k, 0] ** 2 + controls[k, 1] ** 2)
    return dot(b, psi) / support(factors, psi, 0.0), sqrt(upper)


def projections(factors, k, psi):
    """G_k'psi."""
    return dot(factors[k, :, 0], psi), dot(factors[k, :, 1], psi)


def kink(factors, b, psi, controls):
    """Bound proved by a psi at which some impulses vanish, and the peak when those share the rest equally."""
    steps = factors.shape[0]
    pairing = dot(b, psi)
    if pairing < 0.0:
        pairing = -pairing
        for i in range(3):
            psi[i] = -psi[i]
    length = sqrt(dot(psi, psi))
    total, idle, first = 0.0, 0, -1
    rest = np.zeros(3)
    for k in range(steps):
        x, y = projections(factors, k, psi)
        size = sqrt(x * x + y * y)
        controls[k, 0], controls[k, 1] = 0.0, 0.0
        if size <= 1e-13 * length * sqrt(dot(factors[k, :, 1], factors[k, :, 1])):
            idle += 1
            first = k if first < 0 else first
            continue
        total += size
        controls[k, 0], controls[k, 1] = x / size, y / size
        for i in range(3):
            rest[i] += factors[k, i, 0] * controls[k, 0] + factors[k, i, 1] * controls[k, 1]
    if first < 0 or total == 0.0 or pairing == 0.0:
        return 0.0, 1e300
    alpha = pairing / total
    for i in range(3):
        rest[i] = b[i] / alpha - rest[i]
    x, y = in_plane(factors[first, :, 0], factors[first, :, 1], rest)
    share = sqrt(x * x + y * y) / idle
    for k in range(steps):
        if controls[k, 0] == 0.0 and controls[k, 1] == 0.0:
            controls[k, 0], controls[k, 1] = x / idle, y / idle
        controls[k, 0] *= alpha
        controls[k, 1] *= alpha
    return alpha, alpha * max(1.0, share)


def in_plane(first, second, target):
    """Coordinates of a vector of the plane of two others."""
    a, b, c = dot(first, first), dot(first, second), dot(second, second)
    p, q = dot(first, target), dot(second, target)
    volume = a * c - b * b
    return (c * p - b * q) / volume, (a * q - b * p) / volume
