"""The principle in Sapunkov's elements: constants of the motion and the smoothed thrust."""

import pytest
import sympy as sp

from pontryagin.rendezvous.derivation import sapunkov
from pontryagin.rendezvous.derivation import sapunkov_principle as principle


def at_random(expression: sp.Expr):
    """The value of an expression at arbitrary rational values of its symbols, exact."""
    symbols = sorted(expression.free_symbols, key=str)
    return expression.subs({x: sp.Rational(7 + 3 * i * i, 11 + 5 * i) for i, x in enumerate(symbols)})


def test_the_driving_force_is_that_of_the_derived_rates():
    for rates, turn in zip(sapunkov.element_rates(), (-principle.SIN, principle.COS), strict=True):
        difference = (rates.subs(sapunkov.epsilon, 1) - principle.driving() * turn).xreplace(
            {sapunkov.half_anomaly: sp.Rational(1, 2)}
        )
        assert all(sp.expand(at_random(part)) == 0 for part in difference[:2])


@pytest.mark.slow
def test_the_momentum_of_the_turn_is_constant_under_any_thrust():
    assert sp.expand(principle.rate_of(principle.turn_momentum())) == 0


@pytest.mark.slow
def test_the_hamiltonian_and_the_phase_costate_sum_to_a_constant():
    whole = principle.rate_of(principle.hamiltonian() + principle.phase_costate())
    assert sp.expand(at_random(whole)) == 0


def test_the_gradient_of_the_relation_does_not_change_the_thrust():
    relation = sapunkov.bilinear()
    for part in principle.switching_of_the_relation():
        assert sp.denom(sp.cancel(sp.expand(part) / relation)).free_symbols <= {*sapunkov.u}
    turn, gradient = principle.turn_direction(), principle.relation_gradient()
    assert sp.expand(turn.dot(gradient)) == 0
    assert sp.expand(turn.dot(turn) - gradient.dot(gradient)) == 0


@pytest.mark.slow
def test_the_terminal_law_is_that_of_pimkina_and_chelnokov():
    law = principle.switching().dot(sapunkov.force) - principle.running_cost
    assert sp.expand(at_random(principle.terminal_law() - law)) == 0


def test_the_smoothed_throttle_is_a_maximum_and_tends_to_the_jump():
    share, most = principle.smoothed_throttle()
    (S,) = {x for x in share.free_symbols if str(x) == "S"}
    (width,) = share.free_symbols - {S}
    v = sp.Symbol("v", positive=True)
    smooth = S * v - width / 2 * (v * sp.log(v) + (1 - v) * sp.log(1 - v))
    values = {S: sp.Rational(1, 3), width: sp.Rational(1, 5)}
    best = share.subs(values)
    assert abs(sp.N(best - (1 + sp.tanh(S / width).subs(values)) / 2, 20)) < 1e-15
    assert abs(sp.N(smooth.diff(v).subs(values).subs(v, best), 20)) < 1e-15
    assert abs(sp.N((most - smooth.subs(v, share)).subs(values), 20)) < 1e-15
    narrow = most.subs({S: sp.Rational(3, 10), width: sp.Rational(1, 50)})
    assert abs(sp.N(narrow - sp.Rational(3, 10), 15, maxn=300)) < 1e-12
