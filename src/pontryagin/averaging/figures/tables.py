"""Tables of this paper: columns for `plotting.show_table`."""

from typing import Any

import numpy as np
import sympy as sp
from scipy.integrate import quad
from scipy.special import ellipe

from pontryagin.averaging.kepler_example import kepler
from pontryagin.averaging.rotor_example import rotor
from pontryagin.averaging.smooth import smooth_example
from pontryagin.averaging.solution import AveragedSolution
from pontryagin.averaging.spin_down_example import spin_down

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
    """Durations by the engine beside those of the closed forms."""
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


def _fall(a0: float, a1: float) -> float:
    """Least time of the pendulum: the integral of da/omega, omega by an elliptic integral's quadrature."""

    def turn(a: float) -> float:
        return quad(lambda x: 1 / np.sqrt(2 * (a - np.cos(x))), 0, 2 * np.pi, epsabs=1e-13)[0] / (2 * np.pi)

    return quad(turn, a0, a1, epsabs=1e-13)[0]


def _orbit(E0: float, E1: float, l: float) -> float:
    return float(np.sqrt(2 / l) * abs(np.sqrt(-E1) - np.sqrt(-E0)))


def _stop(a0: float, lx: float, ly: float) -> float:
    return float(a0 * np.pi / (2 * lx * ellipe(1 - (ly / lx) ** 2)))
