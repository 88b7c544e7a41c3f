"""Continuation of a transfer on a lap: to the target, to a price of time, to a bound, to least time.

Each continuation follows transcribed extremals over one parameter, from 0 to 1, with guesses by the secant.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.continuation import Point, march
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.laps.equinoctial import TAU, Lap
from pontryagin.rendezvous.laps.hamiltonian import RunningCost
from pontryagin.rendezvous.laps.start import least_energy_guess
from pontryagin.rendezvous.laps.transcription import (
    FEWEST,
    NODES_PER_LAP,
    Path,
    extremal,
    square,
)

LEAST_ENERGY = RunningCost(0.0, 1.0, math.inf)
FIRST, LARGEST, LEAST, TRIES = 0.3, 0.5, 1 / 64, 60
"""First, largest and least step of a continuation, and how many steps are tried."""
ITERATIONS = 8
"""Steps of Newton's method at each point of a continuation."""
ROUNDS = (3, 1)
"""Numbers of rounds of the guess that are tried."""
SHRINK = 4.0
"""Factor by which alpha2 falls on the way to least time."""
STAGES = 14
"""Largest number of these factors."""

Posed = Callable[[float], tuple[Lap, RunningCost, float | None]]
"""A function of the parameter that returns a lap, a cost, and the duration, which is None if it is free."""


def continued(posed: Posed, path: Path, first: float = FIRST, least: float = LEAST) -> Path:
    """The extremal at the parameter 1, from that at 0.

    Raises
    ------
    NotConverged
        If the continuation ends before.
    """

    def at(parameter: float, guess: Array) -> Point[None]:
        found = extremal(*posed(parameter), Path.of(guess), ITERATIONS)
        return Point(found.unknowns, parameter, None)

    start = Point(path.unknowns, 0.0, None)
    *_, last = march(at, start, 1.0, first=first, largest=LARGEST, least=least, tries=TRIES)
    if last.parameter < 1.0:
        raise NotConverged("the continuation on this lap ended", 1.0 - last.parameter)
    return Path.of(last.unknowns)


def least_energy(lap: Lap, duration: float) -> Path:
    """The extremal of least energy, without a bound, of a fixed duration.

    Raises
    ------
    NotConverged
        If it is reached neither from a guess nor from coasting.
    """
    for rounds in ROUNDS:
        guess = least_energy_guess(lap, duration, rounds)
        if guess is not None:
            try:
                return extremal(lap, LEAST_ENERGY, duration, guess)
            except NotConverged:
                continue
    return _from_coasting(lap, duration)


def _from_coasting(lap: Lap, duration: float) -> Path:
    """The extremal as the goal moves from the craft's orbit to the target's, at a fixed longitude."""
    end = lap.longitude(duration)[0]
    if end <= 0:
        raise NotConverged("the meeting is not ahead of the craft", math.inf)
    count = max(FEWEST, math.ceil(NODES_PER_LAP * end / TAU))
    nodes = np.zeros((12, count + 1))
    nodes[:5] = lap.start[:5, None]
    nodes[5] = np.linspace(0.0, end, count + 1)
    middles = (nodes[:, 1:] + nodes[:, :-1]) / 2
    coasting = float(kernels.equinoctial_weight(*[*middles[:3], middles[5]]).sum()) * end / count

    def posed(share: float) -> tuple[Lap, RunningCost, float]:
        goal = lap.start[:5] + share * (lap.goal - lap.start[:5])
        return replace(lap, goal=goal, end=end), LEAST_ENERGY, coasting + share * (duration - coasting)

    return continued(posed, Path(nodes, 0.0, end, coasting))


def priced(lap: Lap, path: Path, ratio: float) -> Path:
    """The extremal of free duration for alpha1/alpha2, without a bound, from one of a fixed duration.

    alpha1 is changed from the value for which the given duration is free.

    Raises
    ------
    NotConverged
        If the continuation ends before.
    """
    own = float(square(path.nodes[:, -1])) / 4
    return continued(
        lambda share: (lap, RunningCost(own * (ratio / own) ** share, 1.0, math.inf), None), path, first=0.5
    )


def bounded(lap: Lap, path: Path, cost: RunningCost, duration: float | None) -> Path:
    """The extremal under a bound, from one without.

    Raises
    ------
    NotConverged
        If the continuation ends before.
    """
    largest = float(path.switching().max()) / (2 * cost.energy_weight)
    if largest <= cost.peak:
        return path
    return continued(
        lambda share: (lap, replace(cost, peak=largest * (cost.peak / largest) ** share), duration), path
    )


def least_time(lap: Lap, path: Path, cost: RunningCost) -> Path:
    """The extremal of least time, alpha1 = 1 and alpha2 = 0, from one with the same bound and alpha2 > 0.

    alpha2 falls until the thrust is saturated at all nodes. Where the transcription with alpha2 = 0 has no
    solution, as may be where |n| nearly vanishes between nodes, the path with the least alpha2 is returned.

    Raises
    ------
    NotConverged
        If alpha2 could not be lowered until the thrust is saturated at all nodes.
    """
    scale = cost.time_weight
    nodes = path.nodes.copy()
    nodes[6:] /= scale
    path = replace(path, nodes=nodes, price=path.price / scale)
    weight = cost.energy_weight / scale
    for _ in range(STAGES):
        if float(path.switching().min()) > 2 * weight * cost.peak:
            break
        path = continued(partial(_cheaper, lap, cost.peak, weight), path, first=1.0, least=1 / 16)
        weight /= SHRINK
    try:
        return extremal(lap, RunningCost(1.0, 0.0, cost.peak), None, path)
    except NotConverged:
        return path


def _cheaper(lap: Lap, peak: float, weight: float, share: float) -> tuple[Lap, RunningCost, None]:
    """Least time with a share of one factor `SHRINK` taken off the weight of energy."""
    return lap, RunningCost(1.0, weight * SHRINK**-share, peak), None
