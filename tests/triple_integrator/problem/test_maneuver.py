"""The manoeuvre: its moments are those of every control that performs it; wrong arguments raise errors."""

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from independent import propagate
from pontryagin.triple_integrator import Maneuver
from strategies import angles, maneuvers, stacked, states

t = sp.Symbol("t")
ORIGIN, AHEAD = [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]


@given(maneuvers(), st.tuples(angles, angles, angles))
def test_the_moments_are_those_of_the_control_that_reaches_the_target(maneuver, polynomial):
    """(1.9): SciPy integrates u(s) = p0 + p1 s + p2 s^2; its moments must be c for the state reached."""
    end = float(maneuver.tf)
    reached, largest = propagate(maneuver, lambda time: np.polynomial.Polynomial(polynomial)(end - time))
    flown = Maneuver(maneuver.x0, reached, maneuver.tf, maneuver.t0, maneuver.disturbance)
    T = float(maneuver.duration)
    integrals = [
        [T ** (i + 3) / (2 * (i + 3)) for i in range(3)],
        [T ** (i + 2) / (i + 2) for i in range(3)],
        [T ** (i + 1) / (i + 1) for i in range(3)],
    ]
    assert_allclose(flown.moments, np.array(integrals) @ polynomial, atol=1e-10 * (1 + largest.max()))


@given(maneuvers())
def test_the_drift_starts_at_the_start_and_misses_the_target_by_the_moments(maneuver):
    drift = maneuver.drift([maneuver.t0, maneuver.tf])
    assert_allclose(drift[0], maneuver.x0, atol=1e-13)
    assert_allclose(maneuver.xf - drift[1], maneuver.moments, atol=1e-11)


@given(maneuvers())
def test_the_drift_is_the_motion_without_control(maneuver):
    """(1.3) for u = 0."""
    middle = float(maneuver.t0 + maneuver.duration / 3)
    early = Maneuver(maneuver.x0, maneuver.xf, middle, maneuver.t0, maneuver.disturbance)
    reached, largest = propagate(early, lambda time: 0.0)
    assert_allclose(maneuver.drift(middle)[0], reached, atol=1e-11 * (1 + largest.max()))


@given(maneuvers(), st.floats(-50, 50))
def test_only_the_duration_matters_when_the_force_is_constant(maneuver, shift):
    later = Maneuver(maneuver.x0, maneuver.xf, maneuver.tf + shift, maneuver.t0 + shift, maneuver.disturbance)
    assert_allclose(later.moments, maneuver.moments, rtol=1e-10, atol=1e-11)


def test_a_force_of_time_knows_when_the_manoeuvre_starts():
    """f = t from t0 to tf: the rate gains (tf^2 - t0^2)/2."""
    moments = Maneuver(ORIGIN, ORIGIN, 5.0, t0=3.0, disturbance=t).moments
    assert_allclose(moments, [-(5**3 / 6 - 3**3 / 6 - 2 * 3**2 / 2), -8.0, 0.0], rtol=1e-14)


def test_stacks_broadcast_ends_times_and_forces():
    m = Maneuver(
        np.zeros((4, 1, 3)), np.ones((3,)), np.full((5,), 2.0), t0=[0.0] * 5, disturbance=np.zeros((4, 1))
    )
    assert m.shape == (4, 5)
    assert m.moments.shape == (4, 5, 3)
    assert m.x0.shape == m.xf.shape == (4, 5, 3)
    assert m.tf.shape == m.t0.shape == m.duration.shape == (4, 5)
    assert m.drift([0.0, 1.0, 2.0]).shape == (4, 5, 3, 3)


@given(st.lists(maneuvers(), min_size=2, max_size=4))
def test_a_stack_has_the_moments_of_its_members(members):
    assert_allclose(stacked(members).moments, [m.moments for m in members], rtol=1e-14, atol=1e-14)


