"""The solvers in Sapunkov's elements for both functionals, against `solve`, Newton's law and differences."""

import math
from dataclasses import dataclass

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

import pontryagin
from pontryagin.numerics.rotation import rotated
from pontryagin.rendezvous import (
    Chaser,
    Elements,
    Extremal,
    Orbit,
    Rendezvous,
    least_fuel,
    solve,
    solve_in_elements,
)
from pontryagin.rendezvous.derivation import sapunkov
from pontryagin.rendezvous.derivation import sapunkov_principle as principle
from pontryagin.rendezvous.elements import shooting as elements_shooting
from pontryagin.rendezvous.elements.certificate import certify
from pontryagin.rendezvous.elements.conditions import ElementsEquations, ElementsSetting, equations
from pontryagin.rendezvous.elements.flight import (
    fly_elements,
    switching,
)
from pontryagin.rendezvous.elements.law import Law
from pontryagin.rendezvous.reduced import shooting
from pontryagin.rendezvous.reduced.start import cold_start
from pontryagin.rendezvous.root import Root

CRAFT = Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0])
COSTATES = np.array([1.5, -0.7, 2.2, -1.3, -2.1, -1.8])


def orbit(degrees: float, eccentricity: float = 0.1) -> Orbit:
    return Orbit.from_angles(1.5, eccentricity, 0.3, math.radians(degrees), 0.5, 0.6)


def problem(degrees: float, **changes) -> Rendezvous:
    given = {"time_weight": 0, "energy_weight": 1, "peak": math.inf} | changes
    return Rendezvous(CRAFT, orbit(degrees), **given)


def at_random(expression: sp.Expr):
    """The value of an expression at arbitrary rational values of its symbols, exact."""
    symbols = sorted(expression.free_symbols, key=str)
    return expression.subs({x: sp.Rational(7 + 3 * i * i, 11 + 5 * i) for i, x in enumerate(symbols)})


# --- the principle ---------------------------------------------------------------------------------------


def test_the_driving_force_is_that_of_the_derived_rates():
    for rates, turn in zip(sapunkov.element_rates(), (-principle.SIN, principle.COS), strict=True):
        difference = (rates.subs(sapunkov.epsilon, 1) - principle.driving() * turn).xreplace(
            {sapunkov.half_anomaly: sp.Rational(1, 2)}
        )
        assert all(sp.expand(at_random(part)) == 0 for part in difference[:2])


@pytest.mark.slow
def test_the_momentum_of_the_turn_is_constant_under_any_thrust():
    assert sp.expand(principle.rate_of(principle.turn_momentum())) == 0


@pytest.mark.slow
def test_the_hamiltonian_and_the_phase_costate_sum_to_a_constant():
    whole = principle.rate_of(principle.hamiltonian() + principle.phase_costate())
    assert sp.expand(at_random(whole)) == 0


def test_the_gradient_of_the_relation_does_not_change_the_thrust():
    relation = sapunkov.bilinear()
    for part in principle.switching_of_the_relation():
        assert sp.denom(sp.cancel(sp.expand(part) / relation)).free_symbols <= {*sapunkov.u}
    turn, gradient = principle.turn_direction(), principle.relation_gradient()
    assert sp.expand(turn.dot(gradient)) == 0
    assert sp.expand(turn.dot(turn) - gradient.dot(gradient)) == 0


@pytest.mark.slow
def test_the_terminal_law_is_that_of_pimkina_and_chelnokov():
    law = principle.switching().dot(sapunkov.force) - principle.running_cost
    assert sp.expand(at_random(principle.terminal_law() - law)) == 0


def test_the_smoothed_throttle_is_a_maximum_and_tends_to_the_jump():
    share, most = principle.smoothed_throttle()
    (S,) = {x for x in share.free_symbols if str(x) == "S"}
    (width,) = share.free_symbols - {S}
    v = sp.Symbol("v", positive=True)
    smooth = S * v - width / 2 * (v * sp.log(v) + (1 - v) * sp.log(1 - v))
    values = {S: sp.Rational(1, 3), width: sp.Rational(1, 5)}
    best = share.subs(values)
    assert abs(sp.N(best - (1 + sp.tanh(S / width).subs(values)) / 2, 20)) < 1e-15
    assert abs(sp.N(smooth.diff(v).subs(values).subs(v, best), 20)) < 1e-15
    assert abs(sp.N((most - smooth.subs(v, share)).subs(values), 20)) < 1e-15
    narrow = most.subs({S: sp.Rational(3, 10), width: sp.Rational(1, 50)})
    assert abs(sp.N(narrow - sp.Rational(3, 10), 15, maxn=300)) < 1e-12


# --- elements of a state ---------------------------------------------------------------------------------

component = st.floats(-2, 2).map(lambda x: round(x, 3))


