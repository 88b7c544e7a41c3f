"""The exact canonical equations by native code, heyoka, DOP853 and LSODA, from the same expressions.

Each integrator follows the best extremal of an example from start to end, with the anomaly as the independent
variable. SciPy's integrators call the equations compiled by Numba, with common subexpressions evaluated once.
With sensitivities, the variational equations for the initial costates are integrated too; their right-hand
side is the Jacobian times the sensitivity matrix. The reference is heyoka in long double or, where that is
not available, DOP853 at the tolerance 3e-14.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
import sympy as sp
from scipy.integrate import odeint, solve_ivp

from benchmarks.averaging.enumeration import shot
from benchmarks.averaging.examples import BODY, EXAMPLES, KEPLER, PAID, SMOOTH
from benchmarks.clock import one_call, take_turns
from benchmarks.table import by_heading
from benchmarks.taylor import Single, VectorMode, has_heyoka
from pontryagin.arrays import Array
from pontryagin.averaging.exact.canonical import (
    Canonical,
    y,
)
from pontryagin.numerics import compile as compiler
from pontryagin.numerics.lanes import compiled_lanes, stacked
from pontryagin.numerics.symbolic import Symbolic

TOLERANCE = 1e-12
EPSILON = 0.01
MANY = 64
"""Number of trajectories that are integrated together."""
STEPS = 1_000_000

OURS, LANES = "native code, one trajectory", f"native code, of {MANY} trajectories"
TAYLOR, TOGETHER = "heyoka, one trajectory", f"heyoka, of {MANY} trajectories"
COUNTS = {OURS: 1, LANES: MANY, TAYLOR: 1, TOGETHER: MANY}
"""How many equal trajectories are integrated together; the time is that of one."""


@dataclass(frozen=True)
class Trajectory:
    """The best extremal of an example: equations, start, and the anomalies at which it starts and ends."""

    equations: Canonical
    start: Array
    begin: float
    end: float
    parameters: Array

    @property
    def wrt(self) -> tuple[sp.Symbol, ...]:
        """The variables of the sensitivities: the costates at the start."""
        return (*self.equations.costates, y)

    def with_sensitivities(self) -> Array:
        """The start, followed by the rows of the sensitivities' initial matrix."""
        identity = np.array([[float(x == w) for w in self.wrt] for x in self.equations.states])
        return np.concatenate([self.start, identity.ravel()])


def trajectory(name: str, epsilon: float) -> Trajectory:
    """The best extremal of an example at an epsilon."""
    solution = EXAMPLES[name].one()
    found = solution.exact(epsilon)
    problem, theta, unknowns = shot(solution, found)
    start = problem.starts(unknowns)[0]
    return Trajectory(problem.equations, start, problem.anomaly, float(theta[0]), problem.parameters)


def scalar_rates(path: Trajectory, sensitivities: bool) -> Callable[[float, Array], Array]:
    """The right-hand side compiled by Numba for floats, from the same expressions as heyoka's."""
    from numba import njit

    equations = path.equations
    jacobian = sp.Matrix(equations.rates).jacobian(equations.states) if sensitivities else sp.Matrix()
    names = [sp.Symbol(f"s{i}", real=True) for i in range(1 + len(equations.states) + len(path.parameters))]
    known = dict(zip((equations.anomaly, *equations.states, *equations.parameters), names, strict=True))
    flat = [e.xreplace(known) for e in (*equations.rates, *jacobian)]
    outputs = {f"out{i}": e for i, e in enumerate(flat)}
    scope: dict = {}
    text = "from math import *\n" + compiler.source("kernel", names, outputs, "Rates, then their Jacobian.")
    exec(text, scope)
    kernel = njit(scope["kernel"], error_model="numpy")
    n, m = len(equations.states), len(path.wrt) if sensitivities else 0
    arguments = ", ".join(
        ["t", *(f"z[{i}]" for i in range(n)), *(f"p[{i}]" for i in range(len(path.parameters)))]
    )
    scope = {"kernel": kernel, "np": np, "n": n, "m": m}
    exec(
        f"def rates(t, z, p):\n"
        f"    columns = np.array(kernel({arguments}))\n"
        f"    if m == 0:\n"
        f"        return columns\n"
        f"    out = np.empty(n + n * m)\n"
        f"    out[:n] = columns[:n]\n"
        f"    for i in range(n):\n"
        f"        for k in range(m):\n"
        f"            total = 0.0\n"
        f"            for j in range(n):\n"
        f"                total += columns[n + i * n + j] * z[n + j * m + k]\n"
        f"            out[n + i * m + k] = total\n"
        f"    return out\n",
        scope,
    )
    compiled, parameters = njit(scope["rates"], error_model="numpy"), path.parameters
    return lambda t, z: compiled(t, z, parameters)


