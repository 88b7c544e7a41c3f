"""Integrals by Gauss's rule on panels, each halved until a further halving no longer changes its integral."""

import functools
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array

Density = Callable[[Array, NDArray[np.intp]], Array]
"""Integrands: a function of arguments (panels, nodes) and of the members (panels,) that they belong to.

It returns the values of all integrands, (panels, nodes, columns).
"""

NODES = 12
"""Nodes of Gauss's rule on each panel."""
STRICT = 1e-14
"""A panel is finished when a halving changes it by less, relative to the integral of the modulus."""
EVERY = slice(None)
"""Selects all columns."""


class Halving(NamedTuple):
    """The number of halvings at ``most``, and the change of a panel's integral that is accepted.

    Where panels are so short that rounding in the integrand dominates, further halving does not reduce the
    change. After ``strict`` halvings the larger relative change ``loose`` is therefore accepted.
    """

    strict: int = 20
    most: int = 40
    loose: float = 1e-10
    nodes: int = NODES


def integral(
    rate: Callable[[Array], Array], edges: ArrayLike, halving: Halving | None = None
) -> tuple[float, bool]:
    """The integral of one function of one argument, smooth between the edges.

    Parameters
    ----------
    rate : function of an array (k,)
        The integrand, (k,).
    edges : (n,) array_like
        Ends of the initial panels, ascending.
    halving : Halving, optional

    Returns
    -------
    float
        The integral.
    bool
        Whether every panel was finished before the halvings were used up.

    Examples
    --------
    >>> value, finished = integral(np.sqrt, [0.0, 0.1, 2.0])
    >>> round(value, 12), finished
    (1.885618083164, True)
    """
    corners = np.asarray(edges, dtype=float)
    every = np.zeros(len(corners) - 1, dtype=np.intp)

    def density(x: Array, _: NDArray[np.intp]) -> Array:
        return rate(x.ravel()).reshape(*x.shape, 1)

    values, finished = integrals(density, every, corners[:-1], corners[1:], halving=halving)
    return float(values[0, 0]), bool(finished[0])


def integrals(
    density: Density,
    member: NDArray[np.intp],
    low: Array,
    high: Array,
    judged: NDArray[np.intp] | slice = EVERY,
    halving: Halving | None = None,
) -> tuple[Array, NDArray[np.bool_]]:
    """Integrals of many functions at once, each over panels of its own.

    Parameters
    ----------
    density : function (x, member) -> columns
        The integrands at x (k, nodes) on panels that belong to ``member`` (k,): (k, nodes, columns).
    member : (panels,) array of int
        The member that each panel belongs to: 0, 1, ..., with at least one panel for each.
    low, high : (panels,) arrays
        Ends of the panels.
    judged : slice or array of int
        The columns that decide whether a panel is fine enough; the others may be their derivatives.
    halving : Halving, optional

    Returns
    -------
    (members, columns) array
        The integrals.
    (members,) array of bool
        Whether all panels of a member were finished; where not, the integral is the best value found.
    """
    rule = halving or Halving()
    value, size = _panels(density, member, low, high, rule.nodes)
    count = int(member.max()) + 1
    scale = np.zeros((count, size.shape[1]))
    np.add.at(scale, member, size)
    result, finished = np.zeros_like(scale), np.ones(count, dtype=bool)
    for step in range(rule.most):
        middle = (low + high) / 2
        left, _ = _panels(density, member, low, middle, rule.nodes)
        right, _ = _panels(density, member, middle, high, rule.nodes)
        change = np.abs(left + right - value)[:, judged]
        own = scale[member][:, judged]
        allowed = (STRICT if step < rule.strict else rule.loose) * np.maximum(
            own, own.max(axis=-1, keepdims=True)
        )
        done = (change <= allowed).all(axis=-1)
        np.add.at(result, member[done], (left + right)[done])
        more = ~done
        member, value = np.tile(member[more], 2), np.concatenate([left[more], right[more]])
        low, high = np.append(low[more], middle[more]), np.append(middle[more], high[more])
        if done.all() or not np.isfinite(change[more]).all():
            break
    np.add.at(result, member, value)
    finished[member] = False
    return result, finished


def _panels(
    density: Density, member: NDArray[np.intp], low: Array, high: Array, nodes: int
) -> tuple[Array, Array]:
    """Integrals of the columns and of their moduli over each panel, (panels, columns) each."""
    at, weights = gauss(nodes)
    length = (high - low)[:, None]
    values = density(low[:, None] + length * at, member)
    scaled = (length * weights)[..., None]
    return (scaled * values).sum(axis=1), (scaled * np.abs(values)).sum(axis=1)


@functools.cache
def gauss(nodes: int) -> tuple[Array, Array]:
    """Nodes and weights of Gauss's rule on the interval from 0 to 1."""
    at, weights = np.polynomial.legendre.leggauss(nodes)
    return (at + 1) / 2, weights / 2
