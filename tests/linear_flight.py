"""The paper's linear motion near the circular orbit, flown by SciPy."""

import numpy as np
from scipy.integrate import solve_ivp

from pontryagin.orbit_correction.system.satellite import LINEAR


def fly(plan):
    """The state at the end of the linear flow by SciPy, with a jump of the speeds before each interval."""
    z = plan.z0
    for impulse in plan.impulses:
        kicked = z + np.array([0, *impulse])
        z = solve_ivp(lambda _, x: LINEAR @ x, (0, plan.thrust.interval), kicked, rtol=1e-12, atol=1e-16).y[
            :, -1
        ]
    return z
