"""Intervals between impulses: controllability against SciPy's exponential; half and whole revolutions."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import expm

from pontryagin.orbit_correction import correct
from pontryagin.orbit_correction.intervals import singular_values, step_condition, sweep
from pontryagin.orbit_correction.printed import Z0
from pontryagin.orbit_correction.system.satellite import LINEAR


@pytest.mark.parametrize("interval", [0.25, 2.0, np.pi, 5.5])
def test_singular_values_are_those_of_the_controllability_matrix(interval):
    impulses = np.eye(3)[:, 1:]
    columns = np.hstack([expm(-LINEAR * j * interval) @ impulses for j in range(5)])
    found = singular_values(interval, 5)
    assert_allclose(found, np.linalg.svd(columns, compute_uv=False), rtol=1e-12)


def test_at_whole_revolutions_the_rank_is_two_and_at_half_ones_three():
    values = singular_values(np.pi * np.arange(1, 7), 6)
    assert np.all(values[1::2, 2] < 1e-13) and np.all(values[::2, 2] > 0.5)


def test_at_half_revolutions_the_even_step_has_no_ellipsoid():
    conditions = step_condition([0.25, np.pi])
    assert conditions[0].max() < 100 and conditions[1, 0] > 1e15 and conditions[1, 1] < 100


def test_close_to_whole_revolutions_the_span_falls_with_the_distance():
    values = singular_values(2 * np.pi - np.array([1e-2, 1e-3, 1e-4]), 4)[:, 2]
    assert_allclose(values[:-1] / values[1:], 10, rtol=1e-2)


@pytest.mark.parametrize("thrust", ["ball", "disc", "box"])
def test_the_sweep_is_that_of_single_plans_and_has_a_gap_at_whole_revolutions(thrust):
    found = sweep(Z0, [0.25, 1.0, np.pi, 2 * np.pi], thrust=thrust)
    for i in range(3):
        plan = correct(Z0, found.intervals[i], thrust=thrust)
        assert (found.impulses[i], found.gauge[i]) == (plan.impulse_count, plan.gauge)
    assert np.isnan([found.impulses[3], found.gauge[3], found.duration[3]]).all()
    assert found.duration[1] == found.impulses[1]


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: singular_values(0.25, 1), "impulses must be"),
        (lambda: singular_values(-0.25, 3), "intervals must be positive"),
        (lambda: step_condition(0.0), "intervals must be positive"),
        (lambda: sweep([1.0, 2.0], [0.25]), "z0 must be"),
    ],
)
def test_what_makes_no_sense_is_named(call, words):
    with pytest.raises(ValueError, match=words):
        call()
