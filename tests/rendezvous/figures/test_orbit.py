"""The way in space ends at the target, and is drawn the same every time."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pontryagin.display.plotting import svg_of
from pontryagin.rendezvous import figures
from pontryagin.rendezvous.case_solutions import solved
from pontryagin.rendezvous.figures import paths


@pytest.mark.slow
def test_the_path_ends_at_the_meeting_which_is_at_the_target():
    ax = figures.orbit(solved("mixed-bounded")).axes[0]
    path = next(line for line in ax.lines if line.get_label() == "the way of the craft")
    star = next(line for line in ax.lines if line.get_label() == "meeting")
    assert_allclose(np.array(path.get_data_3d())[:, -1], np.ravel(star.get_data_3d()))
    target = paths.target_at(solved("mixed-bounded").problem, solved("mixed-bounded").duration)
    assert_allclose(np.ravel(star.get_data_3d()), target, atol=1e-10)


def test_a_figure_is_drawn_the_same_every_time():
    assert svg_of(figures.orbit(solved("mixed-bounded"))) == svg_of(figures.orbit(solved("mixed-bounded")))
