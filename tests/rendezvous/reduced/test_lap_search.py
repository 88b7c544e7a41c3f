"""The search lap by lap finds what the walks along families of exact extremals find."""

import pytest

from pontryagin import NotConverged
from pontryagin.rendezvous.problem.cases import cases
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.lap_search import cost, extremals_on_laps, on_lap
from pontryagin.rendezvous.reduced.search_log import SearchLog

WALKED = {
    "circle-energy": [0.028495, 0.364560],
    "energy-bounded": [0.092923],
    "inclined-energy": [0.294185, 0.432990, 0.613221],
    "circle": [2.190545, 5.050061],
}
"""Costs, in the solver's units, of the extremals that `solve` finds by walks along families."""


def posed(name):
    scaled = cases()[name].problem.scaled
    return Setting(scaled, scaled.ratio, scaled.peak, duration=scaled.duration)


@pytest.mark.slow
@pytest.mark.parametrize("name", WALKED)
def test_no_extremal_of_the_walks_is_missed(name):
    setting, log = posed(name), SearchLog()
    found = sorted(cost(setting, root) for root in extremals_on_laps(setting, log))
    for known in WALKED[name]:
        assert min(abs(value - known) for value in found) < 1e-6
    assert len(log.revolutions) == len(found) and len(log.ends) == 2


def test_an_extremal_on_a_lap_satisfies_the_conditions_and_is_logged():
    setting, log = posed("circle-energy"), SearchLog()
    (root,) = on_lap(setting, 1, log)
    assert root.residual < 1e-10 and log.revolutions == [1] and not log.given_up


def test_a_lap_that_is_over_before_the_start_is_logged_as_given_up():
    setting, log = posed("circle-energy"), SearchLog()
    assert on_lap(setting, -2, log) == []
    assert log.given_up[0].startswith("lap -2: ") and not log.revolutions


@pytest.mark.slow
def test_a_bound_that_no_lap_can_keep_is_not_converged():
    setting = posed("energy-bounded").replace(peak=0.01)
    with pytest.raises(NotConverged, match="on any lap"):
        extremals_on_laps(setting, SearchLog())
