"""The general theory as symbolic identities; the closed forms of the rippled example compared with SciPy."""

import math

import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp

from pontryagin.averaging.derivation import averaged, optimum, principle, ripple

A1, A2 = principle.a


@pytest.mark.slow
def test_the_costates_follow_from_the_first_variation():
    """Of H, (1.4), at fixed u; the ends have the target (1.2) and the cost (1.3), and H = 0 by (1.7)."""
    H = principle.hamiltonian()
    expected = sp.Matrix([-H.diff(x) for x in (*principle.a, principle.psi)])
    assert sp.simplify(principle.costate_rates() - expected).is_zero_matrix
    ends, level = principle.end_conditions()
    assert ends[2] == 0
    assert ends[0] == -principle.g.diff(A1) - principle.alpha * principle.M.diff(A1)
    assert sp.expand(level - H) == 0


def test_the_envelope_and_the_conservation_of_h():
    """The control is that of (1.5), the integral that of (1.8)."""
    assert principle.envelope() == [0] * 6
    H = principle.omega * principle.q + principle.epsilon * principle.h_star
    assert principle.along(H) == 0
    assert principle.along(principle.q) != 0


def test_the_phase_costate_solves_the_level_to_second_order():
    """The level is (1.8)."""
    first, second = principle.phase_costate()
    h = 1 + sp.sin(principle.psi) + A1 * principle.q + principle.epsilon * A2
    concrete = {principle.h_star: h, principle.omega: 1 + A1**2}
    level = (1 + A1**2) * principle.q + principle.epsilon * h
    q = sum(
        principle.epsilon ** (i + 1) * term.subs(principle.omega, concrete[principle.omega])
        for i, term in enumerate((first, second))
    )
    plain = sp.Function("h^*", real=True)
    q = q.replace(plain, lambda *at: h.subs({principle.q: at[5], principle.epsilon: at[6]})).doit()
    left = sp.series(sp.expand(level.subs(principle.q, q)), principle.epsilon, 0, 3).removeO()
    assert sp.simplify(left) == 0


@pytest.mark.slow
def test_the_averaged_system_keeps_its_integral_and_its_hamiltonian():
    """The integral (2.10) along (2.3), H0 along (2.11)."""
    assert averaged.homogeneity() == 0
    assert set(averaged.mean_and_derivative_commute()) == {0}
    assert averaged.along(averaged.integral(), averaged.standard_rates()) == 0
    assert averaged.along(averaged.averaged_hamiltonian(), averaged.rates()) == 0
    assert averaged.along(averaged.integral(), averaged.rates()) != 0
    forward, backward = averaged.standard_rates()
    flipped = sp.Matrix([-2 * averaged.h0.diff(x) for x in averaged.xi]) - backward
    assert averaged.along(averaged.integral(), (forward, flipped)) != 0


def test_the_main_result_and_what_follows_from_it():
    """(2.14), (2.15) and (2.16)."""
    assert optimum.lagrange_identity() == 0
    assert optimum.cost_by_the_end() == 0
    slope = averaged.kappa * optimum.Psi.diff(averaged.kappa)
    assert optimum.cost_slope() == slope
    assert optimum.second_derivative() == optimum.Psi.diff(averaged.kappa).subs(averaged.kappa, 0)
    assert sp.simplify(optimum.cost_difference().diff(averaged.kappa) - slope) == 0


def test_orders_fall_by_three():
    n = sp.Symbol("n")
    sizes = list(averaged.order(n).values())
    assert sizes[0] - sizes[-1] == 3
    assert averaged.cyclic_costate() == 0


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
