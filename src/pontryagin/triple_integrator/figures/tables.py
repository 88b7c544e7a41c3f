"""Tables of this paper, as columns for `plotting.show_table`."""

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.triple_integrator.attitude import turn
from pontryagin.triple_integrator.attitude.rigid_body import RigidBody
from pontryagin.triple_integrator.figures import duration, labels, overpayment, sphere
from pontryagin.triple_integrator.figures.labels import Solution
from pontryagin.triple_integrator.least_time.time import minimum_time
from pontryagin.triple_integrator.norms.impulse import REGIMES, ImpulseSolution, minimum_impulse
from pontryagin.triple_integrator.norms.peak import minimum_peak
from pontryagin.triple_integrator.problem.maneuver import Maneuver

Columns = dict[str, list[Any]]


def examples(angle: float, T: float) -> Columns:
    """The paper's printed numbers for the turn from rest to rest by an angle, beside those of the solvers."""
    maneuver = Maneuver([0, 0, 0], [angle, 0, 0], tf=T)
    energy, peak, impulse = labels.three(maneuver)
    level = 32 * angle / T**3
    time = 2 * np.cbrt(4 * angle / level)
    least = minimum_time([0, 0, 0], [angle, 0, 0], level)
    start, middle = energy.control([0.0, T / 2])
    first, second = peak.switch_times
    rows: list[tuple[str, str, float, Any, Any]] = [
        ("least energy, start", r"$60\gamma_T/T^3$", 60 * angle / T**3, start, energy),
        ("least energy, middle", r"$-30\gamma_T/T^3$", -30 * angle / T**3, middle, energy),
        ("least peak", r"$32\gamma_T/T^3$", level, peak.norm, peak),
        ("its first switch", r"$T/4$", T / 4, first, peak),
        ("its second switch", r"$3T/4$", 3 * T / 4, second, peak),
        ("least time for it", r"$2(4\gamma_T/u_0)^{1/3}$", time, least.duration, least),
        ("least total impulse", r"$16\gamma_T/T^2$", 16 * angle / T**2, impulse.norm, impulse),
        ("total impulse of the least peak", r"$32\gamma_T/T^2$", 32 * angle / T**2, peak.norm * T, peak),
    ]  # fmt: skip
    return {
        "quantity": [row[0] for row in rows],
        "printed": [row[1] for row in rows],
        "its value": [row[2] for row in rows],
        "solved": [float(row[3]) for row in rows],
        "relative difference": [abs(float(row[3]) / row[2] - 1) for row in rows],
        "certified gap": [abs(float(row[4].certificate.gap)) for row in rows],
    }


def crossed_norms(maneuver: Maneuver) -> Columns:
    """The norms L2, L-infinity and L1 of each of the three programmes."""
    T = float(labels.single(maneuver).duration)
    energy, peak, impulse = labels.three(maneuver)
    t = np.linspace(float(maneuver.t0), float(maneuver.tf), 20001)
    u = np.abs(energy.control(t))
    area = float(np.sum((u[1:] + u[:-1]) * np.diff(t)) / 2)
    level, total = float(peak.norm), float(impulse.norm)
    beyond = np.inf if total else 0.0
    return {
        "programme": [labels.name(solution) for solution in (energy, peak, impulse)],
        r"$\lVert u\rVert_2$": [float(energy.norm), level * np.sqrt(T), beyond],
        r"$\max\lvert u\rvert$": [float(u.max()), level, beyond],
        r"$\int \lvert u\rvert\,dt$": [area, level * T, total],
    }


def certificates(maneuver: Maneuver) -> Columns:
    """Value, lower bound, gap and residual for each of the three problems."""
    solutions: list[Solution] = [*labels.three(maneuver)]
    proofs = [solution.certificate for solution in solutions]
    return {
        "problem": [labels.name(solution) for solution in solutions],
        "value": [float(proof.primal_value) for proof in proofs],
        "bound from below": [float(proof.dual_value) for proof in proofs],
        "gap": [abs(float(proof.gap)) for proof in proofs],
        "residual of the moments": [float(proof.primal_residual) for proof in proofs],
    }


