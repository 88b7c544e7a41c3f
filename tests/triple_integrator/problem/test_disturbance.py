"""The integrals of every kind of disturbance against closed forms and SciPy's quadrature."""

import copy
import pickle

import numpy as np
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from scipy.integrate import quad

from pontryagin import NotConverged
from pontryagin.triple_integrator import Maneuver
from pontryagin.triple_integrator.problem.disturbance import integrals

t = sp.Symbol("t")
START, END = np.array(-0.5), np.array(2.0)

ROUNDING = 1e-15
"""NumPy computes a sine alone and among others to within a unit of the last digit, not to the bit."""
SMOOTH = {
    "polynomial": 3 * t**2 - t + 1,
    "oscillating": sp.sin(5 * t) * sp.exp(-t / 3),
    "rational": 1 / (1 + t**2),
    "Gaussian": sp.exp(-(t**2) * 4),
    "sharp": 1 / (1 + 400 * (t - 1) ** 2),
    "no antiderivative": sp.exp(sp.sin(3 * t)),
    "no NumPy antiderivative": sp.cos(t**2 + 1) / (t + 3),
}
ROUGH = {
    "kink": (sp.Abs(t - sp.Rational(1, 3)), [1 / 3]),
    "step": (sp.Piecewise((1, t < sp.Rational(7, 10)), (-2, True)), [0.7]),
    "three pieces": (sp.Piecewise((t, t < 0), (1 - t, t < 1), (t**2, True)), [0.0, 1.0]),
    "Heaviside": (sp.Heaviside(t - sp.Rational(1, 3)) * t, [1 / 3]),
}


def by_quad(f, low, high, points=None):
    """g1 = int (high - tau) f and g2 = int f by SciPy."""
    kwargs = {"epsabs": 1e-13, "epsrel": 1e-12, "limit": 400}
    inner = [p for p in points or [] if low < p < high] or None
    g1, _ = quad(lambda tau: (high - tau) * f(tau), low, high, points=inner, **kwargs)
    g2, _ = quad(f, low, high, points=inner, **kwargs)
    return [g1, g2]


def whole(force, elapsed):
    """g1 and g2 of one interval after a time."""
    return force(np.array([elapsed]))[0]


def numeric(expression):
    f = sp.lambdify(t, expression, "numpy")
    return lambda tau: float(f(tau))


