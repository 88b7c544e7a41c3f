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
NODES, ROWS, ROW = 0, 12, 24
"""Where the table of coefficients holds c and its rows, and the length of a row.

A row holds 12 weights, those that are not zero first, and the stages that they are for. Row s is that of
stage s.
"""
STEP, FIFTH, THIRD = 12, 13, 14
"""The rows of the whole step, b, and of both estimates of its error."""


def evaluate(
    function: Function, t: float, x: Numbers, x_at: int, p: Numbers, out: Numbers, out_at: int
) -> None:
    """Call a function on numbers from the given places on; native code calls an address instead."""
    function(t, x[x_at:], p, out[out_at:])


def combine(size: int, k: Numbers, table: Numbers, row: int, out: Numbers, out_at: int) -> None:
    """The sum of the stages with the weights of a row, four stages at a time."""
    at = ROWS + ROW * row
    for first in range(at, at + STAGES, 4):
        a, b, c, d = table[first], table[first + 1], table[first + 2], table[first + 3]
        i_a, i_b = int(table[first + 12]) * size, int(table[first + 13]) * size
        i_c, i_d = int(table[first + 14]) * size, int(table[first + 15]) * size
        if first == at:
            for i in range(size):
                out[out_at + i] = (a * k[i_a + i] + b * k[i_b + i]) + (c * k[i_c + i] + d * k[i_d + i])
        elif a != 0.0:
            for i in range(size):
                out[out_at + i] += (a * k[i_a + i] + b * k[i_b + i]) + (c * k[i_c + i] + d * k[i_d + i])


def advance(size: int, h: float, y: Numbers, k: Numbers, table: Numbers, row: int, new: Numbers) -> None:
    """new = y + h times the sum of the stages with the weights of a row."""
    combine(size, k, table, row, new, 0)
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
        advance(size, h, y, k, table, s, new)
        evaluate(rates, t + table[NODES + s] * h, new, 0, p, k, s * size)
    advance(size, h, y, k, table, STEP, new)


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
    """Estimated error of a step, as a share of what is allowed; overwrites stages 1 and 2."""
    combine(size, k, table, FIFTH, k, size)  # Neither estimate uses stages 1 and 2.
    combine(size, k, table, THIRD, k, 2 * size)
    fifth, third = 0.0, 0.0
    for i in range(size):
        share = 1.0 / (tolerance * (0.1 + max(abs(y[i]), abs(new[i]))))
        five, three = share * k[size + i], share * k[2 * size + i]
        fifth += five * five
        third += three * three
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
