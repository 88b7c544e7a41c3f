"""Convex sets of controls, each given by sigma(s) = max over its controls u of (s'u - cost of u)."""

from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias

import numpy as np
import sympy as sp

from pontryagin.averaging.system.control_checks import Numbers, numeric, refusal, require_positive
from pontryagin.averaging.system.expressions import expression, matrix, vector
from pontryagin.errors import ArgumentTypeError
from pontryagin.validation import require_bare
from pontryagin.value import value_class

Number: TypeAlias = "float | sp.Expr"


class ControlSet(Protocol):
    """The methods of a set of controls that `PhaseSystem` uses."""

    def support(self, s: Sequence[sp.Expr]) -> sp.Expr:
        """sigma(s), convex in s."""

    def maximiser(self, s: Sequence[sp.Expr]) -> sp.Matrix:
        """The control (m, 1) that attains sigma(s): the gradient of sigma."""

    def cost(self, u: Sequence[sp.Expr]) -> sp.Expr:
        """The cost of the control per unit of slow time."""

    def require_convex(self, dimension: int, numbers: Numbers) -> None:
        """Raise ValueError unless the set has this dimension, is convex, and bounds or prices controls."""


@value_class
@dataclass(frozen=True, eq=False)
class Quadratic:
    """Unbounded controls that cost u'Ru.

    Parameters
    ----------
    weight : number, sympy.Expr or symmetric positive definite (m, m) matrix
        R; a number stands for that multiple of the identity.

    Examples
    --------
    >>> p = sp.Symbol("p", real=True)
    >>> Quadratic().support([p]), Quadratic().maximiser([p])[0]
    (p**2/4, p/2)
    """

    weight: object = 1

    def __post_init__(self) -> None:
        if isinstance(self.weight, list | tuple) or getattr(self.weight, "shape", None):
            object.__setattr__(self, "weight", matrix("Quadratic: weight", self.weight, "weight"))
        else:
            expression("Quadratic: weight", self.weight, "weight")

    def _matrix(self, dimension: int) -> sp.Matrix:
        if isinstance(self.weight, sp.ImmutableMatrix):
            return self.weight
        return sp.ImmutableMatrix(expression("weight", self.weight) * sp.eye(dimension))

    def support(self, s: Sequence[sp.Expr]) -> sp.Expr:
        """s' R^-1 s / 4."""
        row = sp.Matrix(vector("s", s))
        return _expanded((row.T * self._matrix(len(s)).inv() * row)[0]) / 4

    def maximiser(self, s: Sequence[sp.Expr]) -> sp.Matrix:
        """R^-1 s / 2."""
        return self._matrix(len(s)).inv() * sp.Matrix(vector("s", s)) / 2

    def cost(self, u: Sequence[sp.Expr]) -> sp.Expr:
        """u'Ru."""
        row = sp.Matrix(vector("u", u))
        return _expanded((row.T * self._matrix(len(u)) * row)[0])

    def require_convex(self, dimension: int, numbers: Numbers) -> None:
        """R must be symmetric positive definite."""
        matrix = self._matrix(dimension)
        if matrix.shape != (dimension, dimension):
            raise refusal(
                f"Quadratic: weight must be a number or a matrix of shape ({dimension}, {dimension}), "
                f"got shape {matrix.shape}"
            )
        entries = np.stack(numeric("Quadratic: weight", list(matrix), numbers), axis=-1)
        for values in entries.reshape(-1, dimension, dimension):
            if not np.allclose(values, values.T, rtol=1e-12, atol=0):
                raise refusal(f"Quadratic: weight must be symmetric, got {values.tolist()}")
            if not np.linalg.eigvalsh(values)[0] > 0:
                raise refusal(f"Quadratic: weight must be positive definite, got {values.tolist()}")


class Bounded:
    """A set of controls that are bounded and cost nothing."""

    def cost(self, u: Sequence[sp.Expr]) -> sp.Expr:
        """Zero, whatever the control."""
        return sp.Integer(0)


