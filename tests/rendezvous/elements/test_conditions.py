"""The meeting conditions in the elements and their exact derivatives."""

import math

import numpy as np
import pytest

from pontryagin.rendezvous.elements.conditions import ElementsSetting, equations
from pontryagin.rendezvous.elements.law import Law
from rendezvous_problems import problem

COSTATES = np.array([1.5, -0.7, 2.2, -1.3, -2.1, -1.8])


@pytest.mark.slow
@pytest.mark.parametrize("duration", [None, 5.0])
@pytest.mark.parametrize(
    "law",
    [
        Law("square", 0.01, math.inf),
        Law("square", 0.01, 0.08),
        Law("fuel", 0.01, 0.3),
        Law("fuel", 0.01, 0.3, 0.2),
    ],
    ids=["unbounded", "bounded", "jumping", "smoothed"],
)
def test_the_jacobian_is_the_derivative_of_the_equations(law, duration):
    """This holds across switches too, where the derivatives are discontinuous."""
    setting, h = ElementsSetting(problem(20).scaled, law, duration), 1e-6
    point = np.append(COSTATES * (1.0 if law.kind == "fuel" else 0.1), 2.2)
    exact = equations(setting, point)
    columns = [
        (equations(setting, point + h * x).residual - equations(setting, point - h * x).residual) / (2 * h)
        for x in np.eye(7)
    ]
    assert np.allclose(np.array(columns).T, exact.jacobian, rtol=1e-6, atol=1e-6)
    assert (len(exact.flight.pieces) > 1) == (law.peak < 1 and not law.width)
