"""Disturbances given as expressions: kinks and narrow features are found wherever they are, or refused."""

from itertools import pairwise

import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose, assert_array_equal
from scipy.integrate import quad

from pontryagin import NotConverged
from pontryagin.io import formula
from pontryagin.triple_integrator import Maneuver, minimum_peak

t = sp.Symbol("t")
R = sp.Rational


def of(force, tf=2.0, t0=0.0):
    """The manoeuvre from rest to rest at the origin under a disturbance."""
    return Maneuver([0, 0, 0], [0, 0, 0], tf, t0, disturbance=force)


def moment(force):
    """The integral of a disturbance over [0, 2]."""
    return -of(force).moments[1]


NARROW = {
    "Gaussian": (lambda x, w: sp.exp(-((x / w) ** 2)), np.sqrt(np.pi)),
    "soliton": (lambda x, w: sp.sech(x / w) ** 2, 2.0),
    "soliton by exponentials": (lambda x, w: 4 / (sp.exp(x / w) + sp.exp(-x / w)) ** 2, 2.0),
    "two-sided exponential": (lambda x, w: sp.exp(-sp.Abs(x) / w), 2.0),
    "triangle": (lambda x, w: sp.Max(0, 1 - sp.Abs(x) / w), 1.0),
    "rectangle": (lambda x, w: sp.Piecewise((1, sp.Abs(x) < w), (0, True)), 2.0),
    "conditions": (lambda x, w: sp.Piecewise((1, (x > -w) & (x <= w)), (0, True)), 2.0),
    "steps": (lambda x, w: sp.Heaviside(x + w) - sp.Heaviside(x - w), 2.0),
    "signs": (lambda x, w: (sp.sign(x + w) - sp.sign(x - w)) / 2, 2.0),
    "clipped parabola": (lambda x, w: sp.Max(1 - (x / w) ** 2, 0), 4 / 3),
    "least of two": (lambda x, w: sp.Min(1, sp.Abs(x) / w) - 1, -1.0),
}


@pytest.mark.parametrize("name", NARROW)
def test_a_narrow_feature_is_found_wherever_it_is(name):
    shape, area = NARROW[name]
    rng = np.random.default_rng(9)
    for width in (R(1, 100), R(1, 10**4), R(1, 10**6), R(1, 10**9)):
        for _ in range(3):
            at = R(int(rng.integers(1, 10**9)) * 10 + 5 * 10**9, 10**10)
            assert_allclose(moment(shape(t - at, width)), float(width) * area, rtol=2e-12)


def test_floats_in_an_expression_do_as_well():
    """SymPy takes large numbers out of exponents, and multiplies brackets out."""
    assert_allclose(moment(sp.exp(-(((t - 1.0628) / 1e-5) ** 2))), 1e-5 * np.sqrt(np.pi), rtol=1e-12)
    lorentzian = 1e-3 * (np.arctan(1062.8) + np.arctan(937.2))
    assert_allclose(moment(1 / (1 + ((t - 1.0628) / 1e-3) ** 2)), lorentzian, rtol=1e-13)
    assert_allclose(moment(1 / (1 + sp.exp(-(t - 1.0) / 1e-6))), 1.0, rtol=1e-13)


@pytest.mark.parametrize(
    ("force", "area"),
    [
        (sp.Abs(sp.sin(50 * t)), (2 * 31 + 1 - np.cos(100 - 31 * np.pi)) / 50),
        (sp.floor(100 * t), 199.0),
        (sp.ceiling(100 * t), 201.0),
        (sp.frac(10 * t), 1.0),
        (sp.Mod(t, R(1, 5)), 0.2),
        (sp.floor(sp.exp(t)), 2 * 7 - np.log(5040)),
        (sp.sign(sp.Abs(t - 1) - R(1, 10**7)), 2 - 4e-7),
        (sp.Abs(sp.Abs(sp.Abs(t - 1) - R(1, 2)) - R(1, 4)), 0.25),
        (sp.Max(sp.sin(t), sp.cos(t)), np.sin(np.pi / 4) * 2 - np.cos(2)),
        (sp.Piecewise((0, t < 1), (sp.sqrt(t - 1), True)), 2 / 3),
        (sp.Piecewise((t, sp.Or(t < R(1, 2), t > R(3, 2))), (1, True)), 2.0),
        (sp.Heaviside(t - 1) * sp.log(t - R(1, 2)), 1.5 * np.log(1.5) + 0.5 * np.log(2) - 1),
        (sp.atan2(sp.sin(3 * t), sp.cos(3 * t)), (6 - 2 * np.pi) ** 2 / 6),
        (sp.sqrt(sp.Abs(t - sp.pi / 3)), ((np.pi / 3) ** 1.5 + (2 - np.pi / 3) ** 1.5) * 2 / 3),
        (sp.log(sp.Abs(t - 1)), -2.0),
        (sp.sqrt(t), 2**1.5 * 2 / 3),
        (1 / sp.sqrt(t), 2**1.5),
        (sp.sinc(t - 1), 1.8921661407343662),
        (sp.sin(t) / t, 1.6054129768026949),
        (sp.asin(t - 1), 0.0),
        (sp.SingularityFunction(t, 1, 2), 1 / 3),
        (sp.tanh(20 * (t - 1)), 0.0),
        (sp.gamma(t + 1), 2.3080273328272787),
        (sp.erf(t), 1.4367884391671943),
    ],
)
def test_expressions_of_every_kind(force, area):
    assert_allclose(moment(force), area, rtol=1e-12, atol=1e-13)


def test_steps_between_the_times_of_the_clock_keep_their_digits():
    """1 + 1e-9 is no float; the pulse is a billionth long nevertheless."""
    pulse = sp.Heaviside(t - 1) - sp.Heaviside(t - 1 - R(1, 10**9))
    assert_allclose(moment(pulse), 1e-9, rtol=1e-13)


