"""Adaptive integration by the Runge-Kutta method of order 8 of Dormand and Prince, up to an event.

`follow` is the whole loop, as plain source. It becomes native code once per machine and calls native
right-hand sides by their addresses; the same source runs on NumPy arrays and Python functions. The step sizes
are those of DOP853: Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, sections II.4 and
II.10. Inside a step, at an event or at a time of the user's, the state is found by a shorter step from the
same beginning, which is as accurate as the step itself and needs no interpolant.
"""

from math import inf
from typing import Any

Function = Any
"""A function (t, x, p, out) that writes rates, or event functions and their slopes, to ``out``."""
Numbers = Any
"""Floats that can be read and written by their index: an array, or a pointer in native code."""

STAGES = 12
"""Number of stages of a step. The derivative at its end, stage 12, is the first stage of the next step."""
NODES, WEIGHTS, ESTIMATE_5, ESTIMATE_3 = 0, 12, 168, 181
"""Where the table of coefficients holds c, the rows of A with b as row 12, and both error estimates."""
SAFETY, SHRINK, GROWTH = 0.9, 0.2, 10.0
"""A step is at most this much shorter or longer than the one before."""
EVENT, SHORT, MANY = 1, 2, 3
"""Why an arc ended before its end: an event, steps below the resolution of time, too many steps."""
RESOLUTION = 1e-15
"""Steps shorter than this share of the time are refused; events are located to a few of it."""


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


def summit(before: float, rising: float, after: float, falling: float) -> float:
    """Where the cubic with these values and slopes at 0 and 1 is largest, if it rises at 0 and falls at 1."""
    a = 3.0 * (rising + falling) - 6.0 * (after - before)
    b = 6.0 * (after - before) - 4.0 * rising - 2.0 * falling
    root = max(b * b - 4.0 * a * rising, 0.0) ** 0.5
    return float(2.0 * rising / (root - b))


def locate(
    rates: Function,
    guards: Function,
    event: int,
    events: int,
    size: int,
    t: float,
    h: float,
    y: Numbers,
    p: Numbers,
    k: Numbers,
    table: Numbers,
    trial: Numbers,
    values: Numbers,
    below: float,
    above: float,
) -> float:
    """The share of a step after which an event function has grown through zero, by Newton's method.

    It is negative after the share ``below`` and not after ``above``; the share that is returned is the first
    known one after which it is not. ``trial`` is overwritten.
    """
    share = 0.5 * (below + above)
    for _ in range(60):
        step(rates, size, t, share * h, y, p, k, table, trial)
        evaluate(guards, t + share * h, trial, 0, p, values, 2 * events)
        value, slope = values[2 * events + event], values[3 * events + event] * h
        if value < 0.0:
            below = share
        else:
            above = share
        share -= value / slope if slope > 0.0 else 2.0
        if (above - below) * abs(h) <= RESOLUTION * abs(t):
            break
        nearest = 0.25 * RESOLUTION * max(abs(t), abs(h)) / abs(h)  # A root closer than this is passed.
        if not below + nearest < share < above - nearest:
            if abs(value) < abs(slope) * nearest:
                share = above - nearest if value >= 0.0 else below + nearest
            else:
                share = 0.5 * (below + above)
        if not below < share < above:
            break
    return above


def earliest(
    rates: Function,
    guards: Function,
    events: int,
    size: int,
    t: float,
    h: float,
    y: Numbers,
    p: Numbers,
    k: Numbers,
    table: Numbers,
    trial: Numbers,
    values: Numbers,
    first: bool,
) -> tuple[int, float]:
    """The first event in a step and the share of the step after which it comes; -1 if there is none.

    ``values`` holds the event functions at the beginning, their slopes, and both at the end.
    """
    found, least = -1, 2.0
    for i in range(events):
        before, rising = values[i], values[events + i] * h
        after, falling = values[4 * events + i], values[5 * events + i] * h
        below, above = 0.0, 1.0
        if before < 0.0 and after < 0.0:
            if not (rising > 0.0 and falling < 0.0):
                continue
            above = summit(before, rising, after, falling)
        elif first and before >= 0.0 and after >= 0.0 and rising < 0.0 and falling > 0.0:
            below = summit(-before, -rising, -after, -falling)
        elif not (before < 0.0 and after >= 0.0):
            continue
        if below > 0.0 or above < 1.0:
            inside = max(below, above if above < 1.0 else 0.0)
            step(rates, size, t, inside * h, y, p, k, table, trial)
            evaluate(guards, t + inside * h, trial, 0, p, values, 2 * events)
            if (values[2 * events + i] < 0.0) == (above < 1.0):
                continue
        share = locate(rates, guards, i, events, size, t, h, y, p, k, table, trial, values, below, above)
        if share < least:
            found, least = i, share
    return found, least


