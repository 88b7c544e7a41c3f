"""Units of the axes."""

from pontryagin.rendezvous.figures import labels
from pontryagin.rendezvous.problem.cases import (
    DAY,
    case,
)


def test_problems_in_km_and_s_are_shown_in_larger_units():
    own = labels.units(case("mars").problem)
    assert own.time == DAY and own.axis("$t$", "time") == "$t$ [d]"
    assert labels.units(case("glonass").problem).axis("$x$", "length") == "$x$ [$10^3$ km]"
    assert labels.units(case("mixed").problem).axis("$t$", "time") == "$t$"
