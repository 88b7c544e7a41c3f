"""The cost over the duration, and the extremals on it."""

import csv

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pontryagin.io.files import figures_folder
from pontryagin.rendezvous import figures
from pontryagin.rendezvous.case_solutions import solved
from pontryagin.rendezvous.figures.revolutions import branch


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

    @pytest.mark.checkout
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
            branch(solved("mixed-bounded"), 1, (5.0, 15.0), 1.0)
