"""Least fuel: thrust on or off, the limit of smoothed extremals, the law at the end."""

import numpy as np
import pytest

from pontryagin.rendezvous import (
    least_fuel,
    solve_in_elements,
)
from rendezvous_problems import BOUNDED, problem


@pytest.mark.slow
def test_the_thrust_of_least_fuel_is_on_or_off_and_switches_where_n_is_alpha2(fuel):
    assert set(fuel.modes) == {"saturated", "coast"} and len(fuel.modes) >= 3
    assert fuel.certificate.holds(1e-10) and float(fuel.certificate.switching) < 1e-12
    size = np.linalg.norm(fuel.switching(fuel.switch_times), axis=1)
    assert size == pytest.approx(BOUNDED.energy_weight, abs=1e-10)
    t = np.linspace(0, fuel.duration, 301)
    thrust, n = np.linalg.norm(fuel.control(t), axis=1), np.linalg.norm(fuel.switching(t), axis=1)
    assert np.allclose(thrust, np.where(n > 1, BOUNDED.peak, 0.0), atol=1e-14)
    edges = np.array([0.0, *fuel.switch_times, fuel.duration])
    on = [mode == "saturated" for mode in fuel.modes]
    assert fuel.cost == pytest.approx(BOUNDED.peak * np.diff(edges)[on].sum(), rel=1e-12)


@pytest.mark.slow
def test_the_fuel_of_the_smoothed_extremals_decreases_to_that_of_the_switching_one(fuel):
    spent = [float(root.flight.end[17]) * fuel.value for root in fuel.smoothed]
    assert spent == sorted(spent, reverse=True) and fuel.cost < spent[-1] < 1.03 * fuel.cost


def test_each_functional_is_smaller_along_its_own_extremal(fuel):
    first = solve_in_elements(BOUNDED)
    t = np.linspace(0, 6, 20001)
    other = np.linalg.norm(first.control(t), axis=1)
    middle = (other[1:] + other[:-1]) / 2 * np.diff(t)
    assert fuel.cost < float(middle.sum())
    assert first.cost < BOUNDED.peak * fuel.cost


@pytest.mark.slow
@pytest.mark.parametrize(("inclination", "time_weight", "peak"), [(0, 0.01, 0.15), (5, 0.2, 0.1)])
def test_a_solution_of_free_duration_obeys_the_law_at_the_end(inclination, time_weight, peak):
    given = problem(inclination, time_weight=time_weight, energy_weight=1, peak=peak)
    free = least_fuel(given)
    assert free.certificate.holds(1e-10)
    assert set(free.modes) == {"saturated", "coast"}
    n = np.linalg.norm(free.switching(free.duration), axis=1)[0]
    assert given.peak * (n - 1) == pytest.approx(time_weight, rel=1e-9)


BAD = {
    "peak must be finite, got inf: without a bound": lambda: least_fuel(problem(0, duration=6.0)),
    "energy_weight must be greater than 0": lambda: least_fuel(
        problem(0, time_weight=1, energy_weight=0, peak=1)
    ),
}


@pytest.mark.parametrize("message", BAD)
def test_the_error_of_a_wrong_argument_names_it(message):
    with pytest.raises(ValueError, match=message):
        BAD[message]()
