"""Figures: their lines are read back and compared with the mathematics."""

import numpy as np
import pytest
import sympy as sp
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.integrate import trapezoid
from scipy.spatial.transform import Rotation

from independent import response
from pontryagin.display.plotting import svg_of
from pontryagin.triple_integrator import (
    Maneuver,
    figures,
    minimum_energy,
    minimum_impulse,
    minimum_norm,
    minimum_peak,
    minimum_time,
    search,
)
from pontryagin.triple_integrator.attitude.rigid_body import RigidBody
from pontryagin.triple_integrator.derivation import coverage, peak
from pontryagin.triple_integrator.figures import duration, overpayment, sphere, tables
from strategies import maneuver_with, maneuvers, moments, states

MOVING = Maneuver([0.2, -0.3, 0.5], [1, 0.4, -0.2], t0=1.0, tf=3.0)
STACK = Maneuver(np.zeros((2, 3)), np.ones((2, 3)), 1.0)
BODY = RigidBody([[1200, 90, -60], [90, 900, 40], [-60, 40, 700]])


def curves(ax, least=50):
    """Lines of an axes that have at least `least` points, as (x, y)."""
    return [line.get_data() for line in ax.lines if len(line.get_xdata()) >= least]


class TestProgrammes:
    def test_the_drawn_control_has_the_moments_and_the_drawn_states_reach_the_target(self):
        axes = np.array(figures.three_programmes(MOVING).axes).reshape(4, 3)
        for ax in axes[0, :2]:
            t, u = curves(ax)[0]
            found = trapezoid(response(3.0 - t) * u[:, None], t, axis=0)
            assert_allclose(found, MOVING.moments, atol=2e-4)
        for row, state in zip(axes[1:], (2, 1, 0), strict=True):
            for ax in row:
                _, x = curves(ax)[0]
                assert_allclose(x[[0, -1]], [MOVING.x0[state], MOVING.xf[state]], atol=1e-12)

    def test_impulses_are_written_beside_their_arrows(self):
        solution = minimum_impulse(MOVING)
        ax = figures.solution_figure(solution).axes[0]
        written = [float(text.get_text().strip("$")) for text in ax.texts if text.get_text()]
        assert_allclose(written, solution.impulses, rtol=1e-3)

    def test_every_kind_of_solution_has_its_figure(self):
        fast = minimum_time([0, 0, 0], [1, 0, 0], 32.0)
        for solution in (minimum_energy(MOVING), minimum_peak(MOVING), minimum_norm(MOVING, 3.0), fast):
            figure = figures.solution_figure(solution)
            t, u = curves(figure.axes[0])[0]
            assert_allclose(u, solution.control(t), rtol=1e-12)

    def test_a_manoeuvre_that_needs_nothing_is_drawn(self):
        still = Maneuver([0, 0, 0], [0, 0, 0], 1.0)
        for ax in figures.three_programmes(still).axes:
            assert all(np.all(y == 0) for _, y in curves(ax))

    @pytest.mark.parametrize("draw", [figures.three_programmes, figures.dual_functions, figures.norm_family])
    def test_a_stack_is_refused(self, draw):
        with pytest.raises(ValueError, match=r"^maneuver must .* got a stack of shape \(2,\)"):
            draw(STACK)


class TestDualFunctions:
    def test_each_touches_its_bound(self):
        axes = figures.dual_functions(MOVING).axes
        lines = [curves(ax)[0] for ax in axes]
        controls = (minimum_energy(MOVING), minimum_peak(MOVING), minimum_impulse(MOVING))
        energy, area, height = (1 / float(s.norm) for s in controls)
        (t, h), (s, g), (_, p) = lines
        assert_allclose(np.sqrt(trapezoid(h * h, t)), energy, rtol=1e-4)
        assert_allclose(trapezoid(np.abs(g), s), area, rtol=1e-4)
        assert_allclose(np.abs(p).max(), height, rtol=1e-12)

    def test_each_pairs_to_one_with_every_control_of_these_moments(self):
        t = np.linspace(1.0, 3.0, 4001)
        for solution in (minimum_energy(MOVING), minimum_peak(MOVING)):
            for ax in figures.dual_functions(MOVING).axes:
                h = np.polynomial.Polynomial.fit(*curves(ax)[0], 2)
                assert_allclose(trapezoid(h(t) * solution.control(t), t), 1.0, atol=2e-3)

    def test_without_moments_there_is_none(self):
        with pytest.raises(ValueError, match="c = 0"):
            figures.dual_functions(Maneuver([0, 0, 0], [0, 0, 0], 1.0))


