"""Solutions that several files of tests use."""

import pytest

from pontryagin.rendezvous import least_fuel, solve
from rendezvous_problems import BOUNDED, LEAP


@pytest.fixture(scope="session")
def leap():
    """The best extremal of `LEAP`."""
    return solve(LEAP)


@pytest.fixture(scope="session")
def fuel():
    """The extremal of least fuel of `BOUNDED`."""
    return least_fuel(BOUNDED)
