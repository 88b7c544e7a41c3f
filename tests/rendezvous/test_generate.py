"""The committed kernels are those that the derivation generates."""

from pathlib import Path

import pytest

from pontryagin.rendezvous import generate, kernels


@pytest.mark.slow
def test_the_kernels_are_those_that_the_derivation_generates():
    assert Path(kernels.__file__).read_text() == generate.kernels()