class TestSphere:
    @given(states())
    def test_a_direction_comes_back_from_the_disc(self, direction):
        assume(np.linalg.norm(direction) > 0.1)
        unit = direction / np.linalg.norm(direction)
        unit = unit * np.sign(unit @ sphere.frame()[2] + 1e-300)
        assert_allclose(sphere.from_disc(sphere.to_disc(unit)), unit, atol=1e-12)

    def test_areas_are_kept(self):
        directions = np.random.default_rng(0).normal(size=(200_000, 3))
        points = sphere.to_disc(directions * np.sign(directions @ sphere.frame()[2])[:, None])
        shares = np.histogram((points**2).sum(axis=1), bins=np.linspace(0, 1, 11))[0] / len(points)
        assert_allclose(shares, 0.1, atol=0.004)

    def test_the_start_lies_to_the_left_and_the_end_to_the_right(self):
        start, end = sphere.unit_impulse(np.array([1.0, 0.0]))
        assert sphere.to_disc(start)[0] < 0 < sphere.to_disc(end)[0]
        assert_allclose(sphere.to_disc(np.ones(3)), 0.0, atol=1e-15)


class TestRegimes:
    def test_the_share_of_the_printed_formula_is_the_solid_angle(self):
        table = tables.regime_shares(400)
        share = dict(zip(table["regime"], table["share of directions"], strict=True))
        assert share["chebyshev"] == pytest.approx(float(coverage.share_of_directions()), abs=2e-3)
        assert sum(share.values()) == pytest.approx(1.0, abs=2e-3)

    def test_the_map_is_drawn_from_the_solver(self):
        image = figures.impulse_regimes().axes[0].images[0].get_array()
        at_rest = sphere.to_disc(np.array([6.0, 0.0, 0.0]))
        row, column = ((at_rest[::-1] + 1) / 2 * len(image)).astype(int)
        assert image[row, column] == 2  # Chebyshev's
        middle = len(image) // 2
        assert image[middle, middle + 20] == 1  # nearly constant: one sign

    def test_boundaries_separate_regimes(self):
        """At a random place of each great circle drawn the regime is different on its two sides."""
        start, end, middle = sphere.unit_impulse(np.array([1.0, 0.0, 0.5]))
        for first, last in ((start, end), (start, -middle), (end, -middle), (start, -end)):
            point = sphere.arc(first, last, 9)[4]
            normal = np.cross(first, last) / np.linalg.norm(np.cross(first, last))
            near = np.stack([point + 0.01 * normal, point - 0.01 * normal])
            one, other = minimum_impulse(sphere.maneuvers(near)).regime
            assert one != other


class TestPrintedImpulses:
    @given(moments())
    def test_value_least_and_price_are_in_order(self, c):
        least = float(minimum_impulse(maneuver_with(c)).norm)
        value, paid = overpayment.printed(c)
        slack = 1e-12 * (1 + abs(paid))
        assert value <= least + slack and least <= paid + slack and paid <= 1.25 * least + slack

    @pytest.mark.parametrize("sigma", [0.25, 0.75])
    def test_the_worst_is_one_impulse_at_a_quarter(self, sigma):
        c = response(np.array(sigma))
        assert overpayment.printed(c)[1] == pytest.approx(
            1.25 * float(minimum_impulse(maneuver_with(c)).norm)
        )

    def test_the_map_stays_between_one_and_five_quarters(self):
        image = figures.printed_impulses().axes[1].images[0].get_array()
        seen = image[np.isfinite(image)]
        assert seen.min() >= 1 - 1e-12 and 1.24 < seen.max() <= 1.25 + 1e-12


