"""Tables of this paper, as columns for `plotting.show_table`."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import sympy as sp
from scipy.integrate import quad
from scipy.special import ellipe

from pontryagin.averaging import cost_errors
from pontryagin.averaging.averaged.solution import AveragedSolution
from pontryagin.averaging.exact.count import window
from pontryagin.averaging.exact.extremal import Extremals
from pontryagin.averaging.examples.kepler import kepler
from pontryagin.averaging.examples.rotor import rotor
from pontryagin.averaging.examples.smooth import smooth_example
from pontryagin.averaging.examples.spin_down import spin_down

X = sp.Symbol("x", real=True)
UNEVEN = 1 + sp.cos(X) / 5
WELL = sp.cos(X)

Columns = dict[str, list[Any]]


def rotors(a0: float = 3.0, a1: float = 6.0) -> Columns:
    """Averaged optima of rotors between two energies, in least time and at the cost 1 + u^2."""
    cases: dict[str, dict[str, Any]] = {
        "flywheel": {"mass": 1, "potential": 0, "force": 0},
        "pendulum, $V = \\cos x$": {"mass": 1, "potential": WELL, "force": 0},
        "uneven pendulum, $m = 1 + \\frac15\\cos x$": {"mass": UNEVEN, "potential": WELL, "force": 0},
        "the same with drag, $f = -\\frac15$": {
            "mass": UNEVEN,
            "potential": WELL,
            "force": -sp.Rational(1, 5),
        },
    }
    rows: list[tuple[str, str, AveragedSolution]] = []
    for name, parts in cases.items():
        rows.append((name, "least time, $|u| \\le 1$", rotor(a0, a1, **parts, peak=1.0)))
        rows.append((name, "$1 + u^2$", rotor(a0, a1, **parts, k=1.0)))
    return {
        "rotor": [name for name, _, _ in rows],
        "cost": [cost for _, cost, _ in rows],
        "$\\tau_1$": [f"{float(one.duration):.10f}" for _, _, one in rows],
        "$J_0$": [f"{float(one.cost):.10f}" for _, _, one in rows],
        "residual": [f"{float(one.certificate.residual):.0e}" for _, _, one in rows],
    }


def closed_forms() -> Columns:
    """Durations computed numerically, beside those of the closed forms."""
    rows: list[tuple[str, AveragedSolution, float]] = [
        ("smooth, from 1 to 2", smooth_example(1, 2, k=1), 1.0),
        ("smooth, from 3 to 1, $k = \\frac14$", smooth_example(3, 1, k=0.25), 4.0),
        (
            "rotor, $V = \\cos x$, least time",
            rotor(3, 6, mass=1, potential=WELL, force=0, peak=1),
            _fall(3, 6),
        ),
        ("orbit raised", kepler(-0.5, 0.95, -0.35, 0.1), _orbit(-0.5, -0.35, 0.1)),
        ("orbit lowered", kepler(-0.2, 1.2, -0.6, 0.3), _orbit(-0.2, -0.6, 0.3)),
        ("spin-down, $l_y = l_x/2$", spin_down([3, 4, 2], [1, 0.5, 1], 0.5), _stop(5, 1, 0.5)),
        ("spin-down, $l_y = 4l_x$", spin_down([3, 4, 2], [0.5, 2, 1], 0.5), _stop(5, 0.5, 2)),
    ]
    return {
        "problem": [name for name, _, _ in rows],
        "$\\tau_1$": [f"{float(one.duration):.12f}" for _, one, _ in rows],
        "closed form": [f"{value:.12f}" for _, _, value in rows],
        "difference": [f"{abs(float(one.duration) - value):.0e}" for _, one, value in rows],
        "residual": [f"{float(one.certificate.residual):.0e}" for _, one, _ in rows],
    }


def root_counts(epsilons: Sequence[float]) -> Columns:
    """Extremals of the rippled flywheel at each epsilon, their predicted number, and the least cost."""
    solution = smooth_example(1, 2, k=1.0, ripple=0.5)
    predicted = window(solution)
    found = [solution.exact(epsilon) for epsilon in epsilons]
    worst = [max(one.certificate.residual for one in some) for some in found]
    return {
        "$\\varepsilon$": [f"{epsilon:g}" for epsilon in epsilons],
        "extremals": [len(some) for some in found],
        "minima": [sum(one.kind == "minimum" for one in some) for some in found],
        "predicted": [f"{predicted.count(epsilon):.1f}" for epsilon in epsilons],
        "largest residual": [f"{float(value):.0e}" for value in worst],
        "least $J$": [f"{some[0].cost:.8f}" for some in found],
        "$(J - J_0)/\\varepsilon$": [
            f"{(some[0].cost - float(solution.cost)) / epsilon:.3f}"
            for some, epsilon in zip(found, epsilons, strict=True)
        ],
    }


def extremals(found: Extremals, count: int) -> Columns:
    """The cheapest extremals of one problem, numbered among all that were found."""
    some = found[:count]
    return {
        "": [f"{i + 1} of {len(found)}" for i in range(len(some))],
        "kind": [one.kind for one in some],
        "$J$": [f"{one.cost:.8f}" for one in some],
        "$\\tau_1$": [f"{one.duration:.6f}" for one in some],
        "turns": [f"{one.turns:.3f}" for one in some],
        "residual": [f"{float(one.certificate.residual):.0e}" for one in some],
    }


def slopes() -> Columns:
    """J0, the parts of J1, and the slopes of the errors for the problems of `cost_errors.problems`."""
    rows = [cost_errors.errors(name) for name in cost_errors.problems()]
    return {
        "problem": [row.name for row in rows],
        "$J_0$": [f"{row.first:.6f}" for row in rows],
        **{f"$J_1$: {part}": [f"{row.terms[part]:z.5f}" for row in rows] for part in ("start", "end", "way")},
        "error$/\\varepsilon$, $J_0$": [f"{(row.averaged / row.epsilon).max():.3f}" for row in rows],
        "error$/\\varepsilon^2$, corrected": [
            f"{(row.corrected / row.epsilon**2).max():.2f}" for row in rows
        ],
        "slope, $J_0$": [f"{row.slope(row.averaged):.2f}" for row in rows],
        "slope, ends only": [f"{row.slope(row.ends):.2f}" for row in rows],
        "slope, $J_0 + \\varepsilon J_1$": [f"{row.slope(row.corrected):.2f}" for row in rows],
    }


def answers(solution: AveragedSolution, epsilon: float, phase: float = 0.0) -> Columns:
    """Costs, durations and residuals of one problem: averaged, corrected and exact."""
    found = solution.exact(epsilon, phase)
    corrected = float(solution.cost) + epsilon * float(solution.correction(phase))
    return {
        "": ["averaged, $J_0$", "corrected, $J_0 + \\varepsilon J_1$", f"best of {len(found)} extremals"],
        "cost": [f"{float(solution.cost):.8f}", f"{corrected:.8f}", f"{found[0].cost:.8f}"],
        "$\\tau_1$": [f"{float(solution.duration):.6f}", "", f"{found[0].duration:.6f}"],
        "residual": [
            f"{float(solution.certificate.residual):.0e}",
            "",
            f"{float(found[0].certificate.residual):.0e}",
        ],
    }


def _fall(a0: float, a1: float) -> float:
    """Least time of the pendulum: the integral of da/omega, 1/omega being an elliptic integral."""

    def turn(a: float) -> float:
        return quad(lambda x: 1 / np.sqrt(2 * (a - np.cos(x))), 0, 2 * np.pi, epsabs=1e-13)[0] / (2 * np.pi)

    return quad(turn, a0, a1, epsabs=1e-13)[0]


def _orbit(E0: float, E1: float, l: float) -> float:
    return float(np.sqrt(2 / l) * abs(np.sqrt(-E1) - np.sqrt(-E0)))


def _stop(a0: float, lx: float, ly: float) -> float:
    return float(a0 * np.pi / (2 * lx * ellipe(1 - (ly / lx) ** 2)))
