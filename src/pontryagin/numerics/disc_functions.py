"""Elementary functions of discs; see `pontryagin.numerics.discs`."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.numerics.discs import (
    GROWTH,
    ROUNDING,
    Centre,
    Disc,
    chosen,
    inverse,
    is_real,
    magnitude,
    rounded,
    where_defined,
    whole_power,
)


def _monotone(function: Callable[[Array], Array], disc: Disc, ulps: float = 8) -> Disc:
    """An increasing function on real discs, from its values at the ends."""
    low, high = function(disc.lower), function(disc.upper)
    spare = ulps * ROUNDING * (np.abs(low) + np.abs(high))
    return rounded(low / 2 + high / 2, high / 2 - low / 2 + spare, 4)


def _within(function: Callable[[Array], Array], disc: Disc, least: float, most: float) -> Disc:
    """`_monotone` where the discs keep within these ends; not defined elsewhere."""
    low, high = disc.centre - disc.radius, disc.centre + disc.radius
    inside = np.asarray((low >= least) & (high <= most))

    def on_range(x: Array) -> Array:
        return function(np.clip(np.where(np.isnan(x), least, x), least, most))

    return where_defined(inside, _monotone(on_range, disc))


def _shares(disc: Disc) -> tuple[Centre, Array, NDArray[np.bool_]]:
    """Centres, radii relative to them, and whether the discs keep off the real numbers up to zero.

    Where they do not, the first two are those of an arbitrary disc that does.
    """
    size = np.abs(disc.centre)
    away = np.where(disc.centre.real >= 0, size, np.abs(disc.centre.imag))
    with np.errstate(all="ignore"):
        share = disc.radius / size * (1 + 8 * ROUNDING)
    defined = np.asarray((away * (1 - 8 * ROUNDING) > disc.radius) & (share < 1))
    return np.where(defined, disc.centre, 1.0), np.where(defined, share, 0.5), defined


def real_power(disc: Disc, exponent: float) -> Disc:
    """z to a power that is not whole, on the principal branch."""
    base, share, defined = _shares(disc)
    if exponent >= 1:
        change = exponent * share * (1 + share) ** (exponent - 1)
    else:
        change = np.abs(np.expm1(exponent * np.log1p(-share)))
    centre = base**exponent
    ulps = 16 + 8 * abs(exponent)
    slack = 1 + ulps * ROUNDING * (1 - np.log1p(-share))
    return where_defined(defined, rounded(centre, np.abs(centre) * change * slack, ulps))


def sqrt(disc: Disc) -> Disc:
    """The principal square root; a real disc that ends at zero has one too."""
    return _within(np.sqrt, disc, 0.0, np.inf) if is_real(disc) else real_power(disc, 0.5)


def quotient_power(above: Disc, below: Disc, exponent: float) -> Disc:
    """(y / z) to a power that is not whole; closer than the power of the quotient where both are positive."""
    apart = real_power(above, exponent) / real_power(below, exponent)
    positive = (above.lower > 0) & (below.lower > 0)
    if positive.all():
        return apart
    quotient = above / below
    joint = sqrt(quotient) if exponent == 0.5 else real_power(quotient, exponent)
    return chosen(positive, apart, joint)


def log(disc: Disc) -> Disc:
    """The principal logarithm."""
    base, share, defined = _shares(disc)
    radius = -np.log1p(-share) * (1 + 8 * ROUNDING) + 8 * ROUNDING
    return where_defined(defined, rounded(np.log(base), radius, 8))


def exp(disc: Disc) -> Disc:
    """The exponential."""
    if is_real(disc):
        return _monotone(np.exp, disc)
    centre = np.exp(disc.centre)
    radius = np.exp(disc.centre.real + disc.radius)
    near = disc.radius < 0.5
    small = np.abs(centre) * np.expm1(np.where(near, disc.radius, 0.0))
    slack = 4 * ROUNDING * (1 + np.abs(disc.centre.real) + disc.radius)
    return rounded(centre, np.where(near, small, radius) * (1 + slack), 8)


def _series(disc: Disc, value: Centre, slope: Centre) -> Disc:
    """sin, cos, sinh or cosh: value cosh d + slope sinh d at most, for a change by d."""
    radius = np.abs(slope) * np.sinh(disc.radius) + np.abs(value) * 2 * np.sinh(disc.radius / 2) ** 2
    return rounded(value, radius * (1 + 16 * ROUNDING), 8)


def _waves(disc: Disc, value: Centre, slope: Centre) -> Disc:
    if not is_real(disc):
        return _series(disc, value, slope)
    reach = np.minimum(disc.radius, np.abs(slope) * disc.radius + disc.radius**2 / 2) + 8 * ROUNDING
    low, high = np.maximum(value - reach, -1.0), np.minimum(value + reach, 1.0)
    return rounded(low / 2 + high / 2, high / 2 - low / 2, 4)


def sin(disc: Disc) -> Disc:
    """The sine."""
    return _waves(disc, np.sin(disc.centre), np.cos(disc.centre))


def cos(disc: Disc) -> Disc:
    """The cosine."""
    return _waves(disc, np.cos(disc.centre), np.sin(disc.centre))


def tan(disc: Disc) -> Disc:
    """The tangent."""
    return sin(disc) / cos(disc)


def sinh(disc: Disc) -> Disc:
    """The hyperbolic sine."""
    if is_real(disc):
        return _monotone(np.sinh, disc)
    return _series(disc, np.sinh(disc.centre), np.cosh(disc.centre))


def cosh(disc: Disc) -> Disc:
    """The hyperbolic cosine."""
    if is_real(disc):
        modulus = magnitude(disc, False)
        return _monotone(lambda x: np.cosh(np.maximum(x, 0.0)), modulus)
    return _series(disc, np.cosh(disc.centre), np.sinh(disc.centre))


def tanh(disc: Disc) -> Disc:
    """The hyperbolic tangent."""
    if is_real(disc):
        return _monotone(np.tanh, disc)
    side = np.where(disc.centre.real < 0, -1.0, 1.0)
    falling = exp(Disc(-2 * side * disc.centre, 2 * disc.radius))
    share = falling / falling.shifted(1.0)
    value = share.scaled(-2.0).shifted(1.0)
    return Disc(value.centre * side, value.radius)


def _by_slope(
    function: Callable[[Centre], Centre], slope: Disc, defined: NDArray[np.bool_], disc: Disc
) -> Disc:
    """f from its value at the centre and a disc that holds its slopes."""
    centre = function(np.where(defined, disc.centre, 0.5))
    return where_defined(defined, rounded(centre, disc.radius * slope.size + 16 * ROUNDING, 16))


def _beside_imaginary(disc: Disc) -> NDArray[np.bool_]:
    """Whether the discs keep off the numbers iy with |y| >= 1."""
    return np.asarray(
        (np.abs(disc.centre.imag) + disc.radius < 1) | (np.abs(disc.centre.real) > disc.radius * GROWTH)
    )


def _beside_real(disc: Disc) -> NDArray[np.bool_]:
    """Whether the discs keep off the real numbers x with |x| >= 1."""
    return np.asarray(
        (np.abs(disc.centre.real) + disc.radius < 1) | (np.abs(disc.centre.imag) > disc.radius * GROWTH)
    )


def atan(disc: Disc) -> Disc:
    """The inverse tangent."""
    if is_real(disc):
        return _monotone(np.arctan, disc)
    slope = inverse(whole_power(disc, 2).shifted(1.0))
    return _by_slope(np.arctan, slope, _beside_imaginary(disc), disc)


def asinh(disc: Disc) -> Disc:
    """The inverse hyperbolic sine."""
    if is_real(disc):
        return _monotone(np.arcsinh, disc)
    slope = inverse(sqrt(whole_power(disc, 2).shifted(1.0)))
    return _by_slope(np.arcsinh, slope, _beside_imaginary(disc), disc)


def asin(disc: Disc) -> Disc:
    """The inverse sine."""
    if is_real(disc):
        return _within(np.arcsin, disc, -1.0, 1.0)
    slope = inverse(sqrt((-whole_power(disc, 2)).shifted(1.0)))
    return _by_slope(np.arcsin, slope, _beside_real(disc), disc)


def acos(disc: Disc) -> Disc:
    """The inverse cosine."""
    return (-asin(disc)) + Disc(np.asarray(np.pi / 2), np.asarray(ROUNDING))


def atanh(disc: Disc) -> Disc:
    """The inverse hyperbolic tangent."""
    if is_real(disc):
        return _within(np.arctanh, disc, -1.0, 1.0)
    slope = inverse((-whole_power(disc, 2)).shifted(1.0))
    return _by_slope(np.arctanh, slope, _beside_real(disc), disc)


def acosh(disc: Disc) -> Disc:
    """The inverse hyperbolic cosine."""
    if is_real(disc):
        return _within(np.arccosh, disc, 1.0, np.inf)
    slope = inverse(sqrt(disc.shifted(1.0)) * sqrt(disc.shifted(-1.0)))
    defined = _shares(disc.shifted(-1.0))[2]
    return _by_slope(np.arccosh, slope, defined, Disc(np.where(defined, disc.centre, 2.0), disc.radius))


def erf(disc: Disc) -> Disc:
    """The error function."""
    from scipy import special

    if is_real(disc):
        return _monotone(special.erf, disc)
    slope = exp(-whole_power(disc, 2)).scaled(1.1283791670955128)
    return _by_slope(special.erf, slope, np.ones(np.shape(disc.centre), bool), disc)


def atan2(y: Disc, x: Disc) -> Disc:
    """The angle of (x, y); not defined where the discs hold points of the half line y = 0, x <= 0."""
    quarter = Disc(np.asarray(np.pi / 2), np.asarray(ROUNDING))
    right, up, down = x.lower > 0, y.lower > 0, y.upper < 0
    turned = atan(x / y)
    upright = chosen(up, quarter - turned, -quarter - turned)
    return where_defined(right | up | down, chosen(right, atan(y / x), upright))
