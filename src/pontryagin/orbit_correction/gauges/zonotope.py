"""The gauge for impulses in a square: of a zonotope, a sum of segments [-g_k, g_k], by a simplex method.

The least sum of |g_k.psi| over (b, psi) = 1 is attained at a vertex, a psi orthogonal to two of the segments.
The method moves from vertex to vertex along edges. Along an edge the sum is convex and piecewise linear, and
its minimum is found exactly. At the last vertex the multipliers of the two segments are their controls, all
other controls are at their bounds, and primal and dual value agree to rounding.
"""

from math import fabs

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array

PIVOTS = 10_000
"""Largest number of moves from vertex to vertex."""


def cross(u: Array, v: Array, result: Array) -> None:
    """Write u x v to the result."""
    result[0] = u[1] * v[2] - u[2] * v[1]
    result[1] = u[2] * v[0] - u[0] * v[2]
    result[2] = u[0] * v[1] - u[1] * v[0]


def dot(u: Array, v: Array) -> float:
    """u . v for vectors in space."""
    product: float = u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
    return product


def turning_place(times: Array, rates: Array, crossed: NDArray[np.int64], used: int, slope: float) -> int:
    """Place in ``crossed[:used]`` of the segment at which the slope stops being negative, or -1.

    Crossing segment k adds 2 |rates[k]| to the slope. ``crossed`` is rearranged so that segments crossed
    earlier come first. This is a selection, not a sort: its time is proportional to the number of segments.
    """
    low, high = 0, used
    while low < high:
        first, middle, end = times[crossed[low]], times[crossed[(low + high) // 2]], times[crossed[high - 1]]
        pivot = max(min(first, middle), min(max(first, middle), end))
        below, above, place, gain = low, high, low, 0.0
        while place < above:
            k = crossed[place]
            if times[k] < pivot:
                gain += 2.0 * fabs(rates[k])
                crossed[place], crossed[below] = crossed[below], k
                below, place = below + 1, place + 1
            elif times[k] > pivot:
                above -= 1
                crossed[place], crossed[above] = crossed[above], k
            else:
                place += 1
        if below > low and slope + gain >= 0.0:
            high = below
            continue
        slope += gain
        for place in range(below, above):
            slope += 2.0 * fabs(rates[crossed[place]])
            if slope >= 0.0:
                return place
        low = above
    # In this order of summation rounding may leave the slope negative: it then vanishes at the last segment.
    return high - 1 if high < used else -1


def slide(
    segments: Array,
    psi: Array,
    direction: Array,
    slope: float,
    fixed: int,
    leaving: int,
    values: Array,
    signs: Array,
) -> int:
    """Move psi along an edge to the minimum of the sum; return the segment that vanishes there, or -1.

    ``slope``, which is negative, is the rate of the sum at the start. ``values`` holds g_k.psi. ``signs``
    holds the sign with which each segment counts, also where g_k.psi is zero: at many vertices this is so for
    more than two segments, since all radial impulses lie in one plane. Both arrays are updated. The segment
    ``fixed`` stays orthogonal to psi; ``leaving`` is the one that was orthogonal until this move.
    """
    count = segments.shape[0]
    rates, times, crossed = np.empty(count), np.empty(count), np.empty(count, np.int64)
    size, largest = 0.0, 0.0
    for k in range(count):
        rates[k] = 0.0 if k == fixed else dot(segments[k], direction)
        size, largest = max(size, fabs(rates[k])), max(largest, fabs(values[k]))
    used = 0
    for k in range(count):
        if fabs(values[k]) <= 1e-13 * largest:
            values[k] = 0.0
        if fabs(rates[k]) <= 1e-13 * size or k == leaving:
            continue
        if signs[k] * rates[k] < 0.0:
            times[k] = max(0.0, -values[k] / rates[k])
            crossed[used] = k
            used += 1
    last = turning_place(times, rates, crossed, used, slope)
    if last < 0:
        return -1
    stop: int = crossed[last]
    for place in range(last):
        signs[crossed[place]] = -signs[crossed[place]]
    length = times[stop]
    for i in range(3):
        psi[i] += length * direction[i]
    for k in range(count):
        values[k] += length * rates[k]
    values[stop] = 0.0
    return stop


def descend(segments: Array, psi: Array, direction: Array, fixed: int, values: Array, signs: Array) -> int:
    """`slide` along the direction or its opposite, whichever lowers the sum."""
    slope = 0.0
    for k in range(segments.shape[0]):
        if k != fixed:
            slope += signs[k] * dot(segments[k], direction)
    if slope > 0.0:
        slope = -slope
        for i in range(3):
            direction[i] = -direction[i]
    return slide(segments, psi, direction, slope, fixed, -1, values, signs)


def multipliers(segments: Array, b: Array, first: int, second: int, signs: Array, result: Array) -> bool:
    """Solve sum of signs g + x g_first + y g_second = z b for (x, y, z).

    The sum is over all segments except the first and the second. The answer is False if these two and b are
    linearly dependent.
    """
    total, right = np.zeros(3), np.empty(3)
    for k in range(segments.shape[0]):
        if k != first and k != second:
            for i in range(3):
                total[i] += signs[k] * segments[k, i]
    cross(segments[first], segments[second], right)
    volume = dot(right, b)
    if volume == 0.0:
        return False
    result[2] = dot(right, total) / volume
    gap = np.empty(3)
    for i in range(3):
        gap[i] = result[2] * b[i] - total[i]
    cross(segments[second], b, right)
    result[0] = dot(right, gap) / dot(right, segments[first])
    cross(b, segments[first], right)
    result[1] = dot(right, gap) / dot(right, segments[second])
    return True


def zonotope_gauge(segments: Array, b: Array, psi: Array, controls: Array) -> tuple[float, float]:
    """Lower bound on the gauge of b, and the peak of controls (count,) whose segments add up to b.

    ``psi`` (3,) is overwritten by the costate, with (b, psi) = 1. If no vertex is reached, the peak is 1e300.
    """
    count = segments.shape[0]
    square = dot(b, b)
    for k in range(count):
        controls[k] = 0.0
    if square == 0.0:
        return 0.0, 0.0
    values, direction, found = np.empty(count), np.empty(3), np.empty(3)
    longest = 0
    for i in range(3):
        psi[i] = b[i] / square
    for k in range(count):
        values[k] = dot(segments[k], psi)
        if fabs(values[k]) > fabs(values[longest]):
            longest = k
    for i in range(3):
        direction[i] = segments[longest, i] - dot(segments[longest], b) * b[i] / square
    if dot(direction, direction) <= 1e-24 * dot(segments[longest], segments[longest]):
        cross(b, segments[(longest + 1) % count], direction)
    signs = np.empty(count)
    for k in range(count):
        signs[k] = 1.0 if values[k] > 0.0 else -1.0
    first = descend(segments, psi, direction, -1, values, signs)
    if first < 0:
        return 0.0, 1e300
    cross(segments[first], b, direction)
    second = descend(segments, psi, direction, first, values, signs)
    if second < 0:
        return 0.0, 1e300
    for _ in range(PIVOTS):
        if not multipliers(segments, b, first, second, signs, found):
            return 0.0, 1e300
        if fabs(found[0]) <= 1.0 + 1e-12 and fabs(found[1]) <= 1.0 + 1e-12:
            break
        if fabs(found[0]) > fabs(found[1]):
            leaving, staying, excess = first, second, found[0]
        else:
            leaving, staying, excess = second, first, found[1]
        cross(segments[staying], b, direction)
        rate = dot(segments[leaving], direction)
        if rate * excess < 0.0:
            rate = -rate
            for i in range(3):
                direction[i] = -direction[i]
        signs[leaving] = 1.0 if excess > 0.0 else -1.0
        slope = -(fabs(excess) - 1.0) * fabs(rate)
        entering = slide(segments, psi, direction, slope, staying, leaving, values, signs)
        if entering < 0:
            break
        first, second = staying, entering
    cross(segments[first], segments[second], psi)
    pairing = dot(b, psi)
    total = 0.0
    for i in range(3):
        psi[i] /= pairing
    for k in range(count):
        total += fabs(dot(segments[k], psi)) if k != first and k != second else 0.0
        controls[k] = signs[k] / found[2]
    controls[first], controls[second] = found[0] / found[2], found[1] / found[2]
    peak = 0.0
    for k in range(count):
        peak = max(peak, fabs(controls[k]))
    return 1.0 / total, peak
