"""Injection errors: moments, numbers of impulses, seeds, and the progress bar."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pontryagin.orbit_correction import correct
from pontryagin.orbit_correction.montecarlo import impulse_distribution, injection_errors

COVARIANCE = np.array([[1.6e-5, 0, -1.2e-5], [0, 1.0e-5, 0], [-1.2e-5, 0, 2.5e-5]])


def test_the_errors_have_the_covariance_asked_for():
    errors = injection_errors(COVARIANCE, 200_000)
    assert_allclose(np.cov(errors.T), COVARIANCE, atol=2e-7)
    assert_allclose(errors.mean(axis=0), 0, atol=5e-5)


def test_a_singular_covariance_keeps_to_its_plane():
    errors = injection_errors(np.outer([1, 2, 0], [1, 2, 0]) * 1e-5, 50)
    assert_allclose(errors[:, 1], 2 * errors[:, 0], atol=1e-9)
    assert_allclose(errors[:, 2], 0, atol=1e-9)


def test_counts_are_those_of_the_plans_and_larger_sets_need_fewer():
    found = impulse_distribution(COVARIANCE, 300, seed=3)
    for name, counts in found.counts.items():
        rows = [0, 7, 251, 299]
        assert counts[rows].tolist() == [
            int(correct(found.z0[row], thrust=name).impulse_count) for row in rows
        ]
    assert np.all(found.counts["box"] <= found.counts["disc"])
    assert np.all(found.counts["box"] <= found.counts["ball"])


def test_the_quantile_is_the_least_number_that_suffices():
    found = impulse_distribution(COVARIANCE, 200)
    for share in (0.5, 0.9, 0.99):
        enough = found.quantile("ball", share)
        counts = found.counts["ball"]
        assert (counts <= enough).mean() >= share > (counts < enough).mean()


def test_seeds_repeat():
    first, again, other = (impulse_distribution(COVARIANCE, 40, seed=seed) for seed in (5, 5, 6))
    assert np.array_equal(first.z0, again.z0) and not np.array_equal(first.z0, other.z0)


def test_progress_is_shown_when_asked_for_only(capsys):
    impulse_distribution(COVARIANCE, 20)
    assert capsys.readouterr() == ("", "")
    impulse_distribution(COVARIANCE, 20, verbose=True)
    shown = capsys.readouterr()
    assert shown.out == "" and "injection errors" in shown.err and "100%" in shown.err


@pytest.mark.parametrize(
    ("covariance", "samples", "words"),
    [
        (np.eye(2), 5, "covariance must be a symmetric"),
        ([[1, 1, 0], [0, 1, 0], [0, 0, 1]], 5, "covariance must be a symmetric"),
        (np.diag([1.0, 1.0, -1.0]), 5, "covariance must have no negative eigenvalue, got -1"),
        (np.full((3, 3), np.nan), 5, "covariance must be"),
        (np.eye(3), 0, "samples must be"),
    ],
)
def test_what_is_no_covariance_is_named(covariance, samples, words):
    with pytest.raises(ValueError, match=words):
        injection_errors(covariance, samples)
