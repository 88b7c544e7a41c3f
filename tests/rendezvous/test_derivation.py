"""The derivation: identities, and the 16 equations against Newton's law and the primer vector."""

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.optimize import root

from pontryagin.numerics import compile as compiler
from pontryagin.numerics.flow import flow
from pontryagin.rendezvous.derivation import (
    canonical,
    forms,
    model,
    primer,
    principle,
    quaternion,
    reduction,
    repair,
    terminal,
    transversality,
    variation,
)

TARGET = [1.0, 1.5, 0.1, np.sqrt(1.5)]
"""Values of fM, p*, e* and c*."""
SCALE = {"unsaturated": 1.0, "saturated": 0.08, "time-optimal": 0.08}
SPAN = np.linspace(0.0, 3.0, 7)
START = [1.1, 0.1, 1.05, 0.4]
COSTATES = [0.05, 0.15, 0.3, 0.21, 0.26, -0.13]
ATTITUDE = np.array([0.8, 0.1, -0.5, 0.31]) / np.linalg.norm([0.8, 0.1, -0.5, 0.31])
MEASURES = compiler.function(
    "measures",
    [*reduction.REDUCED, *model.attitude, model.gravity],
    {
        "place": model.cartesian()[0],
        "velocity": model.cartesian()[1],
        "primer": quaternion.rotated(principle.switching(), model.attitude),
        "primer_rate": quaternion.rotated(primer.carried(), model.attitude),
    },
)


def trajectory(form, start, scale):
    # SciPy integrates: for a few trajectories, compiling the Taylor integrator takes longer than it saves.
    integrate = flow(form.states, form.rates, form.parameters, taylor=False)
    return integrate(start, SPAN, [*TARGET, scale])


def multiplied(p, q):
    """Hamilton's product in NumPy, from the rule i j = k."""
    a, b, c, d = p
    e, f, g, h = q
    return np.array(
        [
            a * e - b * f - c * g - d * h,
            a * f + b * e + c * h - d * g,
            a * g - b * h + c * e + d * f,
            a * h + b * g - c * f + d * e,
        ]
    )


def lifted_start():
    mu = multiplied(ATTITUDE, [0.0, *COSTATES[3:]])
    return [*START, *ATTITUDE, *COSTATES[:3], 0.7, *mu]


@given(*[st.tuples(*[st.integers(-3, 3)] * 4)] * 3)
def test_the_product_of_quaternions_is_hamilton_s_and_associative(a, b, c):
    p, q, s = (sp.Matrix(x) for x in (a, b, c))
    product, conjugate = quaternion.product, quaternion.conjugate
    assert list(product(p, q)) == multiplied(a, b).tolist()
    assert product(p, product(q, s)) == product(p, q, s)
    assert conjugate(product(p, q)) == product(conjugate(q), conjugate(p))
    assert quaternion.rotated(quaternion.vect(q), p).dot(quaternion.rotated(quaternion.vect(q), p)) == (
        p.dot(p) ** 2 * quaternion.vect(q).dot(quaternion.vect(q))
    )


def test_2_and_3_are_newton_s_law_in_rotating_axes_at_any_thrust():
    def thrust(t):
        return np.array([0.05 * np.sin(3 * t), -0.04 + 0.02 * t, 0.06 * np.cos(2 * t)])

    states = [*principle.STATE]
    rates = compiler.function(
        "rates", [*states, *model.thrust, *TARGET_SYMBOLS], {"rates": principle.state_rates()}
    )
    rotating = solve_ivp(
        lambda t, y: rates(*y, *thrust(t), *TARGET)[0].ravel(),
        (0, 3),
        [*START, *ATTITUDE],
        method="DOP853",
        rtol=1e-12,
        atol=1e-13,
        t_eval=SPAN,
    ).y.T
    place = compiler.function("place", [*states], dict(zip("RV", model.cartesian(), strict=True)))
    R, V = (part[..., 0] for part in place(*rotating.T))

    def newton(t, y):
        radius, normal = y[:3], np.cross(y[:3], y[3:])
        e1, e3 = radius / np.linalg.norm(radius), normal / np.linalg.norm(normal)
        acceleration = np.column_stack([e1, np.cross(e3, e1), e3]) @ thrust(t)
        return [*y[3:], *(acceleration - radius / np.linalg.norm(radius) ** 3)]

    inertial = solve_ivp(
        newton, (0, 3), [*R[0], *V[0]], method="DOP853", rtol=1e-12, atol=1e-13, t_eval=SPAN
    ).y.T
    assert_allclose(np.hstack([R, V]), inertial, atol=1e-10)
    assert abs(rotating[-1, 4:] - rotating[0, 4:]).max() > 0.1


