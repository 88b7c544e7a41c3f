"""The check that a gauge must pass before it is handed out: its two bounds agree."""

import numpy as np

from pontryagin.arrays import Array
from pontryagin.certificate import ACCEPTED, Certificate
from pontryagin.errors import NotConverged

PROVED = 10 * ACCEPTED
"""Largest residual and gap of a gauge that is handed out.

It exceeds `ACCEPTED` for the sake of sets that are nearly flat, as at intervals close to whole revolutions:
their two bounds agree only to rounding times the ratio of the largest width to the least.
"""


def unit(rows: Array) -> Array:
    """Vectors (rows, n) of length 1 along those given, however long; zeros stay.

    Examples
    --------
    >>> unit(np.array([[0.0, 0.0], [3e-200, 4e-200]])).tolist()
    [[0.0, 0.0], [0.6, 0.8]]
    """
    largest = np.abs(rows).max(axis=-1, keepdims=True, initial=0.0)
    scaled = np.divide(rows, largest, out=np.zeros_like(rows), where=largest > 0)
    return np.asarray(scaled / np.maximum(np.linalg.norm(scaled, axis=-1, keepdims=True), 0.5))


def require_closed(proof: Certificate, what: str) -> None:
    """Raise `NotConverged` if a residual, or the gap between the bounds on a gauge, exceeds `PROVED`."""
    with np.errstate(all="ignore"):
        if not (proof.residual <= PROVED).all():
            raise NotConverged(f"{what} could not be proved: lost to rounding", float(proof.residual.max()))
