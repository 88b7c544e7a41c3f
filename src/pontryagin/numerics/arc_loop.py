"""Adaptive integration of an arc up to its end or to an event: the loop over the steps, as plain source.

It becomes native code once per machine and calls native right-hand sides by their addresses; the same source
runs on NumPy arrays and Python functions.
"""

from math import inf

from pontryagin.numerics.crossing import RESOLUTION, earliest
from pontryagin.numerics.runge_kutta import STAGES, Function, Numbers, error, evaluate, first_step, step

SAFETY, SHRINK, GROWTH = 0.9, 0.2, 10.0
"""A step is at most this much shorter or longer than the one before."""
EVENT, SHORT, MANY = 1, 2, 3
"""Why an arc ended before its end: an event, steps below the resolution of time, too many steps."""


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
        if steps >= most:
            outcome = MANY
            break
        last = length >= (end - t) * sense
        if not (last or length > RESOLUTION * abs(t)):
            outcome = SHORT
            break
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
