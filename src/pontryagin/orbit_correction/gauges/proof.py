"""What makes a gauge handed out a proved one."""

import numpy as np

from pontryagin.arrays import Array
from pontryagin.certificate import ACCEPTED, Certificate
from pontryagin.errors import NotConverged


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
    """Raise `NotConverged` where a residual is not small, or the bounds on a gauge do not meet."""
    with np.errstate(all="ignore"):
        if not (proof.residual <= ACCEPTED).all():
            raise NotConverged(f"{what} could not be proved: lost to rounding", float(proof.residual.max()))
