"""The costates in the elements are those of the flight."""

import numpy as np
import pytest

from pontryagin.rendezvous.elements.arcs import TIME
from pontryagin.rendezvous.figures import elements, elements_costates


@pytest.mark.slow
def test_the_hamiltonian_is_constant_and_the_costates_are_those_of_the_flight():
    solution = elements.in_elements("ellipse-mixed")
    figure = elements_costates.costates_along(solution)
    first, second, last = figure.axes
    assert np.abs(last.lines[0].get_ydata()).max() < 1e14 * 1e-12
    for k, line in enumerate([*first.lines, *second.lines]):
        assert line.get_ydata()[[0, -1]] == pytest.approx(
            [solution.flight.pieces[0].whole[8 + k], solution.flight.end[8 + k]], abs=1e-11
        )
    phi = np.linspace(0, solution.flight.phi, 11)
    states = solution.flight.sample(phi)
    assert states[-1, TIME] == pytest.approx(solution.flight.duration)
    wrong = states * np.where(np.arange(states.shape[1]) == 8, 1 + 1e-6, 1.0)
    assert np.abs(elements_costates.drift(solution, wrong, phi)).max() > 1e-9
