"""The lines of the figures and the entries of the tables agree with the solutions."""

import csv
import functools
import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pontryagin.display.plotting import svg_of
from pontryagin.io.files import figures_folder
from pontryagin.rendezvous import Chaser, Extremal, Orbit, Rendezvous, figures
from pontryagin.rendezvous.elements.arcs import TIME
from pontryagin.rendezvous.false_meetings.family import false_family
from pontryagin.rendezvous.figures import elements, elements_costates, labels, paths, tables
from pontryagin.rendezvous.figures.revolutions import branch
from pontryagin.rendezvous.figures.series import drift
from pontryagin.rendezvous.problem.cases import (
    DAY,
    case,
    cases,
)

solved = figures.solved


def space() -> Extremal:
    return solved("mixed-bounded")


class TestPaths:
    @pytest.mark.slow
    def test_the_path_leads_from_the_craft_to_the_target(self):
        problem = space().problem
        times, places, thrust = paths.flight_path(problem, space().flight, 50)
        assert_allclose(places[0], [1, 0, 0], atol=1e-14)
        assert_allclose(places[-1], paths.target_at(problem, space().duration), atol=1e-10)
        assert times[-1] == pytest.approx(space().duration)
        assert_allclose(np.linalg.norm(thrust, axis=1), np.linalg.norm(space().control(times), axis=1))

    def test_the_second_differences_of_the_path_are_gravity_and_thrust(self):
        times, places, thrust = paths.flight_path(space().problem, space().flight, 4001)
        step = times[1] - times[0]
        gravity = -places / np.linalg.norm(places, axis=1, keepdims=True) ** 3
        acceleration = (places[2:] - 2 * places[1:-1] + places[:-2]) / step**2
        assert np.abs(acceleration - (gravity + thrust)[1:-1]).max() < 1e-4

    def test_both_orbits_are_ellipses_about_the_centre(self):
        problem = Rendezvous(
            Chaser(1.0, 0.2, 1.05, [0.6, 0, 0.8, 0]),
            Orbit.from_angles(1.5, 0.3, 0.4, 0.7, 0.2, 0.6),
            peak=0.1,
        )
        for points, size in (
            (paths.initial_orbit(problem), 1 / (2 - 0.2**2 - 1.05**2)),
            (paths.target_orbit(problem), 1.5 / (1 - 0.3**2)),
        ):
            r = np.linalg.norm(points, axis=1)
            assert r.min() + r.max() == pytest.approx(2 * size, rel=1e-3)
        assert_allclose(paths.target_orbit(problem)[0], paths.target_orbit(problem)[-1], atol=1e-12)
        gap = np.linalg.norm(paths.target_orbit(problem) - paths.target_at(problem, 3.0), axis=1)
        assert gap.min() < 0.03


class TestSeries:
    def test_the_curves_are_the_thrust_and_the_costates(self):
        axes = figures.series(space()).axes
        times = axes[0].lines[0].get_xdata()
        drawn = np.array([line.get_ydata() for line in axes[0].lines]).T
        assert_allclose(drawn, space().control(times), atol=1e-12)
        size = axes[1].lines[0].get_ydata()
        assert_allclose(size, np.linalg.norm(drawn, axis=1))
        assert size.max() == pytest.approx(0.08) and axes[1].lines[1].get_ydata()[0] == 0.08
        units = space().problem.scaled.costate_units
        shown = np.array([line.get_ydata() for ax in axes[4:] for line in ax.lines]).T
        assert_allclose(shown * units, space().costate(times), atol=1e-12)

    def test_the_switch_is_where_n_reaches_its_threshold(self):
        axes = figures.series(space()).axes
        curve, line = axes[2].lines[0], axes[2].lines[1].get_ydata()[0]
        switch = np.interp(space().switch_times[0], curve.get_xdata(), curve.get_ydata())
        assert switch == pytest.approx(line, rel=1e-3)
        assert [patch.get_x() for patch in axes[0].patches] == [0.0]
        assert axes[0].patches[0].get_width() == pytest.approx(space().switch_times[0])

    @pytest.mark.slow
    def test_the_hamiltonian_is_constant(self):
        flight = space().flight
        times = np.linspace(0, flight.duration, 101)
        assert np.abs(drift(space(), times, flight.sample(times))).max() < 1e-12
        fixed = solved("circle-energy")
        times = np.linspace(0, fixed.flight.duration, 101)
        assert np.abs(drift(fixed, times, fixed.flight.sample(times))).max() < 1e-12

    def test_problems_in_km_and_s_are_shown_in_larger_units(self):
        own = labels.units(case("mars").problem)
        assert own.time == DAY and own.axis("$t$", "time") == "$t$ [d]"
        assert labels.units(case("glonass").problem).axis("$x$", "length") == "$x$ [$10^3$ km]"
        assert labels.units(case("mixed").problem).axis("$t$", "time") == "$t$"


