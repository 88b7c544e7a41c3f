"""Example 3, from (3.10) on: a symmetric rigid body is freed of its precession in the least time."""

from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.averaging.averaged.solution import AveragedSolution
from pontryagin.averaging.averaged.solve import solved
from pontryagin.averaging.examples.models import example_model, example_system
from pontryagin.errors import ArgumentValueError
from pontryagin.validation import common_shape, positive, vectors

if TYPE_CHECKING:
    from pontryagin.averaging.examples.rotating_frame import RotatingFrame


def spin_down(omega0: ArrayLike, semiaxes: ArrayLike, ratio: ArrayLike) -> AveragedSolution:
    """Bring w_x and w_y to zero in the least time, with the control in an ellipsoid and w_z free at the end.

    Parameters
    ----------
    omega0 : (..., 3) array
        Angular velocity in the principal axes; w_z must not vanish.
    semiaxes : (..., 3) array
        l_x, l_y, l_z > 0: (u_x/l_x)^2 + (u_y/l_y)^2 + (u_z/l_z)^2 <= 1, u torques over moments of inertia.
    ratio : (...) array
        d = I_z / I_x > 0 other than 1.

    Returns
    -------
    AveragedSolution
        In the slow variables (a, c), a = |(w_x, w_y)| and c = w_z: duration and cost a_0 / <R>. The phase is
        the angle of (w_x, w_y), counted in the sense in which it turns, that of (d - 1) c; `initial_phase`
        is that of omega0. The exact extremals of `exact` are found in a frame that turns with the free body,
        where the target is regular (`rotating_frame`), and given in a, c and psi.

    Raises
    ------
    ValueError
        If an argument is not finite or wrongly shaped, semiaxes or ratio not positive, or omega = |(d - 1) c|
        zero.

    Examples
    --------
    >>> solution = spin_down([3.0, 4.0, 2.0], [1.0, 1.0, 1.0], ratio=0.5)
    >>> round(float(solution.duration), 12)
    5.0
    """
    w = vectors("omega0", omega0, 3)
    axes = vectors("semiaxes", semiaxes, 3)
    positive("semiaxes", axes)
    d = positive("ratio", ratio)
    common_shape(omega0=w.shape[:-1], semiaxes=axes.shape[:-1], ratio=d.shape)
    if (d == 1).any():
        message = "ratio must differ from 1, got 1: omega = |(ratio - 1) w_z| would be 0"
        raise ArgumentValueError(message, "ratio")
    if (w[..., 2] == 0).any():
        got = w[w[..., 2] == 0][0]
        message = f"omega0 must have w_z other than 0, got {got}: omega = |(ratio - 1) w_z| would be 0"
        raise ArgumentValueError(message, "omega0")
    sense = np.sign((d - 1) * w[..., 2])
    numbers = (*np.moveaxis(axes, -1, 0), d, sense)
    start = np.stack([np.hypot(w[..., 0], w[..., 1]), w[..., 2]], axis=-1)
    return solved(
        example_model("spin_down"),
        ("a", "c"),
        start,
        numbers,
        partial(example_system, "spin_down", numbers),
        initial_phase=sense * np.arctan2(w[..., 1], w[..., 0]),
        frame=_in_rotating_frame,
    )


def _in_rotating_frame(solution: AveragedSolution) -> "RotatingFrame":
    from pontryagin.averaging.examples.rotating_frame import in_rotating_frame  # loads SymPy

    return in_rotating_frame(solution)
