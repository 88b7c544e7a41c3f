"""Phase systems: what is derived from them, and what they refuse."""

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from pontryagin.averaging import Box, PhaseSystem, Quadratic, kepler, smooth_example, spin_down
from pontryagin.averaging.derivation import kepler as orbit
from pontryagin.averaging.derivation import kepler_phase, rigid_body

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
    system = PhaseSystem(**GOOD, phase_rate=u * sp.sin(x) + a, running_cost=1 + a**2)
    p, q = system.costates, system.phase_costate
    s = p[0] * sp.cos(x) + p[1] + q * sp.sin(x)
    expected = p[0] * a - p[1] * b + q * a - 1 - a**2 + s**2 / 4
    assert sp.expand(system.hamiltonian - expected) == 0
    assert system.rate == sp.exp(a)
    assert list(system.gain) == [sp.cos(x), 1] and list(system.drift) == [a, -b]


@given(st.tuples(*[coordinates] * 6), st.floats(-3, 3))
def test_no_control_does_better_than_the_maximiser(values, other):
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


def test_kepler_in_the_eccentric_anomaly_is_kepler_in_the_true_one():
    """The generated system against (3.6), at numbers."""
    system = kepler(-0.5, 0.8, -0.35, 0.1).system
    E, K = system.slow
    at = {E: -0.43, K: 0.9, system.phase: 1.1}
    plain = orbit.model()
    e = orbit.eccentricity().subs({orbit.energy: -0.43, orbit.momentum: 0.9})
    true = sp.Symbol("x", real=True)
    forward = kepler_phase.eccentric_of_true().subs({orbit.e: e, orbit.anomaly: true})
    true_value = sp.nsolve(forward - 1.1, true, 1.1)
    there = {orbit.energy: -0.43, orbit.momentum: 0.9, orbit.anomaly: true_value}
    for control, mine in zip(orbit.CONTROL, system.control, strict=True):
        for ours, theirs in zip(system.f, plain.rates, strict=True):
            assert float(ours.diff(mine).subs(at)) == pytest.approx(
                float(theirs.diff(control).subs(there)), rel=1e-12
            )
        along = forward.diff(true).subs(true, true_value) * plain.phase_rate.diff(control).subs(there)
        by_e = kepler_phase.eccentric_of_true().diff(orbit.e).subs({orbit.e: e, orbit.anomaly: true_value})
        rate = orbit.element_rates()[orbit.e].diff(control) / orbit.epsilon
        change = by_e * rate.subs({orbit.e: e, orbit.momentum: 0.9, orbit.anomaly: true_value})
        assert float(system.phase_rate.diff(mine).subs(at)) == pytest.approx(float(along + change), rel=1e-11)
    rate = forward.diff(true).subs(true, true_value) * plain.anomaly_rate.subs(there)
    assert float(system.rate.subs(at)) == pytest.approx(float(rate), rel=1e-12)


def test_spin_down_turns_the_phase_forward_whatever_the_sense():
    """A body with (d - 1) w_z < 0 in the mirrored phase against Euler's equations in the plain one."""
    solution = spin_down([0.6, 0.5, 1.2], [1, 0.7, 0.4], 0.6)
    system = solution.system
    numbers = {symbol: float(value) for symbol, value in system.numbers.items()}
    controls = (0.3, -0.2, 0.1)
    at = {**numbers, **dict(zip(system.control, controls, strict=True)), system.phase: 0.8}
    at |= dict(zip(system.slow, (0.7, 1.3), strict=True))
    plain = {rigid_body.a: 0.7, rigid_body.c: 1.3, rigid_body.d: 0.6, rigid_body.psi: -0.8}
    plain |= dict(zip(rigid_body.u, controls, strict=True))
    for ours, theirs in zip(system.f, rigid_body.slow_rates(), strict=True):
        assert float(ours.subs(at)) == pytest.approx(float(theirs.subs(plain)), rel=1e-13)
    assert float(system.phase_rate.subs(at)) == pytest.approx(-float(rigid_body.phase_rate().subs(plain)))
    assert float(system.omega.subs(at)) == pytest.approx(-float(rigid_body.anomaly_rate().subs(plain)))
    assert float(solution.initial_phase) == pytest.approx(-np.arctan2(0.5, 0.6))


def test_the_smooth_example_has_its_ripple():
    system = smooth_example(1.0, 2.0, ripple=0.5).system
    ripple = next(symbol for symbol in system.numbers if str(symbol) == "ripple")
    assert system.f[0] == system.control[0] + ripple * sp.cos(system.phase)
