"""The control of greatest entropy: its moments, its optimality, and the limit of the L_q family."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from independent import integral, moments_of
from pontryagin import Infeasible, NotConverged
from pontryagin.triple_integrator.norms.entropy import maximum_entropy
from pontryagin.triple_integrator.norms.impulse import minimum_impulse
from pontryagin.triple_integrator.norms.norm import minimum_norm
from pontryagin.triple_integrator.problem.maneuver import Maneuver

few = settings(max_examples=15, deadline=None)


@st.composite
def one_signed(draw, narrow=0.05):
    """Manoeuvres inside the moment cone, by mean and second moment of a density on [0, 1], of either sign."""
    mean = draw(st.floats(0.1, 0.9))
    square = mean**2 + draw(st.floats(narrow, 1 - narrow)) * (mean - mean**2)
    total = draw(st.sampled_from([-1, 1])) * draw(st.floats(0.1, 10))
    T, start = draw(st.floats(0.3, 4)), draw(st.floats(-2, 2))
    x0 = np.array(draw(st.tuples(st.floats(-2, 2), st.floats(-2, 2), st.floats(-2, 2))))
    coast = np.array([x0[0] + T * x0[1] + T * T / 2 * x0[2], x0[1] + T * x0[2], x0[2]])
    c = total * np.array([T * T * square / 2, T * mean, 1])
    return Maneuver(x0, coast + c, tf=start + T, t0=start)


@few
@given(one_signed())
def test_the_control_has_the_moments_and_one_sign(m):
    s = maximum_entropy(m)
    tf, T, c = float(m.tf), float(m.duration), m.moments
    assert_allclose(moments_of(s) / [T * T, T, 1] / c[2], c / [T * T, T, 1] / c[2], atol=1e-10)
    assert np.all(s.control(np.linspace(float(m.t0), tf, 20)) * c[2] >= 0)
    assert s.certificate.holds(1e-10)


@pytest.mark.slow
@few
@given(one_signed())
def test_the_true_state_reaches_the_target(m):
    s = maximum_entropy(m)
    scale = np.abs(m.moments[2]) * np.array([1, 1, 1]) * max(1, float(m.duration)) ** 2
    run = solve_ivp(
        lambda t, x: [x[1], x[2], s.control([t])[0]],
        (float(m.t0), float(m.tf)),
        m.x0,
        method="DOP853",
        rtol=1e-12,
        atol=1e-13,
        t_eval=[float(m.t0 + 0.6 * m.duration), float(m.tf)],
        max_step=float(m.duration) / 50,
    )
    assert_allclose((run.y[:, -1] - m.xf) / scale, 0, atol=1e-9)
    assert_allclose((s.state(run.t) - run.y.T) / scale, 0, atol=1e-9)
    assert_allclose((s.state([float(m.tf)])[0] - m.xf) / scale, 0, atol=1e-12)


@few
@given(one_signed())
def test_it_costs_the_least_total_impulse_which_is_not_unique(m):
    s, impulses = maximum_entropy(m), minimum_impulse(m)
    assert_allclose(s.norm, impulses.norm, rtol=1e-10)
    assert not impulses.unique
    assert_allclose(integral(s, lambda _, u: abs(u)), abs(m.moments[2]), rtol=1e-10)
    assert_allclose(s.multipliers @ m.moments, 1)


@few
@given(one_signed())
def test_the_coefficients_are_those_of_the_time_to_go(m):
    s = maximum_entropy(m)
    to_go = np.linspace(0, float(m.duration), 9)
    exponent = np.polynomial.polynomial.polyval(to_go, s.coefficients)
    assert_allclose(
        np.exp(exponent), np.abs(s.control(float(m.tf) - to_go)), rtol=1e-6, atol=1e-9 * abs(s.peak)
    )


@few
@given(one_signed(narrow=0.2), st.sampled_from([1.1, 1.3, 2.0]))
def test_no_other_control_of_one_sign_has_more_entropy(m, q):
    s, other = maximum_entropy(m), minimum_norm(m, q)
    c3, T = float(m.moments[2]), float(m.duration)

    def entropy(_, u):
        share = abs(u / c3) * T
        return -share * np.log(share) / T if share > 0 else 0.0

    assert_allclose(integral(s, entropy), s.entropy, atol=1e-9)
    if other.breakpoints.size == 0:
        assert integral(other, entropy) <= s.entropy + 1e-10


def test_the_entropy_of_a_constant_control_is_the_greatest():
    s = maximum_entropy(Maneuver([0, 0, 0], -3 * np.array([8 / 6, 2, 2]), tf=2.0))
    assert_allclose(s.control([0, 1.3, 2]), -3, rtol=1e-12)
    assert_allclose(s.entropy, 0, atol=1e-14)
    assert maximum_entropy(Maneuver([0, 0, 0], [0.1, 0.4, 1], tf=1.0)).entropy < -1e-3


@pytest.mark.parametrize("c", [(0.2, 0.5, 1), (0.14, 0.5, 1), (-0.1, -0.4, -1), (0.28, 0.7, 1)])
def test_the_least_norm_tends_to_it_at_the_rate_of_q_minus_1(c):
    m = Maneuver([0, 0, 0], c, tf=1.0)
    t = np.linspace(0, 1, 41)
    limit = maximum_entropy(m).control(t)
    excess = np.array([1e-1, 1e-2, 1e-3])
    distance = (
        np.array([np.abs(minimum_norm(m, 1 + e).control(t) - limit).max() for e in excess])
        / np.abs(limit).max()
    )
    assert distance[0] < 0.3
    assert_allclose(distance[2] / excess[2], distance[1] / excess[1], rtol=0.1)


@few
@given(one_signed(), st.floats(-4, 4), st.floats(-2, 2))
def test_units_do_not_matter(m, amplitude, clock):
    a, T = 10.0**amplitude, 10.0**clock
    by_clock = a / T ** np.array([0.0, 1.0, 2.0])
    scaled = Maneuver(m.x0 * by_clock, m.xf * by_clock, T * m.tf, T * m.t0)
    t = np.linspace(float(m.t0), float(m.tf), 7)
    plain = maximum_entropy(m)
    assert_allclose(
        maximum_entropy(scaled).control(T * t) * T**3 / a,
        plain.control(t),
        rtol=1e-6,
        atol=1e-8 * abs(plain.peak),
    )


@pytest.mark.slow
def test_narrow_and_flat_densities():
    """The moments are next to those of one impulse inside, and of two impulses at the ends."""
    for square in (0.25 + 1e-8, 0.5 - 1e-2):
        m = Maneuver([0, 0, 0], [square / 2, 0.5, 1], tf=1.0)
        s = maximum_entropy(m)
        assert s.certificate.holds(1e-10)
        assert_allclose(s.state([0.0, 1.0]), [m.x0, m.xf], atol=1e-11)
    with pytest.raises(NotConverged):
        maximum_entropy(Maneuver([0, 0, 0], [(0.3 - 1e-9) / 2, 0.3, 1], tf=1.0))


def test_a_stack_with_nothing_to_do():
    m = Maneuver([0, 0, 0], [[[0.2, 0.5, 1]], [[0, 0, 0]]], tf=1.0)
    s = maximum_entropy(m)
    t = np.array([0.0, 0.3, 1.0])
    assert s.control(t).shape == (2, 1, 3) and s.state(t).shape == s.costate(t).shape == (2, 1, 3, 3)
    assert np.all(s.control(t)[1] == 0) and s.norm[1, 0] == 0 and s.entropy[1, 0] == 0
    assert s.coefficients[1, 0, 0] == -np.inf
    one = maximum_entropy(Maneuver([0, 0, 0], [0.2, 0.5, 1], tf=1.0))
    assert_allclose(s.control(t)[0, 0], one.control(t), rtol=1e-12)
    assert_allclose(one.costate(t), np.broadcast_to(one.multipliers, (3, 3)))
    assert one.breakpoints.shape == (0,)


@pytest.mark.parametrize(
    ("c", "reason"),
    [
        ((1, 0, 0), "c3 = 0 although c is not 0"),
        ((0.1, 0.5, 1), "2 c1 c3 - c2^2 is not positive"),
        ((0.125, 0.5, 1), "2 c1 c3 - c2^2 is not positive"),
        ((0.3, 0.5, 1), "c3 (T c2 - 2 c1) is not positive"),
        ((0.25, 0.5, 1), "c3 (T c2 - 2 c1) is not positive"),
        ((0.2, -0.5, 1), "c3 (T c2 - 2 c1) is not positive"),
    ],
)
def test_outside_the_cone_and_on_its_boundary_there_is_none(c, reason):
    with pytest.raises(Infeasible) as raised:
        maximum_entropy(Maneuver([0, 0, 0], c, tf=1.0))
    assert str(raised.value).endswith(reason) and raised.value.argument == "maneuver"
    assert minimum_impulse(Maneuver([0, 0, 0], c, tf=1.0)).unique


def test_the_member_of_a_stack_is_named():
    with pytest.raises(Infeasible, match=r"got c = \[1.0, 0.0, 0.0\] \(manoeuvre 1 of the stack\)"):
        maximum_entropy(Maneuver([0, 0, 0], [[0.2, 0.5, 1], [1, 0, 0]], tf=1.0))


@given(one_signed(narrow=0.2))
def test_the_peak_is_the_control_of_largest_modulus(m):
    """The exponent is taken relative to it; the control is read on a grid, near enough to its peak."""
    s = maximum_entropy(m)
    control = s.control(m.t0 + m.duration * np.linspace(0.0, 1.0, 2001))
    assert_allclose(control[np.argmax(np.abs(control))], s.peak, rtol=1e-3)
