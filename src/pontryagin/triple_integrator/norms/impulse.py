"""Least total impulse (L1), (1.20), in every regime of the moments; (4.10) is the solution in one regime.

The least total impulse is 1/rho0 of (4.1): the largest p.mu over the quadratics with |p| <= 1 on [0, 1], a
maximum of a few closed forms. The impulses act where the best p touches its bounds. Here
mu = (c3, c2/T, 2 c1/T^2) are the control's moments of 1, sigma and sigma^2 in sigma = s/T.
"""

from dataclasses import dataclass
from functools import cached_property
from math import fabs
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.certificate import Certificate
from pontryagin.numerics.jit import batched
from pontryagin.triple_integrator.kernels import chebyshev_amplitudes, pairing, reversed_moments, two_impulses
from pontryagin.triple_integrator.problem.maneuver import Maneuver
from pontryagin.triple_integrator.problem.programme import (
    Programme,
    normalise,
    numbers_of,
    over_stack,
    response,
)
from pontryagin.triple_integrator.problem.scales import impulse_unit
from pontryagin.value import Packed, value_class

REGIMES = ("zero", "moment", "chebyshev", "end", "start")
"""The regimes, named by where the impulses act. "zero": nowhere. "moment": anywhere, with one sign.
"chebyshev": at both ends and in the middle with alternating signs, (4.10). "end": at the end and inside.
"start": at the start and inside."""

ZERO, MOMENT, CHEBYSHEV, END, START = 0.0, 1.0, 2.0, 3.0, 4.0

ROUNDING = 4e-15
"""Impulses, and distances to the boundary of a regime, below this relative size are due to rounding."""


def touching_bound(m0: float, m1: float, m2: float) -> float:
    """The bound by 2 (1 - x sigma)^2 - 1 with the stationary x = mu1/mu2; 0 if this x is not in [1, 2]."""
    square, mixed = m2 * m2, m1 * m2
    if square == 0.0 or mixed < square * (1.0 - ROUNDING) or mixed > 2.0 * square:
        return 0.0
    return fabs(m0 - 2.0 * m1 * (m1 / m2))


def one_impulse(m0: float, m1: float) -> tuple[float, ...]:
    """Impulses at the end and inside, and the inner place, for moments on the boundary of the moment cone."""
    if m0 * m1 <= 0.0:
        return m0, 0.0, 0.5
    return 0.0, m0, min(1.0, m1 / m0)


def solve_impulse(c1: float, c2: float, c3: float, T: float) -> tuple[float, ...]:
    """Inner place sigma, impulses at start, inside and end, regime, uniqueness, scaled residual, bound."""
    if c1 == 0.0 and c2 == 0.0 and c3 == 0.0:
        return 0.5, 0.0, 0.0, 0.0, ZERO, 1.0, 0.0, 0.0
    m0, m1, m2 = c3, c2 / T, 2.0 * (c1 / T / T)
    scale = max(fabs(m0), fabs(m1), fabs(m2))
    unit = impulse_unit(scale, T)
    m0, m1, m2 = m0 / scale, m1 / scale, m2 / scale
    n0, n1, n2 = reversed_moments(m0, m1, m2)
    bound, regime = fabs(m0), MOMENT
    for candidate, name in (
        (fabs(pairing(2.0, m0, m1, m2)), CHEBYSHEV),
        (touching_bound(m0, m1, m2), END),
        (touching_bound(n0, n1, n2), START),
    ):
        if candidate > bound:
            bound, regime = candidate, name
    place, unique, at_end, middle, at_start = 0.5, 1.0, 0.0, 0.0, 0.0
    smallest = ROUNDING * bound
    if regime == CHEBYSHEV:
        at_end, middle, at_start = chebyshev_amplitudes(m0, m1, m2)
        if at_end * middle > 0.0 and fabs(at_end) > smallest:
            regime = START
        elif at_start * middle > 0.0 and fabs(at_start) > smallest:
            regime = END
    if regime == START:
        at_start, middle = two_impulses(n0, n1, n2)
        at_end, place = 0.0, max(0.0, 1.0 - n2 / n1)
    elif regime == END or (regime == MOMENT and m0 * m1 > 0.0 and m0 * m2 > 0.0 and m0 * m2 >= m1 * m1):
        at_end, middle = two_impulses(m0, m1, m2)
        at_start, place = 0.0, min(1.0, m2 / m1)
    elif regime == MOMENT:
        at_end, middle, place = one_impulse(m0, m1)
    if regime == MOMENT and fabs(m1 - m2) > smallest and m0 * m2 - m1 * m1 > smallest * fabs(m0):
        unique = 0.0
    at_end = at_end if fabs(at_end) > smallest else 0.0
    middle = middle if fabs(middle) > smallest else 0.0
    at_start = at_start if fabs(at_start) > smallest else 0.0
    residual = max(
        fabs(at_end + middle + at_start - m0),
        fabs(middle * place + at_start - m1),
        fabs(middle * place * place + at_start - m2),
    )
    return (
        place,
        at_start * unit,
        middle * unit,
        at_end * unit,
        regime,
        unique,
        residual / bound,
        bound * unit,
    )


solve_stack = batched(solve_impulse, outputs=8, groups=(4,), packed=True)


