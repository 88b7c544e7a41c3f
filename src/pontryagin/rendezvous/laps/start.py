"""A first path for a lap: the transfer of least energy for equations linearised about a given path.

The elements of the reference path go from those of the craft to those of the target. Along it the best thrust
is linear in six constants, the costates at the end and the price of time, and so are the changes of the
elements and of the duration: six linear equations. Then the path found is the next reference.
"""

import math

import numpy as np

from pontryagin.arrays import Array
from pontryagin.numerics.complex_step import jacobian
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.laps.equinoctial import TAU, Lap
from pontryagin.rendezvous.laps.transcription import FEWEST, NODES_PER_LAP, Path


def least_energy_guess(
    lap: Lap, duration: float, rounds: int = 2, per_lap: int = NODES_PER_LAP
) -> Path | None:
    """The path of least energy after some rounds, for alpha1 = 0 and alpha2 = 1.

    It is None if the meeting is not ahead of the craft, or if a reference path leaves the ellipses.
    """
    end = lap.longitude(duration)[0]
    if end < 0.3:
        return None
    longitude = np.linspace(0.0, end, max(FEWEST, math.ceil(per_lap * end / TAU)) + 1)
    reference = lap.start[:5, None] + longitude / end * (lap.goal - lap.start[:5])[:, None]

    def integral(values: Array) -> Array:
        steps = (values[..., 1:] + values[..., :-1]) / 2 * np.diff(longitude)
        return np.concatenate([np.zeros((*values.shape[:-1], 1)), np.cumsum(steps, axis=-1)], axis=-1)

    for _ in range(rounds):
        weight, by_element = _weight(reference, longitude)
        factors = _thrust_factors(reference, longitude)
        spread = np.einsum("iKn,jKn->ijn", factors, factors) * weight / 2
        passed = integral(by_element)
        left = passed[:, -1:] - passed
        by_costate = integral(spread)
        by_price = integral(np.einsum("ijn,jn->in", spread, left))
        matrix = np.zeros((6, 6))
        matrix[:5, :5], matrix[:5, 5] = by_costate[..., -1], by_price[:, -1]
        matrix[5, :5] = integral(np.einsum("in,ijn->jn", by_element, by_costate))[:, -1]
        matrix[5, 5] = integral((by_element * by_price).sum(axis=0))[-1]
        off = (by_element * (lap.start[:5, None] - reference)).sum(axis=0)
        late = duration - integral(weight)[-1] - integral(off)[-1]
        try:
            found = np.linalg.solve(matrix, np.append(lap.goal - lap.start[:5], late))
        except np.linalg.LinAlgError:
            return None
        costates = found[:5, None] + found[5] * left
        reference = lap.start[:5, None] + np.einsum("ijn,j->in", by_costate, found[:5]) + by_price * found[5]
        if not ((reference[0] > 0.05).all() and (reference[1] ** 2 + reference[2] ** 2 < 0.95).all()):
            return None
    gain = (np.einsum("iKn,in->Kn", factors, costates) ** 2).sum(axis=0) / 4
    fast = -_weight(reference, longitude)[0] * (gain + found[5])
    nodes = np.vstack([reference, longitude, costates, fast])
    return Path(nodes, float(found[5]), end, duration)


def _weight(elements: Array, longitude: Array) -> tuple[Array, Array]:
    """dt/ds, (n,), and its derivatives in p, f, g, h, k, (5, n)."""
    value, slopes = jacobian(lambda x: [kernels.equinoctial_weight(*[*x, longitude])], elements[:3])
    return value[0], np.vstack([slopes[0], np.zeros((2, longitude.size))])


def _thrust_factors(elements: Array, longitude: Array) -> Array:
    """The factors of the five costates in n, (5, 3, n)."""
    units = np.eye(6)[:5, :, None]
    x = np.broadcast_to(elements[:, None], (5, 5, longitude.size))
    n = kernels.equinoctial_switching(*[*x, longitude[None], *np.moveaxis(units, 1, 0)])
    return np.stack([np.broadcast_to(part, (5, longitude.size)) for part in n], axis=1)
