"""The family of exact solutions over the anomaly theta at which they end, turn by turn.

Every member starts at a0 with H = 0, meets the target and the transversality conditions, and ends where the
anomaly is theta. Its phase costate y1 = p_x/epsilon at the end is not zero; since dJ = p_x dtheta along the
family, the extremals of the problem are the roots of y1(theta), and J has its minima where y1 rises through
zero. y1 oscillates once a turn about a slowly changing mean, minus kappa of the averaged problem's family.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pontryagin.averaging.shooting import Shooting, Shot
from pontryagin.errors import NotConverged

Array = NDArray[np.float64]

FEWEST, MOST = 8, 256
"""Members a turn."""
RESOLVED = 0.02
"""How well, in shares of y1's range, members must tell what is halfway between them."""
CLOSE = 1e-7
"""Residual of a member; the roots are polished."""
SWEEPS, QUICK = 20, 6
"""Newton steps allowed from a rough guess, and from a neighbour."""
QUIET_TURNS = 2
"""Turns without a root after which the search ends."""
TURNS = 100_000


@dataclass(frozen=True)
class Family:
    """Members (s) of the family, by rising theta.

    Attributes
    ----------
    theta : (s,) array
        Anomaly at the end.
    unknowns : (s, n + r) array
        Initial costates and multipliers.
    y, duration, cost : (s,) array
        p_x/epsilon at the end, slow time and J.
    limits : tuple of two str
        Why the search ended below and above: "no further root" (y1 keeps off zero for whole turns), "turning
        point" (the mean of y1 moves back towards zero), "start" (the duration would vanish) or
        "no solution" (Newton's method found no member).
    """

    theta: Array
    unknowns: Array
    y: Array
    duration: Array
    cost: Array
    limits: tuple[str, str]


@dataclass(frozen=True)
class _Turn:
    """Members of one turn, with the Jacobians that serve the next one."""

    theta: Array
    unknowns: Array
    shot: Shot
    jacobians: Array

    @property
    def mean(self) -> float:
        return float(self.shot.y.mean())


def family(problem: Shooting, theta: float, unknowns: Array) -> Family:
    """Trace the family outwards from a guess of the member that ends at theta, until no root is left.

    Raises
    ------
    NotConverged
        If the guess leads to no member.
    """
    first = _first_turn(problem, theta, unknowns)
    below, lower = _outwards(problem, first, -1)
    above, upper = _outwards(problem, first, 1)
    turns = [*reversed(below), first, *above]
    shots = [turn.shot for turn in turns]
    return Family(
        np.concatenate([turn.theta for turn in turns]),
        np.concatenate([turn.unknowns for turn in turns]),
        *(np.concatenate([getattr(shot, name) for shot in shots]) for name in ("y", "duration", "cost")),
        (lower, upper),
    )


def members(
    problem: Shooting, theta: Array, guess: Array, sweeps: int = SWEEPS
) -> tuple[Array, Shot, Array]:
    """Unknowns, shots and Jacobians of the members that end at theta (k,), by damped Newton.

    Raises
    ------
    NotConverged
        If some residual is not brought under `CLOSE`.
    """
    w = guess
    for _ in range(sweeps):
        shot, slopes = problem.slopes(theta, w)
        if (shot.error <= CLOSE).all():
            return w, shot, slopes.residual_w
        step = -np.linalg.solve(slopes.residual_w, shot.residual[..., None])[..., 0]
        w = _damped(problem, theta, w, step, shot.error)
    raise NotConverged("Newton's method found no extremal that ends there", float(shot.error.max()))


def _damped(problem: Shooting, theta: Array, w: Array, step: Array, error: Array) -> Array:
    """w + share step, the share halved where the residual does not fall."""
    share = np.ones(len(w))
    for _ in range(5):
        try:
            trial = problem.shoot(theta, w + share[:, None] * step).error
        except (NotConverged, FloatingPointError):
            share = share / 2
            continue
        worse = ~(trial <= (1 - share / 4) * error) & (error > CLOSE)
        if not worse.any():
            break
        share = np.where(worse, share / 2, share)
    else:
        raise NotConverged("Newton's method found no extremal that ends there", float(error.max()))
    return w + share[:, None] * step


def _first_turn(problem: Shooting, theta: float, unknowns: Array) -> _Turn:
    """As many members as resolve y1: those halfway between must be what their neighbours tell."""
    size = FEWEST
    while True:
        turn = _turn_about(problem, theta, unknowns, 2 * size)
        y = turn.shot.y
        between = (-y[:-6:2] + 9 * y[2:-4:2] + 9 * y[4:-2:2] - y[6::2]) / 16
        missed = np.abs(between - y[3:-3:2][: len(between)]).max()
        if missed <= RESOLVED * np.ptp(y) or np.ptp(y) <= 1e-6 * np.abs(y).max() or 2 * size > MOST:
            return _Turn(turn.theta[::2], turn.unknowns[::2], _every_second(turn.shot), turn.jacobians[::2])
        size *= 2