TARGET_SYMBOLS = [model.gravity, model.parameter, model.eccentricity, model.areal]


@pytest.mark.parametrize("mode", ["unsaturated", "saturated"])
def test_the_16_equations_are_newton_s_law_with_lawden_s_primer_vector(mode):
    form = forms.full(mode)
    path = dict(zip(form.states, trajectory(form, lifted_start(), SCALE[mode]).T, strict=True))
    nu = [
        multiplied(q * [1, -1, -1, -1], m)
        for q, m in zip(column(path, model.attitude), column(path, principle.mu), strict=True)
    ]
    rows = [path[x] for x in reduction.REDUCED[:7]] + list(np.array(nu).T[1:])
    R, V, N, N_rate = (part[..., 0] for part in MEASURES(*rows, *column(path, model.attitude).T, 1.0))

    def cartesian(_, y):
        place, primer_ = y[:3], y[6:9]
        r = np.linalg.norm(place)
        length = np.linalg.norm(primer_)
        thrust = primer_ / 2 if mode == "unsaturated" else SCALE[mode] * primer_ / length
        gradient = (3 * np.outer(place, place) / r**2 - np.eye(3)) / r**3
        return [*y[3:6], *(thrust - place / r**3), *y[9:], *(gradient @ primer_)]

    start = [*R[0], *V[0], *N[0], *N_rate[0]]
    inertial = solve_ivp(cartesian, (0, 3), start, method="DOP853", rtol=1e-12, atol=1e-13, t_eval=SPAN).y.T
    assert_allclose(np.hstack([R, V, N, N_rate]), inertial, atol=1e-10)


def column(path, symbols):
    return np.column_stack([path[x] for x in symbols])


@pytest.mark.slow
@pytest.mark.parametrize("mode", principle.MODES)
def test_all_forms_have_the_same_trajectories_and_h_of_17_is_constant(mode):
    sixteen = forms.full(mode)
    path = trajectory(sixteen, lifted_start(), SCALE[mode])
    full = dict(zip(sixteen.states, path.T, strict=True))
    ten = trajectory(forms.reduced(mode), [*START, *COSTATES], SCALE[mode])
    fourteen = trajectory(forms.with_attitude(mode), [*START, *COSTATES, *ATTITUDE], SCALE[mode])
    assert_allclose(ten[:, :7], column(full, reduction.REDUCED[:7]), atol=1e-11)
    assert_allclose(fourteen[:, :10], ten, atol=1e-11)
    assert_allclose(fourteen[:, 10:], column(full, model.attitude), atol=1e-11)
    for row, q, m in zip(ten, column(full, model.attitude), column(full, principle.mu), strict=True):
        assert_allclose(multiplied(q, [0.0, *row[7:]]), m, atol=1e-11)
    energy = compiler.function(
        "energy",
        [
            *reduction.REDUCED,
            *TARGET_SYMBOLS,
            principle.energy_weight if mode == "unsaturated" else principle.peak,
        ],
        {
            "H": reduction.hamiltonian()
            .subs(reduction.anomaly_constant, 0.3)
            .subs(forms.thrust(mode))
            .subs(principle.time_weight, 1)
            .subs(principle.energy_weight if mode != "unsaturated" else sp.Symbol("none"), 1)
        },
    )(*ten.T, *TARGET, SCALE[mode])[0]
    assert_allclose(energy, energy[0], atol=1e-11)


@pytest.mark.parametrize("chart", [1, -1])
def test_chi_and_nu_determine_the_attitude(chart):
    fourteen = trajectory(forms.with_attitude("unsaturated"), [*START, *COSTATES, *ATTITUDE], 1.0)
    invariant = dict(
        zip(
            principle.nu,
            multiplied(multiplied(ATTITUDE, [0, *COSTATES[3:]]), ATTITUDE * [1, -1, -1, -1])[1:],
            strict=True,
        )
    )
    frame = repair.with_length(repair.shortest_turn(chart)).subs(invariant)
    chi = compiler.function("chi", list(model.attitude), {"chi": repair.chi_of(frame)})
    start = float(chi(*ATTITUDE)[0])
    eleven = trajectory(forms.repaired("unsaturated", chart), [*START, *COSTATES, start], 1.0)
    back = compiler.function(
        "back", [repair.chi, *principle.nu], {"lambda": repair.with_length(repair.attitude_of(frame, chart))}
    )(eleven[:, 10], *eleven[:, 7:10].T)[0][..., 0]
    same = np.sign(np.sum(back * fourteen[:, 10:], axis=1))[:, None]
    assert_allclose(same * back, fourteen[:, 10:], atol=1e-11)
    difference = np.angle(np.exp(1j * (eleven[:, 10] - chi(*fourteen[:, 10:].T)[0]) / 1))
    assert_allclose(difference, 0, atol=1e-11)


