"""States, phase, anomaly and control of a solution at given times, for one problem and for stacks."""

import mpmath as mp
import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose
from scipy.integrate import quad
from scipy.interpolate import CubicSpline

from pontryagin.averaging import kepler, rotor, smooth_example, spin_down

X = sp.Symbol("x")


@pytest.fixture(scope="module")
def orbit():
    return kepler(-0.5, 0.7, -0.3, 0.1)


@pytest.fixture(scope="module")
def turning():
    return rotor(1.5, 3.0, mass=1 + sp.cos(X) / 3, potential=-sp.cos(X), peak=1.0)


@pytest.mark.slow
@pytest.mark.parametrize("example", ["orbit", "turning"])
def test_the_phase_is_the_integral_of_the_frequency(example, request):
    """The phase is that of (2.5)."""
    solution = request.getfixturevalue(example)
    tau = np.linspace(0, 1, 4) * solution.duration
    turned = [quad(lambda t: solution.frequency(t)[0], 0, t, epsabs=1e-12)[0] for t in tau]
    np.testing.assert_allclose(solution.phase(tau, 0.01, 0.4), 0.4 + np.array(turned) / 0.01, rtol=1e-10)


def test_keplers_frequency_is_the_mean_motion_and_its_phase_the_mean_anomaly(orbit):
    E = orbit.slow(0.2)[0, 0]
    assert orbit.frequency(0.2)[0] == pytest.approx((-2 * E) ** 1.5)
    xi = np.array([0.0, 0.4, 2.0, -3.0, 9.0])
    e = np.sqrt(1 - 0.7**2)
    np.testing.assert_allclose(orbit.phase_of(0.2, xi), xi - e * np.sin(xi), atol=1e-13)


def test_anomaly_and_phase_are_inverse(orbit, turning):
    for solution in (orbit, turning):
        tau = np.linspace(0, 1, 9) * solution.duration
        psi = solution.phase(tau, 0.05)
        x = solution.anomaly(tau, 0.05)
        np.testing.assert_allclose(solution.phase_of(tau, x), psi, rtol=1e-13)


def test_the_rotors_phase_is_the_share_of_the_turns_time(turning):
    energy = turning.slow(0.1)[0, 0]

    def pace(x):
        return np.sqrt((1 + np.cos(x) / 3) / (2 * (energy + np.cos(x))))

    turn = quad(pace, 0, 2 * np.pi, epsabs=1e-13)[0]
    for x in (0.5, 3.0, 5.5):
        expected = 2 * np.pi * quad(pace, 0, x, epsabs=1e-13)[0] / turn
        assert turning.phase_of(0.1, x)[0] == pytest.approx(expected, rel=1e-12)


def test_the_control_is_the_systems_maximiser_without_phase_costate(orbit):
    """The control is u0* of (2.17)."""
    tau, xi = np.array([0.1, 0.3]), np.array([0.7, 4.0])
    system = orbit.system
    slow, costate, control = orbit.slow(tau), orbit.costate(tau), orbit.control(tau, xi)
    for i in range(2):
        at = dict(zip((*system.slow, *system.costates), (*slow[i], *costate[i]), strict=True))
        at |= {system.phase: xi[i], system.phase_costate: 0}
        np.testing.assert_allclose(control[i], np.array(system.maximiser.subs(at), dtype=float)[:, 0])


def test_keplers_thrust_is_along_the_velocity(orbit):
    tau, xi = 0.2, np.linspace(0, 6, 7)
    (E, K), e = orbit.slow(tau)[0], np.sqrt(1 - 0.7**2)
    r = (1 - e * np.cos(xi)) / (-2 * E)
    velocity = np.stack([e * np.sin(xi) * np.sqrt(-2 * E) / (1 - e * np.cos(xi)), K / r], axis=-1)
    np.testing.assert_allclose(
        orbit.control(tau, xi), orbit.costate(tau)[0, 0] / 2 * velocity, rtol=1e-9, atol=1e-12
    )


def test_the_braking_torque_lies_on_its_ellipsoid():
    axes = np.array([1.0, 0.7, 0.4])
    solution = spin_down([0.6, 0.5, 1.2], axes, 0.6)
    tau = np.linspace(0, 1, 5) * solution.duration
    u = solution.control(tau, np.linspace(0, 6, 5))
    np.testing.assert_allclose(((u / axes) ** 2).sum(axis=-1), 1, atol=1e-13)
    np.testing.assert_allclose(u[:, 2], 0, atol=1e-12)


def test_the_mean_rate_is_the_slope_of_the_slow_variables(orbit):
    h = 1e-4
    slope = (orbit.slow(0.3 + h) - orbit.slow(0.3 - h)) / (2 * h)
    np.testing.assert_allclose(orbit.mean_rate(0.3), slope, rtol=1e-6)