@value_class
@dataclass(frozen=True, eq=False)
class ImpulseSolution(Packed, Programme):
    """Control of least total impulse: at most three impulses.

    Attributes
    ----------
    maneuver : Maneuver
        The problem that is solved.
    inner : (...) array
        Place of the inner impulse, as a share of T to go.
    amplitudes : (..., 3) array
        Impulses at the start, inside and at the end; 0 where there is none.
    regime_index : (...) int array
        Index into ``REGIMES``.
    unique : (...) bool array
        Whether this is the only optimum. In the interior of the moment cone every u of one sign with the
        right moments is optimal; the solution holds the one with an impulse at the end and one before it.
    certificate : Certificate
        Residual of the moments, relative to the largest; the total impulse; and the largest p.mu found.
    """

    maneuver: Maneuver
    inner: Array
    amplitudes: Array
    regime_index: NDArray[np.int8]
    unique: NDArray[np.bool_]
    certificate: Certificate

    def _unpacked(self, numbers: Array) -> dict[str, Any]:
        return _answer(numbers[4:])

    @cached_property
    def regime(self) -> NDArray[np.str_] | str:
        """Where the impulses are, (...): "zero", "moment", "chebyshev", "end" or "start"."""
        names = np.array(REGIMES)[self.regime_index]
        return names if self.maneuver.shape else str(names)

    @cached_property
    def _order(self) -> NDArray[np.intp]:
        return np.argsort(self.amplitudes == 0, axis=-1, kind="stable")

    @cached_property
    def impulse_times(self) -> Array:
        """Times of the impulses in order, then nan for absent ones, (..., 3)."""
        m = self.maneuver
        end = m.tf[..., None]
        times = np.minimum(m.t0[..., None] + self.impulse_offsets, end)
        return np.where(self.impulse_offsets == m.duration[..., None], end, times)

    @cached_property
    def impulse_offsets(self) -> Array:
        """The `impulse_times` as times since the start, which a clock far from 0 cannot carry, (..., 3)."""
        T = self.maneuver.duration
        offsets = np.stack([np.zeros_like(T), T - self.inner * T, T], axis=-1)
        offsets = np.where(self.amplitudes == 0, np.nan, offsets)
        return np.take_along_axis(offsets, self._order, axis=-1)

    @cached_property
    def impulses(self) -> Array:
        """Amplitudes at `impulse_times`, 0 for absent ones, (..., 3); for "chebyshev" those of (4.9)."""
        return np.take_along_axis(self.amplitudes, self._order, axis=-1)

    @property
    def _knots(self) -> Array:
        """Times since the start of the impulses strictly within the manoeuvre, (..., 3)."""
        offsets = self.impulse_offsets
        return np.where((offsets > 0) & (offsets < self.maneuver.duration[..., None]), offsets, np.nan)

    @cached_property
    def multipliers(self) -> Array:
        """l0 of the minimal element h0 = l0'h(s) (4.2), with l0'c = 1 (4.3), (..., 3); zeros where c = 0."""
        T, regime = self.maneuver.duration, self.regime_index
        inside = np.where(regime == START, 1.0 - self.inner, self.inner)
        x = np.where(regime == CHEBYSHEV, 2.0, np.where(regime <= MOMENT, 0.0, 1.0 / inside))
        p0, p1, p2 = np.ones_like(x), -4 * x, 2 * x**2
        start = regime == START
        p0, p1, p2 = np.where(start, p0 + p1 + p2, p0), np.where(start, -p1 - 2 * p2, p1), p2
        return normalise(np.stack([2 * p2, p1, p0], axis=-1), self.maneuver.moments, T)

    def control(self, t: ArrayLike) -> Array:
        """u at the times t, (k,) -> (..., k): 0, and plus or minus infinity at the instant of an impulse."""
        hits = self.maneuver.times(t)[..., :, None] == self.impulse_times[..., None, :]
        signs = (hits * np.sign(self.impulses[..., None, :])).sum(axis=-1)
        return np.where(signs == 0, 0.0, np.inf * np.where(signs == 0, 1.0, signs))

    def state(self, t: ArrayLike) -> Array:
        """x at the times t, (k,) -> (..., k, 3).

        At the instant of an impulse x3 is the value after it, except at the start, where x(t0) = x0.
        """
        m = self.maneuver
        driven = response(self._since(t, self.impulse_offsets), self.impulses, order=0)
        return m.drift(t) + np.where((m.times(t) > m.t0[..., None])[..., None], driven, 0.0)


def _answer(result: Array) -> dict[str, Any]:
    """The fields of a solution from the results of `solve_impulse`, (..., 8)."""
    total = np.abs(result[..., 1]) + np.abs(result[..., 2]) + np.abs(result[..., 3])
    return {
        "inner": result[..., 0],
        "amplitudes": result[..., 1:4],
        "regime_index": result[..., 4].astype(np.int8),
        "unique": result[..., 5] != 0,
        "certificate": Certificate(result[..., 6], total, result[..., 7]),
    }


def minimum_impulse(maneuver: Maneuver) -> ImpulseSolution:
    """Control of least total impulse (integral of |u|) that performs the manoeuvre, problem 3, (1.20).

    Parameters
    ----------
    maneuver : Maneuver
        One manoeuvre or a stack of them.

    Returns
    -------
    ImpulseSolution
        It is exact to rounding in every regime; the printed solution (4.10) is that of "chebyshev".

    Examples
    --------
    >>> s = minimum_impulse(Maneuver([0, 0, 0], [1, 0, 0], tf=2.0))
    >>> float(s.norm), s.impulses.tolist(), s.impulse_times.tolist(), s.regime
    (4.0, [1.0, -2.0, 1.0], [0.0, 1.0, 2.0], 'chebyshev')
    """
    numbers = solve_stack.call(numbers_of(maneuver))
    if numbers is not None:
        solution = ImpulseSolution.from_numbers(numbers)
        solution.__dict__["maneuver"] = maneuver
        return solution
    return ImpulseSolution(maneuver, **_answer(over_stack(solve_stack, maneuver)))
