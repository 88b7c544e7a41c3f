"""A walk goes on where the duration turns back, and its points are extremals of their own durations."""

import math
from itertools import pairwise

import numpy as np
import pytest

from pontryagin import NotConverged
from pontryagin.rendezvous import Chaser, Orbit, Rendezvous
from pontryagin.rendezvous.laps import folds
from pontryagin.rendezvous.laps.equinoctial import Lap, reduced_costates
from pontryagin.rendezvous.laps.families import (
    LEAST_ENERGY,
    least_energy,
    least_energy_by_way_of,
    points,
    stretched,
)
from pontryagin.rendezvous.laps.transcription import ROUGH, Path, distance, extremal, transcribed
from pontryagin.rendezvous.problem.cases import cases
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.quadrature import energy
from pontryagin.rendezvous.reduced.shooting import meet

HALF = math.radians(30)
SCALED = Rendezvous(
    Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]),
    Orbit(1.2, 0.05, [math.cos(HALF), math.sin(HALF), 0, 0], 0.5),
    time_weight=0,
    energy_weight=1,
    peak=math.inf,
    duration=10.0,
).scaled
LAP, DURATION = Lap.of(SCALED, 0), SCALED.duration


def walk(path, duration):
    """Paths in steps of the logarithm of the duration, as far as they reach."""
    ends = math.log(path.duration), math.log(duration)
    found = points(lambda x, _: (LAP, LEAST_ENERGY, math.exp(x)), path, *ends, (0.05, 0.2, 0.01))
    return [Path.of(point.unknowns) for point in found]


def test_the_walk_turns_back_to_another_extremal_of_the_same_duration():
    start = least_energy(LAP, DURATION)
    shorter = walk(start, DURATION / 3)
    assert shorter[-1].duration > 0.9 * DURATION
    beyond = list(folds.along(LAP, LEAST_ENERGY, *shorter[-2:]))
    durations = np.array([path.duration for path in (*shorter[-1:], *beyond)])
    assert durations.min() < shorter[-1].duration and durations[-1] > 2 * DURATION
    before, after = next(pair for pair in pairwise(beyond) if pair[0].duration < DURATION <= pair[1].duration)
    share = (DURATION - before.duration) / (after.duration - before.duration)
    guess = Path.of(before.unknowns + share * (after.unknowns - before.unknowns))
    again = extremal(LAP, LEAST_ENERGY, DURATION, guess, ROUGH)
    setting = Setting(SCALED, SCALED.ratio, math.inf, duration=DURATION)
    starts = [reduced_costates(SCALED, LAP.axes, path.nodes[:, 0]) for path in (start, again)]
    costs = [energy(meet(setting, each).flight) for each in starts]
    assert costs == pytest.approx([0.30228, 0.27521], abs=1e-5)


def test_points_of_the_walk_satisfy_the_equations_of_an_extremal():
    shorter = walk(least_energy(LAP, DURATION), DURATION / 3)
    for path, _ in zip(folds.along(LAP, LEAST_ENERGY, *shorter[-2:]), range(12), strict=False):
        start = Path.of(shorter[-1].unknowns)
        assert np.abs(transcribed(LAP, LEAST_ENERGY, path.duration, path).residual).max() < 0.03
        assert distance(path, start) > 1e-3


def test_a_duration_is_reached_where_steps_of_the_duration_end_before(monkeypatch):
    start = least_energy_by_way_of(LAP, DURATION, DURATION / 2)
    found = stretched(LAP, start, 3 * DURATION, True)
    assert found.duration == pytest.approx(3 * DURATION, rel=1e-12)
    monkeypatch.setattr(folds, "STEPS", 0)
    with pytest.raises(NotConverged, match="the walk over the duration broke off at"):
        stretched(LAP, start, 3 * DURATION, True)


def test_scales_make_the_length_independent_of_the_number_of_nodes():
    scaled = cases()["inclined-30"].problem.scaled
    lap = Lap.of(scaled, 0)
    lengths = []
    for per_lap in (32, 128):
        first = least_energy_by_way_of(lap, 5.0, 5.0, per_lap=per_lap)
        pair = first, extremal(lap, LEAST_ENERGY, 5.2, first)
        change = (pair[1].unknowns - pair[0].unknowns) / folds.scales(pair[0])
        lengths.append(np.linalg.norm(change))
    assert lengths[0] == pytest.approx(lengths[1], rel=0.02)
