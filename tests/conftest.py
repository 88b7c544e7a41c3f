"""Hypothesis profiles, and tests that need an extra of the package.

The profiles: fixed examples by default, and `HYPOTHESIS_PROFILE=deep` for a long random run.
"""

import gc
import os
from importlib import metadata

import pytest
from hypothesis import HealthCheck, settings

settings.register_profile("steady", derandomize=True, max_examples=25, deadline=None, database=None)
settings.register_profile(
    "deep", max_examples=2000, deadline=None, suppress_health_check=[HealthCheck.too_slow], print_blob=True
)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "steady"))

EXTRAS = {"recording": "rerun-sdk", "report": "nbformat", "bench": "casadi"}
"""A package of each extra that tests need: where it is installed, so is the extra."""


def pytest_runtest_setup(item):
    for mark in item.iter_markers("extra"):
        try:
            metadata.version(EXTRAS[mark.kwargs["name"]])
        except metadata.PackageNotFoundError:
            pytest.skip(f"needs the extra {mark.kwargs['name']!r}")


def pytest_collection_finish():
    """Let the garbage collector pass over what was loaded and collected: that lives to the end.

    It would be looked through again and again, and copied page by page in every process that a test forks.
    """
    gc.freeze()
