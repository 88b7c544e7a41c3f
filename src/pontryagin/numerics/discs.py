"""Disc arithmetic on arrays: numbers known to lie within a radius of a centre, real or complex.

Every result holds all values that its operation takes on the operands' discs, rounding included. The radii
come from majorants of Taylor series, which are the same for real and complex centres. Where an operation is
not defined on the whole disc, or not analytic on a complex one, the radius is nan, and so are those of all
results computed from it. `Disc.settled` turns nan into infinite radii.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array

Centre = NDArray[np.float64] | NDArray[np.complex128]

Condition = tuple[NDArray[np.bool_], NDArray[np.bool_]]
"""Whether a condition holds on the whole disc, and whether it fails on the whole disc."""

ROUNDING = 2.0**-52
"""Relative error of one operation, at most; the elementary functions are given more of it."""
GROWTH = 1 + 2.0**-48
"""Factor that covers the rounding in the computation of a radius."""
TINY = 1e-300
"""Part of a radius that covers results which underflow."""


@dataclass(frozen=True, eq=False, slots=True)
class Disc:
    """All numbers within `radius` (...) of `centre` (...), in the real line or in the complex plane.

    Examples
    --------
    >>> disc = Disc.between(1.0, 3.0)
    >>> float((disc * disc).lower) <= 1 and 9 <= float((disc * disc).upper) < 10
    True
    """

    centre: Centre
    radius: Array

    @classmethod
    def between(cls, lower: ArrayLike, upper: ArrayLike) -> "Disc":
        """The real numbers from lower (...) to upper (...)."""
        low, high = np.asarray(lower, float), np.asarray(upper, float)
        return rounded(low / 2 + high / 2, high / 2 - low / 2, 2)

    @property
    def lower(self) -> Array:
        """A lower bound of the real parts."""
        bound: Array = np.nextafter(self.centre.real - self.radius, -np.inf)
        return bound

    @property
    def upper(self) -> Array:
        """An upper bound of the real parts."""
        bound: Array = np.nextafter(self.centre.real + self.radius, np.inf)
        return bound

    @property
    def size(self) -> Array:
        """A bound of the moduli."""
        return np.asarray((np.abs(self.centre) + self.radius) * GROWTH)

    @property
    def settled(self) -> "Disc":
        """The same disc, with centre 0 and infinite radius where it is not finite."""
        finite = np.isfinite(self.centre) & np.isfinite(self.radius)
        if finite.all():
            return self
        return Disc(np.where(finite, self.centre, 0.0), np.where(finite, self.radius, np.inf))

    def __add__(self, other: "Disc") -> "Disc":
        return rounded(self.centre + other.centre, self.radius + other.radius, 1)

    def __sub__(self, other: "Disc") -> "Disc":
        return rounded(self.centre - other.centre, self.radius + other.radius, 1)

    def __neg__(self) -> "Disc":
        return Disc(-self.centre, self.radius)

    def __mul__(self, other: "Disc") -> "Disc":
        radius = np.abs(self.centre) * other.radius + self.radius * other.size
        return rounded(self.centre * other.centre, radius, 4)

    def __truediv__(self, other: "Disc") -> "Disc":
        return self * inverse(other)

    def scaled(self, factor: float) -> "Disc":
        """The product with an exact number."""
        return rounded(self.centre * factor, self.radius * abs(factor), 1)

    def shifted(self, term: float) -> "Disc":
        """The sum with an exact number."""
        return rounded(self.centre + term, self.radius, 1)


def rounded(centre: Centre, radius: Array, ulps: float) -> Disc:
    """A disc whose centre was computed with an error of so many units of its last place."""
    return Disc(centre, np.asarray(radius * GROWTH + (np.abs(centre) * (ulps * ROUNDING) + TINY)))


def hull(first: Disc, second: Disc) -> Disc:
    """A disc that holds both."""
    if not (np.iscomplexobj(first.centre) or np.iscomplexobj(second.centre)):
        low = np.minimum(first.centre - first.radius, second.centre - second.radius)
        high = np.maximum(first.centre + first.radius, second.centre + second.radius)
        return rounded(low / 2 + high / 2, high / 2 - low / 2 + ROUNDING * (np.abs(low) + np.abs(high)), 2)
    apart = np.abs(first.centre - second.centre)
    middle = first.centre / 2 + second.centre / 2
    return rounded(middle, apart / 2 + np.maximum(first.radius, second.radius), 4)


def chosen(which: NDArray[np.bool_], first: Disc, second: Disc) -> Disc:
    """The first disc where `which` holds, else the second."""
    return Disc(np.where(which, first.centre, second.centre), np.where(which, first.radius, second.radius))


def whole(like: Disc) -> Disc:
    """Discs of which nothing is known, of the shape and kind of `like`."""
    shape = np.broadcast_shapes(np.shape(like.centre), np.shape(like.radius))
    return Disc(np.zeros(shape, np.result_type(like.centre)), np.full(shape, np.nan))


def where_defined(defined: NDArray[np.bool_] | bool, disc: Disc) -> Disc:
    """The disc, with the radius nan where it is not defined."""
    return Disc(disc.centre, np.where(defined, disc.radius, np.nan))


def is_real(disc: Disc) -> bool:
    """Whether the centre is real, so that only real numbers are meant."""
    return not np.iscomplexobj(disc.centre)


def inverse(disc: Disc) -> Disc:
    """1 / z, not defined where the disc holds zero."""
    size = np.abs(disc.centre)
    least = size * (1 - 4 * ROUNDING) - disc.radius
    return where_defined(least > 0, rounded(1 / disc.centre, disc.radius / (size * least), 4))


def whole_power(disc: Disc, exponent: int) -> Disc:
    """z to a whole power, 0 excluded."""
    if exponent < 0:
        return inverse(whole_power(disc, -exponent))
    if exponent == 1:
        return disc
    ulps = 4 * exponent
    if is_real(disc) and exponent % 2 == 0:
        size = np.abs(disc.centre)
        low, high = np.maximum(size - disc.radius, 0) ** exponent, (size + disc.radius) ** exponent
        return rounded(low / 2 + high / 2, high / 2 - low / 2 + ulps * ROUNDING * high, 2)
    size = np.abs(disc.centre)
    largest = (size + disc.radius) ** exponent
    radius = np.minimum(
        largest - size**exponent, exponent * disc.radius * (size + disc.radius) ** (exponent - 1)
    )
    return rounded(disc.centre**exponent, radius + ulps * ROUNDING * largest, ulps)


def magnitude(disc: Disc, across: bool) -> Disc:
    """The modulus of a real number, continued to complex ones from where it is z or -z.

    Where a complex disc holds zero the result is not defined, or with `across` it holds z and -z.
    """
    if is_real(disc):
        size = np.abs(disc.centre)
        low, high = np.maximum(size - disc.radius, 0), size + disc.radius
        return rounded(low / 2 + high / 2, high / 2 - low / 2 + ROUNDING * high, 2)
    positive, negative = disc.lower > 0, disc.upper < 0
    side = chosen(positive, disc, -disc)
    both = Disc(np.zeros_like(disc.centre), disc.size if across else np.full_like(disc.radius, np.nan))
    return chosen(positive | negative, side, both)


def sign(disc: Disc, across: bool) -> Disc:
    """The sign of a real number; see `magnitude`."""
    positive, negative = disc.lower > 0, disc.upper < 0
    known = np.where(positive, 1.0, np.where(negative, -1.0, 0.0))
    unknown = 1.0 if across or is_real(disc) else np.nan
    radius = np.where(positive | negative, 0.0, unknown)
    return where_defined(~np.isnan(disc.radius), Disc(known, radius))


def larger(first: Disc, second: Disc, across: bool) -> Disc:
    """The larger of two real numbers; see `magnitude`."""
    if is_real(first) and is_real(second):
        low = np.maximum(first.centre - first.radius, second.centre - second.radius)
        high = np.maximum(first.centre + first.radius, second.centre + second.radius)
        return rounded(low / 2 + high / 2, high / 2 - low / 2 + ROUNDING * (np.abs(low) + np.abs(high)), 2)
    apart = first - second
    known = chosen(apart.lower > 0, first, second)
    both = hull(first, second)
    return chosen((apart.lower > 0) | (apart.upper < 0), known, both if across else whole(both))


def combined(parts: list[Condition], all_of: bool) -> Condition:
    """The conjunction of conditions, or their disjunction."""
    holds, fails = parts[0]
    for more, less in parts[1:]:
        holds = holds & more if all_of else holds | more
        fails = fails | less if all_of else fails & less
    return holds, fails


def joined(values: list[Disc], conditions: list[Condition], known: bool) -> Disc:
    """The disc that holds every piece which may be the valid one; none of them may be.

    Unless `known`, nothing is known where more than one piece may be valid.
    """
    found = whole(values[0])
    for value, (holds, fails) in reversed(list(zip(values, conditions, strict=True))):
        joint = hull(value, found)
        found = chosen(holds, value, chosen(fails, found, joint if known else whole(joint)))
    return found
