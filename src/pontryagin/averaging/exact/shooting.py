"""Shooting from guesses of the initial costates to the conditions at the end, (1.6), many guesses at once.

Unknowns are w = (p0, alpha); y0 follows from H = 0. The end is where the anomaly has reached theta. The
residual there is M(a1) and p1 + g' + alpha M', in units of the problem's own size. y1 vanishes on extremals:
its roots are sought along the family of solutions over theta.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from functools import lru_cache

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.reference import ReferenceExtremal
from pontryagin.averaging.exact.arcs import switched_ends
from pontryagin.averaging.exact.canonical import Canonical, canonical, y
from pontryagin.errors import NotConverged
from pontryagin.numerics import compile as compiler
from pontryagin.numerics.lanes import Ends, ends
from pontryagin.numerics.newton_stack import solved

TOLERANCE = 3e-15
"""Relative error allowed in a step; over hundreds of turns the errors add up to about 1e-11."""
ROUGH = 1e-9
"""Tolerance of the flow with derivatives, which serves Newton's matrices only and not the residuals."""

Kernel = Callable[..., tuple[Array, ...]]
Selection = int | slice | NDArray[np.intp] | NDArray[np.bool_] | list[int]


@dataclass(frozen=True)
class Shot:
    """The extremals that start from k guesses, at their ends.

    Attributes
    ----------
    theta, unknowns, initial : (k,), (k, n + r), (k,) array
        Anomaly at the end, (p0, alpha), and y0.
    residual : (k, n + r) array
        Scaled errors of the conditions at the end.
    y, hamiltonian, duration, cost : (k,) array
        p_x/epsilon, h* = -y r, slow time and J at the end; extremals have y = 0 there, hence h* = 0, (1.7).
    ends : (k, 2n + 3) array
        States at the end.
    """

    theta: Array
    unknowns: Array
    initial: Array
    residual: Array
    y: Array
    hamiltonian: Array
    duration: Array
    cost: Array
    ends: Array

    @property
    def error(self) -> Array:
        """Largest entry of the residual, (k,)."""
        return np.asarray(np.abs(self.residual).max(axis=-1))

    def __getitem__(self, index: Selection) -> "Shot":
        """The shots of some of the guesses."""
        return Shot(*(getattr(self, f.name)[index] for f in fields(self)))

    def put(self, index: Selection, shot: "Shot") -> None:
        """Overwrite the shots of some of the guesses."""
        for f in fields(self):
            getattr(self, f.name)[index] = getattr(shot, f.name)

    @staticmethod
    def joined(shots: Sequence["Shot"]) -> "Shot":
        """The shots one after the other."""
        return Shot(*(np.concatenate([getattr(s, f.name) for s in shots]) for f in fields(Shot)))


@dataclass(frozen=True)
class Slopes:
    """The conditions at the ends of k extremals, to the tolerance `ROUGH`, and their derivatives.

    Attributes
    ----------
    matrix : (k, n + r + 1, n + r + 1) array
        Derivatives of (residual, y) in (w, theta).
    values : (k, n + r + 1) array
        (residual, y).
    rate : (k,) array
        r at the end.
    """

    matrix: Array
    values: Array
    rate: Array

    @property
    def residual(self) -> Array:
        """The scaled errors of the conditions, (k, n + r)."""
        return self.values[:, :-1]

    @property
    def residual_w(self) -> Array:
        """Derivatives of the residual in w, (k, n + r, n + r)."""
        return self.matrix[:, :-1, :-1]


def along(matrix: Array) -> tuple[Array, Array]:
    """dw/dtheta and dy/dtheta on the family, where the residual stays zero, from the matrices of `Slopes`."""
    w = solved(matrix[:, :-1, :-1], -matrix[:, :-1, -1])
    return w, matrix[:, -1, -1] + (matrix[:, -1, :-1] * w).sum(axis=-1)


