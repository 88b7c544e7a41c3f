"""The paper's route to the least impulse: Chebyshev's polynomial and its three impulses."""

import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose
from scipy.special import eval_chebyt

from pontryagin.triple_integrator.derivation import chebyshev
from pontryagin.triple_integrator.derivation.channel import t0, tau, tf
from pontryagin.triple_integrator.derivation.duality import dual_function_of, impulse_bound, peak_of
from pontryagin.triple_integrator.derivation.model import T, c, multipliers

R = sp.Rational


def test_the_polynomial_is_chebyshevs():
    grid = np.linspace(-1, 1, 11)
    assert_allclose(sp.lambdify(chebyshev.z, chebyshev.chebyshev())(grid), eval_chebyt(2, grid), atol=1e-14)


def test_the_unit_variable_maps_the_ends():
    z = chebyshev.unit_variable()
    assert sp.simplify(z.subs(tau, t0)) == -1
    assert sp.simplify(z.subs(tau, tf)) == 1
    assert sp.diff(z, tau, 2) == 0


def test_the_minimal_element_is_proportional_to_the_polynomial_and_normalised():
    """h0 of (4.2) and (4.4) is a multiple of T_2, (4.5), and satisfies (4.3)."""
    least = chebyshev.minimal_multipliers()
    h0 = chebyshev.dual_in_time().subs(least)
    assert sp.simplify(h0 - least[chebyshev.signed_norm] * chebyshev.chebyshev_in_time()) == 0
    assert sp.simplify(sum(m * least[l] for m, l in zip(c, multipliers, strict=True))) == 1


def test_cramers_rule_gives_the_same_multipliers():
    """(4.6)."""
    numerators, denominator = chebyshev.cramer(chebyshev.matching())
    found = [sp.simplify(value / denominator) for value in numerators.values()]
    unknowns = [*multipliers, chebyshev.signed_norm]
    assert all(
        sp.simplify(value - chebyshev.minimal_multipliers()[unknown]) == 0
        for value, unknown in zip(found, unknowns, strict=True)
    )


@pytest.mark.parametrize("moments", [(1, 0, 0), (0, 1, 0), (2, -1, 3), (R(1, 6), R(1, 2), 1)])
def test_the_impulses_reach_every_target(moments):
    """The impulses (4.9) with the amplitudes (4.10)."""
    target = sp.Matrix(moments)
    assert chebyshev.three_impulses(chebyshev.impulses_for(target)) == target


def test_the_amplitudes_solve_the_transfer_for_either_sign():
    """(4.10) with s0 = 1 and s0 = -1."""
    for s0 in (1, -1):
        at = {a: value.subs(chebyshev.sign, s0) for a, value in chebyshev.amplitudes().items()}
        start = sp.symbols("x_10 x_20 x_30", real=True)
        end = chebyshev.impulse_transfer().subs(chebyshev.sign, s0).subs(at)
        assert end.subs(dict.fromkeys(start, 0)).applyfunc(sp.simplify) == c


@pytest.mark.parametrize("impulses", [(1, -2, 1), (3, -1, R(1, 2)), (-1, R(1, 3), -2)])
def test_on_the_cone_cost_and_bound_agree(impulses):
    """(4.7): where their signs alternate the impulses cost 1/rho0 of (4.1)."""
    moments = chebyshev.three_impulses(impulses)
    spent = sum(abs(a) for a in impulses)
    assert impulse_bound(sp.Matrix([16, -8, 1]), moments, sp.S.One) == spent
    total = chebyshev.total().subs({chebyshev.sign: 1, T: 1, **dict(zip(c, moments, strict=True))})
    assert abs(total) == spent


@pytest.mark.parametrize("impulses", [(1, 2, 1), (3, 1, -R(1, 2))])
def test_off_the_cone_they_cost_more_than_the_bound(impulses):
    moments = chebyshev.three_impulses(impulses)
    assert impulse_bound(sp.Matrix([16, -8, 1]), moments, sp.S.One) < sum(abs(a) for a in impulses)


def test_a_pulse_tends_to_a_kick():
    """In the limit a pulse of (4.8) adds its impulse times the response (1.5)."""
    width, weight = sp.Symbol("e", positive=True), sp.Symbol("a")
    pulse = chebyshev.spike(sp.S.Zero, width, weight).applyfunc(lambda x: sp.limit(x, width, 0))
    assert pulse == sp.Matrix([weight * T**2 / 2, weight * T, weight])


def test_the_polynomial_stays_within_its_end_values():
    assert peak_of(dual_function_of(sp.Matrix([16, -8, 1])), sp.S.One) == 1
