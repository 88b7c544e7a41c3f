"""Solve for the second functional, alpha1 + alpha2 |p|, by smoothing the on-off thrust and sharpening it.

An entropy term of the throttle, with a given width, keeps the thrust smooth: p = p_max (1 + tanh(S/width))/2
with S = |n|/alpha2 - 1. The costates of an extremal of the first functional are scaled to give about the same
thrust. Then the goal is moved to the target, a free duration is changed until the terminal law holds, the
bound is lowered, and after it the width. Finally the jump itself replaces the smoothed one, and Newton's
method is used with the switches located as events.
"""

import math
from dataclasses import replace

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentValueError, NotConverged
from pontryagin.rendezvous.elements.conditions import ElementsSetting
from pontryagin.rendezvous.elements.flight import ElementFlight, switching
from pontryagin.rendezvous.elements.law import Law
from pontryagin.rendezvous.elements.shooting import SHOOTING, lead_round, meet
from pontryagin.rendezvous.elements.solution import ElementsExtremal
from pontryagin.rendezvous.elements.start import (
    lead_goal,
    least_energy,
)
from pontryagin.rendezvous.estimate import orbit_change_duration, require_solvable
from pontryagin.rendezvous.families import freed
from pontryagin.rendezvous.problem.rendezvous import Rendezvous
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.root import Root
from pontryagin.validation import integer

WIDTHS = (1.0, 0.5, 0.25, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002)
"""Widths of the smoothed jump, in the order in which they are used."""
SHARPENED_FROM = 0.1
"""Largest width at which the jump itself is tried in the place of the smoothed one."""
ROOM = 1.3
"""Smallest bound at the widest jump, in units of the largest thrust of the first functional."""


def least_fuel(problem: Rendezvous, revolutions: int = 0) -> ElementsExtremal:
    """A rendezvous of least integral of alpha1 + alpha2 |p|, whose thrust is either at the peak or zero.

    The problem's ``time_weight`` and ``energy_weight`` are alpha1 and alpha2; here alpha2 is the weight of
    |p|. One family of extremals is followed; other numbers of revolutions give other local optima.

    Parameters
    ----------
    problem : Rendezvous
        The problem to be solved; its peak must be finite.
    revolutions : int
        Revolutions in addition to the number nearest to that of the coasting craft.

    Returns
    -------
    ElementsExtremal
        Its ``modes`` alternate between "saturated" and "coast"; ``smoothed`` holds the extremals with a
        smoothed jump that were followed to it.

    Raises
    ------
    TypeError
        If ``problem`` is not a `Rendezvous`, or ``revolutions`` not an integer.
    ValueError
        If the peak is infinite, since the optimum then consists of a few impulses and is not a thrust; if
        ``energy_weight`` is 0, since that is the least-time problem of `solve` and `solve_in_elements`; or
        if the duration is free and the craft is with the target at the start.
    Infeasible
        If the duration is free and costs nothing.
    NotConverged
        If the family turns back or ends before it reaches the given problem.

    Examples
    --------
    >>> from pontryagin.rendezvous import Chaser, Orbit, Rendezvous, least_fuel
    >>> target = Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6)
    >>> leap = Rendezvous(Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]), target, time_weight=0, energy_weight=1,
    ...                   peak=0.15, duration=6.0)
    >>> found = least_fuel(leap)
    >>> found.modes, found.certificate.holds(1e-10)
    (('saturated', 'coast', 'saturated'), True)
    """
    require_solvable(problem)
    integer("revolutions", revolutions)
    if problem.energy_weight == 0:
        raise ArgumentValueError(
            "energy_weight must be greater than 0, got 0: only time would have a cost", "energy_weight"
        )
    if problem.peak == math.inf:
        raise ArgumentValueError(
            "peak must be finite, got inf: without a bound impulses approach the least integral of |p|, but "
            "no thrust attains it",
            "peak",
        )
    scaled = problem.scaled
    law = Law("fuel", scaled.ratio * scaled.acceleration, scaled.peak)
    value = problem.energy_weight * scaled.acceleration * scaled.time
    duration = scaled.duration or _guessed_duration(scaled)
    wide = _widest(scaled, law, duration, revolutions)
    smoothed, sharp = (
        _sharpen_freed(scaled, law, wide) if problem.free else _sharpen(scaled, law, wide, duration)
    )
    return ElementsExtremal(problem, sharp, value, tuple(smoothed))


