"""The example with a ripple: its family is the averaged motion, its cost obeys the main result."""

import math

import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp

from pontryagin.averaging.derivation import ripple

speeds = st.floats(0.5, 3.0)


@pytest.mark.slow
@given(
    v0=speeds, gap=st.floats(0.1, 2.0), k=st.floats(0.3, 2.0), share=st.floats(-1.0, 0.6), up=st.booleans()
)
def test_the_rippled_family_is_the_averaged_motion(v0, gap, k, share, up):
    v1 = v0 + gap if up else v0
    start = v0 if up else v0 + gap
    rise, kappa = (1 if up else -1), share * k / (v0 + gap)
    numbers = {
        ripple.v0: start, ripple.v1: v1, ripple.k: k, ripple.rise: rise, ripple.kappa: kappa
    }  # fmt: skip
    T, turned, cost = (
        float(ripple.of_kappa(form()).subs(numbers)) for form in (ripple.duration, ripple.turned, ripple.cost)
    )
    costate = float(ripple.costate().subs({ripple.v: start}).subs(numbers))

    def rates(_, y):
        return [y[1] / 2, -kappa, y[0], k + y[1] ** 2 / 4]

    end = solve_ivp(rates, (0, T), [start, costate, 0, 0], rtol=1e-10, atol=1e-12).y[:, -1]
    assert end == pytest.approx([v1, end[1], turned, cost], rel=1e-8)
    assert kappa * v1 + end[1] ** 2 / 4 - k == pytest.approx(0, abs=1e-8)


def test_the_rippled_cost_obeys_the_main_result():
    kappa, rest = ripple.kappa, {ripple.v0: 1, ripple.v1: 2, ripple.k: 1, ripple.rise: 1}
    J, Psi = (ripple.of_kappa(form()).subs(rest) for form in (ripple.cost, ripple.turned))
    assert sp.simplify(J.diff(kappa) - kappa * Psi.diff(kappa)) == 0
    low, high = (float(end.subs(rest).subs(ripple.c, sp.Rational(1, 2))) for end in ripple.window())
    assert [low, high] == pytest.approx([-(1 + math.sqrt(5)) / 4, (math.sqrt(5) - 1) / 4])
    slope = sp.lambdify(kappa, Psi.diff(kappa))
    count = quad(slope, low, high)[0] / math.pi
    expected = float(ripple.roots_in_the_window().subs(rest).subs(ripple.c, sp.Rational(1, 2)))
    assert count == pytest.approx(expected)
