"""Tables of this paper, as columns for `plotting.show_table`."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentValueError
from pontryagin.orbit_correction import ergodic, printed
from pontryagin.orbit_correction.figures.impulses import same_length
from pontryagin.orbit_correction.flight import ClosedLoop
from pontryagin.orbit_correction.gauges.general import gauge_of_factors
from pontryagin.orbit_correction.gauges.pball import fewest_power_steps
from pontryagin.orbit_correction.montecarlo import Distribution
from pontryagin.orbit_correction.plan.correction import Plan, correct
from pontryagin.orbit_correction.plan.thrust import THRUSTS
from pontryagin.orbit_correction.system import satellite
from pontryagin.orbit_correction.waste import Waste
from pontryagin.validation import vectors

Columns = dict[str, list[Any]]
"""A table as its columns: for each heading the list of entries."""


def states(plan: Plan) -> Columns:
    """The first table's states, 10^-2: printed, ours, and the difference in units of the last digit."""
    return _beside(printed.STATES, 100 * plan.states, "x", 5)


def costates(plan: Plan) -> Columns:
    """The first table's adjoint vectors: printed, ours, and the difference in units of the last digit."""
    return _beside(printed.COSTATES, plan.costates, r"\psi", 4)


def controls(plan: Plan) -> Columns:
    """The second table, 10^-2: printed, ours, and the difference in units of the last digit."""
    return _beside(printed.CONTROLS, 100 * plan.controls, "u", 5)


def _beside(numbers: Sequence[Sequence[str]], ours: Array, symbol: str, digits: int) -> Columns:
    """A printed table, without its common factor 10^-2, beside our numbers in the same units."""
    if ours.shape != (len(numbers), 3):
        raise ArgumentValueError(
            f"plan must have {len(numbers)} rows of 3 numbers like the printed table, got shape {ours.shape}",
            "plan",
        )
    columns: Columns = {"$k$": list(range(len(numbers)))}
    for i in range(3):
        texts, name = [row[i].removesuffix("e-2") for row in numbers], f"{symbol}_{i + 1}"
        away = (ours[:, i] - np.array([float(text) for text in texts])) * 10**digits
        columns[f"${name}$ printed"] = [text.replace("-", "−") for text in texts]
        columns[f"${name}$ ours"] = [_fixed(value, digits + 2) for value in ours[:, i]]
        columns[rf"$\Delta {name}$, units"] = [_fixed(value, 2) for value in away]
    return columns


def _fixed(value: float, digits: int) -> str:
    """A number with fixed digits and a true minus sign."""
    return f"{round(float(value), digits) + 0.0:.{digits}f}".replace("-", "−")


def gauges(plans: Sequence[Plan]) -> Columns:
    """N_min and alpha with the proofs of both, one row for each plan."""
    proofs = [plan.certificate for plan in plans]
    return {
        "impulses in": [plan.thrust.name for plan in plans],
        "steps": [int(plan.steps) for plan in plans],
        "impulses": [int(plan.impulse_count) for plan in plans],
        r"$\alpha$": [float(plan.gauge) for plan in plans],
        "gap": [abs(float(proof.gap)) for proof in proofs],
        r"left of $z_0$": [float(proof.primal_residual) for proof in proofs],
        r"$\alpha$ with a step less": [float(plan.shorter_gauge) for plan in plans],
    }