class TestSpace:
    def test_the_path_ends_at_the_meeting_which_is_at_the_target(self):
        ax = figures.orbit(space()).axes[0]
        path = next(line for line in ax.lines if line.get_label() == "the way of the craft")
        star = next(line for line in ax.lines if line.get_label() == "meeting")
        assert_allclose(np.array(path.get_data_3d())[:, -1], np.ravel(star.get_data_3d()))
        target = paths.target_at(space().problem, space().duration)
        assert_allclose(np.ravel(star.get_data_3d()), target, atol=1e-10)

    def test_there_is_a_panel_for_each_case(self):
        found = {"one": space(), "two": solved("circle-energy")}
        assert [ax.get_title() for ax in figures.trajectories(found).axes] == ["one", "two"]


class TestFalseMeetings:
    family = staticmethod(functools.cache(lambda: false_family(solved("ellipse-mixed"), [0.0, -0.5])))

    @pytest.mark.slow
    def test_the_gap_drawn_is_the_distance_missed(self):
        for ax, member in zip(figures.false_meetings(self.family()).axes, self.family().members, strict=True):
            gap = next(line for line in ax.lines if line.get_label() == "distance missed").get_xydata()
            assert np.linalg.norm(gap[1] - gap[0]) == pytest.approx(member.distance, abs=1e-9)
        assert "the true meeting" in figures.false_meetings(self.family()).axes[0].get_title()

    @pytest.mark.slow
    @pytest.mark.parametrize(("name", "angle"), [("ellipse-mixed", -0.5), ("mixed", -0.35)])
    def test_the_craft_ends_on_the_rotated_orbit_and_not_on_the_target_s(self, name, angle):
        (ax,) = figures.false_meetings(false_family(solved(name), [angle])).axes
        lines = {line.get_label(): line for line in ax.lines}
        places = {
            label: np.transpose(line.get_data_3d() if name == "mixed" else line.get_data())
            for label, line in lines.items()
        }
        end = places["craft at $t_k$"]
        rotated, orbit = (
            np.linalg.norm(places[label] - end, axis=1).min()
            for label in ("target's orbit, turned", "orbit of the target")
        )
        assert rotated < 0.03 < 0.05 < orbit
        assert np.linalg.norm(end - places["target at $t_k$"]) > 0.2

    def test_the_label_names_the_axis_of_the_rotation(self):
        plane = figures.missed(self.family()).axes[2]
        assert plane.get_xlabel() == r"turn of $\lambda(t_k)$ about the normal of the plane [°]"
        space_ = figures.missed(false_family(solved("mixed"), [-0.1, 0.0, 0.1])).axes[2]
        assert space_.get_xlabel() == r"turn of $\lambda(t_k)$ about $\nu^*$ [°]"
        costs = space_.lines[0].get_ydata()
        assert costs[0] < costs[1] < costs[2]

    def test_the_dots_mark_the_true_meetings(self):
        axes = figures.missed(self.family()).axes
        assert axes[1].lines[1].get_xdata() == [0.0]
        assert_allclose(axes[2].lines[0].get_ydata(), self.family().costs)

    def test_one_singular_value_of_the_printed_conditions_is_zero_to_rounding(self):
        ax = figures.singular_values({"case": solved("ellipse-mixed")}).axes[0]
        printed, repaired = (np.sort(line.get_xdata()) for line in ax.lines)
        assert (len(printed), len(repaired)) == (8, 7)
        assert printed[0] < 1e-15 < 1e-5 < printed[1] and repaired[0] > 1e-5

    def test_the_table_holds_the_angles_and_the_residuals(self):
        rows = tables.family(self.family())
        assert rows["turned by [°]"] == ["0", "-29"] and rows["(6) [°]"][1] == "28.6"
        ranks = tables.ranks({"case": self.family()})
        assert float(ranks["printed, smallest"][0]) < 1e-15 < float(ranks["repaired, smallest"][0])


