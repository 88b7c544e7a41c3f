"""Least L_q norm: moments, motion and bounds by independent methods, closed forms, limits and symmetries."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.integrate import quad

from independent import integral, moments_of, pieces, propagate
from pontryagin import NotConverged
from pontryagin.triple_integrator.norms.energy import minimum_energy
from pontryagin.triple_integrator.norms.impulse import minimum_impulse
from pontryagin.triple_integrator.norms.minimal_element import solve_norm
from pontryagin.triple_integrator.norms.norm import dual_bound, minimum_norm
from pontryagin.triple_integrator.norms.peak import minimum_peak
from pontryagin.triple_integrator.norms.power_rules import table
from pontryagin.triple_integrator.norms.quadratic_programme import certify
from pontryagin.triple_integrator.norms.quadrature import (
    Quadratic,
    graded_rule,
    logistic_rule,
    moments_beyond,
)
from pontryagin.triple_integrator.problem.maneuver import Maneuver
from strategies import maneuvers, multipliers

few = settings(max_examples=8, deadline=None)
REST_TO_REST = Maneuver([0, 0, 0], [1, 0, 0], tf=1.0)

exponents = st.sampled_from([1.02, 1.1, 1.3, 1.7, 2.0, 2.5, 4.0, 9.0, 40.0, 100.0])
moving = maneuvers().filter(lambda m: np.abs(m.moments).max() > 1e-3)


def moment_scale(m):
    scale = m.duration ** np.array([3, 2, 1]) / [6, 2, 1]
    return scale * np.abs(m.moments / scale).max()


def assert_same_control(found, expected, q):
    """Controls are equal; for q > 2 their powers q - 1, since u is steep as a root where it changes sign."""
    power = max(q - 1, 1)
    size = np.abs(expected).max()
    by_power = [np.sign(u) * np.abs(u / size) ** power for u in (found, expected)]
    assert_allclose(*by_power, atol=1e-7)


@pytest.mark.slow
@few
@given(moving, exponents)
def test_the_control_has_the_required_moments(m, q):
    """The moment equalities (1.11)."""
    found = moments_of(minimum_norm(m, q))
    assert_allclose(found / moment_scale(m), m.moments / moment_scale(m), atol=2e-9)


@pytest.mark.slow
@few
@given(moving, st.sampled_from([1.1, 1.5, 2.0, 3.0, 4.0]))
def test_the_control_steers_the_true_state_to_the_target(m, q):
    s = minimum_norm(m, q)
    reached, _ = propagate(m, lambda t: s.control([t])[0], s.breakpoints)
    assert_allclose((reached - m.xf) / moment_scale(m), 0, atol=1e-9)


@pytest.mark.slow
@settings(max_examples=4, deadline=None)
@given(moving, exponents)
def test_the_state_reaches_the_target_and_follows_the_equations(m, q):
    s = minimum_norm(m, q)
    t = np.linspace(float(m.t0), float(m.tf), 9)
    x = s.state(t)
    assert_allclose(x[0], m.x0, atol=1e-13)
    assert_allclose((x[-1] - m.xf) / moment_scale(m), 0, atol=1e-10)
    force = float(m.disturbance or 0)
    for a, b in pieces(s):
        third, _ = quad(lambda t: s.control([t])[0], a, b, epsabs=1e-13, epsrel=1e-12, limit=400)
        second, _ = quad(lambda t: s.state([t])[0, 2] + force, a, b, limit=50)
        first, _ = quad(lambda t: s.state([t])[0, 1], a, b, limit=50)
        change = np.diff(s.state([a, b]), axis=0)[0]
        assert_allclose((change - [first, second, third]) / moment_scale(m), 0, atol=1e-8)


@few
@given(moving, exponents)
def test_the_norm_is_that_of_the_control_and_is_certified(m, q):
    s = minimum_norm(m, q)
    by_quadrature = s.peak * integral(s, lambda t, u: abs(u / s.peak) ** q) ** (1 / q)
    assert_allclose(s.norm, by_quadrature, rtol=1e-9)
    assert s.certificate.primal_residual <= 1e-12 and abs(s.certificate.gap) <= 1e-12
    assert_allclose(s.multipliers @ m.moments, 1, rtol=1e-10)


@few
@given(moving, exponents, multipliers)
def test_no_multipliers_give_a_bound_above_the_norm(m, q, l):
    s = minimum_norm(m, q)
    assert dual_bound(m, q, l) <= s.norm * (1 + 1e-12)
    assert_allclose(dual_bound(m, q, s.multipliers), s.norm, rtol=1e-12)


def test_the_bound_is_the_pairing_over_the_conjugate_norm():
    m, q, l = Maneuver([0, 1, -1], [2, 0, 1], tf=2.0, t0=0.5), 3.0, np.array([1.0, -2.0, 0.4])
    power, _ = quad(lambda s: abs(l @ [s * s / 2, s, 1]) ** 1.5, 0, 1.5, points=[0.215, 1.5], limit=200)
    assert_allclose(dual_bound(m, q, l), l @ m.moments / power ** (2 / 3), rtol=1e-8)


@few
@given(moving, exponents)
def test_hoelders_inequality_is_an_equality(m, q):
    """(1.14): |u|^q is proportional to |psi_3|^p, and u has the sign of psi_3."""
    s = minimum_norm(m, q)
    t = np.linspace(float(m.t0), float(m.tf), 23)
    u, h = s.control(t) / s.peak, s.costate(t)[:, 2]
    h = h * s.norm * float(m.duration) ** (1 - 1 / q)
    assert np.all(u * h >= -1e-12)
    inner = np.abs(h) > 1e-6
    ratio = np.abs(h[inner]) / np.abs(u[inner]) ** (q - 1)
    assert_allclose(ratio, ratio[0], rtol=1e-6)


@few
@given(moving)
def test_q_two_is_the_least_energy(m):
    s, energy = minimum_norm(m, 2), minimum_energy(m)
    t = np.linspace(float(m.t0), float(m.tf), 7)
    assert_allclose(s.norm, energy.norm, rtol=1e-12)
    assert_allclose(s.control(t), energy.control(t), atol=1e-11 * s.peak)
    assert_allclose(s.costate(t), energy.costate(t), rtol=1e-9, atol=1e-9 * np.abs(s.multipliers).max())


@pytest.mark.slow
@few
@given(moving)
def test_the_power_mean_grows_with_q_between_both_ends(m):
    T = float(m.duration)
    means = [float(minimum_impulse(m).norm) / T]
    means += [float(minimum_norm(m, q).norm) / T ** (1 / q) for q in (1.01, 1.2, 2.0, 6.0, 50.0, 1000.0)]
    means += [float(minimum_peak(m).norm)]
    assert np.all(np.diff(means) >= -1e-11 * means[-1])


@pytest.mark.parametrize("xf", [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, -2, 0.5), (-0.3, 0.1, 1)])
def test_both_ends_are_approached(xf):
    m = Maneuver([0, 0, 0], xf, tf=1.0)
    impulse, peak = float(minimum_impulse(m).norm), float(minimum_peak(m).norm)
    low = [minimum_norm(m, 1 + e).norm / impulse - 1 for e in (1e-1, 1e-2, 1e-3)]
    high = [1 - minimum_norm(m, e).norm / peak for e in (1e1, 1e2, 1e3)]
    for distance in (low, high):
        assert np.all(np.diff(distance) < 0) and distance[-1] >= -1e-12 and distance[-1] < 0.02


def test_the_limit_of_large_q_switches_where_the_least_peak_does():
    m = Maneuver([0, 0, 0], [1, -2, 0.5], tf=1.0)
    times = minimum_peak(m).switch_times
    distances = [np.abs(minimum_norm(m, q).breakpoints - times).max() for q in (1e2, 1e3, 1e4)]
    assert_allclose(np.array(distances[:-1]) / distances[1:], 10, rtol=0.1)


@few
@given(moving, exponents, st.floats(-6, 6), st.floats(-3, 3), st.sampled_from([-1.0, 1.0]))
def test_units_and_sign_do_not_matter(m, q, amplitude, clock, sign):
    a, T = sign * 10.0**amplitude, 10.0**clock
    by_clock = a / T ** np.array([0.0, 1.0, 2.0])
    scaled = Maneuver(
        m.x0 * by_clock, m.xf * by_clock, T * m.tf, T * m.t0, float(m.disturbance or 0) * by_clock[2]
    )
    plain, other = minimum_norm(m, q), minimum_norm(scaled, q)
    t = np.linspace(float(m.t0), float(m.tf), 5)
    control = a / T**3
    assert_allclose(other.norm, abs(control) * T ** (1 / q) * plain.norm, rtol=1e-9)
    assert_same_control(other.control(T * t) / control, plain.control(t), q)


@few
@given(moving, exponents)
def test_reversal_of_time(m, q):
    """In reversed time x2 and u change sign; the norm does not."""
    mirror = np.array([1.0, -1.0, 1.0])
    back = Maneuver(m.xf * mirror, m.x0 * mirror, m.tf, m.t0, m.disturbance)
    forth_, back_ = minimum_norm(m, q), minimum_norm(back, q)
    t = np.linspace(float(m.t0), float(m.tf), 5)
    assert_allclose(back_.norm, forth_.norm, rtol=1e-10)
    assert_same_control(back_.control(t)[::-1], -forth_.control(t), q)


def test_a_constant_control_is_best_for_every_q():
    m = Maneuver([0, 0, 0], np.array([8 / 6, 2, 2]) * 3, tf=2.0)
    for q in (1.01, 1.5, 3, 100):
        assert_allclose(minimum_norm(m, q).control([0.0, 0.7, 2.0]), 3, rtol=1e-10)


@pytest.mark.parametrize("q", [1.1, 3.0, 100.0, 1000.0])
@pytest.mark.parametrize("width", [1e-2, 1e-4, 1e-6])
@pytest.mark.parametrize("sign", [1, -1])
def test_nearly_double_zeros(q, width, sign):
    """The moments of |h|^(p-1) sign h give h again, whose zeros are 2 `width` apart, real or complex."""
    h = Quadratic(np.array([0.36 - sign * width**2, -1.2, 1.0]), np.asarray(4 * sign * width**2))
    s, values, weights = h.sample(graded_rule())
    u = np.sign(values) * np.abs(values) ** (1 / (q - 1)) * weights
    m = Maneuver([0, 0, 0], [(u * s * s / 2).sum(), (u * s).sum(), u.sum()], tf=1.0)
    solution = minimum_norm(m, q)
    assert solution.certificate.holds(1e-12)
    assert_allclose(
        1 - solution.breakpoints, [0.6 + width, 0.6 - width] if sign > 0 else [], atol=1e-2 * width
    )


@pytest.mark.parametrize("k", [k for k in itertools.product((-1, 0, 1), repeat=3) if any(k)])
@pytest.mark.parametrize("q", [1.001, 1.01, 2.5, 100.0, 1e5])
def test_special_directions(k, q):
    m = Maneuver([0, 0, 0], np.array(k) / np.array([6.0, 2.0, 1.0]), tf=1.0)
    s = minimum_norm(m, q)
    assert s.certificate.holds(1e-12 if q > 1.005 else 1e-11)
    assert_allclose(s.state([1.0])[0], m.xf, atol=1e-10)


def test_a_stack_is_its_members():
    rng = np.random.default_rng(3)
    m = Maneuver(
        rng.normal(size=(2, 1, 3)), rng.normal(size=(3, 3)), tf=[1.0, 2.0, 0.5], t0=0.1, disturbance=np.sin
    )
    s = minimum_norm(m, 3.3)
    t = m.t0[..., None] + m.duration[..., None] * np.array([0.0, 0.4, 1.0])
    control, state, costate = s.control(t), s.state(t), s.costate(t)
    assert control.shape == (2, 3, 3) and state.shape == costate.shape == (2, 3, 3, 3)
    for i in np.ndindex(2, 3):
        one = minimum_norm(Maneuver(m.x0[i], m.xf[i], m.tf[i], m.t0[i], disturbance=np.sin), 3.3)
        assert_allclose(s.norm[i], one.norm, rtol=1e-13)
        assert_allclose(control[i], one.control(t[i]), rtol=1e-9)
        assert_allclose(state[i], one.state(t[i]), atol=1e-11)
        assert_allclose(costate[i], one.costate(t[i]), rtol=1e-9)


@pytest.mark.parametrize("q", [1.02, 1.3, 2.0, 3.3, 30.0, 1000.0])
def test_a_stack_of_mixed_scales_is_its_members_and_its_plain_source(q):
    rng = np.random.default_rng(11)
    T = 10.0 ** rng.uniform(-3, 3, 40)
    k = rng.normal(size=(40, 3)) * 10.0 ** rng.uniform(-6, 6, (40, 1))
    m = Maneuver(np.zeros(3), k * np.stack([T**3 / 6, T**2 / 2, T], axis=-1), T)
    s = minimum_norm(m, q)
    ones = [minimum_norm(Maneuver(m.x0[i], m.xf[i], T[i]), q) for i in range(40)]
    for name in ("norm", "peak", "multipliers"):
        assert_allclose(getattr(s, name), [getattr(one, name) for one in ones], rtol=1e-12)
    rules = np.frombuffer(table(q)).tolist()
    plain = [solve_norm(*c, T, rules)[6] for c, T in zip(m.moments.tolist(), T.tolist(), strict=True)]
    assert_allclose(s.norm, plain, rtol=1e-12)


@pytest.mark.parametrize("q", [1.001, 1.02, 1.3, 3.3, 30.0, 1e5])
def test_the_certificate_is_that_of_an_independent_rule(q):
    """Norm, residual and bound from nodes and panels that the kernel does not have."""
    rng = np.random.default_rng(12)
    m = Maneuver(rng.normal(size=(60, 3)), rng.normal(size=(60, 3)), 10.0 ** rng.uniform(-1, 1, 60))
    s = minimum_norm(m, q)
    bound = dual_bound(m, q, s.multipliers)
    again = certify(m, s.shape, s.peak, s._law[1], q, bound)
    assert_allclose(s.certificate.primal_value, again.primal_value, rtol=1e-11)
    assert_allclose(s.certificate.dual_value, bound, rtol=1e-11)
    assert np.max(again.primal_residual) <= 1e-11 and np.abs(again.gap).max() <= 1e-11


def test_nothing_to_do_needs_no_control():
    m = Maneuver([[0, 1, 2], [0, 0, 0]], [[2, 3, 2], [1, 0, 0]], tf=1.0)
    s = minimum_norm(m, 1.4)
    assert s.norm[0] == 0 and np.all(s.control([0.0, 0.5, 1.0])[0] == 0) and np.all(s.multipliers[0] == 0)
    assert s.norm[1] > 0 and s.certificate.holds(1e-12)
    assert_allclose(s.state([1.0])[0, 0], [2, 3, 2], rtol=1e-14)
    assert minimum_norm(Maneuver([0, 0, 0], [0, 0, 0], tf=1.0), 7.0).breakpoints.size == 0


@pytest.mark.parametrize(
    ("q", "error", "says"),
    [
        (1, ValueError, "1 < q < inf, got 1; q = 1 is minimum_impulse"),
        (np.inf, ValueError, "got inf; q = inf is minimum_peak"),
        (0.5, ValueError, "q must be a number, 1 < q < inf, got 0.5"),
        (-3, ValueError, "got -3"),
        (float("nan"), ValueError, "got nan"),
        ("2", TypeError, "q must be a number"),
        ([2.0, 3.0], TypeError, "q must be a number"),
        (2 + 0j, TypeError, "q must be a number"),
        (True, TypeError, "q must be a number"),
    ],
)
def test_a_wrong_exponent_is_named(q, error, says):
    with pytest.raises(error) as raised:
        minimum_norm(REST_TO_REST, q)
    assert says in str(raised.value)


def test_what_does_not_converge_is_not_handed_out():
    with pytest.raises(NotConverged) as raised:
        minimum_norm(REST_TO_REST, 1 + 1e-12)
    assert raised.value.residual > 1e-10 and "q = 1.000000000001" in str(raised.value)


@pytest.mark.parametrize("rule", [logistic_rule, graded_rule])
@pytest.mark.parametrize("power", [0.001, 0.3, 1.0, 2.5, 30.0, 300.0])
def test_both_rules_integrate_powers_next_to_zeros_and_peaks(rule, power):
    """Integrals of |s - a|^power and |s - a|^(2 power) in closed form."""
    a = np.array([-1e-9, 0.0, 1e-12, 1e-3, 0.37, 1 - 1e-6, 1.0, 1.5])

    def distance(n):
        return (np.sign(a) * np.abs(a) ** (n + 1) + np.sign(1 - a) * np.abs(1 - a) ** (n + 1)) / (n + 1)

    linear = np.stack([-a, np.ones_like(a), np.zeros_like(a)], axis=-1)
    double = np.stack([a * a, -2 * a, np.ones_like(a)], axis=-1)
    for h, exact in (
        (Quadratic.of(linear), distance(power)),
        (Quadratic(double, np.zeros_like(a)), distance(2 * power)),
    ):
        _, values, weights = h.sample(rule())
        assert_allclose((np.abs(values) ** power * weights).sum(axis=(-2, -1)), exact, rtol=4e-13)


def test_a_quadratic_is_continued_from_its_pieces():
    rng = np.random.default_rng(0)
    coefficients = rng.normal(size=(50, 3))
    s = np.append(rng.random(20), [0.0, 1.0])
    assert_allclose(
        Quadratic.of(coefficients)(np.broadcast_to(s, (50, 22))),
        np.polynomial.polynomial.polyval(s, coefficients.T),
        atol=1e-14,
    )


def test_integrals_of_powers_of_a_polynomial_over_part_of_the_interval():
    """With function(h) = h both sides are polynomials."""
    rng = np.random.default_rng(1)
    coefficients = rng.normal(size=(20, 3))
    s = np.append(rng.random(6), [0.0, 1.0])
    found = moments_beyond(Quadratic.of(coefficients), np.broadcast_to(s, (20, 8)), lambda _, h: h, block=7)
    for i, h in enumerate(coefficients):
        primitives = [np.polynomial.Polynomial(h).integ(j, lbnd=1) for j in (3, 2, 1)]
        exact = np.stack([(-1) ** j * p(s) for j, p in zip((3, 2, 1), primitives, strict=True)], axis=-1)
        assert_allclose(found[i], exact, atol=1e-14)


@pytest.mark.parametrize("times", [[0.5], []])
def test_an_empty_stack_has_empty_states(times):
    solution = minimum_norm(Maneuver(np.zeros((0, 3)), np.zeros((0, 3)), 1.0), 3.0)
    assert solution.state(times).shape == (0, len(times), 3)
    assert solution.control(times).shape == (0, len(times))


@pytest.mark.parametrize("q", [1.5, 3.0, 4.0, 10.0, 100.0, 1e4])
@pytest.mark.parametrize("at_end", [True, False])
def test_a_double_zero_at_either_end(q, at_end):
    """h = s^2 or (1 - s)^2: the control is a power of the time to go or since the start, and known."""
    a = 2 / (q - 1)
    first = 1 / (a + 2) if at_end else 1 / (a + 1) / (a + 2)
    second = 1 / (a + 3) if at_end else 2 / (a + 1) / (a + 2) / (a + 3)
    solution = minimum_norm(Maneuver(np.zeros(3), [second / 2, first, 1 / (a + 1)], 1.0), q)
    assert_allclose(solution.norm, (1 / (a * q + 1)) ** (1 / q), rtol=1e-12)
    assert solution.certificate.holds(1e-11)


def test_reversals_as_narrow_as_one_over_q():
    flips = [
        [0.1666568814886584, 0.49992528275361203, 0.9997147386056217],
        [-0.1666625016938592, -0.4999606491380296, -0.9998141055855253],
        [0.16658401479119486, 0.4997908043095213, 0.9997352580521166],
        [0.1666009517172364, 0.4998316641076139, 0.9997843947765604],
    ]
    solution = minimum_norm(Maneuver(np.zeros(3), flips, 1.0), 1e4)
    assert solution.certificate.holds(1e-12)
    assert (solution.norm <= minimum_peak(solution.maneuver).norm * (1 + 1e-12)).all()