@dataclass(frozen=True)
class Shooting:
    """The exact problem of one start and one epsilon.

    Attributes
    ----------
    equations : Canonical
    start : (n,) array
        a0.
    anomaly : float
        x0.
    parameters : (1 + numbers,) array
        epsilon, then the system's numbers.
    scale_a, scale_p, scale_m : (n,), (n,), (r,) array
        Sizes of slow variables, costates and target.
    price : float
        Mean running cost J0/tau1, the size of h*.
    longest : float
        Longest step of the anomaly by which the certificate may follow an extremal.
    """

    equations: Canonical
    start: Array
    anomaly: float
    parameters: Array
    scale_a: Array
    scale_p: Array
    scale_m: Array
    price: float
    longest: float = math.inf

    def shoot(self, theta: Array, w: Array, tolerance: float = TOLERANCE) -> Shot:
        """Follow the extremals with the initial costates p0 to the anomalies theta.

        The tolerance is the relative error allowed in a step, of extremals whose control does not switch; the
        others are followed as exactly in every case.
        """
        starts = self.starts(w)
        reached, _ = _carry(self.equations, tolerance)(starts, self.anomaly, theta, self.parameters)
        return self._shot(theta, w, starts, reached)

    def slopes(self, theta: Array, w: Array) -> Slopes:
        """Conditions at the ends and their derivatives, by the variational equations without tau and J."""
        n, r, count = len(self.start), len(self.scale_m), len(w)
        starts = self.starts(w)[:, : 2 * n + 1]
        reached, through = _derived(self.equations)(starts, self.anomaly, theta, self.parameters)
        rates = _rates(self.equations)(*reached.T, theta, *self.parameters)[0][..., 0]
        _, *motion = _start(self.equations)(*starts.T, self.anomaly, *self.parameters)
        y0_p = -np.stack(motion[:-1], axis=-1) / motion[-1][:, None]
        by_w = np.zeros((count, 2 * n + 1, n + r))
        by_w[..., :n] = through[..., :n] + through[..., n:] * y0_p[:, None, :]
        target, gradient, jacobian, curvature = self.boundary(reached, w)
        by = np.concatenate([by_w, rates[..., None]], axis=-1)
        p_by = by[:, n : 2 * n] + curvature @ by[:, :n]
        p_by[..., n:-1] += jacobian.transpose(0, 2, 1)
        matrix = np.concatenate(
            [jacobian @ by[:, :n] / self.scale_m[:, None], p_by / self.scale_p[:, None], by[:, 2 * n :]],
            axis=1,
        )
        missed = target[..., 0] / self.scale_m
        left = (reached[:, n : 2 * n] + gradient[..., 0]) / self.scale_p
        _, rate = _terminal(self.equations)(*reached[:, :n].T, theta, *self.parameters)
        return Slopes(matrix, np.column_stack([missed, left, reached[:, 2 * n]]), rate)

    def starts(self, w: Array) -> Array:
        """Initial states (k, 2n + 3): y0 from H = 0, (1.8), by Newton's method from y0 = 0."""
        n, count = len(self.start), len(w)
        p = w[:, :n]
        y0 = np.zeros(count)
        for _ in range(50):
            value, *_, rate = _start(self.equations)(*self.start, *p.T, y0, self.anomaly, *self.parameters)
            step = -value / rate
            y0 = y0 + step
            if (np.abs(step) <= 4e-16 * (1 + np.abs(y0))).all():
                break
        else:
            raise NotConverged(
                "Newton's method found no costate of the phase with H = 0 at the start",
                float(np.abs(step).max()),
            )
        fixed = np.broadcast_to(self.start, (count, n))
        return np.concatenate([fixed, p, y0[:, None], np.zeros((count, 2))], axis=1)

    def carry(self, starts: Array, begin: float, end: float) -> Array:
        """States (k, 2n + 3) carried from one anomaly to another, forwards or backwards."""
        return _carry(self.equations, TOLERANCE)(starts, begin, end, self.parameters)[0]

    def boundary(self, reached: Array, w: Array) -> tuple[Array, ...]:
        """M (k, r, 1), g' + alpha M' (k, n, 1), M' (k, r, n) and the second derivatives (k, n, n)."""
        n = len(self.start)
        return _boundary(self.equations)(*reached[:, :n].T, *w[:, n:].T, *self.parameters)

    def missing(self, reached: Array, theta: Array, w: Array) -> tuple[Array, Array, Array]:
        """Scaled residual (k, n + r), J with the terminal cost, and r, at states reached (k, 2n + 3)."""
        n = len(self.start)
        target, gradient, _, _ = self.boundary(reached, w)
        missed = target[..., 0] / self.scale_m
        left = (reached[:, n : 2 * n] + gradient[..., 0]) / self.scale_p
        terminal, rate = _terminal(self.equations)(*reached[:, :n].T, theta, *self.parameters)
        return np.concatenate([missed, left], axis=1), reached[:, 2 * n + 2] + terminal, rate

    def _shot(self, theta: Array, w: Array, starts: Array, reached: Array) -> Shot:
        n = len(self.start)
        residual, cost, rate = self.missing(reached, theta, w)
        y1 = reached[:, 2 * n]
        return Shot(
            theta, w, starts[:, 2 * n], residual, y1, -y1 * rate, reached[:, 2 * n + 1], cost, reached
        )


