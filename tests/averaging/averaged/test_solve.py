"""Averaged extremals compared with closed forms, quadratures and SciPy; problems without a solution."""

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.integrate import quad, solve_ivp
from scipy.special import ellipe, ellipkm1

from pontryagin import Infeasible, NotConverged
from pontryagin.averaging import (
    Ball,
    BoundedQuadratic,
    Box,
    Custom,
    PhaseSystem,
    Quadratic,
    kepler,
    rotor,
    smooth_example,
    solve_averaged,
    spin_down,
)

a, b, x, u, w, v, k = sp.symbols("a b x u w v k", real=True)
X, V = sp.symbols("x v")
speeds = st.floats(0.1, 5).map(lambda z: round(z, 4))
MASS, POTENTIAL = 1 + sp.cos(X) / 3, -sp.cos(X + 1) / 2


def flown(solution):
    """(xi, eta) at the end, integrated by SciPy from the solution's initial values."""
    n = len(solution.names)
    numbers = solution.numbers

    def rate(_, z):
        h, omega = solution.model.averaged(z, numbers)
        gradient = h.gradient + solution.kappa * omega.gradient
        return np.concatenate([gradient[n:], -gradient[:n]])

    start = np.concatenate([solution.slow(0.0)[0], solution.costate(0.0)[0]])
    run = solve_ivp(rate, (0, float(solution.duration)), start, method="DOP853", rtol=1e-12, atol=1e-13)
    return run.y[:n, -1], run.y[n:, -1]


def averaged(solution, tau):
    """(h0, omega) along a solution, each (k)."""
    z = np.concatenate([solution.slow(tau), solution.costate(tau)], axis=-1)
    h, omega = solution.model.averaged(z, tuple(number[..., None] for number in solution.numbers))
    return h.value, omega.value


@pytest.mark.slow
@given(speeds, speeds, st.floats(0.01, 100))
def test_the_smooth_example_is_its_closed_form(v0, v1, price):
    solution = smooth_example(v0, v1, price, ripple=0.5)
    gap = v1 - v0
    assert solution.cost == pytest.approx(2 * np.sqrt(price) * abs(gap), rel=1e-10, abs=1e-14)
    assert solution.duration == pytest.approx(abs(gap) / np.sqrt(price), rel=1e-10, abs=1e-14)
    tau = np.linspace(0, 1, 5) * solution.duration
    np.testing.assert_allclose(solution.slow(tau)[:, 0], v0 + gap * np.linspace(0, 1, 5), atol=1e-12)
    assert solution.certificate.holds(1e-11)


@given(
    st.floats(0.05, 2).map(lambda z: round(-z, 4)),
    st.floats(0.05, 2).map(lambda z: round(-z, 4)),
    st.floats(0.01, 0.98),
    st.floats(0.01, 10),
)
def test_kepler_is_its_closed_form(E0, E1, e, price):
    K0 = np.sqrt((1 - e * e) / (-2 * E0))
    solution = kepler(E0, K0, E1, price)
    duration = np.sqrt(2 / price) * abs(np.sqrt(-E1) - np.sqrt(-E0))
    assert solution.duration == pytest.approx(duration, rel=1e-10, abs=1e-13)
    assert solution.cost == pytest.approx(2 * price * duration, rel=1e-10, abs=1e-13)
    tau = np.linspace(0, float(solution.duration), 7)
    E, K = solution.slow(tau).T
    np.testing.assert_allclose(E * K**2, E0 * K0**2, rtol=1e-10)
    np.testing.assert_allclose(np.diff(np.sqrt(-E), 2), 0, atol=1e-10)
    assert solution.certificate.holds(1e-9)


