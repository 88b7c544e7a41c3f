"""Numbers and trajectories that the tests of the derivation of rendezvous share."""

import numpy as np

from pontryagin.numerics.flow import flow
from pontryagin.rendezvous.derivation import (
    model,
)

TARGET = [1.0, 1.5, 0.1, np.sqrt(1.5)]
"""Values of fM, p*, e* and c*."""


SCALE = {"unsaturated": 1.0, "saturated": 0.08, "time-optimal": 0.08}


SPAN = np.linspace(0.0, 3.0, 7)


START = [1.1, 0.1, 1.05, 0.4]


COSTATES = [0.05, 0.15, 0.3, 0.21, 0.26, -0.13]


ATTITUDE = np.array([0.8, 0.1, -0.5, 0.31]) / np.linalg.norm([0.8, 0.1, -0.5, 0.31])


def trajectory(form, start, scale):
    integrate = flow(form.states, form.rates, form.parameters)
    return integrate(start, SPAN, [*TARGET, scale])


def multiplied(p, q):
    """Hamilton's product in NumPy, from the rule i j = k."""
    a, b, c, d = p
    e, f, g, h = q
    return np.array(
        [
            a * e - b * f - c * g - d * h,
            a * f + b * e + c * h - d * g,
            a * g - b * h + c * e + d * f,
            a * h + b * g - c * f + d * e,
        ]
    )


TARGET_SYMBOLS = [model.gravity, model.parameter, model.eccentricity, model.areal]
