"""First paths in space: the angle and the plane change evenly, and the distance rises to an apex between.

The attitude along a path is a turn about an axis in the plane of the craft, which tilts the plane, after a
turn about its normal, by which the craft runs on. Either runs from that of the craft to that of the target
at the meeting. The plane may be tilted by its angle, or the other way round to the same plane.
"""

import math
from dataclasses import dataclass

import numpy as np

from pontryagin.numerics import kepler
from pontryagin.numerics.rotation import about_third, conjugate, product, twist
from pontryagin.rendezvous.laps.descent import Curve
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.witness.cartesian import cartesian_of

POINTS = 400
"""Number of intervals of a path before its nodes are placed."""


@dataclass(frozen=True)
class Shape:
    """A kind of first path.

    Attributes
    ----------
    turns : int
        Full turns beyond the angle from the craft to the target at the meeting.
    rise : float
        Height of the apex above the even path, in units of the mean of both distances.
    back : bool
        Whether the plane is tilted the other way round.
    """

    turns: int
    rise: float
    back: bool


def curve(scaled: Scaled, duration: float, shape: Shape) -> Curve:
    """The path of a shape, for a duration."""
    anomaly = float(kepler.true_anomaly_after(scaled.anomaly, duration, 1.0, scaled.eccentricity))
    (radius, radial, areal, *attitude), _ = scaled.target(anomaly)
    relative = np.array(attitude)
    angle = twist(relative) % (2 * math.pi)
    tilt = product(relative, conjugate(about_third(angle)))
    axis, size = tilt[1:], float(np.linalg.norm(tilt[1:]))
    half = math.atan2(size, float(tilt[0]))
    half -= math.pi * round(half / math.pi)
    half -= math.copysign(math.pi, half) if shape.back else 0.0
    share = np.linspace(0.0, 1.0, POINTS + 1)
    begin = scaled.start[0]
    distance = begin + share * (radius - begin)
    distance += shape.rise * (radius + begin) / 2 * np.sin(math.pi * share) ** 2
    swept = np.append(0.0, np.cumsum(1 / distance[1:] ** 2 + 1 / distance[:-1] ** 2))
    swept *= (angle + 2 * math.pi * shape.turns) / swept[-1]
    part = np.outer(np.sin(half * share), np.append(0.0, axis / (size or 1.0)))
    part[:, 0] = np.cos(half * share)
    turned = product(part, about_third(swept))
    still = np.zeros_like(distance)
    place = cartesian_of(np.stack([distance, still, still + 1.0], axis=-1), turned)[:, :3]
    times = duration * share
    nodes = np.hstack([place, np.gradient(place, times, axis=0, edge_order=2)])
    nodes[0] = cartesian_of(scaled.start, np.array([1.0, 0, 0, 0]))
    nodes[-1] = cartesian_of(np.array([radius, radial, areal]), relative)
    return Curve(times, nodes)