def regime_shares(size: int = 800) -> Columns:
    """Share of the directions of (6 c1, 2 c2, c3), T = 1, in each regime, and how (4.10) compares there.

    Parameters
    ----------
    size : int
        Cells along each side of the equal-area map over which directions are counted.
    """
    directions, inside = sphere.grid(size)
    maneuvers = sphere.maneuvers(directions[inside])
    solution = minimum_impulse(maneuvers)
    value, total = overpayment.printed(maneuvers.moments)
    rows = [solution.regime_index == REGIMES.index(name) for name in REGIMES[1:]]
    return {
        "regime": list(REGIMES[1:]),
        "share of directions": [round(float(row.mean()), 3) for row in rows],
        r"least $\lvert F\rvert/T^2$ over least impulse": _rounded(value / solution.norm, rows, np.min),
        "most paid for the printed impulses": _rounded(total / solution.norm, rows, np.max),
        "mean paid": _rounded(total / solution.norm, rows, np.mean),
    }


def impulse_examples(moments: Sequence[ArrayLike]) -> Columns:
    """Impulses, regime and bound for moments (c1, c2, c3), T = 1, beside the printed formula (4.10)."""
    c = np.asarray(moments, dtype=float)
    solution = minimum_impulse(Maneuver([0, 0, 0], c, 1.0))
    value, total = overpayment.printed(c)
    return {
        "$c$": [f"({', '.join(str(Fraction(x).limit_denominator(1000)) for x in row)})" for row in c],
        "regime": list(solution.regime),
        "impulses": [_impulses(solution, i) for i in range(len(c))],
        "total": list(solution.norm),
        "bound": list(solution.certificate.dual_value),
        r"printed $\lvert F\rvert/T^2$": list(value),
        "printed impulses pay": list(total),
        "unique": [bool(unique) for unique in solution.unique],
    }


def times_of_one_bound(x0: ArrayLike, xf: ArrayLike, bound: float, durations: tuple[float, float]) -> Columns:
    """All durations within limits whose least peak is the bound, with the least time marked."""
    sampled = np.geomspace(*durations, 4001)
    at = np.broadcast_to(np.asarray(x0, float), (4001, 3)), np.broadcast_to(np.asarray(xf, float), (4001, 3))
    times = duration.crossings(sampled, minimum_peak(Maneuver(*at, sampled)).norm, bound)
    found = np.array([_refined(x0, xf, bound, time) for time in times])
    stack = Maneuver(at[0][: len(found)], at[1][: len(found)], found)
    least = float(minimum_time(x0, xf, bound).duration)
    solution = minimum_peak(stack)
    return {
        "$T$, s": list(found),
        "$u_0(T)$, rad/s³": list(solution.norm),
        r"$\mathcal{H}$": list(duration.hamiltonian(solution)),
        "least time": ["yes" if abs(time - least) < 1e-9 * least else "no" for time in found],
    }


def turn_misses(body: RigidBody, axis: ArrayLike, maneuver: Maneuver) -> Columns:
    """Errors of the body's attitude and rate at the end, with and without gyroscopic feedforward."""
    columns: Columns = {
        "programme": [],
        "gyroscopic torque": [],
        "attitude missed, degrees": [],
        "rate missed, rad/s": [],
    }
    programmes: list[Solution] = [*labels.three(maneuver)]
    for programme in programmes:
        for feedforward in (True, False):
            made = turn(body, axis, programme, feedforward)
            row = (labels.name(programme), "fed forward" if feedforward else "left out")
            for column, value in zip(
                columns.values(), (*row, np.rad2deg(made.attitude_miss), made.rate_miss), strict=True
            ):
                column.append(value)
    return columns


def _impulses(solution: ImpulseSolution, i: int) -> str:
    present = zip(solution.impulse_times[i], solution.impulses[i], strict=True)
    return ", ".join(f"{size:.4g} at {time:.4g}" for time, size in present if size).replace("-", "−")


def _rounded(ratio: Array, rows: Sequence[Array], of: Callable[[Array], Any]) -> list[float]:
    """A statistic of the ratio over each regime, to the three digits that a count of cells determines."""
    return [round(float(of(ratio[row])), 3) for row in rows]


def _refined(x0: ArrayLike, xf: ArrayLike, bound: float, near: float) -> float:
    from scipy.optimize import brentq

    def excess(T: float) -> float:
        return float(minimum_peak(Maneuver(x0, xf, T)).norm) - bound

    return float(brentq(excess, 0.998 * near, 1.002 * near, xtol=1e-14, rtol=1e-15))
