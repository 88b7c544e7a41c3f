"""Averaged extremals by collocation: Newton's method, further guesses where it fails, mesh refinement."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.certificate import certify
from pontryagin.averaging.averaged.collocation import CLOSE, Problem, Trajectories, newton
from pontryagin.averaging.averaged.followed import followed
from pontryagin.averaging.averaged.guess import Guess, shot, straight, towards_target
from pontryagin.averaging.system.model import Model
from pontryagin.certificate import MaximumPrinciple
from pontryagin.errors import ArgumentValueError, Infeasible, NotConverged
from pontryagin.numerics.collocation import Mesh

COARSE, FINE = Mesh((0.0, 1.0), 12), Mesh((0.0, 1.0), 24)
GRADED = Mesh((0.0, *(2.0**-k for k in range(8, 0, -1)), *(1 - 2.0**-k for k in range(2, 9)), 1.0), 12)
TAIL = 1e-13
"""A panel is halved while its last coefficients, relative to the variable, exceed this."""
LAST_TAIL, MOST_PANELS = 1e-9, 64
"""Largest last coefficients accepted when refinement ends, and number of panels at which it must end."""
LEAST_SHARE = 1e-3
"""Shortest step of the continuation, as a share of the distance to the target."""
AT_ONCE = 64
"""Number of problems solved together; more would take more memory and no less time per problem."""


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
    certificate : MaximumPrinciple
    """

    edges: Array
    series: Array
    duration: Array
    cost: Array
    multipliers: Array
    certificate: MaximumPrinciple


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
    groups: list[tuple[NDArray[np.intp], AveragedExtremals]] = []
    level = np.zeros((len(start), model.target))
    problem = Problem(model, start, level, kappa, numbers)
    for first in range(0, len(start), AT_ONCE):
        members = np.arange(first, min(first + AT_ONCE, len(start)))
        groups += [(members[own], found) for own, found in _stack(problem[members], names, first)]
    return _joined(len(start), groups)


def _joined(stack: int, groups: list[tuple[NDArray[np.intp], AveragedExtremals]]) -> AveragedExtremals:
    if not groups:
        raise ArgumentValueError("start must hold at least one problem, got an empty stack", "start")
    panels = max(found.series.shape[1] for _, found in groups)
    degree = max(found.series.shape[2] for _, found in groups)
    edges = np.ones((stack, panels + 1))
    series = np.zeros((stack, panels, degree, groups[0][1].series.shape[-1]))
    duration, cost = np.empty(stack), np.empty(stack)
    multipliers = np.empty((stack, groups[0][1].multipliers.shape[-1]))
    residuals = np.empty((4, stack))
    for members, found in groups:
        edges[members, : found.edges.shape[1]] = found.edges
        series[members, : found.series.shape[1], : found.series.shape[2]] = found.series
        duration[members], cost[members] = found.duration, found.cost
        multipliers[members] = found.multipliers
        of = found.certificate
        residuals[:, members] = [of.boundary, of.transversality, of.hamiltonian, of.maximality]
    return AveragedExtremals(edges, series, duration, cost, multipliers, MaximumPrinciple(*residuals))


def _stack(
    problem: Problem, names: Sequence[str], first: int
) -> list[tuple[NDArray[np.intp], AveragedExtremals]]:
    """Solve problems together; those that end on the same mesh form a group."""
    guess = straight(problem, COARSE)
    there = _already_there(problem)
    _require_sound(problem, guess, names, there, first)
    paths = []
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
            paths += [(rest[own], p) for own, p in _resolved(problem[rest], path[~failed], rest + first)]
        except NotConverged:
            failed[:] = True
        for member in moving[failed]:
            one, number = problem[[member]], first + int(member)
            paths += [(np.array([member]), p) for p in _from_other_guesses(one, names, number)]
    return [(members, _extremals(problem[members], path, names, first + members)) for members, path in paths]


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
                    return [found for _, found in _resolved(problem, path, np.array([member]))]
                except NotConverged as error:
                    unresolved = unresolved or error
    if unresolved is not None:
        raise unresolved
    path = _continued(problem, names, member)
    return [found for _, found in _resolved(problem, path, np.array([member]))]


