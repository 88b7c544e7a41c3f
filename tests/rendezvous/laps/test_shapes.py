"""First paths lead from the craft to the meeting, with the turns and the apex of their shape."""

import math

import numpy as np
import pytest

from pontryagin.rendezvous import Orbit, Rendezvous
from pontryagin.rendezvous.laps.cartesian import Transfer
from pontryagin.rendezvous.laps.shapes import Shape, curve
from pontryagin.rendezvous.problem.cases import chaser_on


def scaled(degrees):
    craft = Orbit.from_angles(1.0, 0.2, 0.3, 0.0, 0.4, 1.0)
    target = Orbit.from_angles(1.2, 0.1, 0.7, math.radians(degrees), 0.2, 2.0)
    return Rendezvous(
        chaser_on(craft), target, time_weight=0, energy_weight=1, peak=math.inf, duration=9.0
    ).scaled


@pytest.mark.parametrize("degrees", [0, 30, 120, 180])
@pytest.mark.parametrize("shape", [Shape(0, 0.0, False), Shape(1, 0.5, True), Shape(2, 1.0, False)])
def test_a_path_leads_from_the_craft_to_the_target(degrees, shape):
    posed = scaled(degrees)
    path, transfer = curve(posed, posed.duration, shape), Transfer(posed)
    there, _ = transfer.meeting(posed.duration)
    assert path.nodes[0] == pytest.approx(transfer.start, abs=1e-12)
    assert path.nodes[-1] == pytest.approx(there, abs=1e-12)
    for one, other in ((0, 1), (-2, -1)):
        step = path.nodes[other, :3] - path.nodes[one, :3]
        assert np.linalg.norm(step) < 0.2
    distance = np.linalg.norm(path.nodes[:, :3], axis=1)
    ends = distance[[0, -1]].mean()
    middle = distance[distance.size // 2]
    assert middle == pytest.approx((1 + shape.rise) * ends, rel=1e-12)


def test_a_path_makes_the_turns_of_its_shape():
    posed = scaled(0)

    def angle(turns):
        path = curve(posed, posed.duration, Shape(turns, 0.5, False))
        return np.unwrap(np.arctan2(path.nodes[:, 1], path.nodes[:, 0]))

    few, many = (angle(turns)[[0, -1]] for turns in (0, 2))
    assert 0 <= few[1] - few[0] < 2 * math.pi
    assert (many[1] - many[0]) - (few[1] - few[0]) == pytest.approx(4 * math.pi)


def test_the_plane_is_tilted_either_way():
    posed = scaled(120)

    def tilts(back):
        path = curve(posed, posed.duration, Shape(0, 0.0, back))
        position = path.nodes[100:301, :3]
        return position[:, 2]

    one, other = tilts(False), tilts(True)
    assert np.abs(one - other).max() > 0.5