@pytest.mark.parametrize(("start", "atol"), [(0, 1e-14), (10**3, 1e-14), (10**6, 1e-13), (10**9, 1e-9)])
def test_a_kink_and_a_bump_far_from_zero(start, atol):
    """Values are those at the times of the clock, but the kink's time is known exactly."""
    bump = sp.exp(-(((t - start - R(2657, 2500)) * 1000) ** 2))
    m = of(bump + sp.Heaviside(t - start - R(1, 3)), start + 2.0, float(start))
    assert_allclose(-m.moments[1], 5 / 3 + 1e-3 * np.sqrt(np.pi), rtol=0, atol=atol)


@pytest.mark.parametrize(
    ("force", "error", "message"),
    [
        (sp.DiracDelta(t - 1), ValueError, "without impulses, got DiracDelta"),
        (sp.Heaviside(t - 1).diff(t), ValueError, "without impulses"),
        (sp.SingularityFunction(t, 1, -1), ValueError, "without impulses"),
        (sp.Piecewise((1, sp.Symbol("x") > 0), (0, True)), ValueError, "in t alone, got symbols x"),
        (sp.Piecewise((1, t < 1)), ValueError, "finite: no condition of"),
        (sp.Piecewise((1, sp.Contains(t, sp.S.Integers)), (0, True)), ValueError, "conditions that compare"),
        (1 / (t - 1), ValueError, r"finite: f\(1\) = inf"),
        (1 / t, NotConverged, "not integrable"),
        (sp.tan(t), NotConverged, "not integrable"),
        (sp.floor(10**6 * t), ValueError, "change its form at fewer times"),
        (sp.Mod(t, R(1, 3000)), ValueError, "at most 4096 kinks"),
        (sp.besselj(0, t), ValueError, "NumPy evaluates"),
    ],
)
def test_what_cannot_be_seen_through_is_refused(force, error, message):
    with pytest.raises(error, match=f"^disturbance .*{message}"):
        of(force)


def test_a_stack_is_its_members():
    ends, starts = np.array([1.0, 2.0, 7.0, 1e3 + 1]), np.array([0.0, 0.5, 5.0, 1e3])
    force = sp.Abs(sp.sin(3 * t)) + sp.exp(-(((t - R(3, 2)) * 10**5) ** 2)) + sp.Mod(t, 2)
    stack = of(force, ends, starts)
    for i in range(len(ends)):
        alone = of(force, ends[i], starts[i])
        assert_allclose(stack.moments[i], alone.moments, rtol=1e-13)
        t_i = np.linspace(starts[i], ends[i], 5)
        assert_allclose(stack.drift(np.linspace(starts, ends, 5, axis=-1))[i], alone.drift(t_i), rtol=1e-12)
    assert of(force, np.ones((2, 0)), 0.0).moments.shape == (2, 0, 3)


def test_kinks_are_edges_beside_those_that_are_told():
    m = Maneuver([0, 0, 0], [0, 0, 0], 2.0, disturbance=sp.Abs(t - R(1, 3)), edges=[0.5])
    assert_allclose(m.edge_offsets, [1 / 3, 0.5])
    assert_array_equal(m.edges, [0.5])


def test_a_formula_is_taken_apart_like_an_expression():
    force = formula.read("exp(-((t - 1.0628)/1e-6)^2)", "t")
    assert_allclose(moment(force), 1e-6 * np.sqrt(np.pi), rtol=1e-12)
    assert_allclose(moment(formula.read("abs(t - 1) + sign(t - 0.5)", "t")), 2.0, rtol=1e-14)
    assert_allclose(
        moment(formula.read("2^t", "t")), 3 / np.log(2), rtol=1e-13
    )  # SymPy is not given this one


def test_the_control_meets_the_target_under_a_pulse():
    """The moments of (1.10) are those of the pulse, and so is the motion, (1.3)."""
    pulse = 10**5 * sp.Piecewise((1, (t > R(2, 3)) & (t < R(2, 3) + R(1, 10**5))), (0, True))
    m = Maneuver([0, 0, 0], [1, 0, 0], 2.0, disturbance=pulse)
    assert_allclose(m.moments, [1 - (2 - 2 / 3 - 5e-6), -1, 0], rtol=1e-12)
    assert_allclose(minimum_peak(m).state(2.0)[0], [1, 0, 0], atol=1e-12)
    before, after = m.drift([2 / 3, 2 / 3 + 1e-5])[:, 1]
    assert_allclose([before, after], [0, 1], atol=1e-9)


@pytest.mark.parametrize(
    "force",
    [
        sp.sqrt(sp.Abs((t - R(26, 25)) * sp.frac(3 * t))),
        sp.Max(1 / (sp.Abs(sp.cos(3 * t)) + 1), sp.sin(12 * t + R(19, 25))),
        sp.Max(sp.sqrt(sp.Abs(sp.sin(10 * t + R(177, 100)))) * sp.frac(3 * t), sp.sin(7 * t + R(199, 100))),
        sp.sqrt(1 - sp.cos(t - 1)),
        1 / (1 + sp.exp(-50 * sp.sin(20 * t))),
    ],
)
def test_kinks_that_meet_singularities(force):
    """QUADPACK, between the kinks that were found."""
    m, f = of(force), sp.lambdify(t, force, "numpy")
    cuts = [0.0, *np.unique(m.edge_offsets), 2.0]
    parts = [
        quad(f, a, b, epsabs=1e-13, epsrel=1e-12, limit=200)[0] for a, b in pairwise(cuts) if b > a + 1e-7
    ]
    assert_allclose(-m.moments[1], sum(parts), rtol=1e-9)
