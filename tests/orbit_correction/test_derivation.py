"""The derivation against conserved quantities, SciPy's matrix exponential and impulses applied one by one."""

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from pontryagin.orbit_correction import derivation
from pontryagin.orbit_correction.derivation import interval, r, summands, v_radial, v_transverse

LINEAR = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 2.0], [0.0, -1.0, 0.0]])
INTERVALS = (sp.Rational(1, 4), sp.Integer(1), sp.pi / 2, sp.Integer(4))


def numbers(matrix, at=None):
    """A SymPy matrix as numbers, with a value for the interval."""
    return np.array(
        sp.Matrix(matrix).subs({} if at is None else {interval: at}).evalf().tolist(), dtype=float
    )


def test_energy_and_angular_momentum_are_conserved():
    rates = derivation.equations_of_motion()
    state = sp.Matrix([r, v_radial, v_transverse])
    for conserved in (r * v_transverse, (v_radial**2 + v_transverse**2) / 2 - 1 / r):
        assert sp.simplify((sp.Matrix([conserved]).jacobian(state) * rates)[0]) == 0
    assert derivation.angular_rate() == v_transverse / r


def test_the_linearised_flow_is_the_tangent_of_the_true_flow():
    rates = sp.lambdify([r, v_radial, v_transverse], list(derivation.equations_of_motion()), "math")
    circle, span, small = np.array([1.0, 0.0, 1.0]), 1.3, 1e-5
    columns = []
    for direction in np.eye(3):
        ends = [
            solve_ivp(
                lambda _, x: rates(*x), (0, span), circle + sign * small * direction, rtol=1e-12, atol=1e-13
            ).y[:, -1]
            for sign in (1, -1)
        ]
        columns.append((ends[0] - ends[1]) / (2 * small))
    assert_allclose(np.column_stack(columns), numbers(derivation.transition(sp.Float(span))), atol=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("time", [0, 0.25, 1.7, np.pi, -3.0, 7.5])
def test_the_transition_is_the_matrix_exponential(time):
    assert_allclose(numbers(derivation.linearised()), LINEAR)
    assert_allclose(numbers(derivation.transition(sp.Float(time))), expm(LINEAR * time), atol=1e-12)


@given(
    st.tuples(*[st.floats(-1, 1)] * 3).map(np.array),
    st.lists(st.tuples(*[st.floats(-1, 1)] * 2), min_size=6, max_size=6).map(np.array),
    st.sampled_from(INTERVALS),
)
def test_steps_are_impulses_flown_one_by_one(state, impulses, at):
    regrouped, flown, once = state, [state], expm(LINEAR * float(at))
    for impulse in impulses:
        flown.append(once @ (flown[-1] + np.array([0.0, *impulse])))
    for k in range(4):
        control = [impulses[j, component] for j, component in derivation.schedule(k)]
        step = numbers(derivation.step_matrix(k), at) @ regrouped
        regrouped = step + numbers(derivation.step_inputs(k), at) @ control
        if k % 2 == 1:
            assert_allclose(regrouped, flown[3 * (k + 1) // 2], atol=1e-12)


@pytest.mark.parametrize("at", INTERVALS)
def test_factors_are_inputs_carried_back_to_the_start(at):
    back = np.eye(3)
    for k in range(4):
        back = back @ np.linalg.inv(numbers(derivation.step_matrix(k), at))
        assert_allclose(
            numbers(derivation.factor_columns(k), at),
            back @ numbers(derivation.step_inputs(k), at),
            atol=1e-12,
        )


def test_determinants_of_the_inputs():
    even, odd = (sp.simplify(derivation.step_inputs(k).det()) for k in range(2))
    assert sp.simplify(even + sp.sin(interval)) == 0
    assert sp.simplify(odd - 2 * (1 - sp.cos(interval))) == 0


def matrices(seed, n, steps):
    """Random numbers for the symbols of `summands`: A_k, its transpose, H_k and u_k."""
    generator = np.random.default_rng(seed)
    known = {}
    for k in range(steps):
        A, L = generator.normal(size=(2, n, n)) + 2 * np.eye(n)
        known |= {summands.A(k): A, summands.A_transposed(k): A.T, summands.H(k): L @ L.T}
        known[summands.u(k)] = generator.normal(size=(n, 1))
    return known


def evaluated(expression, known):
    """The value of a noncommutative expression, given those of its symbols."""
    if expression in known:
        return known[expression]
    if expression.is_Number:
        return float(expression)
    parts = [evaluated(part, known) for part in expression.args]
    if expression.is_Add:
        return sum(parts[1:], parts[0])
    if expression.is_Pow:
        return np.linalg.matrix_power(parts[0], int(expression.args[1]))
    product = parts[0]
    for part in parts[1:]:
        product = product * part if np.ndim(product) == 0 or np.ndim(part) == 0 else product @ part
    return product


@given(st.integers(0, 1000), st.integers(2, 6), st.integers(1, 4))
def test_the_algebra_of_lemma_1_in_numbers(seed, n, steps):
    """Lemma 1 and the system (1), derived with symbols, for random matrices."""
    known = matrices(seed, n, steps)
    state = evaluated(summands.state_brought_to_zero(steps), known)
    assert_allclose(evaluated(summands.final_state(steps), known | {summands.x: state}), 0, atol=1e-9)
    for k in range(steps):
        state = known[summands.A(k)] @ state + known[summands.u(k)]
    assert_allclose(state, 0, atol=1e-9)


@given(st.integers(0, 1000), st.integers(2, 6), st.integers(1, 4))
def test_costates_and_carried_ellipsoids_in_numbers(seed, n, steps):
    """The costates of Theorem 2 and the ellipsoids of Lemma 8, derived with symbols, for random matrices."""
    known = matrices(seed, n, steps)
    free, costate = np.eye(n), np.ones((n, 1))
    for k in range(steps):
        free = known[summands.A(k)] @ free
    carried = evaluated(summands.adjoint(steps), known) @ costate
    x = np.arange(1.0, n + 1)[:, None]
    assert_allclose(carried.T @ (free @ x), costate.T @ x, rtol=1e-9)
    shape = evaluated(summands.carried_back(steps), known)
    assert_allclose(x.T @ shape @ x, (free @ x).T @ known[summands.H(steps - 1)] @ (free @ x), rtol=1e-9)