def _turn_about(problem: Shooting, theta: float, unknowns: Array, size: int) -> _Turn:
    step = 2 * np.pi / size
    angles = theta + step * np.arange(-size // 2, size // 2)
    angles = angles[angles > problem.anomaly + step / 2]
    try:
        return _Turn(angles, *members(problem, angles, np.tile(unknowns, (len(angles), 1))))
    except NotConverged:
        centre = int(np.argmin(np.abs(angles - theta)))
        middle = members(problem, angles[[centre]], unknowns[None])
        up = list(_march(problem, angles[centre], middle, angles[centre + 1 :]))
        down = list(_march(problem, angles[centre], middle, angles[:centre][::-1]))
        return _joined([*reversed(down), (angles[[centre]], *middle), *up])


def _outwards(problem: Shooting, first: _Turn, sense: int) -> tuple[list[_Turn], str]:
    """Turns beyond the first, and why there are no more."""
    history, found, quiet = [first], [], 0
    while len(found) < TURNS:
        last = history[-1]
        angles = first.theta + sense * 2 * np.pi * (len(found) + 1)
        step = first.theta[1] - first.theta[0]
        if len(last.theta) < len(first.theta) or (angles <= problem.anomaly + step / 2).any():
            angles = angles[angles > problem.anomaly + step / 2]
        following, complete = _next_turn(problem, history, angles, sense)
        if following is not None:
            found.append(following)
            history = [*history[-2:], following]
        if not complete:
            return found, "start" if sense < 0 and _near_start(problem, found, first) else "no solution"
        if len(angles) < len(first.theta):
            return found, "start"
        quiet = 0 if _has_root(last, following, sense) else quiet + 1
        if quiet >= QUIET_TURNS:
            return found, "no further root"
        if len(found) >= 2 and sense * (following.mean - last.mean) < 0:
            return found, "turning point"
    raise NotConverged("the family has no end", float(abs(last.mean)))


def _next_turn(
    problem: Shooting, history: list[_Turn], angles: Array, sense: int
) -> tuple[_Turn | None, bool]:
    """The members at the angles, and whether all were found; guessed from the turns before."""
    size = len(angles)
    if size == 0:
        return None, False
    past = [turn for turn in history if len(turn.theta) >= size]
    cut = slice(-size, None) if sense < 0 else slice(0, size)
    before = [turn.unknowns[cut] for turn in past]
    weights = {0: [], 1: [1.0], 2: [-1.0, 2.0]}.get(len(before), [1.0, -3.0, 3.0])
    try:
        if not before:
            raise NotConverged("no turn before", np.inf)
        guess = sum(weight * w for weight, w in zip(weights, before[-3:], strict=True))
        jacobians = past[-1].jacobians[cut]
        return _Turn(angles, *_chord(problem, angles, guess, jacobians)), True
    except NotConverged:
        last = history[-1]
        end = -1 if sense > 0 else 0
        edge = (last.unknowns[[end]], _pick(last.shot, [end]), last.jacobians[[end]])
        marched = list(_march(problem, float(last.theta[end]), edge, angles[::sense]))
        if not marched:
            return None, False
        return _joined(marched[::sense]), len(marched) == size


def _chord(problem: Shooting, theta: Array, w: Array, jacobians: Array) -> tuple[Array, Shot, Array]:
    """Newton's method with the Jacobians of the turn before, corrected by Broyden; exact ones if slow."""
    shot = problem.shoot(theta, w)
    jacobians = jacobians.copy()
    for _ in range(6):
        if (shot.error <= CLOSE).all():
            return w, shot, jacobians
        step = -np.linalg.solve(jacobians, shot.residual[..., None])[..., 0]
        following = problem.shoot(theta, w + step)
        if not (following.error <= np.maximum(0.3 * shot.error, CLOSE)).all():
            break
        length = np.maximum((step**2).sum(axis=-1), 1e-300)
        unexplained = following.residual / length[:, None]
        jacobians += unexplained[:, :, None] * step[:, None, :]
        w, shot = w + step, following
    return members(problem, theta, w)


def _march(
    problem: Shooting, theta: float, edge: tuple[Array, Shot, Array], angles: Iterable[float]
) -> Iterable[tuple[Array, Array, Shot, Array]]:
    """Member after member from the edge, each guessed from the one before; ends where none is found."""
    w = edge[0]
    for angle in angles:
        try:
            while theta != angle:
                theta, w, found = _advance(problem, theta, w, angle)
        except NotConverged:
            return
        yield (np.array([angle]), *found)


def _advance(problem: Shooting, theta: float, w: Array, angle: float):
    """One step towards the angle, as long as Newton's method follows."""
    _, slopes = problem.slopes(np.array([theta]), w)
    reach = angle - theta
    for _ in range(5):
        try:
            guess = w + reach * slopes.along[0]
            found = members(problem, np.array([theta + reach]), guess, QUICK)
            return (angle if reach == angle - theta else theta + reach), found[0], found
        except NotConverged:
            reach /= 2
    raise NotConverged("the family of solutions ends", abs(reach))


def _has_root(last: _Turn, following: _Turn, sense: int) -> bool:
    edge = last.shot.y[-1:] if sense > 0 else last.shot.y[:1]
    y = np.concatenate([edge, following.shot.y])
    return bool(y.min() <= 0 <= y.max())


def _near_start(problem: Shooting, found: list[_Turn], first: _Turn) -> bool:
    reached = found[-1].theta[0] if found else first.theta[0]
    return reached - problem.anomaly < np.pi


def _joined(parts: list[tuple[Array, Array, Shot, Array]]) -> _Turn:
    theta, w, shots, jacobians = zip(*parts, strict=True)
    merged = Shot(*(np.concatenate([getattr(s, name) for s in shots]) for name in Shot.__dataclass_fields__))
    return _Turn(np.concatenate(theta), np.concatenate(w), merged, np.concatenate(jacobians))


def _pick(shot: Shot, index) -> Shot:
    return Shot(*(getattr(shot, name)[index] for name in Shot.__dataclass_fields__))


def _every_second(shot: Shot) -> Shot:
    return _pick(shot, slice(None, None, 2))
