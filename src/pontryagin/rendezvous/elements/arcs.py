"""One arc of an extremal in Sapunkov's elements, up to its end or to the switch before it.

The independent variable is phi. The states are A, B, their costates a, b, the time and what L has cost so
far; along them run the derivatives in six unknown costates at the start. Four modes of thrust along n:

unsaturated  n/2                                      alpha1 + alpha2 p^2 below the peak
saturated    p_max n/|n|                              any functional
coast        0                                        alpha1 + alpha2 |p|
smoothed     p_max n/|n| (1 + tanh(S/width))/2        alpha1 + alpha2 |p| with its jump at S = |n| - 1 blunted

The rates are those of `kernels`, whatever the thrust. Units are those of `Scaled`, alpha2 = 1.
"""

import functools
import types
from collections.abc import Callable
from typing import Literal, NamedTuple, Protocol

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.flow import (
    ROUGH,
    TOLERANCE,
    has_heyoka,
)
from pontryagin.rendezvous import kernels

Mode = Literal["unsaturated", "saturated", "coast", "smoothed"]

ELEMENTS, COSTATES, TIME, SPENT = slice(0, 8), slice(8, 16), 16, 17
COUNT, COLUMNS = 18, 6
STRIDE = 8.0
"""Longest step of phi under a smoothed jump, in its widths.

A coast under it is a straight line to rounding, and steps without limit would leap over the burn behind it.
"""
STEPS_PER_UNIT = 80
"""An arc that needs more Taylor steps than this per unit of phi runs into a singularity."""


class Constants(NamedTuple):
    """Of a mode: p_max, L at p_max, |n| at which the arc ends, width of the smoothed jump."""

    peak: float = 1.0
    charge: float = 0.0
    level: float = 1e30
    width: float = 1.0


class Reached(NamedTuple):
    """Where an arc ended: phi, the states and derivatives (126,), whether at a switch."""

    phi: float
    whole: Array
    switched: bool


class Arc(Protocol):
    """An integrator of one mode."""

    def run(self, whole: Array, begin: float, end: float, constants: Constants) -> Reached:
        """From ``whole`` at phi = ``begin`` to ``end``, or to the switch before it."""

    def sample(self, whole: Array, grid: Array, constants: Constants) -> Array:
        """The states (k, 18) at ascending phi of one arc that begins at the first of them."""


@functools.cache
def arc(mode: Mode, taylor: bool | None = None, rough: bool = False) -> Arc:
    """The integrator of a mode: heyoka's Taylor series, or SciPy's DOP853 where heyoka has no wheel."""
    use_taylor = has_heyoka() if taylor is None else taylor
    return (_Taylor if use_taylor else _RungeKutta)(mode, rough)


def steered(mode: Mode, n, constants, sqrt: Callable, tanh: Callable) -> tuple[list, object]:
    """Thrust and its L of n; on floats, complex arrays or heyoka's expressions."""
    peak, charge, _, width = constants
    square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2]
    if mode == "coast":
        return [0.0 * part for part in n], 0.0 * square
    if mode == "unsaturated":
        return [0.5 * part for part in n], 0.25 * square
    size = sqrt(square)
    if mode == "saturated":
        return [peak * part / size for part in n], charge + 0.0 * square
    share = 0.5 + 0.5 * tanh((size - 1.0) / width)
    return [peak * share * part / size for part in n], charge * share


def rates_of(mode: Mode, x, phi, constants, functions: "Functions") -> list:
    """Rates of the 18 states by phi."""
    n = functions.switching(*x[:16], phi)
    thrust, cost = steered(mode, n, constants, functions.sqrt, functions.tanh)
    *moving, clock = functions.rates(*x[:16], phi, *thrust)
    return [*moving, clock, clock * cost]


