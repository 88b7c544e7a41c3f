"""Refinement of collocation meshes where series do not end in rounding errors or miss narrow features."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.collocation import CLOSE, Problem, Trajectories, newton
from pontryagin.averaging.averaged.guess import straight
from pontryagin.averaging.averaged.resolution import resolution
from pontryagin.averaging.averaged.soundness import require_sound, which
from pontryagin.errors import NotConverged
from pontryagin.numerics.collocation import Mesh, evaluate

COARSE, FINE = Mesh((0.0, 1.0), 12), Mesh((0.0, 1.0), 24)
GRADED = Mesh((0.0, *(2.0**-k for k in range(8, 0, -1)), *(1 - 2.0**-k for k in range(2, 9)), 1.0), 12)
TAIL = 1e-13
"""A panel is halved while its last coefficients, relative to the variable, exceed this."""
LAST_TAIL, MOST_PANELS = 1e-9, 64
"""Largest last coefficients accepted when refinement ends, and number of panels at which it must end."""
ROUGH = 1e-10
"""Residual on a cell from which its features are taken into account."""
SHARE = 1e-3
"""Share of the largest residual from which they are."""
NARROW_TAIL = 3e-12
"""Largest last coefficients where features are narrow."""
ENOUGH = 1e-11
"""Residual of the collocation equations that is accepted where features are narrow."""


def resolved(
    problem: Problem, path: Trajectories, members: NDArray[np.intp], enough: float = -np.inf
) -> list[tuple[NDArray[np.intp], Trajectories]]:
    """Refine the mesh of the members that need it until their last coefficients are rounding errors."""
    groups = []
    tail = TAIL if enough < 0 else NARROW_TAIL
    most = max(MOST_PANELS, 2 * path.mesh.panels)
    active = np.arange(len(path.duration))
    while len(active):
        tails = path.tails()
        last = path.mesh.panels >= most
        settled = np.asarray((tails <= (LAST_TAIL if last else tail)).all(axis=1))
        if settled.any():
            groups.append((active[settled], path[settled]))
        active, path, tails = active[~settled], path[~settled], tails[~settled]
        if not len(active):
            break
        if last:
            raise NotConverged(
                f"the averaged extremal is not smooth enough for {path.mesh.panels} collocation panels, the "
                f"most that are tried{which(problem, members[active[0]])}",
                float(tails.max()),
            )
        coarse = path.mesh == COARSE
        finer = FINE if coarse else path.mesh.bisected(np.asarray((tails > tail).any(axis=0)))
        found, closeness = newton(problem[active], path.on(finer), enough)
        lost = closeness > CLOSE
        good = lost & (tails <= LAST_TAIL).all(axis=1)
        if good.any():
            groups.append((active[good], path[good]))
        path, active, lost = found[~good], active[~good], lost[~good]
        if lost.any():
            member = members[active[np.argmax(lost)]]
            raise NotConverged(
                f"Newton's method did not converge after the mesh was refined to {finer.panels} panels"
                f"{which(problem, member)}",
                float(tails.max()),
            )
    return groups


def heeding(
    problem: Problem,
    path: Trajectories,
    edges: tuple[float, ...],
    rough: Array,
    names: Sequence[str],
    member: int,
) -> Trajectories:
    """Solve one problem (1) again, its extremal having missed features of the system.

    Parameters
    ----------
    problem : Problem
    path : Trajectories
        The extremal that misses them.
    edges : tuple of float
        Ends of the cells of tau / duration on which the residuals were taken.
    rough : (cells) array
        These residuals.
    names : sequence of str
        Names of the slow variables, for errors.
    member : int
        Place of the problem in the whole stack, for errors.

    Raises
    ------
    ValueError, Infeasible
        If a feature makes the frequency negative or the target unreachable.
    NotConverged
        If no extremal was found.
    """
    cells = np.array(edges)
    for coarsening in (4, 1):
        mesh = _graded(path.mesh, cells, rough > max(ROUGH, SHARE * rough.max()), coarsening)
        if mesh.panels > MOST_PANELS:
            break
        for guess in _guesses(problem, path, mesh, names, member):
            found, closeness = newton(problem, guess, ENOUGH)
            if closeness[0] <= CLOSE:
                return found
    raise NotConverged(
        "the averaged extremal misses a narrow feature of the system, and none was found that heeds it"
        f"{which(problem, member)}",
        float(rough.max()),
    )


def foreseen(problem: Problem, names: Sequence[str], member: int) -> tuple[Problem, Trajectories] | None:
    """Solve one problem (1) on a mesh that heeds the features on the straight line to the target.

    The result holds the problem with means that heed them too; it is None where there are no features.
    """
    path = straight(problem, FINE).path
    view = resolution(problem, path)
    if view.edges[0] == path.mesh.edges and not view.turn[0]:
        return None
    heeded = with_turn(problem, view.turn[0] or problem.model.turn)
    rough = np.ones(len(view.edges[0]) - 1)
    return heeded, heeding(heeded, path, view.edges[0], rough, names, member)


def _graded(mesh: Mesh, edges: Array, rough: NDArray[np.bool_], coarsening: int) -> Mesh:
    """The mesh with panels halved to at most `coarsening` times the length of the rough cells in them."""
    low, high = edges[:-1][rough], edges[1:][rough]
    ends = [0.0]

    def halve(begin: float, end: float) -> None:
        inside = (low >= begin) & (high <= end)
        if inside.any() and end - begin > 1.5 * coarsening * (high - low)[inside].min():
            halve(begin, (begin + end) / 2)
            halve((begin + end) / 2, end)
        else:
            ends.append(end)

    for begin, end in zip(mesh.edges, mesh.edges[1:], strict=False):
        halve(begin, end)
    return Mesh(tuple(ends), FINE.degree)


def _guesses(
    problem: Problem, path: Trajectories, mesh: Mesh, names: Sequence[str], member: int
) -> Iterator[Trajectories]:
    """Guesses on a mesh of time as it passes on a known trajectory."""
    ends = evaluate(np.array(path.mesh.edges), path.mesh.series(path.z), np.array(mesh.edges))[0]
    moved = (ends - ends[0])[:, : problem.model.slow]
    if moved[-1].any():
        share = moved @ moved[-1] / (moved[-1] @ moved[-1])
        if (np.diff(share) > 0).all():
            yield _straight(problem, Mesh((0.0, *share[1:-1], 1.0), mesh.degree), names, member)
    yield path.on(mesh)
    yield straight(problem, mesh).path


def _straight(problem: Problem, distance: Mesh, names: Sequence[str], member: int) -> Trajectories:
    """The guess of one problem (1) along a straight line, on a mesh of distance that is refined for it."""
    last = False
    while True:
        guess = straight(problem, distance, own_times=True)
        require_sound(problem, guess, names, np.zeros(1, bool), member)
        tails = guess.path.tails()[0]
        bad, better = tails > NARROW_TAIL, tails > TAIL
        if last or not better.any() or distance.panels + bad.sum() > MOST_PANELS:
            return guess.path
        last = not bad.any()
        distance = distance.bisected(better if last else bad)


def with_turn(problem: Problem, turn: tuple[float, ...]) -> Problem:
    """The same problem with means on other cells of a turn."""
    return problem if turn == problem.model.turn else replace(problem, model=problem.model.with_turn(turn))