class TestRevolutions:
    @pytest.mark.slow
    def test_the_slope_of_the_cost_over_the_duration_vanishes_at_the_extremal(self):
        best = solved("ellipse-mixed")
        points = branch(best, 1, (5.0, 17.0), 0.06)
        assert_allclose(points[0], [best.duration, best.cost], rtol=1e-9)
        curve = np.polynomial.Polynomial.fit(*points[:5].T, 4).deriv()
        assert abs(curve(best.duration)) < 1e-6 < abs(curve(points[4, 0]))
        mirrored = branch(best, -1, (5.0, 17.0), 0.06)
        assert mirrored[-1, 0] < best.duration < points[-1, 0]

    @pytest.mark.slow
    def test_the_dots_are_the_extremals(self):
        best = solved("ellipse-mixed")
        ax = figures.revolutions({"case": best}).axes[0]
        dots = [line.get_xydata()[0] for line in ax.lines if line.get_marker() == "o"]
        assert_allclose(dots, [[one.duration, one.cost] for one in [best, *best.others]])

    def test_the_meeting_at_360_degrees_on_the_curve_of_false_meetings_is_among_the_extremals(self):
        with (figures_folder() / "42-rendezvous-false-meetings" / "family.csv").open() as file:
            (row,) = (row for row in csv.DictReader(file) if row["turned by [°]"] == "360")
        best = solved("ellipse-mixed")
        found = [(one.duration, one.cost) for one in [best, *best.others]]
        wanted = (float(row["$t_k$"]), float(row["$J$"]))
        assert min(np.abs(np.subtract(one, wanted)).max() for one in found) < 2e-6

    def test_a_branch_of_a_bounded_problem_is_refused(self):
        with pytest.raises(
            ValueError, match=r"must be of a problem without a bound on the thrust, got a peak of 0\.08"
        ):
            branch(space(), 1, (5.0, 15.0), 1.0)


@pytest.mark.slow
def test_the_tables_hold_the_numbers_of_the_solutions():
    found = {name: solved(name) for name in ("mixed-bounded", "ellipse-mixed")}
    rows = tables.solutions(found)
    assert rows["arcs"] == ["SU", "U"]
    assert_allclose([float(value) for value in rows["$J$"]], [one.cost for one in found.values()], rtol=1e-9)
    assert_allclose(np.array(rows["direct $J$"], float), np.array(rows["$J$"], float), rtol=1e-6)
    residuals = tables.certificates(found)
    assert residuals.pop("case") == list(found)
    assert all(1 < float(value) < 1e4 for value in residuals.pop("condition"))
    largest = np.max([[float(value) for value in column] for column in residuals.values()], axis=0)
    wanted = [float(one.certificate.residual) for one in found.values()]
    assert_allclose(largest, wanted, rtol=0.5)
    assert largest.max() < 1e-10
    direct = tables.judge(found)
    assert direct["direct/J − 1, 40"][1].endswith("(another)")
    several = {name: 1 + len(best.others) for name, best in found.items() if best.others}
    assert {name: tables.others(found)["case"].count(name) for name in several} == several
    assert rows["others"] == [len(best.others) for best in found.values()]
    assert len(tables.titles()["case"]) == 15


class TestElements:
    @pytest.mark.slow
    def test_the_start_of_each_case_is_described(self):
        assert elements._with_start("circle-energy")[1] == "cold"
        assert elements._with_start("ellipse-mixed")[1] == "carried (cold: 0.0393)"
        for name in ("circle-energy", "ellipse-mixed"):
            assert elements.in_elements(name).cost == pytest.approx(solved(name).cost, rel=1e-10)

    def test_the_solutions_in_both_sets_of_variables_agree_in_all_cases(self):
        with (figures_folder() / "43-rendezvous-elements" / "agreement.csv").open() as file:
            rows = list(csv.DictReader(file))
        assert [row["case"] for row in rows] == list(cases())
        columns = ("difference of $J$", "of $t_k$", "of $|p(0)|$", "residual")
        assert max(float(row[name]) for row in rows for name in columns) < 1e-9
        assert {row["start"].split()[0] for row in rows} == {"cold", "carried"}

    def test_the_hamiltonian_is_constant_and_the_costates_are_those_of_the_flight(self):
        solution = elements.in_elements("ellipse-mixed")
        figure = elements_costates.costates_along(solution)
        first, second, last = figure.axes
        assert np.abs(last.lines[0].get_ydata()).max() < 1e14 * 1e-12
        for k, line in enumerate([*first.lines, *second.lines]):
            assert line.get_ydata()[[0, -1]] == pytest.approx(
                [solution.flight.pieces[0].whole[8 + k], solution.flight.end[8 + k]], abs=1e-11
            )
        phi = np.linspace(0, solution.flight.phi, 11)
        states = solution.flight.sample(phi)
        assert states[-1, TIME] == pytest.approx(solution.flight.duration)
        wrong = states * np.where(np.arange(states.shape[1]) == 8, 1 + 1e-6, 1.0)
        assert np.abs(elements_costates.drift(solution, wrong, phi)).max() > 1e-9


def test_a_figure_is_drawn_the_same_every_time():
    assert svg_of(figures.orbit(space())) == svg_of(figures.orbit(space()))


def test_an_unknown_case_is_refused():
    with pytest.raises(ValueError, match="name must be one of"):
        figures.solved("moon")
    assert math.isclose(labels.units(case("mixed").problem).length, 1)
