"""Motions on which users of a jerk-limited trajectory generator reported errors, flown in exact arithmetic.

The numbers are those of issues 58, 80, 83, 160 and 201 of the project pantor/ruckig: ends that differ by
rounding alone, speeds of 1e-20, targets that are very far, and a very large bound on the jerk.
"""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from pontryagin.triple_integrator import minimum_time

MOTIONS = {
    "58, a huge bound": ([0, 0, 0], [1e-3, 0, 0], 1e15),
    "80, a far target": ([0, -6.6706965561032989, 0.21350997812776198], [51002.562712464198, 0, 0], 1.0),
    "83, almost there": ([0.1174161453909641, -3.662950284795513e-09, 1.350015487635199e-07],
                         [0.117416145324707, 0, 0], 0.18),
    "83, far from it": ([-0.4222080077114712, -5.585273134233322e-09, 2.058506025917496e-07],
                        [-0.4, 0, 0], 0.18),
    "160, one digit": ([-0.04895883258572608, 1.425883388427091e-14, -2.370282711878416e-12],
                       [-0.04895883258572691, 0, 0], 150.0),
    "160, a slow start": ([0.1992637939208025, -9.520201039439915e-20, 0], [0.1992637939208025, 0, 0], 150.0),
    "160, a slow turn": ([0.2093483656756634, 1.924174584908152e-18, -3.608224830031759e-16],
                         [0.2093483656756634, 0, 0], 150.0),
    "201, farther": ([0, 0, 0], [1e9, 0, 0], 1.0),
}  # fmt: skip


@pytest.mark.parametrize("name", MOTIONS)
def test_the_motion_arrives(name):
    start, end, peak = MOTIONS[name]
    motion = minimum_time(start, end, peak=peak)
    assert motion.certificate.holds(1e-13)
    switches = np.ravel(motion.switch_times)
    knots = [Fraction(0), *map(Fraction, switches[np.isfinite(switches)]), Fraction(float(motion.duration))]
    x, v, a = map(Fraction, map(float, start))
    jerk = Fraction(peak) * int(motion.first_sign)
    for begin, finish in pairwise(knots):
        h = finish - begin
        x, v, a = x + h * v + h**2 / 2 * a + h**3 / 6 * jerk, v + h * a + h**2 / 2 * jerk, a + h * jerk
        jerk = -jerk
    whole, largest = Fraction(float(motion.duration)), abs(jerk)
    misses = [x - Fraction(end[0]), v, a]
    for miss, size in zip(misses, [largest * whole**3, largest * whole**2, largest * whole], strict=True):
        assert abs(miss) <= 1e-15 * size
