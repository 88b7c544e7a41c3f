"""Equations (2) and (3) are Newton's law in rotating axes; symbols as they print."""

import numpy as np
import sympy as sp
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from pontryagin.numerics import compile as compiler
from pontryagin.rendezvous.derivation import (
    model,
    principle,
)
from rendezvous_derived import ATTITUDE, SPAN, START, TARGET, TARGET_SYMBOLS


def test_2_and_3_are_newton_s_law_in_rotating_axes_at_any_thrust():
    def thrust(t):
        return np.array([0.05 * np.sin(3 * t), -0.04 + 0.02 * t, 0.06 * np.cos(2 * t)])

    states = [*principle.STATE]
    rates = compiler.function(
        "rates", [*states, *model.thrust, *TARGET_SYMBOLS], {"rates": principle.state_rates()}
    )
    rotating = solve_ivp(
        lambda t, y: rates(*y, *thrust(t), *TARGET)[0].ravel(),
        (0, 3),
        [*START, *ATTITUDE],
        method="DOP853",
        rtol=1e-12,
        atol=1e-13,
        t_eval=SPAN,
    ).y.T
    place = compiler.function("place", [*states], dict(zip("RV", model.cartesian(), strict=True)))
    R, V = (part[..., 0] for part in place(*rotating.T))

    def newton(t, y):
        radius, normal = y[:3], np.cross(y[:3], y[3:])
        e1, e3 = radius / np.linalg.norm(radius), normal / np.linalg.norm(normal)
        acceleration = np.column_stack([e1, np.cross(e3, e1), e3]) @ thrust(t)
        return [*y[3:], *(acceleration - radius / np.linalg.norm(radius) ** 3)]

    inertial = solve_ivp(
        newton, (0, 3), [*R[0], *V[0]], method="DOP853", rtol=1e-12, atol=1e-13, t_eval=SPAN
    ).y.T
    assert_allclose(np.hstack([R, V]), inertial, atol=1e-10)
    assert abs(rotating[-1, 4:] - rotating[0, 4:]).max() > 0.1


def test_the_symbols_of_the_target_print_with_a_star():
    assert sp.latex(model.anomaly_rate()) == (
        r"\frac{c^* \left(e^* \cos{\left(\varphi^* \right)} + 1\right)^{2}}{\left(p^*\right)^{2}}"
    )
    assert str(model.parameter) == "p_star"
