"""False meetings: extremals that satisfy all that the paper asks of the ten equations, in another place.

(15) compares lambda o nu o lambda~ with lambda* o nu o lambda*~. Turning lambda about nu* changes neither, so
that a craft whose attitude at the end is lambda* turned about nu* by any angle passes (15), and with (5),
(16) and (17) everything the ten equations are asked. Here that angle is prescribed, and from the true meeting
the family is followed to it.
"""

import math

import numpy as np

from pontryagin.errors import NotConverged
from pontryagin.numerics.rotation import about_third, product, rotated
from pontryagin.rendezvous.false_meetings.rotated_target import (
    refined,
    towards_turned,
)
from pontryagin.rendezvous.problem.checks import number
from pontryagin.rendezvous.problem.rendezvous import Rendezvous
from pontryagin.rendezvous.reduced.flight import Flight
from pontryagin.rendezvous.reduced.homotopy import (
    Point,
    between,
    follow,
)
from pontryagin.rendezvous.reduced.solution import (
    Extremal,
    require_extremal,
    solve,
)

STEPS = 200


def false_meeting(problem: Rendezvous, angle: float, true: Extremal | None = None) -> Extremal:
    """The extremal that ends with the attitude lambda* turned about nu* by an angle.

    Its certificate says what it is: ``boundary``, ``transversality``, ``hamiltonian`` and ``maximality`` are
    as small as those of a meeting, ``attitude`` and ``cartesian`` are not.

    Parameters
    ----------
    problem : Rendezvous
        What is to be met.
    angle : float
        In radians, about nu*, in the plane about the normal of the target's orbit; 0 gives the true meeting.
    true : Extremal, optional
        A true meeting of the problem, from which the family is followed; `solve` by default.

    Raises
    ------
    ValueError, TypeError
        Naming the argument that is not as above.
    NotConverged
        Where the family turns back before it reaches the angle.

    Examples
    --------
    >>> import math
    >>> from pontryagin.rendezvous import Chaser, Orbit, Rendezvous
    >>> leap = Rendezvous(Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]), Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6),
    ...                   time_weight=0, energy_weight=1, peak=math.inf, duration=6.0)
    >>> misled = false_meeting(leap, math.pi / 6)
    >>> paper_residual(misled) < 1e-11, distance(misled) > 0.5
    (True, True)
    """
    wanted = number("angle", angle)
    if true is not None:
        require_extremal("true", true)
    meeting = solve(problem) if true is None else true
    family = towards_turned(meeting)
    last: Point | None = None
    for point in follow(family, meeting.root.unknowns, 0.0, wanted, steps=STEPS):
        if last is not None and (point.parameter - wanted) * (last.parameter - wanted) <= 0:
            return Extremal(problem, refined(family, between(last, point, wanted), wanted))
        if wanted == 0:
            return Extremal(problem, refined(family, point.unknowns, wanted))
        if point.parameter * wanted < 0:
            break
        last = point
    reached = 0.0 if last is None else last.parameter
    raise NotConverged(f"the family of false meetings went to {reached:.3g} rad only", abs(wanted - reached))


def paper_residual(extremal: Extremal) -> float:
    """The largest of what (5), (15), (16) and (17) leave, in the units of the certificate."""
    flight, proof = extremal.flight, extremal.certificate
    parts = (proof.boundary, proof.transversality, proof.hamiltonian)
    return max(invariant_residual(flight), *(float(part) for part in parts))


def invariant_residual(flight: Flight) -> float:
    """What (15) leaves: lambda* o nu o lambda*~ at the end less nu*, relative to |nu*|."""
    there = flight.scaled.target(float(flight.end[3]))[0][3:]
    constant = flight.costates[3:]
    return float(np.abs(rotated(flight.end[7:10], there) - constant).max() / np.linalg.norm(constant))


def distance(extremal: Extremal) -> float:
    """How far craft and target are from each other at the end, in the user's unit of length."""
    problem = extremal.problem
    end = extremal.state([extremal.duration])[0]
    craft = rotated(np.array([end[0], 0.0, 0.0]), end[4:])
    orbit = problem.target
    attitude = product(orbit.attitude, about_third(end[3]))
    radius = orbit.parameter / (1 + orbit.eccentricity * math.cos(end[3]))
    return float(np.linalg.norm(craft - rotated(np.array([radius, 0.0, 0.0]), attitude)))