@pytest.mark.slow
@pytest.mark.parametrize("name", SMOOTH)
@pytest.mark.parametrize("kind", ["expression", "callable", "scalar callable"])
def test_smooth_forces_to_1e_12(name, kind):
    """g1 and g2 of (1.8)."""
    expression = SMOOTH[name]
    given_as = {
        "expression": expression,
        "callable": sp.lambdify(t, expression, "numpy"),
        "scalar callable": lambda tau: numeric(expression)(float(tau)),
    }[kind]
    exact = by_quad(numeric(expression), -0.5, 2.0)
    assert_allclose(whole(integrals(given_as, START, END), 2.5), exact, rtol=1e-12, atol=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("name", ROUGH)
@pytest.mark.parametrize("kind", ["expression", "callable"])
def test_rough_forces_to_1e_12(name, kind):
    expression, points = ROUGH[name]
    given_as = expression if kind == "expression" else numeric(expression)
    for end in (0.2, 2.0):
        exact = by_quad(numeric(expression), -0.5, end, points)
        assert_allclose(whole(integrals(given_as, START, END), end + 0.5), exact, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize(
    ("force", "exact"), [(sp.sqrt(t), [4 / 15, 2 / 3]), (np.sqrt, [4 / 15, 2 / 3]), (np.log, [-3 / 4, -1.0])]
)
def test_integrable_singularities_of_the_slope_and_of_the_value(force, exact):
    assert_allclose(whole(integrals(force, np.array(0.0), np.array(1.0)), 1.0), exact, rtol=1e-12)


def test_a_narrow_pulse_is_found():
    width, at = 1e-3, 0.4
    force = integrals(lambda s: np.exp(-(((s - at) / width) ** 2)), np.array(0.0), np.array(1.0))
    g1, g2 = whole(force, 1.0)
    assert_allclose([g1, g2], np.array([1 - at, 1]) * width * np.sqrt(np.pi), rtol=1e-12)


@given(st.floats(-0.5, 2.0))
def test_the_integrals_add_up(middle):
    """g2(t, r) + g2(r, s) = g2(t, s) and g1(t, s) = g1(t, r) + (t - r) g2(r, s) + g1(r, s)."""

    def f(s):
        return np.cos(3 * s) + np.abs(s - 0.3)

    if middle in (START, END):
        return
    both = integrals(f, START, END)
    first, rest = whole(both, middle + 0.5), whole(integrals(f, np.array(middle), END), 2.0 - middle)
    assert_allclose(whole(both, 2.5)[1], first[1] + rest[1], atol=1e-13)
    assert_allclose(whole(both, 2.5)[0], first[0] + (2.0 - middle) * first[1] + rest[0], atol=1e-13)


@pytest.mark.parametrize("force", [None, 2, 2.0, np.float32(2), np.array(2.0), sp.Integer(2), lambda s: 2.0])
def test_every_way_to_give_a_constant(force):
    level = 0.0 if force is None else 2.0
    result = whole(integrals(force, START, END), 2.5)
    assert_allclose(result, [level * 2.5**2 / 2, level * 2.5], rtol=1e-14)


def test_constants_of_a_stack():
    m = Maneuver(np.zeros((2, 3)), np.zeros(3), 2.0, disturbance=[1.0, -3.0])
    assert_allclose(m.moments, [[-2.0, -2.0, 0.0], [6.0, 6.0, 0.0]])
    assert m.drift([1.0]).shape == (2, 1, 3)


def test_a_stack_of_intervals_shares_one_force():
    starts, ends = np.array([0.0, 1.0]), np.array([1.0, 3.0])
    stacked = integrals(np.cos, starts, ends)((ends - starts)[:, None])[:, 0]
    for row, low, high in zip(stacked, starts, ends, strict=True):
        assert_allclose(row, by_quad(np.cos, low, high), rtol=1e-12)


def test_a_symbol_called_t_may_carry_any_assumption():
    positive = sp.Symbol("t", positive=True)
    assert_allclose(whole(integrals(positive**2, START, END), 2.5)[1], (8 + 0.125) / 3, rtol=1e-13)


@pytest.mark.parametrize(
    ("force", "error", "message"),
    [
        ("strong", TypeError, "'strong'"),
        ({}, TypeError, "{}"),
        (True, TypeError, "True"),
        (object(), TypeError, "object"),
        (np.nan, ValueError, "finite, got nan"),
        ([1.0, np.inf], ValueError, "finite, got inf"),
        ([[1.0], [1.0, 2.0]], ValueError, "ragged"),
        (lambda s: np.nan, ValueError, r"finite: f\(.*\) = nan"),
        (lambda s: np.where(np.asarray(s) > 0.5, np.inf, 1.0), ValueError, r"finite: f\(.*\) = inf"),
        (lambda s: np.zeros((3, 3)), ValueError, r"one number for each time: got shape \(3, 3\)"),
        (lambda s: np.zeros((np.size(s), 1)), ValueError, r"one number for each time: got shape \(225, 1\)"),
        (lambda s: np.array([1.0]), ValueError, r"one number for each time: got shape \(1,\)"),
        (lambda s: "much", TypeError, "returns a number: got 'much'"),
        (lambda s: 1j, TypeError, "returns a number: got 1j"),
        (lambda s: 1j * np.asarray(s), TypeError, "returns a number"),
        (lambda: 1.0, TypeError, "takes a time"),
        (lambda s, r: s, TypeError, "takes a time"),
        (sp.Symbol("a") * t, ValueError, "in t alone, got symbols a"),
        (sp.I * t, TypeError, "complex"),
        (sp.Matrix([t, t]), TypeError, "real expression"),
        (t > 0, TypeError, "real expression"),
        (sp.zoo, TypeError, "real expression"),
        (sp.Function("g")(t), ValueError, "NumPy evaluates, got g"),
        (1 / (t - sp.Rational(1, 2)), ValueError, "finite"),
        (sp.Piecewise((1, t < sp.Rational(1, 2))), ValueError, "finite"),
    ],
)
def test_what_is_no_force_is_refused_when_the_manoeuvre_is_made(force, error, message):
    with pytest.raises(error, match=f"^disturbance.*{message}"):
        Maneuver([0, 0, 0], [1, 0, 0], 1.0, disturbance=force)


@pytest.mark.parametrize("force", [1 / t, lambda s: 1 / s, lambda s: np.sign(np.sin(1e9 * s))])
def test_what_cannot_be_integrated_says_so(force):
    with pytest.raises(NotConverged, match=r"^disturbance is not integrable to 1e-13 near t = "):
        Maneuver([0, 0, 0], [1, 0, 0], 1.0, disturbance=force)


@pytest.mark.filterwarnings("ignore:divide by zero")
@pytest.mark.parametrize("pole", [0.3, 1 / 3, 0.77])
def test_a_pole_is_refused_whether_its_time_is_met_or_not(pole):
    with pytest.raises((NotConverged, ValueError), match=r"^disturbance (is not integrable|must be finite)"):
        Maneuver([0, 0, 0], [1, 0, 0], 1.0, disturbance=lambda s: 1 / (s - pole))


def test_an_error_inside_the_users_function_is_not_hidden():
    with pytest.raises(ZeroDivisionError):
        Maneuver([0, 0, 0], [1, 0, 0], 1.0, disturbance=lambda s: 1 / 0)


def test_a_feature_of_one_percent_is_seen_wherever_it_is():
    m = Maneuver([0, 0, 0], [0, 0, 0], 2.0, disturbance=lambda s: np.where(abs(s - 1.0628) < 0.05, 1.0, 0.0))
    assert_allclose(m.moments[1], -0.1, rtol=1e-12)
    for at in np.random.default_rng(5).uniform(0.01, 0.99, 60):
        pulse = integrals(
            lambda s, at=at: np.where(abs(s - at) < 0.005, 1.0, 0.0), np.array(0.0), np.array(1.0)
        )
        assert_allclose(whole(pulse, 1.0)[1], 0.01, rtol=1e-10)


@pytest.mark.slow
def test_an_integral_of_sympy_is_done_or_refused():
    x = sp.Symbol("x")
    force = sp.Integral(sp.sin(x), (x, 0, t))
    assert_allclose(whole(integrals(force, START, END), 2.5)[1], 2.5 - np.sin(2) - np.sin(0.5), rtol=1e-12)
    with pytest.raises(ValueError, match=r"^disturbance must be an expression that NumPy evaluates"):
        Maneuver([0, 0, 0], [1, 0, 0], 1.0, disturbance=sp.Integral(sp.exp(-(x**2) / (1 + x**4)), (x, 0, t)))


def test_a_stack_is_its_members_whatever_the_others_are():
    """An interval of 40 with values up to 1e17 beside one of 1e-3, and ten thousand far from zero."""

    def rough(s):
        return np.sin(1e4 * s) + np.exp(s)

    ends = np.array([1e-3, 40.0, 2.0])
    together = Maneuver([0, 0, 0], [0, 0, 0], ends, disturbance=rough)
    alone = [Maneuver([0, 0, 0], [0, 0, 0], end, disturbance=rough).moments for end in ends]
    assert_array_equal(together.moments, alone)

    starts = np.arange(1e4)
    many = Maneuver(np.zeros(3), [1, 0, 0], starts + 1, starts, disturbance=lambda s: 1 + 0.1 * np.sin(s))
    exact = 1 + 0.1 * (np.cos(starts) - np.cos(starts + 1))
    assert_allclose(many.moments[:, 1], -exact, rtol=1e-12)
    for i in (0, 17, 9999):
        one = Maneuver(np.zeros(3), [1, 0, 0], starts[i] + 1, starts[i], disturbance=many.disturbance)
        assert_allclose(many.moments[i], one.moments, rtol=ROUNDING)
    assert_allclose(many.drift(starts[:, None] + 0.5)[17], one_drift(many, 17), rtol=ROUNDING)


def one_drift(many, i):
    """The drift of a member of a stack, alone, half a unit of time after its start."""
    one = Maneuver(many.x0[i], many.xf[i], many.tf[i], many.t0[i], disturbance=many.disturbance)
    return one.drift(many.t0[i] + np.array([0.5]))


def test_a_feature_of_one_percent_of_a_member_is_seen_beside_longer_members():
    def pulse(s):
        return np.where(np.abs(s - 0.5137) < 0.005, 1.0, 0.0)

    together = Maneuver([0, 0, 0], [0, 0, 0], [1.0, 100.0], disturbance=pulse)
    assert_allclose(together.moments[0], [-0.01 * (1 - 0.5137), -0.01, 0], rtol=1e-9)


def rectangle(low, high):
    """A pulse of area 1 between two times."""
    return lambda s: np.where((s >= low) & (s < high), 1 / (high - low), 0.0)


@pytest.mark.parametrize("width", [1e-3, 1e-6, 1e-9, 1e-12])
@pytest.mark.parametrize("kind", ["rectangle", "bump"])
def test_a_pulse_that_is_told_is_integrated_wherever_it_is(width, kind):
    rng = np.random.default_rng(6)
    for T in (1e-3, 1.0, 2e5):
        for at in rng.uniform(0, 1 - width, 6) * T:
            low, high = at, at + width * T
            middle, half = (low + high) / 2, (high - low) / 2
            shapes = {
                "rectangle": (rectangle(low, high), 1.0),
                "bump": (lambda s, m=middle, h=half: np.maximum(0.0, 1 - ((s - m) / h) ** 2), half * 4 / 3),
            }
            force, area = shapes[kind]
            m = Maneuver([0, 0, 0], [0, 0, 0], T, disturbance=force, edges=[high, low])
            rtol = 1e-12 if kind == "rectangle" else max(1e-12, 1e-15 / width)
            assert_allclose(m.moments[:2], [-area * (T - middle), -area], rtol=rtol)


def test_edges_of_a_stack_are_shared_or_each_members_own():
    ends, width = np.array([1.0, 4.0, 1e4]), 1e-9
    at = ends / np.pi
    own = np.stack([at, at * (1 + width)], axis=-1)

    def pulses(s):
        return np.sum([rectangle(*pair)(s) for pair in own], axis=0)

    expected = -np.array([1.0, 2.0, 3.0])
    shared = Maneuver([0, 0, 0], [0, 0, 0], ends, disturbance=pulses, edges=own.ravel())
    each = Maneuver([0, 0, 0], [0, 0, 0], ends, disturbance=pulses, edges=[own.ravel()[::-1]] * 3)
    assert_allclose(shared.moments[:, 1], expected, rtol=1e-12)
    assert_array_equal(shared.moments, each.moments)
    assert shared.edges.shape == (6,) and each.edges.shape == (3, 6)
    for i, end in enumerate(ends):
        alone = Maneuver([0, 0, 0], [0, 0, 0], end, disturbance=pulses, edges=own[: i + 1].ravel())
        assert_allclose(alone.moments, shared.moments[i], rtol=1e-14)
        assert_allclose(alone.drift(alone.tf)[0], -alone.moments, rtol=1e-12)
    between = Maneuver([0, 0, 0], [0, 0, 0], 1.0, disturbance=pulses, edges=own[0])
    assert_allclose(between.drift(own[0].mean())[0, 1], 0.5, rtol=1e-6)


def test_edges_outside_do_no_harm_and_those_of_the_function_count():
    plain = Maneuver([0, 0, 0], [0, 0, 0], 2.0, 1.0, disturbance=np.cos)
    for edges in ([-5.0], [0.5, 7.0], [1.0, 2.0], [1.0, 1.0, 2.0, 2.0]):
        told = Maneuver([0, 0, 0], [0, 0, 0], 2.0, 1.0, disturbance=np.cos, edges=edges)
        assert_array_equal(told.moments, plain.moments)
    pulse = rectangle(1.5, 1.5 + 1e-9)
    pulse.edges = (1.5 + 1e-9,)
    m = Maneuver([0, 0, 0], [0, 0, 0], 2.0, 1.0, disturbance=pulse, edges=[1.5])
    assert_allclose(m.moments[1], -1.0, rtol=1e-12)
    assert_allclose(m.edge_offsets, [0.5, 0.5 + 1e-9])


def test_an_edge_is_never_crossed_by_the_rounding_of_a_time():
    """Far from zero a pulse of three units in the last place has no times but those of the clock."""
    for low in np.random.default_rng(7).uniform(1e6, 1e6 + 1, 20):
        high = low + 3 * np.spacing(low)
        m = Maneuver([0] * 3, [0] * 3, 1e6 + 1, 1e6, disturbance=rectangle(low, high), edges=[low, high])
        assert_allclose(m.moments[1], -1.0, rtol=1e-12)


@pytest.mark.parametrize(
    ("edges", "error", "message"),
    [
        ([0.5, np.nan], ValueError, "finite, got nan"),
        (np.inf, ValueError, "finite, got inf"),
        (0.5, ValueError, r"must be an array \(k,\) or \(..., k\) of times, got 0.5"),
        ("soon", TypeError, "'soon'"),
        ([True], TypeError, "bool"),
        ([[0.1], [0.2]], ValueError, "do not broadcast"),
        (None, TypeError, "None"),
    ],
)
@pytest.mark.parametrize("force", [None, np.sin])
def test_what_are_no_edges_is_refused(edges, error, message, force):
    with pytest.raises(error, match=f"^edges.*{message}") as failure:
        Maneuver(np.zeros((3, 3)), [1, 0, 0], 1.0, disturbance=force, edges=edges)
    assert failure.value.argument == "edges"


def test_edges_are_part_of_the_value():
    one = Maneuver([0, 0, 0], [1, 0, 0], 1.0, disturbance=np.sin, edges=[0.5, 0.2, 0.5])
    assert one.edges.tolist() == [0.2, 0.5]
    assert one == Maneuver([0, 0, 0], [1, 0, 0], 1.0, disturbance=np.sin, edges=(0.2, 0.5))
    assert one != Maneuver([0, 0, 0], [1, 0, 0], 1.0, disturbance=np.sin)
    assert pickle.loads(pickle.dumps(one)) == one == copy.copy(one)
    assert hash(pickle.loads(pickle.dumps(one))) == hash(one)
    assert not one.edges.flags.writeable
