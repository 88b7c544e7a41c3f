"""Exact extremals of the unaveraged problem, each with its trajectory and its certificate."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import overload

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.averaging.exact.arcs import switched_flow
from pontryagin.averaging.exact.canonical import Canonical, y
from pontryagin.averaging.exact.family import Family
from pontryagin.certificate import MaximumPrinciple
from pontryagin.numerics import compile as compiler
from pontryagin.numerics.flow import Flow, flow
from pontryagin.validation import times
from pontryagin.value import value_class


@value_class
@dataclass(frozen=True, eq=False)
class Extremal:
    """One extremal of the unaveraged problem with n slow variables.

    Attributes
    ----------
    cost : float
        J.
    duration : float
        tau_1 = epsilon t_1.
    kind : str
        "minimum" or "maximum" of J among the solutions that end at neighbouring anomalies.
    epsilon : float
    starting_anomaly, ending_anomaly : float
        x at the start, in its first turn, and at the end; for `spin_down`, the angle chi of `rotating_frame`.
    curvature : float
        d^2 J / dtheta^2 along the family, epsilon dy/dtheta: the sign decides `kind`.
    initial : (2n + 3,) array
        (a, p, p_x/epsilon, tau, J) at the start, in the variables of the exact equations.
    equations : Canonical
        The exact equations that it solves.
    parameters : array
        epsilon, then the system's numbers.
    certify : callable
        Makes the certificate at its first use.
    turn_to_phase : callable
        Gives psi from slow variables (k, n) and anomalies (k,).
    view : callable or None
        Converts states and controls of the equations to the problem's own variables, where these differ.
    """

    cost: float
    duration: float
    kind: str
    epsilon: float
    starting_anomaly: float
    ending_anomaly: float
    curvature: float
    initial: Array
    equations: Canonical = field(repr=False)
    parameters: Array = field(repr=False)
    certify: Callable[[], MaximumPrinciple] = field(repr=False, compare=False)
    turn_to_phase: Callable[[Array, Array], Array] = field(repr=False, compare=False)
    view: Callable[[Array, Array], Array] | None = field(default=None, repr=False, compare=False)

    @cached_property
    def certificate(self) -> MaximumPrinciple:
        """Residuals of the maximum principle, from a second propagation by another integrator."""
        return self.certify()

    @property
    def turns(self) -> float:
        """Turns of the anomaly."""
        return (self.ending_anomaly - self.starting_anomaly) / (2 * np.pi)

    def slow(self, tau: ArrayLike) -> Array:
        """The slow variables a at slow times (k,), as (k, n)."""
        own = self._own(tau)
        return own[:, : _slow_count(own)]

    def costate(self, tau: ArrayLike) -> Array:
        """p at slow times (k,), as (k, n)."""
        own = self._own(tau)
        return own[:, _slow_count(own) : 2 * _slow_count(own)]

    def phase_costate(self, tau: ArrayLike) -> Array:
        """p_x, conjugate to the anomaly, at slow times (k,): of order epsilon, and zero at the end."""
        return self.epsilon * self._states(tau)[:, -4]

    def anomaly(self, tau: ArrayLike) -> Array:
        """x at slow times (k,)."""
        return self._own(tau)[:, -1]

    def phase(self, tau: ArrayLike) -> Array:
        """The rotating phase psi at slow times (k,)."""
        own = self._own(tau)
        return self.turn_to_phase(own[:, : _slow_count(own)], own[:, -1])

    def spent(self, tau: ArrayLike) -> Array:
        """Integral of the running cost up to slow times (k,)."""
        return self._states(tau)[:, -2]

    def control(self, tau: ArrayLike) -> Array:
        """u at slow times (k,), as (k, m)."""
        return self._control(self._states(tau))

    def _control(self, states: Array) -> Array:
        canonical = states[:, : 2 * len(self.equations.slow) + 1]
        (control,) = _control(self.equations)(*canonical.T, states[:, -1], *self.parameters)
        return control[..., 0]

    def _own(self, tau: ArrayLike) -> Array:
        """(a, p, y, tau, J, x) in the variables of the averaged solution."""
        states = self._states(tau)
        return states if self.view is None else self.view(states, self._control(states))

    def _states(self, tau: ArrayLike) -> Array:
        """(a, p, y, tau, J, x) at slow times (k,) in any order."""
        wanted = times("tau", tau, np.zeros(()), np.asarray(self.duration))
        grid, place = np.unique(np.concatenate([[0.0], wanted]), return_inverse=True)
        start = np.append(self.initial, self.starting_anomaly)
        if len(grid) == 1:
            return np.broadcast_to(start, (len(wanted), len(start)))
        return _follow(self.equations)(start, grid, self.parameters)[place[1:]]


@value_class
@dataclass(frozen=True, eq=False)
class Extremals(Sequence[Extremal]):
    """All extremals found, the least cost first.

    Attributes
    ----------
    items : tuple of Extremal
    epsilon, phase : float
        epsilon and psi_0.
    family : Family or None
        The solutions over the ending anomaly, of which the extremals are those with a stationary cost; None
        where that anomaly cannot be chosen. Its ``limits`` say why the search ended on either side.
    """

    items: tuple[Extremal, ...]
    epsilon: float
    phase: float
    family: Family | None

    @property
    def traced(self) -> Family:
        """The family, which must exist.

        Raises
        ------
        ValueError
            If there is no family, as for the least time with one slow variable.
        """
        if self.family is None:
            raise ValueError(
                "extremals of the least time with one slow variable have no family over the ending anomaly"
            )
        return self.family

    @overload
    def __getitem__(self, index: int) -> Extremal: ...

    @overload
    def __getitem__(self, index: slice) -> tuple[Extremal, ...]: ...

    def __getitem__(self, index: int | slice) -> Extremal | tuple[Extremal, ...]:
        return self.items[index]

    def __len__(self) -> int:
        return len(self.items)

    def __iter__(self) -> Iterator[Extremal]:
        return iter(self.items)


def _slow_count(states: Array) -> int:
    """n of states (k, 2n + 4)."""
    return int(states.shape[1] // 2 - 2)


@lru_cache(maxsize=32)
def _follow(equations: Canonical) -> Flow:
    arguments = ((*equations.states, equations.anomaly), equations.time_rates, equations.parameters)
    return switched_flow(equations.modes, *arguments) if equations.modes else flow(*arguments)


@lru_cache(maxsize=32)
def _control(equations: Canonical) -> Callable[..., tuple[Array, ...]]:
    arguments = [*equations.slow, *equations.costates, y, equations.anomaly, *equations.parameters]
    return compiler.function("control", arguments, {"u": sp.Matrix(equations.control)})
