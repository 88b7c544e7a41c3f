"""Optional packages: installed ones are found; a missing one gives one warning per process."""

import warnings

import pytest

from pontryagin.numerics.packages import installed


def test_a_present_package_is_found_without_a_warning():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert installed("numpy", "nothing runs")


def test_a_missing_package_warns_once_and_names_itself():
    with pytest.warns(UserWarning, match="no_such_package is not installed; all is slow"):
        assert not installed("no_such_package", "all is slow")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert not installed("no_such_package", "all is slow")
