"""Sapunkov's elements A, B and phi: conversion from and to place and velocity."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentValueError
from pontryagin.numerics.complex_step import jacobian
from pontryagin.numerics.rotation import conjugate, product
from pontryagin.rendezvous import kernels
from pontryagin.validation import common_shape, finite, positive, vectors
from pontryagin.value import value_class

I1 = np.array([0.0, 1.0, 0.0, 0.0])
RELATED = 1e-6
"""Largest residual of the bilinear relation that is accepted, relative to A^2 + B^2."""


@value_class
@dataclass(frozen=True, eq=False)
class Elements:
    """A place and a velocity on an ellipse, as A, B and phi; or a stack of them.

    The spinor u = A cos phi + B sin phi gives the place, R = u~ o i1 o u, and w = -A sin phi + B cos phi the
    velocity; A and B are constant while the craft coasts. Turning A and B together, A -> exp(i1 s) o A,
    changes neither R nor V.

    Parameters
    ----------
    A, B : (..., 4) array_like
        Scalar part first, in square roots of the unit of length.
    phi : (...) array_like
        Half the eccentric anomaly, up to a constant.
    gravity : float
        fM.

    Raises
    ------
    ValueError, TypeError
        If an argument is not as above; the message names it. Also if A and B both vanish, or do not satisfy
        scal(A~ o i1 o B) = 0, which holds for those of any place and velocity.

    Examples
    --------
    >>> start = Elements.from_state([1.0, 0, 0], [0.0, 1, 0])
    >>> start.A.round(12) + 0.0, start.B.round(12) + 0.0, round(float(start.Q), 12)
    (array([1., 0., 0., 0.]), array([ 0.,  0.,  0., -1.]), 2.0)
    >>> start.at(np.pi / 4).position.round(12) + 0.0
    array([0., 1., 0.])
    """

    A: Array
    B: Array
    phi: Array = 0.0  # type: ignore[assignment]
    gravity: float = 1.0

    if TYPE_CHECKING:

        def __init__(
            self, A: ArrayLike, B: ArrayLike, phi: ArrayLike = 0.0, gravity: float = 1.0
        ) -> None: ...

    def __post_init__(self) -> None:
        A, B = vectors("A", self.A, 4), vectors("B", self.B, 4)
        phi = finite("phi", self.phi, "a number or an array of them")
        gravity = _gravity(self.gravity)
        shape = common_shape(A=A.shape[:-1], B=B.shape[:-1], phi=phi.shape)
        for name, value in (("A", A), ("B", B)):
            object.__setattr__(self, name, np.broadcast_to(value, (*shape, 4)))
        object.__setattr__(self, "phi", np.broadcast_to(phi, shape))
        object.__setattr__(self, "gravity", gravity)
        if np.any(self.Q == 0):
            raise ArgumentValueError("A and B must not both be zero, got 0, 0, 0, 0 for each", "A")
        if np.any(off := np.abs(self.relation) > RELATED * self.Q):
            worst = float(np.broadcast_to(self.relation, off.shape)[off].flat[0])
            raise ArgumentValueError(f"A and B must satisfy scal(A~ o i1 o B) = 0, got {worst:.6g}", "B")

    @classmethod
    def from_state(cls, position: ArrayLike, velocity: ArrayLike, gravity: float = 1.0) -> "Elements":
        """The elements of R and V (..., 3), with phi = 0.

        Raises
        ------
        ValueError
            If the energy is not negative, or R is zero.

        Examples
        --------
        >>> Elements.from_state([-2.0, 0, 0], [0, 0, 0.5]).position
        array([-2.,  0.,  0.])
        """
        R, V = vectors("position", position, 3), vectors("velocity", velocity, 3)
        common_shape(position=R.shape[:-1], velocity=V.shape[:-1])
        R, V = np.broadcast_arrays(R, V)
        scale = _gravity(gravity)
        r = np.linalg.norm(R, axis=-1)
        if np.any(r == 0):
            raise ArgumentValueError("position must not be the centre of attraction, got 0, 0, 0", "position")
        energy = np.sum(V**2, axis=-1) / 2 - scale / r
        if np.any(energy >= 0):
            raise ArgumentValueError(
                "velocity must leave the energy V^2/2 - gravity/r negative, as the elements A and B exist on "
                f"ellipses only, got {float(np.max(energy)):.6g}",
                "velocity",
            )
        both = _oscillation(R, V / np.sqrt(scale))
        return cls(both[..., :4], both[..., 4:], np.zeros(r.shape), scale)

    def at(self, phi: ArrayLike) -> "Elements":
        """The elements of the same orbit at another phi."""
        return Elements(self.A, self.B, phi, self.gravity)

    @property
    def Q(self) -> Array:
        """A^2 + B^2, twice the semi-axis, (...)."""
        return np.asarray(np.sum(np.square(self.A) + np.square(self.B), axis=-1))

    @property
    def u(self) -> Array:
        """A cos phi + B sin phi, (..., 4)."""
        phi = np.asarray(self.phi)[..., None]
        return np.asarray(self.A * np.cos(phi) + self.B * np.sin(phi))

    @property
    def w(self) -> Array:
        """du/d phi at constant A and B, (..., 4)."""
        phi = np.asarray(self.phi)[..., None]
        return np.asarray(self.B * np.cos(phi) - self.A * np.sin(phi))

    @property
    def position(self) -> Array:
        """R, (..., 3)."""
        return place(self.A, self.B, self.phi)[..., :3]

    @property
    def velocity(self) -> Array:
        """V, (..., 3)."""
        return np.asarray(place(self.A, self.B, self.phi)[..., 3:] * np.sqrt(self.gravity))

    @property
    def relation(self) -> Array:
        """scal(A~ o i1 o B), zero for elements of a place and a velocity, (...)."""
        return product(conjugate(self.A), product(I1, self.B))[..., 0]

    def turned(self, angle: ArrayLike) -> "Elements":
        """Elements with A and B turned together by exp(i1 angle); place and velocity are the same."""
        half = finite("angle", angle, "a number or an array of them")[..., None]
        turn = np.cos(half) * np.array([1.0, 0, 0, 0]) + np.sin(half) * I1
        return Elements(product(turn, self.A), product(turn, self.B), self.phi, self.gravity)


def _gravity(value: ArrayLike) -> float:
    gravity = positive("gravity", value)
    if gravity.ndim:
        raise ArgumentValueError(
            f"gravity must be one number, got an array of shape {gravity.shape}", "gravity"
        )
    return float(gravity)


def place(A: ArrayLike, B: ArrayLike, phi: ArrayLike) -> Array:
    """R and V (..., 6) of A, B and phi, fM = 1."""
    columns = [*np.moveaxis(np.asarray(A), -1, 0), *np.moveaxis(np.asarray(B), -1, 0), np.asarray(phi)]
    return np.stack(kernels.element_place(*columns), axis=-1)


def relation_gradient(craft: Elements) -> Array:
    """Gradient of scal(A~ o i1 o B) in A and B, (8,)."""
    return np.concatenate([product(I1, craft.B), -product(I1, craft.A)])


def place_gradient(craft: Elements) -> Array:
    """Derivatives (6, 8) of R and V in A and B, fM = 1."""
    inputs = np.concatenate([craft.A, craft.B, [craft.phi]])
    return jacobian(lambda x: kernels.element_place(*x), inputs)[1][:, :8]


def _oscillation(R: Array, V: Array) -> Array:
    """u and w, (..., 8), of R and V, fM = 1, by the one of two formulas that is regular at R."""
    ahead = R[..., 0] >= 0
    parts = [*np.moveaxis(R, -1, 0), *np.moveaxis(V, -1, 0)]
    with np.errstate(divide="ignore", invalid="ignore"):
        both = [
            np.stack(np.broadcast_arrays(*kernel(*parts)), axis=-1)  # type: ignore[no-untyped-call]
            for kernel in (kernels.oscillation_ahead, kernels.oscillation_behind)
        ]
    return np.where(ahead[..., None], *both)
