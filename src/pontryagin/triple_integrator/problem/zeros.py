"""Where an expression in t is zero on intervals: exactly for polynomials, by enclosures for others."""

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np
import sympy as sp

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentValueError
from pontryagin.numerics import compile as compiler
from pontryagin.numerics.discs import Disc
from pontryagin.numerics.enclosure import enclosure

t = sp.Symbol("t", real=True)
"""The time."""

CELLS = 64
"""Into so many cells an interval is cut first."""

MOST = 100_000
"""Largest number of cells that are looked at together."""

NARROWEST = 1e-14
"""Cells narrower than this share of their interval are not cut further."""

SAMPLES = 4096
"""Number of samples of an expression that cannot be enclosed."""

HIGHEST = 40
"""Largest degree of a polynomial whose zeros are isolated exactly."""

BITS = 80
"""To so many bits, relative to the interval's ends, zeros of polynomials are isolated."""


def zeros(expression: sp.Expr, low: Array, high: Array, rests: dict[float, float] | None = None) -> Array:
    """The zeros of an expression on disjoint intervals, to the rounding of their values, ascending, (j,).

    No sign change is missed: zeros of polynomials are isolated exactly; other expressions are enclosed with
    their derivatives, on cells that are halved until each holds no zero, or the expression is monotone on it.
    What is left of a zero without a sign change is a few narrow cells, whose middles are returned.
    Expressions that cannot be enclosed are sampled at 4096 times of each interval.

    Parameters
    ----------
    expression : sympy.Expr in `t` alone
    low, high : (n,) arrays
        Ends of the intervals; they belong to them.
    rests : dict, optional
        Here it is noted by how much zeros of polynomials exceed the floats that stand for them.

    Raises
    ------
    ValueError
        If there are so many zeros that they cannot be told apart.
    """
    if t not in expression.free_symbols or expression.is_zero is False:
        return np.empty(0)
    value = numeric(expression)
    roots = _of_polynomial(expression, float(np.abs([low, high]).max()))
    if roots is None:
        found = _by_enclosures(expression, value, low, high)
    else:
        found = _polished(value, np.array(list(map(float, roots))))
        exceeding = (float(root - sp.Rational(x)) for root, x in zip(roots, found.tolist(), strict=True))
        (rests if rests is not None else {}).update(zip(found.tolist(), exceeding, strict=True))
    inside = (
        (found[:, None] >= low) & (found[:, None] <= high) if len(low) < CELLS else _in_any(found, low, high)
    )
    return np.unique(found[inside.any(axis=1)] if inside.ndim > 1 else found[inside])


def _in_any(x: Array, low: Array, high: Array) -> Any:
    order = np.argsort(low)
    at = np.clip(np.searchsorted(low[order], x, side="right") - 1, 0, None)
    return (x >= low[order][at]) & (x <= high[order][at])


@lru_cache(maxsize=256)
def numeric(expression: sp.Expr, *parameters: sp.Symbol) -> Callable[..., Array]:
    """An expression as a function of times and parameters, (k,) each, to (k,).

    Its parts b t + c are computed as b (t + c/b), which keeps their digits near their zeros.
    """
    parts: dict[Any, Any] = {}
    reduced = expression.replace(_is_linear, lambda part: parts.setdefault(part, sp.Dummy(real=True)))
    linear = [(float(slope), *_parts(-constant / slope)) for slope, _, constant in map(_linear, parts)]
    compiled = compiler.function("disturbance", [t, *parameters, *parts.values()], {"f": reduced})

    def value(*arguments: Array) -> Array:
        given = [*arguments, *(slope * ((arguments[0] - zero) - rest) for slope, zero, rest in linear)]
        try:
            with np.errstate(all="ignore"):
                return compiled(*given)[0]
        except TypeError:  # Some functions take numbers only.
            return np.array([compiled(*numbers)[0] for numbers in zip(*given, strict=True)], dtype=float)

    return value


def _parts(number: Any) -> tuple[float, float]:
    """The float nearest to a rational number, and what is left."""
    nearest = float(number)
    return nearest, float(number - sp.Rational(nearest))


def _linear(part: Any) -> tuple[Any, Any, Any]:
    """Slope, variable and constant of a sum of a constant and another term."""
    constant, rest = part.as_coeff_Add()
    return (*rest.as_coeff_Mul(), constant)


