"""The direct method agrees with the extremals, better on a finer mesh."""

import pytest

from pontryagin.rendezvous import solve
from rendezvous_problems import BOUNDED, problem


@pytest.mark.slow
@pytest.mark.extra(name="bench")
def test_the_direct_method_agrees_and_its_error_shrinks_with_the_mesh():
    from pontryagin.rendezvous.judge.collocation import direct

    given = problem(20, duration=8.0)
    best = solve(given)
    errors = [abs(direct(given, 8.0, 0.7, n).cost / best.cost - 1) for n in (15, 30)]
    assert errors[0] < 1e-2 and errors[1] < errors[0] / 8


@pytest.mark.slow
@pytest.mark.extra(name="bench")
def test_the_direct_method_of_least_fuel_agrees_and_its_error_shrinks_with_the_mesh(fuel):
    from pontryagin.rendezvous.judge.collocation import direct

    errors = [abs(direct(BOUNDED, 6.0, 0.6, n, fuel=True).cost / fuel.cost - 1) for n in (20, 80)]
    assert errors[1] < 1e-4 and errors[1] < errors[0]
