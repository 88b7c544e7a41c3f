"""An unknown case is refused."""

import math

import pytest

from pontryagin.rendezvous import figures
from pontryagin.rendezvous.figures import labels
from pontryagin.rendezvous.problem.cases import (
    case,
)


def test_an_unknown_case_is_refused():
    with pytest.raises(ValueError, match="name must be one of"):
        figures.solved("moon")
    assert math.isclose(labels.units(case("mixed").problem).length, 1)
