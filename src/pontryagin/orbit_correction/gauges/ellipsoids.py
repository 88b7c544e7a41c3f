"""The gauge of the sum of ellipsoids E_k = G_k B (B the unit ball): how much of the peak a state needs.

The sum's support function is S(psi) = sum |G_k'psi|. The gauge of b is the largest (b, psi)/S(psi); its
square is twice the largest value of the smooth concave (b, psi) - S(psi)^2/2, found by Newton's method.
Any psi proves a lower bound; the controls that it chooses, corrected to reach b exactly, an upper one.
"""

from math import fabs, sqrt

import numpy as np

STEPS = 80
GAP = 1e-12
CONTINUATION = 12


def cholesky_solve(matrix, right):
    """Solve a positive definite system in place of its right-hand side; False if it is not definite."""
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


def forward_backward(factor, right):
    """Solve L L' x = right in place, given L."""
    n = factor.shape[0]
    for i in range(n):
        for k in range(i):
            right[i] -= factor[i, k] * right[k]
        right[i] /= factor[i, i]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            right[i] -= factor[k, i] * right[k]
        right[i] /= factor[i, i]


def support(factors, psi, smoothing):
    """S(psi), each term |g| rounded off to sqrt(|g|^2 + smoothing^2)."""
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


def support_derivatives(factors, psi, smoothing, gradient, hessian):
    """`support`, its gradient (the support point) and its second derivative (lower triangle), in place."""
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


def gauge_of(factors, gram_factor, b, psi, controls):
    """Lower bound on the gauge of b, and peak of controls (steps, m) that reach b; psi ends as the costate.

    ``gram_factor`` is the Cholesky factor of the sum of G_k G_k'.
    """
    if not least_energy_start(factors, gram_factor, b, psi):
        controls[:, :] = 0.0
        return 0.0, 0.0
    newton(factors, b, psi, 0.0)
    return bounds(factors, gram_factor, b, psi, controls)


def gauge_by_continuation(factors, gram_factor, b, psi, controls):
    """`gauge_of` for sets that are all but flat, where Newton's method alone ends short."""
    continuation(factors, gram_factor, b, psi)
    return bounds(factors, gram_factor, b, psi, controls)


def continuation(factors, gram_factor, b, psi):
    """Newton's method on support functions rounded off less and less."""
    least_energy_start(factors, gram_factor, b, psi)
    smoothing = support(factors, psi, 0.0) / factors.shape[0]
    for _ in range(CONTINUATION):
        smoothing *= 0.1
        newton(factors, b, psi, smoothing)
    newton(factors, b, psi, 0.0)


def least_energy_start(factors, gram_factor, b, psi):
    """The costate of the least-energy controls, scaled to the best value of the dual; False if b = 0."""
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


def newton(factors, b, psi, smoothing):
    """Minimise S(psi)^2/2 - (b, psi) from psi, in place."""
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


def bounds(factors, gram_factor, b, psi, parts):
    """What psi proves from below, and the peak of the controls it chooses once they reach b exactly."""
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


def gauge_stack(factors, targets, costates, results):
    """Bounds on the gauge and what the controls miss, for each row of targets (states, n).

    Factors are whitened: the sum of G_k G_k' is the identity. Results are (states, 3), costates (states, n).
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