@value_class
@dataclass(frozen=True, eq=False)
class Ball(Bounded):
    """|u| <= radius.

    Examples
    --------
    >>> p, q = sp.symbols("p q", real=True)
    >>> Ball(2).support([p, q])
    2*sqrt(p**2 + q**2)
    """

    radius: Number = 1

    def __post_init__(self) -> None:
        expression("Ball: radius", self.radius, "radius")

    def support(self, s: Sequence[sp.Expr]) -> sp.Expr:
        """Radius times |s|."""
        return expression("radius", self.radius) * _norm(s)

    def maximiser(self, s: Sequence[sp.Expr]) -> sp.Matrix:
        """Radius times s / |s|."""
        return expression("radius", self.radius) * _unit(s)

    def require_convex(self, dimension: int, numbers: Numbers) -> None:
        """The radius must be positive."""
        require_positive("Ball: radius", [self.radius], numbers)


@value_class
@dataclass(frozen=True, eq=False)
class Ellipsoid(Bounded):
    """sum of (u_i / l_i)^2 <= 1.

    Parameters
    ----------
    semiaxes : sequence of m numbers or expressions
        l_i > 0.

    Examples
    --------
    >>> p, q = sp.symbols("p q", real=True)
    >>> Ellipsoid([1, 2]).support([p, q])
    sqrt(p**2 + 4*q**2)
    """

    semiaxes: Sequence[Number]

    def __post_init__(self) -> None:
        object.__setattr__(self, "semiaxes", _entries("Ellipsoid: semiaxes", self.semiaxes))

    def support(self, s: Sequence[sp.Expr]) -> sp.Expr:
        """sqrt(sum of l_i^2 s_i^2)."""
        return _norm(self._scaled(s))

    def maximiser(self, s: Sequence[sp.Expr]) -> sp.Matrix:
        """l_i^2 s_i / support."""
        unit = _unit(self._scaled(s))
        return sp.Matrix([l * part for l, part in zip(self._lengths(), unit, strict=True)])

    def _lengths(self) -> list[sp.Expr]:
        return vector("semiaxes", self.semiaxes)

    def _scaled(self, s: Sequence[sp.Expr]) -> list[sp.Expr]:
        return [l * part for l, part in zip(self._lengths(), vector("s", s), strict=True)]

    def require_convex(self, dimension: int, numbers: Numbers) -> None:
        """The semiaxes must be positive, one for each control."""
        require_positive("Ellipsoid: semiaxes", self.semiaxes, numbers, dimension)


@value_class
@dataclass(frozen=True, eq=False)
class Box(Bounded):
    """|u_i| <= l_i.

    Parameters
    ----------
    bounds : sequence of m numbers or expressions
        l_i > 0.

    Examples
    --------
    >>> p, q = sp.symbols("p q", real=True)
    >>> Box([1, 2]).support([p, q])
    Abs(p) + 2*Abs(q)
    """

    bounds: Sequence[Number]

    def __post_init__(self) -> None:
        object.__setattr__(self, "bounds", _entries("Box: bounds", self.bounds))

    def support(self, s: Sequence[sp.Expr]) -> sp.Expr:
        """sum of l_i |s_i|."""
        return sp.Add(*self._each(sp.Abs, s))

    def maximiser(self, s: Sequence[sp.Expr]) -> sp.Matrix:
        """l_i sign(s_i)."""
        return sp.Matrix(self._each(sp.sign, s))

    def _each(self, function: type[sp.Function], s: Sequence[sp.Expr]) -> list[sp.Expr]:
        return [
            l * _of_one(function, part)
            for l, part in zip(vector("bounds", self.bounds), vector("s", s), strict=True)
        ]

    def require_convex(self, dimension: int, numbers: Numbers) -> None:
        """The bounds must be positive, one for each control."""
        require_positive("Box: bounds", self.bounds, numbers, dimension)


