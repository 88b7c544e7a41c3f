"""First unknowns in the elements from paths in space, which may lose their angular momentum on the way."""

import math
from collections.abc import Iterator

import numpy as np

from pontryagin.arrays import Array
from pontryagin.rendezvous.elements.elements import place_gradient
from pontryagin.rendezvous.elements.flight import basis, start_of
from pontryagin.rendezvous.laps.transcription import Path
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.reduced.conditions import Setting
from pontryagin.rendezvous.reduced.free_shape_search import paths_of_free_duration
from pontryagin.rendezvous.reduced.search_log import SearchLog
from pontryagin.rendezvous.reduced.shape_search import paths_of_fixed_duration


def in_space(scaled: Scaled) -> Iterator[Array]:
    """Unknowns (7,) of the transcribed extremals that descents from shapes lead to.

    Those that fly through a parabola or a hyperbola are left out.
    """
    setting = Setting(scaled, scaled.ratio, scaled.peak, duration=scaled.duration)
    paths = paths_of_free_duration if setting.free else paths_of_fixed_duration
    for path in paths(setting, SearchLog(), math.inf):
        phi = half_anomaly(path)
        if math.isfinite(phi):
            craft = start_of(scaled)
            yield np.append(basis(craft).T @ place_gradient(craft).T @ path.nodes[6:, 0], phi)


def half_anomaly(path: Path) -> float:
    """phi at the end: the integral of dt/(r sqrt(2Q)) with dt/ds = r^(3/2); nan beyond ellipses."""
    position, velocity = path.nodes[:3], path.nodes[3:6]
    distance = np.linalg.norm(position, axis=0)
    inverse = 1 / distance - (velocity**2).sum(axis=0) / 2
    if (inverse <= 0).any():
        return math.nan
    rate = np.sqrt(distance * inverse / 2)
    return float((rate[1:] + rate[:-1]).sum() * path.span / (2 * (rate.size - 1)))
