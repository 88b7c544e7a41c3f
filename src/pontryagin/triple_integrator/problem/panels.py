"""A function of time as Chebyshev series on panels, and its integrals, on many intervals side by side.

Every interval is judged by its own values, so that its panels and integrals do not depend on the others.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import pairwise
from math import inf
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged

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

STEEPEST = 100.0
"""Largest relative slope per length of a stretch at which more than that is put down to this rounding."""

LATE = 1e-13
"""A relative change of values by the rounding of times above this is made up for."""

TOO_LATE = 1e-3
"""Not so where times are rounded by more than this share of half a panel."""

FAINT = 1e-6
"""A panel that can hold at most this share of what another one can hold waits for that one."""

LEAST = 1e-295
"""Errors of a value smaller than this are those of tiny numbers, which enclosures round up."""

PANELS = 4096
"""Largest number of panels into which an interval is cut."""


@cache
def chebyshev_fit(degree: int) -> tuple[Array, Array]:
    """Chebyshev nodes in [-1, 1], and the matrix from values there to the coefficients of the series."""
    nodes = np.cos(np.pi * (np.arange(degree + 1) + 0.5) / (degree + 1))
    return nodes, np.asarray(np.linalg.inv(chebyshev.chebvander(nodes, degree)), dtype=float)


Function = Callable[[NDArray[np.intp], Array], Array]
"""A function of the numbers of stretches, and of times within these, to values, each (k,)."""


Proof = Callable[[NDArray[np.intp], Array, Array], Array]
"""A function of the numbers of stretches, and of both ends of panels, each (k,), to (2, k): bounds on the errors
of series through the values at the nodes, and on the moduli of the function; nan where the values decide."""


@dataclass(frozen=True)
class Panels:
    """A function of time on m intervals: Chebyshev series on panels that are halved until each is resolved.

    Attributes
    ----------
    function : callable (stretch, time) -> values, each (k,)
        The function. Stretches are numbered through all intervals. Where a stretch ends at an edge, it is
        never called at the edge itself or beyond it, to which the rounding of a time may lead.
    clock : (m, k + 2) array
        The ends of the k + 1 stretches of each interval, ascending; a stretch may be empty. The function may
        be not smooth from one stretch to the next.
    proof : callable, optional
        Bounds on what values at the nodes do not show. Without them the values decide.
    """

    function: Function
    clock: Array
    proof: Proof | None = None

    @property
    def _origin(self) -> Array:
        """The starts of the stretches, (n,)."""
        return self.clock[:, :-1].ravel()

    @cached_property
    def _bounds(self) -> tuple[Array, Array]:
        """The first and the last time of the clock within each stretch, (n,)."""
        first, last = self.clock[:, :-1].copy(), self.clock[:, 1:].copy()
        first[:, 1:], last[:, :-1] = np.nextafter(first[:, 1:], np.inf), np.nextafter(last[:, :-1], -np.inf)
        return first.ravel(), last.ravel()

    def _sampled(self, stretch: NDArray[np.intp], low: Array, after: Array) -> tuple[Array, Array]:
        """Values at times (k, n) after times (k,) since the starts of stretches, and their delay by rounding."""
        origin, first, last = (x[stretch][:, None] for x in (self._origin, *self._bounds))
        time = np.clip(origin + (low[:, None] + after), first, last)
        values = self.function(np.repeat(stretch, after.shape[1]), time.ravel())
        return values.reshape(after.shape), ((time - origin) - low[:, None]) - after

    def _member(self, stretch: NDArray[np.intp]) -> NDArray[np.intp]:
        """The intervals of stretches."""
        return np.asarray(stretch // (self.clock.shape[1] - 1))

    def _start(self) -> tuple[Any, ...]:
        """The initial panels: their stretches, (p,), and their ends as times since the start of these.

        Their nodes lie so close that no feature of 1 % of the interval falls between them. Last comes which
        of the ends lie inside a stretch.
        """
        width = np.diff(self.clock, axis=1)
        duration = self.clock[:, -1:] - self.clock[:, :1]
        count = np.ceil(COARSEST * (width / duration)).astype(np.intp)
        count = np.where(width > 0, np.maximum(count, 1), 0).ravel()
        stretch = np.repeat(np.arange(count.size), count)
        place = np.arange(stretch.size) - np.repeat(np.cumsum(count) - count, count)
        whole, parts = width.ravel()[stretch], count[stretch]
        last = place + 1 == parts
        high = np.where(last, whole, whole * ((place + 1) / parts))
        return stretch, whole * (place / parts), high, place > 0, ~last

    def _meets_its_ends(
        self, stretch: NDArray[np.intp], ends: tuple[Array, ...], coefficients: Array, allowed: Array
    ) -> NDArray[np.bool_]:
        """Whether panels' series take the function's values at those of their ends that lie inside, (p,).

        Otherwise a step lies so near to a cut that no node is beyond it.
        """
        low, high, low_inside, high_inside = ends
        right = np.ones(len(low), dtype=bool)
        for t, inside, x in ((low, low_inside, -1.0), (high, high_inside, 1.0)):
            made = np.flatnonzero(inside)
            if made.size:
                values = self._sampled(stretch[made], t[made], np.zeros((made.size, 1)))[0][:, 0]
                off = np.abs(values - chebyshev.chebval(x, coefficients[made].T))
                right[made] &= off <= LOOSER * allowed[made]
        return right

    def _proved(
        self, smooth: NDArray[np.bool_], stretch: NDArray[np.intp], low: Array, high: Array, allowed: Array
    ) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Which of the panels are proved to be resolved, and which of the others wait, (p,) each.

        Those wait that can hold but little in comparison with another one of their interval. When that one is
        known better, they may be found to be negligible. Where nothing is proved, those are resolved that
        look smooth.
        """
        if self.proof is None:
            return smooth, np.zeros_like(smooth)
        error, size = self.proof(stretch, low, high)
        told = ~np.isnan(error)
        proved = np.where(told, error <= np.maximum(allowed, LEAST), smooth)
        most = np.where(proved, 0.0, np.where(told, size * (high - low), np.inf))
        largest = np.zeros(len(self.clock))
        np.maximum.at(largest, self._member(stretch), most)
        return proved, ~proved & (most < FAINT * largest[self._member(stretch)])

    def _blur(
        self, stretch: NDArray[np.intp], ends: tuple[Array, Array], sizes: tuple[Array, Array]
    ) -> Array:
        """By how much the rounding of times may change values of the given slopes and sizes, (p,).

        A function may vary as fast as its stretch is narrow; one that varies still faster is near a pole,
        where rounding would excuse anything.
        """
        slope, largest = sizes
        origin = self._origin[stretch]
        rounding = EPSILON * np.maximum(*(np.abs(origin + end) for end in ends))
        share = rounding / np.diff(self.clock, axis=1).ravel()[stretch]
        return np.minimum(rounding * slope, np.maximum(BLURRED, STEEPEST * share) * largest)

    @cached_property
    def series(self) -> tuple[NDArray[np.intp], Array, Array, Array, Array]:
        """The panels, those of an interval one after the other.

        Returns
        -------
        (m + 1,) array
            Where the panels of each interval begin.
        (p,), (p,) array
            Left ends, as times since the start of the interval, and widths.
        (p, 2) array
            The integrals from the start of the interval to the left end.
        (p, degree + 1) array
            Coefficients of the series.
        """
        nodes, _ = chebyshev_fit(DEGREE)
        low: Any
        stretch, low, high, low_inside, high_inside = self._start()
        done: list[tuple[Array, ...]] = []
        count = np.bincount(self._member(stretch), minlength=len(self.clock))
        area = np.zeros(len(self.clock))
        while len(stretch):
            width, member = high - low, self._member(stretch)
            sample, late = self._sampled(stretch, low, width[:, None] * ((nodes + 1) / 2))
            largest = np.abs(sample).max(axis=1)
            with np.errstate(over="ignore"):
                np.maximum.at(area, member, (np.abs(sample) / sample.shape[1]).sum(axis=1) * width)
                coefficients = _fitted(sample, 2 * late / width[:, None])
                tail = np.abs(coefficients[:, -3:]).max(axis=1)
                slope = np.abs(coefficients) @ np.arange(DEGREE + 1) * 2 / width
                blurred = self._blur(stretch, (low, high), (slope, largest))
                allowed = np.maximum.reduce([1e-14 * largest, 1e-15 * area[member] / width, blurred])
            smooth = (largest < 1e300) & (tail <= allowed)
            at = np.flatnonzero(smooth)
            ends = (low[at], high[at], low_inside[at], high_inside[at])
            smooth[at] = self._meets_its_ends(stretch[at], ends, coefficients[at], allowed[at])
            smooth, waits = self._proved(smooth, stretch, low, high, allowed)
            done.append((stretch[smooth], low[smooth], width[smooth], coefficients[smooth]))
            rough, middle = ~(smooth | waits), (low + high) / 2
            np.add.at(count, member[rough], 1)
            before, time, after = (self._origin[stretch] + x for x in (low, middle, high))
            lost = rough & (
                (largest >= 1e300) | (before == time) | (time == after) | (count[member] > PANELS)
            )
            if lost.any():
                i = int(np.argmax(lost))
                raise NotConverged(
                    f"disturbance is not integrable to 1e-13 near t = {time[i]:.6g}",
                    float(tail[i] / largest[i]) if largest[i] else inf,
                )
            held = [x[waits] for x in (stretch, low, high, low_inside, high_inside)]
            stretch, low, middle, high, low_inside, high_inside = (
                np.repeat(x[rough], 2) for x in (stretch, low, middle, high, low_inside, high_inside)
            )
            low[1::2], high[::2] = middle[1::2], middle[::2]
            low_inside[1::2], high_inside[::2] = True, True
            parts = zip((stretch, low, high, low_inside, high_inside), held, strict=True)
            stretch, low, high, low_inside, high_inside = (np.concatenate(pair) for pair in parts)
        columns: list[Any] = [np.concatenate(column) for column in zip(*done, strict=True)]
        order = np.lexsort((columns[1], columns[0]))
        stretch, low, width, coefficients = (column[order] for column in columns)
        owner = self._member(stretch)
        left = low + (self.clock[:, :-1] - self.clock[:, :1]).ravel()[stretch]
        first = np.searchsorted(owner, np.arange(len(self.clock) + 1))
        return first, left, width, _running(first, owner, width, coefficients), coefficients

    def integrals(self, elapsed: Array, member: NDArray[np.intp]) -> Array:
        """g1 and g2 from the starts of the intervals with these numbers, both broadcast, (..., 2)."""
        first, left, width, running, coefficients = self.series
        times, owner = np.broadcast_arrays(np.asarray(elapsed, dtype=float), member)
        flat, own = times.ravel(), owner.ravel()
        low, high = first[own], first[own + 1] - 1
        while (low < high).any():
            middle = (low + high + 1) // 2
            beyond = left[middle] <= flat
            low, high = np.where(beyond, middle, low), np.where(beyond, high, middle - 1)
        past = flat - left[low]
        inside = _panel_integrals(coefficients[low], 2 * past / width[low] - 1, width[low])
        inside += running[low]
        inside[:, 0] += running[low, 1] * past
        return inside.reshape(*times.shape, 2)