@value_class
@dataclass(frozen=True, eq=False)
class BoundedQuadratic:
    """|u| <= radius, at the cost weight |u|^2.

    Examples
    --------
    >>> p = sp.Symbol("p", real=True)
    >>> BoundedQuadratic(1).support([p])
    Piecewise((p**2/4, Abs(p) <= 2), (Abs(p) - 1, True))
    """

    radius: Number = 1
    weight: Number = 1

    def __post_init__(self) -> None:
        for name, value in (("radius", self.radius), ("weight", self.weight)):
            expression(f"BoundedQuadratic: {name}", value, name)

    def support(self, s: Sequence[sp.Expr]) -> sp.Expr:
        """|s|^2 / (4 weight) if the unbounded maximum is in the ball, else radius |s| - weight radius^2."""
        radius, weight, norm = *self._numbers(), _norm(s)
        squares = sp.Add(*(part**2 for part in vector("s", s)))
        return sp.Piecewise(
            (squares / (4 * weight), norm <= 2 * weight * radius),
            (radius * norm - weight * radius**2, True),
        )

    def maximiser(self, s: Sequence[sp.Expr]) -> sp.Matrix:
        """s / (2 weight), shortened to the radius where it is longer."""
        radius, weight, norm = *self._numbers(), _norm(s)
        inside = norm <= 2 * weight * radius
        return sp.Matrix(
            [
                sp.Piecewise((part / (2 * weight), inside), (radius * unit, True))
                for part, unit in zip(vector("s", s), _unit(s), strict=True)
            ]
        )

    def cost(self, u: Sequence[sp.Expr]) -> sp.Expr:
        """Weight times |u|^2."""
        return expression("weight", self.weight) * sp.Add(*(part**2 for part in vector("u", u)))

    def _numbers(self) -> tuple[sp.Expr, sp.Expr]:
        return expression("radius", self.radius), expression("weight", self.weight)

    def require_convex(self, dimension: int, numbers: Numbers) -> None:
        """Radius and weight must be positive."""
        require_positive("BoundedQuadratic: radius", [self.radius], numbers)
        require_positive("BoundedQuadratic: weight", [self.weight], numbers)


def _entries(name: str, values: Any) -> tuple[Number, ...]:
    """The numbers and expressions of a sequence, as they are given but checked."""
    argument = name.partition(": ")[2]
    require_bare(argument, values, "a sequence such as a list")
    try:
        entries = None if isinstance(values, str | bytes | Set | Mapping) else tuple(values)
    except TypeError:
        entries = None
    if entries is None:
        raise ArgumentTypeError(f"{name} must be a sequence such as a list, got {values!r}", argument)
    for i, value in enumerate(entries):
        expression(f"{name}[{i}]", value, argument)
    return entries


def _expanded(square: sp.Expr) -> sp.Expr:
    """Products multiplied out, but no exponential divided into factors, which may overflow by themselves."""
    return sp.expand(square, power_exp=False)


def _norm(s: Sequence[sp.Expr]) -> sp.Expr:
    parts = vector("s", s)
    return _of_one(sp.Abs, parts[0]) if len(parts) == 1 else sp.sqrt(sp.Add(*(part**2 for part in parts)))


def _unit(s: Sequence[sp.Expr]) -> sp.Matrix:
    parts = vector("s", s)
    return sp.Matrix([_of_one(sp.sign, parts[0])]) if len(parts) == 1 else sp.Matrix(parts) / _norm(parts)


def _of_one(function: type[sp.Function], value: sp.Expr) -> sp.Expr:
    """Abs or sign of a real expression, without simplifying the roots of positive quantities in it."""
    roots = {power: sp.Dummy(positive=True) for power in value.atoms(sp.Pow) if not power.exp.is_integer}
    back = {positive: power for power, positive in roots.items()}
    return function(value.xreplace(roots)).xreplace(back)
