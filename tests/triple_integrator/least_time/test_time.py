"""Least time: the state arrives, and not earlier, by exact roots, Sturm's count and dense scans."""

import itertools

import mpmath as mp
import numpy as np
import pytest
import sympy as sp
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from independent import exact_bang_bang_times, propagate
from pontryagin.triple_integrator import Maneuver, minimum_peak, minimum_time
from pontryagin.triple_integrator.least_time.quartic import sign_changes, stationary_points
from strategies import angles, places, signs, states, wide

peaks = st.floats(0.2, 5.0)
transfers = st.tuples(states(), states()).filter(lambda ends: np.abs(ends[1] - ends[0]).max() > 1e-3)
THREE_TIMES = ([0.5, 1.0, 0.0], [1.5, 1.5, -2.0])
CROSSED = 14.0


def flown(start, level, durations):
    """State after three pieces of the control, level, -level, level."""
    x = np.array(start, dtype=float)
    for u, tau in zip((level, -level, level), durations, strict=True):
        x = np.array(
            [
                x[0] + x[1] * tau + x[2] * tau**2 / 2 + u * tau**3 / 6,
                x[1] + x[2] * tau + u * tau**2 / 2,
                x[2] + u * tau,
            ]
        )
    return x


def least_exact(x0, xf, peak, force=0.0):
    """The least exact candidate with switches within [0, T], up to 1e-15."""
    return float(min(T for violation, T in exact_bang_bang_times(x0, xf, peak, force) if violation <= 1e-15))


def fixed_time_peaks(x0, xf, durations, force=0.0):
    """The least peaks u0(T) for given durations."""
    return minimum_peak(Maneuver(x0, xf, durations, disturbance=np.full(np.shape(durations), force))).norm


@given(states(), states(), peaks, angles)
def test_the_control_steers_the_true_state_to_the_target(x0, xf, peak, force):
    assume(np.abs(xf - x0).max() > 1e-6)
    solution = minimum_time(x0, xf, peak, disturbance=force)
    maneuver = solution.maneuver
    reached, largest = propagate(
        maneuver, lambda t: float(solution.control(t)[0]), breakpoints=solution.breakpoints
    )
    assert_allclose(reached, xf, atol=1e-10 * (1 + largest.max()))
    assert_allclose(solution.state(solution.duration)[0], xf, atol=1e-10 * (1 + largest.max()))
    assert np.abs(solution.control(np.linspace(0, solution.duration, 50))).max() <= peak


@given(transfers, peaks, angles)
def test_it_is_the_least_admissible_root_in_exact_arithmetic(ends, peak, force):
    found = float(minimum_time(*ends, peak, force).duration)
    assert_allclose(found, least_exact(*ends, peak, force), rtol=1e-11)


@given(states(wide()), states(wide()), st.floats(-3, 3))
def test_the_same_over_six_decades(x0, xf, decade):
    assume((xf != x0).any())
    peak = 10.0**decade
    assert_allclose(float(minimum_time(x0, xf, peak).duration), least_exact(x0, xf, peak), rtol=1e-10)


@settings(max_examples=8)
@given(
    *[st.integers(-3, 3).map(sp.Integer) for _ in range(6)],
)
def test_no_earlier_admissible_root_by_sturm(x10, x20, x30, x1f, x2f, x3f):
    """Each real root of both quartics below the answer, by an exact count, has a switch outside [0, T]."""
    assume((x10, x20, x30) != (x1f, x2f, x3f))
    T = sp.Symbol("T", positive=True)
    found = sp.Rational(float(minimum_time([x10, x20, x30], [x1f, x2f, x3f], 1.0).duration))
    c3 = x3f - x30
    for v in (1, -1):
        p1 = v * T**3 + 3 * x30 * T**2 + 6 * x20 * T - 6 * (x1f - x10)
        p2 = v * T**2 + 2 * x30 * T - 2 * (x2f - x20)
        p3 = v * T - c3
        quartic = sp.Poly(16 * p1 * p3 - 12 * p2**2 - p3**4, T)
        count = quartic.count_roots(0, found * (1 - sp.Rational(1, 10**9)))
        earlier = [
            root for root in sp.Poly(quartic, T).nroots(n=40, maxsteps=500) if abs(sp.im(root)) < 1e-15
        ]
        earlier = [r for r in earlier if -1e-30 <= sp.re(r) < found * (1 - sp.Rational(1, 10**9))]
        assert len({sp.N(r, 12) for r in earlier}) == count
        for root in map(sp.re, earlier):
            gap = p3.subs(T, root)
            if abs(gap) < 1e-25 or root <= 0:
                continue
            d, m = gap / (2 * v * root), (v * root**2 - 2 * (x2f - x20 - x30 * root)) / (root * gap)
            assert min((m - d) / 2, 1 - (m + d) / 2, d) < 1e-12


