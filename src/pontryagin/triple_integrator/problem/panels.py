"""A function of time as Chebyshev series on panels, and its integrals, on many intervals side by side.

Every interval is judged by its own values, so that its panels and integrals do not depend on the others.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import pairwise
from math import ceil
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentTypeError, ArgumentValueError, NotConverged

DEGREE = 24
"""Degree of the Chebyshev series on each panel."""

COARSEST = 9
"""An interval is cut into at least so many panels, whose nodes lie less than 0.8 % of it apart. An odd number
keeps a node in the middle of the interval, where users like to put poles."""

LOOSER = 1e3
"""By how much more than its last coefficients a series may miss the function at the ends of a panel."""

EPSILON = float(np.finfo(float).eps)
"""Relative rounding of a time, by which values far from zero are blurred."""

BLURRED = 1e-9
"""Largest relative error that is put down to this rounding."""

PANELS = 4096
"""Largest number of panels into which an interval is cut."""


def _real(value: object) -> Array:
    array = np.asarray(value)
    if array.dtype.kind in "cUS":
        raise TypeError(f"got {value!r}")
    return array.astype(float)


@cache
def chebyshev_fit(degree: int) -> tuple[Array, Array]:
    """Chebyshev nodes in [-1, 1], and the matrix from values there to the coefficients of the series."""
    nodes = np.cos(np.pi * (np.arange(degree + 1) + 0.5) / (degree + 1))
    return nodes, np.asarray(np.linalg.inv(chebyshev.chebvander(nodes, degree)), dtype=float)


@dataclass(frozen=True)
class Panels:
    """A function of time on m intervals: Chebyshev series on panels that are halved until each is resolved.

    Attributes
    ----------
    function : callable f(t)
        The function. It may have an attribute ``edges``: the times at which it is not smooth.
    low, high : (m,) array
        Ends of the intervals.
    """

    function: Callable[[Any], Any]
    low: Array
    high: Array

    def values(self, t: Array) -> Array:
        """f at the times (k,), by one call with an array if f takes it, else by a call for each time."""
        try:
            result = _real(self.function(t))
        except (TypeError, ValueError):
            result = np.empty(())
        if result.shape == ():
            result = np.asarray([self._at(float(time)) for time in t])
        if result.shape != t.shape:
            raise ArgumentValueError(
                f"disturbance must return one number for each time: got shape {result.shape} "
                f"for times of shape {t.shape}",
                "disturbance",
            )
        if not np.isfinite(result).all():
            k = int(np.argmin(np.isfinite(result)))
            raise ArgumentValueError(
                f"disturbance must be finite: f({t[k]:.6g}) = {result[k]}", "disturbance"
            )
        return result

    def _at(self, time: float) -> float:
        try:
            value = _real(self.function(time))
        except TypeError as error:
            raise ArgumentTypeError(
                f"disturbance must be a function f(t) that takes a time and returns a number: {error}",
                "disturbance",
            ) from error
        if value.shape != ():
            raise ArgumentValueError(
                f"disturbance must return one number for each time: got shape {value.shape} for one time",
                "disturbance",
            )
        return float(value)

    @cached_property
    def _edges(self) -> Array:
        """The times at which the function says that it is not smooth, ascending."""
        return np.sort(np.asarray(getattr(self.function, "edges", ()), dtype=float).ravel())

    def _start(self) -> tuple[NDArray[np.intp], Array, Array]:
        """The initial panels: their intervals, (p,), and their ends, cut at the ``edges`` of the function.

        Their nodes lie so close that no feature of 1 % of the interval falls between them.
        """
        share = np.arange(COARSEST) / COARSEST
        if not self._edges.size:
            width = (self.high - self.low)[:, None]
            cuts = np.hstack([self.low[:, None] + width * share, self.high[:, None]])
            member = np.repeat(np.arange(len(cuts)), COARSEST)
            return member, cuts[:, :-1].ravel(), cuts[:, 1:].ravel()
        parts: list[tuple[int, float, float]] = []
        for i, (low, high) in enumerate(zip(self.low, self.high, strict=True)):
            inner = self._edges[(self._edges > low) & (self._edges < high)]
            for start, end in pairwise([low, *inner, high]):
                count = max(1, ceil(COARSEST * ((end - start) / (high - low))))
                steps = np.append(start + (end - start) * np.arange(count) / count, end).tolist()
                parts += [(i, left, right) for left, right in pairwise(steps)]
        of, lows, highs = map(np.array, zip(*parts, strict=True))
        return of, lows, highs

    def _meets_its_ends(
        self, member: NDArray[np.intp], low: Array, high: Array, coefficients: Array, allowed: Array
    ) -> NDArray[np.bool_]:
        """Whether panels' series take the function's values at the cuts that halving made, (p,).

        Otherwise a step lies so near to a cut that no node is beyond it.
        """
        right = np.ones(len(low), dtype=bool)
        for t, given, x in ((low, self.low, -1.0), (high, self.high, 1.0)):
            made = np.flatnonzero((t != given[member]) & ~np.isin(t, self._edges))
            if made.size:
                off = np.abs(self.values(t[made]) - chebyshev.chebval(x, coefficients[made].T))
                right[made] &= off <= LOOSER * allowed[made]
        return right

    @cached_property
    def series(self) -> tuple[NDArray[np.intp], Array, Array, Array, Array]:
        """The panels, those of an interval one after the other.

        Returns
        -------
        (m + 1,) array
            Where the panels of each interval begin.
        (p,), (p,) array
            Left ends and widths.
        (p, 2) array
            The integrals from the start of the interval to the left end.
        (p, degree + 1) array
            Coefficients of the series.
        """
        nodes, invert = chebyshev_fit(DEGREE)
        member, low, high = self._start()
        done: list[tuple[Array, ...]] = []
        area, count = np.zeros(len(self.low)), np.bincount(member, minlength=len(self.low))
        while len(member):
            width = high - low
            sample = self.values((low[:, None] + width[:, None] * (nodes + 1) / 2).ravel())
            sample = sample.reshape(len(low), -1)
            largest = np.abs(sample).max(axis=1)
            with np.errstate(over="ignore"):
                np.maximum.at(area, member, (np.abs(sample) / sample.shape[1]).sum(axis=1) * width)
                # A product of matrices rounds the last digit by the number of panels, einsum does not.
                coefficients = np.einsum("pn,cn->pc", sample, invert)
                tail = np.abs(coefficients[:, -3:]).max(axis=1)
                slope = np.einsum("pc,c->p", np.abs(coefficients), np.arange(DEGREE + 1.0)) * 2 / width
                blurred = EPSILON * np.maximum(np.abs(low), np.abs(high)) * slope
                blurred = np.minimum(blurred, BLURRED * largest)  # Next to a pole it would excuse anything.
                allowed = np.maximum.reduce([1e-14 * largest, 1e-15 * area[member] / width, blurred])
            smooth = (largest < 1e300) & (tail <= allowed)
            at = np.flatnonzero(smooth)
            smooth[at] = self._meets_its_ends(member[at], low[at], high[at], coefficients[at], allowed[at])
            done.append((member[smooth], low[smooth], width[smooth], coefficients[smooth]))
            rough, middle = ~smooth, (low + high) / 2
            np.add.at(count, member[rough], 1)
            lost = rough & (
                (largest >= 1e300) | ~((low < middle) & (middle < high)) | (count[member] > PANELS)
            )
            if lost.any():
                i = int(np.argmax(lost))
                raise NotConverged(
                    f"disturbance is not integrable to 1e-13 near t = {middle[i]:.6g}",
                    float(tail[i] / largest[i]),
                )
            member, low, middle, high = (np.repeat(x[rough], 2) for x in (member, low, middle, high))
            low[1::2], high[::2] = middle[1::2], middle[::2]
        parts: list[Any] = [np.concatenate(column) for column in zip(*done, strict=True)]
        order = np.lexsort((parts[1], parts[0]))
        owner, left, width, coefficients = (part[order] for part in parts)
        first = np.searchsorted(owner, np.arange(len(self.low) + 1))
        return first, left, width, _running(first, owner, width, coefficients), coefficients

    def integrals(self, t: Array, t0: Array, member: NDArray[np.intp]) -> Array:
        """g1 and g2 from t0 to t on the intervals with these numbers, all broadcast, (..., 2)."""
        from_start = self._from_start(t, member)
        if (t0 == self.low[member]).all():
            return from_start
        before = self._from_start(t0, member)
        between = from_start - before
        between[..., 0] -= before[..., 1] * (np.asarray(t) - t0)
        return between

    def _from_start(self, t: Array, member: NDArray[np.intp]) -> Array:
        first, left, width, running, coefficients = self.series
        times, owner = np.broadcast_arrays(np.asarray(t, dtype=float), member)
        flat, own = times.ravel(), owner.ravel()
        low, high = first[own], first[own + 1] - 1
        while (low < high).any():
            middle = (low + high + 1) // 2
            beyond = left[middle] <= flat
            low, high = np.where(beyond, middle, low), np.where(beyond, high, middle - 1)
        elapsed = flat - left[low]
        inside = _panel_integrals(coefficients[low], 2 * elapsed / width[low] - 1, width[low])
        inside += running[low]
        inside[:, 0] += running[low, 1] * elapsed
        return inside.reshape(*times.shape, 2)


def _running(first: NDArray[np.intp], owner: NDArray[np.intp], width: Array, coefficients: Array) -> Array:
    """g1 and g2 from the start of each interval to the left ends of its panels, (p, 2)."""
    over = _panel_integrals(coefficients, np.ones(len(width)), width)
    place = np.arange(len(width)) - first[owner]
    order = np.argsort(place, kind="stable")
    bounds = np.searchsorted(place[order], np.arange(1, place.max(initial=0) + 2))
    found = np.zeros_like(over)
    for begin, end in pairwise(bounds):
        here = order[begin:end]
        before = here - 1
        found[here] = found[before] + over[before]
        found[here, 0] += found[before, 1] * width[before]
    return found


def _panel_integrals(coefficients: Array, x: Array, width: Array) -> Array:
    """g1 and g2 from the left edge of panels (p, degree+1) to the positions x in [-1, 1], (p, 2)."""
    first = chebyshev.chebint(coefficients, 1, lbnd=-1, axis=1)
    second = chebyshev.chebint(coefficients, 2, lbnd=-1, axis=1)
    g2 = chebyshev.chebval(x, first.T, tensor=False) * width / 2
    g1 = chebyshev.chebval(x, second.T, tensor=False) * (width / 2) ** 2
    return np.stack([g1, g2], axis=-1)
