"""The check of every gauge before it is returned: its lower and its upper bound must agree."""

import numpy as np

from pontryagin.arrays import Array
from pontryagin.certificate import ACCEPTED, Certificate
from pontryagin.errors import NotConverged

PROVED = 10 * ACCEPTED
"""Largest residual and gap of a gauge that is returned.

It is larger than `ACCEPTED` because of sets that are nearly flat, as at intervals close to whole revolutions.
Their two bounds agree only to rounding times the ratio of the largest width to the least.
"""


def unit(rows: Array) -> Array:
    """Vectors of length 1 along the given ones (rows, n), which may be of any size; zero vectors stay zero.

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
            reason = f"{what} could not be proved: rounding leaves a residual or gap above {PROVED:g}"
            raise NotConverged(reason, float(proof.residual.max()))