def _extremals(
    problem: Problem, path: Trajectories, names: Sequence[str], members: NDArray[np.intp]
) -> AveragedExtremals:
    """The certified extremals of solved trajectories on one mesh."""
    n, mesh = problem.model.slow, path.mesh
    certificate = certify(problem, path, names, members)
    if not certificate.holds():
        worst = int(np.argmax(np.nan_to_num(certificate.residual, nan=np.inf)))
        raise NotConverged(
            f"the averaged extremal does not satisfy the maximum principle{_which(problem, members[worst])}",
            float(certificate.residual[worst]),
        )
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
        certificate=certificate,
    )


def _resolved(
    problem: Problem, path: Trajectories, members: NDArray[np.intp]
) -> list[tuple[NDArray[np.intp], Trajectories]]:
    """Refine the mesh of the members that need it until their last coefficients are rounding errors."""
    groups = []
    active = np.arange(len(path.duration))
    while len(active):
        tails = path.tails()
        last = path.mesh.panels >= MOST_PANELS
        settled = np.asarray((tails <= (LAST_TAIL if last else TAIL)).all(axis=1))
        if settled.any():
            groups.append((active[settled], path[settled]))
        active, path, tails = active[~settled], path[~settled], tails[~settled]
        if not len(active):
            break
        if last:
            raise NotConverged(
                f"the averaged extremal is not smooth enough for {path.mesh.panels} collocation panels, the "
                f"most that are tried{_which(problem, members[active[0]])}",
                float(tails.max()),
            )
        coarse = path.mesh == COARSE
        finer = FINE if coarse else path.mesh.bisected(np.asarray((tails > TAIL).any(axis=0)))
        found, closeness = newton(problem[active], path.on(finer))
        lost = closeness > CLOSE
        good = lost & (tails <= LAST_TAIL).all(axis=1)
        if good.any():
            groups.append((active[good], path[good]))
        path, active, lost = found[~good], active[~good], lost[~good]
        if lost.any():
            member = members[active[np.argmax(lost)]]
            raise NotConverged(
                f"Newton's method did not converge after the mesh was refined to {finer.panels} panels"
                f"{_which(problem, member)}",
                float(tails.max()),
            )
    return groups


def _already_there(problem: Problem) -> NDArray[np.bool_]:
    """Whether the start meets the target and g is stationary there, so that the duration is zero."""
    target, terminal = problem.model.ends(problem.start, problem.numbers)
    return np.asarray((target.value == problem.level).all(axis=1) & (terminal.gradient == 0).all(axis=1))


def _require_sound(
    problem: Problem, guess: Guess, names: Sequence[str], there: NDArray[np.bool_], first: int
) -> None:
    single = problem.model.slow == 1
    seen = slice(None) if single else slice(0, 1)
    stopped = ~(guess.frequency[:, seen] > 0)
    if stopped.any():
        member, place = (int(i[0]) for i in np.nonzero(stopped))
        raise ArgumentValueError(
            f"omega must be positive along the whole trajectory, got {guess.frequency[member, place]:.6g} at "
            f"{_point(names, guess.slow[member, place])}{_which(problem, first + member)}",
            "omega",
        )
    idle = ~(guess.idle < 0)
    if idle.any():
        member = int(np.nonzero(idle)[0][0])
        kappa, rate = problem.kappa[member], -guess.idle[member]
        where = _which(problem, first + member)
        if kappa:
            raise ArgumentValueError(
                f"kappa must be less than the mean running cost over omega, got {kappa:.6g}: the mean of the "
                f"running cost minus kappa omega is {rate:.6g} at the start{where}",
                "kappa",
            )
        raise ArgumentValueError(
            f"running_cost must be positive on average over a turn, got {rate:.6g} at the start{where}",
            "running_cost",
        )
    stuck = guess.stuck & ~there[:, None]
    if single and stuck.any():
        member, place = (int(i[0]) for i in np.nonzero(stuck))
        raise Infeasible(
            f"the target cannot be reached: at {_point(names, guess.slow[member, place])} the mean drift "
            f"leads away from it, and no control outweighs the drift{_which(problem, first + member)}"
        )


def _point(names: Sequence[str], values: Array) -> str:
    return ", ".join(f"{name} = {value:.6g}" for name, value in zip(names, values, strict=True))


def _which(problem: Problem, member: int) -> str:
    return f" (problem {member} of the stack)" if len(problem.start) > 1 else ""


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
            reached = _point(names, known[-1][1].z[0, -1, : model.slow]) if known else "the start"
            raise NotConverged(
                f"no averaged extremal was found beyond {100 * done:.1f} % of the way to the target, "
                f"at {reached}; the target may be out of reach{_which(problem, member)}",
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
