"""Features of a system that are narrower than the spacing of collocation points or of nodes on a turn."""

from dataclasses import replace

import mpmath
import numpy as np
import pytest
import sympy as sp

from pontryagin import Infeasible, NotConverged
from pontryagin.averaging import Ball, Box, Custom, PhaseSystem, Quadratic, rotor, solve_averaged
from pontryagin.averaging.averaged.solve import solved
from pontryagin.errors import ArgumentValueError

a, b, u, v, x = sp.symbols("a b u v x", real=True)
PLACE = sp.Rational(1534, 1000)


def bump(steepness, place=PLACE):
    return sp.exp(-steepness * (a - place) ** 2)


def peak(steepness, place=1):
    """A feature of the phase of height 1."""
    return sp.exp(-steepness * (1 - sp.cos(x - place)))


def system(**changes):
    plain = {"f": [u], "omega": 1, "control_set": Quadratic(), "slow": [a], "control": [u], "phase": x}
    return PhaseSystem(**(plain | {"target": [a - 2]} | changes))


def cost_of(running_cost, width, place):
    """2 times the integral of sqrt(L) from 1 to 2, least for a' = u at the cost L + u^2."""
    rate = sp.lambdify(a, sp.sqrt(running_cost), "mpmath")
    ends = {1.0, 2.0, *(float(place) + k * float(width) for k in range(-6, 7))}
    return float(2 * mpmath.quad(rate, sorted(end for end in ends if 1 <= end <= 2)))


def test_a_frequency_that_is_negative_on_a_part_of_the_way_is_refused():
    with pytest.raises(ArgumentValueError, match=r"omega must be positive.*at a = 1\.5") as error:
        solve_averaged(system(omega=1 - sp.Rational(11, 10) * bump(100)), [1.0])
    assert error.value.argument == "omega"


@pytest.mark.parametrize(
    "weight", [1 + 2 * sp.cos(x), 1 - sp.Rational(11, 10) * peak(10**4), 1 + sp.cos(x) * 2 * bump(10**5)]
)
def test_a_negative_weight_is_refused(weight):
    with pytest.raises(ArgumentValueError, match=r"weight must be positive.*x = ") as error:
        solve_averaged(system(weight=weight), [1.0])
    assert error.value.argument == "weight"


def test_a_narrow_rise_of_the_cost_is_climbed():
    solution = solve_averaged(system(running_cost=1 + 99 * bump(10**5)), [1.0])
    right = cost_of(1 + 99 * bump(10**5), 5e-3, PLACE)
    assert right == pytest.approx(2.1304, abs=5e-5)
    assert float(solution.cost) == pytest.approx(right, rel=1e-12)
    assert solution.certificate.holds() and solution.certificate.unresolved == 0


@pytest.mark.parametrize("gain", [1, 2 + sp.cos(x), sp.exp(sp.cos(x) / 2)])
def test_a_narrow_rise_of_the_cost_is_climbed_whatever_the_phase_does(gain):
    solution = solve_averaged(system(f=[u * gain], running_cost=1 + 99 * bump(10**5)), [1.0])
    square = mpmath.quad(sp.lambdify(x, gain**2, "mpmath"), [0, mpmath.pi, 2 * mpmath.pi]) / (2 * mpmath.pi)
    right = cost_of(1 + 99 * bump(10**5), 5e-3, PLACE) / mpmath.sqrt(square)
    assert float(solution.cost) == pytest.approx(float(right), rel=1e-12)


@pytest.mark.parametrize("drift", [1, 1 + sp.cos(x)])
def test_a_narrow_drift_that_cannot_be_overcome_is_found(drift):
    with pytest.raises(Infeasible, match=r"at a = 1\.53"):
        solve_averaged(system(control_set=Ball(1), f=[u - 2 * drift * bump(10**5)]), [1.0])


@pytest.mark.parametrize("control_set", [Ball(1), Box([1]), Custom(lambda s: sp.Abs(s[0]))])
def test_a_narrow_gap_of_the_control_s_effect_is_crossed(control_set):
    """Least time is the integral of 1 / (1 - bump / 2)."""
    solution = solve_averaged(system(control_set=control_set, f=[u * (1 - bump(10**6) / 2)]), [1.0])
    near = [1, 1.53, 1.533, 1.534, 1.535, 1.54, 2]
    right = mpmath.quad(sp.lambdify(a, 1 / (1 - bump(10**6) / 2), "mpmath"), near)
    assert float(solution.duration) == pytest.approx(float(right), rel=1e-11)


