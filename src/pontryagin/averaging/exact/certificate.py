"""Certificates of exact extremals, which are propagated again in slow time, without switches all together.

The search integrates over the anomaly. Here the independent variable is another one, h* comes from the
support function and not from the control that attains it, and without switches the integrator is SciPy's and
the rates are NumPy's.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from scipy.integrate import solve_ivp

from pontryagin.arrays import Array
from pontryagin.averaging.exact.arcs import switched_flow
from pontryagin.averaging.exact.canonical import Canonical, y
from pontryagin.averaging.exact.shooting import Shooting, Shot
from pontryagin.certificate import MaximumPrinciple
from pontryagin.errors import NotConverged
from pontryagin.numerics import compile as compiler
from pontryagin.numerics.flow import Flow

SAMPLES = 200
"""The Hamiltonian and its maximum are evaluated at this many points of each trajectory."""


@dataclass(frozen=True, eq=False)
class ExactCertificates:
    """Residuals of k extremals of one problem, computed together at the first use.

    Target and costates are in the units of `Shooting`, the Hamiltonian and p_x/epsilon times the rate are
    relative to the mean running cost, and the error of the cost is relative to the cost.
    """

    problem: Shooting
    shot: Shot

    def one(self, index: int) -> MaximumPrinciple:
        """The certificate of one extremal."""
        of = self.all
        parts = (of.boundary, of.transversality, of.hamiltonian, of.maximality)
        return MaximumPrinciple(*(np.asarray(part[index]) for part in parts))

    @cached_property
    def all(self) -> MaximumPrinciple:
        """The certificates of all extremals, with residuals (k,)."""
        problem, shot = self.problem, self.shot
        n = len(problem.start)
        path = self._path()
        price = np.abs(shot.cost) / shot.duration
        columns = (*np.moveaxis(path[..., : 2 * n + 1], -1, 0), path[..., -1])
        values = _along(problem.equations)(*columns, *problem.parameters)
        hamiltonian, gap = (np.abs(value).max(axis=0) / price for value in values)
        missing, cost, rate = problem.missing(path[-1, :, :-1], path[-1, :, -1], shot.unknowns)
        r = len(problem.scale_m)
        boundary = np.maximum(np.abs(missing[:, :r]).max(axis=1), np.abs(cost / shot.cost - 1))
        last = np.abs(path[-1, :, 2 * n] * rate) / price
        return MaximumPrinciple(
            boundary, np.maximum(np.abs(missing[:, r:]).max(axis=1), last), hamiltonian, gap
        )

    def _path(self) -> Array:
        """(a, p, y, tau, J, x) at `SAMPLES` + 1 shares of the duration, (samples, k, 2n + 4)."""
        problem, shot = self.problem, self.shot
        starts = np.column_stack([problem.starts(shot.unknowns), np.full(len(shot.theta), problem.anomaly)])
        shares = np.linspace(0.0, 1.0, SAMPLES + 1)
        if problem.equations.modes:
            follow = _arcs(problem.equations)
            each = [
                follow(s, shares * d, problem.parameters) for s, d in zip(starts, shot.duration, strict=True)
            ]
            return np.stack(each, axis=1)
        return _together(problem, starts, shot.duration, shares)


def _together(problem: Shooting, starts: Array, duration: Array, shares: Array) -> Array:
    count, width = starts.shape
    rates = _rates(problem.equations)

    def rate(_: float, flat: Array) -> Array:
        columns = flat.reshape(width, count)
        found = rates(*columns, *problem.parameters)
        return (np.stack(found) * duration).ravel()

    result = solve_ivp(rate, (0.0, 1.0), starts.T.ravel(), "DOP853", shares, rtol=1e-13, atol=1e-14)
    if not result.success:
        raise NotConverged(f"the integration of an extremal stopped: {result.message}", 1.0)
    return result.y.reshape(width, count, len(shares)).transpose(2, 1, 0)


@lru_cache(maxsize=32)
def _rates(equations: Canonical) -> Callable[..., tuple[Array, ...]]:
    arguments = [*equations.states, equations.anomaly, *equations.parameters]
    outputs = {f"d{i}": rate for i, rate in enumerate(equations.time_rates)}
    return compiler.function("rates", arguments, outputs)


@lru_cache(maxsize=32)
def _along(equations: Canonical) -> Callable[..., tuple[Array, ...]]:
    arguments = [*equations.slow, *equations.costates, y, equations.anomaly, *equations.parameters]
    return compiler.function("along", arguments, {"hamiltonian": equations.hamiltonian, "gap": equations.gap})


@lru_cache(maxsize=32)
def _arcs(equations: Canonical) -> Flow:
    states = (*equations.states, equations.anomaly)
    return switched_flow(equations.modes, states, equations.time_rates, equations.parameters)
