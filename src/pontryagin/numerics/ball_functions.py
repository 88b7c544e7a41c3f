"""Elementary functions of balls; see `pontryagin.numerics.balls`."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.numerics.balls import (
    GROWTH,
    ROUNDING,
    Ball,
    Centre,
    chosen,
    inverse,
    is_real,
    magnitude,
    rounded,
    where_defined,
    whole_power,
)


def _monotone(function: Callable[[Array], Array], ball: Ball, ulps: float = 8) -> Ball:
    """An increasing function on real balls, from its values at the ends."""
    low, high = function(ball.lower), function(ball.upper)
    spare = ulps * ROUNDING * (np.abs(low) + np.abs(high))
    return rounded(low / 2 + high / 2, high / 2 - low / 2 + spare, 4)


def _within(function: Callable[[Array], Array], ball: Ball, least: float, most: float) -> Ball:
    """`_monotone` where the balls keep within these ends; not defined elsewhere."""
    low, high = ball.centre - ball.radius, ball.centre + ball.radius
    inside = np.asarray((low >= least) & (high <= most))

    def on_range(x: Array) -> Array:
        return function(np.clip(np.where(np.isnan(x), least, x), least, most))

    return where_defined(inside, _monotone(on_range, ball))


def _shares(ball: Ball) -> tuple[Centre, Array, NDArray[np.bool_]]:
    """Centres, radii relative to them, and whether the balls keep off the real numbers up to zero.

    Where they do not, the first two are those of an arbitrary ball that does.
    """
    size = np.abs(ball.centre)
    away = np.where(ball.centre.real >= 0, size, np.abs(ball.centre.imag))
    with np.errstate(all="ignore"):
        share = ball.radius / size * (1 + 8 * ROUNDING)
    defined = np.asarray((away * (1 - 8 * ROUNDING) > ball.radius) & (share < 1))
    return np.where(defined, ball.centre, 1.0), np.where(defined, share, 0.5), defined


def real_power(ball: Ball, exponent: float) -> Ball:
    """z to a power that is not whole, on the principal branch."""
    base, share, defined = _shares(ball)
    if exponent >= 1:
        change = exponent * share * (1 + share) ** (exponent - 1)
    else:
        change = np.abs(np.expm1(exponent * np.log1p(-share)))
    centre = base**exponent
    ulps = 16 + 8 * abs(exponent)
    slack = 1 + ulps * ROUNDING * (1 - np.log1p(-share))
    return where_defined(defined, rounded(centre, np.abs(centre) * change * slack, ulps))


def sqrt(ball: Ball) -> Ball:
    """The principal square root; a real ball that ends at zero has one too."""
    return _within(np.sqrt, ball, 0.0, np.inf) if is_real(ball) else real_power(ball, 0.5)


def log(ball: Ball) -> Ball:
    """The principal logarithm."""
    base, share, defined = _shares(ball)
    radius = -np.log1p(-share) * (1 + 8 * ROUNDING) + 8 * ROUNDING
    return where_defined(defined, rounded(np.log(base), radius, 8))


def exp(ball: Ball) -> Ball:
    """The exponential."""
    if is_real(ball):
        return _monotone(np.exp, ball)
    centre = np.exp(ball.centre)
    radius = np.exp(ball.centre.real + ball.radius)
    near = ball.radius < 0.5
    small = np.abs(centre) * np.expm1(np.where(near, ball.radius, 0.0))
    slack = 4 * ROUNDING * (1 + np.abs(ball.centre.real) + ball.radius)
    return rounded(centre, np.where(near, small, radius) * (1 + slack), 8)


def _series(ball: Ball, value: Centre, slope: Centre) -> Ball:
    """sin, cos, sinh or cosh: value cosh d + slope sinh d at most, for a change by d."""
    radius = np.abs(slope) * np.sinh(ball.radius) + np.abs(value) * 2 * np.sinh(ball.radius / 2) ** 2
    return rounded(value, radius * (1 + 16 * ROUNDING), 8)


def _waves(ball: Ball, value: Centre, slope: Centre) -> Ball:
    if not is_real(ball):
        return _series(ball, value, slope)
    reach = np.minimum(ball.radius, np.abs(slope) * ball.radius + ball.radius**2 / 2) + 8 * ROUNDING
    low, high = np.maximum(value - reach, -1.0), np.minimum(value + reach, 1.0)
    return rounded(low / 2 + high / 2, high / 2 - low / 2, 4)


def sin(ball: Ball) -> Ball:
    """The sine."""
    return _waves(ball, np.sin(ball.centre), np.cos(ball.centre))


def cos(ball: Ball) -> Ball:
    """The cosine."""
    return _waves(ball, np.cos(ball.centre), np.sin(ball.centre))


def tan(ball: Ball) -> Ball:
    """The tangent."""
    return sin(ball) / cos(ball)


def sinh(ball: Ball) -> Ball:
    """The hyperbolic sine."""
    if is_real(ball):
        return _monotone(np.sinh, ball)
    return _series(ball, np.sinh(ball.centre), np.cosh(ball.centre))


def cosh(ball: Ball) -> Ball:
    """The hyperbolic cosine."""
    if is_real(ball):
        modulus = magnitude(ball, False)
        return _monotone(lambda x: np.cosh(np.maximum(x, 0.0)), modulus)
    return _series(ball, np.cosh(ball.centre), np.sinh(ball.centre))


def tanh(ball: Ball) -> Ball:
    """The hyperbolic tangent."""
    if is_real(ball):
        return _monotone(np.tanh, ball)
    side = np.where(ball.centre.real < 0, -1.0, 1.0)
    falling = exp(Ball(-2 * side * ball.centre, 2 * ball.radius))
    share = falling / falling.shifted(1.0)
    value = share.scaled(-2.0).shifted(1.0)
    return Ball(value.centre * side, value.radius)


def _by_slope(
    function: Callable[[Centre], Centre], slope: Ball, defined: NDArray[np.bool_], ball: Ball
) -> Ball:
    """f from its value at the centre and a ball that holds its slopes."""
    centre = function(np.where(defined, ball.centre, 0.5))
    return where_defined(defined, rounded(centre, ball.radius * slope.size + 16 * ROUNDING, 16))


def _beside_imaginary(ball: Ball) -> NDArray[np.bool_]:
    """Whether the balls keep off the numbers iy with |y| >= 1."""
    return np.asarray(
        (np.abs(ball.centre.imag) + ball.radius < 1) | (np.abs(ball.centre.real) > ball.radius * GROWTH)
    )


def _beside_real(ball: Ball) -> NDArray[np.bool_]:
    """Whether the balls keep off the real numbers x with |x| >= 1."""
    return np.asarray(
        (np.abs(ball.centre.real) + ball.radius < 1) | (np.abs(ball.centre.imag) > ball.radius * GROWTH)
    )


def atan(ball: Ball) -> Ball:
    """The inverse tangent."""
    if is_real(ball):
        return _monotone(np.arctan, ball)
    slope = inverse(whole_power(ball, 2).shifted(1.0))
    return _by_slope(np.arctan, slope, _beside_imaginary(ball), ball)


def asinh(ball: Ball) -> Ball:
    """The inverse hyperbolic sine."""
    if is_real(ball):
        return _monotone(np.arcsinh, ball)
    slope = inverse(sqrt(whole_power(ball, 2).shifted(1.0)))
    return _by_slope(np.arcsinh, slope, _beside_imaginary(ball), ball)


def asin(ball: Ball) -> Ball:
    """The inverse sine."""
    if is_real(ball):
        return _within(np.arcsin, ball, -1.0, 1.0)
    slope = inverse(sqrt((-whole_power(ball, 2)).shifted(1.0)))
    return _by_slope(np.arcsin, slope, _beside_real(ball), ball)


def acos(ball: Ball) -> Ball:
    """The inverse cosine."""
    return (-asin(ball)) + Ball(np.asarray(np.pi / 2), np.asarray(ROUNDING))


def atanh(ball: Ball) -> Ball:
    """The inverse hyperbolic tangent."""
    if is_real(ball):
        return _within(np.arctanh, ball, -1.0, 1.0)
    slope = inverse((-whole_power(ball, 2)).shifted(1.0))
    return _by_slope(np.arctanh, slope, _beside_real(ball), ball)


def acosh(ball: Ball) -> Ball:
    """The inverse hyperbolic cosine."""
    if is_real(ball):
        return _within(np.arccosh, ball, 1.0, np.inf)
    slope = inverse(sqrt(ball.shifted(1.0)) * sqrt(ball.shifted(-1.0)))
    defined = _shares(ball.shifted(-1.0))[2]
    return _by_slope(np.arccosh, slope, defined, Ball(np.where(defined, ball.centre, 2.0), ball.radius))


def erf(ball: Ball) -> Ball:
    """The error function."""
    from scipy import special

    if is_real(ball):
        return _monotone(special.erf, ball)
    slope = exp(-whole_power(ball, 2)).scaled(1.1283791670955128)
    return _by_slope(special.erf, slope, np.ones(np.shape(ball.centre), bool), ball)


def atan2(y: Ball, x: Ball) -> Ball:
    """The angle of (x, y); not defined where the balls hold points of the half line y = 0, x <= 0."""
    quarter = Ball(np.asarray(np.pi / 2), np.asarray(ROUNDING))
    right, up, down = x.lower > 0, y.lower > 0, y.upper < 0
    turned = atan(x / y)
    upright = chosen(up, quarter - turned, -quarter - turned)
    return where_defined(right | up | down, chosen(right, atan(y / x), upright))
