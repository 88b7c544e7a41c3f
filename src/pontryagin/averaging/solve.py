"""The optimal averaged extremal: a guess, Newton's method, continuation where it fails, degree as needed."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pontryagin.averaging import chebyshev
from pontryagin.averaging.certify import certify
from pontryagin.averaging.collocation import CLOSE, Path, Problem, newton
from pontryagin.averaging.guess import Guess, straight
from pontryagin.averaging.model import Model
from pontryagin.certificate import MaximumPrinciple
from pontryagin.errors import Infeasible, NotConverged

Array = NDArray[np.float64]

DEGREES = (12, 24, 48, 96, 192)
TAIL = 1e-13
LAST_TAIL = 1e-9
"""What the last coefficients may be at any degree, and at the highest."""
RESIDUAL = 1e-7
"""The largest residual of the maximum principle that is handed out."""
LEAST_SHARE = 1e-3
AT_ONCE = 256
"""Problems solved side by side; more take memory and no less time each."""


@dataclass(frozen=True, eq=False)
class Extremals:
    """Averaged extremals of a stack (s).

    Attributes
    ----------
    series : (s, N + 1, 2n) array
        Chebyshev coefficients of (xi, eta) in 2 tau / duration - 1.
    duration, cost : (s) array
    multipliers : (s, r) array
        alpha.
    certificate : MaximumPrinciple
    """

    series: Array
    duration: Array
    cost: Array
    multipliers: Array
    certificate: MaximumPrinciple


def extremals(
    model: Model, names: Sequence[str], start: Array, numbers: tuple[Array, ...], kappa: Array
) -> Extremals:
    """Solve a stack of problems: start (s, n), numbers and kappa (s).

    Raises
    ------
    ValueError
        If the frequency is not positive on the way, or the running cost not positive on average.
    Infeasible, NotConverged
        See `solve_averaged`.
    """
    parts = []
    for first in range(0, len(start), AT_ONCE):
        members = slice(first, first + AT_ONCE)
        held = tuple(number[members] for number in numbers)
        level = np.zeros((len(start[members]), model.target))
        parts.append(_stack(Problem(model, start[members], level, kappa[members], held), names, first))
    degree = max(part.series.shape[1] for part in parts)
    series = [np.pad(p.series, [(0, 0), (0, degree - p.series.shape[1]), (0, 0)]) for p in parts]
    joined = {
        name: np.concatenate([getattr(part, name) for part in parts])
        for name in ("duration", "cost", "multipliers")
    }
    residuals = {
        name: np.concatenate([getattr(part.certificate, name) for part in parts])
        for name in ("boundary", "transversality", "hamiltonian", "maximality")
    }
    return Extremals(np.concatenate(series), **joined, certificate=MaximumPrinciple(**residuals))


def _stack(problem: Problem, names: Sequence[str], first: int) -> Extremals:
    guess = straight(problem, DEGREES[0])
    there = _already_there(problem)
    _require_sound(problem, guess, names, there, first)
    if there.all():
        path, closeness = guess.path[~there], np.zeros(0)
    else:
        path, closeness = newton(problem[~there], guess.path[~there])
    moving = np.nonzero(~there)[0]
    result = Path(guess.path.z.copy(), np.where(there, 0.0, guess.path.duration), guess.path.multipliers)
    result.z[there] = guess.path.z[there][:, :1]
    for i in np.nonzero(closeness > CLOSE)[0]:
        one = _continued(problem[[moving[i]]], names, first + int(moving[i]))
        path.z[i], path.duration[i], path.multipliers[i] = one.z[0], one.duration[0], one.multipliers[0]
    result.z[moving], result.duration[moving], result.multipliers[moving] = (
        path.z,
        path.duration,
        path.multipliers,
    )
    found = _resolved(problem, result, moving, first)
    certificate = certify(problem, found, names, first)
    if not certificate.holds(RESIDUAL):
        worst = int(np.argmax(np.nan_to_num(certificate.residual, nan=np.inf)))
        raise NotConverged(
            f"the averaged extremal does not satisfy the maximum principle{_which(problem, first + worst)}",
            float(certificate.residual[worst]),
        )
    return Extremals(found.z, found.duration, _cost(problem, found), found.multipliers, certificate)


def _cost(problem: Problem, path: Path) -> Array:
    """g plus the integral of the mean running cost eta f0 - h0, path being given by its series."""
    n, degree = problem.model.slow, path.degree
    z = chebyshev.polynomials(chebyshev.points(degree), degree) @ path.z
    h, _ = problem.averaged(z)
    running = np.einsum("ski,ski->sk", z[..., n:], h.gradient[..., n:]) - h.value
    _, terminal = problem.model.ends(z[:, -1, :n], problem.numbers)
    return terminal.value + path.duration * (running @ chebyshev.integrals(degree)[-1])


def _already_there(problem: Problem) -> NDArray[np.bool_]:
    """Whether the start meets the target, which is then kept where g does not say otherwise."""
    target, terminal = problem.model.ends(problem.start, problem.numbers)
    return (target.value == problem.level).all(axis=1) & (terminal.gradient == 0).all(axis=1)


def _require_sound(
    problem: Problem, guess: Guess, names: Sequence[str], there: NDArray[np.bool_], first: int
) -> None:
    single = problem.model.slow == 1
    seen = slice(None) if single else slice(0, 1)
    dead = ~(guess.frequency[:, seen] > 0)
    if dead.any():
        member, place = (int(i[0]) for i in np.nonzero(dead))
        raise ValueError(
            f"omega must be positive all the way, got {guess.frequency[member, place]:.6g} at "
            f"{_point(names, guess.slow[member, place])}{_which(problem, first + member)}"
        )
    idle = ~(guess.idle[:, 0] < 0)
    if idle.any():
        member = int(np.nonzero(idle)[0][0])
        name = (
            "kappa must be less than the mean running cost over omega"
            if problem.kappa[member]
            else ("running_cost must be positive on average")
        )
        raise ValueError(
            f"{name}, at the start the cost rate is {-guess.idle[member, 0]:.6g}"
            f"{_which(problem, first + member)}"
        )
    stuck = guess.stuck & ~there[:, None]
    if single and stuck.any():
        member, place = (int(i[0]) for i in np.nonzero(stuck))
        raise Infeasible(
            f"the target cannot be reached: at {_point(names, guess.slow[member, place])} the mean drift "
            f"opposes every control and exceeds it{_which(problem, first + member)}"
        )


def _point(names: Sequence[str], values: Array) -> str:
    return ", ".join(f"{name} = {value:.6g}" for name, value in zip(names, values, strict=True))


def _which(problem: Problem, member: int) -> str:
    return f" (problem {member} of the stack)" if len(problem.start) > 1 else ""


def _continued(problem: Problem, names: Sequence[str], member: int) -> Path:
    """Solve one problem (1) by bringing its target from the start's level to the given one in steps."""
    model = problem.model
    target, _ = model.ends(problem.start, problem.numbers)
    far = target.value - problem.level
    done, share = 0.0, 0.25
    known: list[tuple[float, Path]] = []
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
                f"at {reached}; it may be out of reach{_which(problem, member)}",
                float(np.abs((1 - done) * far).max()),
            )
    return known[-1][1]


