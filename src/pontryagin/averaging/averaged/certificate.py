"""Certificates of averaged extremals: residuals of the maximum principle between collocation points."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.collocation import Problem, Trajectories, scales
from pontryagin.averaging.averaged.positivity import refuse
from pontryagin.averaging.system.model import PERIODIC
from pontryagin.certificate import MaximumPrinciple
from pontryagin.errors import ArgumentValueError
from pontryagin.numerics.collocation import derivative, evaluate
from pontryagin.numerics.periodic_means import CHECKING
from pontryagin.value import value_class

ENTRIES = ("boundary", "transversality", "hamiltonian", "maximality", "unresolved")
"""The entries of an `AveragedCertificate`, in their order."""
LEAST_POINTS = 27
"""Number of points on a cell that is shorter than its panel; see `resolution.REACH`."""


@value_class
@dataclass(frozen=True, eq=False)
class AveragedCertificate(MaximumPrinciple):
    """Residuals of an averaged extremal, and how narrow a feature would have to be to be unseen.

    Parameters
    ----------
    boundary, transversality, hamiltonian, maximality : (...) array
        See `MaximumPrinciple`.
    unresolved : (...) array
        Share of the way, or of a turn, below which a feature of the system could hide between the points at
        which the residuals are taken. It is 0 where the system's functions were shown to be bounded on
        complex neighbourhoods of the way and of a turn: then they have no features between these points.

    Examples
    --------
    >>> from pontryagin.averaging import smooth_example
    >>> float(smooth_example(1.0, 2.0).certificate.unresolved)
    0.0
    """

    unresolved: Array


def certify(
    problem: Problem,
    path: Trajectories,
    names: Sequence[str],
    members: NDArray[np.intp],
    edges: tuple[float, ...],
) -> tuple[MaximumPrinciple, Array]:
    """Residuals of extremals between the collocation points.

    The derivatives of the series are compared with the means of f under the control u* itself, not with the
    derivatives of h0, and all means are taken by rules with other nodes than the solver's. A violation of the
    equations of motion is measured by the change that it makes over a panel.

    Parameters
    ----------
    problem : Problem
    path : Trajectories
        The extremals (s).
    names : sequence of str
        Names of the slow variables, for errors.
    members : (s) array of int
        Places of the problems in the whole stack, for errors.
    edges : tuple of float
        Ends of the cells of tau / duration on each of which the residuals are taken.

    Returns
    -------
    MaximumPrinciple
    (s, cells) array
        Residual of the equations on each cell.

    Raises
    ------
    ValueError
        If the frequency is not positive along the whole extremal.
    """
    if not path.duration.any():
        return _at_rest(problem, path), np.zeros((len(path.z), 1))
    model, mesh, duration = problem.model, path.mesh, path.duration
    n = model.slow
    own, series, cells = np.array(mesh.edges), mesh.series(path.z), np.array(edges)
    points = mesh.degree + 3 if len(edges) == len(own) else max(mesh.degree + 3, LEAST_POINTS)
    inside = np.sin(np.pi * (np.arange(points) + 0.5) / (2 * points)) ** 2
    s = (cells[:-1, None] + np.diff(cells)[:, None] * inside).reshape(-1)
    count = len(s)
    z, slope = evaluate(own, series, s), derivative(own, series, s)
    flat = z.reshape(-1, 2 * n)
    numbers = tuple(np.repeat(number, count) for number in problem.numbers)
    kappa = np.repeat(problem.kappa, count)
    h, omega = model.averaged(flat, numbers, CHECKING)
    _require_turning(omega.value.reshape(-1, count), z[..., :n], names, members)
    _require_periodic(model.change_in_a_turn(flat, numbers, _anomalies(len(flat))), flat[:, :n], names)
    rate, cost = model.controlled(flat, numbers, CHECKING)
    size = scales(z)
    price = np.abs(cost).reshape(-1, count).max(axis=1)

    def largest(values: Array) -> Array:
        return np.asarray(np.abs(values).reshape(len(z), -1).max(axis=1))

    slow_time = duration[:, None, None]
    lengths = np.repeat(np.diff(own)[np.searchsorted(own, cells[:-1], side="right") - 1], points)[:, None]
    states = lengths * (slope[..., :n] - slow_time * rate.reshape(-1, count, n)) / size[:, None, :n]
    force = (h.gradient + kappa[:, None] * omega.gradient)[:, :n].reshape(-1, count, n)
    costates = lengths * (slope[..., n:] + slow_time * force) / size[:, None, n:]
    level = (h.value + kappa * omega.value).reshape(-1, count, 1) / price[:, None, None]
    start, end = path.z[:, 0], path.z[:, -1]
    target, terminal = model.ends(end[:, :n], problem.numbers)
    normal = terminal.gradient + np.einsum("sr,sri->si", path.multipliers, target.gradient)
    reach = (np.abs(target.gradient) * size[:, None, :n]).sum(axis=-1)
    at_ends = np.where(duration[:, None] > 0, end[:, n:] + normal, 0.0)
    everywhere = np.abs(np.concatenate([states, costates, level], axis=-1)).max(axis=-1)
    certificate = MaximumPrinciple(
        boundary=np.maximum.reduce(
            [
                largest(states),
                largest((start[:, :n] - problem.start) / size[:, :n]),
                largest((target.value - problem.level) / np.where(reach > 0, reach, 1.0)),
            ]
        ),
        transversality=np.maximum(largest(costates), largest(at_ends / size[:, n:])),
        hamiltonian=largest(level),
        maximality=largest(np.einsum("pi,pi->p", flat[:, n:], rate) - cost - h.value) / price,
    )
    return certificate, everywhere.reshape(len(z), -1, points).max(axis=-1)


def _at_rest(problem: Problem, path: Trajectories) -> MaximumPrinciple:
    """Residuals of problems whose target holds at the start, so that the duration is zero."""
    start = path.z[:, 0, : problem.model.slow]
    target, _ = problem.model.ends(start, problem.numbers)
    none = np.zeros(len(start))
    away = np.abs(target.value - problem.level).max(axis=1)
    return MaximumPrinciple(np.maximum(away, np.abs(start - problem.start).max(axis=1)), none, none, none)


def _anomalies(count: int) -> Array:
    """Three random anomalies for each of so many points."""
    return np.random.default_rng(1977).uniform(0, 2 * np.pi, (count, 3))


def _require_periodic(change: Array, slow: Array, names: Sequence[str]) -> None:
    """Raise if the rates differ a turn later: `PhaseSystem` compares them where it finds them defined."""
    worst = int(np.argmax(change))
    if change[worst] > PERIODIC:
        at = ", ".join(f"{name} = {value:.6g}" for name, value in zip(names, slow[worst], strict=True))
        raise ArgumentValueError(
            "f, running_cost and the rate of the phase must be 2 pi-periodic in the anomaly, got a change "
            f"by {change[worst]:.3g} over a turn at {at}",
            "f",
        )


def _require_turning(omega: Array, slow: Array, names: Sequence[str], members: NDArray[np.intp]) -> None:
    dead = ~(omega > 0)
    if dead.any():
        member, place = (int(i[0]) for i in np.nonzero(dead))
        point = list(zip(names, slow[member, place], strict=True))
        refuse("omega", float(omega[member, place]), point, members, member)
