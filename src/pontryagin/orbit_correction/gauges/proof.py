"""What makes a gauge handed out a proved one."""

import numpy as np

from pontryagin.arrays import Array
from pontryagin.certificate import Certificate
from pontryagin.errors import NotConverged

CLOSED = 1e-7
"""Largest residual, and gap relative to the gauge, of an answer that is handed out."""


def unit(rows: Array) -> Array:
    """Vectors (rows, n) of length 1 along those given, however long; zeros stay.

    Examples
    --------
    >>> unit(np.array([[0.0, 0.0], [3e-200, 4e-200]])).tolist()
    [[0.0, 0.0], [0.6, 0.8]]
    """
    largest = np.abs(rows).max(axis=-1, keepdims=True, initial=0.0)
    scaled = np.divide(rows, largest, out=np.zeros_like(rows), where=largest > 0)
    return scaled / np.maximum(np.linalg.norm(scaled, axis=-1, keepdims=True), 0.5)


def require_closed(proof: Certificate, what: str) -> None:
    """Raise `NotConverged` where a residual is not small, or the bounds on a gauge do not meet.

    The gauge is homogeneous in the state: its gap is taken relative to it, however small it is.
    """
    with np.errstate(all="ignore"):
        apart = np.where(
            proof.primal_value > 0, np.abs(1 - proof.dual_value / proof.primal_value), proof.primal_value
        )
    left = np.maximum(np.abs(proof.primal_residual), apart)
    if not (left <= CLOSED).all():
        raise NotConverged(f"{what} could not be proved: lost to rounding", float(left.max()))
