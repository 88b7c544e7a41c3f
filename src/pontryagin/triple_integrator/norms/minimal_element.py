"""The minimal element (1.13) in L_p, 1 < p < infinity: a smooth convex problem in two unknowns, by Newton.

The time to go s is a share of T, and the moments are scaled to length one in a basis of polynomials
orthonormal on [0, 1]. N(h) = (integral of |h|^p)^(1/p) is minimised over the quadratics with
<h, moments> = 1. Its derivative along that plane is the error of the moments of |h|^(p-1) sign h, so that
at the minimum this control has the required moments.
"""

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.triple_integrator.norms.newton import CHUNK, minimise
from pontryagin.triple_integrator.norms.quadrature import (
    Quadratic,
    basis_at,
    first_moments,
    logistic_rule,
    orthonormal,
    second_moments,
)

STEEP = 30.0
"""Where p - 1 or q - 1 exceeds this, the problem with a third of that number is solved first and gives the
starting point."""


@dataclass(frozen=True)
class Plane:
    """The quadratics with <h, w> = 1, for unit vectors w (n, 3) of moments in the orthonormal basis."""

    w: Array

    @property
    def tangent(self) -> Array:
        """Two orthonormal directions along which <h, w> is constant, (n, 3, 2)."""
        return np.swapaxes(np.linalg.svd(self.w[:, None, :])[2][:, 1:, :], 1, 2)

    @property
    def start(self) -> Quadratic:
        """The minimal element of L_2, which is w itself."""
        return Quadratic.of(self.w @ orthonormal())


def minimal_elements(w: Array, q: float) -> tuple[Quadratic, Array]:
    """Minimal elements in L_p, 1/p + 1/q = 1, for unit vectors w (n, 3), and the residuals left (n,)."""
    solved = [_chunk(w[i : i + CHUNK], q) for i in range(0, len(w), CHUNK)]
    coefficients = np.concatenate([h.coefficients for h, _ in solved])
    discriminant = np.concatenate([h.discriminant for h, _ in solved])
    return Quadratic(coefficients, discriminant), np.concatenate([residual for _, residual in solved])


def _chunk(w: Array, q: float) -> tuple[Quadratic, Array]:
    plane = Plane(w)
    h = plane.start
    excess = max(q - 1, 1 / (q - 1))
    stages = [excess]
    while stages[0] > STEEP:
        stages.insert(0, stages[0] / 3)
    for stage in stages:
        p = 1 + (stage if q < 2 else 1 / stage)
        tolerance = 1e-14 if stage == excess else 1e-3
        h, residual = minimise(partial(derivatives, p=p), plane.tangent, h, tolerance)
    return h, residual


def derivatives(h: Quadratic, _: NDArray[np.intp], p: float) -> tuple[Array, Array, Array]:
    """N with its gradient and Hessian in the orthonormal basis: (n,), (n, 3), (n, 3, 3)."""
    rule = logistic_rule()
    s, values, weights = h.sample(rule)
    top = np.abs(values).max(axis=(-2, -1), keepdims=True)
    values = values / top
    with np.errstate(all="ignore"):
        curved = weights * np.abs(values) ** (p - 2)
    curved = np.where(np.isfinite(curved), curved, 0.0)
    steep = curved * values
    power = (steep * values).sum(axis=(-2, -1))
    _add_tails(curved, h, p, rule.step)
    basis = basis_at(s)
    gradient = first_moments(basis, steep) / power[:, None]
    second = second_moments(basis, curved) / power[:, None, None]
    norm = power ** (1 / p)
    hessian = (p - 1) * (second - gradient[:, :, None] * gradient[:, None, :])
    return norm * top[:, 0, 0], gradient * norm[:, None], hessian * (norm / top[:, 0, 0])[:, None, None]


def _add_tails(curved: Array, h: Quadratic, p: float, step: float) -> None:
    """Add the tails of |h|^(p-2) that the rule cuts off at zeros, where it decays only like exp(-(p-1) x)."""
    at_zero = h.cuts[1] == 0
    tail = -np.expm1(-(p - 1) * step)
    curved[..., 0] = np.where(at_zero[..., :-1], curved[..., 0] / tail, curved[..., 0])
    curved[..., -1] = np.where(at_zero[..., 1:], curved[..., -1] / tail, curved[..., -1])