def follow(
    rates: Function,
    plain: Function,
    guards: Function,
    events: int,
    size: int,
    counted: int,
    y: Numbers,
    p: Numbers,
    end: float,
    longest: float,
    tolerance: float,
    most: int,
    times: Numbers,
    samples: int,
    states: int,
    rows: Numbers,
    k: Numbers,
    inner: Numbers,
    table: Numbers,
    new: Numbers,
    trial: Numbers,
    values: Numbers,
    report: Numbers,
) -> int:
    """Integrate a state from the time report[0] to its end, or to an event before it.

    Parameters
    ----------
    rates, plain, guards : function
        The rates of all numbers in y; of the first ``states`` numbers; the event functions and their slopes
        along the trajectory.
    events, size, counted : int
        Number of event functions; of numbers in y; of those among them that are not there to fill a row.
    y : (size,) numbers
        The state, which is overwritten with the last one.
    p : numbers
        The parameters.
    end, longest, tolerance : float
        Time at the end, longest step, relative error allowed in a step.
    most : int
        Largest number of steps.
    times, samples, states, rows : (samples,) numbers, int, int, (samples, states) numbers
        The times at which the first ``states`` numbers of the state are kept in ``rows``.
    k, inner, table, new, trial, values : numbers
        Room for 13 stages of the state and of its first numbers; the coefficients; room for two states and
        for 6 ``events``.
    report : (4,) numbers
        The time reached, the number of steps, the event, the number of rows.

    Returns
    -------
    int
        0, `EVENT`, `SHORT` or `MANY`.
    """
    t = report[0]
    span, sense = end - t, 1.0 if end >= t else -1.0
    done, steps, outcome = 0, 0, 0
    while done < samples and (times[done] - t) * sense <= 0.0:
        for i in range(states):
            rows[done * states + i] = y[i]
        done += 1
    event, first, length = -1, True, inf
    evaluate(rates, t, y, 0, p, k, 0)
    if events > 0:
        evaluate(guards, t, y, 0, p, values, 0)
    if span != 0.0:
        length = first_step(rates, size, counted, t, span, y, p, k, new, tolerance)
    grown = GROWTH
    while (end - t) * sense > 0.0:
        length = min(length, longest)
        if not length > RESOLUTION * abs(t):
            outcome = SHORT
            break
        if steps >= most:
            outcome = MANY
            break
        last = length >= (end - t) * sense
        h = end - t if last else sense * length
        steps += 1
        step(rates, size, t, h, y, p, k, table, new)
        evaluate(rates, t + h, new, 0, p, k, STAGES * size)
        off = error(size, counted, h, y, new, k, table, tolerance)
        if not off < 1.0:
            length = abs(h) * (max(SHRINK, SAFETY * off**-0.125) if off < inf else SHRINK)
            grown = 1.0
            continue
        length = abs(h) * (grown if off == 0.0 else min(grown, SAFETY * off**-0.125))
        grown = GROWTH
        reached = end if last else t + h
        if events > 0:
            evaluate(guards, reached, new, 0, p, values, 4 * events)
            event, share = earliest(rates, guards, events, size, t, h, y, p, k, table, trial, values, first)
            if event >= 0:
                reached = t + share * h
        if event >= 0:
            step(rates, size, t, share * h, y, p, k, table, trial)
            for i in range(size):
                new[i] = trial[i]
        for i in range(states):
            inner[i] = k[i]
        while done < samples and (times[done] - reached) * sense <= 0.0:
            if times[done] == reached:
                for i in range(states):
                    trial[i] = new[i]
            else:
                step(plain, states, t, times[done] - t, y, p, inner, table, trial)
            for i in range(states):
                rows[done * states + i] = trial[i]
            done += 1
        for i in range(size):
            y[i] = new[i]
            k[i] = k[STAGES * size + i]
        if event >= 0:
            t, outcome = reached, EVENT
            break
        for i in range(2 * events):
            values[i] = values[4 * events + i]
        t, first = reached, False
    for i in range(size):
        if not abs(y[i]) < inf:
            outcome = SHORT
    report[0], report[1], report[2], report[3] = t, steps, event, done
    return outcome
