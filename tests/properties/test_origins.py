"""A clock whose zero is far away: `t` is the user's time, what is flown is the time since the start."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from pontryagin.triple_integrator import (
    Maneuver,
    maximum_entropy,
    minimum_energy,
    minimum_impulse,
    minimum_norm,
    minimum_peak,
)
from pontryagin.triple_integrator.attitude import RigidBody, turn
from pontryagin.triple_integrator.coupling import couple
from strategies import maneuvers

BODY = RigidBody([[4.0, 0.3, -0.2], [0.3, 3.0, 0.1], [-0.2, 0.1, 2.0]])
ORIGINS = [0.0, 1e3, 1e6, 1e9, -1e12]
OFFSETS = ("switch_offsets", "impulse_offsets", "breakpoint_offsets")
SHARES = np.array([0.0, 0.1, 0.35, 0.5, 0.8, 0.93, 1.0])


def third(maneuver):
    """The control of least L_3 norm."""
    return minimum_norm(maneuver, 3.0)


SOLVERS = [minimum_energy, minimum_peak, minimum_impulse, third]
every_solver = pytest.mark.parametrize("solve", [*SOLVERS, maximum_entropy])


def one_sign(maneuver):
    """The manoeuvre of the same times whose moments a control of one sign has."""
    T = maneuver.duration[..., None]
    return Maneuver(
        np.zeros(3), np.array([1 / 7, 0.45, 1.0]) * T ** [3.0, 2.0, 1.0], maneuver.tf, maneuver.t0
    )


def size_of(solution, t):
    """The largest modulus of each coordinate of the state at times, (..., 1, 3)."""
    return np.abs(solution.state(t)).max(axis=-2, keepdims=True) + 1e-300


@every_solver
@pytest.mark.parametrize("duration", [1e-3, 0.3, 40.0])
@pytest.mark.parametrize("origin", ORIGINS)
def test_the_state_meets_its_ends_wherever_the_clock_starts(solve, origin, duration):
    scale = duration ** np.array([-2.0, -1.0, 0.0])
    m = Maneuver([0, 0, 0], [1, 0.3, 0.2] * scale, np.nextafter(origin + duration, np.inf), origin)
    solution = solve(one_sign(m) if solve is maximum_entropy else m)
    m = solution.maneuver
    t = np.linspace(m.t0, m.tf, 50)
    first, last = solution.state([m.t0, m.tf])
    assert_allclose(first, m.x0, atol=0)
    assert (np.abs(last - m.xf) <= 1e-12 * size_of(solution, t)[0]).all()


def test_a_millisecond_in_the_year_2001():
    m = Maneuver([0, 0, 0], [1, 0.3, 0.2], 1e9 + 1e-3, 1e9)
    for solve in SOLVERS:
        solution = solve(m)
        size = size_of(solution, np.linspace(m.t0, m.tf, 20))[0]
        assert (np.abs(solution.state(m.tf)[0] - m.xf) <= 1e-12 * size).all()


@every_solver
@given(maneuver=maneuvers(), origin=st.floats(-12, 12), sign=st.sampled_from([-1.0, 1.0]))
def test_answers_do_not_depend_on_the_origin_of_time(solve, maneuver, origin, sign):
    """Those at (t0, tf) are those at (0, tf - t0), and what is flown until t is t - t0."""
    start = sign * 10.0**origin
    m = Maneuver(maneuver.x0, maneuver.xf, start + maneuver.duration, start, maneuver.disturbance)
    if solve is maximum_entropy:
        m = one_sign(m)
    there = solve(m)
    here = solve(Maneuver(m.x0, m.xf, m.tf - m.t0, 0.0, m.disturbance))
    assert_array_equal(there.norm, here.norm)
    for name in OFFSETS:
        if hasattr(here, name):
            assert_array_equal(getattr(there, name), getattr(here, name))
    t = np.clip(m.t0 + m.duration * SHARES, m.t0, m.tf)
    for name in ("control", "state", "costate"):
        expected = getattr(here, name)(t - m.t0)
        finite = np.abs(expected[np.isfinite(expected)])
        allowed = 1e-13 * (1 + finite.max(initial=0.0) * (1 if name == "state" else 100))
        near = np.isclose(
            t[:, None] - m.t0, here.breakpoint_offsets, rtol=0, atol=2 * np.spacing(abs(start) + 9)
        )
        if name == "state" and solve is not minimum_impulse:
            assert_allclose(there.state(t), expected, rtol=1e-13, atol=allowed)
        else:
            apart = ~near.any(axis=1)
            assert_allclose(getattr(there, name)(t)[apart], expected[apart], rtol=1e-12, atol=allowed)


@pytest.mark.parametrize("solve", SOLVERS)
def test_a_stack_may_mix_origins(solve):
    start = np.array(ORIGINS)
    end = np.array([2.0, 1e3 + 0.01, 1e6 + 1e-3, 1e9 + 7, -1e12 + 0.25])
    stack = solve(Maneuver([0.1, 0, 0.3], [1, 0.3, 0.2], end, start, disturbance=0.5))
    last = stack.state(end[:, None])[:, 0]
    t = np.linspace(start, end, 9, axis=-1)
    assert (np.abs(last - [1, 0.3, 0.2]) <= 1e-12 * size_of(stack, t)[:, 0]).all()
    for i in range(len(start)):
        alone = solve(Maneuver([0.1, 0, 0.3], [1, 0.3, 0.2], end[i], start[i], disturbance=0.5))
        assert_array_equal(stack.state(t)[i], alone.state(t[i]))


@pytest.mark.parametrize("origin", ORIGINS)
def test_at_the_time_of_a_switch_or_an_impulse_it_has_happened(origin):
    """Also where the clock cannot tell that time from earlier ones."""
    m = Maneuver([0, 0, 0], [1, 0.37, 0.21], origin + 1.7, origin)
    peak, impulse = minimum_peak(m), minimum_impulse(m)
    signs = peak.first_sign * peak.norm * np.array([-1.0, 1.0])
    assert_array_equal(peak.control(peak.switch_times), signs)
    kicked = impulse.state(impulse.impulse_times)[1:, 2] - impulse.state(impulse.impulse_times)[:-1, 2]
    assert_allclose(kicked[1:], impulse.impulses[2:], rtol=1e-12, atol=1e-12)
    assert np.isinf(impulse.control(impulse.impulse_times)).all()
    assert impulse.impulse_times[-1] == m.tf
    assert_allclose(impulse.impulse_offsets, impulse.impulse_times - origin, atol=np.spacing(abs(origin) + 1))
    assert_allclose(peak.breakpoints, peak.switch_times)


@pytest.mark.slow
@pytest.mark.parametrize("solve", [minimum_peak, minimum_impulse])
@pytest.mark.parametrize("origin", [1e9, -1e12])
def test_a_body_turns_alike_on_every_clock(solve, origin):
    duration = (origin + (2e-3 if origin > 0 else 0.5)) - origin
    here = turn(BODY, [1, 2, 2], solve(Maneuver([0, 0, 0], [1.5, 0, 0], duration)))
    there = turn(BODY, [1, 2, 2], solve(Maneuver([0, 0, 0], [1.5, 0, 0], origin + duration, origin)))
    assert there.attitude_miss < 1e-10
    t = np.linspace(origin, origin + duration, 8)
    assert_allclose(there.attitude(t), here.attitude(t - origin), atol=1e-12)
    assert_allclose(there.torque(t), here.torque(t - origin), rtol=1e-9, atol=1e-9 / duration**2)


@pytest.mark.slow
def test_channels_are_coupled_alike_on_every_clock():
    origin, ends = 1e9, (0.3, -0.2, 0.4)
    duration = (origin + 1e-3) - origin
    here = couple(BODY, [Maneuver([0, 0, 0], [x, 0, 0], duration) for x in ends], minimum_peak)
    there = couple(
        BODY, [Maneuver([0, 0, 0], [x, 0, 0], origin + duration, origin) for x in ends], minimum_peak
    )
    assert_allclose(there.misses, here.misses, atol=1e-12)
    t = np.linspace(origin, origin + duration, 7)
    for name in ("attitude", "rate", "coupling", "state"):
        one, other = getattr(there, name)(t), getattr(here, name)(t - origin)
        assert_allclose(one, other, rtol=1e-9, atol=1e-9 * np.abs(other).max())
    for one, other in zip(there.programmes, here.programmes, strict=True):
        assert_array_equal(one.switch_offsets, other.switch_offsets)
        assert (np.abs(one.state(origin + duration)[0] - one.maneuver.xf) <= 1e-12 * size_of(one, t)[0]).all()


def test_a_disturbance_is_that_of_the_users_clock():
    origin = 1e6
    there = Maneuver([0, 0, 0], [1, 0, 0], origin + 2, origin, disturbance=lambda t: np.cos(3 * (t - origin)))
    here = Maneuver([0, 0, 0], [1, 0, 0], 2.0, disturbance=lambda t: np.cos(3 * t))
    assert_allclose(there.moments, here.moments, rtol=1e-9)
    assert_allclose(minimum_peak(there).state(origin + 2)[0], there.xf, atol=1e-12)