@pytest.mark.slow
@given(
    st.tuples(st.floats(0.2, 2), st.floats(-2, 2), st.floats(0.2, 2)),
    st.floats(1e-3, 1e3),
    st.floats(0.1, 4).filter(lambda d: abs(d - 1) > 0.01),
)
def test_spin_down_is_its_elliptic_integral(w0, aspect, ratio):
    """SciPy's ellipe takes the parameter m = 1 - (l_y / l_x)^2, which may be negative."""
    solution = spin_down(w0, [0.7, 0.7 * aspect, 0.4], ratio)
    mean = 2 * 0.7 / np.pi * ellipe(1 - aspect**2)
    equatorial = np.hypot(w0[0], w0[1])
    assert solution.duration == pytest.approx(equatorial / mean, rel=1e-10)
    assert solution.cost == pytest.approx(equatorial / mean, rel=1e-10)
    end = solution.slow(solution.duration)[0]
    assert end == pytest.approx([0, w0[2]], abs=1e-12)
    assert solution.costate(0.0)[0] == pytest.approx([-1 / mean, 0], rel=1e-10, abs=1e-12)


def rotor_rates(energy, force=0.0):
    """omega and the mean of x' f of the rotor of this file by SciPy's quadrature."""
    m, potential = (sp.lambdify(X, e) for e in (MASS, POTENTIAL))

    def speed(angle):
        return np.sqrt(2 * (energy - potential(angle)) / m(angle))

    f = sp.lambdify([X, V], force)
    turn = quad(lambda angle: 1 / speed(angle), 0, 2 * np.pi, epsabs=1e-13)[0]
    push = quad(lambda angle: f(angle, speed(angle)), 0, 2 * np.pi, epsabs=1e-13)[0]
    return 2 * np.pi / turn, push / turn


FORCES = {"none": sp.S.Zero, "mean zero": sp.sin(X), "drag": sp.sin(X) - V / 5}


@pytest.mark.slow
@pytest.mark.parametrize("force", FORCES)
@pytest.mark.parametrize(("a0", "a1"), [(1.0, 3.0), (3.0, 1.0)])
def test_the_rotors_least_time_is_a_quadrature_over_the_energy(force, a0, a1):
    solution = rotor(a0, a1, mass=MASS, potential=POTENTIAL, force=FORCES[force], peak=0.8)
    sign = np.sign(a1 - a0)

    def pace(energy):
        omega, drift = rotor_rates(energy, FORCES[force])
        return 1 / (sign * 0.8 * omega + drift)

    assert solution.duration == pytest.approx(quad(pace, a0, a1, epsabs=1e-12)[0], rel=1e-10)
    assert solution.cost == pytest.approx(float(solution.duration), rel=1e-12)


def test_a_rotor_of_constant_speed_is_the_papers_square_root():
    a0, a1 = np.array([[1.0], [4.0]]), np.array([2.0, 9.0, 0.25])
    solution = rotor(a0, a1, peak=0.5)
    expected = np.sqrt(2) * np.abs(np.sqrt(a1) - np.sqrt(a0)) / 0.5
    np.testing.assert_allclose(solution.duration, expected, rtol=1e-12)
    tau = solution.duration[0, 0] / 3
    assert np.sqrt(solution.slow(tau)[0, 0, 0, 0]) == pytest.approx(1 + (np.sqrt(2) - 1) / 3)


@pytest.mark.parametrize("price", [0.3, 5.0])
def test_the_rotor_paid_by_its_control_is_a_quadrature_too(price):
    """With one degree of freedom h0 = 0 gives the costate at each energy, and hence the rate of energy."""
    solution = rotor(1.0, 3.0, mass=MASS, potential=POTENTIAL, force=FORCES["drag"], k=price)
    m, potential = (sp.lambdify(X, e) for e in (MASS, POTENTIAL))

    def pace(energy):
        omega, drift = rotor_rates(energy, FORCES["drag"])
        square = quad(
            lambda angle: np.sqrt(2 * (energy - potential(angle)) / m(angle)), 0, 2 * np.pi, epsabs=1e-13
        )[0]
        square *= omega / (2 * np.pi)
        eta = 2 * (-drift + np.sqrt(drift**2 + price * square)) / square
        return 1 / (drift + eta * square / 2)

    assert solution.duration == pytest.approx(quad(pace, 1, 3, epsabs=1e-12)[0], rel=1e-10)


