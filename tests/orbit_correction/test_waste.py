"""Impulses that the ball wastes: the paper's example; larger sets never need more impulses."""

import numpy as np
import pytest

from pontryagin.orbit_correction.printed import Z0
from pontryagin.orbit_correction.waste import count_impulses, random_states


def test_the_paper_fires_six_impulses_where_its_square_needs_five():
    found = count_impulses(Z0)
    assert found.counts["ball"] == 6 and found.counts["box"] == 5 and found.wasted() == 1


@pytest.mark.parametrize("interval", [0.25, 1.3])
def test_a_larger_set_never_needs_more(interval):
    found = count_impulses(random_states(60), interval=interval)
    assert np.all(found.counts["box"] <= found.counts["disc"])
    assert np.all(found.wasted() >= 0) and found.wasted().max() > 0


def test_random_states_are_seeded_and_of_the_size_asked_for():
    assert np.array_equal(random_states(5, 0.02), 2 * random_states(5, 0.01))
    assert np.std(random_states(4000, 0.5)) == pytest.approx(0.5, rel=0.03)
    for count in (0, 2.5):
        with pytest.raises(ValueError, match="count must be"):
            random_states(count)
