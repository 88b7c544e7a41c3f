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
BETWEEN = 0.06
"""How far, in shares of its range, y1 may reach beyond its members: (1 - cos(pi/8))/2 is 0.04."""
BROKEN = 0.25
"""Error of dJ = p_x dtheta between neighbours, in shares of y1's range, that tells they are not kin."""
QUIET_TURNS = 2
"""Turns without a root after which the search ends."""
TURNS = 100_000
VALUES = ("y", "hamiltonian", "duration", "cost")


@dataclass(frozen=True)
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
        Why the search ended below and above: "no further root" (y1 keeps off zero for whole turns), "turning
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
        """The part between two anomalies; where it loses members, no solution was found beyond."""
        keep = (self.theta >= low) & (self.theta <= high)
        lower, upper = self.limits
        limits = (lower if keep[0] else "no solution", upper if keep[-1] else "no solution")
        columns = (getattr(self, name)[keep] for name in ("theta", "unknowns", *VALUES))
        return Family(*columns, self.centre, limits)


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
    traced = Family(
        np.concatenate([turn.theta for turn in turns]),
        np.concatenate([turn.unknowns for turn in turns]),
        *(np.concatenate([getattr(shot, name) for shot in shots]) for name in VALUES),
        theta,
        (lower, upper),
    )
    return _unbroken(traced, float(problem.parameters[0]))


def local_range(theta: Array, y: Array) -> Array:
    """Range of y within a turn of each member."""
    low, high = np.searchsorted(theta, theta - 2 * np.pi), np.searchsorted(theta, theta + 2 * np.pi)
    return np.array([np.ptp(y[i:j]) for i, j in zip(low, high, strict=True)])


def _unbroken(traced: Family, small: float) -> Family:
    """The part about the centre along which the cost changes as y1 says."""
    step = np.diff(traced.theta)
    expected = small * step * (traced.y[:-1] + traced.y[1:]) / 2
    size = local_range(traced.theta, traced.y)
    size = np.maximum(size[:-1], size[1:]) + 1e-3 * np.abs(traced.y[:-1])
    broken = np.abs(np.diff(traced.cost) - expected) > BROKEN * small * step * size
    below = traced.theta[1:][broken & (traced.theta[:-1] < traced.centre)]
    above = traced.theta[:-1][broken & (traced.theta[:-1] >= traced.centre)]
    return traced.cut(below.max(initial=-np.inf), above.min(initial=np.inf))


def members(problem: Shooting, theta: Array, guess: Array, sweeps: int = SWEEPS) -> tuple[Array, Shot, Array]:
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
            return _Turn(turn.theta[::2], turn.unknowns[::2], turn.shot[::2], turn.jacobians[::2])
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
        up = list(march(problem, angles[centre], middle, angles[centre + 1 :]))
        down = list(march(problem, angles[centre], middle, angles[:centre][::-1]))
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
        edge = (last.unknowns[[end]], last.shot[[end]], last.jacobians[[end]])
        marched = list(march(problem, float(last.theta[end]), edge, angles[::sense]))
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
    return members(problem, theta, w, QUICK)


def march(
    problem: Shooting, theta: float, edge: tuple[Array, Shot, Array], angles: Iterable[float]
) -> Iterable[tuple[Array, Array, Shot, Array]]:
    """Member after member from the edge, each guessed from the ones before; ends where none is found."""
    w, _, jacobians = edge
    _, slopes = problem.slopes(np.array([theta]), w)
    tangent = slopes.along[0]
    for angle in angles:
        while theta != angle:
            for halvings in range(6):
                target = angle if halvings == 0 else theta + (angle - theta) / 2**halvings
                try:
                    found = _chord(problem, np.array([target]), w + (target - theta) * tangent, jacobians)
                    break
                except NotConverged:
                    continue
            else:
                return
            tangent = (found[0] - w) / (target - theta)
            theta, (w, _, jacobians) = target, found
        yield (np.array([angle]), *found)


def _has_root(last: _Turn, following: _Turn, sense: int) -> bool:
    """Whether y1 vanishes in the turn, between its members too."""
    y = np.concatenate([last.shot.y, following.shot.y][::sense])
    seen = y[-len(following.theta) - 1 :] if sense > 0 else y[: len(following.theta) + 1]
    reach = BETWEEN * np.ptp(y)
    return bool(seen.min() <= reach and seen.max() >= -reach)


def _near_start(problem: Shooting, found: list[_Turn], first: _Turn) -> bool:
    reached = found[-1].theta[0] if found else first.theta[0]
    return reached - problem.anomaly < np.pi


def _joined(parts: list[tuple[Array, Array, Shot, Array]]) -> _Turn:
    theta, w, shots, jacobians = zip(*parts, strict=True)
    return _Turn(np.concatenate(theta), np.concatenate(w), Shot.joined(shots), np.concatenate(jacobians))
