"""The search lap by lap finds what the walks along families of exact extremals find."""

import pytest

from pontryagin import Infeasible
from pontryagin.rendezvous.laps.equinoctial import Lap
from pontryagin.rendezvous.problem.cases import cases
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.lap_search import cost, extremals_on_laps, first_durations, on_lap
from pontryagin.rendezvous.reduced.search_log import SearchLog

WALKED = {
    "circle-energy": [0.028495, 0.364560],
    "energy-bounded": [0.092923],
    "inclined-energy": [0.294185, 0.432990, 0.613221],
    "circle": [2.190545, 5.050061],
    "ellipse": [3.277713, 5.291422, 6.385067],
    "inclined-1": [2.890030, 5.087636],
    "inclined-30": [3.662510, 5.811994],
    "ellipse-mixed": [0.102873, 0.108289, 0.108723, 0.109683, 0.155781, 0.182256, 0.212416, 0.228228],
    "mixed": [0.170536, 0.216663, 0.220253, 0.221912, 0.347983],
    "mixed-bounded": [0.178142, 0.216663, 0.220253, 0.221912],
    "ellipses": [3.912829, 6.835017],
    "mars": [3.076176, 4.838152],
    "glonass": [5.506520, 13.266876],
}
"""Costs, in the solver's units, of extremals found by walks along families of exact extremals."""


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
    lap = Lap.of(setting.scaled, 1)
    (root,) = on_lap(setting, lap, first_durations(setting, lap), log)
    assert root.residual < 1e-10 and log.revolutions == [1] and not log.given_up
    assert log.durations == [setting.duration]


def test_a_lap_that_is_over_before_the_start_has_no_first_transfer():
    setting = posed("circle-energy")
    assert first_durations(setting, Lap.of(setting.scaled, -2)) == []


def test_a_lap_that_costs_too_much_has_no_first_transfer():
    for name in ("circle-energy", "circle", "mixed"):
        setting = posed(name)
        lap = Lap.of(setting.scaled, 1)
        assert first_durations(setting, lap) and not first_durations(setting, lap, 0.02)


@pytest.mark.slow
def test_every_extremal_of_least_time_of_a_lap_is_found():
    setting, log = posed("inclined-60"), SearchLog()
    lap = Lap.of(setting.scaled, 1)
    found = on_lap(setting, lap, first_durations(setting, lap), log)
    assert sorted(cost(setting, root) for root in found) == pytest.approx([8.358898, 8.813095], abs=1e-6)


def test_a_bound_that_no_lap_can_keep_is_infeasible():
    setting = posed("energy-bounded").replace(peak=0.01)
    with pytest.raises(Infeasible, match="on each lap, which is above the peak"):
        list(extremals_on_laps(setting, SearchLog()))