@settings(max_examples=60, deadline=None)
@given(st.tuples(*[component] * 3), st.tuples(*[component] * 3), st.floats(0, 6), st.floats(0.5, 4))
def test_the_elements_of_a_state_give_the_state_back_also_when_turned(position, velocity, angle, gravity):
    R, V = np.array(position), np.array(velocity)
    r = np.linalg.norm(R)
    if r < 0.1:
        return
    V = V * min(1.0, 1.2 * math.sqrt(gravity / r) / (np.linalg.norm(V) + 1e-9))
    for found in (one := Elements.from_state(R, V, gravity), one.turned(angle)):
        assert np.allclose(found.position, R, atol=1e-12)
        assert np.allclose(found.velocity, V, atol=1e-12)
        assert abs(float(found.relation)) < 1e-12
    assert float(one.Q) == pytest.approx(-gravity / (V @ V / 2 - gravity / r), rel=1e-10)


def test_elements_broadcast():
    many = Elements.from_state(np.tile([1.0, 0.2, -0.4], (5, 2, 1)), [0.1, 0.8, 0.3])
    assert many.A.shape == (5, 2, 4) and many.Q.shape == (5, 2)
    assert many.at(np.zeros((3, 1, 1))).position.shape == (3, 5, 2, 3)


def test_states_on_the_first_axis_have_elements():
    for sign in (1, -1):
        found = Elements.from_state([sign * 1.0, 0, 0], [0.1, 0.7, 0.2])
        assert np.allclose(found.position, [sign, 0, 0], atol=1e-15)


# --- shooting --------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("duration", [None, 5.0])
@pytest.mark.parametrize(
    "law",
    [
        Law("square", 0.01, math.inf),
        Law("square", 0.01, 0.08),
        Law("fuel", 0.01, 0.3),
        Law("fuel", 0.01, 0.3, 0.2),
    ],
    ids=["unbounded", "bounded", "jumping", "smoothed"],
)
def test_the_jacobian_is_the_derivative_of_the_equations(law, duration):
    """This holds across switches too, where the derivatives are discontinuous."""
    setting, h = ElementsSetting(problem(20).scaled, law, duration), 1e-6
    point = np.append(COSTATES * (1.0 if law.kind == "fuel" else 0.1), 2.2)
    exact = equations(setting, point)
    columns = [
        (equations(setting, point + h * x).residual - equations(setting, point - h * x).residual) / (2 * h)
        for x in np.eye(7)
    ]
    assert np.allclose(np.array(columns).T, exact.jacobian, rtol=1e-6, atol=1e-6)
    assert (len(exact.flight.pieces) > 1) == (law.peak < 1 and not law.width)


def test_both_integrators_give_the_same_flight():
    law = Law("fuel", 0.0, 0.3)
    taylor, classic = (fly_elements(problem(20).scaled, COSTATES, 1.9, law, use) for use in (True, False))
    assert len(taylor.pieces) == len(classic.pieces) > 1
    assert np.allclose(taylor.switch_angles, classic.switch_angles, atol=1e-10)
    assert np.allclose(taylor.end, classic.end, atol=1e-9)
    assert np.allclose(taylor.slopes, classic.slopes, rtol=1e-7, atol=1e-7)


# --- the first functional --------------------------------------------------------------------------------


def by_the_axes(given: Rendezvous) -> Extremal:
    """The solution by the equations in the axes eta.

    Without a bound and with a fixed duration it is the extremal by `cold_start`, otherwise that of `solve`.
    """
    if given.free or given.peak < math.inf:
        return solve(given)
    setting = shooting.Setting(given.scaled, 1.0, math.inf, duration=given.scaled.duration)
    return Extremal(given, cold_start(setting))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("degrees", "changes"),
    [
        (0, {"duration": 6.0}),
        (60, {"duration": 4.0}),
        (20, {"time_weight": 0.01, "peak": 0.12}),
    ],
)
def test_the_solution_in_the_elements_is_an_extremal_found_in_the_axes_eta(degrees, changes):
    """Both solutions are found from coasting, independently of each other."""
    given = problem(degrees, **changes)
    mine = solve_in_elements(given)
    other = by_the_axes(given)
    same = min(
        [other, *other.others], key=lambda x: abs(x.duration - mine.duration) + abs(x.cost - mine.cost)
    )
    assert mine.cost == pytest.approx(same.cost, rel=1e-10)
    assert mine.duration == pytest.approx(same.duration, rel=1e-10)
    assert mine.certificate.holds(1e-10)
    t = np.linspace(0, mine.duration, 7)
    attitude = same.state(np.clip(t, 0, same.duration))[:, 4:]
    assert np.allclose(
        mine.control(t), rotated(same.control(np.clip(t, 0, same.duration)), attitude), atol=1e-9
    )
    assert np.allclose(
        np.linalg.norm(mine.elements(t).position, axis=1), same.state(t.clip(0, same.duration))[:, 0]
    )


