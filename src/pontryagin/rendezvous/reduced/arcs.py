"""One arc of an extremal, unsaturated or saturated, up to its end or to the switch before it.

The eleven repaired equations are flown with their derivatives in the six initial costates and in the bound:
p_max rides along as a twelfth state that does not change. Where |n| passes 2 alpha2 p_max the arc ends; the
control is continuous there, so the derivatives go on without a jump. heyoka's Taylor integrator does it,
SciPy's DOP853 where heyoka has no wheel; both run the text of `kernels`. Units are those of `Scaled`.
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

Mode = Literal["unsaturated", "saturated"]

STATES = ("r", "v1", "c", "phi", "rho", "s1", "e", "nu1", "nu2", "nu3", "chi", "p_max")
COSTATES = slice(4, 10)
BOUND = 11
COUNT, COLUMNS = 12, 7
HYSTERESIS = 1e-14
"""An unsaturated arc ends this far above saturation, a saturated one this far below.

heyoka overlooks the other roots of the first step where an arc begins at a root to the last bit.
"""
STEPS_PER_UNIT = 100
"""An arc that needs more Taylor steps than this per unit of time runs into a singularity."""


class Reached(NamedTuple):
    """Where an arc ended: the time, the states and derivatives (96,), whether at a switch."""

    time: float
    whole: Array
    switched: bool


class Arc(Protocol):
    """An integrator of one mode."""

    def run(self, whole: Array, begin: float, end: float, eccentricity: float, chart: int) -> Reached:
        """From ``whole`` at ``begin`` to ``end``, or to the switch before it."""

    def sample(self, whole: Array, times: Array, eccentricity: float, chart: int) -> Array:
        """The states (k, 12) at times of one arc that begins at the first of them."""


def _steps(duration: float) -> int:
    return int(STEPS_PER_UNIT * (1 + duration))


def identity() -> Array:
    """The derivatives (12, 7) at the start: of the six costates and of p_max in themselves."""
    columns = np.zeros((COUNT, COLUMNS))
    columns[COSTATES, :6] = np.eye(6)
    columns[BOUND, 6] = 1.0
    return columns


@functools.cache
def arc(mode: Mode, ends: bool = True, taylor: bool | None = None, rough: bool = False) -> Arc:
    """The integrator of a mode; without ``ends`` it takes no notice of switches (alpha2 = 0)."""
    use_taylor = has_heyoka() if taylor is None else taylor
    return (_Taylor if use_taylor else _RungeKutta)(mode, ends, rough)


def rates(function: Callable, x, eccentricity, chart) -> list:
    """Rates of the twelve states; alpha2 = 1."""
    scale = 1.0 if function.__name__ == "unsaturated" else x[BOUND]
    return [*function(*x[:BOUND], 1.0, 1.0, eccentricity, 1.0, scale, chart), 0.0 * x[BOUND]]


def saturation(function: Callable, x):
    """|n|^2/(2 p_max)^2 - 1, alpha2 = 1."""
    return function(x[0], x[2], x[5], x[6], x[7]) / (4.0 * x[BOUND] * x[BOUND]) - 1.0


def lifted(kernel: Callable) -> Callable:
    """The kernel's own text, on heyoka's expressions."""
    import heyoka as hy

    names = {"sqrt": hy.sqrt, "sin": hy.sin, "cos": hy.cos}
    return types.FunctionType(kernel.__code__, names, kernel.__name__)


class _Taylor:
    def __init__(self, mode: Mode, ends: bool, rough: bool) -> None:
        import heyoka as hy

        x = hy.make_vars(*STATES)
        along = rates(lifted(getattr(kernels, mode)), x, hy.par[0], hy.par[1])
        along[BOUND] = hy.expression(0.0)
        system = hy.var_ode_sys(list(zip(x, along, strict=True)), [*x[COSTATES], x[BOUND]], order=1)
        events = []
        if ends:
            growing = hy.event_direction.positive if mode == "unsaturated" else hy.event_direction.negative
            function = saturation(lifted(kernels.switching_square), x)
            function = function - HYSTERESIS if mode == "unsaturated" else function + HYSTERESIS
            events = [hy.t_event(function, direction=growing)]
        self._hy = hy
        self._integrator = hy.taylor_adaptive(
            system,
            np.ones(COUNT),
            pars=[0.0, 1.0],
            tol=ROUGH if rough else TOLERANCE,
            compact_mode=True,
            t_events=events,
        )
        assert np.array_equal(self._integrator.state[COUNT:], identity().ravel())

    def _begin(self, whole: Array, time: float, eccentricity: float, chart: int):
        integrator = self._integrator
        if integrator.with_events:
            integrator.reset_cooldowns()
        integrator.time = time
        integrator.state[:] = whole
        integrator.pars[:] = eccentricity, chart
        return integrator

    def _require(self, outcome, left: float) -> None:
        if outcome != self._hy.taylor_outcome.time_limit:
            raise NotConverged(f"the Taylor integrator stopped: {outcome}", left)

    def run(self, whole: Array, begin: float, end: float, eccentricity: float, chart: int) -> Reached:
        integrator = self._begin(whole, begin, eccentricity, chart)
        outcome = integrator.propagate_until(end, max_steps=_steps(end - begin))[0]
        switched = int(outcome) == -1
        if not switched:
            self._require(outcome, end - integrator.time)
        return Reached(float(integrator.time), integrator.state.copy(), switched)

    def sample(self, whole: Array, times: Array, eccentricity: float, chart: int) -> Array:
        integrator = self._begin(whole, times[0], eccentricity, chart)
        outcome, *_, states = integrator.propagate_grid(times, max_steps=_steps(times[-1] - times[0]))
        filled = states[:, :COUNT]
        if int(outcome) == -1:  # the last time is the switch itself
            filled[~np.isfinite(filled).all(axis=1)] = integrator.state[:COUNT]
        else:
            self._require(outcome, times[-1] - integrator.time)
        return filled


class _RungeKutta:
    def __init__(self, mode: Mode, ends: bool, rough: bool) -> None:
        self._kernel = getattr(kernels, mode)
        self._tolerance = ROUGH if rough else 1e-13
        self._ends, self._direction = ends, 1.0 if mode == "unsaturated" else -1.0

    def _solve(self, whole: Array, begin: float, end: float, times, eccentricity: float, chart: int):
        from scipy.integrate import solve_ivp

        step = 1e-30

        def rate(_: float, flat: Array) -> Array:
            """Rates, and along each column their derivative by a complex step, exact to rounding."""
            columns = flat[COUNT:].reshape(COUNT, -1)
            x = np.column_stack([flat[:COUNT], flat[:COUNT, None] + 1j * step * columns])
            slopes = np.array(rates(self._kernel, x, eccentricity, chart))
            return np.concatenate([slopes[:, 0].real, (slopes[:, 1:].imag / step).ravel()])

        def leaving(_: float, flat: Array) -> float:
            return float(saturation(kernels.switching_square, flat[:COUNT]))

        leaving.terminal, leaving.direction = True, self._direction  # type: ignore[attr-defined]
        events = [leaving] if self._ends else None
        with np.errstate(all="ignore"):
            result = solve_ivp(
                rate,
                (begin, end),
                whole,
                "DOP853",
                times,
                events=events,
                rtol=self._tolerance,
                atol=self._tolerance / 10,
            )
        if result.status < 0 or not np.isfinite(result.y[:, -1:]).all():
            raise NotConverged(f"the Runge-Kutta integrator stopped: {result.message}", end - begin)
        return result

    def run(self, whole: Array, begin: float, end: float, eccentricity: float, chart: int) -> Reached:
        result = self._solve(whole, begin, end, None, eccentricity, chart)
        if result.status == 1:
            return Reached(float(result.t_events[0][0]), result.y_events[0][0], True)
        return Reached(end, result.y[:, -1], False)

    def sample(self, whole: Array, times: Array, eccentricity: float, chart: int) -> Array:
        result = self._solve(whole[:COUNT], times[0], times[-1], times, eccentricity, chart)
        missing = len(times) - result.y.shape[1]  # the last time is the switch itself
        tail = [result.y_events[0][0]] * missing if missing else []
        return np.vstack([result.y.T, *tail])
