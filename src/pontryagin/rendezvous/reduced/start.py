"""The first extremal of the problem without bound, by continuation from coasting with zero costates.

The goal is moved from where the coasting craft ends to where the target will be, and the extremal follows it:
no thrust at the beginning of the path, the whole transfer at its end. The turn in the orbit's plane may
include any number of whole revolutions, each of which gives a family of extremals. A fixed duration is
reached directly, or from a shorter one by continuation in the duration. For a free duration a guess is made,
and the family over the duration is followed until the terminal law holds.
"""

import math
from collections.abc import Callable

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.rotation import about_third, conjugate, product
from pontryagin.progress import report
from pontryagin.rendezvous.estimate import ballistic_lead, gap_duration, orbit_change_duration
from pontryagin.rendezvous.families import freed, stretched
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.reduced.conditions import I3, Mismatch, Setting, goal_of, mismatch
from pontryagin.rendezvous.reduced.flight import (
    Flight,
    fly,
)
from pontryagin.rendezvous.reduced.search_log import SearchLog
from pontryagin.rendezvous.reduced.shooting import SHOOTING, meet
from pontryagin.rendezvous.root import Root

GoalPath = Callable[[float], tuple[Array, Array]]
"""A function of the share of the path that returns the goal (7,) and its rate (7,)."""

SEED: Array = np.array([0, 0, 0, 0, 0, 1e-6])
"""Costates of coasting; nu is slightly off zero, so that it has a direction."""
LEAST_STEP = 1 / 256
"""Smallest step of the goal, as a share of its path."""
TRIES = 60
"""Largest number of steps of the goal that are tried."""
TAU = 2 * math.pi
SHORT = 0.5
"""A free duration estimated from the gap between craft and target is tried first if it is below this."""
STRETCHED = (1.0, 0.6, 0.4, 0.2)
"""Shares of a fixed duration at which a first extremal is sought, to be stretched to that duration."""
GUESSED = (1.0, 1.5, 0.7, 2.5, 0.4)
"""Multiples of a guessed duration that are tried."""
MORE_TURNS = (0, 1, -1, 2, -2)
"""Revolutions tried in addition to the number that makes up half of the target's lead."""


def unbounded(setting: Setting, log: SearchLog) -> Root[Flight]:
    """An extremal of the unbounded problem, with the fixed duration or a free one.

    Raises
    ------
    NotConverged
        If no extremal is reached from any guess.
    """
    for duration in _durations(setting):
        log.durations.append(duration)
        for more in MORE_TURNS:
            turns = _even_turns(setting.scaled, duration) + more
            report(
                f"seeking a first extremal of duration {duration * setting.scaled.time:.3g}, "
                f"with {turns} turns of the goal"
            )
            try:
                fixed = cold_start(setting.replace(duration=duration), turns)
                return (freed if setting.free else stretched)(SHOOTING, setting, fixed)
            except NotConverged as reason:
                users = duration * setting.scaled.time
                log.given_up.append(
                    f"start with the duration {users:.3g} and {turns} turns of the goal: {reason}"
                )
    raise NotConverged("no extremal was found from which to continue", float("inf"))


def _durations(setting: Setting) -> list[float]:
    """Durations to start from: the fixed one and shorter ones, or guesses of a free one."""
    if setting.duration is not None:
        return [share * setting.duration for share in STRETCHED]
    usual, short = (guess(setting.scaled, setting.ratio) for guess in (orbit_change_duration, gap_duration))
    multiples = [usual * stretch for stretch in GUESSED]
    return [short, *multiples] if short < SHORT else multiples


def _even_turns(scaled: Scaled, duration: float) -> int:
    """Revolutions for which the craft turns by the mean of its own and the target's angle when coasting."""
    wanted = ballistic_lead(scaled, duration) / 2
    return round((wanted - coasting_twist(scaled, duration)) / TAU)


