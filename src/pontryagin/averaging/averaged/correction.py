"""The first correction J1 along an averaged solution; derived and proved in `derivation.correction`.

Only the averaged extremal is needed. J1 consists of Fourier primitives of k1 = h*/r in the anomaly at both
ends, and of the integral along the extremal of the mean of
k2 - (dk1/dp minus its mean) d(primitive of k1)/da.
"""

import math
from collections.abc import Callable
from functools import lru_cache
from itertools import pairwise

import numpy as np

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.reference import ReferenceExtremal
from pontryagin.averaging.exact.arrivals import fixed_ending
from pontryagin.averaging.exact.canonical import Canonical, canonical, epsilon, y
from pontryagin.errors import ArgumentValueError, NotConverged
from pontryagin.numerics import compile as compiler

POINTS = (64, 128, 256, 512, 1024, 2048, 4096)
"""Numbers of points on a turn, tried in this order."""
NODES_OF_A_CELL = 70
"""Number of points over a length for which a Fourier series is exact to rounding; see `MeanRule.on`."""
NODES = (12, 24, 48, 96)
"""Numbers of Gauss points along the averaged solution, tried in this order."""
SETTLED, ROUGH = 1e-11, 1e-6
"""Largest relative changes by a finer quadrature of a settled term, and of one that is still accepted."""
CANDIDATES = 4
"""Number of maxima of the primitive that are polished before the largest is taken."""


def terms(reference: ReferenceExtremal, start: Array, ending: Array | None = None) -> dict[str, Array]:
    """The terms of J1 in J* = J0 + epsilon J1 + O(epsilon^2), (...) each: at the start, end and on the way.

    Parameters
    ----------
    reference : ReferenceExtremal
        An averaged extremal at kappa = 0.
    start : (...) array
        Anomaly at the start.
    ending : (...) array, optional
        Anomaly at the end; by default the one that makes J1 least, as the optimum does. Where the control
        cannot choose it (`fixed_ending`) it must be given; J1 then depends on it.

    Returns
    -------
    dict
        ``start``, ``end`` and ``way``, the last zero if reversing the anomaly reverses the system.

    Raises
    ------
    ValueError
        If `ending` must be given.
    NotConverged
        If the Fourier series do not settle.
    """
    equations = canonical(reference.system)
    if ending is None and fixed_ending(equations):
        raise ArgumentValueError(
            "ending must be given for the least time with one slow variable, got None: the control cannot "
            "choose the anomaly at the end there, and J1 depends on it",
            "ending",
        )
    first, last = _ends(reference, equations, start, ending)
    sizes = _sizes(reference)
    way = _settled(lambda size: _integral(reference, equations, size), "the mean Hamiltonian", sizes)
    return {"start": first, "end": -last, "way": -way}


def _ends(
    reference: ReferenceExtremal, equations: Canonical, start: Array, ending: Array | None
) -> tuple[Array, Array]:
    """The primitive of k1 at the start, and at the end: at `ending` or where it is largest."""
    both = np.stack([np.zeros_like(reference.duration), reference.duration], axis=-1)

    def values(size: int) -> Array:
        series = _series(_at(reference, equations, both, size)[..., 0])
        first = _sum(series[..., 0, :], start)
        there = _largest(series[..., 1, :]) if ending is None else _sum(series[..., 1, :], ending)
        return np.stack(np.broadcast_arrays(first, there))

    first, there = _settled(values, "the primitive of the Hamiltonian", _sizes(reference))
    return first, there


def _integral(reference: ReferenceExtremal, equations: Canonical, size: int) -> Array:
    """Integral of omega times the second mean Hamiltonian over the slow time."""

    def values(count: int) -> Array:
        node, weight = np.polynomial.legendre.leggauss(count)
        tau = reference.duration[..., None] * (node + 1) / 2
        columns = _at(reference, equations, tau, size)
        n = (columns.shape[-1] - 3) // 2
        slopes_p, slopes_a = columns[..., 3 : 3 + n], columns[..., 3 + n :]
        swing = slopes_p - slopes_p.mean(axis=-2, keepdims=True)
        primitives = _primitive(np.moveaxis(slopes_a, -1, -2))
        second = columns[..., 1].mean(axis=-1)
        second = second - (np.moveaxis(swing, -1, -2) * primitives).sum(axis=-2).mean(axis=-1)
        frequency = 1 / columns[..., 2].mean(axis=-1)
        return np.asarray((weight * frequency * second).sum(axis=-1) * reference.duration / 2)

    return _settled(values, "the integral along the averaged solution", NODES)


def _sizes(reference: ReferenceExtremal) -> tuple[int, ...]:
    """Numbers of points on a turn that do not miss narrow features of the system."""
    least = NODES_OF_A_CELL / min((b - a for a, b in pairwise(reference.turn)), default=math.inf)
    sizes = tuple(size for size in POINTS if size >= least)
    if len(sizes) < 2:
        raise NotConverged(
            f"the correction takes at most {POINTS[-1]} points on a turn, and features of the phase are too "
            "narrow for them",
            least,
        )
    return sizes


