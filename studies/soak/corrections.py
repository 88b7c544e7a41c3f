"""Corrections of a circular orbit with each thrust, and linear and cone programmes that judge them."""

from functools import partial
from typing import Any

import numpy as np
from benchmarks.clarabel_programme import programme
from benchmarks.peers import installed
from scipy import sparse
from scipy.linalg import expm
from scipy.optimize import linprog

from pontryagin.arrays import Array
from pontryagin.orbit_correction import correct
from studies.part import Found, Part
from studies.soak.outcome import Input, Outcome, attempt, relative, text

CHUNK = 500
WANTED = 100_000
THRUSTS = ("ball", "disc", "box")
WIDTHS = {"ball": 3, "disc": 2, "box": 1}
"""How many successive components of the impulses are bounded together by the Euclidean norm."""
MOST = 240
"""Longest plan that the oracle looks at."""
ALLOWED = 1e-7
"""Largest disagreement with the programme that is no failure: Clarabel stops at 1e-8."""
FLOWN = 1e-9
"""Largest state that may remain after the plan is flown by matrix exponentials, relative to the start."""
MOTION = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 2.0], [0.0, -1.0, 0.0]])
"""Rates of the deviations of radius, radial and transverse speed: r'' = c^2/r^3 - 1/r^2, linearised."""
INTERVALS = (0.25, 0.01, np.pi, np.pi / 2, 2 * np.pi / 3, 2 * np.pi - 1e-3, 40.0)
"""The paper's interval, and such where impulses act at few places of the orbit."""


