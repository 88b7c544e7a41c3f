"""Newton's method for many convex functions of a quadratic at once, with a line search on the slope."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.triple_integrator.norms.quadrature import Quadratic, orthonormal

Derivatives = Callable[[Quadratic, NDArray[np.intp]], tuple[Array, Array, Array]]
"""A function from quadratics (n) and the indices of their problems (n,) to a scale (n,), the gradient (n, 3)
and the Hessian (n, 3, 3) in the orthonormal basis."""

CHUNK = 64
"""How many problems a caller solves at once; their quadrature nodes then fit into a processor's cache."""

SMALL = 1e-10
"""An iteration that stops improving with a residual below this is limited by rounding and ends."""


def minimise(
    derivatives: Derivatives, directions: Array, start: Quadratic, tolerance: float, steps: int = 100
) -> tuple[Quadratic, Array]:
    """The best h found by Newton's method from `start` along directions (n, 3, 2), and the residuals (n,).

    A residual is the length of the gradient along the directions over the scale. A problem leaves the
    iteration when its residual is within the tolerance, or below `SMALL` and no longer falling.
    """
    n = len(directions)
    best, stalled = np.full(n, np.inf), np.zeros(n, dtype=int)
    coefficients, discriminant = start.coefficients.copy(), start.discriminant.copy()
    h, active = start, np.arange(n)
    scale, gradient, hessian = derivatives(h, active)
    for _ in range(steps):
        slope = np.einsum("nij,ni->nj", directions[active], gradient)
        residual = np.linalg.norm(slope, axis=1) / scale
        better = residual < best[active]
        improved = active[better]
        best[improved] = residual[better]
        coefficients[improved], discriminant[improved] = h.coefficients[better], h.discriminant[better]
        stalled[active] = np.where(better, 0, stalled[active] + 1)
        going = (best[active] > tolerance) & ~((stalled[active] >= 3) & (best[active] < SMALL))
        active = active[going]
        if not active.size:
            break
        along = directions[active]
        curvature = np.swapaxes(along, 1, 2) @ hessian[going] @ along
        step = (along @ -np.linalg.solve(curvature, slope[going, :, None]))[..., 0]
        h, scale, gradient, hessian = line_search(derivatives, h[going], step, gradient[going], active)
    return Quadratic(coefficients, discriminant), best


def line_search(
    derivatives: Derivatives, h: Quadratic, step: Array, gradient: Array, which: NDArray[np.intp]
) -> tuple[Quadratic, Array, Array, Array]:
    """Take each step, or where it goes too far a part of it that ends with at most half of the first slope.

    The search uses the slope because it is known to more digits than the value. The function is convex, so
    that the slope grows along the step; where the full step goes too far, the zero of the slope is bracketed.
    """
    n = len(which)
    first = (gradient * step).sum(axis=-1)
    share, low, high = np.ones(n), np.zeros(n), np.full(n, np.nan)
    at_low, at_high = first.copy(), np.full(n, np.nan)
    coefficients, discriminant = np.empty((n, 3)), np.empty(n)
    scale, gradient, hessian = np.empty(n), np.empty((n, 3)), np.empty((n, 3, 3))
    todo = np.arange(n)
    for _ in range(60):
        trial = h[todo].plus(share[todo, None] * (step[todo] @ orthonormal()))
        coefficients[todo], discriminant[todo] = trial.coefficients, trial.discriminant
        scale[todo], gradient[todo], hessian[todo] = derivatives(trial, which[todo])
        slope = (gradient[todo] * step[todo]).sum(axis=-1)
        flat = np.abs(slope) <= 0.5 * np.abs(first[todo])
        short = (slope <= 0) & np.isnan(high[todo])
        past = ~(slope <= 0)
        low[todo], high[todo] = (
            np.where(past, low[todo], share[todo]),
            np.where(past, share[todo], high[todo]),
        )
        at_low[todo] = np.where(past, at_low[todo] / 2, slope)
        at_high[todo] = np.where(past, slope, at_high[todo] / 2)
        todo = todo[~(flat | short)]
        if not todo.size:
            break
        split = np.clip(at_low[todo] / (at_low[todo] - at_high[todo]), 0.02, 0.98)
        share[todo] = low[todo] + split * (high[todo] - low[todo])
    return Quadratic(coefficients, discriminant), scale, gradient, hessian
