"""The regularised Hamiltonian K = (S(|n|^2) + c) dt/ds + l_L with its derivatives in elements and costates.

The derivation gives the derivatives of n and of dt/ds; K is made of them by the chain rule.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from pontryagin.arrays import Array
from pontryagin.numerics.jit import batched
from pontryagin.rendezvous.kernels import (
    SWITCHING_CURVATURES,
    SWITCHING_SLOPES,
    WEIGHT_CURVATURES,
    WEIGHT_SLOPES,
    equinoctial_switching,
    equinoctial_switching_curvatures,
    equinoctial_switching_slopes,
    equinoctial_weight_slopes,
)

VARIABLES = 12
"""Six elements and six costates."""
LENGTHS = (
    3,
    *map(len, (SWITCHING_SLOPES, SWITCHING_CURVATURES)),
    1,
    *map(len, (WEIGHT_SLOPES, WEIGHT_CURVATURES)),
)
"""Numbers of the components, slopes and curvatures that `derivatives` returns, of n and then of dt/ds."""


def derivatives(  # type: ignore[no-untyped-def]
    p, f, g, h, k, L, l_p, l_f, l_g, l_h, l_k, l_L
):
    """n and dt/ds with their derivatives that do not vanish; curvatures are of (m, n) with m = n constant."""
    n = equinoctial_switching_slopes(p, f, g, h, k, L, l_p, l_f, l_g, l_h, l_k, l_L)
    bends = equinoctial_switching_curvatures(p, f, g, h, k, L, l_p, l_f, l_g, l_h, l_k, l_L, n[0], n[1], n[2])
    return n + bends + equinoctial_weight_slopes(p, f, g, L)


at_nodes = batched(derivatives, outputs=sum(LENGTHS))
_STARTS = np.cumsum((0, *LENGTHS))


def _places(shape: tuple[int, ...], part: int, keys: Sequence[Any]) -> Array:
    """For each entry of an array of derivatives, in which column it stands; the last column holds zeros."""
    places = np.full(shape, _STARTS[-1])
    for offset, key in enumerate(keys):
        places[key] = _STARTS[part] + offset
    return np.asarray(places.ravel())


_SLOPES = _places((3, VARIABLES), 1, SWITCHING_SLOPES)
_WEIGHT_SLOPES = _places((VARIABLES,), 4, WEIGHT_SLOPES)


def _symmetric(part: int, keys: Sequence[Any]) -> Array:
    shape = (VARIABLES, VARIABLES)
    upper = _places(shape, part, keys).reshape(shape)
    return np.asarray(np.minimum(upper, upper.T).ravel())


_CURVATURES = _symmetric(2, SWITCHING_CURVATURES)
_WEIGHT_CURVATURES = _symmetric(5, WEIGHT_CURVATURES)


class Cost(Protocol):
    """A running cost that depends on the length of the thrust."""

    @property
    def time_weight(self) -> float:
        """The cost without thrust."""

    def gain(self, square: Array) -> tuple[Array, Array, Array]:
        """S, the largest (n, p) less what the thrust costs, with its first two derivatives in |n|^2."""


@dataclass(frozen=True)
class RunningCost:
    """alpha1 + alpha2 p^2 under a bound on the thrust, with alpha2 = 0 for least time."""

    time_weight: float
    energy_weight: float
    peak: float

    def gain(self, square: Array) -> tuple[Array, Array, Array]:
        """S, the largest (n, p) - alpha2 p^2, with its first two derivatives, as functions of |n|^2."""
        weight, peak = self.energy_weight, self.peak
        if peak < math.inf:
            size = np.sqrt(square)
            slope = peak / (2 * size)
            saturated = peak * size - weight * peak**2, slope, -slope / (2 * square)
        inside = square <= (2 * weight * peak) ** 2
        if peak < math.inf and not inside.any():
            return saturated
        within = square / (4 * weight), np.full_like(square, 1 / (4 * weight)), np.zeros_like(square)
        if inside.all() or peak == math.inf:
            return within
        first, second, third = (np.where(inside, a, b) for a, b in zip(within, saturated, strict=True))
        return first, second, third


def square(nodes: Array) -> Array:
    """|n|^2 at elements and costates (12, ...)."""
    n = np.array(equinoctial_switching(*nodes))
    return np.asarray((n * n).sum(axis=0))


@dataclass(frozen=True, eq=False)
class Hamiltonian:
    """K and its derivatives at n nodes.

    Attributes
    ----------
    value : (n,) array
        K.
    slopes : (n, 12) array
        Its derivatives in elements and costates.
    curvatures : (n, 12, 12) array
        Its second derivatives.
    weight : (n,) array
        dt/ds, which is the derivative of K in c.
    weight_slopes : (n, 12) array
        The derivatives of dt/ds.
    gain : (n,) array
        S.
    gain_slopes : (n, 12) array
        Its derivatives.
    """

    value: Array
    slopes: Array
    curvatures: Array
    weight: Array
    weight_slopes: Array
    gain: Array
    gain_slopes: Array


def hamiltonian(cost: Cost, nodes: Array, price: float) -> Hamiltonian:
    """K and its derivatives at elements and costates (12, n), for the price c of time."""
    count = nodes.shape[1]
    found = np.zeros((count, _STARTS[-1] + 1))
    found[:, :-1] = at_nodes(*nodes)
    n, weight = found[:, :3], found[:, _STARTS[3]]
    n_slopes = found[:, _SLOPES].reshape(count, 3, VARIABLES)
    weight_slopes = found[:, _WEIGHT_SLOPES]
    gain, slope, bend = cost.gain(np.einsum("ij,ij->i", n, n))
    of_square = 2 * np.einsum("ij,ijk->ik", n, n_slopes)
    gain_slopes = slope[:, None] * of_square
    by_weight = gain_slopes[:, :, None] * weight_slopes[:, None, :]
    curvatures = (
        (gain + price)[:, None, None] * found[:, _WEIGHT_CURVATURES].reshape(count, VARIABLES, VARIABLES)
        + by_weight
        + by_weight.transpose(0, 2, 1)
        + (bend * weight)[:, None, None] * of_square[:, :, None] * of_square[:, None, :]
        + (2 * slope * weight)[:, None, None]
        * (
            n_slopes.transpose(0, 2, 1) @ n_slopes
            + found[:, _CURVATURES].reshape(count, VARIABLES, VARIABLES)
        )
    )
    slopes = (gain + price)[:, None] * weight_slopes + gain_slopes * weight[:, None]
    slopes[:, -1] += 1
    value = (gain + price) * weight + nodes[-1]
    return Hamiltonian(value, slopes, curvatures, weight, weight_slopes, gain, gain_slopes)