@pytest.mark.slow
@settings(max_examples=15)
@given(transfers, peaks)
def test_nothing_arrives_before_by_a_dense_scan(ends, peak):
    """u0(T') > U at a thousand T' < T, and u0(T) = U."""
    duration = float(minimum_time(*ends, peak).duration)
    before = np.r_[np.linspace(1e-3, 1, 900, endpoint=False), 1 - np.geomspace(1e-7, 1e-1, 100)] * duration
    assert (fixed_time_peaks(*ends, before) > peak).all()
    assert_allclose(fixed_time_peaks(*ends, duration), peak, rtol=1e-10)


@given(states(), st.tuples(angles), peaks, st.booleans(), st.floats(0.2, 4.0), st.floats(1.01, 3.0))
def test_the_peak_falls_with_the_time_if_an_end_is_an_equilibrium(x, place, peak, reverse, T, factor):
    """With x2 = x3 = 0 at one end the body can wait there: u0 does not rise, minimum_time is its inverse."""
    rest = np.array([*place, 0.0, 0.0])
    ends = (rest, x) if reverse else (x, rest)
    assume(np.abs(ends[0] - ends[1]).max() > 1e-3)
    early, late = fixed_time_peaks(*ends, np.array([T, factor * T]))
    assert late <= early * (1 + 1e-12)
    assert_allclose(minimum_time(*ends, early).duration, T, rtol=1e-7)


def test_three_times_meet_one_bound_when_neither_end_is_an_equilibrium():
    """u0(T) falls, rises and falls again through 14: the least of the three crossings is the answer."""
    durations = np.linspace(0.3, 6, 4001)
    above = fixed_time_peaks(*THREE_TIMES, durations) > CROSSED
    crossings = durations[1:][np.diff(above.astype(int)) != 0]
    assert len(crossings) == 3
    assert_allclose(minimum_time(*THREE_TIMES, CROSSED).duration, crossings[0], atol=2e-3)
    assert not minimum_time(*THREE_TIMES, CROSSED).duration >= crossings[1]


@pytest.mark.slow
@given(signs, places(), states(), st.floats(0.3, 3.0))
def test_bang_bang_data_of_every_structure_arrive_no_later(level, switches, x0, T):
    """For narrow flips, one switch or none the known transfer is an upper bound, up to rounding."""
    a, b = switches
    xf = flown(x0, level, (T * (1 - a), T * (a - b), T * b))
    solution = minimum_time(x0, xf, 1.0)
    assert solution.certificate.primal_residual <= 1e-13
    exact = [float(t) for violation, t in exact_bang_bang_times(x0, xf, 1.0) if violation <= 1e-15]
    assert float(solution.duration) <= min(exact) * (1 + 1e-9)


@pytest.mark.parametrize(
    ("x0", "xf"),
    [
        (
            [1.3982580176838768, -0.09125531017372712, 0.6614811220473554],
            [1.4194804907023995, 0.1397948887670714, 0.23309426795082977],
        ),
        (
            [-0.9124618623156648, -0.09119632567004163, 0.0589376762965288],
            [-0.9325863867579943, 0.03307550349143075, 0.5017000957835428],
        ),
        (
            [-0.5822223817912094, -0.13660962869016802, -0.6302734900331294],
            [0.29581153472391253, 2.095764999815318, 2.2049929544404776],
        ),
        (
            [0.0680853607988866, 0.7316536203665386, 0.4739267427868387],
            [-0.8767758161596649, -3.1046414746289153, -2.810195144027697],
        ),
    ],
)
def test_switches_within_rounding_of_the_ends_and_roots_within_rounding_of_each_other(x0, xf):
    assert_allclose(minimum_time(x0, xf, 1.0).duration, least_exact(x0, xf, 1.0), rtol=1e-10)