def random_rise(number):
    """A rise or dip of the cost with its width and place: widths down to 1e-4 of the way."""
    rng = np.random.default_rng(number)
    place = 1 + sp.Rational(int(rng.integers(100, 9900)), 10000)
    width = sp.Rational(float(10.0 ** rng.uniform(-4, -0.5))).limit_denominator(10**7)
    height = sp.Rational(float(10.0 ** rng.uniform(-3, 2))).limit_denominator(10**4)
    if number % 3 == 2:
        height = -height / (1 + height)
    return 1 + height * sp.exp(-(((a - place) / width) ** 2)), width, place


@pytest.mark.parametrize(
    "number", [*range(3), *(pytest.param(n, marks=pytest.mark.slow) for n in range(3, 90))]
)
def test_no_random_rise_or_dip_is_missed(number):
    running_cost, width, place = random_rise(number)
    solution = solve_averaged(system(running_cost=running_cost), [1.0])
    assert float(solution.cost) == pytest.approx(cost_of(running_cost, width, place), rel=1e-9)


@pytest.mark.parametrize(
    "number", [*range(3), *(pytest.param(n, marks=pytest.mark.slow) for n in range(3, 40))]
)
def test_no_random_feature_of_the_phase_is_missed(number):
    """f = u (1 + h peak): the mean of its square is 1 + 2 h m(k) + h^2 m(2k), m(k) = exp(-k) I0(k)."""
    rng = np.random.default_rng(number)
    steepness = sp.Rational(float(10.0 ** rng.uniform(1, 7))).limit_denominator(100)
    height = sp.Rational(float(10.0 ** rng.uniform(-2, 2))).limit_denominator(1000)
    place = sp.Rational(int(rng.integers(0, 6283)), 1000)
    solution = solve_averaged(system(f=[u * (1 + height * peak(steepness, place))]), [1.0])
    k, h = mpmath.mpf(float(steepness)), mpmath.mpf(float(height))
    square = 1 + 2 * h * mpmath.besseli(0, k) * mpmath.exp(-k)
    square += h**2 * mpmath.besseli(0, 2 * k) * mpmath.exp(-2 * k)
    assert float(solution.cost) == pytest.approx(float(2 / mpmath.sqrt(square)), rel=1e-11)
    assert solution.certificate.unresolved == 0


def test_means_that_heed_a_feature_stay_with_the_solution():
    solution = solve_averaged(system(f=[u * (1 + 50 * peak(10**5))]), [1.0])
    tau = np.linspace(0, float(solution.duration), 5)
    slope = 1 / float(solution.duration)
    np.testing.assert_allclose(solution.mean_rate(tau)[..., 0], slope, rtol=1e-11)


@pytest.mark.slow
def test_a_feature_that_moves_with_the_slow_variable_is_told():
    """A narrow feature at x = a is averaged rightly, but enclosing it takes too many boxes."""
    solution = solve_averaged(system(f=[u * (1 + 50 * peak(10**4, a))]), [1.0])
    k = mpmath.mpf(10**4)
    square = 1 + 100 * mpmath.besseli(0, k) * mpmath.exp(-k)
    square += 2500 * mpmath.besseli(0, 2 * k) * mpmath.exp(-2 * k)
    assert float(solution.cost) == pytest.approx(float(2 / mpmath.sqrt(square)), rel=1e-9)
    assert 0 < solution.certificate.unresolved < 1


@pytest.mark.parametrize("quantity", ["mass", "potential", "force"])
def test_narrow_features_of_a_rotor_are_averaged(quantity):
    """Least time with |u| <= 1, from a' = <(1 + f) v> with v the speed and 1 / v the weight."""
    narrow = peak(10**5)
    functions = {"mass": sp.Integer(1), "potential": sp.cos(x), "force": sp.Integer(0)}
    functions[quantity] += {"mass": 5, "potential": 1, "force": -5}[quantity] * narrow
    solution = rotor(3.0, 5.0, **functions, peak=1.0)
    m, potential, force = (functions[name] for name in ("mass", "potential", "force"))
    edges = np.array([0, *(1 + 0.003 * np.arange(-12, 13)), 2.5, 4, 2 * np.pi])
    node, weight = np.polynomial.legendre.leggauss(30)
    angle = (edges[:-1, None] + np.diff(edges)[:, None] * (node + 1) / 2).ravel()
    share = (np.diff(edges)[:, None] * weight / 2).ravel()
    pace = sp.lambdify([a, x], 1 / sp.sqrt(2 * (a - potential) / m), "numpy")
    push = (sp.lambdify(x, 1 + force + 0 * x, "numpy")(angle) * np.ones(angle.shape)) @ share
    expected = sum(w * (pace(4 + s, angle) @ share) / push for s, w in zip(node, weight, strict=True))
    assert float(solution.duration) == pytest.approx(expected, rel=1e-11)
    assert solution.certificate.unresolved == 0