def test_the_transformed_costates_of_a_solution_are_a_solution_in_the_elements():
    """The ellipses are inclined, the units km and s, and the craft's attitude is not the unit quaternion."""
    craft = Chaser(7000.0, 0.3, 54000.0, [0.6, 0, 0.8, 0])
    target = Orbit.from_angles(9000.0, 0.2, 0.3, 1.3, 0.5, 0.6)
    given = Rendezvous(craft, target, 0.0, 1.0, math.inf, gravity=398600.0, duration=5000.0)
    best = by_the_axes(given)
    mine = solve_in_elements(given, start=best)
    assert mine.cost == pytest.approx(best.cost, rel=1e-11)
    assert mine.certificate.holds(1e-9)
    start = mine.elements(0.0)
    attitude = np.array([0.6, 0, 0.8, 0])
    assert np.allclose(start.position[0], rotated(np.array([7000.0, 0, 0]), attitude), rtol=1e-12)
    assert np.allclose(start.velocity[0], rotated(np.array([0.3, 54000 / 7000, 0]), attitude), atol=1e-11)


def test_the_certificate_detects_a_wrong_costate():
    mine = solve_in_elements(problem(20, duration=6.0))
    moved = mine.root.unknowns + 1e-6 * np.eye(7)[2]
    wrong = Root(moved, equations(ElementsSetting(mine.problem.scaled, mine.flight.law, 1.0), moved))
    assert mine.certificate.holds(1e-10) and not certify(wrong, free=False).holds(1e-8)


# --- the second functional -------------------------------------------------------------------------------

LEAP = problem(20, peak=0.2, duration=6.0)


@pytest.fixture(scope="module")
def fuel():
    return least_fuel(LEAP)


@pytest.mark.slow
def test_the_thrust_of_least_fuel_is_on_or_off_and_switches_where_n_is_alpha2(fuel):
    assert set(fuel.modes) == {"saturated", "coast"} and len(fuel.modes) >= 3
    assert fuel.certificate.holds(1e-10) and float(fuel.certificate.switching) < 1e-12
    size = np.linalg.norm(fuel.switching(fuel.switch_times), axis=1)
    assert size == pytest.approx(LEAP.energy_weight, abs=1e-10)
    t = np.linspace(0, fuel.duration, 301)
    thrust, n = np.linalg.norm(fuel.control(t), axis=1), np.linalg.norm(fuel.switching(t), axis=1)
    assert np.allclose(thrust, np.where(n > 1, LEAP.peak, 0.0), atol=1e-14)
    edges = np.array([0.0, *fuel.switch_times, fuel.duration])
    on = [mode == "saturated" for mode in fuel.modes]
    assert fuel.cost == pytest.approx(LEAP.peak * np.diff(edges)[on].sum(), rel=1e-12)


def test_the_fuel_of_the_smoothed_extremals_decreases_to_that_of_the_switching_one(fuel):
    spent = [float(root.flight.end[17]) * fuel.value for root in fuel.smoothed]
    assert spent == sorted(spent, reverse=True) and fuel.cost < spent[-1] < 1.03 * fuel.cost


def test_each_functional_is_smaller_along_its_own_extremal(fuel):
    first = solve_in_elements(LEAP)
    t = np.linspace(0, 6, 20001)
    other = np.linalg.norm(first.control(t), axis=1)
    middle = (other[1:] + other[:-1]) / 2 * np.diff(t)
    assert fuel.cost < float(middle.sum())
    assert first.cost < LEAP.peak * fuel.cost


