"""Motion in the plane along an extremal of example 2: position, thrust and osculating ellipse.

Energy, angular momentum and the anomaly give the position on the osculating ellipse. The ellipse's
orientation, the angle gamma of its pericentre, is integrated here. The fixed axes pass through the attracting
centre, the first of them through the pericentre at the start.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.interpolate import CubicSpline

from pontryagin.arrays import Array
from pontryagin.averaging.derivation import kepler as elements
from pontryagin.averaging.derivation import kepler_orbit as orbit
from pontryagin.averaging.exact.extremal import Extremal
from pontryagin.numerics import compile as compiler

PER_TURN = 80
"""Number of samples per turn."""
FINER = 4
"""Number of steps of the quadrature for gamma between two samples."""


@dataclass(frozen=True)
class SpiralFlight:
    """The motion at slow times (k,).

    Attributes
    ----------
    tau : (k,) array
    slow : (k, 2) array
        E and K.
    pericentre : (k,) array
        gamma, rad; 0 at the start.
    anomaly : (k,) array
        True anomaly within a turn.
    control : (k, 2) array
        u_r, u_phi.
    place, thrust : (k, 2) array
        Position, and the control turned into the same fixed axes.
    """

    tau: Array
    slow: Array
    pericentre: Array
    anomaly: Array
    control: Array
    place: Array
    thrust: Array

    def ellipses(self, points: int) -> Array:
        """The osculating ellipse at each time as a closed line, (k, points, 2)."""
        return ellipses(self.slow, self.pericentre, points)


def fly(extremal: Extremal) -> SpiralFlight:
    """Follow an extremal of `kepler` through the plane."""
    samples = FINER * max(PER_TURN, int(np.ceil(PER_TURN * extremal.turns)))
    tau = np.linspace(0.0, extremal.duration, samples + 1)
    slow, control, eccentric = extremal.slow(tau), extremal.control(tau), extremal.anomaly(tau)
    true, rate = _pericentre_rate()(*slow.T, eccentric, *control.T)
    pericentre = CubicSpline(tau, rate).antiderivative()(tau)
    shown = slice(None, None, FINER)
    at = (*slow[shown].T, pericentre[shown], true[shown])
    thrust = _thrust()(*at, *control[shown].T)[0][..., 0]
    return SpiralFlight(
        tau[shown],
        slow[shown],
        pericentre[shown],
        true[shown],
        control[shown],
        _place()(*at)[0][..., 0],
        thrust,
    )


def ellipses(slow: Array, pericentre: Array, points: int) -> Array:
    """Orbits of energies and angular momenta (k, 2), pericentres at angles (k,), as lines (k, points, 2).

    Examples
    --------
    >>> ellipses(np.array([[-0.5, 0.8]]), np.zeros(1), 3).round(12) + 0.0
    array([[[ 0.4,  0. ],
            [-1.6,  0. ],
            [ 0.4,  0. ]]])
    """
    turn = np.linspace(0.0, 2 * np.pi, points)
    each = (np.asarray(column)[..., None] for column in (*slow.T, pericentre))
    return _place()(*each, turn)[0][..., 0]


@lru_cache(maxsize=1)
def _place() -> Callable[..., tuple[Array, ...]]:
    at = [elements.energy, elements.momentum, elements.gamma, elements.anomaly]
    return compiler.function("place", at, {"place": orbit.position()})


@lru_cache(maxsize=1)
def _thrust() -> Callable[..., tuple[Array, ...]]:
    at = [elements.energy, elements.momentum, elements.gamma, elements.anomaly, *elements.CONTROL]
    return compiler.function("thrust", at, {"thrust": orbit.any_thrust()})


@lru_cache(maxsize=1)
def _pericentre_rate() -> Callable[..., tuple[Array, ...]]:
    true = orbit.true_anomaly()
    at = [elements.energy, elements.momentum, elements.eccentric, *elements.CONTROL]
    rate = orbit.pericentre_rate().subs(elements.anomaly, true)
    return compiler.function("pericentre", at, {"true": true, "rate": rate})
