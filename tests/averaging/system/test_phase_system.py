"""Phase systems: the derived quantities, and invalid arguments that are refused."""

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from pontryagin.averaging import (
    Box,
    PhaseSystem,
    Quadratic,
    kepler,
    smooth_example,
    solve_averaged,
    spin_down,
)

a, b, x, u, v, k = sp.symbols("a b x u v k", real=True)
GOOD = {
    "f": [u * sp.cos(x) + a, u - b],
    "omega": sp.exp(a),
    "control_set": Quadratic(),
    "slow": [a, b],
    "control": [u],
    "phase": x,
    "target": [a - 1],
}
coordinates = st.floats(0.2, 2).map(lambda z: round(z, 3))


def test_the_hamiltonian_splits_the_rates_at_the_control():
    """h* is that of (1.4) and (1.5) for a system of the form (1.1)."""
    system = PhaseSystem(**GOOD, phase_rate=u * sp.sin(x) + a, running_cost=1 + a**2)
    p, q = system.costates, system.phase_costate
    s = p[0] * sp.cos(x) + p[1] + q * sp.sin(x)
    expected = p[0] * a - p[1] * b + q * a - 1 - a**2 + s**2 / 4
    assert sp.expand(system.hamiltonian - expected) == 0
    assert system.rate == sp.exp(a)
    assert list(system.gain) == [sp.cos(x), 1] and list(system.drift) == [a, -b]


@pytest.mark.slow
@given(st.tuples(*[coordinates] * 6), st.floats(-3, 3))
def test_no_control_does_better_than_the_maximiser(values, other):
    """The maximiser is that of (1.5)."""
    system = PhaseSystem(**GOOD | {"control_set": Box([2])}, phase_rate=u * sp.sin(x))
    at = dict(zip((a, b, x, *system.costates, system.phase_costate), values, strict=True))

    def whole(control):
        rates = (*GOOD["f"], u * sp.sin(x))
        pulls = (*system.costates, system.phase_costate)
        total = sum(rate * pull for rate, pull in zip(rates, pulls, strict=True)) - 1
        return float(total.subs(u, control).subs(at))

    best = float(system.maximiser[0].subs(at))
    assert whole(best) == pytest.approx(float(system.hamiltonian.subs(at)), rel=1e-12)
    assert whole(np.clip(other, -2, 2)) <= whole(best) + 1e-12


@pytest.mark.parametrize(
    ("change", "error", "message"),
    [
        ({"f": [u * sp.cos(x) + k, u]}, ValueError, r"f\[0\] holds unknown symbols k"),
        ({"f": [sp.Symbol("a") * u, u]}, ValueError, "same name differ"),
        ({"f": [u**2, u]}, ValueError, r"f\[0\] must be affine in the control"),
        ({"f": [u, u * sp.cos(x / 2)]}, ValueError, r"f\[1\] must be 2 pi-periodic"),
        ({"f": [u * x, u]}, ValueError, r"f\[0\] must be 2 pi-periodic"),
        ({"f": [u]}, ValueError, "f must hold one rate for each of 2 slow variables, got 1"),
        ({"f": u}, TypeError, "f must be a sequence"),
        ({"f": ["u", u]}, TypeError, r"f\[0\] must be a SymPy expression"),
        ({"f": [None, u]}, TypeError, r"f\[0\] must be a SymPy expression"),
        ({"f": [u * sp.I, u]}, ValueError, r"f\[0\] must be real"),
        ({"f": [u * float("nan"), u]}, ValueError, r"f\[0\] must be finite"),
        ({"omega": sp.cos(x)}, ValueError, "omega holds unknown symbols x"),
        ({"omega": -1}, ValueError, "omega must be positive"),
        ({"omega": 0}, ValueError, "omega must be positive"),
        ({"omega": None}, ValueError, "exactly one of omega and anomaly_rate"),
        ({"anomaly_rate": a}, ValueError, "exactly one of omega and anomaly_rate"),
        ({"omega": None, "anomaly_rate": a, "weight": 1 + sp.cos(x)}, ValueError, "weight must not be given"),
        ({"slow": [a, sp.Symbol("b")]}, ValueError, "slow must hold real symbols: write"),
        ({"slow": [a, a]}, ValueError, "must be different symbols"),
        ({"slow": ["a", b]}, TypeError, "slow must hold SymPy symbols"),
        ({"control": []}, ValueError, "control must hold at least one symbol"),
        ({"phase": a}, ValueError, "must be different symbols"),
        ({"target": []}, ValueError, "target must hold 1 to 2"),
        ({"target": [a, b, a - b]}, ValueError, "target must hold 1 to 2"),
        ({"target": [a - sp.cos(x)]}, ValueError, r"target\[0\] holds unknown symbols x"),
        ({"terminal_cost": u}, ValueError, "terminal_cost holds unknown symbols u"),
        ({"running_cost": 1 + u**2}, ValueError, "running_cost holds unknown symbols u"),
        ({"phase_rate": u**3}, ValueError, "phase_rate must be affine"),
        ({"numbers": {a: 1.0}}, ValueError, "numbers must not hold slow"),
        ({"numbers": {k: float("inf")}}, ValueError, "k must be a number or an array and finite"),
        ({"numbers": {k: [1.0, 2.0], v: [1.0, 2.0, 3.0]}}, ValueError, "do not broadcast"),
        ({"numbers": [k]}, TypeError, "numbers must map symbols to numbers"),
    ],
)
def test_bad_input_is_refused_by_name(change, error, message):
    with pytest.raises(error, match=message):
        PhaseSystem(**GOOD | change)


