"""The rendezvous solver: exact derivatives, solutions in every geometry, certificates that can fail."""

import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import pontryagin
from pontryagin.rendezvous import Chaser, Orbit, Rendezvous, generate, kernels, solve
from pontryagin.rendezvous.families import bounded
from pontryagin.rendezvous.problem.cases import chaser_on
from pontryagin.rendezvous.reduced.certificate import certify
from pontryagin.rendezvous.reduced.conditions import Setting, end_thrust, equations
from pontryagin.rendezvous.reduced.flight import fly
from pontryagin.rendezvous.reduced.quadrature import energy
from pontryagin.rendezvous.reduced.search_log import Search
from pontryagin.rendezvous.reduced.shooting import SHOOTING, meet
from pontryagin.rendezvous.reduced.solve import extremals
from pontryagin.rendezvous.reduced.start import cold_start
from pontryagin.rendezvous.root import Root

CRAFT = Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0])
COSTATES = np.array([0.01, 0.02, 0.05, 0.01, 0.02, 0.03])
INCLINATIONS = (0, 1, 60, 150)


def orbit(degrees: float, eccentricity: float = 0.1) -> Orbit:
    return Orbit.from_angles(1.5, eccentricity, 0.3, math.radians(degrees), 0.5, 0.6)


def problem(degrees: float, **changes) -> Rendezvous:
    given = {"time_weight": 0, "energy_weight": 1, "peak": math.inf} | changes
    return Rendezvous(CRAFT, orbit(degrees), **given)


@pytest.mark.slow
def test_the_kernels_are_those_that_the_derivation_generates():
    assert Path(kernels.__file__).read_text() == generate.kernels()


def test_importing_the_package_loads_neither_sympy_nor_an_integrator():
    heavy = "{'sympy', 'heyoka', 'scipy.integrate', 'numba', 'casadi', 'matplotlib'}"
    code = f"import sys, pontryagin.rendezvous as r; r.Orbit; print({heavy} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "set()"


@pytest.mark.parametrize("degrees", INCLINATIONS)
@pytest.mark.parametrize(("ratio", "peak"), [(0.01, 0.05), (0.001, 0.05), (math.inf, 0.05), (0.01, math.inf)])
def test_the_jacobian_is_the_derivative_of_the_equations(degrees, ratio, peak):
    """It is so across switches, for the terminal law, and in the bound, alpha1/alpha2 and the lead too."""
    setting, h = Setting(problem(degrees).scaled, ratio, peak), 1e-6
    point = np.append(COSTATES, 6.0)
    exact = equations(setting, point)

    def slope(there, back):
        return (there.residual - back.residual) / (2 * h)

    columns = [slope(equations(setting, point + h * x), equations(setting, point - h * x)) for x in np.eye(7)]
    assert np.allclose(np.array(columns).T, exact.jacobian, rtol=1e-6, atol=1e-6)
    turned = [equations(setting.replace(lead=x), point) for x in (h, -h)]
    assert np.allclose(slope(*turned), exact.by_lead, atol=1e-8)
    if peak < math.inf:
        bounds = [equations(setting.replace(peak=peak * math.exp(x)), point) for x in (h, -h)]
        assert np.allclose(slope(*bounds), exact.by_peak, atol=1e-7)
    if ratio < math.inf:
        ratios = [equations(setting.replace(ratio=ratio * math.exp(x)), point) for x in (h, -h)]
        assert np.allclose(slope(*ratios), exact.by_ratio, atol=1e-8)


@pytest.mark.parametrize("peak", [math.inf, 0.03])
def test_both_integrators_give_the_same_flight(peak):
    taylor, classic = (fly(problem(20).scaled, COSTATES, 8.0, peak, taylor=use) for use in (True, False))
    assert len(taylor.pieces) == len(classic.pieces) == (1 if peak == math.inf else 2)
    assert np.allclose(taylor.switch_times, classic.switch_times, atol=1e-11)
    assert np.allclose(taylor.end, classic.end, atol=1e-10)
    assert np.allclose(taylor.slopes, classic.slopes, atol=1e-8)
    grid = np.linspace(0, 8, 33)
    assert np.allclose(taylor.sample(grid), classic.sample(grid), atol=1e-10)


def test_both_charts_give_the_same_attitude():
    scaled = problem(20).scaled
    above, below = (fly(scaled, COSTATES, 5.0, chart=chart) for chart in (1, -1))
    first, second = above.attitude(above.end), below.attitude(below.end)
    assert np.allclose(first, np.sign(first @ second) * second, atol=1e-12)