# An example that is not in the paper, with two slow variables, one of which is free at the end.
def carriage(control_set=None, terminal=0, target=None, mixing=0):
    return PhaseSystem(
        f=[
            u * (1 + sp.cos(x) / 2) + mixing * w * sp.cos(x) - a * b / 4,
            w + u * sp.sin(x) + a / 3,
        ],
        omega=1 + a**2,
        control_set=control_set or Quadratic(),
        slow=[a, b],
        control=[u, w],
        phase=x,
        target=target or [a - 2],
        running_cost=1 + b**2 / 2 + sp.cos(x) / 4,
        terminal_cost=terminal,
    )


CARRIAGES = {
    "free": carriage(),
    "priced end": carriage(terminal=b**2 - a * b),
    "curved target": carriage(target=[a**2 + b**2 - 4]),
    "fixed end": carriage(target=[a - 2, b + 1]),
    "ball": carriage(Ball(2)),
    "box": carriage(Box([2, 1]), mixing=1),
    "bounded": carriage(BoundedQuadratic(sp.Rational(3, 2))),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", CARRIAGES)
@pytest.mark.parametrize("kappa", [0.0, -0.2])
def test_the_flow_from_the_start_meets_target_transversality_and_level(name, kappa):
    """The flow of (2.11) meets the conditions (2.4) and (2.12) at the end."""
    system = CARRIAGES[name]
    solution = solve_averaged(system, [0.5, 0.3], kappa=kappa)
    xi, eta = flown(solution)
    at = dict(zip(system.slow, xi, strict=True))
    assert [float(m.subs(at)) for m in system.target] == pytest.approx([0.0] * len(system.target), abs=1e-8)
    pull = sp.Matrix([system.terminal_cost]).jacobian(system.slow)
    pull += sp.Matrix([list(solution.multipliers)]) * sp.Matrix(system.target).jacobian(system.slow)
    np.testing.assert_allclose(eta, -np.array(pull.subs(at), dtype=float)[0], atol=1e-7)
    h, omega = averaged(solution, np.linspace(0, 1, 30) * solution.duration)
    np.testing.assert_allclose(h + kappa * omega, 0, atol=1e-8)
    assert solution.certificate.residual < 1e-7


def test_no_neighbouring_programme_is_cheaper():
    """Perturbed averaged controls, integrated to the target by SciPy, cost more than the averaged optimum.

    For a quadratic cost the averaged problem is itself a control problem, whose control is eta(tau).
    """
    solution = solve_averaged(CARRIAGES["priced end"], [0.5, 0.3])
    rng = np.random.default_rng(3)

    def cost(amplitudes, stretch):
        def rate(tau, z):
            share = tau / (stretch * float(solution.duration))
            eta = solution.costate(min(share, 1.0) * float(solution.duration))[0]
            wave = np.sin(np.pi * share * np.arange(1, 3))
            eta = eta + amplitudes @ wave
            h, _ = solution.model.averaged(np.concatenate([z[:2], eta]), ())
            return [*h.gradient[2:], eta @ h.gradient[2:] - h.value]

        reached = lambda _, z: z[0] - 2  # noqa: E731
        reached.terminal = True
        run = solve_ivp(rate, (0, 3), [0.5, 0.3, 0.0], events=reached, rtol=1e-10, atol=1e-12)
        end = run.y_events[0][0]
        return end[2] + end[1] ** 2 - end[0] * end[1]

    best = cost(np.zeros((2, 2)), 1.0)
    assert best == pytest.approx(float(solution.cost), rel=1e-7)
    for _ in range(6):
        assert cost(0.1 * rng.standard_normal((2, 2)), 1 + 0.1 * rng.standard_normal()) > best


def test_a_priced_free_end_is_its_closed_form():
    """v' = u, y' = w with the running cost k + u^2 + w^2 and the terminal cost c y: eta_y = -c throughout."""
    c, price = 1.2, 2.0
    system = PhaseSystem(
        f=[u, w],
        omega=v,
        control_set=Quadratic(),
        slow=[v, b],
        control=[u, w],
        phase=x,
        target=[v - 3],
        running_cost=price,
        terminal_cost=c * b,
    )
    solution = solve_averaged(system, [1.0, 0.5])
    eta = 2 * np.sqrt(price - c**2 / 4)
    assert solution.duration == pytest.approx(2 / (eta / 2), rel=1e-12)
    assert solution.costate(0.3)[0] == pytest.approx([eta, -c], rel=1e-11)
    paid = solution.duration * (price + eta**2 / 4 + c**2 / 4) + c * (0.5 - c / 2 * solution.duration)
    assert solution.cost == pytest.approx(float(paid), rel=1e-12)


@pytest.mark.parametrize("name", ["free", "priced end", "curved target"])
def test_the_main_result_holds_along_the_family(name):
    """(2.14), dJ0/dkappa = kappa dPsi/dkappa with Psi the integral of omega, by differences in kappa."""
    system = CARRIAGES[name]

    def at(kappa):
        s = solve_averaged(system, [0.5, 0.3], kappa=kappa)
        return s.cost, s.phase(s.duration[..., None], 1.0)[..., 0]

    step = 5e-4
    middle = np.array([-0.3, -0.1, 0.0, 0.05])
    cost, phase = at(middle + step * np.array([[-2], [-1], [1], [2]]))
    weights = np.array([1, -8, 8, -1]) / (12 * step)
    np.testing.assert_allclose(weights @ cost, middle * (weights @ phase), rtol=1e-5, atol=1e-7)
    assert ((weights @ phase)[2] > 0).all()


@settings(max_examples=10)
@given(st.lists(st.tuples(speeds, speeds, st.floats(0.1, 10)), min_size=1, max_size=4))
def test_a_stack_is_its_members(members):
    columns = np.array(members).T
    together = smooth_example(*columns)
    for i, values in enumerate(members):
        alone = smooth_example(*values)
        assert together.cost[i] == pytest.approx(float(alone.cost), rel=1e-12, abs=1e-14)
        tau = 0.4 * alone.duration
        np.testing.assert_allclose(together.slow(0.4 * together.duration[:, None])[i], alone.slow(tau))


def test_members_that_need_different_meshes_stand_side_by_side():
    E1 = np.array([[-0.5, -0.499], [-0.3, -0.002]])
    together = kepler(-0.5, [0.8, 0.7], E1, 0.1)
    assert together.duration.shape == (2, 2) and together.slow(0.0).shape == (2, 2, 1, 2)
    expected = np.sqrt(20) * np.abs(np.sqrt(-E1) - np.sqrt(0.5))
    np.testing.assert_allclose(together.duration, expected, rtol=1e-9, atol=1e-13)
    ends = together.slow(together.duration[..., None])[..., 0, 0]
    np.testing.assert_allclose(ends, E1, rtol=1e-9)
    alone = kepler(-0.5, 0.7, -0.002, 0.1)
    costate = together.costate(0.3 * together.duration[..., None])[1, 1]
    np.testing.assert_allclose(costate, alone.costate(0.3 * alone.duration), rtol=1e-7, atol=1e-12)


def test_large_stacks_are_cut():
    v1 = np.linspace(1.5, 4, 600)
    np.testing.assert_allclose(smooth_example(1.0, v1).cost, 2 * (v1 - 1), rtol=1e-12)


@pytest.mark.parametrize(
    "solution",
    [
        lambda: smooth_example(1.5, 1.5),
        lambda: kepler(-0.4, 0.7, -0.4, 0.1),
        lambda: spin_down([0, 0, 1.2], [1, 0.5, 0.4], 0.6),
        lambda: rotor(2.0, 2.0, peak=1.0),
    ],
)
def test_what_is_there_already_takes_no_time(solution):
    found = solution()
    assert found.duration == 0 and found.cost == 0
    assert np.isfinite(found.slow(0.0)).all() and np.isfinite(found.costate(0.0)).all()
    assert found.certificate.holds(1e-10)
    assert np.isfinite(found.control(0.0, 0.3)).all()


def test_near_the_separatrix_where_the_frequency_vanishes():
    solution = rotor(1.001, 4.0, potential=-sp.cos(X), peak=1.0)

    def pace(energy):
        turn = quad(lambda angle: 1 / np.sqrt(2 * (energy + np.cos(angle))), 0, np.pi, limit=400)[0]
        return turn / np.pi

    expected = quad(pace, 1.001, 1.1)[0] + quad(pace, 1.1, 4.0)[0]
    assert solution.duration == pytest.approx(expected, rel=1e-8)


def test_a_drift_that_exceeds_the_control_makes_a_target_unreachable():
    with pytest.raises(Infeasible, match="drift leads away from it, and no control outweighs"):
        rotor(1.0, 4.0, force=-V, peak=1.0)
    with pytest.raises(Infeasible, match="at a = 2 "):
        rotor(1.0, 2.0, force=-V / 2, peak=1.0)
    assert rotor(1.0, 1.99, force=-V / 2, peak=1.0).certificate.holds(1e-8)
    assert rotor(4.0, 1.0, force=-V, peak=1.0).certificate.holds(1e-8)
    with pytest.raises(Infeasible, match=r"\(problem 1 of the stack\)"):
        rotor(1.0, [0.5, 4.0], force=-V, peak=1.0)


def test_a_frequency_that_vanishes_on_the_way_is_refused():
    through = PhaseSystem(
        f=[u], omega=a**2 - 1, control_set=Quadratic(), slow=[a], control=[u], phase=x, target=[a - 2]
    )
    assert solve_averaged(through, [1.5]).certificate.holds(1e-10)
    for start in (0.5, -3.0, 1.0):
        with pytest.raises(
            ValueError, match=r"omega must be positive along the whole trajectory, got .* at a = "
        ):
            solve_averaged(through, [start])


def test_a_cost_that_pays_for_waiting_is_refused():
    for price in (0, -1, sp.cos(x), 1 - a):
        idle = PhaseSystem(
            f=[u],
            omega=1,
            control_set=Quadratic(),
            slow=[a],
            control=[u],
            phase=x,
            target=[a - 3],
            running_cost=price,
        )
        with pytest.raises(ValueError, match="running_cost must be positive on average"):
            solve_averaged(idle, [2.0])


def test_what_cannot_be_found_is_not_handed_out():
    """Two variables under independent bounds must arrive together: the costate of the faster one is zero."""
    cylinder = PhaseSystem(
        f=[u * sp.cos(x) + v * sp.sin(x), w],
        omega=b,
        control_set=Custom(lambda s: sp.sqrt(s[0] ** 2 + s[1] ** 2) + sp.Abs(s[2])),
        slow=[a, b],
        control=[u, v, w],
        phase=x,
        target=[a - 1, b - 5],
    )
    with pytest.raises(NotConverged, match="no averaged extremal was found"):
        solve_averaged(cylinder, [2.0, 1.0])


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        (([1.0],), ValueError, r"start must be an array \(\.\.\., 2\)"),
        (([1.0, float("nan")],), ValueError, "start must be an array"),
        ((["one", 2],), TypeError, "start must be an array"),
        ((np.zeros((0, 2)),), ValueError, "empty"),
    ],
)
def test_a_bad_start_is_refused(arguments, error, message):
    with pytest.raises(error, match=message):
        solve_averaged(CARRIAGES["free"], *arguments)


