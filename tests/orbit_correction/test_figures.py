"""Figures and tables: their lines and entries are read back and compared with the mathematics."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pontryagin.display.plotting import svg_of
from pontryagin.orbit_correction import close_loop, correct, figures, sets
from pontryagin.orbit_correction.figures import flight, growth, impulses, tables
from pontryagin.orbit_correction.montecarlo import impulse_distribution
from pontryagin.orbit_correction.plan.thrust import THRUSTS, Thrust
from pontryagin.orbit_correction.printed import Z0
from pontryagin.orbit_correction.waste import count_impulses, random_states

PLAN = correct(Z0)


class TestSets:
    @pytest.mark.parametrize("square", [False, True])
    def test_support_points_lie_on_the_boundary_with_the_normal_asked_for(self, square):
        generator = np.random.default_rng(1)
        factors, normals = generator.normal(size=(4, 3, 3)), generator.normal(size=(30, 3))
        points = sets.support_points(factors, normals, square)
        along = np.einsum("ni,kij->nkj", normals, factors)
        support = np.abs(along).sum(axis=(1, 2)) if square else np.linalg.norm(along, axis=2).sum(axis=1)
        assert_allclose(np.einsum("ni,ni->n", normals, points), support, rtol=1e-12)
        assert np.all(normals @ points.T <= support[:, None] + 1e-12)

    def test_in_its_frame_a_set_reaches_from_minus_one_to_one_and_right_angles_stay(self):
        factors = Thrust("ball", 0.25, 0.0035).factors(4)
        frame = sets.frame_of(factors, square=False)
        directions = np.random.default_rng(2).normal(size=(400, 3))
        surface = frame.points(sets.support_points(factors, frame.back(directions), False))
        assert_allclose(np.abs(surface).max(axis=0), 1.0, atol=0.05)
        unit = directions / np.linalg.norm(directions, axis=1, keepdims=True)
        assert_allclose(frame.normals(frame.back(directions)), unit, atol=1e-12)
        assert np.all(unit @ surface.T <= np.einsum("ni,ni->n", unit, surface)[:, None] + 1e-12)

    def test_states_lie_on_alpha_times_the_remaining_set_with_normal_minus_psi(self):
        for k in range(4):
            factors = figures.sets._at_step(PLAN, 4, k)
            reached = sets.support_points(factors, -PLAN.costates[k], False)
            assert_allclose(PLAN.gauge * reached, PLAN.states[k], atol=1e-13)

    def test_the_drawn_path_ends_in_the_middle(self):
        path = next(
            line for line in figures.controllable_sets(PLAN).axes[0].lines if len(line.get_data_3d()[0]) == 5
        )
        assert_allclose(np.array(path.get_data_3d())[:, -1], 0.0, atol=1e-10)

    def test_what_has_no_set_is_refused(self):
        with pytest.raises(ValueError, match="must have a step"):
            figures.controllable_sets(correct([0.0, 0.0, 0.0]))
        with pytest.raises(ValueError, match="at most 6 steps, got 7"):
            figures.remaining_sets(correct(Z0, interval=np.pi, thrust="box"))

    @pytest.mark.parametrize("thrust", ["ball", "box"])
    def test_each_panel_has_the_state_on_the_line_that_the_set_does_not_cross(self, thrust):
        plan = correct(Z0, thrust=thrust)
        for k, ax in enumerate(figures.remaining_sets(plan).axes):
            drawn = ax.patches[0].get_xy()
            (across, up), line = ax.lines[2].get_data(), ax.lines[1].get_xdata()[0]
            assert line == across[0] == pytest.approx(drawn[:, 0].max(), rel=1e-12)
            size = np.linalg.norm(100 * plan.states[k])
            assert np.hypot(across[0], up[0]) <= size * (1 + 1e-12)
            assert drawn[:, 1].min() < up[0] < drawn[:, 1].max()
            assert ax.get_aspect() == 1

    def test_the_outlines_are_those_of_the_surfaces(self):
        space, *planes = figures.controllable_sets(PLAN).axes
        for ax, view in zip(planes, figures.sets.VIEWS, strict=True):
            largest = np.array(ax.patches[0].get_xy())
            assert_allclose(np.abs(largest).max(axis=0), 1.0, atol=1e-3)
            path = np.array(next(line.get_xydata() for line in ax.lines if len(line.get_xdata()) == 5))
            drawn = next(line.get_data_3d() for line in space.lines if len(line.get_data_3d()[0]) == 5)
            assert_allclose(path, np.array(drawn)[list(view)].T)


class TestImpulses:
    @pytest.mark.parametrize("thrust", THRUSTS)
    def test_the_drawn_motion_starts_at_the_state_and_ends_at_rest(self, thrust):
        plan = correct(Z0, thrust=thrust)
        times, states = impulses.linear_path(plan, 7)
        assert_allclose(states[0], Z0)
        assert_allclose(states[-1], 0, atol=1e-14)
        assert times[-1] == pytest.approx(0.25 * int(plan.impulse_count))
        drawn = figures.plan_figure(plan).axes[0].lines[0].get_ydata()
        assert drawn[0] == Z0[0] and abs(drawn[-1]) < 1e-14

    def test_the_hodograph_stays_in_the_square_and_the_disc_s_in_the_disc(self):
        plans = [correct(Z0, thrust=name) for name in THRUSTS]
        for ax, plan in zip(figures.hodograph(plans).axes, plans, strict=True):
            points = np.array(ax.lines[-1].get_data())
            assert_allclose(points.T, plan.impulses / 0.0035)
            assert np.abs(points).max() <= 1
        assert np.linalg.norm(plans[1].impulses, axis=1).max() <= 0.0035

    def test_each_bar_is_the_impulse_of_its_plan(self):
        plan = correct(Z0, thrust="disc")
        heights = [bar.get_height() for bar in figures.alternatives(plan).axes[0].patches]
        expected = [one.impulses[:, 0] / 0.0035 for one in impulses.same_length(plan)]
        assert_allclose(heights, np.concatenate(expected))

    def test_places_that_agree_are_numbered_together(self):
        assert impulses._numbered(np.array([[0.5, 0], [1, 1], [0.5, 0]])) == {(0.5, 0): "0, 2", (1, 1): "1"}

    def test_no_impulse_is_no_picture(self):
        with pytest.raises(ValueError, match="must have an impulse"):
            figures.plan_figure(correct([0.0, 0.0, 0.0]))


class TestGrowth:
    @pytest.mark.slow
    def test_curves_are_in_the_order_of_their_sets(self):
        ax = figures.gauge_over_impulses(Z0, most=9).axes[0]
        drawn = {line.get_label(): dict(zip(*line.get_data(), strict=True)) for line in ax.lines}
        for count in (3, 5, 6, 8, 9):
            ordered = ["square", "$p$-ball, $p = 16$", "$p$-ball, $p = 8$", "ball (the paper)"]
            chain = [drawn[name][count] for name in ordered]
            assert np.all(np.diff(chain) > 0)
            assert drawn["square"][count] <= drawn["disc"][count]

    def test_the_crossing_of_one_is_the_number_of_impulses(self):
        for name in THRUSTS:
            counts, alpha = growth.gauges(Z0, name, 12, 0.25, 0.0035)
            assert counts[np.argmax(alpha <= 1)] == correct(Z0, thrust=name).impulse_count


class TestBeyond:
    def test_every_state_is_in_the_picture_of_waste(self):
        found = count_impulses(random_states(40))
        left, right = figures.wasted_impulses(found).axes
        assert left.collections[0].get_sizes().sum() == 5 * 40
        assert sum(bar.get_height() for bar in right.patches) == pytest.approx(2)

    def test_the_residual_s_slope_is_two(self):
        lines = [line for line in figures.nonlinear_residual(Z0).axes[0].lines if len(line.get_xdata()) == 25]
        for line in lines:
            assert flight.fitted_slope(*line.get_data()) == pytest.approx(2, abs=0.01)

    def test_replanning_ends_below_rounding(self):
        loops = {"box": close_loop(Z0, thrust="box")}
        x, y = figures.replanning(loops).axes[0].lines[0].get_data()
        assert x.tolist() == [0, 5, 7, 9] and y[-1] < 1e-14

    def test_at_whole_revolutions_the_curve_has_a_gap(self):
        above, below = figures.impulses_over_interval(Z0, longest=2 * np.pi, points=8).axes
        assert np.isnan(above.lines[0].get_ydata()[-1]) and np.isfinite(above.lines[0].get_ydata()[:-1]).all()
        least = below.lines[2].get_ydata()
        assert least[-1] < 1e-10 < least[:-50].min()

    def test_the_distance_from_the_limit_falls_like_one_over_the_number(self):
        right = figures.ergodic_limit(Z0, most=400, points=20).axes[1]
        for line in right.lines[:3]:
            count, distance = (np.asarray(values) for values in line.get_data())
            assert np.all(distance[4:] * count[4:] < 40) and distance[-1] < distance[0] / 20

    def test_shares_of_injections_add_up(self):
        found = impulse_distribution(1e-5 * np.eye(3), 60)
        left, right = figures.injection_impulses(found).axes
        assert sum(bar.get_height() for bar in left.patches) == pytest.approx(3)
        assert right.lines[0].get_ydata()[-1] == pytest.approx(1)


class TestTables:
    @pytest.mark.parametrize("table", [tables.states, tables.costates, tables.controls])
    def test_no_printed_number_is_off_by_a_unit(self, table):
        columns = table(PLAN)
        away = [
            float(text.replace("−", "-")) for name in columns if "units" in name for text in columns[name]
        ]
        assert len(away) >= 12 and max(np.abs(away)) < 1
        for i, symbol in enumerate("123"):
            printed, ours = (
                [float(text.replace("−", "-")) for text in values]
                for name, values in list(columns.items())[1 + 3 * i : 3 + 3 * i]
            )
            assert_allclose(ours, printed, atol=1e-4), symbol

    def test_only_the_derived_inputs_give_the_printed_gauge(self):
        columns = tables.printed_inputs(Z0)
        derived, printed = columns[r"$\alpha(4)$"]
        assert abs(derived - 0.9286) < 1e-4 < 0.01 < abs(printed - 0.9286)
        assert min(columns[r"$\alpha(3)$"]) > 1

    def test_a_plan_of_another_length_has_no_such_table(self):
        with pytest.raises(ValueError, match="must have 5 rows"):
            tables.states(correct(np.multiply(2, Z0)))

    def test_each_plan_is_the_least_in_its_own_measure(self):
        columns = tables.crossed_measures([correct(Z0, thrust=name) for name in THRUSTS])
        for start in (0, 3, 6):
            for row, name in enumerate(list(columns)[2:5]):
                values = columns[name][start : start + 3]
                assert values[row] <= min(values) * (1 + 1e-9)

    @pytest.mark.slow
    def test_the_rows_of_proofs(self):
        columns = tables.gauges([correct(Z0, thrust=name) for name in THRUSTS])
        assert columns["impulses"] == [6, 5, 5] and max(columns["gap"]) < 1e-12
        assert min(columns[r"$\alpha$ with a step less"]) > 1
        balls = tables.power_balls(Z0, (2, 16))
        assert balls["steps"] == [4, 3] and balls[r"$\alpha$"][0] == pytest.approx(float(PLAN.gauge))

    def test_limits_and_loops_and_intervals(self):
        table = tables.limits(Z0, {"quarter": np.pi / 2}, steps=400)
        assert_allclose(table[r"$\alpha N$ at $N = 400$"], table["limit"], rtol=1e-10)
        loop = tables.closed_loop({"ball": close_loop(Z0)})
        assert loop["impulses"] == [6, 2, 2] and loop["leaves"][0] == loop["starts from"][1]
        special = tables.special_intervals(Z0, {"half": np.pi})
        assert special["gap"][0] < 1e-12 and special["impulses"] == [8]

    def test_counts_over_states(self):
        found = count_impulses(random_states(30))
        table = tables.waste_table(found)
        assert table["mean"][0] - table["mean"][2] == pytest.approx(table["wasted by the ball, mean"][2])
        errors = tables.distribution(impulse_distribution(1e-5 * np.eye(3), 50))
        assert all(a <= b for a, b in zip(errors["enough for 50 %"], errors["enough for 99 %"], strict=True))


@pytest.mark.slow
@pytest.mark.parametrize(
    "draw",
    [lambda: figures.controllable_sets(PLAN), lambda: figures.remaining_sets(PLAN)],
    ids=["sets", "remaining"],
)
def test_figures_are_the_same_twice(draw):
    assert svg_of(draw()) == svg_of(draw())