def shooting(reference: ReferenceExtremal, epsilon: float, anomaly: float) -> Shooting:
    """The exact problem that starts at an anomaly and has a given first approximation."""
    equations = canonical(reference.system)
    numbers = [float(number) for number in reference.numbers]
    grid = np.linspace(0.0, 1.0, 33) * reference.duration
    scale_a = np.abs(reference.slow(grid)).max(axis=0)
    scale_a = np.where(scale_a > 0, scale_a, scale_a.max())
    scale_p = np.maximum(np.abs(reference.costate(grid)).max(axis=0), abs(float(reference.cost)) / scale_a)
    parameters = np.array([epsilon, *numbers])
    alpha = np.atleast_1d(reference.multipliers)
    ends_at = reference.slow(grid)[-1]
    _, _, jacobian, _ = _boundary(equations)(*ends_at, *alpha, *parameters)
    return Shooting(
        equations,
        np.asarray(reference.start, dtype=float),
        anomaly,
        parameters,
        scale_a,
        scale_p,
        np.abs(jacobian) @ scale_a,
        abs(float(reference.cost / reference.duration)),
        2 * float(min(np.diff(reference.turn), default=math.inf)),
    )


# --- kernels, compiled once for the same equations -----------------------------------------------------


@lru_cache(maxsize=32)
def _carry(equations: Canonical, tolerance: float) -> Ends:
    return _ends(equations, (), tolerance)


@lru_cache(maxsize=32)
def _derived(equations: Canonical) -> Ends:
    """(a, p, y) with derivatives, without tau and J, which enter no condition."""
    return _ends(equations, (*equations.costates, y), ROUGH)


def _ends(equations: Canonical, wrt: tuple[sp.Symbol, ...], tolerance: float) -> Ends:
    count = -2 if wrt else None
    states, rates = equations.states[:count], equations.rates[:count]
    arguments = (states, rates, equations.parameters, equations.anomaly, wrt)
    if equations.modes:
        return switched_ends(equations.modes, *arguments)
    return ends(*arguments, tolerance=tolerance)


@lru_cache(maxsize=32)
def _rates(equations: Canonical) -> Kernel:
    """d(a, p, y)/dx."""
    rates = equations.unswitched(equations.rates[:-2])
    arguments = [*equations.states[:-2], equations.anomaly, *equations.parameters]
    return compiler.function("rates", arguments, {"rates": sp.Matrix(rates)})


@lru_cache(maxsize=32)
def _start(equations: Canonical) -> Kernel:
    arguments = [*equations.slow, *equations.costates, y, equations.anomaly, *equations.parameters]
    motion = {f"motion_{i}": g for i, g in enumerate(equations.motion)}
    return compiler.function("start", arguments, {"hamiltonian": equations.hamiltonian, **motion})


@lru_cache(maxsize=32)
def _boundary(equations: Canonical) -> Kernel:
    target = sp.Matrix(equations.boundary)
    alpha = sp.symbols(f"alpha:{len(target)}", real=True)
    lagrangian = equations.terminal_cost + sum(c * m for c, m in zip(alpha, target, strict=True))
    gradient = sp.Matrix([lagrangian]).jacobian(equations.slow).T
    return compiler.function(
        "boundary",
        [*equations.slow, *alpha, *equations.parameters],
        {
            "target": target,
            "gradient": gradient,
            "jacobian": target.jacobian(equations.slow),
            "curvature": gradient.jacobian(equations.slow),
        },
    )


@lru_cache(maxsize=32)
def _terminal(equations: Canonical) -> Kernel:
    arguments = [*equations.slow, equations.anomaly, *equations.parameters]
    return compiler.function("terminal", arguments, {"g": equations.terminal_cost, "r": equations.rate})