def _sharpen_freed(
    scaled: Scaled, law: Law, wide: Root[ElementFlight]
) -> tuple[list[Root[ElementFlight]], Root[ElementFlight]]:
    """`_sharpen` for a free duration, with the terminal law in place of the duration.

    With the jump itself, arcs appear and vanish as the duration changes. The sharp extremal of a fixed
    duration is therefore followed to the terminal law only if the smoothed family ends.
    """
    try:
        return _sharpen(scaled, law, wide, None)
    except NotConverged:
        smoothed, sharp = _sharpen(scaled, law, wide, wide.flight.duration)
        return smoothed, freed(SHOOTING, ElementsSetting(scaled, law), sharp)


def _guessed_duration(scaled: Scaled) -> float:
    """A first guess of a free duration: 1.5 times what half the peak needs to change the orbit."""
    return 1.5 * orbit_change_duration(scaled, (scaled.peak / 2) ** 2)


def _widest(scaled: Scaled, law: Law, duration: float, revolutions: int) -> Root[ElementFlight]:
    """The extremal of the widest smoothed jump, under the bound of the problem."""
    gentle = least_energy(scaled, duration, revolutions)
    wide = replace(
        law, width=WIDTHS[0], peak=max(law.peak, ROOM * float(SHOOTING.thrust(gentle.flight).max()))
    )
    root = lead_goal(ElementsSetting(scaled, wide, duration), rescaled_unknowns(gentle, wide))
    fixed = scaled.duration
    if fixed is None:
        root = freed(SHOOTING, ElementsSetting(scaled, wide), root)

    def lowered(logarithm: float) -> ElementsSetting:
        return ElementsSetting(scaled, replace(wide, peak=math.exp(logarithm)), fixed)

    return lead_round(lowered, root, math.log(wide.peak), math.log(law.peak))


def _sharpen(
    scaled: Scaled, law: Law, wide: Root[ElementFlight], duration: float | None
) -> tuple[list[Root[ElementFlight]], Root[ElementFlight]]:
    """The extremals of smoothed jumps, widest first, and the extremal with the jump itself.

    Raises
    ------
    NotConverged
        If Newton's method with the jump itself fails from all of them.
    """

    def narrowed(logarithm: float) -> ElementsSetting:
        return ElementsSetting(scaled, replace(law, width=math.exp(logarithm)), duration)

    found = [wide]
    for width in WIDTHS[1:]:
        last = found[-1]
        found.append(lead_round(narrowed, last, math.log(last.flight.law.width), math.log(width)))
        if width <= SHARPENED_FROM:
            try:
                return found, meet(ElementsSetting(scaled, law, duration), found[-1].unknowns)
            except NotConverged:
                continue
    raise NotConverged(
        "the extremal with a smoothed thrust could not be continued to one with jumps of the thrust",
        WIDTHS[-1],
    )


def rescaled_unknowns(gentle: Root[ElementFlight], law: Law) -> Array:
    """Unknowns of an extremal of the first functional, scaled to give a smoothed thrust of about its size."""
    flight = gentle.flight
    grid = np.linspace(0.0, flight.phi, 201)
    size = float(np.sqrt(np.mean(switching(flight.sample(grid), grid) ** 2) * 3))
    share = min(0.9, size / 2 / law.peak)
    factor = max(0.1, 1 + law.width * math.atanh(2 * share - 1)) / size
    return np.asarray(gentle.unknowns * np.append(np.full(6, factor), 1.0))