def printed_inputs(z0: ArrayLike, interval: float = 0.25, peak: float = 0.0035) -> Columns:
    """The gauge of the paper's system for B(k) as derived and as printed, beside the printed 0.9286."""
    derived = [satellite.step_input(k, interval) for k in range(4)]
    once = satellite.transition(interval)
    radial, transverse = once[:, 1], once[:, 2]
    even = np.column_stack([radial, once @ transverse, radial])
    odd = np.column_stack([transverse, radial, transverse])
    back = [
        np.linalg.inv(satellite.transition(interval * (3 * (k + 1) // 2 + (k + 1) % 2))) for k in range(4)
    ]
    state, found = vectors("z0", z0, 3), []
    for inputs in (derived, [even, odd, even, odd]):
        factors = peak * np.array(back) @ np.array(inputs)
        found.append([gauge_of_factors(factors[:steps], state) for steps in (3, 4)])
    return {
        "$B(k)$": ["derived", "as printed"],
        r"rank of $B(0)$, $B(1)$": [
            f"{_rank(matrices[0])}, {_rank(matrices[1])}" for matrices in (derived, [even, odd])
        ],
        r"$\alpha(3)$": [float(three.alpha) for three, _ in found],
        r"$\alpha(4)$": [float(four.alpha) for _, four in found],
        "printed": [printed.GAUGE, printed.GAUGE],
        **{rf"$\psi_{i + 1}(0)$": [float(four.costate[i]) for _, four in found] for i in range(3)},
    }


def _rank(matrix: np.ndarray) -> int:
    return int(np.linalg.matrix_rank(matrix))


def power_balls(
    z0: ArrayLike, powers: Sequence[float], interval: float = 0.25, peak: float = 0.0035
) -> Columns:
    """N_min and alpha for p-balls between the paper's ball and the cube."""
    found = [fewest_power_steps(z0, p, interval, peak) for p in powers]
    return {
        "$p$": [f"{p:g}" for p in powers],
        "steps": [one.steps for one, _ in found],
        "impulses": [one.impulse_count for one, _ in found],
        r"$\alpha$": [one.alpha for one, _ in found],
        "gap": [abs(float(one.certificate.gap)) for one, _ in found],
        r"$\alpha$ with a step less": [shorter for _, shorter in found],
    }


def crossed_measures(plans: Sequence[Plan]) -> Columns:
    """For every given plan: peak, energy and fuel of the plans of least peak, least energy and least fuel."""
    rows = [one for plan in plans for one in same_length(plan)]
    return {
        "impulses in": [one.plan.thrust.name for one in rows],
        "least": [one.least for one in rows],
        r"peak$/\alpha_{\max}$": [one.peak for one in rows],
        r"$\sum w^2/\alpha_{\max}^2$": [one.energy for one in rows],
        r"$\sum \lvert w\rvert/\alpha_{\max}$": [one.fuel for one in rows],
        "gap": [abs(float(one.certificate.gap)) for one in rows],
    }


def waste_table(found: Waste) -> Columns:
    """Numbers of impulses of many states under ball, disc and square, and how many the ball wastes."""
    ball = found.counts["ball"]
    return {
        "impulses in": list(found.counts),
        "mean": [float(counts.mean()) for counts in found.counts.values()],
        "most": [int(counts.max()) for counts in found.counts.values()],
        "wasted by the ball, mean": [float(found.wasted(name).mean()) for name in found.counts],
        "most wasted": [int(found.wasted(name).max()) for name in found.counts],
        "share of the ball's": [float(found.wasted(name).sum() / ball.sum()) for name in found.counts],
        "states where it wastes": [float((found.wasted(name) > 0).mean()) for name in found.counts],
    }


def closed_loop(loops: Mapping[str, ClosedLoop]) -> Columns:
    """Each plan of each closed loop: the deviation before it, its impulses, the deviation after it."""
    rows = [(name, loop, i) for name, loop in loops.items() for i in range(len(loop.plans))]
    before = [float(loop.residuals[i]) for _, loop, i in rows]
    after = [float(loop.residuals[i + 1]) for _, loop, i in rows]
    return {
        "impulses in": [name for name, _, _ in rows],
        "plan": [i + 1 for _, _, i in rows],
        "starts from": before,
        "impulses": [int(loop.impulse_counts[i]) for _, loop, i in rows],
        "leaves": after,
        "over the square of its start": [b / a**2 for a, b in zip(before, after, strict=True)],
    }


def limits(z0: ArrayLike, intervals: Mapping[str, float], peak: float = 0.0035, steps: int = 3000) -> Columns:
    """alpha N at a large N and its limit, for named intervals and every set of impulses."""
    rows = [(words, h, name) for words, h in intervals.items() for name in THRUSTS]
    ends = [ergodic.limit(z0, h, peak, name) for _, h, name in rows]
    reached = [float(ergodic.approach(z0, [steps], h, peak, name)[0]) for _, h, name in rows]
    each = [1.5 if name == "ball" else 1.0 for _, _, name in rows]
    return {
        r"$\Delta t$": [words for words, _, _ in rows],
        "impulses in": [name for _, _, name in rows],
        rf"$\alpha N$ at $N = {steps}$": reached,
        "limit": ends,
        "limit in impulses": [factor * end for factor, end in zip(each, ends, strict=True)],
    }


def special_intervals(z0: ArrayLike, intervals: Mapping[str, float], peak: float = 0.0035) -> Columns:
    """Plans for the paper's ball at named intervals: number of impulses, gauge and certificate."""
    plans = [correct(z0, interval, peak) for interval in intervals.values()]
    return {
        r"$\Delta t$": list(intervals),
        "impulses": [int(plan.impulse_count) for plan in plans],
        r"$\alpha$": [float(plan.gauge) for plan in plans],
        "gap": [abs(float(plan.certificate.gap)) for plan in plans],
        r"left of $z_0$": [float(plan.certificate.primal_residual) for plan in plans],
    }


def distribution(found: Distribution, shares: Sequence[float] = (0.5, 0.9, 0.99)) -> Columns:
    """Mean and quantiles of the number of impulses over injection errors."""
    columns: Columns = {
        "impulses in": list(found.counts),
        "mean": [found.mean(name) for name in found.counts],
    }
    for share in shares:
        columns[f"enough for {100 * share:g} %"] = [found.quantile(name, share) for name in found.counts]
    return columns | {"most": [int(counts.max()) for counts in found.counts.values()]}
