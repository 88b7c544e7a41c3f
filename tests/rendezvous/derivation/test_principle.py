"""The magnitudes of (10) maximise the gain."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from pontryagin.rendezvous.derivation import (
    principle,
)


def test_the_magnitudes_of_10_maximise_the_gain():
    """The gain is the part of H that depends on the size of a thrust along n of (9)."""
    p, length = principle.thrust_magnitude, principle.switching_length
    assert principle.along_switching() == length * p - principle.energy_weight * p**2
    top = length / (2 * principle.energy_weight)
    assert principle.best_magnitudes() == (top, principle.peak, principle.peak)


@settings(max_examples=20)
@given(st.floats(0.0, 2.0), st.floats(0.05, 3.0), st.floats(0.02, 2.0))
def test_no_magnitude_on_a_grid_gains_more_than_that_of_10(length, weight, bound):
    share = np.linspace(0, bound, 4001)
    gain = -weight * share**2 + length * share
    values = {principle.s1: length, principle.e: 0, principle.nu[0]: 0, principle.energy_weight: weight}
    free = float(principle.stationary_magnitude().subs(values))
    best = min(free, bound)
    assert -weight * best**2 + length * best >= gain.max() - 1e-12