@pytest.mark.parametrize("shape", [(0,), (0, 3), (2, 0)])
@pytest.mark.parametrize("force", [None, 1.0, np.sin, sp.sin(t)])
def test_a_stack_of_none_has_no_moments(shape, force):
    assert Maneuver(np.zeros((*shape, 3)), AHEAD, 1.0, disturbance=force).moments.shape == (*shape, 3)


def test_it_cannot_be_changed_neither_by_name_nor_through_the_arrays_given():
    start = np.zeros(3)
    m = Maneuver(start, AHEAD, 1.0)
    with pytest.raises(AttributeError):
        m.tf = np.array(2.0)
    start[0] = 5.0
    assert m.x0[0] == 0.0
    assert m.moments[0] == 1.0


@pytest.mark.parametrize(
    ("changed", "error", "message"),
    [
        ({"x0": [0, np.nan, 0]}, ValueError, r"^x0 must be an array \(\.\.\., 3\) and finite, got nan"),
        ({"xf": [0, 0, -np.inf]}, ValueError, r"^xf .*finite, got -inf at index \(2,\)"),
        ({"x0": [0, 0]}, ValueError, r"^x0 .*got shape \(2,\)"),
        ({"xf": 1.0}, ValueError, r"^xf .*got shape \(\)"),
        ({"xf": "far"}, TypeError, "^xf .*'far'"),
        ({"x0": None}, TypeError, "^x0 .*None"),
        ({"x0": [1j, 0, 0]}, TypeError, "^x0 .*complex"),
        ({"tf": 0.0}, ValueError, "^tf must be later than t0, got t0 = 0.0 and tf = 0.0"),
        ({"tf": 1.0, "t0": 2.0}, ValueError, "^tf must be later than t0, got t0 = 2.0 and tf = 1.0"),
        ({"tf": [1.0, -1.0]}, ValueError, "^tf must be later than t0, got t0 = 0.0 and tf = -1.0"),
        ({"tf": np.nan}, ValueError, "^tf .*finite, got nan"),
        ({"t0": -np.inf}, ValueError, "^t0 .*finite, got -inf"),
        ({"tf": "soon"}, TypeError, "^tf .*'soon'"),
        (
            {"x0": np.zeros((2, 3)), "tf": [1.0, 2.0, 3.0]},
            ValueError,
            r"do not broadcast: x0 \(2,\).* tf \(3,\)",
        ),
    ],
)
def test_what_is_no_manoeuvre_is_refused(changed, error, message):
    with pytest.raises(error, match=message) as failure:
        Maneuver(**({"x0": ORIGIN, "xf": AHEAD, "tf": 1.0} | changed))
    assert failure.value.argument in changed


@pytest.mark.parametrize("outside", [-0.01, 1.01])
def test_times_outside_are_refused(outside):
    with pytest.raises(ValueError, match=r"^t must lie between"):
        Maneuver(ORIGIN, AHEAD, 1.0).drift([0.5, outside])


@given(states())
def test_nothing_to_do_has_no_moments(start):
    coasting = Maneuver(start, [0, 0, 0], 2.0).drift(2.0)[0]
    assert_allclose(Maneuver(start, coasting, 2.0).moments, 0.0, atol=1e-13)


@given(maneuvers(), st.floats(-50, 50), st.booleans())
def test_a_manoeuvre_from_lists_equals_one_from_a_stack(given, force, in_lists):
    """The first is made by native code where there is some, the second by NumPy."""
    ends = [x.tolist() if in_lists else x for x in (given.x0, given.xf)]
    one = Maneuver(*ends, float(given.tf), float(given.t0), disturbance=force)
    stack = Maneuver(*([x] for x in ends), [given.tf], [given.t0], disturbance=[force])
    for name in ("moments", "x0", "xf", "tf", "t0", "duration"):
        assert getattr(one, name).tobytes() == getattr(stack, name)[0].tobytes()
        assert np.shape(getattr(one, name)) == getattr(stack, name).shape[1:]
    assert one.disturbance is force and one.drift(one.tf).tolist() == stack.drift(stack.tf)[0].tolist()