def _beyond(x, phi, constants, functions: "Functions"):
    """|n|^2/level^2 - 1."""
    n = functions.switching(*x[:16], phi)
    level = constants[2]
    return (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / (level * level) - 1.0


class Functions(NamedTuple):
    """The kernels and what they call."""

    rates: Callable
    switching: Callable
    sqrt: Callable
    tanh: Callable


NUMERIC = Functions(kernels.element_rates, kernels.element_switching, np.sqrt, np.tanh)

RISING = {"unsaturated": 1.0, "saturated": -1.0, "coast": 1.0, "smoothed": 1.0}
"""The sense in which |n| passes the level where an arc ends."""


class _Taylor:
    def __init__(self, mode: Mode, rough: bool) -> None:
        import heyoka as hy

        def root(x):
            """Of a number too: heyoka takes none."""
            return np.sqrt(x) if isinstance(x, int) else hy.sqrt(x)

        def lifted(kernel: Callable) -> Callable:
            """The kernel's own text, on heyoka's expressions."""
            known = {"sqrt": root, "sin": hy.sin, "cos": hy.cos}
            return types.FunctionType(kernel.__code__, known, kernel.__name__)

        functions = Functions(
            lifted(kernels.element_rates), lifted(kernels.element_switching), hy.sqrt, hy.tanh
        )
        names = [f"{group}{i}" for group in ("A", "B", "a", "b") for i in range(4)]
        x = hy.make_vars(*names, "t", "spent")
        constants = [hy.par[i] for i in range(4)]
        rates = rates_of(mode, x, hy.time, constants, functions)
        system = hy.var_ode_sys(list(zip(x, rates, strict=True)), x[8:14], order=1)
        sense = hy.event_direction.positive if RISING[mode] > 0 else hy.event_direction.negative
        event = hy.t_event(_beyond(x, hy.time, constants, functions), direction=sense)
        self._hy, self._mode, self._count = hy, mode, 4 if mode == "smoothed" else 3
        self._integrator = hy.taylor_adaptive(
            system,
            np.ones(COUNT),
            pars=[1.0] * self._count,
            tol=ROUGH if rough else TOLERANCE,
            compact_mode=True,
            t_events=[event],
        )

    def _begin(self, whole: Array, phi: float, constants: Constants):
        integrator = self._integrator
        integrator.reset_cooldowns()
        integrator.time = phi
        integrator.state[:] = whole
        integrator.pars[:] = constants[: self._count]
        return integrator

    def _require(self, outcome, left: float) -> None:
        if outcome != self._hy.taylor_outcome.time_limit:
            raise NotConverged(f"the Taylor integrator stopped: {outcome}", left)

    def run(self, whole: Array, begin: float, end: float, constants: Constants) -> Reached:
        integrator = self._begin(whole, begin, constants)
        limits = {"max_delta_t": _stride(self._mode, constants), "max_steps": _steps(end - begin)}
        outcome = integrator.propagate_until(end, **limits)[0]
        switched = int(outcome) == -1
        if not switched:
            self._require(outcome, end - integrator.time)
        return Reached(float(integrator.time), integrator.state.copy(), switched)

    def sample(self, whole: Array, grid: Array, constants: Constants) -> Array:
        integrator = self._begin(whole, grid[0], constants)
        limits = {"max_delta_t": _stride(self._mode, constants), "max_steps": _steps(grid[-1] - grid[0])}
        outcome, *_, states = integrator.propagate_grid(grid, **limits)
        filled = states[:, :COUNT]
        if int(outcome) == -1:  # the last phi is the switch itself
            filled[~np.isfinite(filled).all(axis=1)] = integrator.state[:COUNT]
        else:
            self._require(outcome, grid[-1] - integrator.time)
        return filled


class _RungeKutta:
    def __init__(self, mode: Mode, rough: bool) -> None:
        self._mode, self._tolerance = mode, ROUGH if rough else 1e-13

    def _solve(self, whole: Array, begin: float, end: float, grid, constants: Constants):
        from scipy.integrate import solve_ivp

        step = 1e-30

        def rate(phi: float, flat: Array) -> Array:
            """Rates, and along each column their derivative by a complex step, exact to rounding."""
            columns = flat[COUNT:].reshape(COUNT, -1)
            x = np.column_stack([flat[:COUNT], flat[:COUNT, None] + 1j * step * columns])
            slopes = np.array(rates_of(self._mode, x, phi, constants, NUMERIC))
            return np.concatenate([slopes[:, 0].real, (slopes[:, 1:].imag / step).ravel()])

        def leaving(phi: float, flat: Array) -> float:
            return float(_beyond(flat[:COUNT], phi, constants, NUMERIC))

        leaving.terminal, leaving.direction = True, RISING[self._mode]  # type: ignore[attr-defined]
        with np.errstate(all="ignore"):
            result = solve_ivp(
                rate,
                (begin, end),
                whole,
                "DOP853",
                grid,
                events=[leaving],
                max_step=_stride(self._mode, constants),
                rtol=self._tolerance,
                atol=self._tolerance / 10,
            )
        if result.status < 0 or not np.isfinite(result.y[:, -1:]).all():
            raise NotConverged(f"the Runge-Kutta integrator stopped: {result.message}", end - begin)
        return result

    def run(self, whole: Array, begin: float, end: float, constants: Constants) -> Reached:
        result = self._solve(whole, begin, end, None, constants)
        if result.status == 1:
            return Reached(float(result.t_events[0][0]), result.y_events[0][0], True)
        return Reached(end, result.y[:, -1], False)

    def sample(self, whole: Array, grid: Array, constants: Constants) -> Array:
        result = self._solve(whole[:COUNT], grid[0], grid[-1], grid, constants)
        missing = len(grid) - result.y.shape[1]  # the last phi is the switch itself
        tail = [result.y_events[0][0]] * missing if missing else []
        return np.vstack([result.y.T, *tail])


def _stride(mode: Mode, constants: Constants) -> float:
    return STRIDE * constants.width if mode == "smoothed" else np.inf


def _steps(span: float) -> int:
    return int(STEPS_PER_UNIT * (1 + span))
