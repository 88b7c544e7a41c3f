"""The curves over time are those of the solution."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pontryagin.rendezvous import figures
from pontryagin.rendezvous.case_solutions import solved
from pontryagin.rendezvous.figures.series import drift


def test_the_curves_are_the_thrust_and_the_costates():
    axes = figures.series(solved("mixed-bounded")).axes
    times = axes[0].lines[0].get_xdata()
    drawn = np.array([line.get_ydata() for line in axes[0].lines]).T
    assert_allclose(drawn, solved("mixed-bounded").control(times), atol=1e-12)
    size = axes[1].lines[0].get_ydata()
    assert_allclose(size, np.linalg.norm(drawn, axis=1))
    assert size.max() == pytest.approx(0.08) and axes[1].lines[1].get_ydata()[0] == 0.08
    units = solved("mixed-bounded").problem.scaled.costate_units
    shown = np.array([line.get_ydata() for ax in axes[4:] for line in ax.lines]).T
    assert_allclose(shown * units, solved("mixed-bounded").costate(times), atol=1e-12)


def test_the_switch_is_where_n_reaches_its_threshold():
    axes = figures.series(solved("mixed-bounded")).axes
    curve, line = axes[2].lines[0], axes[2].lines[1].get_ydata()[0]
    switch = np.interp(solved("mixed-bounded").switch_times[0], curve.get_xdata(), curve.get_ydata())
    assert switch == pytest.approx(line, rel=1e-3)
    assert [patch.get_x() for patch in axes[0].patches] == [0.0]
    assert axes[0].patches[0].get_width() == pytest.approx(solved("mixed-bounded").switch_times[0])


@pytest.mark.slow
def test_the_hamiltonian_is_constant():
    flight = solved("mixed-bounded").flight
    times = np.linspace(0, flight.duration, 101)
    assert np.abs(drift(solved("mixed-bounded"), times, flight.sample(times))).max() < 1e-12
    fixed = solved("circle-energy")
    times = np.linspace(0, fixed.flight.duration, 101)
    assert np.abs(drift(fixed, times, fixed.flight.sample(times))).max() < 1e-12
