"""A function of time as Chebyshev series on panels, and its integrals, on many intervals side by side.

Every interval is judged by its own values, so that its panels and integrals do not depend on the others.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import inf

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.triple_integrator.problem.chebyshev_series import (
    DEGREE,
    chebyshev_fit,
    fitted,
    panel_integrals,
    running_integrals,
)
from pontryagin.triple_integrator.problem.panel_table import Table, chosen, halved, joined
from pontryagin.value import freeze

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

SHARE = 1e-15
"""Errors of a panel up to this share of the integral of |f| over its interval are negligible."""

OVERRATED = 10.0
"""If that integral was overrated by more than this factor at first, panels are judged again."""

TOO_LARGE = 1e300
"""Values from here on are refused."""

FAINT = 1e-6
"""A panel that can hold at most this share of what another one can hold waits for that one."""

LEAST = 1e-295
"""Errors of a value smaller than this are those of tiny numbers, which enclosures round up."""

PANELS = 4096
"""Largest number of panels into which an interval is cut; with a proof four times as many."""


Function = Callable[[NDArray[np.intp], Array], Array]
"""A function of the numbers of stretches, and of times within these, to values, each (k,)."""


Proof = Callable[[NDArray[np.intp], Array, Array], Array]
"""A function of the numbers of stretches, and of both ends of panels, each (k,), to (2, k): bounds on the
errors of series through the values at the nodes, and on the moduli; nan where the values decide."""


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
    rest : (m, k + 2) array, optional
        By how much the true ends of stretches exceed those on the clock, whose digits narrow ones go beyond.
    """

    function: Function
    clock: Array
    proof: Proof | None = None
    rest: Array | None = None

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
        """Values at times (k, n) after low ends (k,) in stretches, and their delay by rounding."""
        origin, first, last = (x[stretch][:, None] for x in (self._origin, *self._bounds))
        low = low[:, None] if self.rest is None else (low + self.rest[:, :-1].ravel()[stretch])[:, None]
        time = np.clip(origin + (low + after), first, last)
        values = self.function(np.repeat(stretch, after.shape[1]), time.ravel())
        return values.reshape(after.shape), ((time - origin) - low) - after

    @cached_property
    def _widths(self) -> Array:
        """The lengths of the stretches, (m, k + 1)."""
        width = np.diff(self.clock, axis=1)
        if self.rest is not None:
            exceeding = np.maximum(width + np.diff(self.rest, axis=1), width / 4)
            width = np.where(width > 0, exceeding, 0.0)
        freeze((width, self.rest))
        return width

    def _member(self, stretch: NDArray[np.intp]) -> NDArray[np.intp]:
        """The intervals of stretches."""
        return np.asarray(stretch // (self.clock.shape[1] - 1))

    def _start(self) -> Table:
        """The initial panels: their stretches, (p,), and their ends as times since the start of these.

        Their nodes lie so close that no feature of 1 % of the interval falls between them. It is noted which
        of the ends lie inside a stretch.
        """
        width = self._widths
        duration = self.clock[:, -1:] - self.clock[:, :1]
        count = np.ceil(COARSEST * (width / duration)).astype(np.intp)
        count = np.where(width > 0, np.maximum(count, 1), 0).ravel()
        stretch = np.repeat(np.arange(count.size), count)
        place = np.arange(stretch.size) - np.repeat(np.cumsum(count) - count, count)
        whole, parts = width.ravel()[stretch], count[stretch]
        last = place + 1 == parts
        high = np.where(last, whole, whole * ((place + 1) / parts))
        ends = {"low": whole * (place / parts), "high": high}
        return {"stretch": stretch, **ends, "low_inside": place > 0, "high_inside": ~last}

    def _meets_its_ends(
        self, panels: Table, smooth: NDArray[np.bool_], coefficients: Array, allowed: Array
    ) -> NDArray[np.bool_]:
        """Whether the series of smooth panels take the function's values at those ends that lie inside, (p,).

        Otherwise a step lies so near to a cut that no node is beyond it.
        """
        right = np.ones(len(smooth), dtype=bool)
        for end, x in (("low", -1.0), ("high", 1.0)):
            made = np.flatnonzero(smooth & panels[f"{end}_inside"])
            if made.size:
                at_end = np.zeros((made.size, 1))
                values = self._sampled(panels["stretch"][made], panels[end][made], at_end)[0][:, 0]
                off = np.abs(values - chebyshev.chebval(x, coefficients[made].T))
                right[made] &= off <= LOOSER * allowed[made]
        return right

    def _judged(self, panels: Table, area: Array) -> tuple[Table, NDArray[np.bool_], NDArray[np.bool_]]:
        """The panels with their series and errors, which are resolved, and which of the others wait.

        Those wait that can hold but little in comparison with another one of their interval. When that one is
        known better, they may be found to be negligible.
        """
        stretch, low, high = (panels[name] for name in ("stretch", "low", "high"))
        nodes, _ = chebyshev_fit(DEGREE)
        width, member = high - low, self._member(stretch)
        sample, late = self._sampled(stretch, low, width[:, None] * ((nodes + 1) / 2))
        largest = np.abs(sample).max(axis=1)
        with np.errstate(over="ignore"):
            mass = (np.abs(sample) / sample.shape[1]).sum(axis=1) * width
            np.maximum.at(area, member, mass)
            coefficients = fitted(sample, 2 * late / width[:, None])
            tail = np.abs(coefficients[:, -3:]).max(axis=1)
            slope = np.einsum("pc,c->p", np.abs(coefficients), np.arange(DEGREE + 1.0)) * 2 / width
            blurred = self._blur(stretch, (low, high), (slope, largest))
            small = SHARE * area[member] / width
        own = np.maximum(1e-14 * largest, blurred)
        resolved = (largest < TOO_LARGE) & (tail <= np.maximum(own, small))
        resolved &= self._meets_its_ends(panels, resolved, coefficients, np.maximum(own, small))
        error, waits = tail, np.zeros_like(resolved)
        if self.proof is not None:
            bound, size = self.proof(stretch, low, high)
            proved = ~np.isnan(bound)
            error, own = np.where(proved, bound, tail), np.where(proved, 1e-14 * largest, own)
            resolved = np.where(proved, bound <= np.maximum.reduce([own, small, 0 * own + LEAST]), resolved)
            most = np.where(resolved, 0.0, np.where(proved, size * width, np.inf))
            peak = np.zeros(len(self.clock))
            np.maximum.at(peak, member, most)
            waits = ~resolved & (most < FAINT * peak[member])
        found = {"coefficients": coefficients, "error": error, "own": own, "mass": mass, "largest": largest}
        return panels | found, resolved, waits

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
        share = rounding / self._widths.ravel()[stretch]
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
        open_, done = self._start(), []
        count = np.bincount(self._member(open_["stretch"]), minlength=len(self.clock))
        area: Array = np.zeros(len(self.clock))
        while True:
            while len(open_["stretch"]):
                judged, resolved, waits = self._judged(open_, area)
                done.append(chosen(judged, resolved))
                rough = ~(resolved | waits)
                np.add.at(count, self._member(open_["stretch"][rough]), 1)
                self._require_hope(chosen(judged, rough), count)
                open_ = joined([halved(chosen(open_, rough)), chosen(open_, waits)])
            table = joined(done)
            area = np.bincount(self._member(table["stretch"]), table["mass"], len(self.clock)).astype(float)
            width = table["high"] - table["low"]
            small = SHARE * area[self._member(table["stretch"])] / width
            poor = table["error"] > np.maximum.reduce([table["own"], OVERRATED * small, 0 * small + LEAST])
            if not poor.any():
                break
            done, open_ = [chosen(table, ~poor)], chosen(table, poor)
        return self._in_order(table)

    def _require_hope(self, rough: Table, count: NDArray[np.intp]) -> None:
        """Raise NotConverged if one of the panels to be halved is lost."""
        stretch, low, high, largest = (rough[name] for name in ("stretch", "low", "high", "largest"))
        before, time, after = (self._origin[stretch] + x for x in (low, (low + high) / 2, high))
        most = PANELS if self.proof is None else 4 * PANELS
        many = count[self._member(stretch)] > most
        lost = (largest >= TOO_LARGE) | (before == time) | (time == after) | many
        if lost.any():
            i = int(np.argmax(lost))
            raise NotConverged(
                f"disturbance is not integrable to 1e-13 near t = {time[i]:.6g}",
                float(rough["error"][i] / largest[i]) if largest[i] else inf,
            )

    def _in_order(self, table: Table) -> tuple[NDArray[np.intp], Array, Array, Array, Array]:
        """The panels by intervals and times, as in `series`."""
        order = np.lexsort((table["low"], table["stretch"]))
        names = ("stretch", "low", "high", "coefficients")
        stretch, low, high, coefficients = (table[name][order] for name in names)
        owner, width = self._member(stretch), np.asarray(high - low)
        begin = self.clock[:, :-1] - self.clock[:, :1]
        left = low + (begin if self.rest is None else begin + self.rest[:, :-1]).ravel()[stretch]
        first = np.searchsorted(owner, np.arange(len(self.clock) + 1))
        return first, left, width, running_integrals(first, owner, width, coefficients), coefficients

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
        inside = panel_integrals(coefficients[low], 2 * past / width[low] - 1, width[low])
        inside += running[low]
        inside[:, 0] += running[low, 1] * past
        return inside.reshape(*times.shape, 2)
