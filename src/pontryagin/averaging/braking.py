"""Example 3 flown: a symmetric body under the synthesis of the first approximation, a feedback."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike, NDArray
from scipy.integrate import solve_ivp

from pontryagin import compile as compiler
from pontryagin.averaging.derivation import rigid_body
from pontryagin.errors import NotConverged
from pontryagin.validation import positive, vectors

Array = NDArray[np.float64]

STOPPED = 1e-6
"""Share of the first transverse rate at which the body counts as stopped: the synthesis has no value at 0."""
PER_TURN = 96


@dataclass(frozen=True)
class Braking:
    """A flight at slow times (k,).

    Attributes
    ----------
    tau : (k,) array
    rates : (k, 3) array
        Angular velocity in the principal axes.
    control : (k, 3) array
        u, torques over moments of inertia.
    """

    tau: Array
    rates: Array
    control: Array

    @property
    def transverse(self) -> Array:
        """a, (k,)."""
        return np.hypot(self.rates[:, 0], self.rates[:, 1])


def brake(omega0: ArrayLike, semiaxes: ArrayLike, ratio: float, epsilon: float) -> Braking:
    """Fly Euler's equations (3.10) under the synthesis until the precession has stopped.

    Parameters
    ----------
    omega0, semiaxes, ratio
        As in `spin_down`, of one problem.
    epsilon : float
        Positive.

    Raises
    ------
    ValueError
        If an argument is not finite, wrongly shaped, or not positive where it has to be.
    NotConverged
        If the integrator stops short.

    Examples
    --------
    >>> flight = brake([0.3, 0.4, 2.0], [1.0, 1.0, 1.0], ratio=0.5, epsilon=0.05)
    >>> round(float(flight.tau[-1]), 5)
    0.5
    """
    start, axes = vectors("omega0", omega0, 3), vectors("semiaxes", semiaxes, 3)
    for name, value in (("semiaxes", axes), ("ratio", ratio), ("epsilon", epsilon)):
        positive(name, value)
    low = STOPPED * float(np.hypot(*start[:2]))

    def stopped(t: float, w: Array) -> float:
        return float(np.hypot(w[0], w[1])) - low

    stopped.terminal = True  # type: ignore[attr-defined]
    longest = 2 * float(np.hypot(*start[:2])) / float(axes[:2].min()) / epsilon
    step = 2 * np.pi / (PER_TURN * max(abs((ratio - 1) * start[2]), 1e-3))
    flown = solve_ivp(
        lambda t, w: np.array(_rates()(*w, *axes, ratio, epsilon)),
        (0.0, longest),
        start,
        events=stopped,
        max_step=step,
        rtol=1e-10,
        atol=1e-12,
    )
    if not flown.success or not flown.t_events or flown.t_events[0].size == 0:
        raise NotConverged(f"the body did not stop: {flown.message}", float(np.hypot(*flown.y[:2, -1])))
    control = np.stack(np.broadcast_arrays(*_control()(*flown.y, *axes)), axis=-1)
    return Braking(epsilon * flown.t, flown.y.T, control)


def _synthesis() -> dict[str, sp.Expr]:
    return {str(name): value for name, value in zip(rigid_body.u, rigid_body.braking(), strict=True)}


@lru_cache(maxsize=1)
def _control():
    return compiler.function("synthesis", [*rigid_body.w, *rigid_body.semiaxes], _synthesis())


@lru_cache(maxsize=1)
def _rates():
    controlled = dict(zip(rigid_body.u, rigid_body.braking(), strict=True))
    rates = rigid_body.symmetric_rates().subs(controlled)
    arguments = [*rigid_body.w, *rigid_body.semiaxes, rigid_body.d, rigid_body.epsilon]
    named = {f"rate_{name}": value for name, value in zip(rigid_body.w, rates, strict=True)}
    return compiler.function("rates", arguments, named)
