"""Figures and tables show the solvers' results: their lines are read back and checked."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pontryagin.averaging import (
    cost_errors,
    figures,
    kepler,
    smooth_example,
    spin_down,
)
from pontryagin.averaging.figures import pictures, tables
from pontryagin.display.plotting import svg_of

EPSILONS = (0.1, 0.05)


@pytest.fixture(scope="module")
def rippled():
    solution = smooth_example(1.0, 2.0, ripple=0.5)
    return solution, solution.exact(0.1)


@pytest.fixture(autouse=True)
def brief(monkeypatch):
    """Restrict the measured cost errors to one problem and three values of epsilon."""
    name = "rippled flywheel"
    known, whole = cost_errors.problems()[name], cost_errors.errors
    monkeypatch.setattr(cost_errors, "problems", lambda: {name: known})
    monkeypatch.setattr(cost_errors, "errors", lambda name, epsilons=(0.1, 0.05, 0.02): whole(name, epsilons))


def lines(axis, label):
    return [line for line in axis.lines if label in str(line.get_label())]


def labelled(figure):
    """Assert that the axes of a figure are labelled, and that it can be written."""
    assert any(axis.get_xlabel() for axis in figure.axes)
    assert any(axis.get_ylabel() for axis in figure.axes)
    assert len(svg_of(figure)) > 5000


@pytest.mark.slow
def test_figure_1_is_h_at_the_end_its_mean_and_the_roots():
    figure = figures.end_condition(EPSILONS)
    labelled(figure)
    for axis, epsilon in zip(figure.axes, EPSILONS, strict=True):
        found = pictures._extremals(epsilon)
        (exact,) = lines(axis, "at the end")
        (mean,) = lines(axis, "its mean")
        for one in found:
            assert abs(np.interp(one.duration, *exact.get_data())) < 0.05
        assert np.interp(1.0, *mean.get_data()) == pytest.approx(0, abs=0.3)
        shown = np.sort(np.concatenate([line.get_xdata() for line in lines(axis, "roots")]))
        assert_allclose(shown, np.sort([one.duration for one in found]))


def test_figure_2_is_the_cost_of_both_families_and_its_stationary_points():
    figure = figures.cost_over_end(EPSILONS)
    labelled(figure)
    for axis, epsilon in zip(figure.axes, EPSILONS, strict=True):
        (curve,) = lines(axis, "exact")
        (mean,) = lines(axis, "averaged")
        assert min(mean.get_ydata()) == pytest.approx(2.0, abs=1e-3)
        for kind, sign in (("minima", 1), ("maxima", -1)):
            (marks,) = lines(axis, kind)
            for tau, cost in zip(*marks.get_data(), strict=True):
                near = np.interp([tau - epsilon / 20, tau + epsilon / 20], *curve.get_data())
                assert np.all(sign * (near - cost) > -1e-3)


@pytest.mark.slow
def test_a_landscape_shows_every_extremal(rippled):
    solution, found = rippled
    figure = figures.landscape(solution, (0.1,))
    labelled(figure)
    shown = sum(
        len(line.get_xdata()) for kind in ("minima", "maxima") for line in lines(figure.axes[0], kind)
    )
    assert shown == len(found)


@pytest.mark.parametrize("draw", [figures.drift, figures.extremal_figure])
def test_an_extremal_is_drawn_over_the_averaged_solution(rippled, draw):
    solution, found = rippled
    figure = draw(solution, found[0])
    labelled(figure)
    assert figure.axes[0].get_ylabel() == "$v$"
    for line in lines(figure.axes[0], "exact") + lines(figure.axes[0], "averaged"):
        assert_allclose(line.get_ydata()[[0, -1]], [1.0, 2.0], atol=1e-9)


@pytest.mark.slow
def test_the_spiral_begins_and_ends_at_its_energies():
    solution = kepler(-0.5, 0.95, -0.35, 0.1)
    figure = figures.spiral(solution, solution.exact(0.1)[0])
    labelled(figure)
    for line in figure.axes[1].lines[:2]:
        assert_allclose(line.get_ydata()[[0, -1]], [-0.5, -0.35], atol=1e-8)


@pytest.mark.slow
def test_the_control_of_the_braked_body_runs_on_its_ellipse_and_the_printed_one_does_not():
    figure = figures.braking([1.0, 0.4, 2.0], [1.3, 0.55, 0.7], 1.6, 0.1)
    labelled(figure)
    derived, printed = (line.get_data() for line in figure.axes[1].lines[:2])
    assert_allclose((derived[0] / 1.3) ** 2 + (derived[1] / 0.55) ** 2, 1, atol=1e-12)
    assert np.abs((printed[0] / 1.3) ** 2 + (printed[1] / 0.55) ** 2 - 1).max() > 0.3
    flown, mean = (line.get_data() for line in figure.axes[2].lines[:2])
    assert mean[0][-1] == pytest.approx(float(spin_down([1.0, 0.4, 2.0], [1.3, 0.55, 0.7], 1.6).duration))
    assert flown[1][0] == pytest.approx(np.hypot(1.0, 0.4)) and flown[1][-1] < 1e-5


@pytest.mark.slow
def test_errors_are_drawn_over_their_slopes():
    figure = figures.error_slopes()
    axis = figure.axes[0]
    assert axis.get_xscale() == axis.get_yscale() == "log" and axis.get_ylabel() == "error of the cost"
    known = cost_errors.errors("rippled flywheel")
    for label, values in (
        ("averaged", known.averaged),
        ("ends", known.ends),
        ("varepsilon J_1", known.corrected),
    ):
        (line,) = lines(axis, label)
        assert_allclose(line.get_ydata(), values)
    cost = figures.cost_convergence(epsilons=(0.1, 0.05, 0.02))
    labelled(cost)
    (marks,) = lines(cost.axes[0], "exact")
    assert_allclose(marks.get_ydata(), known.exact)


def columns(table):
    sizes = {len(column) for column in table.values()}
    assert len(sizes) == 1
    return sizes.pop()


@pytest.mark.slow
def test_the_table_of_counts_holds_what_is_found_and_predicted():
    table = tables.root_counts(EPSILONS)
    assert columns(table) == 2
    assert table["extremals"] == [3, 7] and table["predicted"] == ["3.5", "7.0"]


@pytest.mark.slow
def test_tables_hold_their_columns(rippled):
    solution, found = rippled
    assert columns(tables.rotors()) == 8
    closed = tables.closed_forms()
    assert columns(closed) == 7 and max(map(float, closed["difference"])) < 1e-10
    assert columns(tables.extremals(found, 2)) == 2
    answers = tables.answers(solution, 0.1)
    assert columns(answers) == 3
    assert [float(cost) for cost in answers["cost"]] == pytest.approx(
        [2.0, 2.0 + 0.1 * float(solution.correction()), found[0].cost], abs=1e-7
    )
    assert columns(tables.slopes()) == 1
