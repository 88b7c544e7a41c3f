"""Hypothesis profiles: fixed examples by default, and `HYPOTHESIS_PROFILE=deep` for a long random run."""

import gc
import os

from hypothesis import HealthCheck, settings

settings.register_profile("steady", derandomize=True, max_examples=25, deadline=None, database=None)
settings.register_profile(
    "deep", max_examples=2000, deadline=None, suppress_health_check=[HealthCheck.too_slow], print_blob=True
)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "steady"))


def pytest_collection_finish():
    """Let the garbage collector pass over what was loaded and collected: that lives to the end.

    It would be looked through again and again, and copied page by page in every process that a test forks.
    """
    gc.freeze()
