"""What remains of states after the steps of their plans, as a kernel."""

from math import fabs

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array

MISS_SIGNATURE = (
    "void(float64[:,:,::1],float64[:,:,::1],int64[::1],float64[:,::1],float64[:,:,::1],float64[::1])"
)
"""The types of the kernel."""


def misses_of(
    transitions: Array,
    inputs: Array,
    counts: NDArray[np.int64],
    states: Array,
    controls: Array,
    results: Array,
) -> None:
    """What remains of each state (rows, 3) after its steps, flown one by one, relative to the initial state.

    ``transitions`` and ``inputs`` hold the matrices of an even and an odd step.
    """
    current, following = np.empty(3), np.empty(3)
    for row in range(states.shape[0]):
        size = 0.0
        for i in range(3):
            current[i] = states[row, i]
            size = max(size, fabs(current[i]))
        for k in range(counts[row]):
            parity = k % 2
            for i in range(3):
                following[i] = 0.0
                for j in range(3):
                    following[i] += transitions[parity, i, j] * current[j]
                for j in range(inputs.shape[2]):
                    following[i] += inputs[parity, i, j] * controls[row, k, j]
            current[:] = following
        left = 0.0
        for i in range(3):
            left = max(left, fabs(current[i]))
        results[row] = left / size if size > 0.0 else 0.0