def test_a_speed_that_is_least_at_an_end_of_the_way_is_shown_to_be_positive():
    bumpy = rotor(2.0, 5.0, mass=1, potential=sp.cos(x) + peak(10**5), force=0, k=1.0)
    assert bumpy.certificate.unresolved == 0


def test_the_correction_of_a_narrow_feature_of_the_phase_is_refused():
    """64 and 128 points agree that there is none."""
    solution = solve_averaged(system(f=[u * (2 + sp.cos(x) + peak(10**7))]), [1.0])
    with pytest.raises(NotConverged, match="too narrow"):
        solution.correction()


@pytest.mark.slow
def test_exact_extremals_that_pass_over_a_narrow_feature_are_refused():
    """Least cost is below that of the mean of the squared gain, since the ends choose the phase; never 2."""
    with pytest.raises(NotConverged, match="pass over narrow features"):
        solve_averaged(system(f=[u * (1 + 50 * peak(10**5))]), [1.0]).exact(0.05)
    seen = solve_averaged(system(f=[u * (2 + sp.cos(x))], running_cost=1 + 100 * peak(10**5)), [1.0]).exact(
        0.05
    )
    assert all(extremal.certificate.holds() for extremal in seen)


def test_a_stack_is_its_members():
    narrow = system(running_cost=1 + 99 * bump(10**5))
    starts = [[1.0], [1.9], [1.2], [2.5], [1.6]]
    together = solve_averaged(narrow, starts)
    for i, start in enumerate(starts):
        alone = solve_averaged(narrow, start)
        assert float(alone.cost) == pytest.approx(float(together.cost[i]), rel=1e-12)
        assert alone.certificate.unresolved == together.certificate.unresolved[i]


def test_two_slow_variables():
    """With b free, b stays at rest and the problem is that of one variable."""
    two = {"slow": [a, b], "control": [u, v], "f": [u, v]}
    solution = solve_averaged(system(**two, running_cost=1 + bump(10**4)), [1.0, 0.0])
    assert float(solution.cost) == pytest.approx(cost_of(1 + bump(10**4), 1e-2, PLACE), rel=1e-10)
    assert solution.certificate.unresolved == 0


def test_a_feature_beside_the_way_bends_the_costate():
    """L = 1 + b bump has no effect on the way b = 0 but on its costate: a solution that misses it is seen."""
    two = {"slow": [a, b], "control": [u, v], "f": [u, v], "target": [a - 2, b]}
    solution = solve_averaged(system(**two, running_cost=1 + b * bump(10**5)), [1.0, 0.0])
    side = solution.costate(np.array([0.0, 1.0]) * solution.duration)[..., 1]
    area = float(mpmath.sqrt(mpmath.pi / 10**5))
    assert side[1] - side[0] == pytest.approx(area, rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("width", [1, sp.Rational(1, 1000)])
def test_steps_in_slow_time_are_refused(width):
    """Collocation by smooth series does not converge there, however short the piece."""
    piece = sp.Piecewise((1, sp.Abs(a - PLACE) < width / 2), (0, True))
    with pytest.raises(NotConverged):
        solve_averaged(system(running_cost=1 + 99 * piece), [1.0])


@pytest.mark.slow
def test_the_neighbourhood_of_a_kink_stays_unresolved():
    solution = solve_averaged(system(running_cost=1 + sp.Abs(a - PLACE)), [1.0])
    s, t = float(PLACE) - 1, 2 - float(PLACE)
    assert float(solution.cost) == pytest.approx(4 / 3 * ((1 + s) ** 1.5 + (1 + t) ** 1.5 - 2), rel=1e-10)
    assert 0 < solution.certificate.unresolved < 1e-5


USUAL = {
    "plain": (system(), [1.0]),
    "phase": (system(f=[u * (2 + sp.cos(x)) - sp.sin(x)]), [1.0]),
    "bounded": (system(f=[u * sp.exp(sp.cos(x) / 2) * a], control_set=Ball(2)), [1.0]),
    "drift": (system(f=[a * u - a**2 / 5], running_cost=2 + sp.sin(a)), [1.0]),
    "frequency": (system(omega=1 / (1 + a**2), weight=1 + sp.cos(x) / 2), [1.0]),
    "two": (system(slow=[a, b], control=[u, v], f=[u + b, v * sp.cos(x)], target=[a - 2]), [1.0, 0.2]),
}


@pytest.mark.parametrize("name", USUAL)
def test_usual_systems_are_solved_as_without_enclosures(name):
    usual, start = USUAL[name]
    solution = solve_averaged(usual, start)
    bare = solved(replace(usual.model, bounds=None), solution.names, np.array(start), (), lambda: usual)
    assert float(solution.cost) == pytest.approx(float(bare.cost), rel=1e-12)
    assert solution.certificate.unresolved == 0 and solution.edges.shape == bare.edges.shape