def by_solve_ivp(
    path: Trajectory, rates: Callable, start: Array, method: str, tolerance: float = TOLERANCE
) -> Array:
    """The end by one of the methods of SciPy's solve_ivp."""
    found = solve_ivp(rates, (path.begin, path.end), start, method, rtol=tolerance, atol=tolerance)
    return found.y[:, -1] if found.success else np.full(len(start), np.nan)


def by_odeint(path: Trajectory, rates: Callable, start: Array) -> Array:
    """The end by LSODA through SciPy's odeint, whose loop over steps is in Fortran."""
    grid = [path.begin, path.end]
    return odeint(rates, start, grid, rtol=TOLERANCE, atol=TOLERANCE, tfirst=True, mxstep=STEPS)[-1]


def symbolic(path: Trajectory, sensitivities: bool) -> Symbolic:
    """The equations of a trajectory, to be differentiated in the costates at the start or not at all."""
    e = path.equations
    return Symbolic(e.states, tuple(e.rates), e.parameters, e.anomaly, path.wrt if sensitivities else ())


def together(path: Trajectory, count: int, integrate: Callable[..., tuple[Array, Array]]) -> Array:
    """The first of the ends of equal trajectories, which an integrator follows in one call."""
    starts = np.tile(path.start, (count, 1))
    states, slopes = integrate(*stacked(starts, path.begin, path.end, path.parameters, len(path.parameters)))
    return np.concatenate([states[0], slopes[0].ravel()])


def reference(path: Trajectory, rates: Callable, sensitivities: bool) -> Array:
    """The end to more digits than any of the compared integrators gives."""
    start = path.with_sensitivities() if sensitivities else path.start
    if not has_heyoka() or np.finfo(np.longdouble).eps >= np.finfo(float).eps:
        return by_solve_ivp(path, rates, start, "DOP853", 3e-14)
    return together(path, 1, Single(symbolic(path, sensitivities), 1e-18, np.longdouble))


def contestants(path: Trajectory, sensitivities: bool) -> tuple[dict[str, Callable[[], Array]], Array]:
    """One run of each integrator, by name, and the reference end."""
    rates = scalar_rates(path, sensitivities)
    start = path.with_sensitivities() if sensitivities else path.start
    equations = symbolic(path, sensitivities)
    ours = partial(compiled_lanes(equations).run, tolerance=TOLERANCE)
    integrators = {OURS: ours, LANES: ours}
    if has_heyoka():
        integrators |= {TAYLOR: Single(equations, TOLERANCE), TOGETHER: VectorMode(equations, TOLERANCE)}
    found = {
        method: partial(together, path, COUNTS[method], integrate)
        for method, integrate in integrators.items()
    }
    for method in ("DOP853", "LSODA"):
        found[f"{method}, solve_ivp"] = partial(by_solve_ivp, path, rates, start, method)
    found["LSODA, odeint"] = partial(by_odeint, path, rates, start)
    return found, reference(path, rates, sensitivities)


def table(quick: bool) -> dict[str, list]:
    """Time and error of each integrator, with and without sensitivities."""
    rows = []
    for name in (SMOOTH,) if quick else (SMOOTH, PAID, KEPLER, BODY):
        path = trajectory(name, EPSILON)
        turns = (path.end - path.begin) / (2 * np.pi)
        for sensitivities in (False, True):
            runs, exact = contestants(path, sensitivities)
            errors = {method: error(run(), exact) for method, run in runs.items()}
            counted = {method: one_call(run, COUNTS.get(method, 1)) for method, run in runs.items()}
            timings = take_turns(counted, 1 if quick else 3)
            ours = timings[LANES].typical
            rows += [
                {
                    "example": name,
                    "what": "states and sensitivities" if sensitivities else "states",
                    "turns": turns,
                    "integrator": method,
                    "ms": 1e3 * timing.typical,
                    "times native code together": timing.typical / ours,
                    "error": errors[method],
                }
                for method, timing in timings.items()
            ]
    return by_heading(rows)


def error(found: Array, exact: Array) -> float:
    """Largest difference, divided by the largest entry of `exact` where that exceeds one."""
    return float(np.abs(found - exact).max() / max(1.0, np.abs(exact).max()))
