"""Ball arithmetic on arrays: numbers known to lie within a radius of a centre, real or complex.

Every result holds all values that its operation takes on the operands' balls, rounding included. The radii
come from majorants of Taylor series, which are the same for real and complex centres. Where an operation is
not defined on the whole ball, or not analytic on a complex one, the radius is nan, and so are those of all
results computed from it. `Ball.settled` turns nan into infinite radii.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array

Centre = NDArray[np.float64] | NDArray[np.complex128]

Condition = tuple[NDArray[np.bool_], NDArray[np.bool_]]
"""Whether a condition holds on the whole ball, and whether it fails on the whole ball."""

ROUNDING = 2.0**-52
"""Relative error of one operation, at most; the elementary functions are given more of it."""
GROWTH = 1 + 2.0**-48
"""Factor that covers the rounding in the computation of a radius."""
TINY = 1e-300
"""Part of a radius that covers results which underflow."""


@dataclass(frozen=True, eq=False, slots=True)
class Ball:
    """All numbers within `radius` (...) of `centre` (...), in the real line or in the complex plane.

    Examples
    --------
    >>> ball = Ball.between(1.0, 3.0)
    >>> float((ball * ball).lower) <= 1 and 9 <= float((ball * ball).upper) < 10
    True
    """

    centre: Centre
    radius: Array

    @classmethod
    def between(cls, lower: ArrayLike, upper: ArrayLike) -> "Ball":
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
    def settled(self) -> "Ball":
        """The same ball, with centre 0 and infinite radius where it is not finite."""
        finite = np.isfinite(self.centre) & np.isfinite(self.radius)
        if finite.all():
            return self
        return Ball(np.where(finite, self.centre, 0.0), np.where(finite, self.radius, np.inf))

    def __add__(self, other: "Ball") -> "Ball":
        return rounded(self.centre + other.centre, self.radius + other.radius, 1)

    def __sub__(self, other: "Ball") -> "Ball":
        return rounded(self.centre - other.centre, self.radius + other.radius, 1)

    def __neg__(self) -> "Ball":
        return Ball(-self.centre, self.radius)

    def __mul__(self, other: "Ball") -> "Ball":
        radius = np.abs(self.centre) * other.radius + self.radius * other.size
        return rounded(self.centre * other.centre, radius, 4)

    def __truediv__(self, other: "Ball") -> "Ball":
        return self * inverse(other)

    def scaled(self, factor: float) -> "Ball":
        """The product with an exact number."""
        return rounded(self.centre * factor, self.radius * abs(factor), 1)

    def shifted(self, term: float) -> "Ball":
        """The sum with an exact number."""
        return rounded(self.centre + term, self.radius, 1)


def rounded(centre: Centre, radius: Array, ulps: float) -> Ball:
    """A ball whose centre was computed with an error of so many units of its last place."""
    return Ball(centre, np.asarray(radius * GROWTH + (np.abs(centre) * (ulps * ROUNDING) + TINY)))


def hull(first: Ball, second: Ball) -> Ball:
    """A ball that holds both."""
    if not (np.iscomplexobj(first.centre) or np.iscomplexobj(second.centre)):
        low = np.minimum(first.centre - first.radius, second.centre - second.radius)
        high = np.maximum(first.centre + first.radius, second.centre + second.radius)
        return rounded(low / 2 + high / 2, high / 2 - low / 2 + ROUNDING * (np.abs(low) + np.abs(high)), 2)
    apart = np.abs(first.centre - second.centre)
    middle = first.centre / 2 + second.centre / 2
    return rounded(middle, apart / 2 + np.maximum(first.radius, second.radius), 4)


def chosen(which: NDArray[np.bool_], first: Ball, second: Ball) -> Ball:
    """The first ball where `which` holds, else the second."""
    return Ball(np.where(which, first.centre, second.centre), np.where(which, first.radius, second.radius))


def whole(like: Ball) -> Ball:
    """Balls of which nothing is known, of the shape and kind of `like`."""
    shape = np.broadcast_shapes(np.shape(like.centre), np.shape(like.radius))
    return Ball(np.zeros(shape, np.result_type(like.centre)), np.full(shape, np.nan))


def where_defined(defined: NDArray[np.bool_] | bool, ball: Ball) -> Ball:
    """The ball, with the radius nan where it is not defined."""
    return Ball(ball.centre, np.where(defined, ball.radius, np.nan))


def is_real(ball: Ball) -> bool:
    """Whether the centre is real, so that only real numbers are meant."""
    return not np.iscomplexobj(ball.centre)


def inverse(ball: Ball) -> Ball:
    """1 / z, not defined where the ball holds zero."""
    size = np.abs(ball.centre)
    least = size * (1 - 4 * ROUNDING) - ball.radius
    return where_defined(least > 0, rounded(1 / ball.centre, ball.radius / (size * least), 4))


def whole_power(ball: Ball, exponent: int) -> Ball:
    """z to a whole power, 0 excluded."""
    if exponent < 0:
        return inverse(whole_power(ball, -exponent))
    if exponent == 1:
        return ball
    ulps = 4 * exponent
    if is_real(ball) and exponent % 2 == 0:
        size = np.abs(ball.centre)
        low, high = np.maximum(size - ball.radius, 0) ** exponent, (size + ball.radius) ** exponent
        return rounded(low / 2 + high / 2, high / 2 - low / 2 + ulps * ROUNDING * high, 2)
    size = np.abs(ball.centre)
    largest = (size + ball.radius) ** exponent
    radius = np.minimum(
        largest - size**exponent, exponent * ball.radius * (size + ball.radius) ** (exponent - 1)
    )
    return rounded(ball.centre**exponent, radius + ulps * ROUNDING * largest, ulps)


def magnitude(ball: Ball, across: bool) -> Ball:
    """The modulus of a real number, continued to complex ones from where it is z or -z.

    Where a complex ball holds zero the result is not defined, or with `across` it holds z and -z.
    """
    if is_real(ball):
        size = np.abs(ball.centre)
        low, high = np.maximum(size - ball.radius, 0), size + ball.radius
        return rounded(low / 2 + high / 2, high / 2 - low / 2 + ROUNDING * high, 2)
    positive, negative = ball.lower > 0, ball.upper < 0
    side = chosen(positive, ball, -ball)
    both = Ball(np.zeros_like(ball.centre), ball.size if across else np.full_like(ball.radius, np.nan))
    return chosen(positive | negative, side, both)


def sign(ball: Ball, across: bool) -> Ball:
    """The sign of a real number; see `magnitude`."""
    positive, negative = ball.lower > 0, ball.upper < 0
    known = np.where(positive, 1.0, np.where(negative, -1.0, 0.0))
    unknown = 1.0 if across or is_real(ball) else np.nan
    radius = np.where(positive | negative, 0.0, unknown)
    return where_defined(~np.isnan(ball.radius), Ball(known, radius))


def larger(first: Ball, second: Ball, across: bool) -> Ball:
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


def joined(values: list[Ball], conditions: list[Condition], known: bool) -> Ball:
    """The ball that holds every piece which may be the valid one; none of them may be.

    Unless `known`, nothing is known where more than one piece may be valid.
    """
    found = whole(values[0])
    for value, (holds, fails) in reversed(list(zip(values, conditions, strict=True))):
        joint = hull(value, found)
        found = chosen(holds, value, chosen(fails, found, joint if known else whole(joint)))
    return found