def _predicted(problem: Problem, known: list[tuple[float, Path]], at: float) -> Path:
    if not known:
        return straight(problem, DEGREES[0]).path
    if len(known) == 1:
        return known[0][1]
    (earlier, first), (later, second) = known
    more = (at - later) / (later - earlier)
    duration = second.duration + more * (second.duration - first.duration)
    return Path(
        second.z + more * (second.z - first.z),
        np.where(duration > 0, duration, second.duration),
        second.multipliers + more * (second.multipliers - first.multipliers),
    )


def _resolved(problem: Problem, path: Path, moving: NDArray[np.intp], first: int) -> Path:
    """Raise the degree of the members that need it until their series end in rounding."""
    stack = len(path.duration)
    series = np.zeros((stack, DEGREES[-1] + 1, path.z.shape[-1]))
    duration, multipliers = path.duration.copy(), path.multipliers.copy()
    series[:, 0] = path.z[:, 0]
    active, current = moving, path[moving]
    used = 0
    for degree, following in zip(DEGREES, (*DEGREES[1:], 0), strict=True):
        if not len(active):
            break
        tail = current.tail()
        settled = tail <= (TAIL if following else LAST_TAIL)
        members = active[settled]
        series[members, : degree + 1] = chebyshev.to_coefficients(degree) @ current.z[settled]
        duration[members], multipliers[members] = current.duration[settled], current.multipliers[settled]
        used = degree if len(members) else used
        active, current = active[~settled], current[~settled]
        if not len(active):
            break
        if not following:
            raise NotConverged(
                f"the averaged extremal is not smooth enough for degree {degree}"
                f"{_which(problem, first + int(active[0]))}",
                float(tail.max()),
            )
        current, closeness = newton(problem[active], current.refined(following))
        if (closeness > CLOSE).any():
            lost = int(active[np.argmax(closeness)])
            raise NotConverged(
                f"Newton's method lost the averaged extremal at degree {following}"
                f"{_which(problem, first + lost)}",
                float(tail.max()),
            )
    return Path(series[:, : used + 1], duration, multipliers)
