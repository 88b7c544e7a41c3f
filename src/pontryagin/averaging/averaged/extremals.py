"""Averaged extremals by collocation: Newton's method, further guesses where it fails, mesh refinement."""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.certified import AveragedExtremals, Found, certified, joined
from pontryagin.averaging.averaged.collocation import CLOSE, Problem, Trajectories, newton
from pontryagin.averaging.averaged.followed import followed
from pontryagin.averaging.averaged.guess import shot, straight, towards_target
from pontryagin.averaging.averaged.refinement import COARSE, ENOUGH, FINE, GRADED, foreseen, resolved
from pontryagin.averaging.averaged.soundness import point, require_sound, which
from pontryagin.averaging.system.model import Model
from pontryagin.errors import NotConverged

LEAST_SHARE = 1e-3
"""Shortest step of the continuation, as a share of the distance to the target."""
AT_ONCE = 64
"""Number of problems solved together; more would take more memory and no less time per problem."""


def extremals(
    model: Model, names: Sequence[str], start: Array, numbers: tuple[Array, ...], kappa: Array
) -> AveragedExtremals:
    """Solve a stack of problems: start (s, n), numbers and kappa (s).

    Raises
    ------
    ValueError
        If the frequency is not positive along the way, or the running cost is not positive on average.
    Infeasible, NotConverged
        See `solve_averaged`.
    """
    groups: list[Found] = []
    level = np.zeros((len(start), model.target))
    problem = Problem(model, start, level, kappa, numbers)
    for first in range(0, len(start), AT_ONCE):
        members = np.arange(first, min(first + AT_ONCE, len(start)))
        groups += [(members[own], found) for own, found in _stack(problem[members], names, first)]
    return joined(len(start), groups)


def _stack(problem: Problem, names: Sequence[str], first: int) -> list[Found]:
    """Solve problems together; those that end on the same mesh form a group."""
    guess = straight(problem, COARSE)
    there = _already_there(problem)
    require_sound(problem, guess, names, there, first)
    paths, alone = [], []
    if there.any():
        still = guess.path[there]
        paths.append(
            (np.nonzero(there)[0], Trajectories(COARSE, still.z, 0 * still.duration, still.multipliers))
        )
    if not there.all():
        moving = np.nonzero(~there)[0]
        path, closeness = newton(problem[moving], guess.path[moving])
        failed = closeness > CLOSE
        rest = moving[~failed]
        try:
            paths += [(rest[own], p) for own, p in resolved(problem[rest], path[~failed], rest + first)]
        except NotConverged:
            failed[:] = True
        for member in moving[failed]:
            own = np.array([member])
            alone += [(own, found) for found in _alone(problem[own], names, first + own)]
    return alone + [
        (members[own], found)
        for members, path in paths
        for own, found in certified(problem[members], path, names, first + members)
    ]


def _alone(problem: Problem, names: Sequence[str], members: NDArray[np.intp]) -> list[AveragedExtremals]:
    """Solve one problem (1), which was not solved among others."""
    member = int(members[0])
    try:
        paths = _from_other_guesses(problem, names, member)
    except NotConverged:
        seen = foreseen(problem, names, member)
        if seen is None:
            raise
        problem, path = seen
        paths = [finer for _, finer in resolved(problem, path, members, ENOUGH)]
    return [found for path in paths for _, found in certified(problem, path, names, members)]


def _from_other_guesses(problem: Problem, names: Sequence[str], member: int) -> list[Trajectories]:
    """Solve one problem (1) from better guesses, where the first one failed or was not fine enough."""
    guesses: tuple[Callable[[], Trajectories | None], ...] = (
        lambda: straight(problem, COARSE).path,
        lambda: straight(problem, FINE).path,
        lambda: shot(problem, FINE),
        lambda: followed(problem, COARSE.degree),
        lambda: straight(problem, GRADED).path,
        lambda: towards_target(problem, FINE),
    )
    unresolved: NotConverged | None = None
    for make in guesses:
        guess = make()
        if guess is not None:
            path, closeness = newton(problem, guess)
            if closeness[0] <= CLOSE:
                try:
                    return [found for _, found in resolved(problem, path, np.array([member]))]
                except NotConverged as error:
                    unresolved = unresolved or error
    if unresolved is not None:
        raise unresolved
    path = _continued(problem, names, member)
    return [found for _, found in resolved(problem, path, np.array([member]))]


def _already_there(problem: Problem) -> NDArray[np.bool_]:
    """Whether the start meets the target and g is stationary there, so that the duration is zero."""
    target, terminal = problem.model.ends(problem.start, problem.numbers)
    return np.asarray((target.value == problem.level).all(axis=1) & (terminal.gradient == 0).all(axis=1))


def _continued(problem: Problem, names: Sequence[str], member: int) -> Trajectories:
    """Solve one problem (1) by continuation of the target's level from that of the start."""
    model = problem.model
    target, _ = model.ends(problem.start, problem.numbers)
    far = target.value - problem.level
    done, share = 0.0, 0.25
    known: list[tuple[float, Trajectories]] = []
    while done < 1:
        at = min(1.0, done + share)
        nearer = Problem(model, problem.start, problem.level + (1 - at) * far, problem.kappa, problem.numbers)
        path, closeness = newton(nearer, _predicted(nearer, known, at))
        if closeness[0] <= CLOSE:
            known = [*known[-1:], (at, path)]
            done, share = at, 2 * share
            continue
        share /= 2
        if share < LEAST_SHARE:
            reached = point(names, known[-1][1].z[0, -1, : model.slow]) if known else "the start"
            raise NotConverged(
                f"no averaged extremal was found beyond {100 * done:.1f} % of the way to the target, "
                f"at {reached}; the target may be out of reach{which(problem, member)}",
                float(np.abs((1 - done) * far).max()),
            )
    return known[-1][1]


def _predicted(problem: Problem, known: list[tuple[float, Trajectories]], at: float) -> Trajectories:
    if not known:
        return straight(problem, FINE).path
    if len(known) == 1:
        return known[0][1]
    (earlier, first), (later, second) = known
    more = (at - later) / (later - earlier)
    duration = second.duration + more * (second.duration - first.duration)
    return Trajectories(
        second.mesh,
        second.z + more * (second.z - first.z),
        np.where(duration > 0, duration, second.duration),
        second.multipliers + more * (second.multipliers - first.multipliers),
    )