def _settled(values: Callable[[int], Array], what: str, sizes: tuple[int, ...] = POINTS) -> Array:
    """Values at the first size that changes them by no more than `SETTLED`, else at the last size."""
    before = values(sizes[0])
    for size in sizes[1:]:
        found = values(size)
        change = np.abs(found - before)
        scale = 1e-3 + np.abs(found)
        if (change <= SETTLED * scale).all():
            return found
        before = found
    if not (change <= ROUGH * scale).all():
        raise NotConverged(
            f"{what} has not converged with {sizes[-1]} points: the last increase of their number changed it "
            f"by more than {ROUGH:g} of its size",
            float((change / scale).max()),
        )
    return found


def _at(reference: ReferenceExtremal, equations: Canonical, tau: Array, size: int) -> Array:
    """k1, k2, 1/r, dk1/dp, dk1/da at times (..., k) on `size` points of a turn: (..., k, size, 3 + 2n)."""
    a, p = reference.slow(tau), reference.costate(tau)
    z = np.moveaxis(np.concatenate([a, p], axis=-1), -1, 0)[..., None]
    numbers = [np.asarray(number)[..., None, None] for number in reference.numbers]
    x = 2 * np.pi * np.arange(size) / size
    return np.stack(_kernel(equations)(*z, x, *numbers), axis=-1)


@lru_cache(maxsize=32)
def _kernel(equations: Canonical) -> Callable[..., tuple[Array, ...]]:
    n, numbers = len(equations.slow), equations.parameters[1:]
    h = equations.hamiltonian.subs(y, 0)
    r = equations.rate
    f = [g.subs(y, 0) for g in equations.motion[:n]]
    F = equations.motion[n].subs(y, 0).diff(epsilon)
    h_a = [-g.subs(y, 0) for g in equations.unswitched(equations.time_rates[n : 2 * n])]
    outputs = {"k1": h / r, "k2": -h * F / r**2, "pace": 1 / r}
    outputs |= {f"k1_p{i}": g / r for i, g in enumerate(f)}
    outputs |= {
        f"k1_a{i}": slope / r - h * r.diff(a) / r**2
        for i, (slope, a) in enumerate(zip(h_a, equations.slow, strict=True))
    }
    arguments = [*equations.slow, *equations.costates, equations.anomaly, *numbers]
    return compiler.function("corrected", arguments, outputs)


# --- Fourier series on a turn ------------------------------------------------------------------------


def _series(values: Array) -> Array:
    """Complex coefficients (..., harmonics) of the primitive of values (..., size) minus their mean."""
    size = values.shape[-1]
    order = np.arange(1, size // 2)
    return np.asarray(2 * np.fft.rfft(values, axis=-1)[..., 1 : size // 2] / size / (1j * order))


def _sum(series: Array, x: Array) -> Array:
    """The primitive at x (...)."""
    order = np.arange(1, series.shape[-1] + 1)
    waves = series * np.exp(1j * order * np.asarray(x)[..., None])
    return np.asarray(waves.real.sum(axis=-1))


def _primitive(values: Array) -> Array:
    """The zero-mean primitive of values (..., size) minus their mean, at the same points."""
    size = values.shape[-1]
    spectrum = np.zeros((*values.shape[:-1], size // 2 + 1), complex)
    spectrum[..., 1 : size // 2] = _series(values) * size / 2
    return np.fft.irfft(spectrum, n=size, axis=-1)


def _largest(series: Array) -> Array:
    """The largest value of the primitive: the best points of a fine grid, polished by Newton's method."""
    harmonics = series.shape[-1]
    size = max(1024, 4 * (harmonics + 1))
    spectrum = np.zeros((*series.shape[:-1], size // 2 + 1), complex)
    spectrum[..., 1 : harmonics + 1] = series * size / 2
    values = np.fft.irfft(spectrum, n=size, axis=-1)
    peak = (values >= np.roll(values, 1, axis=-1)) & (values >= np.roll(values, -1, axis=-1))
    best = np.argsort(np.where(peak, values, -np.inf), axis=-1)[..., -CANDIDATES:]
    spacing, order = 2 * np.pi / size, np.arange(1, harmonics + 1)
    x = best * spacing
    for _ in range(4):
        waves = series[..., None, :] * np.exp(1j * order * x[..., None])
        slope = (1j * order * waves).real.sum(axis=-1)
        bend = -(order**2 * waves).real.sum(axis=-1)
        step = np.divide(-slope, bend, out=np.zeros_like(slope), where=bend < 0)
        x = np.clip(x + step, (best - 1) * spacing, (best + 1) * spacing)
    polished = _sum(series[..., None, :], x).max(axis=-1)
    return np.asarray(np.maximum(polished, values.max(axis=-1)))