def test_a_bad_kappa_or_system_is_refused():
    with pytest.raises(ValueError, match="kappa must be a number"):
        solve_averaged(CARRIAGES["free"], [0.5, 0.3], kappa=float("inf"))
    with pytest.raises(ValueError, match="kappa must be less than the mean running cost over omega"):
        solve_averaged(CARRIAGES["free"], [0.5, 0.3], kappa=5.0)
    with pytest.raises(ValueError, match="do not broadcast"):
        solve_averaged(CARRIAGES["free"], np.zeros((2, 2)) + 0.5, kappa=[0, 0.1, 0.2])
    with pytest.raises(TypeError, match="system must be a PhaseSystem"):
        solve_averaged("pendulum", [1.0])


def test_a_start_between_two_targets_reaches_one_of_them():
    """a' = epsilon u at the cost 1 + u^2 takes 2 per unit of distance; the target's slope is zero at 2.5."""
    a, x, u = sp.symbols("a x u", real=True)
    system = PhaseSystem(
        f=[u], omega=1, control_set=Quadratic(), slow=[a], control=[u], phase=x, target=[(a - 2) * (a - 3)]
    )
    for start in (2.5, 2.4, 2.7):
        found = solve_averaged(system, [start])
        assert float(found.cost) == pytest.approx(2 * min(start - 2, 3 - start), rel=1e-12)


