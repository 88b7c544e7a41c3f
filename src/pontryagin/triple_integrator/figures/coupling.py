"""Convergence of the iteration over the cross-coupling, and the angles beyond which it fails."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.display.plotting import BLUE, INK, RED, SEQUENTIAL, styled, subplots
from pontryagin.errors import NotConverged
from pontryagin.triple_integrator.attitude.rigid_body import RigidBody
from pontryagin.triple_integrator.coupling import CoupledManeuver, couple, spherical_factor
from pontryagin.triple_integrator.norms.energy import minimum_energy
from pontryagin.triple_integrator.problem.maneuver import Maneuver
from pontryagin.value import value_class

TOLERANCE = 1e-6
"""The target counts as reached if the miss is at most this, rad."""


@value_class
@dataclass(frozen=True, eq=False)
class Attempt:
    """A coupled turn from rest to rest by an angle (degrees), or the reason why none was found."""

    degrees: float
    turn: CoupledManeuver | None
    remark: str


def attempts(
    body: RigidBody, direction: ArrayLike, degrees: Sequence[float], duration: float
) -> list[Attempt]:
    """Turns about one direction by several angles in one time, each iterated to 1e-6 rad.

    Parameters
    ----------
    body : RigidBody
        The body that turns.
    direction : (3,) array_like
        Direction of the rotation vector to reach.
    degrees : sequence of float
        The angles.
    duration : float
        Duration T of each turn, s.
    """
    unit = np.asarray(direction, dtype=float) / np.linalg.norm(np.asarray(direction, dtype=float))
    return [_attempt(body, unit, angle, duration) for angle in degrees]


def attempts_table(tried: Sequence[Attempt]) -> dict[str, list[Any]]:
    """A row for each angle: iterations, factor measured and of a spherical body, and the outcome."""
    return {
        "angle, degrees": [attempt.degrees for attempt in tried],
        "first miss, rad": [round(attempt.turn.misses[0], 6) if attempt.turn else None for attempt in tried],
        "motions integrated": [len(attempt.turn.misses) if attempt.turn else None for attempt in tried],
        "factor": [round(attempt.turn.factor, 6) if attempt.turn else None for attempt in tried],
        "spherical body": [
            round(float(spherical_factor(np.deg2rad(attempt.degrees))), 6) for attempt in tried
        ],
        "outcome": [attempt.remark for attempt in tried],
    }


@styled
def coupling_convergence(tried: Sequence[Attempt]) -> Figure:
    """The miss of the target by each iterate, and the factor between iterates against the angle of the turn.

    Parameters
    ----------
    tried : sequence of Attempt
        Returned by `attempts`; those that did not converge are marked in the second panel.
    """
    figure, (left, right) = subplots(1, 2, height=3.4, width_ratios=(1.15, 1))
    settled = [(attempt.degrees, attempt.turn) for attempt in tried if attempt.turn]
    for degrees, turn in settled:
        paint = mpl.colormaps[SEQUENTIAL](0.85 * degrees / settled[-1][0])
        left.semilogy(turn.misses, "o-", color=paint, markersize=3, label=f"{degrees:g}°")
    left.set(xlabel="iteration", ylabel="miss of the target, rad")
    left.legend(title="angle", loc="upper right")
    every = np.linspace(0.5, 150, 300)
    right.axhspan(1, 2, color=RED, alpha=0.08, linewidth=0)
    right.text(6, 1.03, "leads away", color=RED, va="bottom")
    right.plot(every, spherical_factor(np.deg2rad(every)), color=INK, label="spherical body, exact")
    right.plot(
        *zip(*[(x, turn.factor) for x, turn in settled], strict=True), "o", color=BLUE, label="this body"
    )
    lost = [attempt.degrees for attempt in tried if not attempt.turn]
    right.plot(
        lost, np.full(len(lost), 1.07), "x", color=RED, markersize=7, label="this body, did not settle"
    )
    right.set(xlabel="angle of the turn, degrees", ylabel="factor per iteration")
    right.set(xlim=(0, every[-1]), ylim=(0, 1.6))
    right.legend(loc="lower right", fontsize=8.5)
    return figure


def _attempt(body: RigidBody, unit: Array, degrees: float, duration: float) -> Attempt:
    ends = np.deg2rad(degrees) * unit
    channels = [Maneuver([0, 0, 0], [end, 0, 0], tf=duration) for end in ends]
    try:
        return Attempt(degrees, couple(body, channels, minimum_energy, tol=TOLERANCE), "settles")
    except NotConverged as reason:
        return Attempt(degrees, None, str(reason).partition(" (")[0])