@cache
def _derivatives(degree: int) -> tuple[Array, Array]:
    """The matrices from coefficients of series to their first and second derivatives at the nodes."""
    nodes, _ = chebyshev_fit(degree)
    unit = np.eye(degree + 1)
    first, second = (chebyshev.chebval(nodes, chebyshev.chebder(unit, order)) for order in (1, 2))
    return np.asarray(first), np.asarray(second)


def _fitted(sample: Array, late: Array) -> Array:
    """Coefficients of series from values (p, degree+1) at nodes that are late by so much, in [-1, 1].

    The series itself tells how much the values change between the nodes and the rounded times, so that
    narrow features keep the digits that the values have.
    """
    _, invert = chebyshev_fit(DEGREE)
    first, second = _derivatives(DEGREE)
    coefficients: Array = sample @ invert.T
    moved = late * (coefficients @ first)
    most = np.abs(late).max(axis=1, initial=0.0)
    at = np.flatnonzero((np.abs(moved).max(axis=1) > LATE * np.abs(sample).max(axis=1)) & (most < TOO_LATE))
    for _ in range(3 if at.size else 0):
        given = coefficients[at]
        moved = late[at] * (given @ first + late[at] / 2 * (given @ second))
        coefficients[at] = (sample[at] - moved) @ invert.T
    return coefficients


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
