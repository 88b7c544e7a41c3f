"""The state after a control of constant pieces, propagated piece by piece in extended precision."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array


def miss(
    x0: NDArray,
    xf: NDArray,
    durations: NDArray,
    levels: NDArray,
    force: ArrayLike = 0.0,
    impulses: NDArray | None = None,
) -> Array:
    """Distance from the target over the size of the motion, the largest for the three states.

    Both are in units of the angle: rates times T, accelerations times T^2. The size is the sum of the
    moduli of all terms of the propagation, so that a miss of one rounding error corresponds to a change of
    the data by one.

    Parameters
    ----------
    x0, xf : (n, 3) arrays
        States at the start and at the end.
    durations, levels : (n, k) arrays
        Durations and levels of the pieces of constant control, in time order.
    force : (n,) array or number
        Constant disturbance.
    impulses : (n, k + 1) array, optional
        Impulses before the first piece, between the pieces, and after the last piece.

    Returns
    -------
    (n,) array
    """
    x1, x2, x3, f = (np.asarray(v, dtype=np.longdouble) for v in (*np.moveaxis(x0, -1, 0), force))
    s1, s2, s3 = abs(x1), abs(x2), abs(x3)
    if impulses is not None:
        x3, s3 = x3 + impulses[:, 0], s3 + abs(impulses[:, 0])
    for k in range(durations.shape[1]):
        h, u = durations[:, k].astype(np.longdouble), levels[:, k].astype(np.longdouble)
        x1 = x1 + h * (x2 + h * ((x3 + f) / 2 + h * u / 6))
        s1 = s1 + h * (s2 + h * ((s3 + abs(f)) / 2 + h * abs(u) / 6))
        x2, s2 = x2 + h * (x3 + f + h * u / 2), s2 + h * (s3 + abs(f) + h * abs(u) / 2)
        x3, s3 = x3 + h * u, s3 + h * abs(u)
        if impulses is not None:
            x3, s3 = x3 + impulses[:, k + 1], s3 + abs(impulses[:, k + 1])
    T = durations.sum(axis=1, dtype=np.longdouble)
    targets = np.moveaxis(np.abs(xf), -1, 0)
    parts = zip((x1, x2, x3), (s1, s2, s3), np.moveaxis(xf, -1, 0), targets, (1, T, T * T), strict=True)
    missed, size = zip(
        *((unit * abs(x - end), unit * (s + target)) for x, s, end, target, unit in parts), strict=True
    )
    total = np.max(np.stack(np.broadcast_arrays(*size)), axis=0)
    return (np.max(np.stack(missed), axis=0) / np.where(total == 0, 1, total)).astype(float)


def bang_bang_pieces(duration: NDArray, shares: NDArray, levels: NDArray) -> tuple[NDArray, NDArray]:
    """Durations and levels (n, 3) of a control that is `levels`, and its negative between two switches.

    Parameters
    ----------
    duration : (n,) array
        Time from the start to the end.
    shares : (n, 2) array
        Both switches a >= b as shares of the duration to go.
    levels : (n,) array
        Level outside the switches.
    """
    a, b = duration * shares[:, 0], duration * shares[:, 1]
    pieces = np.stack([duration - a, duration * (shares[:, 0] - shares[:, 1]), b], axis=-1)
    return np.maximum(pieces, 0.0), np.stack([levels, -levels, levels], axis=-1)