class TestLevelEquation:
    def test_both_functions_on_the_line_have_the_moments(self):
        maneuver = maneuver_with([0.15, 0.4, 0.2])
        _, line = figures.convex_level_equation(maneuver).axes
        drawn = [step.get_data() for step in line.lines if len(step.get_xdata()) == 6]
        assert len(drawn) == 2
        for s, level in drawn:
            powers = np.array([s**3 / 6, s**2 / 2, s])
            assert_allclose(np.diff(powers, axis=1) @ level[:-1], maneuver.moments, atol=1e-12)

    def test_the_curve_is_convex_and_passes_minus_three_sixteenths(self):
        t, g = curves(figures.convex_level_equation(maneuver_with([0.15, 0.4, 0.2])).axes[0])[0]
        slopes = np.diff(g) / np.diff(t)
        assert np.all(np.diff(slopes) > 0)
        assert np.interp(0.0, t, g) == pytest.approx(-3 / 16, abs=1e-3)

    def test_its_second_derivative_is_the_sum_shown(self):
        k2, k3, t = peak.k2, peak.k3, peak.t
        y = 1 - k3 * t
        shown = 3 * (k2 - k3) ** 2 / (2 * y**3) + 3 * k3**2 * y / 8
        assert sp.simplify(sp.diff(peak.level_equation(), t, 2) - shown) == 0

    @pytest.mark.parametrize(
        ("c", "words"),
        [((1.0, 0.0, 0.0), "one root only"), ((1 / 6, 0.5, 1.0), "constant"), ((0.0, 0.0, 0.0), "constant")],
    )
    def test_without_two_roots_it_is_refused(self, c, words):
        with pytest.raises(ValueError, match=words):
            figures.convex_level_equation(maneuver_with(np.array(c)))


class TestDuration:
    @given(maneuvers())
    def test_the_least_peak_changes_with_time_as_the_hamiltonian_says(self, maneuver):
        force, T = maneuver.disturbance, float(maneuver.duration)

        def solved(time):
            return minimum_peak(Maneuver(maneuver.x0, maneuver.xf, time, disturbance=force))

        centre, step = solved(T), 1e-5 * T
        assume(float(centre.norm) > 1e-3 and np.all(np.abs(centre.switch_condition) < 1e3))
        slope = (float(solved(T + step).norm) - float(solved(T - step).norm)) / (2 * step)
        predicted = -float(centre.norm) * float(duration.hamiltonian(centre))
        assert_allclose(slope, predicted, rtol=1e-4, atol=1e-4 * float(centre.norm) / T)

    def test_three_times_of_one_bound_are_the_roots_of_the_cubics(self):
        table = tables.times_of_one_bound([0, 1, 0], [3, 1, 0], 0.4, (2, 14))
        exact = [np.roots([0.4, 0, sign * 32, -sign * 96]) for sign in (1, -1)]
        real = sorted(float(z.real) for z in np.concatenate(exact) if abs(z.imag) < 1e-9 and z.real > 0)
        assert_allclose(table["$T$, s"], real, rtol=1e-12)
        assert table["least time"] == ["yes", "no", "no"]

    def test_from_rest_to_rest_it_never_rises(self):
        ax = figures.peak_over_duration([0, 0, 0], [1, 0, 0], (0.5, 4)).axes[0]
        falls, rises = curves(ax)[:2]
        assert np.all(np.isnan(rises[1])) and np.all(np.diff(falls[1]) < 0)


class TestFamily:
    @given(moments())
    def test_the_mean_norm_grows_with_the_exponent(self, c):
        assume(np.abs(c).max() > 1e-3)
        exponents = (1.2, 2.0, 6.0)
        maneuver = maneuver_with(c)
        ends = float(minimum_impulse(maneuver).norm), float(minimum_peak(maneuver).norm)
        chain = [ends[0], *(float(minimum_norm(maneuver, q).norm) for q in exponents), ends[1]]
        assert np.all(np.diff(chain) >= -1e-9 * ends[1])

    def test_the_drawn_curve_joins_the_three_problems(self):
        x, y = curves(figures.norm_family(MOVING).axes[1], least=20)[0]
        T = 2.0
        assert y[0] == pytest.approx(float(minimum_peak(MOVING).norm))
        assert y[-1] == pytest.approx(float(minimum_impulse(MOVING).norm) / T)
        middle = float(minimum_energy(MOVING).norm) / np.sqrt(T)
        assert np.interp(0.5, x, y) == pytest.approx(middle, rel=1e-3)

    def test_one_signed_programmes_cost_the_same(self):
        ax = figures.equally_cheap(maneuver_with([0.22, 0.5, 1.0])).axes[0]
        cost = [trapezoid(np.abs(u), t) for t, u in curves(ax)]
        assert cost[0] > 1.01  # the parabola changes sign
        assert_allclose(cost[2:], 1.0, atol=1e-3)


