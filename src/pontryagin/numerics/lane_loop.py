"""Adaptive integration of several trajectories side by side: the loop over the steps, as plain source.

Each trajectory has its own time and its own steps. Numbers of one kind lie beside each other, one for each
trajectory (a lane), so that the processor's vectors hold them and one instruction serves all. Lanes that have
reached their end wait, with steps of zero. It becomes native code in the same way as
`pontryagin.numerics.arc_loop`, whose steps and lengths of steps these are.
"""

from math import inf

from pontryagin.numerics.arc_loop import GROWTH, MANY, SAFETY, SHORT, SHRINK
from pontryagin.numerics.crossing import RESOLUTION
from pontryagin.numerics.runge_kutta import Function, Numbers

LANES = 8
"""Number of trajectories side by side: as many as the widest vectors of common processors hold."""
LENGTH, GROWN, OPEN, TAKEN, AIM, STEPS, SLOPES = 0, 1, 2, 3, 4, 5, 6
"""What is held for each lane: the next step's length and its largest growth, whether the lane is under way,
whether its last step was taken and where it led, the number of steps, the size of the first slopes."""
HELD = 7
"""Number of these rows."""


def evaluate_lanes(function: Function, t: Numbers, x: Numbers, p: Numbers, out: Numbers, at: int) -> None:
    """Call the rates of all lanes; native code calls an address instead."""
    function(t, x, p, out[at:])


def step_lanes(
    step: Function,
    t: Numbers,
    h: Numbers,
    y: Numbers,
    p: Numbers,
    k: Numbers,
    new: Numbers,
    off: Numbers,
    tolerance: float,
) -> None:
    """Call a function that makes a step of all lanes; native code calls an address instead.

    From the states y, whose rates k are known, steps h lead to the states ``new``. The rates there follow k,
    and ``off`` gets the estimated errors as shares of what is allowed.
    """
    step(t, h, y, p, k, new, off, tolerance)


def first_steps(
    rates: Function,
    size: int,
    t: Numbers,
    end: Numbers,
    y: Numbers,
    p: Numbers,
    k: Numbers,
    new: Numbers,
    tolerance: float,
    held: Numbers,
    h: Numbers,
    clock: Numbers,
) -> None:
    """Length of each lane's first step, by the sizes of the state and of its first and second derivatives."""
    for lane in range(LANES):
        states, slopes, span = 0.0, 0.0, end[lane] - t[lane]
        for i in range(size):
            j = i * LANES + lane
            allowed = tolerance * (0.1 + abs(y[j]))
            states += (y[j] / allowed) * (y[j] / allowed)
            slopes += (k[j] / allowed) * (k[j] / allowed)
        states, slopes = (states / size) ** 0.5, (slopes / size) ** 0.5
        length = 1e-6 if states < 1e-5 or slopes < 1e-5 else 0.01 * states / slopes
        length = min(max(length, 1e-8 * abs(span)), abs(span))
        held[LENGTH * LANES + lane], held[SLOPES * LANES + lane] = length, slopes
        h[lane] = length if span > 0 else -length
        clock[lane] = t[lane] + h[lane]
        for i in range(size):
            new[i * LANES + lane] = y[i * LANES + lane] + h[lane] * k[i * LANES + lane]
    evaluate_lanes(rates, clock, new, p, k, size * LANES)
    for lane in range(LANES):
        bends, length = 0.0, held[LENGTH * LANES + lane]
        for i in range(size):
            j = i * LANES + lane
            bend = (k[size * LANES + j] - k[j]) / (tolerance * (0.1 + abs(y[j])))
            bends += bend * bend
        if length > 0.0:
            largest = max(held[SLOPES * LANES + lane], (bends / size) ** 0.5 / length)
            other = max(1e-6, 1e-3 * length) if largest <= 1e-15 else (0.01 / largest) ** 0.125
            length = min(100.0 * length, other, abs(end[lane] - t[lane]))
        held[LENGTH * LANES + lane] = length