def test_rates_that_only_look_nonlinear_are_taken():
    system = PhaseSystem(**GOOD | {"f": [(u + 1) ** 2 - u**2, u]})
    assert list(system.gain) == [2, 1] and list(system.drift) == [1, 0]


def orbit_elements(state):
    """Elements (E, K, xi) from (r, v_r, v_phi)."""
    r, v_r, v_phi = state
    E = (v_r**2 + v_phi**2) / 2 - 1 / r
    return np.array([E, r * v_phi, np.arctan2(r * v_r * np.sqrt(-2 * E), 1 + 2 * E * r)])


@pytest.mark.parametrize("thrust", [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)])
def test_keplers_rates_are_those_of_the_elements_along_the_flight(thrust):
    """The generated system agrees with numerical derivatives by Newton's equations in polar coordinates."""
    system = kepler(-0.5, 0.8, -0.35, 0.1).system
    state = np.array([1.3, 0.3, 0.7])
    r, v_r, v_phi = state
    free = np.array([v_r, v_phi**2 / r - 1 / r**2, -v_r * v_phi / r])
    pushed = np.array([0.0, *thrust])
    step = 1e-5

    def change(direction):
        ahead = [orbit_elements(state + i * step * direction) for i in (-2, -1, 1, 2)]
        return np.dot([1, -8, 8, -1], ahead) / (12 * step)

    E, K, xi = orbit_elements(state)
    at = {**dict(zip(system.slow, (E, K), strict=True)), system.phase: xi}
    at |= dict(zip(system.control, thrust, strict=True))
    rates = [float(rate.subs(at)) for rate in (*system.f, system.phase_rate)]
    np.testing.assert_allclose(rates, change(pushed), atol=1e-10)
    np.testing.assert_allclose([0, 0, float(system.rate.subs(at))], change(free), atol=1e-10)


@pytest.mark.parametrize("w", [(0.6, 0.5, 1.2), (0.6, -0.5, -1.2)])
@pytest.mark.parametrize("ratio", [0.6, 1.7])
def test_spin_down_turns_the_phase_forward_whatever_the_sense(w, ratio):
    """The rates agree with Euler's equations in body axes, the phase measured in the sense of rotation."""
    solution = spin_down(w, [1, 0.7, 0.4], ratio)
    system = solution.system
    controls, sense = np.array([0.3, -0.2, 0.1]), np.sign((ratio - 1) * w[2])
    free = np.array([(1 - ratio) * w[1] * w[2], (ratio - 1) * w[0] * w[2], 0.0])
    psi = sense * np.arctan2(w[1], w[0])
    assert float(solution.initial_phase) == pytest.approx(psi)

    def seen(rate):
        """(a', c', phase') from the rate of (w_x, w_y, w_z)."""
        square = np.hypot(w[0], w[1])
        along = (w[0] * rate[0] + w[1] * rate[1]) / square
        return np.array([along, rate[2], sense * (w[0] * rate[1] - w[1] * rate[0]) / square**2])

    numbers = {symbol: float(value) for symbol, value in system.numbers.items()}
    at = {**numbers, **dict(zip(system.control, controls, strict=True)), system.phase: psi}
    at |= dict(zip(system.slow, (np.hypot(w[0], w[1]), w[2]), strict=True))
    rates = [float(rate.subs(at)) for rate in (*system.f, system.phase_rate)]
    np.testing.assert_allclose(rates, seen(controls), atol=1e-14)
    np.testing.assert_allclose([0, 0, float(system.omega.subs(at))], seen(free), atol=1e-14)
    assert float(system.omega.subs(at)) > 0


def test_the_smooth_example_has_its_ripple():
    system = smooth_example(1.0, 2.0, ripple=0.5).system
    ripple = next(symbol for symbol in system.numbers if str(symbol) == "ripple")
    assert system.f[0] == system.control[0] + ripple * sp.cos(system.phase)


def test_rates_frequency_and_controls_may_be_given_in_order():
    rest = {name: GOOD[name] for name in ("slow", "control", "phase", "target")}
    system = PhaseSystem(GOOD["f"], GOOD["omega"], GOOD["control_set"], **rest)
    assert system.hamiltonian == PhaseSystem(**GOOD).hamiltonian


@pytest.mark.parametrize("value", [None, 3, Quadratic])
def test_a_control_set_is_asked_for(value):
    with pytest.raises(TypeError, match="control_set must be a set of controls"):
        PhaseSystem(**GOOD | {"control_set": value})


def test_an_expression_is_compared_over_a_turn_where_it_is_defined():
    """Roots are defined for negative energies alone; the second one in a small interval far from zero."""
    c = sp.Symbol("c", real=True)
    for root, end in ((sp.sqrt(-2 * c), -0.25), (sp.sqrt((c - 200) * (202 - c)), 201.5)):
        given = {"omega": 1, "control_set": Quadratic(), "slow": [c], "control": [u], "phase": x}
        once = PhaseSystem(f=[u * (2 + root * sp.cos(x))], target=[c - end], **given)
        assert solve_averaged(once, [end - 0.25]).certificate.holds(1e-10)
        with pytest.raises(ValueError, match="2 pi-periodic"):
            twice = PhaseSystem(f=[u * (2 + root * sp.cos(x / 2))], target=[c - end], **given)
            solve_averaged(twice, [end - 0.25])


def test_every_member_of_a_stack_is_compared_over_a_turn():
    changed = {"f": [u * (2 + sp.cos(k * x)), u], "numbers": {k: [1.0, 1.0, 1.5]}}
    with pytest.raises(ValueError, match=r"f\[0\] must be 2 pi-periodic"):
        PhaseSystem(**GOOD | changed)
    PhaseSystem(**GOOD | changed | {"numbers": {k: [1.0, 2.0, 3.0]}})
