"""Example 3 under feedback: a symmetric body controlled by the synthesis of the first approximation."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import cast

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import OdeSolution, solve_ivp

from pontryagin.arrays import Array
from pontryagin.averaging.derivation import rigid_body
from pontryagin.errors import ArgumentValueError, NotConverged
from pontryagin.numerics import compile as compiler
from pontryagin.validation import positive, vectors

STOPPED = 1e-6
"""The body counts as stopped at this share of its first transverse rate; at 0 no synthesis is defined."""
PER_TURN, FEWEST = 96, 400
"""Number of samples per turn, and least number of samples in all."""


@dataclass(frozen=True)
class Braking:
    """The motion of a body under the synthesis, at slow times (k,).

    Attributes
    ----------
    tau : (k,) array
    rates : (k, 3) array
        Angular velocity in the principal axes.
    control : (k, 3) array
        u, the torques divided by the moments of inertia.
    """

    tau: Array
    rates: Array
    control: Array

    @property
    def transverse(self) -> Array:
        """a, (k,)."""
        return np.hypot(self.rates[:, 0], self.rates[:, 1])


def brake(omega0: ArrayLike, semiaxes: ArrayLike, ratio: float, epsilon: float) -> Braking:
    """Integrate Euler's equations (3.10) under the synthesis until the precession has stopped.

    Parameters
    ----------
    omega0, semiaxes, ratio
        As in `spin_down`, for one problem.
    epsilon : float
        Positive.

    Raises
    ------
    ValueError
        If an argument is not finite, wrongly shaped, or not positive where it has to be, or the body has no
        precession at the start.
    NotConverged
        If the body does not stop.

    Examples
    --------
    >>> flight = brake([0.3, 0.4, 2.0], [1.0, 1.0, 1.0], ratio=0.5, epsilon=0.05)
    >>> round(float(flight.tau[-1]), 5)
    0.5
    """
    start, axes = vectors("omega0", omega0, 3), vectors("semiaxes", semiaxes, 3)
    for name, value in (("semiaxes", axes), ("ratio", ratio), ("epsilon", epsilon)):
        positive(name, value)
    if not np.hypot(*start[:2]) > 0:
        message = (
            f"omega0 must have w_x or w_y other than 0, as there is no precession otherwise, got {start}"
        )
        raise ArgumentValueError(message, "omega0")
    path, last = fly(start, axes, ratio, epsilon)
    turns = max(abs((ratio - 1) * start[2]), float(np.hypot(*start[:2]))) * last / (2 * np.pi)
    even = np.linspace(0.0, last, max(FEWEST, int(PER_TURN * turns)))
    # Close to rest w turns quickly to an axis of the ellipse, which the integrator's own steps resolve.
    t = np.union1d(even, path.ts[path.ts < last])
    rates = path(t).T
    return Braking(epsilon * t, rates, synthesis(rates, axes))


def fly(start: Array, semiaxes: Array, ratio: float, epsilon: float) -> tuple[OdeSolution, float]:
    """omega under the synthesis as a function of time, (k,) to (3, k), and the time when the body stops.

    Raises
    ------
    NotConverged
        If the body does not come to rest in twice the time that the weaker semiaxis alone would take.
    """
    first = float(np.hypot(*start[:2]))
    constants = (*semiaxes[:2], ratio, epsilon)

    def rest(_: float, w: Array) -> float:
        return float(np.hypot(w[0], w[1])) - STOPPED * first

    rest.terminal = True  # type: ignore[attr-defined]
    longest = 2 * first / float(semiaxes[:2].min()) / epsilon
    run = solve_ivp(
        lambda _, w: _synthesis()(*w, *constants)[0][..., 0],
        (0.0, longest),
        start,
        method="DOP853",
        rtol=1e-10,
        atol=1e-12,
        events=rest,
        dense_output=True,
    )
    if run.status != 1:
        raise NotConverged(
            f"the precession has not stopped at the time {run.t[-1]:.6g}: {run.message}",
            rest(0.0, run.y[:, -1]),
        )
    return cast(OdeSolution, run.sol), float(run.t[-1])


def synthesis(rates: Array, semiaxes: Array) -> Array:
    """u of the first approximation as a function of omega (k, 3), (k, 3)."""
    _, control = _synthesis()(*rates.T, *semiaxes[:2], 1.0, 1.0)
    return control[..., 0]


@lru_cache(maxsize=1)
def _synthesis() -> Callable[..., tuple[Array, ...]]:
    """omega' and u as functions of omega under `rigid_body.braking`."""
    control = rigid_body.braking()
    rates = rigid_body.symmetric_rates().subs(dict(zip(rigid_body.u, control, strict=True)))
    arguments = [*rigid_body.w, *rigid_body.semiaxes[:2], rigid_body.d, rigid_body.epsilon]
    return compiler.function("synthesis", arguments, {"rates": rates, "control": control})