def test_a_stack_samples_as_its_members_do():
    E1 = np.array([-0.3, -0.45, -0.5])
    together = kepler(-0.5, np.array([[0.7], [0.9]]), E1, 0.1)
    assert together.cost.shape == (2, 3)
    tau = np.linspace(0, 1, 5) * together.duration[..., None]
    for sample, width in ((together.slow, 2), (together.costate, 2)):
        assert sample(tau).shape == (2, 3, 5, width) and sample(0.0).shape == (2, 3, 1, width)
    alone = kepler(-0.5, 0.9, -0.45, 0.1)
    np.testing.assert_allclose(together.slow(tau)[1, 1], alone.slow(tau[1, 1]), rtol=1e-12)
    np.testing.assert_allclose(together.phase(tau, 0.1)[1, 1], alone.phase(tau[1, 1], 0.1), atol=1e-10)
    np.testing.assert_allclose(together.anomaly(tau, 0.1)[1, 1], alone.anomaly(tau[1, 1], 0.1), atol=1e-10)
    np.testing.assert_allclose(together.control(tau, 1.0)[1, 1], alone.control(tau[1, 1], 1.0), atol=1e-11)


def test_the_names_and_the_initial_phase_are_told():
    assert kepler(-0.5, 0.7, -0.3, 0.1).names == ("E", "K")
    assert smooth_example(1.0, 2.0).initial_phase == 0
    body = spin_down([[0.6, 0.5, 1.2], [0.6, -0.5, 1.2]], [1, 1, 1], [0.6, 1.6])
    np.testing.assert_allclose(body.initial_phase, -np.arctan2(0.5, 0.6))


@pytest.mark.parametrize("epsilon", [0, -0.1, float("nan"), [0.1, 0.2], "small"])
def test_an_epsilon_that_is_not_positive_is_refused(orbit, epsilon):
    for call in (lambda: orbit.phase(0.1, epsilon), lambda: orbit.exact(epsilon)):
        with pytest.raises((ValueError, TypeError), match="epsilon must be a positive number"):
            call()


def test_times_outside_are_refused(orbit):
    with pytest.raises(ValueError, match="tau must lie between"):
        orbit.slow(2 * orbit.duration)
    with pytest.raises(ValueError, match="tau must be a number or an array"):
        orbit.costate(float("nan"))
    with pytest.raises(ValueError, match="anomaly must be"):
        orbit.control(0.1, float("inf"))


@pytest.mark.slow
def test_the_exact_spin_down_is_handed_out_in_the_paper_s_variables():
    """H of the paper's system vanishes on it, (a, psi) obey the equations of motion, and a falls to 0."""
    solution = spin_down([1.0, 0.4, 2.0], [1.0, 0.5, 0.7], 1.6)
    best = solution.exact(0.1)[0]
    tau = np.linspace(0, best.duration, 200)
    a, p, psi, u = best.slow(tau), best.costate(tau), best.phase(tau), best.control(tau)
    assert_allclose(a[0], solution.start)
    assert psi[0] == pytest.approx(float(solution.initial_phase)) and a[-1, 0] < 1e-9
    system = solution.system
    whole = system.hamiltonian * best.epsilon + system.phase_costate * system.rate
    arguments = [*system.slow, *system.costates, system.phase, system.phase_costate, *system.numbers]
    numbers = [float(number) for number in solution.numbers]
    value = sp.lambdify(arguments, whole)(
        *a[:-1].T, *p[:-1].T, psi[:-1], best.phase_costate(tau)[:-1], *numbers
    )
    assert np.abs(value).max() < 1e-9 * best.epsilon
    slope = CubicSpline(tau, a)(tau, 1)[3:-3]
    rate = sp.lambdify([*system.slow, system.phase, *system.control, *system.numbers], list(system.f))
    expected = np.stack(np.broadcast_arrays(*rate(*a.T, psi, *u.T, *numbers)), axis=1)[3:-3]
    assert_allclose(slope, expected, atol=1e-4)


@pytest.mark.parametrize("phase", [1000.0, 1e10, -1e15])
def test_a_phase_of_many_turns_is_the_one_within_a_turn(phase):
    with mp.workdps(60):
        within = float(mp.atan2(mp.sin(mp.mpf(phase)), mp.cos(mp.mpf(phase))))
    solution = smooth_example(1.0, 2.0, ripple=0.5)
    far, usual = solution.exact(0.05, phase), solution.exact(0.05, within)
    assert_allclose([one.cost for one in far], [one.cost for one in usual], rtol=1e-12)
    assert far[0].certificate.holds(1e-9)
    assert_allclose(solution.correction(phase), solution.correction(within), rtol=1e-12)
    assert_allclose(np.cos(solution.anomaly(0.5, 0.1, phase)), np.cos(solution.anomaly(0.5, 0.1, within)))


@pytest.mark.parametrize("call", ["exact", "correction", "phase", "anomaly"])
def test_a_phase_that_has_no_place_on_the_turn_is_refused(call):
    solution = smooth_example(1.0, 2.0)
    arguments = {"exact": (0.1, 1e17), "correction": (1e17,)}.get(call, (0.5, 0.1, 1e17))
    with pytest.raises(ValueError, match=r"^phase must be a number.*, at most 9.0e\+15 rad") as caught:
        getattr(solution, call)(*arguments)
    assert caught.value.argument == "phase"


@pytest.mark.parametrize("epsilon", [1e-9, 1e-300])
def test_more_turns_than_can_be_followed_are_refused(epsilon):
    with pytest.raises(ValueError, match=r"^epsilon must leave at most 100000 turns of the phase") as caught:
        smooth_example(1.0, 2.0, ripple=0.5).exact(epsilon)
    assert caught.value.argument == "epsilon"
