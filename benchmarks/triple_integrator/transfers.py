"""Least time by our solver and by ruckig with a bound on the jerk alone, including the set-up of inputs."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import product
from math import inf

import numpy as np
from numpy.typing import NDArray

from benchmarks.apart import answer
from benchmarks.clock import one_by_one, one_call, repeated
from benchmarks.contest import CALL, STACK, Contestant, Row, contest, worst, worst_gap
from benchmarks.peers import absent
from benchmarks.table import by_heading
from benchmarks.triple_integrator import problems, propagation
from benchmarks.triple_integrator.problems import Transfers
from pontryagin.arrays import Array
from pontryagin.triple_integrator import minimum_time
from pontryagin.triple_integrator.least_time import time as least_time

REACHED = 1e-9
"""An answer counts only if its relative miss is at most this."""

SAME = 1e-7
"""A duration counts as longer than another if the relative difference exceeds this."""

AXES = 100
"""Number of axes in one call of ruckig where it is timed on stacks."""


@dataclass(frozen=True)
class Answers:
    """Answers of one solver: whether there is one, its duration, and its miss by propagation, all (n,)."""

    returned: NDArray[np.bool_]
    duration: Array
    miss: Array

    @property
    def solved(self) -> NDArray[np.bool_]:
        """Whether there is an answer and it reaches the target."""
        return self.returned & (self.miss <= REACHED)


def by_pontryagin(work: Transfers) -> Answers:
    """Our answers, computed one by one; nan where the solver did not converge."""
    columns = [x[:, i] for x in (work.x0, work.xf) for i in range(3)]
    result = least_time.solve_stack(*columns, work.force, work.peak)
    returned = np.isfinite(result[:, 0])
    duration = np.where(returned, result[:, 0], np.nan)
    pieces = propagation.bang_bang_pieces(duration, result[:, 2:4], result[:, 1])
    return Answers(returned, duration, propagation.miss(work.x0, work.xf, *pieces, force=work.force))


def by_ruckig(work: Transfers) -> Answers:
    """Ruckig's answers: its phases, brake phases included, propagated independently; none if it dies."""
    none = np.full(len(work.peak), np.nan)
    return answer("ruckig", partial(_by_ruckig, work), Answers(np.zeros(len(none), bool), none, none))


def _by_ruckig(work: Transfers) -> Answers:
    import ruckig

    solve = RuckigAxis()
    count = len(work.peak)
    returned, durations = np.zeros(count, bool), np.full(count, np.nan)
    pieces, levels = np.zeros((count, 9)), np.zeros((count, 9))
    for i, problem in enumerate(zip(*as_lists(work), strict=True)):
        try:
            returned[i] = solve(*problem) == ruckig.Result.Working
        except ruckig.RuckigError:
            continue
        if returned[i]:
            profile = solve.trajectory.profiles[0][0]
            durations[i] = solve.trajectory.duration
            pieces[i] = [*profile.brake.t, *profile.t]
            levels[i] = [*profile.brake.j, *profile.j]
    return Answers(returned, durations, propagation.miss(work.x0, work.xf, pieces, levels))


class RuckigAxis:
    """One axis of ruckig with a bound on jerk alone; calling it sets the inputs and computes."""

    def __init__(self) -> None:
        import ruckig

        self.otg, self.input, self.trajectory = (
            ruckig.Ruckig(1),
            ruckig.InputParameter(1),
            ruckig.Trajectory(1),
        )
        self.input.max_velocity = self.input.max_acceleration = [inf]

    def __call__(self, x0: list[float], xf: list[float], peak: float):
        """Ruckig's result code; the trajectory is in ``trajectory``."""
        entry = self.input
        entry.current_position, entry.current_velocity, entry.current_acceleration = (
            [x0[0]],
            [x0[1]],
            [x0[2]],
        )
        entry.target_position, entry.target_velocity, entry.target_acceleration = [xf[0]], [xf[1]], [xf[2]]
        entry.max_jerk = [peak]
        return self.otg.calculate(entry, self.trajectory)


def as_lists(work: Transfers) -> tuple[list[list[float]], list[list[float]], list[float]]:
    """Ends and bounds as plain Python numbers, the fastest input of both solvers for single problems."""
    return work.x0.tolist(), work.xf.tolist(), work.peak.tolist()


def rows(quick: bool) -> list[Row]:
    """Least time at unit scales: computing time per problem, and durations in comparison with ours."""
    result: list[Row] = []
    for name in ("full states", "no acceleration at the ends"):
        result += _rows(f"least time, {name}", name, 200 if quick else 2000, 3 if quick else 7)
    return result


def _rows(problem: str, name: str, count: int, rounds: int) -> list[Row]:
    work, large = problems.transfers(name, count), problems.transfers(name, 50 * count)
    stack = (large.x0, large.xf, large.peak)
    ours = by_pontryagin(work)
    certificate = minimum_time(*stack).certificate
    gap = worst_gap(certificate.dual_value, certificate.primal_value)
    single, together = (
        one_by_one(minimum_time, *as_lists(work)),
        one_call(lambda: minimum_time(*stack), 50 * count),
    )
    arrays = one_by_one(minimum_time, work.x0, work.xf, work.peak.tolist())
    contestants = {
        CALL: Contestant(single, gap, float(ours.solved.mean())),
        f"{CALL} from arrays": Contestant(arrays, gap, float(ours.solved.mean())),
        STACK: Contestant(together, gap, float(by_pontryagin(large).solved.mean())),
    }
    if not absent("ruckig"):
        answers = by_ruckig(work)
        both = answers.solved & ours.solved
        error, solved = worst((answers.duration / ours.duration - 1)[both]), float(answers.solved.mean())
        contestants |= {method: Contestant(run, error, solved) for method, run in _ruckig_runs(work).items()}
    return contest(problem, contestants, rounds)