@pytest.mark.parametrize(
    ("x0", "xf", "miss"),
    [
        (
            [-0.3160179788233455, -0.882887386029873, -0.8729423457753583],
            [-2.7405870136794674, -0.021111643049373463, 0.01625263869327257],
            1.3e-7,
        ),
        (
            [0.23357880414085733, -0.6143855791645411, 0.4205319482574358],
            [-0.23357880414085733, -0.6143855791645411, -0.4205319482574358],
            8e-9,
        ),
    ],
)
def test_a_root_that_misses_by_little_is_no_arrival(x0, xf, miss):
    """There is an earlier root, but its switch lies `miss`, a share of T, outside the transfer."""
    candidates = exact_bang_bang_times(x0, xf, 1.0)
    least = least_exact(x0, xf, 1.0)
    earlier = [violation for violation, T in candidates if least > T]
    assert 0 < min(earlier) < 1.1 * miss
    assert_allclose(minimum_time(x0, xf, 1.0).duration, least, rtol=1e-12)


@given(states(), states(), st.sampled_from([1.0, 1024.0, 2.0**30]))
def test_a_force_is_an_offset_of_the_third_state(x0, xf, force):
    """x3 + f drives x2: only this sum matters, however large its parts are."""
    grid = np.array([1, 1, 1024.0])
    x0, xf = np.round(x0 * grid) / grid, np.round(xf * grid) / grid
    assume(np.abs(xf - x0).max() > 1e-3)
    shifted = minimum_time(x0 - [0, 0, force], xf - [0, 0, force], 1.0, disturbance=force)
    assert_allclose(shifted.duration, minimum_time(x0, xf, 1.0).duration, rtol=1e-13)


@given(transfers, peaks, st.floats(0.1, 10), st.floats(0.1, 10))
def test_units_of_angle_and_time(ends, peak, angle, time):
    units = angle / time ** np.arange(3)
    scaled = minimum_time(*(x * units for x in ends), peak * angle / time**3)
    assert_allclose(scaled.duration, minimum_time(*ends, peak).duration * time, rtol=1e-10)


@given(transfers, peaks)
def test_the_way_back_takes_as_long(ends, peak):
    """If time is reversed, the rate and u change sign."""
    back = minimum_time(*(x * [1, -1, 1] for x in reversed(ends)), peak)
    assert_allclose(back.duration, minimum_time(*ends, peak).duration, rtol=1e-11)


@given(transfers, peaks)
def test_the_sign_of_the_control_is_that_of_the_third_costate(ends, peak):
    solution = minimum_time(*ends, peak)
    edges = np.array([0, *solution.breakpoints, solution.duration], dtype=float)
    middle = (edges[1:] + edges[:-1]) / 2
    assert np.sign(solution.costate(middle)[:, 2]).tolist() == np.sign(solution.control(middle)).tolist()


@given(transfers, peaks)
def test_just_before_the_target_is_provably_out_of_reach(ends, peak):
    """A little before the dual value the least peak is above the bound."""
    solution = minimum_time(*ends, peak)
    assume(solution.certificate.holds(1e-9))
    earlier = float(solution.certificate.dual_value) * (1 - 1e-6)
    assert fixed_time_peaks(*ends, earlier) > peak


@pytest.mark.parametrize(
    ("x0", "xf"), [([0, -1, -1], [-3, -2, -1]), ([0, 0, -2], [-3, -3, -2]), ([0, -3, 2], [-3, 0, 2])]
)
def test_one_switch_is_proved_by_the_functional_that_falls(x0, xf):
    """Here phi rises through T for (s - aT)(s - bT) and falls for a zero at the other end instead."""
    solution = minimum_time(x0, xf, 1.0)
    assert len(solution.breakpoints) == 1
    assert solution.certificate.holds(1e-12)
    assert_allclose(solution.duration, least_exact(x0, xf, 1.0), rtol=1e-14)


def test_where_no_functional_falls_the_certificate_does_not_hold():
    """u0(T) touches the bound from above with slope zero: no single functional proves the least time."""
    solution = minimum_time([-2, 2, -2], [-1, -1, -2], 1.0)
    assert_allclose(solution.duration, 2.0, rtol=1e-12)
    assert not solution.certificate.holds(1e-3)


def test_rest_to_rest():
    """One radian with |u| <= 32 takes one second, 32 = 32/T^3."""
    solution = minimum_time([0, 0, 0], [1, 0, 0], 32.0)
    assert_allclose(solution.duration, 1.0, rtol=1e-15)
    assert_allclose(solution.switch_times, [0.25, 0.75], rtol=1e-15)
    assert solution.certificate.holds(1e-12)


def test_ends_that_agree_take_no_time():
    solution = minimum_time([1, 2, 3], [1, 2, 3], 1.0)
    assert float(solution.duration) == float(solution.norm) == 0.0
    assert np.isnan(solution.switch_times).all()
    assert solution.certificate.holds(0.0)
    assert solution.control([0.0]).tolist() == [0.0]
    assert solution.state([0.0]).tolist() == [[1, 2, 3]]
    assert not solution.costate([0.0]).any()