def test_each_chart_of_the_repair_is_regular_where_the_other_is_singular():
    small = sp.Symbol("h", positive=True)
    nearby = dict(zip(principle.nu, (sp.sin(small), 0, -sp.cos(small)), strict=True))
    slopes = [repair.with_length(repair.chi_rate(chart)).diff(model.thrust[2]) for chart in (1, -1)]
    first, second = (sp.limit(sp.simplify(slope.subs(nearby)), small, 0, "+") for slope in slopes)
    assert first.is_infinite and second == 0


@pytest.mark.slow
def test_6_has_rank_three_and_15_rank_two_as_it_does_not_change_under_rotations_about_nu():
    assert repair.change_of_mismatch().rank() == 3
    change = repair.change_of_invariant()
    assert change.rank() == 2
    (null,) = change.nullspace()
    assert null.cross(principle.nu).applyfunc(sp.simplify).is_zero_matrix


def test_the_target_of_5_and_6_solves_the_equations_of_motion():
    ends = transversality.end_values()
    coasting = principle.state_rates().subs(dict.fromkeys(model.thrust, 0)).subs(ends)
    rates = transversality.meeting()[:3, :].diff(model.anomaly) * model.anomaly_rate()
    assert (coasting[:3, :] - rates).subs(model.gravity, model.GAUSS).applyfunc(sp.simplify).is_zero_matrix
    names = dict(zip(model.attitude, model.target_attitude(), strict=True))
    attitude_rate = model.target_attitude().diff(model.anomaly) * model.anomaly_rate()
    assert (coasting[4:, :].subs(names) - attitude_rate).applyfunc(sp.simplify).is_zero_matrix


def test_the_second_derivative_of_n_is_the_gravity_gradient_times_n():
    n = principle.switching()
    assert (primer.second_rate() - primer.gravity_gradient() * n).applyfunc(sp.simplify).is_zero_matrix
    assert sp.simplify(primer.hamiltonian() - reduction.hamiltonian()) == 0
    assert primer.turning_invariant(-primer.carried(), n) == principle.nu
    costates = primer.costates(-primer.carried(), n)
    assert all(sp.simplify(value - symbol) == 0 for symbol, value in costates.items())
    assert len(costates) == 6


def test_at_a_thrust_not_along_n_the_derivative_of_n_has_an_additional_term():
    n = principle.switching()
    rate = primer.rate_at_any_thrust(n)
    r, c = model.r, model.c
    torque = n.cross(model.thrust)
    extra = (rate - primer.carried()).applyfunc(sp.simplify)
    assert (extra - sp.Matrix([0, 0, r * torque[0] / c])).applyfunc(sp.simplify).is_zero_matrix


@pytest.mark.slow
def test_16_and_17_give_the_law_for_the_thrust_at_the_end():
    at_end = terminal.law().subs(transversality.end_values())
    assert sp.simplify(terminal.hamiltonian_at_a_meeting() - at_end) == 0
    assert terminal.end_thrust() == sp.sqrt(principle.time_weight) / sp.sqrt(principle.energy_weight)
    scale = principle.time_weight + principle.energy_weight * principle.peak**2
    assert sp.expand(terminal.scale_of_saturated() - scale) == 0


@pytest.mark.parametrize("mode", principle.MODES)
def test_the_slope_of_the_cost_over_the_duration_vanishes_with_the_law_at_the_end(mode):
    assert sp.expand(terminal.cost_slope(mode) + terminal.law_in_lengths(mode)) == 0
    assert variation.energy_rate(mode) == 0


@pytest.mark.slow
def test_the_first_variation_consists_of_a_term_at_the_end_and_one_of_the_thrust():
    thrust_slopes = [variation.FAMILY[p].diff(variation.s) for p in model.thrust]
    rest = variation.rest_of_the_variation() + variation.gradient_by_thrust().dot(thrust_slopes)
    assert sp.expand(rest) == 0
    end = variation.of_a_meeting()
    assert sp.expand(end.coeff(variation.delay) + principle.in_nu(principle.hamiltonian())) == 0