def _ruckig_runs(work: Transfers) -> dict[str, Callable[[], int]]:
    import ruckig

    axis, count = RuckigAxis(), len(work.peak)
    prepared = [RuckigAxis() for _ in range(AXES)]
    for single, *problem in zip(prepared, *as_lists(work), strict=False):
        _quietly(single, *problem)
    alone = one_by_one(
        _quietly, *zip(*((a.otg.calculate, a.input, a.trajectory) for a in prepared), strict=True)
    )

    otg, entry, trajectory = ruckig.Ruckig(AXES), ruckig.InputParameter(AXES), ruckig.Trajectory(AXES)
    entry.synchronization = ruckig.Synchronization.No
    entry.max_velocity = entry.max_acceleration = [inf] * AXES
    names = ("position", "velocity", "acceleration")

    def many_axes() -> int:
        for i in range(0, count, AXES):
            part = slice(i, i + AXES)
            for k, name in enumerate(names):
                setattr(entry, f"current_{name}", work.x0[part, k].tolist())
                setattr(entry, f"target_{name}", work.xf[part, k].tolist())
            entry.max_jerk = work.peak[part].tolist()
            _quietly(otg.calculate, entry, trajectory)
        return count

    return {
        "ruckig, one call": one_by_one(_quietly, [axis] * count, *as_lists(work)),
        "ruckig, the call alone": repeated(alone, count // AXES),
        f"ruckig, {AXES} axes a call": many_axes,
    }


def _quietly(call, *arguments) -> None:
    """Make a call that is timed and ignore its failure; failures are counted elsewhere."""
    import ruckig

    try:
        call(*arguments)
    except ruckig.RuckigError:
        return


@dataclass(frozen=True)
class Cell:
    """Both solvers on inputs of one kind and scale.

    An answer counts as failed if there is none or its propagation misses the target by more than `REACHED`.
    It counts as longer if that of the other solver reaches the target and is shorter by more than `SAME`.
    """

    ends: str
    states: str
    jerk: str
    count: int
    failed: dict[str, int]
    longer: dict[str, int]
    miss: dict[str, float]


def cells(quick: bool) -> list[Cell]:
    """Each kind of ends at each decade of the states and of the jerk bound, and mixed scales."""
    exponents = range(-3, 4, 3) if quick else range(-3, 4)
    count = 50 if quick else 400
    result = []
    for ends in ("full states", "no acceleration at the ends"):
        base = problems.transfers(ends, count)
        for state, jerk in product(exponents, exponents):
            scale, peak = 10.0**state, np.full(count, 10.0**jerk)
            work = Transfers(scale * base.x0, scale * base.xf, peak, np.zeros(count))
            result.append(_compare(ends, f"1e{state}", f"1e{jerk}", work))
    mixed = problems.transfers("sizes 1e-3 to 1e3", 25 * count)
    return [*result, _compare("full states", "each 1e-3 to 1e3", "1e-3 to 1e3", mixed)]


def _compare(ends: str, states: str, jerk: str, work: Transfers) -> Cell:
    answers = {"ruckig": by_ruckig(work), "pontryagin": by_pontryagin(work)}
    both = answers["ruckig"].solved & answers["pontryagin"].solved
    least = np.minimum(answers["ruckig"].duration, answers["pontryagin"].duration)
    failed, longer, miss = {}, {}, {}
    for side, given in answers.items():
        failed[side] = int((~given.solved).sum())
        longer[side] = int((both & (given.duration > least * (1 + SAME))).sum())
        miss[side] = worst(given.miss[given.returned])
    return Cell(ends, states, jerk, len(work.peak), failed, longer, miss)


def by_cell(found: Sequence[Cell]) -> dict[str, list]:
    """A table with a row for every cell."""
    return by_heading(
        [{"ends": cell.ends, "states": cell.states, "jerk": cell.jerk} | _shares([cell]) for cell in found]
    )


def summary(found: Sequence[Cell]) -> dict[str, list]:
    """A table of the sums over the cells of each kind."""
    kinds: dict[tuple[str, str], list[Cell]] = {}
    for cell in found:
        scales = "each its own" if cell.states.startswith("each") else "by decades"
        kinds.setdefault((cell.ends, scales), []).append(cell)
    return by_heading(
        [{"ends": ends, "scales": scales} | _shares(kinds[ends, scales]) for ends, scales in kinds]
    )


def _shares(group: Sequence[Cell]) -> dict[str, float]:
    """The number of inputs of some cells, the shares that failed and were longer, and the worst miss."""
    inputs = sum(cell.count for cell in group)
    row: dict[str, float] = {"inputs": inputs}
    for side in ("ruckig", "pontryagin"):
        row[f"{side} fails"] = sum(cell.failed[side] for cell in group) / inputs
        row[f"{side} longer"] = sum(cell.longer[side] for cell in group) / inputs
        row[f"{side} worst miss"] = float(np.fmax.reduce([cell.miss[side] for cell in group]))
    return row
