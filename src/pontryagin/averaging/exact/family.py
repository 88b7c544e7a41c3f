"""The family of exact solutions over the anomaly theta at which they end, turn by turn.

Every member starts at a0 with H = 0, meets the target and the transversality conditions, and ends where the
anomaly is theta. Its phase costate y1 = p_x/epsilon at the end is not zero; since dJ = p_x dtheta along the
family, the extremals of the problem are the roots of y1(theta), and J has its minima where y1 rises through
zero. y1 oscillates once a turn about a slowly changing mean, minus kappa of the averaged problem's family.

From one turn to the next the members change by O(epsilon). So only some of the turns are solved, and those
between them are interpolated (`pontryagin.averaging.exact.turns`).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.exact.beginning import broken, from_the_start
from pontryagin.averaging.exact.members import FAR, MemberTable, chord, close_chord, march, members
from pontryagin.averaging.exact.shooting import Shooting
from pontryagin.averaging.exact.turns import Turn, at, excess, filled, means_at, resolved
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
QUIET_TURNS = 2
"""The search ends after this many turns without a root."""
TURNS = 100_000
"""Largest number of turns that are searched."""
PATIENCE = 2
"""After a turn that was too far ahead, so many are found before the distance grows again."""
PREDICTED = 0.02
"""The distance to the next turn is doubled where y1 was predicted to this share of its range."""
EXTRAPOLATED = 3
"""Number of turns from which the next one is extrapolated."""


@value_class
@dataclass(frozen=True, eq=False)
class Family(MemberTable):
    """Members (s) of the family, by rising theta.

    Attributes
    ----------
    theta : (s,) array
        Anomaly at the end.
    unknowns : (s, n + r) array
        Initial costates and multipliers.
    y, hamiltonian, duration, cost : (s,) array
        p_x/epsilon and h* at the end, slow time and J.
    derivatives : (s, n + r + 1, n + r + 1) array
        Derivatives of the scaled conditions at the end and of y in (unknowns, theta).
    centre : float
        Where the search began.
    limits : tuple of two str
        Why the search ended below and above: "no further root" (y1 stays off zero for whole turns), "turning
        point" (the mean of y1 moves back towards zero), "start" (the duration would vanish) or
        "no solution" (Newton's method found no member).
    """

    centre: float
    limits: tuple[str, str]

    def cut(self, low: float, high: float) -> "Family":
        """The part between two anomalies; a side that loses members gets the limit "no solution"."""
        keep = (self.theta >= low) & (self.theta <= high)
        lower, upper = self.limits
        limits = (lower if keep[0] else "no solution", upper if keep[-1] else "no solution")
        return self.with_columns(self[keep], limits)

    def with_columns(self, found: MemberTable, limits: tuple[str, str] | None = None) -> "Family":
        """The family with other members."""
        return _family(found, self.centre, limits or self.limits)


def _family(found: MemberTable, centre: float, limits: tuple[str, str]) -> Family:
    theta, unknowns, y, hamiltonian, duration, cost, derivatives = found.columns
    return Family(theta, unknowns, y, hamiltonian, duration, cost, derivatives, centre, limits)


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
    solved_turns = resolved(problem, [*reversed(below), first, *above], size)
    every = MemberTable.joined([turn.members for turn in filled(solved_turns, size)])
    small = float(problem.parameters[0])
    if lower == "start":
        every = from_the_start(problem, every, small)
    return _unbroken(_family(every, theta, (lower, upper)), small)


def _first_turn(problem: Shooting, theta: float, unknowns: Array) -> tuple[Turn, int]:
    """The turn about theta, and the number of members that resolves y1, judged by interpolation halfway."""
    size = FEWEST
    while 2 * size < MOST:
        angles = _angles(problem, theta, 2 * size, 0)
        y = _turn_about(problem, theta, unknowns, angles[angles >= theta - 1e-9], "").members.y
        between = (-y[:-6:2] + 9 * y[2:-4:2] + 9 * y[4:-2:2] - y[6::2]) / 16
        missed = np.abs(between - y[3:-3:2]).max(initial=0.0)
        if missed <= RESOLVED * np.ptp(y) or np.ptp(y) <= FLAT * np.abs(y).max():
            break
        size *= 2
    angles = _angles(problem, theta, size, 0)
    return _turn_about(problem, theta, unknowns, angles, "start" if len(angles) < size else ""), size


def _angles(problem: Shooting, theta: float, size: int, turn: int) -> Array:
    """Anomalies after the start for the members of a turn; turn 0 is about theta and has it."""
    step = 2 * np.pi / size
    angles: Array = theta + 2 * np.pi * turn + step * np.arange(-size // 2, size // 2, dtype=float)
    own: NDArray[np.bool_] = (angles == theta) & (theta > problem.anomaly)
    return angles[(angles > problem.anomaly + step / 2) | own]


def _turn_about(problem: Shooting, theta: float, unknowns: Array, angles: Array, below: str) -> Turn:
    try:
        return Turn(0, members(problem, angles, np.tile(unknowns, (len(angles), 1))), (below, ""))
    except NotConverged:
        centre = int(np.argmin(np.abs(angles - theta)))
        middle = members(problem, angles[[centre]], unknowns[None])
        up = list(march(problem, middle, angles[centre + 1 :]))
        down = list(march(problem, middle, angles[:centre][::-1]))
        above = "" if _complete(up, angles[centre + 1 :]) else _reason(problem, up, 1)
        below = below if _complete(down, angles[:centre][::-1]) else _reason(problem, down, -1)
        return Turn(0, MemberTable.joined([*reversed(down), middle, *up]), (below, above))


def _outwards(problem: Shooting, first: Turn, theta: float, size: int, sense: int) -> tuple[list[Turn], str]:
    """Turns beyond the first, by rising distance, and why there are no more."""
    found, quiet, stride, waiting = [first], 0, 1, 0
    beyond: list[Turn] = []
    while not (reason := found[-1].ends[(sense + 1) // 2]):
        last = found[-1]
        report(f"following the exact solutions {'later' if sense > 0 else 'earlier'}, turn {last.number}")
        if abs(last.number) >= TURNS:
            raise NotConverged(
                f"the family of solutions over the ending anomaly has no end within {TURNS} turns",
                float(abs(last.mean)),
            )
        number, waiting = last.number + sense * stride, waiting - 1
        angles = _angles(problem, theta, size, number)
        if stride > 1:
            past = _whole([*found, *beyond], size)
            predicted = Turn(number, at(past, number))
            turn = _leap(problem, past, last, predicted, angles)
            if turn is not None and _goes_on([*past, turn], last, turn):
                found.append(turn)
                easy = excess(predicted.members.y, turn.members.y) < PREDICTED
                stride *= 2 if easy and waiting < 0 else 1
            else:
                beyond += [turn] if turn is not None else []
                stride, waiting = stride // 2, PATIENCE
            continue
        following = _next_turn(problem, found, angles, number, size)
        if following is None:
            near = sense < 0 and last.members.theta[0] - problem.anomaly < np.pi
            return found[1:], "start" if near else "no solution"
        found.append(following)
        quiet = 0 if _has_root(last, following, sense) else quiet + 1
        turned_back = len(found) > 2 and sense * (following.mean - last.mean) < 0
        if quiet >= QUIET_TURNS:
            return found[1:], "no further root"
        if turned_back and not following.ends[(sense + 1) // 2]:
            return found[1:], "turning point"
        if len(_whole(found, size)) > 2 and not quiet and waiting < 0:
            stride = 2
    return found[1:], reason


def _leap(problem: Shooting, past: Sequence[Turn], last: Turn, predicted: Turn, angles: Array) -> Turn | None:
    """A turn some turns ahead, if it is predicted to go on and is found at once."""
    if len(angles) < len(predicted.members.y) or not _goes_on(past, last, predicted):
        return None
    try:
        guess = predicted.members
        solutions = close_chord(problem, angles, guess.unknowns, guess.derivatives)
    except NotConverged:
        return None
    return None if solutions is None else Turn(predicted.number, solutions)


def _goes_on(turns: Sequence[Turn], last: Turn, turn: Turn) -> bool:
    """Whether y1 may vanish in a turn ahead, and its mean keeps its sense on the way there."""
    way = np.arange(last.number, turn.number, 1 if turn.number > last.number else -1, dtype=float)
    means = np.append(means_at(turns, way), turn.mean)
    return _vanishes(turn.members.y, turn.members.y) and bool(
        (np.diff(means) * (turn.number - last.number) >= 0).all()
    )


def _whole(turns: Sequence[Turn], size: int) -> list[Turn]:
    return [turn for turn in turns if len(turn.members.theta) == size]


def _next_turn(
    problem: Shooting, found: Sequence[Turn], angles: Array, number: int, size: int
) -> Turn | None:
    """The members at the angles, extrapolated from the turns before; None where none is found."""
    if len(angles) == 0:
        return None
    last, sense = found[-1], 1 if number > found[-1].number else -1
    ends = ("start" if len(angles) < size else "", "")
    past = _whole(found, size)[-EXTRAPOLATED:]
    try:
        if not past:
            raise NotConverged("there is no earlier turn to extrapolate from", np.inf)
        guess = at(past, number)[slice(size - len(angles), None)]
        return Turn(number, chord(problem, angles, guess.unknowns, guess.derivatives), ends)
    except NotConverged:
        edge = last.members[[0 if sense < 0 else -1]]
        marched = list(march(problem, edge, angles[::sense]))
        if not marched:
            return None
        if not _complete(marched, angles[::sense]):
            reason = _reason(problem, marched, sense)
            ends = (reason, "") if sense < 0 else ("", reason)
        return Turn(number, MemberTable.joined(marched[::sense]), ends)


def _complete(marched: Sequence[MemberTable], angles: Array) -> bool:
    return len(angles) == 0 or (len(marched) > 0 and marched[-1].theta[0] == angles[-1])


def _reason(problem: Shooting, marched: Sequence[MemberTable], sense: int) -> str:
    """Why a march stopped: h* far from zero, less than half a turn left to the start, or something else."""
    if marched and abs(float(marched[-1].hamiltonian[0])) > FAR * problem.price:
        return "no further root"
    if sense < 0 and marched and float(marched[-1].theta[0]) - problem.anomaly < np.pi:
        return "start"
    return "no solution"


def _has_root(last: Turn, following: Turn, sense: int) -> bool:
    """Whether y1 may vanish in the turn, at its members or between them."""
    y = np.concatenate([last.members.y, following.members.y][::sense])
    count = len(following.members.y) + 1
    return _vanishes(y[-count:] if sense > 0 else y[:count], y)


def _vanishes(seen: Array, y: Array) -> bool:
    """Whether y1 may vanish at or between neighbouring members, one turn of which has the values y."""
    reach = BETWEEN * np.ptp(y)
    return bool(seen.min() <= reach and seen.max() >= -reach)


def _unbroken(traced: Family, small: float) -> Family:
    """The part about the centre along which dJ = p_x dtheta holds."""
    apart = broken(traced, small)
    below = traced.theta[1:][apart & (traced.theta[:-1] < traced.centre)]
    above = traced.theta[:-1][apart & (traced.theta[:-1] >= traced.centre)]
    return traced.cut(below.max(initial=-np.inf), above.min(initial=np.inf))
