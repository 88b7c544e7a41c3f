"""The family of exact solutions over the anomaly theta at which they end, turn by turn.

Every member starts at a0 with H = 0, meets the target and the transversality conditions, and ends where the
anomaly is theta. Its phase costate y1 = p_x/epsilon at the end is not zero; since dJ = p_x dtheta along the
family, the extremals of the problem are the roots of y1(theta), and J has its minima where y1 rises through
zero. y1 oscillates once a turn about a slowly changing mean, minus kappa of the averaged problem's family.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pontryagin.arrays import Array
from pontryagin.averaging.exact.members import FAR, chord, march, members
from pontryagin.averaging.exact.shooting import Shooting, Shot
from pontryagin.errors import NotConverged
from pontryagin.progress import report
from pontryagin.value import value_class

FEWEST, MOST = 8, 64
"""Least and largest number of members in a turn."""
RESOLVED = 0.02
"""Largest error of interpolation halfway between members, relative to the range of y1."""
FLAT = 1e-6
"""A range of y1 below this share of its size counts as zero."""
BETWEEN = 0.06
"""Assumed excess of y1 between members over its values at them, relative to its range.

For a sine wave with eight members in a turn it is (1 - cos(pi/8))/2 = 0.04.
"""
BROKEN = 0.25
"""Neighbours whose dJ differs from p_x dtheta by more than this share of y1's range are not of one family."""
QUIET_TURNS = 2
"""The search ends after this many turns without a root."""
TURNS = 100_000
"""Largest number of turns that are searched."""
VALUES = ("y", "hamiltonian", "duration", "cost")
"""Columns of a `Shot` that a `Family` keeps."""
Member = tuple[Array, Array, Shot, Array]
"""theta, unknowns, shot and Jacobian of one member, (1, ...) each."""


@value_class
@dataclass(frozen=True, eq=False)
class Family:
    """Members (s) of the family, by rising theta.

    Attributes
    ----------
    theta : (s,) array
        Anomaly at the end.
    unknowns : (s, n + r) array
        Initial costates and multipliers.
    y, hamiltonian, duration, cost : (s,) array
        p_x/epsilon and h* at the end, slow time and J.
    centre : float
        Where the search began.
    limits : tuple of two str
        Why the search ended below and above: "no further root" (y1 stays off zero for whole turns), "turning
        point" (the mean of y1 moves back towards zero), "start" (the duration would vanish) or
        "no solution" (Newton's method found no member).
    """

    theta: Array
    unknowns: Array
    y: Array
    hamiltonian: Array
    duration: Array
    cost: Array
    centre: float
    limits: tuple[str, str]

    def cut(self, low: float, high: float) -> "Family":
        """The part between two anomalies; a side that loses members gets the limit "no solution"."""
        keep = (self.theta >= low) & (self.theta <= high)
        lower, upper = self.limits
        limits = (lower if keep[0] else "no solution", upper if keep[-1] else "no solution")
        kept = {name: getattr(self, name)[keep] for name in ("theta", "unknowns", *VALUES)}
        return Family(**kept, centre=self.centre, limits=limits)


@dataclass(frozen=True)
class _Turn:
    """Members of one turn, with their Jacobians; `ends` says why the family breaks off below or above."""

    theta: Array
    unknowns: Array
    shot: Shot
    jacobians: Array
    ends: tuple[str, str] = ("", "")

    @property
    def mean(self) -> float:
        return float(self.shot.y.mean())


def family(problem: Shooting, theta: float, unknowns: Array) -> Family:
    """Trace the family outwards from a guess of the member that ends at theta, until no root is left.

    Raises
    ------
    NotConverged
        If Newton's method finds no member from the guess.
    """
    first, size = _first_turn(problem, theta, unknowns)
    below, lower = _outwards(problem, first, theta, size, -1)
    above, upper = _outwards(problem, first, theta, size, 1)
    turns = [*reversed(below), first, *above]
    shots = [turn.shot for turn in turns]
    values = {name: np.concatenate([getattr(shot, name) for shot in shots]) for name in VALUES}
    traced = Family(
        theta=np.concatenate([turn.theta for turn in turns]),
        unknowns=np.concatenate([turn.unknowns for turn in turns]),
        **values,
        centre=theta,
        limits=(lower, upper),
    )
    return _unbroken(traced, float(problem.parameters[0]))


def _first_turn(problem: Shooting, theta: float, unknowns: Array) -> tuple[_Turn, int]:
    """The turn about theta, and the number of members that resolves y1, judged by interpolation halfway."""
    size = FEWEST
    while 2 * size < MOST:
        angles = _angles(problem, theta, 2 * size, 0)
        y = _turn_about(problem, theta, unknowns, angles[angles >= theta - 1e-9], "").shot.y
        between = (-y[:-6:2] + 9 * y[2:-4:2] + 9 * y[4:-2:2] - y[6::2]) / 16
        missed = np.abs(between - y[3:-3:2]).max(initial=0.0)
        if missed <= RESOLVED * np.ptp(y) or np.ptp(y) <= FLAT * np.abs(y).max():
            break
        size *= 2
    angles = _angles(problem, theta, size, 0)
    return _turn_about(problem, theta, unknowns, angles, "start" if len(angles) < size else ""), size


