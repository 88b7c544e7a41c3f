"""Problems as values; the error of a wrong argument names it."""

import copy
import math
import pickle
from dataclasses import replace

import numpy as np
import pytest

from pontryagin.rendezvous import (
    Chaser,
    Orbit,
    Rendezvous,
)
from rendezvous_problems import LEAP, orbit, problem

BAD = {
    "attitude must be a unit quaternion": lambda: Orbit(1, 0.1, [1, 1, 0, 0], 0),
    "eccentricity must be less than 1": lambda: Orbit(1, 1.0, [1, 0, 0, 0], 0),
    "eccentricity must be at least 0": lambda: Orbit(1, -0.1, [1, 0, 0, 0], 0),
    "parameter must be greater than 0": lambda: Orbit(0, 0.1, [1, 0, 0, 0], 0),
    "anomaly must be a number and finite": lambda: Orbit(1, 0.1, [1, 0, 0, 0], math.nan),
    "r must be greater than 0": lambda: Chaser(-1, 0, 1, [1, 0, 0, 0]),
    "c must be greater than 0": lambda: Chaser(1, 0, 0, [1, 0, 0, 0]),
    "attitude must be an array": lambda: Chaser(1, 0, 1, [1, 0, 0]),
    "chaser must start on an ellipse": lambda: Rendezvous(Chaser(1, 0, 1.5, [1, 0, 0, 0]), orbit(0)),
    "peak must be greater than 0": lambda: problem(0, peak=0),
    "peak must be a number and finite": lambda: problem(0, peak=math.nan),
    "peak must be finite": lambda: problem(0, time_weight=1, energy_weight=0),
    "must not both be 0": lambda: problem(0, energy_weight=0, peak=1.0),
    "time_weight must be at least 0": lambda: problem(0, time_weight=-1),
    "duration must be greater than 0": lambda: problem(0, duration=0),
    "duration must be left free": lambda: problem(0, time_weight=1, energy_weight=0, peak=1.0, duration=5),
    "gravity must be greater than 0": lambda: problem(0, gravity=0),
}


@pytest.mark.parametrize("message", BAD)
def test_the_error_of_a_wrong_argument_names_it(message):
    with pytest.raises(ValueError, match=message):
        BAD[message]()


def test_problems_with_equal_numbers_are_equal_and_have_one_hash():
    other = Rendezvous(Chaser(1, 0, 1, (1.0, 0, 0, 0)), replace(LEAP.target), 0, 1, math.inf, duration=6)
    assert other == LEAP and hash(other) == hash(LEAP) and other.target == LEAP.target
    assert replace(LEAP, peak=1.0) != LEAP and LEAP.chaser != LEAP.target
    assert {LEAP: 1}[pickle.loads(pickle.dumps(LEAP))] == 1 == {copy.deepcopy(LEAP): 1}[LEAP]


def test_attitudes_are_read_only():
    for one in (LEAP.target, LEAP.chaser):
        with pytest.raises(ValueError, match="read-only"):
            one.attitude[:] = 0


def test_quaternions_in_single_precision_are_normalised():
    turn = np.array([np.cos(0.3), 0, 0, np.sin(0.3)], dtype=np.float32)
    assert np.linalg.norm(Orbit(1, 0, turn, 0).attitude) == pytest.approx(1, abs=1e-15)
    assert replace(LEAP, peak=np.float32("inf")).peak == math.inf


def test_numbers_beyond_double_precision_are_refused():
    with pytest.raises(ValueError, match="r must be a number that double precision holds"):
        Chaser(10**400, 0, 1, [1, 0, 0, 0])
    for other in (Orbit(1e150, 0, [1, 0, 0, 0], 0), Orbit(1e-150, 0, [1, 0, 0, 0], 0)):
        with pytest.raises(ValueError, match="must be of sizes that double precision holds"):
            replace(LEAP, target=other)
    for changes in ({"peak": 1e-320}, {"time_weight": 1e-200, "energy_weight": 1e200}):
        with pytest.raises(ValueError, match="must be of sizes that double precision holds"):
            replace(LEAP, **{"duration": None, "peak": 0.1} | changes)
    with pytest.raises(ValueError, match="chaser must start on an ellipse"):
        replace(LEAP, chaser=Chaser(1, 1e200, 1, [1, 0, 0, 0]))
