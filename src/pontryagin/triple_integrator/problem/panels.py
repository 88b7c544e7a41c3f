"""A function of time as Chebyshev series on panels, and its integrals, on many intervals side by side.

Every interval is judged by its own values, so that its panels and integrals do not depend on the others.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import pairwise
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

PANELS = 4096
"""Largest number of panels into which an interval is cut."""


@cache
def chebyshev_fit(degree: int) -> tuple[Array, Array]:
    """Chebyshev nodes in [-1, 1], and the matrix from values there to the coefficients of the series."""
    nodes = np.cos(np.pi * (np.arange(degree + 1) + 0.5) / (degree + 1))
    return nodes, np.asarray(np.linalg.inv(chebyshev.chebvander(nodes, degree)), dtype=float)


Function = Callable[[NDArray[np.intp], Array], Array]
"""A function of the numbers of stretches, and of times since the starts of these, to values, each (k,)."""


@dataclass(frozen=True)
class Panels:
    """A function of time on m intervals: Chebyshev series on panels that are halved until each is resolved.

    Attributes
    ----------
    function : callable (stretch, time since its start) -> values, each (k,)
        The function. Stretches are numbered through all intervals.
    clock : (m, k + 2) array
        The ends of the k + 1 stretches of each interval, ascending; a stretch may be empty. The function may
        be not smooth from one stretch to the next.
    """

    function: Function
    clock: Array

    @property
    def _origin(self) -> Array:
        """The starts of the stretches, (n,)."""
        return self.clock[:, :-1].ravel()

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
                off = np.abs(
                    self.function(stretch[made], t[made]) - chebyshev.chebval(x, coefficients[made].T)
                )
                right[made] &= off <= LOOSER * allowed[made]
        return right

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
        nodes, invert = chebyshev_fit(DEGREE)
        low: Any
        stretch, low, high, low_inside, high_inside = self._start()
        done: list[tuple[Array, ...]] = []
        count = np.bincount(self._member(stretch), minlength=len(self.clock))
        area = np.zeros(len(self.clock))
        while len(stretch):
            width, member = high - low, self._member(stretch)
            sample = (low[:, None] + width[:, None] * (nodes + 1) / 2).ravel()
            sample = self.function(np.repeat(stretch, nodes.size), sample).reshape(len(low), -1)
            largest = np.abs(sample).max(axis=1)
            with np.errstate(over="ignore"):
                np.maximum.at(area, member, (np.abs(sample) / sample.shape[1]).sum(axis=1) * width)
                # A product of matrices rounds the last digit by the number of panels, einsum does not.
                coefficients = np.einsum("pn,cn->pc", sample, invert)
                tail = np.abs(coefficients[:, -3:]).max(axis=1)
                slope = np.einsum("pc,c->p", np.abs(coefficients), np.arange(DEGREE + 1.0)) * 2 / width
                blurred = self._blur(stretch, (low, high), (slope, largest))
                allowed = np.maximum.reduce([1e-14 * largest, 1e-15 * area[member] / width, blurred])
            smooth = (largest < 1e300) & (tail <= allowed)
            at = np.flatnonzero(smooth)
            ends = (low[at], high[at], low_inside[at], high_inside[at])
            smooth[at] = self._meets_its_ends(stretch[at], ends, coefficients[at], allowed[at])
            done.append((stretch[smooth], low[smooth], width[smooth], coefficients[smooth]))
            rough, middle = ~smooth, (low + high) / 2
            np.add.at(count, member[rough], 1)
            before, time, after = (self._origin[stretch] + x for x in (low, middle, high))
            lost = rough & (
                (largest >= 1e300) | (before == time) | (time == after) | (count[member] > PANELS)
            )
            if lost.any():
                i = int(np.argmax(lost))
                raise NotConverged(
                    f"disturbance is not integrable to 1e-13 near t = {time[i]:.6g}",
                    float(tail[i] / largest[i]),
                )
            stretch, low, middle, high, low_inside, high_inside = (
                np.repeat(x[rough], 2) for x in (stretch, low, middle, high, low_inside, high_inside)
            )
            low[1::2], high[::2] = middle[1::2], middle[::2]
            low_inside[1::2], high_inside[::2] = True, True
        parts: list[Any] = [np.concatenate(column) for column in zip(*done, strict=True)]
        order = np.lexsort((parts[1], parts[0]))
        stretch, low, width, coefficients = (part[order] for part in parts)
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