def cold_start(setting: Setting, revolutions: int = 0, seed: Array = SEED) -> Root[Flight]:
    """The unbounded extremal of a fixed duration, alpha2 = 1, by continuation from coasting.

    Parameters
    ----------
    setting : Setting
        A setting with a fixed duration.
    revolutions : int
        Revolutions of the goal on its path in addition to the shortest turn.
    seed : (6,) array
        Costates of the flight at whose end the goal starts; by default those of coasting.

    Raises
    ------
    NotConverged
        If the extremal cannot follow the goal.
    """
    loose = setting.replace(peak=math.inf, ratio=1.0)
    scaled, duration = loose.scaled, float(loose.duration or 0)
    costates, done, step = seed, 0.0, 1.0
    first = fly(scaled, costates, duration)
    path = _path(first, goal_of(loose, float(first.end[3]))[0], revolutions)
    for _ in range(TRIES):
        reached = min(1.0, done + step)
        moved = _chase(loose, costates, done, reached, path)
        if moved is None:
            step /= 2
            if step < LEAST_STEP:
                break
            continue
        costates, done, step = moved, reached, min(1.0, 1.5 * step)
        if done == 1:
            return meet(loose, costates)
    raise NotConverged(
        f"the goal could be moved only {100 * done:.1f} % of the way from coasting to the target", 1 - done
    )


def twist(relative: Array) -> float:
    """The angle about i3 when a turn is split into (turn about an axis normal to i3) o (turn about i3).

    It lies in (-pi, pi].
    """
    angle = 2 * math.atan2(relative[3], relative[0])
    return angle - 2 * math.pi * round(angle / (2 * math.pi))


def coasting_twist(scaled: Scaled, duration: float) -> float:
    """The angle in the orbit's plane from the coasting craft's end to the target there, in (-pi, pi]."""
    flight = fly(scaled, SEED, duration)
    goal, _ = scaled.target(float(flight.end[3]))
    return twist(product(conjugate(flight.attitude(flight.end)), goal[3:]))


def _path(flight: Flight, goal: Array, revolutions: int) -> GoalPath:
    """The path of the goal from the end of a flight to the target."""
    place = flight.attitude(flight.end)
    relative = product(conjugate(place), goal[3:])
    angle = twist(relative)
    tilt = product(relative, about_third(-angle))
    tilt = tilt if tilt[0] >= 0 else -tilt
    size = np.linalg.norm(tilt[1:])
    axis = np.concatenate([[0.0], tilt[1:] / size]) if size else np.zeros(4)
    half, whole = math.atan2(size, tilt[0]), angle + 2 * math.pi * revolutions
    here = flight.end[:3]

    def goal_at(share: float) -> tuple[Array, Array]:
        tilted = math.cos(share * half) * np.array([1.0, 0, 0, 0]) + math.sin(share * half) * axis
        attitude = product(product(place, tilted), about_third(share * whole))
        rate = product(product(place, product(tilted, half * axis)), about_third(share * whole))
        rate = rate + whole / 2 * product(attitude, I3)
        return (
            np.concatenate([here + share * (goal[:3] - here), attitude]),
            np.concatenate([goal[:3] - here, rate]),
        )

    return goal_at


def _chase(setting: Setting, costates: Array, done: float, reached: float, path: GoalPath) -> Array | None:
    """Costates of the extremal as the goal moves from one share of its path to another; None if that fails.

    They are predicted along the path and corrected by Newton's method without damping.
    """
    scaled, duration = setting.scaled, float(setting.duration or 0)
    goal, rate = path(done)

    def towards(goal: Array, z: Array) -> Mismatch:
        flight = fly(scaled, z, duration, rough=True)
        return mismatch(flight, goal)

    try:
        start = towards(goal, costates)
        z = costates - np.linalg.solve(start.by_start[:, :6], start.by_goal @ rate) * (reached - done)
        goal, last = path(reached)[0], np.inf
        for _ in range(8):
            here = towards(goal, z)
            step = np.linalg.solve(here.by_start[:, :6], -here.residual)
            size = float(np.linalg.norm(step))
            if not size < max(last, 1e-9):
                return None
            z, last = z + step, size
            if size < 1e-8 * (1e-6 + np.linalg.norm(z)):
                return np.asarray(z)
    except (NotConverged, np.linalg.LinAlgError):
        pass
    return None