def drawn(rng: np.random.Generator, number: int) -> tuple[Array, float, float]:
    """States over five decades about the reach of an impulse, an interval, a peak."""
    peak = float(10.0 ** rng.uniform(-6, -1))
    if number % 2:
        interval = float(INTERVALS[number // 2 % len(INTERVALS)])
    else:
        interval = float(10.0 ** rng.uniform(-1.3, 1.0))
    size = peak * 10.0 ** rng.uniform(-3, 1.3, (CHUNK, 1))
    states = size * rng.standard_normal((CHUNK, 3)) * rng.choice([0.0, 1.0], (CHUNK, 3), p=[0.15, 0.85])
    states[1::50] = np.round(states[1::50] / peak) * peak
    if interval < 0.05:
        states *= 0.1
    return states, interval, peak


def line(problem: Input) -> str:
    arguments = ", ".join(text(value) for value in problem.values())
    return (
        "from pontryagin.orbit_correction import correct; h = float.fromhex; "
        f"p = correct({arguments}); print(p.steps, p.gauge, p.shorter_gauge, p.certificate)"
    )


def chunk(thrust: str, rng: np.random.Generator, number: int) -> Found:
    """A chunk of states: certificates on all, the oracle on a hundredth."""
    states, interval, peak = drawn(rng, number)
    inputs = [{"z0": z, "interval": interval, "peak": peak, "thrust": thrust} for z in states]
    outcome = Outcome(line)
    outcome.problems = len(states)
    sample = {*range(7, CHUNK, 100)}
    values = np.full(len(states), np.nan)
    for numbers, plan in attempt(outcome, lambda some: correct(states[some], interval, peak, thrust), inputs):
        bad = outcome.certified(plan.certificate, [inputs[i] for i in numbers])
        sample |= {numbers[i] for i in bad}
        values[numbers] = plan.gauge
        for i in np.flatnonzero(~(plan.gauge <= 1 + 1e-11) | ~(plan.shorter_gauge > 1)):
            outcome.failed("the gauge is above 1, or that of fewer steps is not", inputs[numbers[i]])
    for i in sorted(sample):
        if not np.isnan(values[i]):
            _judge(outcome, states[i], values[i], inputs[i])
    return outcome.found()


def _judge(outcome: Outcome, state: Array, value: float, problem: Input) -> None:
    try:
        plan = correct(**problem)
    except Exception as error:  # whatever is raised is what is looked for
        outcome.failed(f"alone: {type(error).__name__}: {error}", problem)
        return
    if relative(float(plan.gauge), value) > 1e-13:
        outcome.failed("alone it differs from its stack", problem)
    left = remaining(plan.impulses, problem["interval"], state)
    outcome.measured("residual", left, problem)
    if not left <= FLOWN:
        outcome.failed(f"flown, the plan leaves {left:.1e} of the state", problem)
    if not state.any() or len(plan.impulses) > MOST:
        return
    if problem["thrust"] != "box" and not installed("clarabel"):
        outcome.absent.add("clarabel")
        return
    best = partial(least_gauge, problem["thrust"], problem["interval"], problem["peak"], state)
    steps, width = int(plan.steps), WIDTHS[problem["thrust"]]
    apart = relative(float(plan.gauge), best(steps))
    shorter = best(steps - 1)
    if width > 1 or steps > 2:
        apart = max(apart, max(0.0, 1 - shorter), max(0.0, 1 - shorter / float(plan.shorter_gauge)))
    outcome.judged(apart, problem, ALLOWED, "HiGHS" if problem["thrust"] == "box" else "Clarabel")


def remaining(impulses: Array, interval: float, state: Array) -> float:
    """What is left of a state after impulses at the starts of the intervals, relative to it."""
    once = expm(MOTION * (interval % (2 * np.pi)))
    largest = z = np.asarray(state, dtype=float)
    for radial, transverse in impulses:
        z = once @ (z + np.array([0.0, radial, transverse]))
        largest = np.maximum(np.abs(z), np.abs(largest))
    return float(np.abs(z).max() / largest.max()) if largest.any() else float(np.abs(z).max())


def least_gauge(thrust: str, interval: float, peak: float, state: Array, steps: int) -> float:
    """The least peak of impulses that bring a state to zero in so many steps; inf if none do.

    A linear programme for HiGHS where each component is bounded, else a cone programme for Clarabel. Rows are
    scaled by the reach of the impulses and by the state.
    """
    width = WIDTHS[thrust]
    count = (3 if thrust == "ball" else 2) * steps
    if count < 3:
        return _of_few(thrust, peak, state, steps)
    back = [expm(-MOTION * ((interval * k) % (2 * np.pi)))[:, 1:] for k in range(-(-count // 2))]
    reach = np.concatenate(back, axis=1)[:, :count]
    size = np.abs(state).max()
    rows = np.abs(reach).max(axis=1)
    if thrust == "box":
        return size / peak / _most_by_linear_programme(reach / rows[:, None], -state / size / rows)
    balance = sparse.csc_matrix(np.column_stack([reach / rows[:, None], np.zeros(3)]))
    groups = -(-count // width)
    within = sparse.lil_matrix((groups * (width + 1), count + 1))
    for group in range(groups):
        within[group * (width + 1), count] = -1.0
        for j in range(width):
            within[group * (width + 1) + 1 + j, group * width + j] = -1.0
    cost = np.append(np.zeros(count), 1.0)
    right = np.concatenate([-state / size / rows, np.zeros(within.shape[0])])
    cones = [("Zero", 3), *[("SecondOrder", width + 1)] * groups]
    solver, optimum = programme(cost, sparse.vstack([balance, within]), right, cones)
    return float(optimum(solver.solve())) * size / peak


def _most_by_linear_programme(reach: Array, target: Array) -> float:
    """The largest s with reach w = s target for components |w_i| <= 1."""
    count = reach.shape[1]
    found = linprog(
        np.append(np.zeros(count), -1.0),
        A_eq=np.column_stack([reach, -target]),
        b_eq=np.zeros(3),
        bounds=[(-1, 1)] * count + [(0, None)],
        method="highs",
        options={"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10},
    )
    return -float(found.fun) if found.status == 0 else float("nan")


def _of_few(thrust: str, peak: float, state: Array, steps: int) -> float:
    if steps == 0:
        return np.inf
    if state[0] != 0:
        return np.inf
    norm: Any = np.hypot if thrust == "disc" else lambda a, b: max(abs(a), abs(b))
    return float(norm(state[1], state[2]) / peak)


def parts() -> list[Part]:
    """The rows of the table."""
    return [
        Part(f"correction, {name}", [__name__], WANTED // CHUNK, partial(chunk, name)) for name in THRUSTS
    ]