@pytest.mark.parametrize("degrees", INCLINATIONS)
def test_a_cold_start_meets_the_target_in_every_geometry(degrees):
    """The 16 equations check (6); Newton's law and Kepler's equation check the place."""
    setting = Setting(problem(degrees).scaled, 1.0, math.inf, duration=3.0)
    root = cold_start(setting)
    assert certify(root, (0.0, 1.0), free=False).holds(1e-10)


def test_different_numbers_of_revolutions_give_different_extremals():
    setting = Setting(problem(20).scaled, 1.0, math.inf, duration=12.0)
    costs = {turns: energy(cold_start(setting, turns).flight) for turns in (-1, 0, 1)}
    assert len({round(cost, 6) for cost in costs.values()}) == 3


@pytest.mark.slow
@pytest.mark.parametrize("taylor", [True, False])
def test_the_certificate_detects_a_wrong_costate(taylor):
    setting = Setting(problem(20).scaled, 1.0, math.inf, duration=3.0, taylor=taylor)
    root = meet(setting, cold_start(setting).unknowns)
    moved = equations(setting, root.unknowns + 1e-6 * np.eye(6)[3])
    assert certify(root, (0.0, 1.0), free=False).holds(1e-10)
    wrong = Root(root.unknowns, moved)
    assert not certify(wrong, (0.0, 1.0), free=False).holds(1e-8)


@pytest.mark.slow
def test_a_meeting_ahead_of_the_target_violates_only_the_condition_on_the_attitude():
    """In one plane and with a circular target orbit, (5), (15), (16) and H = 0 hold anywhere on the orbit."""
    free = Rendezvous(CRAFT, orbit(0, eccentricity=0.0), 0.002, 1.0, math.inf)
    best = solve(free)
    setting = Setting(free.scaled, free.scaled.ratio, math.inf)
    ahead = meet(setting.replace(lead=0.1), best.root.unknowns)
    false = certify(ahead, free.scaled.weights, free=True)
    others = (false.boundary, false.transversality, false.hamiltonian, false.maximality, false.agreement)
    assert max(others) < 1e-10
    assert false.attitude == pytest.approx(math.sin(0.05), rel=1e-6)
    assert best.certificate.holds(1e-10)


def test_the_slope_of_the_cost_over_the_duration_is_minus_the_square_of_the_end_thrust():
    """dJ/dt_k = alpha1 - alpha2 p(t_k)^2 along the family of extremals of fixed duration."""
    setting, h = Setting(problem(20).scaled, 1.0, math.inf, duration=3.0), 1e-4
    here = cold_start(setting)
    later, sooner = (energy(meet(setting.replace(duration=3.0 + x), here.unknowns).flight) for x in (h, -h))
    assert (later - sooner) / (2 * h) == pytest.approx(-(end_thrust(here.flight) ** 2), rel=1e-6)


@pytest.mark.slow
def test_a_mixed_problem_reaches_the_bound_and_obeys_the_law_at_the_end():
    best = solve(problem(20, time_weight=0.0036, peak=0.08))
    assert all(b.certificate.holds(1e-9) for b in (best, *best.others))
    assert "saturated" in best.modes and best.modes[-1] == "unsaturated"
    thrust = np.linalg.norm(best.control([*best.switch_times, best.duration]), axis=1)
    assert thrust[:-1] == pytest.approx(0.08, rel=1e-12)
    assert thrust[-1] == pytest.approx(math.sqrt(0.0036), rel=1e-10)
    assert [b.cost for b in (best, *best.others)] == sorted(b.cost for b in (best, *best.others))
    assert best.searched.durations and 0 in best.searched.revolutions


def least_time(degrees: float):
    """A problem of least time, and its extremal by one homotopy from the unbounded problem."""
    given = problem(degrees, time_weight=1, energy_weight=0, peak=0.1)
    scaled = given.scaled
    loose = Setting(scaled, (2.5 * scaled.peak) ** 2, math.inf)
    (root, *_) = extremals(loose, Search())
    return given, bounded(SHOOTING, Setting(scaled, scaled.ratio, scaled.peak), loose, root)


@pytest.mark.slow
@pytest.mark.parametrize("degrees", [0, 30])
def test_the_thrust_of_least_time_is_saturated_throughout(degrees):
    given, root = least_time(degrees)
    certificate = certify(root, given.scaled.weights, free=True)
    assert certificate.holds(1e-10)
    assert [piece.mode for piece in root.flight.pieces] == ["saturated"]


