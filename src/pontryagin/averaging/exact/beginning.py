"""The beginning of a family of exact solutions: members that end shortly after the start.

As the duration vanishes, the cost J grows without limit and y1 falls, steeply at the end. A family whose
first member has a positive y1 therefore has a root of y1, an extremal, before it.
"""

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.exact.members import MemberTable, march
from pontryagin.averaging.exact.shooting import Shooting

BROKEN = 0.25
"""Neighbours whose dJ differs from p_x dtheta by more than this share of y1's range are not of one family."""
NEARER, STEPS = 0.75, 60
"""Ratio of the distances to the start, and number, of members sought before the first one."""


def from_the_start(problem: Shooting, every: MemberTable, small: float) -> MemberTable:
    """The members, with others before the first positive y1, closer and closer, down to a negative one.

    The step across the root is halved until both its ends are seen to be of one family.

    Parameters
    ----------
    problem : Shooting
    every : MemberTable
        Members down to less than half a turn from the start.
    small : float
        Epsilon.
    """
    if every.y[0] < 0 and not _too_steep(every, small):
        return every
    rest = every[1:] if every.y[0] < 0 else every
    gap = float(rest.theta[0]) - problem.anomaly
    for member in march(problem, rest[[0]], problem.anomaly + gap * NEARER ** np.arange(1, STEPS + 1)):
        rest = MemberTable.joined([member, rest])
        if member.y[0] < 0:
            break
    for _ in range(STEPS):
        if not _too_steep(rest, small):
            break
        middle = float(rest.theta[:2].mean())
        between = [*march(problem, rest[[1]], [middle])]
        if not between or between[-1].theta[0] != middle:
            break
        across = between[-1:] if between[-1].y[0] < 0 else [rest[[0]], between[-1]]
        rest = MemberTable.joined([*across, rest[1:]])
    return rest


def _too_steep(every: MemberTable, small: float) -> bool:
    """Whether y1 rises through zero between the first two members so steeply that they look broken apart."""
    rises = len(every.y) > 1 and every.y[0] < 0 <= every.y[1]
    return bool(rises and broken(every, small)[0])


def broken(every: MemberTable, small: float) -> NDArray[np.bool_]:
    """Whether dJ = p_x dtheta fails between neighbours of k members, (k - 1,)."""
    step = np.diff(every.theta)
    expected = small * step * (every.y[:-1] + every.y[1:]) / 2
    size = local_range(every.theta, every.y)
    size = np.maximum(size[:-1], size[1:]) + 1e-3 * np.abs(every.y[:-1])
    failed: NDArray[np.bool_] = np.abs(np.diff(every.cost) - expected) > BROKEN * small * step * size
    return failed


def local_range(theta: Array, y: Array) -> Array:
    """Range of y within a turn on either side of each member."""
    low, high = np.searchsorted(theta, theta - 2 * np.pi), np.searchsorted(theta, theta + 2 * np.pi)
    return np.array([np.ptp(y[i:j]) for i, j in zip(low, high, strict=True)])
