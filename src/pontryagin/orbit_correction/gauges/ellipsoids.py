"""The gauge of a sum of ellipsoids E_k = G_k B, B the unit ball, by Newton's method: Lemma 9 and (8) to (11).

The sum's support function is S(psi) = sum |G_k'psi|. The gauge of b = -x0 is the largest (b, psi)/S(psi). Its
square is twice the largest value of the concave function (b, psi) - S(psi)^2/2. Where the gradient of this
function vanishes, b = S(psi) sum G_k G_k'psi/|G_k'psi|, which is the equation of Lemma 9 with the factor
alpha = S(psi). Every psi proves the lower bound (b, psi)/S(psi). The controls that belong to psi by Lemma 10,
corrected so that they reach b, prove an upper bound.
"""

from math import fabs, sqrt

import numpy as np

from pontryagin.arrays import Array

STEPS = 80
"""Largest number of iterations of Newton's method."""

GAP = 1e-12
"""Relative gap between the bounds above which a slower method is tried."""

CONTINUATION = 12
"""Number of rounds of the continuation; each has a tenth of the smoothing of the round before."""


def cholesky_solve(matrix: Array, right: Array) -> bool:
    """Overwrite the right-hand side by the solution; False if the matrix is not positive definite."""
    n = matrix.shape[0]
    for j in range(n):
        pivot = matrix[j, j]
        for k in range(j):
            pivot -= matrix[j, k] * matrix[j, k]
        if pivot <= 0.0:
            return False
        root = sqrt(pivot)
        matrix[j, j] = root
        for i in range(j + 1, n):
            entry = matrix[i, j]
            for k in range(j):
                entry -= matrix[i, k] * matrix[j, k]
            matrix[i, j] = entry / root
    forward_backward(matrix, right)
    return True


def forward_backward(factor: Array, right: Array) -> None:
    """Overwrite ``right`` by the solution x of L L' x = right, given L."""
    n = factor.shape[0]
    for i in range(n):
        for k in range(i):
            right[i] -= factor[i, k] * right[k]
        right[i] /= factor[i, i]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            right[i] -= factor[k, i] * right[k]
        right[i] /= factor[i, i]


def support(factors: Array, psi: Array, smoothing: float) -> float:
    """S(psi), with each term |g| smoothed to sqrt(|g|^2 + smoothing^2)."""
    steps, n, m = factors.shape
    total = 0.0
    for k in range(steps):
        square = smoothing * smoothing
        for j in range(m):
            part = 0.0
            for i in range(n):
                part += factors[k, i, j] * psi[i]
            square += part * part
        total += sqrt(square)
    return total


def support_derivatives(
    factors: Array, psi: Array, smoothing: float, gradient: Array, hessian: Array
) -> float:
    """`support`; in place, its gradient (the support point rho(psi)) and the lower half of its Hessian."""
    steps, n, m = factors.shape
    total = 0.0
    gradient[:] = 0.0
    hessian[:, :] = 0.0
    part, point = np.empty(m), np.empty(n)
    for k in range(steps):
        square = smoothing * smoothing
        for j in range(m):
            part[j] = 0.0
            for i in range(n):
                part[j] += factors[k, i, j] * psi[i]
            square += part[j] * part[j]
        size = sqrt(square)
        if size == 0.0:
            continue
        total += size
        for i in range(n):
            point[i] = 0.0
            for j in range(m):
                point[i] += factors[k, i, j] * part[j]
            point[i] /= size
            gradient[i] += point[i]
        for i in range(n):
            for l in range(i + 1):
                entry = -point[i] * point[l]
                for j in range(m):
                    entry += factors[k, i, j] * factors[k, l, j]
                hessian[i, l] += entry / size
    return total


def gauge_of(
    factors: Array, gram_factor: Array, b: Array, psi: Array, controls: Array
) -> tuple[float, float]:
    """Lower bound on the gauge of b, and the peak of controls that reach b.

    ``psi`` is overwritten by the costate and ``controls`` (steps, m) by the controls. ``gram_factor`` is the
    Cholesky factor of the sum of G_k G_k'.
    """
    if not least_energy_start(factors, gram_factor, b, psi):
        controls[:, :] = 0.0
        return 0.0, 0.0
    newton(factors, b, psi, 0.0)
    return bounds(factors, gram_factor, b, psi, controls)


def gauge_by_continuation(
    factors: Array, gram_factor: Array, b: Array, psi: Array, controls: Array
) -> tuple[float, float]:
    """`gauge_of` for nearly flat sets, for which Newton's method without continuation stops early."""
    continuation(factors, gram_factor, b, psi)
    return bounds(factors, gram_factor, b, psi, controls)


