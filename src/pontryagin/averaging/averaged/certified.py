"""Certified averaged extremals: solved again on finer meshes where they miss narrow features."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.certificate import ENTRIES, AveragedCertificate, certify
from pontryagin.averaging.averaged.collocation import Problem, Trajectories
from pontryagin.averaging.averaged.positivity import undecided
from pontryagin.averaging.averaged.refinement import ENOUGH, heeding, resolved, with_turn
from pontryagin.averaging.averaged.resolution import resolution
from pontryagin.averaging.averaged.soundness import which
from pontryagin.certificate import ACCEPTED, MaximumPrinciple
from pontryagin.errors import ArgumentValueError, NotConverged

ROUNDS = 6
"""Largest number of times that an extremal is solved again."""


@dataclass(frozen=True, eq=False)
class AveragedExtremals:
    """Averaged extremals of a stack (s).

    Attributes
    ----------
    edges : (s, panels + 1) array
        Edges of the panels of tau / duration; a stack's members may have panels of zero length at the end.
    series : (s, panels, degree + 1, 2n + 1) array
        Chebyshev coefficients on each panel, of (xi, eta) and of the integral of omega over tau / duration.
    duration, cost : (s) array
    multipliers : (s, r) array
        alpha.
    certificate : AveragedCertificate
    turn : tuple of float
        Ends of the cells of a turn that the means heed; empty where none is narrow.
    """

    edges: Array
    series: Array
    duration: Array
    cost: Array
    multipliers: Array
    certificate: AveragedCertificate
    turn: tuple[float, ...]


Found = tuple[NDArray[np.intp], AveragedExtremals]
"""Places in a stack, and the extremals there."""


def joined(stack: int, groups: list[Found]) -> AveragedExtremals:
    """The extremals of so many problems, from those of groups."""
    if not groups:
        raise ArgumentValueError("start must hold at least one problem, got an empty stack", "start")
    panels = max(found.series.shape[1] for _, found in groups)
    degree = max(found.series.shape[2] for _, found in groups)
    edges = np.ones((stack, panels + 1))
    series = np.zeros((stack, panels, degree, groups[0][1].series.shape[-1]))
    duration, cost = np.empty(stack), np.empty(stack)
    multipliers = np.empty((stack, groups[0][1].multipliers.shape[-1]))
    residuals = np.empty((5, stack))
    for members, found in groups:
        edges[members, : found.edges.shape[1]] = found.edges
        series[members, : found.series.shape[1], : found.series.shape[2]] = found.series
        duration[members], cost[members] = found.duration, found.cost
        multipliers[members] = found.multipliers
        of = found.certificate
        residuals[:, members] = [getattr(of, entry) for entry in ENTRIES]
    turn = tuple(sorted({end for _, found in groups for end in found.turn}))
    certificate = AveragedCertificate(*residuals)
    return AveragedExtremals(edges, series, duration, cost, multipliers, certificate, turn)


def certified(
    problem: Problem,
    path: Trajectories,
    names: Sequence[str],
    members: NDArray[np.intp],
    rounds: int = ROUNDS,
) -> list[Found]:
    """Extremals (s) from solved trajectories on one mesh, in groups, with their places among the s.

    Parameters
    ----------
    problem : Problem
    path : Trajectories
        The trajectories (s).
    names : sequence of str
        Names of the slow variables, for errors.
    members : (s) array of int
        Places of the problems in the whole stack, for errors.
    rounds : int
        How many times those that miss features of the system may be solved again.

    Raises
    ------
    ValueError, Infeasible, NotConverged
        See `solve_averaged`.
    """
    if not path.duration.any():
        principle, _ = certify(problem, path, names, members, path.mesh.edges)
        return [(np.arange(len(members)), _extremals(problem, path, principle, np.zeros(len(members))))]
    view = resolution(problem, path)
    unresolved = view.unresolved
    open_ = np.nonzero(~view.positive)[0]
    if len(open_):
        signs = undecided(problem[open_], path[open_], names, members[open_])
        unresolved[open_] = np.maximum(unresolved[open_], signs)
    groups: list[Found] = []
    for (edges, turn), own in view.groups.items():
        one = with_turn(problem[own], turn or problem.model.turn)
        principle, rough = certify(one, path[own], names, members[own], edges)
        fine = principle.residual <= ACCEPTED
        if fine.all():
            groups.append((own, _extremals(one, path[own], principle, unresolved[own])))
            continue
        if (edges == path.mesh.edges and not turn) or not rounds:
            worst = int(np.argmax(np.nan_to_num(principle.residual, nan=np.inf)))
            raise NotConverged(
                "the averaged extremal does not satisfy the maximum principle"
                f"{which(problem, int(members[own[worst]]))}",
                float(principle.residual[worst]),
            )
        if fine.any():
            groups += [
                (own[fine], e) for _, e in certified(one[fine], path[own[fine]], names, members[own[fine]], 0)
            ]
        for i in np.nonzero(~fine)[0]:
            place = own[i : i + 1]
            alone, member = with_turn(problem[place], one.model.turn), members[place]
            better = heeding(alone, path[place], edges, rough[i], names, int(member[0]))
            for _, finer in resolved(alone, better, member, ENOUGH):
                groups += [(place, e) for _, e in certified(alone, finer, names, member, rounds - 1)]
    return groups


def _extremals(
    problem: Problem, path: Trajectories, principle: MaximumPrinciple, unresolved: Array
) -> AveragedExtremals:
    n, mesh = problem.model.slow, path.mesh
    h, omega = problem.averaged(path.z)
    running = np.einsum("ski,ski->sk", path.z[..., n:], h.gradient[..., n:]) - h.value
    _, terminal = problem.model.ends(path.z[:, -1, :n], problem.numbers)
    turned = (omega.value @ mesh.integrals.T)[..., None]
    return AveragedExtremals(
        edges=np.broadcast_to(np.array(mesh.edges), (len(path.z), mesh.panels + 1)),
        series=mesh.series(np.concatenate([path.z, turned], axis=-1)),
        duration=path.duration,
        cost=terminal.value + path.duration * (running @ mesh.integrals[-1]),
        multipliers=path.multipliers,
        certificate=AveragedCertificate(
            principle.boundary,
            principle.transversality,
            principle.hamiltonian,
            principle.maximality,
            unresolved,
        ),
        turn=problem.model.turn,
    )