@pytest.mark.slow
def test_the_solution_does_not_depend_on_units_and_on_the_sign_of_quaternions():
    """Lengths are multiplied by 7000, fM is 398600, and -Lambda* takes the place of Lambda*."""
    plain = problem(20, duration=8.0)
    length, gravity = 7000.0, 398600.0
    time = math.sqrt(length**3 / gravity)
    speed = length / time
    target = plain.target
    other = Rendezvous(
        Chaser(length, 0.0, length * speed, [-1, 0, 0, 0]),
        Orbit(1.5 * length, target.eccentricity, -np.asarray(target.attitude), target.anomaly),
        time_weight=0,
        energy_weight=1,
        peak=math.inf,
        gravity=gravity,
        duration=8.0 * time,
    )
    first, second = solve(plain), solve(other)
    assert second.cost * time / speed**2 == pytest.approx(first.cost, rel=1e-11)
    assert second.arrival_anomaly == pytest.approx(first.arrival_anomaly, abs=1e-11)
    assert second.certificate.holds(1e-10)


@pytest.mark.slow
def test_samples_are_in_the_units_of_the_user():
    given = problem(20, duration=8.0)
    best = solve(given)
    t = np.linspace(0, 8, 9)
    states = best.state(t)
    assert states.shape == (9, 8) and best.costate(t).shape == (9, 6) and best.control(t).shape == (9, 3)
    assert np.allclose(states[0], [1, 0, 1, 0.6, 1, 0, 0, 0], atol=1e-14)
    assert np.allclose(best.costate(0.0)[0], best.initial_costate)
    assert np.allclose(np.linalg.norm(states[:, 4:], axis=1), 1, atol=1e-12)
    with pytest.raises(ValueError, match=r"^t must lie between"):
        best.state(8.1)


@pytest.mark.slow
def test_the_solution_of_a_neighbouring_problem_is_a_start():
    first = solve(problem(20, duration=8.0))
    near = solve(problem(20, duration=8.05), start=first)
    assert near.certificate.holds(1e-10) and near.cost < first.cost


@pytest.mark.slow
def test_the_direct_method_agrees_and_its_error_shrinks_with_the_mesh():
    pytest.importorskip("casadi")
    from pontryagin.rendezvous.judge.collocation import direct

    given = problem(20, duration=8.0)
    best = solve(given)
    errors = [abs(direct(given, 8.0, 0.7, n).cost / best.cost - 1) for n in (15, 30)]
    assert errors[0] < 1e-2 and errors[1] < errors[0] / 8


BAD = {
    "attitude must be a unit quaternion": lambda: Orbit(1, 0.1, [1, 1, 0, 0], 0),
    "eccentricity must be less than 1": lambda: Orbit(1, 1.0, [1, 0, 0, 0], 0),
    "eccentricity must be at least 0": lambda: Orbit(1, -0.1, [1, 0, 0, 0], 0),
    "parameter must be greater than 0": lambda: Orbit(0, 0.1, [1, 0, 0, 0], 0),
    "anomaly must be a number and finite": lambda: Orbit(1, 0.1, [1, 0, 0, 0], math.nan),
    "r must be greater than 0": lambda: Chaser(-1, 0, 1, [1, 0, 0, 0]),
    "c must be greater than 0": lambda: Chaser(1, 0, 0, [1, 0, 0, 0]),
    "attitude must be an array": lambda: Chaser(1, 0, 1, [1, 0, 0]),
    "chaser must start on an ellipse": lambda: Rendezvous(Chaser(1, 0, 1.5, [1, 0, 0, 0]), orbit(0)),
    "peak must be greater than 0": lambda: problem(0, peak=0),
    "peak must be a number and finite": lambda: problem(0, peak=math.nan),
    "peak must be finite": lambda: problem(0, time_weight=1, energy_weight=0),
    "must not both be 0": lambda: problem(0, energy_weight=0, peak=1.0),
    "time_weight must be at least 0": lambda: problem(0, time_weight=-1),
    "duration must be greater than 0": lambda: problem(0, duration=0),
    "duration must be left free": lambda: problem(0, time_weight=1, energy_weight=0, peak=1.0, duration=5),
    "gravity must be greater than 0": lambda: problem(0, gravity=0),
}


@pytest.mark.parametrize("message", BAD)
def test_the_error_of_a_wrong_argument_names_it(message):
    with pytest.raises(ValueError, match=message):
        BAD[message]()


def test_least_energy_in_free_time_is_infeasible():
    with pytest.raises(pontryagin.Infeasible, match="longer flight is always cheaper"):
        solve(problem(20))


@pytest.mark.slow
def test_a_bound_too_small_for_the_duration_is_infeasible():
    with pytest.raises(
        pontryagin.Infeasible, match=r"the bound on the thrust could be lowered to 0\.\d+, but not to 0\.04"
    ):
        solve(problem(20, peak=0.04, duration=4.0))


def test_a_craft_on_its_target_needs_no_thrust():
    target = Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6)
    together = Rendezvous(
        chaser_on(target), target, time_weight=0, energy_weight=1, peak=math.inf, duration=6.0
    )
    best = solve(together)
    assert best.cost < 1e-28
    assert best.certificate.holds(1e-10)
