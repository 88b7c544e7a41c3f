"""Conversion between phase and anomaly: psi(x) is the integral of the weight dpsi/dx from zero to x."""

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.system.jets import evaluate
from pontryagin.averaging.system.model import Model
from pontryagin.errors import NotConverged

FIRST, LAST = 64, 2**14
"""First and largest number of points on a turn at which the weight is sampled."""


def phase_at(model: Model, slow: Array, anomaly: Array, numbers: tuple[Array, ...]) -> Array:
    """psi (...) of the anomaly (...) at slow variables (..., n)."""
    series = _weight_series(model, slow, numbers)
    return _phase(series, anomaly)


def anomaly_at(model: Model, slow: Array, phase: Array, numbers: tuple[Array, ...]) -> Array:
    """x (...) of the phase (...) at slow variables (..., n): Newton's method with bisection."""
    series = _weight_series(model, slow, numbers)
    phase = np.broadcast_to(phase, series.shape[:-1])
    half_turn = np.abs(_phase(series, np.full(phase.shape, np.pi)) - np.pi) + np.pi
    x = phase.copy()
    low, high = phase - 2 * half_turn, phase + 2 * half_turn
    for _ in range(100):
        miss = _phase(series, x) - phase
        low, high = np.where(miss < 0, x, low), np.where(miss > 0, x, high)
        newton = x - miss / _weight(series, x)
        following = np.where((newton >= low) & (newton <= high), newton, (low + high) / 2)
        moved, x = np.abs(following - x), following
        if (moved <= 4e-16 * (1 + np.abs(x))).all():
            break
    return x


def _weight_series(model: Model, slow: Array, numbers: tuple[Array, ...]) -> NDArray[np.complex128]:
    """Complex Fourier coefficients (..., 1 + harmonics) of dpsi/dx, scaled to mean one."""
    a = np.moveaxis(slow[..., None, :], -1, 0)
    values = tuple(number[..., None] for number in numbers)
    size = FIRST
    while size <= LAST:
        x = 2 * np.pi * np.arange(size) / size
        turn = evaluate(model.pace, *a, x, *values)[..., 0]
        series = np.fft.rfft(turn, axis=-1) / size
        series = series / series[..., :1].real
        if (np.abs(series[..., -size // 8 :]) <= 1e-15).all():
            keep = int(
                np.nonzero((np.abs(series) > 1e-17).reshape(-1, series.shape[-1]).any(axis=0))[0].max()
            )
            return series[..., : keep + 1]
        size *= 2
    raise NotConverged(
        f"the weight dpsi/dx is not smooth enough in x for {LAST} Fourier points",
        float(np.abs(series[..., -size // 8 :]).max()),
    )


def _phase(series: NDArray[np.complex128], x: Array) -> Array:
    k = np.arange(1, series.shape[-1])
    primitive = series[..., 1:] / (1j * k)
    swing = primitive * (np.exp(1j * np.asarray(x)[..., None] * k) - 1)
    return np.asarray(x + 2 * swing.real.sum(axis=-1))


def _weight(series: NDArray[np.complex128], x: Array) -> Array:
    k = np.arange(1, series.shape[-1])
    return np.asarray(1 + 2 * (series[..., 1:] * np.exp(1j * x[..., None] * k)).real.sum(axis=-1))