def test_ends_that_agree_do_not_disturb_the_others_of_a_stack():
    both = minimum_time([[0, 1, 0], [0, 0, 0]], [[0, 1, 0], [1, 0, 0]], 32.0)
    assert_allclose(both.duration, [0.0, 1.0], rtol=1e-15)
    assert both.state([[0.0], [1.0]])[:, 0] == pytest.approx(np.array([[0, 1, 0], [1, 0, 0]]), abs=1e-14)
    with pytest.raises(ValueError, match=r"^t must lie between"):
        both.state([[0.5], [0.5]])


@pytest.mark.parametrize("x3f", [2.0, -2.0])
def test_a_constant_control_arrives_when_x3_does(x3f):
    xf = flown([0, 0, 0], np.sign(x3f), (2.0, 0.0, 0.0))
    solution = minimum_time([0, 0, 0], xf, 1.0)
    assert float(solution.duration) == 2.0
    assert np.isnan(solution.switch_times).all()


def test_stacks_broadcast():
    solution = minimum_time(np.zeros((4, 1, 3)), [1.0, 0, 0], [1.0, 2.0, 4.0], disturbance=np.zeros((4, 1)))
    assert solution.duration.shape == (4, 3)
    assert solution.switch_times.shape == (4, 3, 2)
    assert_allclose(solution.duration[0], np.cbrt([32, 16, 8]), rtol=1e-14)
    assert minimum_time(np.zeros((0, 3)), [1, 0, 0], 1.0).duration.shape == (0,)


@pytest.mark.parametrize(
    ("changed", "error", "message"),
    [
        ({"peak": 0.0}, ValueError, "^peak must be positive, got 0"),
        ({"peak": -1.0}, ValueError, "^peak must be positive, got -1"),
        ({"peak": np.nan}, ValueError, "^peak .*nan"),
        ({"peak": "low"}, TypeError, "^peak .*'low'"),
        ({"peak": None}, TypeError, "^peak .*None"),
        ({"x0": [0, 0]}, ValueError, r"^x0 .*shape \(2,\)"),
        ({"xf": [np.inf, 0, 0]}, ValueError, "^xf .*inf"),
        ({"disturbance": np.sin}, TypeError, "^disturbance must be None or a constant"),
        ({"disturbance": sp.Symbol("t")}, TypeError, "^disturbance must be None or a constant"),
        ({"disturbance": "weak"}, TypeError, "^disturbance .*'weak'"),
        ({"x0": np.zeros((2, 3)), "peak": [1.0] * 3}, ValueError, r"x0 \(2,\).*peak \(3,\)"),
    ],
)
def test_what_is_no_transfer_is_refused(changed, error, message):
    with pytest.raises(error, match=message):
        minimum_time(**({"x0": [0, 0, 0], "xf": [1, 0, 0], "peak": 1.0} | changed))


def test_the_exact_reference_knows_a_transfer_by_hand():
    """From rest to rest over 1 with |u| <= 32 the reference finds the admissible root T = 1 only."""
    admissible = [T for violation, T in exact_bang_bang_times([0, 0, 0], [1, 0, 0], 32.0) if violation <= 0]
    assert len(admissible) == 1
    assert abs(admissible[0] - mp.mpf(1)) < 1e-40


def test_changes_of_sign_are_counted_as_one_counts_them():
    """Over all patterns of signs; zeros do not count, and the leading coefficient is positive."""
    for rising in itertools.product((-1.0, 0.0, 2.0), repeat=4):
        row = [1.0, *(q for q in reversed(rising) if q)]
        assert sign_changes(*rising) == sum(a * b < 0 for a, b in itertools.pairwise(row))


def test_stationary_points_are_the_roots_of_the_derivative():
    """Of quartics with the leading coefficient 3 and up to three stationary points; NumPy finds the roots."""
    rng, counts = np.random.default_rng(8), set()
    for _ in range(300):
        q1, q2, q3 = rng.normal(size=3) * 10.0 ** rng.uniform(-1, 1, 3)
        roots = np.roots([12.0, 3 * q3, 2 * q2, q1])
        real = np.sort(roots[np.abs(roots.imag) < 1e-9].real)
        inside = real[(real > 0) & (real < 20.0)]
        found = np.array(stationary_points(20.0, q1, q2, q3))
        assert_allclose(found[: len(inside)], inside, rtol=1e-9)
        assert np.all(found[len(inside) :] == 20.0)
        counts.add(len(inside))
    assert counts == {0, 1, 2, 3}