def _angles(problem: Shooting, theta: float, size: int, turn: int) -> Array:
    """Anomalies after the start for the members of a turn; turn 0 is the one about theta."""
    step = 2 * np.pi / size
    angles: Array = theta + 2 * np.pi * turn + step * np.arange(-size // 2, size // 2, dtype=float)
    return angles[angles > problem.anomaly + step / 2]


def _turn_about(problem: Shooting, theta: float, unknowns: Array, angles: Array, below: str) -> _Turn:
    try:
        found = members(problem, angles, np.tile(unknowns, (len(angles), 1)))
        return _Turn(angles, *found, (below, ""))
    except NotConverged:
        centre = int(np.argmin(np.abs(angles - theta)))
        middle = members(problem, angles[[centre]], unknowns[None])
        up = list(march(problem, angles[centre], middle, angles[centre + 1 :]))
        down = list(march(problem, angles[centre], middle, angles[:centre][::-1]))
        above = "" if _complete(up, angles[centre + 1 :]) else _reason(problem, up, 1)
        below = below if _complete(down, angles[:centre][::-1]) else _reason(problem, down, -1)
        return _joined([*reversed(down), (angles[[centre]], *middle), *up], (below, above))


def _outwards(
    problem: Shooting, first: _Turn, theta: float, size: int, sense: int
) -> tuple[list[_Turn], str]:
    """Turns beyond the first, and why there are no more."""
    last, history, quiet = first, [first], 0
    found: list[_Turn] = []
    while not (reason := last.ends[(sense + 1) // 2]):
        report(f"following the exact solutions {'later' if sense > 0 else 'earlier'}, turn {len(found) + 1}")
        if len(found) == TURNS:
            raise NotConverged(
                f"the family of solutions over the ending anomaly has no end within {TURNS} turns",
                float(abs(last.mean)),
            )
        angles = _angles(problem, theta, size, sense * (len(found) + 1))
        following = _next_turn(problem, history, angles, size, sense)
        if following is None:
            near = sense < 0 and last.theta[0] - problem.anomaly < np.pi
            return found, "start" if near else "no solution"
        found.append(following)
        history = [*history[-2:], following]
        quiet = 0 if _has_root(last, following, sense) else quiet + 1
        turned_back = len(found) >= 2 and sense * (following.mean - last.mean) < 0
        last = following
        if quiet >= QUIET_TURNS:
            return found, "no further root"
        if turned_back and not following.ends[(sense + 1) // 2]:
            return found, "turning point"
    return found, reason


def _next_turn(problem: Shooting, history: list[_Turn], angles: Array, size: int, sense: int) -> _Turn | None:
    """The members at the angles, extrapolated from the turns before; None where none is found."""
    if len(angles) == 0:
        return None
    ends = ("start" if len(angles) < size else "", "")
    past = [turn for turn in history if len(turn.theta) == size]
    guesses = [turn.unknowns[size - len(angles) :] for turn in past]
    weights = {1: [1.0], 2: [-1.0, 2.0], 3: [1.0, -3.0, 3.0]}.get(len(past))
    try:
        if weights is None:
            raise NotConverged("there is no earlier turn to extrapolate from", np.inf)
        guess = np.einsum("i,i...->...", np.array(weights), np.array(guesses))
        jacobians = past[-1].jacobians[size - len(angles) :]
        return _Turn(angles, *chord(problem, angles, guess, jacobians), ends)
    except NotConverged:
        last, end = history[-1], min(sense, 0) * -1 - 1
        edge = (last.unknowns[[end]], last.shot[[end]], last.jacobians[[end]])
        marched = list(march(problem, float(last.theta[end]), edge, angles[::sense]))
        if not marched:
            return None
        if not _complete(marched, angles[::sense]):
            reason = _reason(problem, marched, sense)
            ends = (reason, "") if sense < 0 else ("", reason)
        return _joined(marched[::sense], ends)


def _complete(marched: Sequence[Member], angles: Array) -> bool:
    return len(angles) == 0 or (len(marched) > 0 and marched[-1][0][0] == angles[-1])


def _reason(problem: Shooting, marched: Sequence[Member], sense: int) -> str:
    """Why a march stopped: h* far from zero, less than half a turn left to the start, or something else."""
    if marched and abs(float(marched[-1][2].hamiltonian[0])) > FAR * problem.price:
        return "no further root"
    if sense < 0 and marched and float(marched[-1][0][0]) - problem.anomaly < np.pi:
        return "start"
    return "no solution"


def _has_root(last: _Turn, following: _Turn, sense: int) -> bool:
    """Whether y1 may vanish in the turn, at its members or between them."""
    y = np.concatenate([last.shot.y, following.shot.y][::sense])
    seen = y[-len(following.theta) - 1 :] if sense > 0 else y[: len(following.theta) + 1]
    reach = BETWEEN * np.ptp(y)
    return bool(seen.min() <= reach and seen.max() >= -reach)


def _joined(parts: Sequence[Member], ends: tuple[str, str]) -> _Turn:
    theta, w, shots, jacobians = zip(*parts, strict=True)
    return _Turn(
        np.concatenate(theta), np.concatenate(w), Shot.joined(shots), np.concatenate(jacobians), ends
    )


def local_range(theta: Array, y: Array) -> Array:
    """Range of y within a turn on either side of each member."""
    low, high = np.searchsorted(theta, theta - 2 * np.pi), np.searchsorted(theta, theta + 2 * np.pi)
    return np.array([np.ptp(y[i:j]) for i, j in zip(low, high, strict=True)])


def _unbroken(traced: Family, small: float) -> Family:
    """The part about the centre along which dJ = p_x dtheta holds."""
    step = np.diff(traced.theta)
    expected = small * step * (traced.y[:-1] + traced.y[1:]) / 2
    size = local_range(traced.theta, traced.y)
    size = np.maximum(size[:-1], size[1:]) + 1e-3 * np.abs(traced.y[:-1])
    broken = np.abs(np.diff(traced.cost) - expected) > BROKEN * small * step * size
    below = traced.theta[1:][broken & (traced.theta[:-1] < traced.centre)]
    above = traced.theta[:-1][broken & (traced.theta[:-1] >= traced.centre)]
    return traced.cut(below.max(initial=-np.inf), above.min(initial=np.inf))
