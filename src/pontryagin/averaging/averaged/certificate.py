"""Certificates of averaged extremals: residuals of the maximum principle between collocation points."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.collocation import Problem, Trajectories, scales
from pontryagin.averaging.system.model import PERIODIC
from pontryagin.certificate import MaximumPrinciple
from pontryagin.errors import ArgumentValueError
from pontryagin.numerics.collocation import derivative, evaluate
from pontryagin.numerics.periodic_means import CHECKING


def certify(
    problem: Problem, path: Trajectories, names: Sequence[str], members: NDArray[np.intp]
) -> MaximumPrinciple:
    """Residuals of extremals between the collocation points.

    The derivatives of the series are compared with the means of f under the control u* itself, not with the
    derivatives of h0, and all means are taken by rules with other nodes than the solver's. A violation of the
    equations of motion is measured by the change that it makes over a panel.

    Raises
    ------
    ValueError
        If the frequency is not positive along the whole extremal.
    """
    if not path.duration.any():
        return _at_rest(problem, path)
    model, mesh, duration = problem.model, path.mesh, path.duration
    n = model.slow
    edges, series = np.array(mesh.edges), mesh.series(path.z)
    inside = np.sin(np.pi * (np.arange(mesh.degree + 3) + 0.5) / (2 * mesh.degree + 6)) ** 2
    s = (edges[:-1, None] + np.diff(edges)[:, None] * inside).reshape(-1)
    count = len(s)
    z, slope = evaluate(edges, series, s), derivative(edges, series, s)
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
    lengths = np.repeat(np.diff(edges), len(inside))[:, None]
    states = lengths * (slope[..., :n] - slow_time * rate.reshape(-1, count, n))
    force = (h.gradient + kappa[:, None] * omega.gradient)[:, :n].reshape(-1, count, n)
    costates = lengths * (slope[..., n:] + slow_time * force)
    start, end = path.z[:, 0], path.z[:, -1]
    target, terminal = model.ends(end[:, :n], problem.numbers)
    normal = terminal.gradient + np.einsum("sr,sri->si", path.multipliers, target.gradient)
    reach = (np.abs(target.gradient) * size[:, None, :n]).sum(axis=-1)
    at_ends = np.where(duration[:, None] > 0, end[:, n:] + normal, 0.0)
    return MaximumPrinciple(
        boundary=np.maximum.reduce(
            [
                largest(states / size[:, None, :n]),
                largest((start[:, :n] - problem.start) / size[:, :n]),
                largest((target.value - problem.level) / np.where(reach > 0, reach, 1.0)),
            ]
        ),
        transversality=np.maximum(largest(costates / size[:, None, n:]), largest(at_ends / size[:, n:])),
        hamiltonian=largest(h.value + kappa * omega.value) / price,
        maximality=largest(np.einsum("pi,pi->p", flat[:, n:], rate) - cost - h.value) / price,
    )


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
        at = ", ".join(
            f"{name} = {value:.6g}" for name, value in zip(names, slow[member, place], strict=True)
        )
        where = f" (problem {members[member]} of the stack)" if len(members) > 1 else ""
        got = f"{omega[member, place]:.6g} at {at}{where}"
        raise ArgumentValueError(f"omega must be positive along the whole trajectory, got {got}", "omega")
