"""Seeded random problems: ordinary ones, and degenerate classes on which solvers tend to fail."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

SEED = 20121109
"""The seed that, with the name of a class, determines all random problems of the benchmark."""


def generator(name: str) -> Generator:
    """The random generator for a class of problems."""
    return np.random.default_rng([SEED, *name.encode()])


@dataclass(frozen=True)
class Transfers:
    """Least-time problems: ends (n, 3), bound on |u| (n,), constant force (n,)."""

    x0: NDArray
    xf: NDArray
    peak: NDArray
    force: NDArray


def powers(rng: Generator, low: float, high: float, size: int | tuple[int, ...]) -> NDArray:
    """Powers of 10 with exponents uniform on [low, high]."""
    return 10.0 ** rng.uniform(low, high, size)


def signs(rng: Generator, size: int | tuple[int, ...]) -> NDArray:
    """Random signs, plus or minus one."""
    return rng.choice([-1.0, 1.0], size)


def ends(name: str, count: int, scale: float = 1.0) -> tuple[NDArray, NDArray]:
    """Both states (n, 3) of ordinary manoeuvres, normally distributed."""
    rng = generator(name)
    return scale * rng.standard_normal((count, 3)), scale * rng.standard_normal((count, 3))


def ordinary(rng: Generator, n: int) -> NDArray:
    """Scaled moments without any structure."""
    return rng.standard_normal((n, 3))


def wide(rng: Generator, n: int) -> NDArray:
    """Moments that each have any size between 1e-6 and 1e6."""
    return signs(rng, (n, 3)) * powers(rng, -6, 6, (n, 3))


def sparse(rng: Generator, n: int) -> NDArray:
    """Moments of which some are exactly zero; in one case of eight all are."""
    return rng.standard_normal((n, 3)) * rng.integers(0, 2, (n, 3))


def narrow_flip(rng: Generator, n: int) -> NDArray:
    """Moments of a constant control with one flip, as narrow as 1e-14 of the duration."""
    b = rng.uniform(0, 1, n)
    d = np.minimum(powers(rng, -14, -1, n), 1 - b)
    a = b + d
    scaled = [1 - 2 * d * (a * a + a * b + b * b), 1 - 2 * d * (a + b), 1 - 2 * d]
    return signs(rng, (n, 1)) * np.stack(scaled, axis=-1)


def one_switch(rng: Generator, n: int) -> NDArray:
    """Moments on, or within rounding of, the cone of controls with one switch."""
    a = rng.uniform(0, 1, n)
    scaled = np.stack([1 - 2 * a**3, 1 - 2 * a**2, 1 - 2 * a], axis=-1)
    return signs(rng, (n, 1)) * scaled * (1 + powers(rng, -17, -6, (n, 3)) * rng.integers(0, 2, (n, 1)))


def one_impulse(rng: Generator, n: int) -> NDArray:
    """Moments on, or near, the boundary of the cone of controls of one sign."""
    place = rng.choice([0.0, 0.5, 1.0], n) * rng.integers(0, 2, n) + rng.uniform(0, 1, n) * 1e-3
    scaled = np.stack([3 * place**2, 2 * place, np.ones(n)], axis=-1)
    return signs(rng, (n, 1)) * scaled * (1 + signs(rng, (n, 3)) * powers(rng, -17, -3, (n, 3)))


MOMENT_CLASSES: dict[str, Callable[[Generator, int], NDArray]] = {
    "ordinary": ordinary,
    "sizes 1e-6 to 1e6": wide,
    "zeros among the moments": sparse,
    "flip narrower than 0.1, to 1e-14": narrow_flip,
    "one switch": one_switch,
    "one impulse": one_impulse,
}
"""Classes of scaled moments (6 c1/T^3, 2 c2/T^2, c3/T), as functions (generator, n) -> (n, 3)."""


def moments(name: str, count: int) -> tuple[NDArray, NDArray]:
    """Moments c (n, 3) and durations T (n,) between 1e-3 and 1e3 of one of `MOMENT_CLASSES`."""
    rng = generator(name)
    scaled, T = MOMENT_CLASSES[name](rng, count), powers(rng, -3, 3, count)
    return scaled * np.stack([T**3 / 6, T**2 / 2, T], axis=-1), T


def transfers(name: str, count: int) -> Transfers:
    """Least-time problems of one of `TRANSFER_CLASSES`."""
    rng = generator(name)
    x0, xf, peak, force = TRANSFER_CLASSES[name](rng, count)
    return Transfers(x0, xf, np.broadcast_to(peak, count), np.broadcast_to(force, count))


def _normal(mask: tuple[int, int, int], decades: int, rng: Generator, n: int) -> tuple:
    x0, xf = (rng.standard_normal((n, 3)) * mask for _ in range(2))
    return x0, xf, powers(rng, -decades, decades, n), 0.0


def _wide(rng: Generator, n: int) -> tuple:
    x0, xf = (signs(rng, (n, 3)) * powers(rng, -3, 3, (n, 3)) for _ in range(2))
    return x0, xf, powers(rng, -3, 3, n), 0.0


def _equilibrium(rng: Generator, n: int) -> tuple:
    x0, _, peak, _ = _wide(rng, n)
    return x0, np.zeros((n, 3)), peak, 0.0


def _near(rng: Generator, n: int) -> tuple:
    x0 = rng.standard_normal((n, 3))
    return x0, x0 + powers(rng, -12, -2, (n, 1)) * rng.standard_normal((n, 3)), powers(rng, -1, 1, n), 0.0


def _pushed(rng: Generator, n: int) -> tuple:
    x0, xf, peak, _ = _normal((1, 1, 1), 1, rng, n)
    return x0, xf, peak, rng.standard_normal(n)


TRANSFER_CLASSES: dict[str, Callable[[Generator, int], tuple]] = {
    "full states": partial(_normal, (1, 1, 1), 1),
    "no acceleration at the ends": partial(_normal, (1, 1, 0), 1),
    "rest to rest": partial(_normal, (1, 0, 0), 3),
    "sizes 1e-3 to 1e3": _wide,
    "to an equilibrium, sizes 1e-3 to 1e3": _equilibrium,
    "ends 1e-12 to 1e-2 apart": _near,
    "constant force": _pushed,
}
"""Classes of least-time problems, as functions (generator, n) -> x0, xf, peak, force."""
