"""Figures and tables of false meetings hold the numbers of the family."""

import functools

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pontryagin.rendezvous import figures
from pontryagin.rendezvous.case_solutions import solved
from pontryagin.rendezvous.false_meetings.family import false_family
from pontryagin.rendezvous.figures import tables


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

    @pytest.mark.slow
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
