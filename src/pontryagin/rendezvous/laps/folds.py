"""A walk along extremals of one cost over the duration, by arclength, so that the duration may turn back.

Where two extremals of one duration meet, a walk in steps of the duration ends. Here each point is sought in
a plane across the line through the two points before it, and the duration is one of the unknowns.
"""

from collections.abc import Iterator

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.rendezvous.laps.ends import Ends
from pontryagin.rendezvous.laps.hamiltonian import Cost
from pontryagin.rendezvous.laps.transcription import ROUGH, Path, Plane, extremal

STEPS = 60
"""Largest number of steps that are tried."""
GROWTH, LARGEST, LEAST = 1.5, 0.3, 1e-3
"""Factor by which a step grows after a success, and the largest and the least length of a step."""


def along(ends: Ends, cost: Cost, before: Path, here: Path) -> Iterator[Path]:
    """Roughly corrected extremals beyond the second of two, until steps are too short or too many."""
    length = 0.0
    for _ in range(STEPS):
        scale = scales(here)
        secant = here.unknowns - before.unknowns
        size = float(np.linalg.norm(secant / scale))
        length = length or min(size, LARGEST)
        guess = here.unknowns + length / size * secant
        normal = secant / scale**2 / size
        try:
            found = extremal(ends, cost, Plane(normal, float(normal @ guess)), Path.of(guess), ROUGH)
        except NotConverged:
            length /= 2
            if length < LEAST:
                return
            continue
        before, here = here, found
        yield here
        length = min(GROWTH * length, LARGEST)


def scales(path: Path) -> Array:
    """Units of the unknowns, in which the root mean square of the changes of all nodes is a length."""
    count = path.nodes.shape[1]
    size = float(np.abs(path.nodes[6:]).max())
    nodes = np.repeat([1.0, size], 6 * count) * np.sqrt(count)
    return np.append(nodes, [size, path.span, path.duration])