@pytest.mark.slow
@pytest.mark.parametrize(("inclination", "time_weight", "peak"), [(0, 0.01, 0.15), (5, 0.2, 0.1)])
def test_a_solution_of_free_duration_obeys_the_law_at_the_end(inclination, time_weight, peak):
    given = problem(inclination, time_weight=time_weight, energy_weight=1, peak=peak)
    free = least_fuel(given)
    assert free.certificate.holds(1e-10)
    assert set(free.modes) == {"saturated", "coast"}
    n = np.linalg.norm(free.switching(free.duration), axis=1)[0]
    assert given.peak * (n - 1) == pytest.approx(time_weight, rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("law", [Law("fuel", 0.1, 0.1), Law("square", 0.01, 0.3)])
def test_the_mode_of_every_arc_is_that_of_the_switching_function(law):
    random = np.random.default_rng(5)
    level = 1.0 if law.kind == "fuel" else 2 * law.peak
    switches = 0
    for costates in random.normal(size=(40, 6)) * random.choice([0.2, 0.4, 0.8], (40, 1)):
        try:
            flight = fly_elements(LEAP.scaled, costates, 4.0, law)
        except pontryagin.NotConverged:
            continue
        ends = [*flight.switch_angles, flight.phi]
        for piece, end in zip(flight.pieces, ends, strict=True):
            inside = np.linspace(piece.begin, end, 202)[1:-1]
            size = np.linalg.norm(switching(flight.sample(inside), inside), axis=1)
            assert np.all((size > level) == (piece.mode == "saturated"))
        switches += len(flight.switch_angles)
    assert switches > 10


@pytest.mark.slow
def test_no_step_of_the_integrator_misses_a_burn_of_a_nearly_discontinuous_thrust():
    law = Law("fuel", 0.0, 0.2, width=0.02)
    random = np.random.default_rng(3)
    compared = 0
    for costates in random.normal(size=(40, 6)) * random.choice([0.2, 0.4, 0.8], (40, 1)):
        try:
            exact, rough = (fly_elements(LEAP.scaled, costates, 3.0, law, rough=r).end for r in (False, True))
        except pontryagin.NotConverged:
            continue
        assert_allclose(rough, exact, atol=1e-3 * np.abs(exact).max())  # a missed burn: 1 or more
        compared += 1
    assert compared > 20


@dataclass(frozen=True)
class Level:
    """A setting that holds only the value required of a function of the first unknown."""

    value: float
    rough: bool = False


@pytest.fixture
def bent(monkeypatch):
    """Replace the shooting equations: a given function of the first unknown has a value, the others are 1."""

    def bend(function, slope):
        def equations(setting, unknowns):
            residual = np.append(function(unknowns[0]) - setting.value, unknowns[1:] - 1)
            jacobian = np.diag([slope(unknowns[0]), *np.ones(6)])
            return ElementsEquations(None, residual, jacobian)

        monkeypatch.setattr(elements_shooting, "equations", equations)

    return bend


def lying_at(value, x):
    unknowns = np.append(x, np.ones(6))
    return Root(unknowns, elements_shooting.equations(Level(value), unknowns))


def test_a_family_is_followed_around_its_folds(bent):
    """x^3 - x = value: from -1.5 to 1.5 the curve turns back at -1/sqrt(3) and at 1/sqrt(3)."""
    bent(lambda x: x**3 - x, lambda x: 3 * x**2 - 1)
    root = elements_shooting.lead_round(Level, lying_at(-1.875, -1.5), -1.875, 1.875)
    assert root.unknowns[0] == pytest.approx(1.5, abs=1e-12)


def test_a_family_that_does_not_reach_the_value_is_not_converged(bent):
    bent(lambda x: -(x**2), lambda x: -2 * x)
    with pytest.raises(pontryagin.NotConverged, match="could not be followed"):
        elements_shooting.lead_round(Level, lying_at(-1.0, 1.0), -1.0, 1.0)


def test_a_residual_above_1e_6_is_not_converged_however_large_the_condition_number(bent):
    bent(lambda x: x**2 + 0.5, lambda x: 2 * x)
    with pytest.raises(pontryagin.NotConverged):
        elements_shooting.meet(Level(0.0), np.append(1e-9, np.ones(6)))


@pytest.mark.slow
def test_the_direct_method_agrees_and_its_error_shrinks_with_the_mesh(fuel):
    pytest.importorskip("casadi")
    from pontryagin.rendezvous.judge.collocation import direct

    errors = [abs(direct(LEAP, 6.0, 0.6, n, fuel=True).cost / fuel.cost - 1) for n in (20, 80)]
    assert errors[1] < 1e-4 and errors[1] < errors[0]


BAD = {
    "peak must be finite, got inf: without a bound": lambda: least_fuel(problem(0, duration=6.0)),
    "energy_weight must be greater than 0": lambda: least_fuel(
        problem(0, time_weight=1, energy_weight=0, peak=1)
    ),
    "velocity must leave the energy": lambda: Elements.from_state([1, 0, 0], [0, 2, 0]),
    "position must not be the centre": lambda: Elements.from_state([0, 0, 0], [0, 1, 0]),
    "phi must be a number": lambda: Elements([1, 0, 0, 0], [0, 0, 0, 1], math.nan),
    "A must be an array": lambda: Elements([1, 0, 0], [0, 0, 0, 1]),
    "gravity must be": lambda: Elements.from_state([1, 0, 0], [0, 1, 0], gravity=-1.0),
}


@pytest.mark.parametrize("message", BAD)
def test_the_error_of_a_wrong_argument_names_it(message):
    with pytest.raises(ValueError, match=message):
        BAD[message]()


def test_least_energy_or_fuel_in_free_time_is_infeasible():
    for solver in (solve_in_elements, least_fuel):
        with pytest.raises(pontryagin.Infeasible, match="longer flight is always cheaper"):
            solver(problem(20, peak=0.2))
        with pytest.raises(TypeError, match="problem must be of type Rendezvous"):
            solver(None)