def aim(t: Numbers, end: Numbers, most: int, held: Numbers, h: Numbers, codes: Numbers) -> int:
    """Each lane's next step h, zero for those that have ended; how many are under way."""
    under_way = 0
    for lane in range(LANES):
        left, length = end[lane] - t[lane], held[LENGTH * LANES + lane]
        last = length >= abs(left)
        if held[OPEN * LANES + lane] > 0.0:
            if left == 0.0:
                held[OPEN * LANES + lane] = 0.0
            elif held[STEPS * LANES + lane] >= most:
                held[OPEN * LANES + lane], codes[lane] = 0.0, MANY
            elif not (last or length > RESOLUTION * abs(t[lane])):
                held[OPEN * LANES + lane], codes[lane] = 0.0, SHORT
        if held[OPEN * LANES + lane] > 0.0:
            h[lane] = left if last else (length if left > 0.0 else -length)
            held[AIM * LANES + lane] = end[lane] if last else t[lane] + h[lane]
            held[STEPS * LANES + lane] += 1
            under_way += 1
        else:
            h[lane] = 0.0
            held[AIM * LANES + lane] = t[lane]
    return under_way


def judge(h: Numbers, off: Numbers, held: Numbers) -> None:
    """Which lanes take their step, and the length of each lane's next one."""
    for lane in range(LANES):
        length, share = abs(h[lane]), off[lane]
        taken = share < 1.0 and held[OPEN * LANES + lane] > 0.0
        factor = SAFETY / ((share**0.5) ** 0.5) ** 0.5 if 0.0 < share < inf else inf
        if share < 1.0:
            length *= min(held[GROWN * LANES + lane], factor)
            held[GROWN * LANES + lane] = GROWTH
        else:
            length *= max(SHRINK, factor) if share < inf else SHRINK
            held[GROWN * LANES + lane] = 1.0
        held[LENGTH * LANES + lane], held[TAKEN * LANES + lane] = length, 1.0 if taken else 0.0


def follow_lanes(
    rates: Function,
    step: Function,
    size: int,
    y: Numbers,
    p: Numbers,
    t: Numbers,
    end: Numbers,
    tolerance: float,
    most: int,
    k: Numbers,
    new: Numbers,
    taken: Numbers,
    h: Numbers,
    off: Numbers,
    held: Numbers,
    codes: Numbers,
) -> int:
    """Integrate the states of all lanes to their ends.

    Parameters
    ----------
    rates, step : function
        The rates of all numbers in y; a step of all lanes, see `step_lanes`.
    size : int
        Number of numbers of a trajectory.
    y : (size, LANES) numbers
        The states, which are overwritten with the last ones.
    p : (p, LANES) numbers
        The parameters.
    t, end : (LANES,) numbers
        The times, which are overwritten with those reached; times at the ends.
    tolerance, most : float, int
        Relative error allowed in a step; largest number of steps.
    k, new, taken, h, off, held : numbers
        Room for twice the states, two times for once; for two numbers and for `HELD` numbers of each lane.
    codes : (LANES,) numbers
        0, `SHORT` or `MANY` of `arc_loop` for each lane.

    Returns
    -------
    int
        How many lanes did not reach their end.
    """
    wide = size * LANES
    for lane in range(LANES):
        held[GROWN * LANES + lane], held[OPEN * LANES + lane] = GROWTH, 1.0
        held[STEPS * LANES + lane], codes[lane] = 0.0, 0.0
    evaluate_lanes(rates, t, y, p, k, 0)
    first_steps(rates, size, t, end, y, p, k, new, tolerance, held, h, off)
    while aim(t, end, most, held, h, codes) > 0:
        step_lanes(step, t, h, y, p, k, new, off, tolerance)
        judge(h, off, held)
        for lane in range(LANES):
            if held[TAKEN * LANES + lane] > 0.0:
                t[lane] = held[AIM * LANES + lane]
        for i in range(size):
            for lane in range(LANES):
                taken[i * LANES + lane] = held[TAKEN * LANES + lane]
        for j in range(wide):
            y[j] = new[j] if taken[j] > 0.0 else y[j]
            k[j] = k[wide + j] if taken[j] > 0.0 else k[j]
    failed = 0
    for lane in range(LANES):
        for i in range(size):
            if not abs(y[i * LANES + lane]) < inf:
                codes[lane] = SHORT
        if codes[lane] > 0.0:
            failed += 1
    return failed