@pytest.mark.parametrize("end", [(-1.5, 0.5625), (1.5, -0.0625)])
def test_rates_that_have_a_corner(end):
    """Under s = cos x (p + 2 q sin x) the mean of |s| does not depend on q where |p| > 2 |q|.

    Elsewhere it is 2 |q| (1 + k^2) / pi with k = p / 2 q: the rates are 2 k / pi and 2 (1 - k^2) / pi.
    """
    target = [a - end[0], b - end[1]]
    turning = [u * sp.cos(x), u * sp.sin(2 * x)]
    system = PhaseSystem(
        f=turning, omega=1, control_set=Ball(1), slow=[a, b], control=[u], phase=x, target=target
    )
    far, up = abs(end[0]), abs(end[1])
    k = max(np.roots([far, up, -far]))
    solution = solve_averaged(system, [0.0, 0.0])
    assert solution.cost == pytest.approx(far * np.pi / (2 * k), rel=1e-10)
    assert solution.certificate.holds(1e-10)


@pytest.mark.parametrize("energy", [-0.35, -1e-4, pytest.param(-1e-8, marks=pytest.mark.slow)])
def test_keplers_closed_form_holds_for_orbits_that_all_but_escape(energy):
    """(3.8): the duration is sqrt(2/l) times the change of sqrt|E|, and E K^2 is constant."""
    solution = kepler(-0.5, 0.95, energy, 0.1)
    expected = np.sqrt(20) * (np.sqrt(0.5) - np.sqrt(-energy))
    assert_allclose(solution.duration, expected, rtol=1e-13)
    assert_allclose(solution.cost, 0.2 * expected, rtol=1e-13)
    E, K = solution.slow(expected * np.linspace(0, 1, 9)[:-1]).T
    assert_allclose(E * K**2, -0.5 * 0.95**2, rtol=1e-9)
    assert solution.certificate.holds(1e-10)


@pytest.mark.parametrize("gap", [1e-2, pytest.param(1e-5, marks=pytest.mark.slow)])
def test_a_pendulum_is_sped_up_from_beside_its_upper_equilibrium(gap):
    """In least time, |u| <= 1, the energy grows at the rate omega = pi sqrt((a + 1)/2) / K(2/(a + 1))."""

    def slowness(log_gap):
        above = np.exp(log_gap)
        return above * ellipkm1(above / (2 + above)) / (np.pi * np.sqrt((2 + above) / 2))

    expected, _ = quad(slowness, np.log(gap), np.log(2.0), epsabs=0, epsrel=1e-13)
    for first, last in ((1 + gap, 3.0), (3.0, 1 + gap)):
        solution = rotor(first, last, potential=-sp.cos(sp.Symbol("x")), peak=1.0)
        assert_allclose(solution.duration, expected, rtol=1e-10)
        assert solution.certificate.holds(1e-9)
