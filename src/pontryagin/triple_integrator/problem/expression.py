"""A disturbance given as an expression in t: its values on stretches, and proofs that no feature is missed.

Between its kinks an expression is analytic. Enclosures bound its continuation on complex discs about a panel,
and such a bound tells how far a Chebyshev series through the values at the nodes can be from it.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import sqrt
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray
from sympy.core.function import AppliedUndef

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentTypeError, ArgumentValueError
from pontryagin.numerics.discs import Disc
from pontryagin.numerics.enclosure import enclosure, exact
from pontryagin.triple_integrator.problem.chebyshev_series import DEGREE
from pontryagin.triple_integrator.problem.panels import Function, Proof
from pontryagin.triple_integrator.problem.pieces import pieces
from pontryagin.triple_integrator.problem.samples import require_finite
from pontryagin.triple_integrator.problem.zeros import numeric, t

REWRITTEN = {
    sp.sec: sp.cos,
    sp.csc: sp.sin,
    sp.cot: sp.cos,
    sp.sech: sp.cosh,
    sp.csch: sp.sinh,
    sp.coth: sp.tanh,
}
"""Functions written by others, which can be enclosed."""

TINIEST, HUGEST = sp.Float("1e-290"), sp.Float("1e290")
"""Sizes of numbers that double precision holds."""

PIECES = 4096
"""Largest number of pieces for an interval."""

DISCS = (3.0, 5.0, 2.2)
"""Radii of the discs about a panel, in halves of its width."""

NEAR = 1e-4
"""Within this share of a stretch, panels beside a singularity at its end are judged by their values."""

SLIVER = 1e-7
"""Stretches that end at a singularity and are narrower than this share of the interval are so as well."""

NARROW = 1e-2
"""Ends of stretches up to this share of their interval are known better than the clock tells."""

RESOLVED = 2e-15
"""So are those that exceed the time of the clock by more than this share of the stretches."""

APART = 10.0
"""Intervals whose gap is more than so many times the length of those before it are treated apart."""


def in_time(expression: Any) -> Any:
    """An expression checked to be a real one in t alone, in the symbol `t` of this module.

    Raises
    ------
    TypeError, ValueError
        If it is something else.
    """
    if expression.atoms(AppliedUndef):  # The name of such a function would be run as code.
        raise _refusal(expression)
    if not isinstance(expression, sp.Expr) or expression.is_real is False:
        raise ArgumentTypeError(
            f"disturbance must be a real expression in t, got {expression}", "disturbance"
        )
    foreign = {str(symbol) for symbol in expression.free_symbols} - {"t"}
    if foreign:
        raise ArgumentValueError(
            f"disturbance must be an expression in t alone, got symbols {', '.join(sorted(foreign))}",
            "disturbance",
        )
    expression = expression.subs(dict.fromkeys(expression.free_symbols, t))
    try:
        expression = expression.doit()  # Integrals and derivatives that are left to be done.
    except NotImplementedError:
        raise _refusal(expression) from None
    expression = expression.replace(sp.SingularityFunction, _by_steps)
    for kind, simpler in REWRITTEN.items():
        expression = expression.replace(kind, lambda x, kind=kind, simpler=simpler: kind(x).rewrite(simpler))
    return _exactly(expression)


def _by_steps(*arguments: Any) -> Any:
    return sp.SingularityFunction(*arguments).rewrite("Heaviside")


def _exactly(expression: Any) -> Any:
    """An expression with rational numbers in place of floats, which SymPy takes out of exponents.

    exp(1e6*(t - 1.0)) is made 3e-434295*exp(1e6*t) by SymPy, which has no value in double precision.
    """
    joined = expression.replace(lambda e: e.is_Mul and e.args[0].is_Float and e.has(sp.exp), _into_exponent)
    floats = {x: sp.Rational(x) for x in joined.atoms(sp.Float) if x.is_finite and TINIEST < abs(x) < HUGEST}
    return joined.xreplace(floats)


def _into_exponent(product: Any) -> Any:
    """A product in which a number beyond double precision is taken into an exponential."""
    factor, *others = product.args
    powers = [part for part in others if isinstance(part, sp.exp)]
    if not powers or not factor or TINIEST < abs(factor) < HUGEST:
        return product
    logarithm = sp.Rational(sp.log(abs(factor)).evalf(40))
    exponent = _exactly(powers[0].args[0]) + logarithm
    rest = [_exactly(part) for part in others if part is not powers[0]]
    return sp.sign(factor) * sp.exp(exponent) * sp.Mul(*rest)


def _refusal(expression: Any) -> ArgumentValueError:
    return ArgumentValueError(
        f"disturbance must be an expression that NumPy evaluates, got {expression}", "disturbance"
    )


@dataclass(frozen=True)
class AnalyticForm:
    """An analytic expression in t and parameters, which pieces may share.

    Attributes
    ----------
    expression : sympy.Expr
    names : list of sympy.Symbol
        The parameters.
    columns : list of int
        Their places among the parameters of all forms.
    """

    expression: Any
    names: list[Any]
    columns: list[int]

    @cached_property
    def value(self) -> Callable[..., Array]:
        """The values at times (k,), with parameters (k,) each."""
        return numeric(self.expression, *self.names)

    @cached_property
    def enclosed(self) -> Callable[..., list[Disc]]:
        """Enclosures of the values on discs of times."""
        return enclosure([t, *self.names], [self.expression])

    @cached_property
    def known(self) -> bool:
        """Whether all functions in the expression can be enclosed: on a few numbers at least one is."""
        numbers = exact(np.array([0.1234, 0.91, 2.345, -0.3, -17.1, 123.4, 1e5, -1e5]))
        return bool(
            np.isfinite(self.enclosed(numbers, *(numbers.centre for _ in self.names))[0].radius).any()
        )


@dataclass(frozen=True)
class Analytic:
    """An expression on disjoint intervals, as pieces that are analytic.

    Attributes
    ----------
    starts, ends : (n,) array
        The times at which the pieces begin, ascending, and at which they end.
    rests : (n,) array
        By how much the true starts exceed these, as far as that is known.
    forms : tuple of AnalyticForm
    form : (n,) array of int
        Which form each piece has.
    values : (n, q) array
        The parameters of each piece; nan for those that its form does not hold.
    singular : (n, 2) array of bool
        Whether the form is singular at the start and at the end of each piece.
    """

    starts: Array
    ends: Array
    rests: Array
    forms: tuple[AnalyticForm, ...]
    form: NDArray[np.intp]
    values: Array
    singular: NDArray[np.bool_]

    @classmethod
    def of(cls, expression: Any, start: Array, end: Array) -> "Analytic":
        """An expression taken apart on the intervals of a stack."""
        expression = in_time(expression)
        try:
            parts, rests = pieces(expression, *_joined(start.ravel(), end.ravel()), PIECES * start.size)
            names = sorted({name for part in parts for name in part.values}, key=str)
            order = {form: i for i, form in enumerate(dict.fromkeys(part.expression for part in parts))}
            forms = tuple(_form(form, names) for form in order)
            for form in forms:
                form.value(start.ravel()[:1], *(np.zeros(1) for _ in form.names))
        except (NameError, KeyError, NotImplementedError):
            raise _refusal(expression) from None
        values = np.array([[part.values.get(name, np.nan) for name in names] for part in parts])
        starts, ends, singular = (
            np.array([getattr(part, name) for part in parts]) for name in ("low", "high", "singular")
        )
        which = np.array([order[part.expression] for part in parts])
        exceeding = np.array([rests.get(part.low, 0.0) for part in parts])
        return cls(starts, ends, exceeding, forms, which, values.reshape(len(parts), -1), singular)

    @property
    def edges(self) -> Array:
        """The times at which a piece ends and the next begins, ascending, (n - 1,)."""
        return self.starts[1:]

    def on_stretches(self, clock: Array) -> tuple[Function, Array, Proof, Array]:
        """The arguments of `Panels`: values on stretches, these, proofs, and what floats leave out."""
        low, high = clock[:, :-1].ravel(), clock[:, 1:].ravel()
        piece = np.searchsorted(self.starts, low / 2 + high / 2, side="right") - 1
        at_start = self.singular[piece, 0] & (low == self.starts[piece])
        at_end = self.singular[piece, 1] & (high == self.ends[piece])
        interval = np.repeat(clock[:, -1] - clock[:, 0], clock.shape[1] - 1)
        sliver = (at_start | at_end) & (high - low <= SLIVER * interval)

        def value(stretch: NDArray[np.intp], time: Array) -> Array:
            result = self._each(piece[stretch], lambda form, *given: form.value(*given), time)
            require_finite(time, result)
            return result

        def proof(stretch: NDArray[np.intp], left: Array, right: Array) -> Array:
            width, whole = right - left, high[stretch] - low[stretch]
            near = at_start[stretch] & (right <= NEAR * whole)
            near |= at_end[stretch] & (whole - left <= NEAR * whole)
            near |= sliver[stretch]
            bounds = np.full((2, left.size), np.inf)
            for radius in DISCS:
                rho = radius + sqrt(radius * radius - 1)
                middle, reach = low[stretch] + (left + right) / 2, radius * width / 2
                sizes = self._each(piece[stretch], _modulus, middle, reach)
                errors = sizes * (4 * rho**-DEGREE / (rho - 1))
                bounds = np.where(errors >= bounds[0], bounds, [errors, sizes])
            return np.where(near, np.nan, bounds)

        return value, clock, proof, self._rests(clock)

    def _rests(self, clock: Array) -> Array:
        """By how much the true ends of stretches exceed those of the clock, (m, k + 2).

        That is left out where it is lost in the rounding of times within both stretches that meet there.
        """
        if not self.edges.size:
            return np.zeros(clock.shape)
        at = np.minimum(np.searchsorted(self.edges, clock), self.edges.size - 1) + 1
        width = np.diff(clock, axis=1)
        share = np.where(width > 0, width, np.inf) / (clock[:, -1:] - clock[:, :1])
        least, most = np.full(clock.shape, np.inf), np.zeros(clock.shape)
        for side in (slice(None, -1), slice(1, None)):
            least[:, side] = np.minimum(least[:, side], share)
            most[:, side] = np.maximum(most[:, side], width)
        inside = (clock > clock[:, :1]) & (clock < clock[:, -1:])
        kept = inside & ((least <= NARROW) | (np.abs(self.rests[at]) > RESOLVED * most))
        return np.where(kept & (self.starts[at] == clock), self.rests[at], 0.0)

    def _each(self, piece: NDArray[np.intp], function: Callable[..., Array], *given: Array) -> Array:
        """A function of forms, arrays (k,) and parameters for pieces (k,)."""
        result = np.empty(piece.shape)
        for i, form in enumerate(self.forms):
            at = np.flatnonzero(self.form[piece] == i)
            if at.size:
                parameters = self.values[piece[at]][:, form.columns].T
                result[at] = function(form, *(x[at] for x in given), *parameters)
        return result


def _form(expression: Any, names: list[Any]) -> AnalyticForm:
    own = [name for name in names if name in expression.free_symbols]
    return AnalyticForm(expression, own, [names.index(name) for name in own])


def _modulus(form: AnalyticForm, middle: Array, reach: Array, *parameters: Array) -> Array:
    """Bounds of the modulus on discs of times; nan for a form that cannot be enclosed."""
    if not form.known:
        return np.full_like(middle, np.nan)
    return form.enclosed(Disc(middle.astype(complex), reach), *parameters)[0].size


def _joined(start: Array, end: Array) -> tuple[Array, Array]:
    """Intervals (n,), (n,) joined with those near them, as disjoint intervals in order."""
    order = np.argsort(start)
    low, high = start[order], np.maximum.accumulate(end[order])
    kept = [0]
    for i in range(1, len(low)):
        length = high[i - 1] - low[kept[-1]]
        if low[i] - high[i - 1] > APART * length:
            kept.append(i)
    return low[kept], high[[*(i - 1 for i in kept[1:]), len(low) - 1]]