class TestRealTurn:
    def test_feedforward_keeps_the_plan_and_a_principal_axis_needs_none(self):
        quarter = Maneuver([0, 0, 0], [np.pi / 2, 0, 0], tf=60.0)
        missed = [y for ax in figures.real_turn(BODY, [1, 2, 2], quarter).axes[3:] for _, y in curves(ax)]
        assert min(np.nanmax(error) for error in missed[::2]) > 20
        assert max(np.nanmax(error) for error in missed[1::2]) < 1e-7
        axis = np.linalg.eigh(BODY.inertia)[1][:, 0]
        table = tables.turn_misses(BODY, axis, quarter)
        assert max(table["attitude missed, degrees"]) < 1e-7

    @pytest.mark.slow
    def test_attempts_reach_their_attitude_or_say_why_not(self):
        tried = figures.attempts(BODY, [2, -1, 2], (20, 160), duration=60.0)
        reached = Rotation.from_quat(tried[0].turn.attitude(60.0)[0], scalar_first=True).as_rotvec()
        assert_allclose(reached, np.deg2rad(20) * np.array([2, -1, 2]) / 3, atol=2e-6)
        assert tried[1].turn is None and "the iteration diverges" in tried[1].remark
        table = figures.attempts_table(tried)
        assert table["factor"][0] == pytest.approx(table["spherical body"][0], abs=0.05)
        assert table["factor"][1] is None and table["spherical body"][1] > 1
        assert len(figures.coupling_convergence(tried).axes) == 2


class TestTables:
    @given(st.floats(0.1, 3.0), st.floats(0.5, 20.0))
    def test_printed_examples_are_the_solvers(self, angle, T):
        table = tables.examples(angle, T)
        assert max(table["relative difference"]) < 1e-11 and max(table["certified gap"]) < 1e-12

    @given(maneuvers())
    def test_each_programme_is_the_cheapest_in_its_own_norm(self, maneuver):
        assume(np.abs(maneuver.moments).max() > 1e-6)
        table = tables.crossed_norms(maneuver)
        for i, column in enumerate(list(table)[1:]):
            assert table[column][i] <= min(table[column]) * (1 + 1e-6)

    def test_certificates_meet(self):
        table = tables.certificates(MOVING)
        assert_allclose(table["value"], table["bound from below"], rtol=1e-12)

    def test_impulse_rows_add_up(self):
        table = tables.impulse_examples([(1, 0, 0), (9 / 32, 3 / 4, 1)])
        assert table["regime"] == ["chebyshev", "moment"]
        assert table["impulses"] == ["4 at 0, −8 at 0.5, 4 at 1", "1 at 0.25"]
        assert_allclose(table["printed impulses pay"], [16, 1.25])


def test_every_outcome_of_the_search_has_a_mark():
    from pontryagin.triple_integrator.figures.search import OUTCOMES, WORDS

    assert list(OUTCOMES) == ["", *search.REASONS] and list(WORDS) == list(search.ROUTES)


def test_every_direction_of_the_search_is_drawn():
    survey = search.survey(12, routes=["multiplier", "multiplier within"])
    axes = figures.search_routes(survey).axes
    drawn = [sum(len(line.get_xdata()) for line in ax.lines) for ax in axes[:2]]
    assert drawn == [12, 12]
    assert "right: 100.0 %" in axes[1].get_title()


@pytest.mark.slow
@pytest.mark.parametrize(
    "draw",
    [
        lambda: figures.three_programmes(MOVING),
        figures.printed_impulses,
        lambda: figures.norm_family(MOVING, (1.5, 4.0)),
    ],
    ids=["three programmes", "printed impulses", "norm family"],
)
def test_figures_are_the_same_twice(draw):
    assert svg_of(draw()) == svg_of(draw())