def continuation(factors: Array, gram_factor: Array, b: Array, psi: Array) -> None:
    """Newton's method on support functions that are smoothed less from round to round."""
    least_energy_start(factors, gram_factor, b, psi)
    smoothing = support(factors, psi, 0.0) / factors.shape[0]
    for _ in range(CONTINUATION):
        smoothing *= 0.1
        newton(factors, b, psi, smoothing)
    newton(factors, b, psi, 0.0)


def least_energy_start(factors: Array, gram_factor: Array, b: Array, psi: Array) -> bool:
    """Set psi to the costate of the least-energy controls, scaled to the best dual value; False if b = 0."""
    n = b.shape[0]
    size = 0.0
    for i in range(n):
        size = max(size, fabs(b[i]))
        psi[i] = b[i]
    if size == 0.0:
        return False
    forward_backward(gram_factor, psi)
    pairing = 0.0
    for i in range(n):
        pairing += b[i] * psi[i]
    total = support(factors, psi, 0.0)
    for i in range(n):
        psi[i] *= pairing / (total * total)
    return True


def newton(factors: Array, b: Array, psi: Array, smoothing: float) -> None:
    """Minimise S(psi)^2/2 - (b, psi), starting from psi and overwriting it."""
    n = b.shape[0]
    gradient, hessian, step, trial = np.empty(n), np.empty((n, n)), np.empty(n), np.empty(n)
    polish = 3
    for _ in range(STEPS):
        total = support_derivatives(factors, psi, smoothing, gradient, hessian)
        pairing = 0.0
        for i in range(n):
            pairing += b[i] * psi[i]
        value = 0.5 * total * total - pairing
        for i in range(n):
            step[i] = b[i] - total * gradient[i]
            trial[i] = step[i]
            for l in range(i + 1):
                hessian[i, l] = total * hessian[i, l] + gradient[i] * gradient[l]
        if not cholesky_solve(hessian, step):
            break
        slope = 0.0
        for i in range(n):
            slope += trial[i] * step[i]
        length = 1.0
        close = slope <= 1e-9 * fabs(value)
        for _ in range(40):
            for i in range(n):
                trial[i] = psi[i] + length * step[i]
            after = support(factors, trial, smoothing)
            pairing = 0.0
            for i in range(n):
                pairing += b[i] * trial[i]
            if close or 0.5 * after * after - pairing <= value - 0.25 * length * slope:
                break
            length *= 0.5
        if length < 1e-6:
            break
        for i in range(n):
            psi[i] = trial[i]
        if close:
            polish -= 1
            if polish == 0:
                break


def bounds(factors: Array, gram_factor: Array, b: Array, psi: Array, parts: Array) -> tuple[float, float]:
    """The lower bound that psi proves, and the peak of its controls by Lemma 10, corrected so as to reach b.

    The correction is the least-energy control for what the controls miss.
    """
    steps, n, m = factors.shape
    total, pairing = support(factors, psi, 0.0), 0.0
    for i in range(n):
        pairing += b[i] * psi[i]
    lower = pairing / total
    miss = b.copy()
    for k in range(steps):
        square = 0.0
        for j in range(m):
            parts[k, j] = 0.0
            for i in range(n):
                parts[k, j] += factors[k, i, j] * psi[i]
            square += parts[k, j] * parts[k, j]
        scale = lower / sqrt(square) if square > 0.0 else 0.0
        for j in range(m):
            parts[k, j] *= scale
            for i in range(n):
                miss[i] -= factors[k, i, j] * parts[k, j]
    forward_backward(gram_factor, miss)
    upper = 0.0
    for k in range(steps):
        square = 0.0
        for j in range(m):
            for i in range(n):
                parts[k, j] += factors[k, i, j] * miss[i]
            square += parts[k, j] * parts[k, j]
        upper = max(upper, square)
    return lower, sqrt(upper)


def gauge_stack(factors: Array, targets: Array, costates: Array, results: Array) -> None:
    """Both bounds on the gauge and what the controls miss of b, for each row of targets (states, n).

    Factors must be whitened: the sum of G_k G_k' is the identity. The results are written to ``results``
    (states, 3) and ``costates`` (states, n).
    """
    steps, n, m = factors.shape
    controls = np.empty((steps, m))
    identity = np.eye(n)
    for row in range(targets.shape[0]):
        lower, upper = gauge_of(factors, identity, targets[row], costates[row], controls)
        if upper - lower > GAP * upper:
            lower, upper = gauge_by_continuation(factors, identity, targets[row], costates[row], controls)
        results[row, 0], results[row, 1], results[row, 2] = lower, upper, 0.0
        size = 0.0
        for i in range(n):
            miss = targets[row, i]
            size = max(size, fabs(miss))
            for k in range(steps):
                for j in range(m):
                    miss -= factors[k, i, j] * controls[k, j]
            results[row, 2] = max(results[row, 2], fabs(miss))
        if size > 0.0:
            results[row, 2] /= size
