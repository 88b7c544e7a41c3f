"""The distribution of the number of impulses over random injection errors."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentValueError
from pontryagin.orbit_correction import arguments
from pontryagin.orbit_correction.plan.correction import correct
from pontryagin.orbit_correction.plan.thrust import THRUSTS
from pontryagin.validation import finite
from pontryagin.value import value_class

if TYPE_CHECKING:
    from rich.progress import Progress

CHUNK = 250
"""Number of states that are planned between two updates of the progress bar."""


@value_class
@dataclass(frozen=True, eq=False)
class Distribution:
    """The fewest impulses of random injection errors, for each set of impulses.

    Attributes
    ----------
    z0 : (samples, 3) array
        The injection errors.
    counts : dict of (samples,) int arrays
        Fewest impulses by the name of the set, "ball", "disc", "box".
    """

    z0: Array
    counts: dict[str, NDArray[np.int64]]

    def mean(self, thrust: str) -> float:
        """Mean number of impulses."""
        return float(self.counts[thrust].mean())

    def quantile(self, thrust: str, share: float) -> int:
        """The least number of impulses that suffices for a given share of the errors."""
        return int(np.quantile(self.counts[thrust], share, method="inverted_cdf"))


def injection_errors(covariance: ArrayLike, samples: int, seed: int = 0) -> Array:
    """Normally distributed deviations of mean zero and given covariance, (samples, 3), from a seed.

    Raises
    ------
    TypeError, ValueError
        If an argument is invalid, with its name.

    Examples
    --------
    >>> injection_errors(1e-4 * np.eye(3), 4).shape
    (4, 3)
    """
    matrix = finite("covariance", covariance, "a symmetric (3, 3) matrix")
    if matrix.shape != (3, 3) or not np.allclose(matrix, matrix.T, rtol=1e-12, atol=0):
        raise ArgumentValueError(
            f"covariance must be a symmetric (3, 3) matrix, got {matrix.tolist()}", "covariance"
        )
    number = arguments.count("samples", samples)
    values, axes = np.linalg.eigh(matrix)
    if values[0] < -1e-12 * max(values[-1], 0.0) or values[-1] < 0:
        raise ArgumentValueError(
            f"covariance must have no negative eigenvalue, got {values[0]:.3g}", "covariance"
        )
    normal = np.random.default_rng(arguments.count("seed", seed, least=0)).standard_normal((number, 3))
    return np.asarray(normal * np.sqrt(np.maximum(values, 0.0)) @ axes.T)


def impulse_distribution(
    covariance: ArrayLike,
    samples: int = 2000,
    interval: float = 0.25,
    peak: float = 0.0035,
    seed: int = 0,
    verbose: bool = False,
) -> Distribution:
    """Fewest impulses of random injection errors under the ball, the disc and the box.

    Parameters
    ----------
    covariance : (3, 3) array_like
        Covariance of (dr, dv_R, dv_T), in units of the orbit's radius and speed; symmetric and
        positive semidefinite.
    samples : int
        Number of errors.
    interval, peak : float
        As in `correct`.
    seed : int
        Seed of the random numbers.
    verbose : bool
        Whether to show a progress bar on standard error.

    Raises
    ------
    TypeError, ValueError, pontryagin.Infeasible
        As `injection_errors` and `correct`.

    Examples
    --------
    >>> found = impulse_distribution(np.diag([1e-5, 1e-5, 4e-5]), samples=100)
    >>> found.mean("box") < found.mean("ball")
    True
    """
    errors = injection_errors(covariance, samples, seed)
    counts = {name: np.zeros(len(errors), dtype=np.int64) for name in THRUSTS}
    with _progress(verbose) as bar:
        task = bar.add_task("injection errors", total=len(errors))
        for first in range(0, len(errors), CHUNK):
            rows = slice(first, first + CHUNK)
            for name in THRUSTS:
                counts[name][rows] = correct(errors[rows], interval, peak, name).impulse_count
            bar.advance(task, len(errors[rows]))
    return Distribution(errors, counts)


def _progress(verbose: bool) -> "Progress":
    """A progress bar on standard error, which is hidden unless `verbose`."""
    from rich.console import Console
    from rich.progress import Progress

    console = Console(stderr=True, quiet=not verbose)  # Rich before 15 ends a disabled bar by a line.
    return Progress(console=console, disable=not verbose)
