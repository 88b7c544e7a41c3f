"""Where event functions grow through zero within a step, as plain source.

The state inside a step is found by a shorter step from the same beginning, which is as accurate as the step
itself and needs no interpolant. This becomes native code together with `pontryagin.numerics.arc_loop`.
"""

from pontryagin.numerics.runge_kutta import Function, Numbers, evaluate, step

RESOLUTION = 1e-15
"""Steps shorter than this share of the time are refused; events are located to a few of it."""


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
