"""Gauss's rules for integrals of powers of a quadratic, in tables that the solver's kernel reads."""

from functools import lru_cache
from math import exp
from typing import NamedTuple

import numpy as np

from pontryagin.arrays import Array
from pontryagin.numerics.quadrature import gauss
from pontryagin.triple_integrator.norms.power_integrals import HEAD


class Grade(NamedTuple):
    """How fine a rule is.

    Attributes
    ----------
    nodes : int
        Nodes on each panel.
    ratio : float
        Largest difference of log h over a panel.
    steepness : float
        Largest difference of p log h over a panel.
    depth : float
        Parts of a piece on which |h|^(p-1/2) is smaller than at its top by more than exp(-depth) are left
        out: next to a double zero their share in the integral of |h|^(p-1) is as small.
    reach : float
        How far the rule for zeros reaches over convex pieces, in distances of the two zeros.
    """

    nodes: int
    ratio: float
    steepness: float
    depth: float
    reach: float

    @property
    def size(self) -> int:
        """How many numbers a rule holds."""
        return HEAD + 4 * self.nodes + 1


COARSE = Grade(8, 1.1, 4.0, 10.0, 2.0)
"""For all steps but the last: three digits or more."""

FINE = Grade(16, 1.1, 8.0, 40.0, 2.0)
"""For the last steps."""

INDEPENDENT = Grade(18, 0.9, 10.0, 40.0, 1.3)
"""For the certificate: other nodes on other panels than those of the solver."""


def gauss_jacobi(nodes: int, p: float) -> tuple[Array, Array]:
    """Nodes and weights on [0, 1] for integrals with the weight t^(p-1), by Golub and Welsch.

    Examples
    --------
    >>> t, w = gauss_jacobi(3, 1.5)
    >>> bool(np.isclose((w * t**4).sum(), 1 / (1.5 + 4)))
    True
    """
    b, i = p - 1.0, np.arange(1, nodes)
    even = 2 * i + b
    diagonal = np.append(b / (b + 2), b / even * (b / (even + 2)))
    beside = 2 * i * (i + b) / even / np.sqrt((even + 1) * (even - 1))
    places, vectors = np.linalg.eigh(np.diag(diagonal) + np.diag(beside, 1) + np.diag(beside, -1))
    return (1 + places) / 2, vectors[0] ** 2 / p


def rule(grade: Grade, p: float) -> Array:
    """The numbers of one rule, as `power_integrals.HEAD` describes them."""
    n = grade.nodes
    smooth, (places, weights) = gauss(n), gauss_jacobi(n, p)
    factor = exp(-min(grade.ratio, grade.steepness / p))
    concave = 1.0 if p <= 1.5 * n else -1.0
    head = [p, n, factor, grade.depth / (p - 0.5), grade.reach, concave]
    at_zero = max(1 / (p - 1) - (weights / places).sum(), 0.0)
    return np.concatenate([head, *smooth, places, weights / places, [at_zero]])


def stages(q: float) -> list[float]:
    """The exponents p for which the problem is solved one after the other, the last being that of q.

    For the first of them Newton's method converges from the minimal element of L_2.
    """
    excess = max(q - 1, 1 / (q - 1))
    factor = 5.0 if q > 2 else 3.0
    following = [excess]
    while following[0] > factor:
        following.insert(0, following[0] / factor)
    return [1 + (stage if q < 2 else 1 / stage) for stage in following]


@lru_cache(maxsize=64)
def table(q: float) -> bytes:
    """The number of stages, the coarse rule of each, the fine rule and the independent one."""
    exponents = stages(q)
    rules = [rule(COARSE, p) for p in exponents]
    rules += [rule(grade, exponents[-1]) for grade in (FINE, INDEPENDENT)]
    return np.concatenate([[len(exponents)], *rules]).tobytes()
