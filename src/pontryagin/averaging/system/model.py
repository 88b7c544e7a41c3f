"""The averaged Hamiltonian h0 of a phase system, (2.3), as compiled kernels and their quadrature."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.system.jets import Jet, Kernel, evaluate, jet, width
from pontryagin.numerics.periodic_means import SOLVING, MeanRule, find_switches, mean
from pontryagin.numerics.quadrature import Density

if TYPE_CHECKING:
    from pontryagin.averaging.system.bounds import Bounds

BESIDE = 1e-9
"""Distance from a switch at which one-sided derivatives are taken; they enter Newton's matrix only."""

PERIODIC = 1e-9
"""Largest change of a periodic expression over a turn, relative to 1 + its size; rounding stays below it."""


@dataclass(frozen=True, eq=False)
class Model:
    """The compiled kernels of a `PhaseSystem`; each takes the system's numbers as its last arguments.

    Attributes
    ----------
    slow, target : int
        n and r, the numbers of slow variables and of target conditions.
    mean : kernel of (a, p), or None
        Columns of the jet of h0 in (a, p), where the average is known in closed form.
    density : kernel of (a, p, x), or None
        Columns of the jet of h* dpsi/dx at p_x = 0, and its derivative in x. Where the frequency is an
        integral, the same columns for h* / r, then the jet of 1 / r in a. None where `mean` is given.
    frequency : kernel of a, or None
        Columns of the jet of omega in a, None where omega is an integral.
    switching : kernel of (a, p, x), or None
        Functions at whose zeros the density is not smooth, and their derivatives in x.
    boundary : kernel of a
        Columns of the jets in a of M_1, ..., M_r and g.
    control : kernel of (a, p, x)
        u* at p_x = 0.
    rates : kernel of (a, x, u)
        f and the whole running cost.
    pace : kernel of (a, x)
        1 / r, proportional to dpsi/dx.
    origin : functools.partial
        Call that makes the same model again; pickles hold it instead of the kernels.
    bounds : Bounds, optional
        What is enclosed of the system; None for those that are known to have no narrow features.
    turn : tuple of float
        Ends of the cells of a turn on which the density was found to be bounded, where some are narrow.
    """

    slow: int
    target: int
    mean: Kernel | None
    density: Kernel | None
    frequency: Kernel | None
    switching: Kernel | None
    boundary: Kernel
    control: Kernel
    rates: Kernel
    pace: Kernel
    origin: "partial[Model]"
    bounds: "Bounds | None" = None
    turn: tuple[float, ...] = ()

    def __reduce__(self) -> tuple[Callable[..., "Model"], tuple[Any, ...]]:
        """Pickles and copies hold what the model is made from, since compiled kernels do not pickle."""
        return _made, (self.origin, self.turn)

    def with_turn(self, turn: tuple[float, ...]) -> "Model":
        """The same model, whose means heed other cells of a turn."""
        return self if turn == self.turn else replace(self, turn=turn)

    def averaged(self, z: Array, numbers: tuple[Array, ...], rule: MeanRule = SOLVING) -> tuple[Jet, Jet]:
        """Jets of h0 and of omega in z = (a, p) at points z (..., 2n)."""
        shape = np.broadcast_shapes(z.shape[:-1], *(number.shape for number in numbers))
        flat = np.broadcast_to(z, (*shape, z.shape[-1])).reshape(-1, z.shape[-1])
        values = tuple(np.broadcast_to(number, shape).reshape(-1) for number in numbers)
        a = flat[:, : self.slow].T
        if self.mean is None:
            h, turn = self._quadrature(flat, values, rule)
        else:
            h, turn = jet(evaluate(self.mean, *flat.T, *values), 2 * self.slow), None
        if turn is None:
            assert self.frequency is not None
            omega = jet(evaluate(self.frequency, *a, *values), self.slow).padded(2 * self.slow)
        else:
            omega = jet(_one(len(flat), 2 * self.slow), 2 * self.slow) / turn
            h = h / turn
        return _shaped(h, shape), _shaped(omega, shape)

    def _quadrature(self, z: Array, numbers: tuple[Array, ...], rule: MeanRule) -> tuple[Jet, Jet | None]:
        """Means of the density, and of 1 / r where the frequency is an integral."""
        assert self.density is not None
        n = self.slow
        density = _over(self.density, tuple(z.T), numbers)
        switches = self.switches(z, numbers)
        own, judged = width(2 * n), np.arange(1 + 2 * n)
        if self.frequency is None:
            judged = np.append(judged, own + 1 + np.arange(1 + n))
        columns = mean(density, switches, rule.on(self.turn), judged)
        h = jet(columns[:, :own], 2 * n)
        if not np.isnan(switches).all():
            h = Jet(h.value, h.gradient, h.hessian + self._jumps(density, switches))
        turn = None if self.frequency is not None else jet(columns[:, own + 1 :], n).padded(2 * n)
        return h, turn

    def controlled(self, z: Array, numbers: tuple[Array, ...], rule: MeanRule) -> tuple[Array, Array]:
        """Means over the phase, under u* at z (points, 2n): f (points, n) and the running cost (points)."""
        a = tuple(z[:, : self.slow].T)
        control = _over(self.control, tuple(z.T), numbers)

        def density(x: Array, index: NDArray[np.intp]) -> Array:
            u = np.moveaxis(control(x, index), -1, 0)
            here, values = [c[index, None] for c in a], [v[index, None] for v in numbers]
            pace = evaluate(self.pace, *here, x, *values)
            return np.concatenate([pace * evaluate(self.rates, *here, x, *u, *values), pace], axis=-1)

        means = mean(density, self.switches(z, numbers), rule.on(self.turn))
        means = means[:, :-1] / means[:, -1:]
        return means[:, :-1], means[:, -1]

    def change_in_a_turn(self, z: Array, numbers: tuple[Array, ...], x: Array) -> Array:
        """Change of f, the running cost and 1 / r from x (points, k) to a turn later, against 1 + their size.

        The control is u* at x, and the points are z (points, 2n); the largest change at each, (points).
        """
        columns, values = z.T[..., None], [number[:, None] for number in numbers]
        u = np.moveaxis(evaluate(self.control, *columns, x, *values), -1, 0)

        def at(anomaly: Array) -> Array:
            slow = columns[: self.slow]
            parts = (
                evaluate(self.rates, *slow, anomaly, *u, *values),
                evaluate(self.pace, *slow, anomaly, *values),
            )
            return np.concatenate(parts, axis=-1)

        here, later = at(x), at(x + 2 * np.pi)
        return np.asarray((np.abs(later - here) / (1 + np.abs(here))).max(axis=(1, 2)))

    def switches(self, z: Array, numbers: tuple[Array, ...]) -> Array:
        """Anomalies where h* is not smooth at the points z (points, 2n), (points, s), padded with nan."""
        if self.switching is None:
            return np.full((len(z), 0), np.nan)
        return find_switches(_over(self.switching, tuple(z.T), numbers), len(z))

    def _jumps(self, density: Density, switches: Array) -> Array:
        """The Hessian's part from moving switches: sum of J J' / (2 pi [dh*/dx]), J the gradient's jump."""
        count = 2 * self.slow
        point, which = np.nonzero(~np.isnan(switches))
        at = switches[point, which][:, None]
        jump = (density(at + BESIDE, point) - density(at - BESIDE, point))[:, 0]
        gradient, slope = jump[:, 1 : 1 + count], jump[:, width(count)]
        kinks = np.divide(1, slope, out=np.zeros_like(slope), where=slope != 0) / (2 * np.pi)
        result = np.zeros((len(switches), count, count))
        np.add.at(result, point, kinks[:, None, None] * gradient[:, :, None] * gradient[:, None, :])
        return result

    def ends(self, a: Array, numbers: tuple[Array, ...]) -> tuple[Jet, Jet]:
        """Jets in a of M, stacked along the axis before the derivatives' (..., r), and of g (...)."""
        columns = evaluate(self.boundary, *np.moveaxis(a, -1, 0), *numbers)
        each = columns.reshape(*columns.shape[:-1], self.target + 1, -1)
        return jet(each[..., :-1, :], self.slow), jet(each[..., -1, :], self.slow)


def _made(origin: "partial[Model]", turn: tuple[float, ...]) -> Model:
    return origin().with_turn(turn)


def _over(kernel: Kernel, point: tuple[Array, ...], numbers: tuple[Array, ...]) -> Density:
    """The kernel as a density in x, at points given by their coordinates and each point's numbers."""

    def density(x: Array, index: NDArray[np.intp]) -> Array:
        return evaluate(kernel, *(c[index, None] for c in point), x, *(v[index, None] for v in numbers))

    return density


def _one(points: int, variables: int) -> Array:
    return np.broadcast_to(np.eye(1, width(variables)), (points, width(variables)))


def _shaped(flat: Jet, shape: tuple[int, ...]) -> Jet:
    k = flat.gradient.shape[-1]
    return Jet(
        flat.value.reshape(shape), flat.gradient.reshape(*shape, k), flat.hessian.reshape(*shape, k, k)
    )
