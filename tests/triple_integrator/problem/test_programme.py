"""Control, state and costate over time: consistent with each other, with the ends, and across stacks."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from independent import propagate
from pontryagin.triple_integrator import Maneuver, minimum_energy, minimum_impulse, minimum_peak
from pontryagin.triple_integrator.problem.bang_bang import bang_bang, first_sign, switch_offsets
from pontryagin.triple_integrator.problem.programme import truncated_power
from strategies import maneuver_with, maneuvers, stacked

SOLVERS = [minimum_energy, minimum_peak, minimum_impulse]
every_solver = pytest.mark.parametrize("solve", SOLVERS)


@every_solver
@given(maneuver=maneuvers())
def test_the_state_joins_the_ends(solve, maneuver):
    """(0.8) and (0.9)."""
    state = solve(maneuver).state([maneuver.t0, maneuver.tf])
    size = 1 + np.abs(solve(maneuver).state(np.linspace(maneuver.t0, maneuver.tf, 30))).max()
    assert_allclose(state, [maneuver.x0, maneuver.xf], atol=1e-11 * size)


def flown(solution, until):
    """The state at a time by SciPy, and the largest modulus of each coordinate on the way."""
    m, control, kicks = solution.maneuver, lambda t: float(solution.control(t)[0]), []
    if hasattr(solution, "impulses"):
        pairs = zip(solution.impulse_times.tolist(), solution.impulses.tolist(), strict=True)
        control, kicks = lambda t: 0.0, [(t, size) for t, size in pairs if t <= until]
    part = Maneuver(m.x0, m.xf, until, m.t0, m.disturbance)
    return propagate(part, control, [t for t in solution.breakpoints if t < until], kicks)


@every_solver
@given(maneuver=maneuvers())
def test_the_control_steers_the_true_state_to_the_target(solve, maneuver):
    solution = solve(maneuver)
    reached, largest = flown(solution, float(maneuver.tf))
    assert_allclose(reached, maneuver.xf, atol=1e-10 * (1 + largest.max()))
    assert_allclose(solution.state(maneuver.tf)[0], maneuver.xf, atol=1e-10 * (1 + largest.max()))
    assert solution.certificate.holds(1e-12)


@every_solver
@given(maneuver=maneuvers(), share=st.floats(0.05, 0.95))
def test_the_state_on_the_way_is_that_of_scipy(solve, maneuver, share):
    time = float(maneuver.t0 + share * maneuver.duration)
    solution = solve(maneuver)
    reached, largest = flown(solution, time)
    assert_allclose(solution.state(time)[0], reached, atol=1e-10 * (1 + largest.max()))


@every_solver
@pytest.mark.parametrize("exponent", [-290, -170, -160, -100, 100, 160, 170, 290])
@pytest.mark.parametrize("c", [[1.0, -0.25, 0.5], [0.3, -0.8, 0.9], [0.2, 0.6, 0.5], [0.2, 0.5, 1.0]])
def test_tiny_and_huge_moments_scale_exactly(solve, c, exponent):
    size = 2.0**exponent
    unit, scaled = (solve(maneuver_with(np.array(c) * factor)) for factor in (1.0, size))
    assert scaled.norm == unit.norm * size
    assert_allclose(scaled.multipliers * size, unit.multipliers, rtol=1e-14)
    if solve is minimum_peak:
        assert scaled.switch_times.tolist() == unit.switch_times.tolist()
    if solve is minimum_impulse:
        assert scaled.regime == unit.regime
        assert (scaled.impulses == unit.impulses * size).all()


@every_solver
@given(maneuver=maneuvers())
def test_the_costate_solves_the_adjoint_equation(solve, maneuver):
    """(1.15): psi1' = 0, psi2' = -psi1, psi3' = -psi2. (1.16): psi(tf) = l.

    The costate is a quadratic, so that differences are exact.
    """
    solution = solve(maneuver)
    t = np.linspace(maneuver.t0, maneuver.tf, 5)
    psi = solution.costate(t)
    step = np.diff(t)
    size = np.abs(psi).max() + 1
    assert_allclose(np.diff(psi[:, 0]), 0, atol=1e-12 * size)
    assert_allclose(np.diff(psi[:, 1]), -psi[:-1, 0] * step, atol=1e-12 * size)
    assert_allclose(np.diff(psi[:, 2]), -(psi[:-1, 1] + psi[1:, 1]) / 2 * step, atol=1e-12 * size)
    assert_allclose(psi[-1], solution.multipliers, atol=1e-12 * size)


@every_solver
@given(maneuver=maneuvers())
def test_the_minimal_element_has_the_inverse_norm(solve, maneuver):
    """rho0 = 1 / norm in the dual norm, for h0 of (1.12), (1.13) and (1.17).

    The dual norm is L2 for the energy, L1 for the peak, and L-infinity for the impulses.
    """
    solution = solve(maneuver)
    if not maneuver.moments.any():
        return
    t = np.linspace(maneuver.t0, maneuver.tf, 20001)
    h = np.abs(solution.costate(t)[:, 2])
    measured = {
        minimum_energy: np.sqrt(np.trapezoid(h**2, t)),
        minimum_peak: np.trapezoid(h, t),
        minimum_impulse: h.max(),
    }[solve]
    assert_allclose(measured * solution.norm, 1.0, rtol=1e-5)


@every_solver
@given(members=st.lists(maneuvers(), min_size=2, max_size=3))
def test_a_stack_samples_as_its_members_do(solve, members):
    stack = solve(stacked(members))
    shares = np.array([0.0, 0.3, 0.7, 1.0])
    t = np.array([m.t0 + shares * (m.tf - m.t0) for m in members])
    singles = [solve(m) for m in members]
    for name in ("control", "state", "costate"):
        alone = np.array([getattr(s, name)(row) for s, row in zip(singles, t, strict=True)])
        finite = alone[np.isfinite(alone)]
        size = 1 + np.abs(finite).max()
        assert_allclose(getattr(stack, name)(t), alone, rtol=1e-9, atol=1e-9 * size)


@every_solver
@pytest.mark.parametrize("shape", [(), (1,), (2, 3), (0,), (3, 0), (1, 1, 1)])
@pytest.mark.parametrize("count", [0, 1, 4])
def test_shapes(solve, shape, count):
    solution = solve(Maneuver(np.zeros((*shape, 3)), [1.0, 0, 0.5], 2.0, t0=np.zeros(shape)))
    t = np.linspace(0, 2, count)
    assert solution.norm.shape == shape
    assert solution.multipliers.shape == (*shape, 3)
    assert solution.control(t).shape == (*shape, count)
    assert solution.state(t).shape == (*shape, count, 3)
    assert solution.costate(t).shape == (*shape, count, 3)
    assert solution.certificate.gap.shape == shape
    assert solution.certificate.holds(1e-12)


@every_solver
@pytest.mark.parametrize("outside", [-0.1, 2.1, np.nan, np.inf])
@pytest.mark.parametrize("name", ["control", "state", "costate"])
def test_times_outside_the_manoeuvre_are_refused(solve, outside, name):
    solution = solve(Maneuver([0, 0, 0], [1, 0, 0], 2.0))
    with pytest.raises(ValueError, match=r"^t must"):
        getattr(solution, name)([1.0, outside])


def test_a_switch_belongs_to_the_piece_after_it():
    switches, first = np.array([1.0, 2.0]), np.array(3.0)
    since = np.array([0.0, 1.0, 1.5, 2.0])[:, None] - switches
    assert bang_bang(since, first).tolist() == [3, -3, -3, 3]


@given(st.integers(0, 5), st.floats(-2, 2), st.floats(-2, 2))
def test_truncated_powers_are_each_others_integrals(order, time, knot):
    """(t - k)_+^n / n! is zero before k, and grows by (t - k)/n times the power before it."""
    value = truncated_power(np.array(time - knot), order)
    if time < knot:
        assert value == 0
    elif order:
        below = truncated_power(np.array(time - knot), order - 1)
        assert_allclose(value, below * (time - knot) / order, rtol=1e-14, atol=1e-300)
    assert truncated_power(np.array(np.nan), order) == 0


def test_a_piece_that_reaches_an_end_is_no_switch():
    duration = np.array(4.0)
    shares = np.array([[0.75, 0.25], [1.0, 0.5], [0.5, 0.0], [0.0, 0.0], [1.0, 1.0]])
    offsets = switch_offsets(duration, shares)
    assert_allclose(offsets, [[1, 3], [2, np.nan], [2, np.nan], [np.nan] * 2, [np.nan] * 2])
    assert first_sign(np.ones(5), shares).tolist() == [1, -1, 1, 1, 1]


def test_an_error_in_a_stack_tells_which_members_it_is_about():
    far = [1.0, 1e308, 2.0, 1e308]
    ends = np.array([[x, 0.0, 0.0] for x in far]).reshape(2, 2, 3)
    maneuver = Maneuver(np.zeros(3), ends, np.where(ends[..., 0] > 9, 1e-200, 1.0))
    with pytest.raises(ValueError, match=r"at index \[0, 1\]") as error:
        minimum_energy(maneuver)
    assert error.value.argument == "xf" and error.value.members == (1, 3)
