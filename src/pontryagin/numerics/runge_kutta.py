"""A step of Dormand and Prince's Runge-Kutta method of order 8, its error and its length, as plain source.

It becomes native code together with `pontryagin.numerics.arc_loop`. The lengths of steps are those of DOP853:
Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, sections II.4 and II.10.
"""

from typing import Any

Function = Any
"""A function (t, x, p, out) that writes rates, or event functions and their slopes, to ``out``."""
Numbers = Any
"""Floats that can be read and written by their index: an array, or a pointer in native code."""

STAGES = 12
"""Number of stages of a step. The derivative at its end, stage 12, is the first stage of the next step."""
NODES, WEIGHTS, ESTIMATE_5, ESTIMATE_3 = 0, 12, 168, 181
"""Where the table of coefficients holds c, the rows of A with b as row 12, and both error estimates."""


def evaluate(
    function: Function, t: float, x: Numbers, x_at: int, p: Numbers, out: Numbers, out_at: int
) -> None:
    """Call a function on numbers from the given places on; native code calls an address instead."""
    function(t, x[x_at:], p, out[out_at:])


def combine(
    size: int, h: float, y: Numbers, k: Numbers, table: Numbers, row: int, count: int, new: Numbers
) -> None:
    """new = y + h (sum of stages with the weights of a row)."""
    for i in range(size):
        new[i] = 0.0
    for j in range(count):
        weight = table[row + j]
        if weight != 0.0:
            for i in range(size):
                new[i] += weight * k[j * size + i]
    for i in range(size):
        new[i] = y[i] + h * new[i]


def step(
    rates: Function,
    size: int,
    t: float,
    h: float,
    y: Numbers,
    p: Numbers,
    k: Numbers,
    table: Numbers,
    new: Numbers,
) -> None:
    """The state after a step h from y, whose first stage is known."""
    for s in range(1, STAGES):
        combine(size, h, y, k, table, WEIGHTS + STAGES * s, s, new)
        evaluate(rates, t + table[NODES + s] * h, new, 0, p, k, s * size)
    combine(size, h, y, k, table, WEIGHTS + STAGES * STAGES, STAGES, new)


def error(
    size: int,
    counted: int,
    h: float,
    y: Numbers,
    new: Numbers,
    k: Numbers,
    table: Numbers,
    tolerance: float,
) -> float:
    """Estimated error of a step, as a share of what is allowed."""
    fifth, third = 0.0, 0.0
    for i in range(size):
        five, three = 0.0, 0.0
        for j in range(STAGES + 1):
            five += table[ESTIMATE_5 + j] * k[j * size + i]
            three += table[ESTIMATE_3 + j] * k[j * size + i]
        allowed = tolerance * (0.1 + max(abs(y[i]), abs(new[i])))
        fifth += (five / allowed) * (five / allowed)
        third += (three / allowed) * (three / allowed)
    whole = fifth + 0.01 * third
    if whole == 0.0:
        return 0.0
    return float(abs(h) * fifth / (whole * counted) ** 0.5)


def first_step(
    rates: Function,
    size: int,
    counted: int,
    t: float,
    span: float,
    y: Numbers,
    p: Numbers,
    k: Numbers,
    new: Numbers,
    tolerance: float,
) -> float:
    """Length of the first step, by the sizes of the state, of its first and of its second derivative."""
    states, slopes, bends = 0.0, 0.0, 0.0
    for i in range(size):
        allowed = tolerance * (0.1 + abs(y[i]))
        states += (y[i] / allowed) * (y[i] / allowed)
        slopes += (k[i] / allowed) * (k[i] / allowed)
    states, slopes = (states / counted) ** 0.5, (slopes / counted) ** 0.5
    h = 1e-6 if states < 1e-5 or slopes < 1e-5 else 0.01 * states / slopes
    h = min(max(h, 1e-8 * abs(span)), abs(span))
    signed = h if span > 0 else -h
    for i in range(size):
        new[i] = y[i] + signed * k[i]
    evaluate(rates, t + signed, new, 0, p, k, size)
    for i in range(size):
        bend = (k[size + i] - k[i]) / (tolerance * (0.1 + abs(y[i])))
        bends += bend * bend
    largest = max(slopes, (bends / counted) ** 0.5 / h)
    other = max(1e-6, 1e-3 * h) if largest <= 1e-15 else (0.01 / largest) ** 0.125
    return float(min(100.0 * h, other, abs(span)))
