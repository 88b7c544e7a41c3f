"""The maximum principle of the standard form."""

import pytest
import sympy as sp

from pontryagin.averaging.derivation import principle

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
