"""The meeting conditions and their exact derivatives."""

import math

import numpy as np
import pytest

from pontryagin.rendezvous.reduced.conditions import Setting, equations
from rendezvous_problems import INCLINATIONS, problem

COSTATES = np.array([0.01, 0.02, 0.05, 0.01, 0.02, 0.03])


@pytest.mark.parametrize("degrees", INCLINATIONS)
@pytest.mark.parametrize(("ratio", "peak"), [(0.01, 0.05), (0.001, 0.05), (math.inf, 0.05), (0.01, math.inf)])
def test_the_jacobian_is_the_derivative_of_the_equations(degrees, ratio, peak):
    """It is so across switches and for the terminal law."""
    setting, h = Setting(problem(degrees).scaled, ratio, peak), 1e-6
    point = np.append(COSTATES, 6.0)
    exact = equations(setting, point)

    def slope(there, back):
        return (there.residual - back.residual) / (2 * h)

    columns = [slope(equations(setting, point + h * x), equations(setting, point - h * x)) for x in np.eye(7)]
    assert np.allclose(np.array(columns).T, exact.jacobian, rtol=1e-6, atol=1e-6)