@pytest.mark.slow
@given(*[st.fractions(1, 2, max_denominator=9)] * 3)
@settings(max_examples=3, deadline=None)
def test_the_costates_transformed_from_cartesian_ones_obey_the_16_equations(r, v1, c):
    numbers = [sp.Rational(x.numerator, x.denominator) for x in (r, v1, c)]
    lengths = dict(zip((model.r, model.v1, model.c), numbers, strict=True))
    point = lengths | dict(zip(model.attitude, (sp.Rational(k, 7) for k in (2, -3, 6, 0)), strict=True))
    assert canonical.state_gap(point).is_zero_matrix
    assert canonical.costate_gap(point).is_zero_matrix


def test_the_axes_made_of_place_and_velocity_are_eta():
    point = dict(zip(model.attitude, (sp.Rational(k, 5) for k in (1, 2, 2, 4)), strict=True))
    axes = canonical.axes(canonical.place_and_velocity().subs(point)).applyfunc(sp.simplify)
    eta = [quaternion.rotated(axis, model.attitude).subs(point) for axis in (model.EX, model.EY, model.EZ)]
    assert axes == sp.Matrix.hstack(*eta)


def test_the_magnitudes_of_10_maximise_the_gain():
    """The gain is the part of H that depends on the size of a thrust along n of (9)."""
    p, length = principle.thrust_magnitude, principle.switching_length
    assert principle.along_switching() == length * p - principle.energy_weight * p**2
    top = length / (2 * principle.energy_weight)
    assert principle.best_magnitudes() == (top, principle.peak, principle.peak)


def test_the_symbols_of_the_target_print_with_a_star():
    assert sp.latex(model.anomaly_rate()) == (
        r"\frac{c^* \left(e^* \cos{\left(\varphi^* \right)} + 1\right)^{2}}{\left(p^*\right)^{2}}"
    )
    assert str(model.parameter) == "p_star"


def test_saturated_rates_are_homogeneous_of_degree_zero_and_one_in_the_costates():
    costates = [principle.rho, principle.s1, principle.e, *principle.nu]
    form = forms.reduced("saturated")
    point = {x: sp.Rational(k + 3, k + 7) for k, x in enumerate([*form.states, *form.parameters])}
    scaled = point | {x: 5 * point[x] for x in costates}
    for x, rate in zip(form.states, form.rates, strict=True):
        ratio = (rate.subs(scaled) / rate.subs(point)).evalf(30)
        assert abs(ratio - (5 if x in costates else 1)) < 1e-25


@settings(max_examples=20)
@given(st.floats(0.0, 2.0), st.floats(0.05, 3.0), st.floats(0.02, 2.0))
def test_no_magnitude_on_a_grid_gains_more_than_that_of_10(length, weight, bound):
    share = np.linspace(0, bound, 4001)
    gain = -weight * share**2 + length * share
    values = {principle.s1: length, principle.e: 0, principle.nu[0]: 0, principle.energy_weight: weight}
    free = float(principle.stationary_magnitude().subs(values))
    best = min(free, bound)
    assert -weight * best**2 + length * best >= gain.max() - 1e-12


def test_the_derived_slope_of_the_cost_agrees_with_differences_of_optimal_costs():
    form = forms.with_attitude("unsaturated")
    integrate = flow(form.states, form.rates, form.parameters)
    ends = compiler.function("ends", [*form.states, *TARGET_SYMBOLS], {"ends": model.boundary()})

    def end_of(unknowns, times):
        rho, s1, e, nu3 = unknowns
        return integrate([1, 0, 1, 0.6, rho, s1, e, 0, 0, nu3, 1, 0, 0, 0], times, [*TARGET, 1.0])

    def residual(unknowns, duration):
        y = end_of(unknowns, [0.0, duration])[-1]
        return [*ends(*y, *TARGET)[0].ravel(), np.sin(np.arctan2(y[13], y[10]) - y[3] / 2)]

    def cost_and_length(duration):
        found = root(residual, np.zeros(4), args=(duration,), tol=1e-13)
        assert np.abs(found.fun).max() < 1e-12
        nodes, weights = np.polynomial.legendre.leggauss(40)
        times = np.concatenate([[0.0], (nodes + 1) * duration / 2, [duration]])
        y = end_of(found.x, times)
        square = (y[:, 5] ** 2 + (y[:, 6] * y[:, 0]) ** 2) / 4
        return duration / 2 * weights @ square[1:-1], 2 * np.sqrt(square[-1])

    h = 1e-3
    (before, _), (_, length), (after, _) = (cost_and_length(5 + k * h) for k in (-1, 0, 1))
    slope = terminal.cost_slope("unsaturated").subs(
        {terminal.switching_length: length, principle.time_weight: 0, principle.energy_weight: 1}
    )
    assert_allclose((after - before) / (2 * h), float(slope), rtol=1e-5)