def _is_linear(part: Any) -> bool:
    if not part.is_Add:
        return False
    slope, base, constant = _linear(part)
    return bool(base == t and constant.is_Rational and slope.is_Rational)


def _of_polynomial(expression: sp.Expr, size: float) -> list[Any] | None:
    """The real zeros of a polynomial with rational coefficients, as such; None for other expressions."""
    poly = expression.as_poly(t)
    if (
        poly is None
        or poly.degree() > HIGHEST
        or not all(c.is_Rational or c.is_Float for c in poly.all_coeffs())
    ):
        return None
    exact = sp.Poly([sp.Rational(c) for c in poly.all_coeffs()], t, domain="QQ")
    if exact.degree() <= 0:
        return []
    if exact.degree() == 1:
        slope, constant = exact.all_coeffs()
        return [-constant / slope]
    eps = sp.Rational(size or 1.0) / 2**BITS
    return [(a + b) / 2 for (a, b), _ in exact.sqf_part().intervals(eps=eps)]


def _polished(value: Callable[..., Array], near: Array) -> Array:
    """Zeros moved by a few units in the last place to where the computed values change sign."""
    steps = np.arange(-4, 5)
    beside = near[:, None] + steps * np.spacing(np.abs(near))[:, None]
    signs = np.sign(value(beside.ravel())).reshape(beside.shape)
    changed = signs != signs[:, :1]
    first = np.where(changed.any(axis=1), changed.argmax(axis=1), 4)
    return np.asarray(np.take_along_axis(beside, first[:, None], axis=1)[:, 0])


def _by_enclosures(expression: sp.Expr, value: Callable[..., Array], low: Array, high: Array) -> Array:
    ranges = enclosure([t], [expression, sp.diff(expression, t)])
    share = np.arange(CELLS) / CELLS
    width = (high - low)[:, None]
    left = (low[:, None] + width * share).ravel()
    right = np.hstack([(low[:, None] + width * share[1:]), high[:, None]]).ravel()
    least = np.repeat(NARROWEST * (high - low), CELLS)
    middle = (left + right) / 2
    if not any(np.isfinite(disc.radius).any() for disc in ranges(middle)):
        return _by_samples(value, low, high)
    found: list[Array] = []
    while left.size:
        if left.size > MOST:
            raise ArgumentValueError(
                f"disturbance must change its form at fewer times, got {expression}, which is zero too often",
                "disturbance",
            )
        whole, slope = ranges(Disc.between(left, right))
        may = ~((whole.lower > 0) | (whole.upper < 0)) & (
            np.isfinite(value(left)) | np.isfinite(value(right)) | np.isfinite(value((left + right) / 2))
        )
        monotone = (slope.lower > 0) | (slope.upper < 0)
        found.append(_crossings(value, left[may & monotone], right[may & monotone]))
        middle = (left + right) / 2
        tiny = (right - left <= least) | (middle <= left) | (middle >= right)
        found.append(middle[may & ~monotone & tiny])
        rest = may & ~monotone & ~tiny
        left, middle, right, least = (np.repeat(x[rest], 2) for x in (left, middle, right, least))
        left[1::2], right[::2] = middle[1::2], middle[::2]
    return np.concatenate(found)


def _by_samples(value: Callable[..., Array], low: Array, high: Array) -> Array:
    grid = np.linspace(low, high, SAMPLES, axis=-1)
    return _crossings(value, grid[:, :-1].ravel(), grid[:, 1:].ravel())


def _crossings(value: Callable[..., Array], left: Array, right: Array) -> Array:
    """The first floats of the new sign in those of the cells at whose ends the signs differ."""
    before, after = np.sign(value(left)), np.sign(value(right))
    at_start = left[before == 0]
    crosses = (before * after < 0) | ((before != 0) & (after == 0))
    left, right, before = left[crosses], right[crosses], before[crosses]
    while True:
        middle = (left + right) / 2
        if ((middle <= left) | (middle >= right)).all():
            return np.concatenate([at_start, right])
        same = np.sign(value(middle)) == before
        left, right = np.where(same, middle, left), np.where(same, right, middle)
