"""The gauge for a given number of steps, and the fewest steps with their plan: our solvers and peers."""

from collections.abc import Callable, Mapping
from functools import cache
from math import ceil

import numpy as np
from numpy.typing import NDArray

from benchmarks.apart import answer
from benchmarks.clock import one_by_one, one_call, repeated
from benchmarks.contest import CALL, STACK, Contestant, Row, contest, peer, worst, worst_gap
from benchmarks.orbit_correction import cones, linear, modelled
from benchmarks.orbit_correction.states import INTERVAL, PEAK, Peer, Solver, states, thrust
from benchmarks.peers import absent
from pontryagin.orbit_correction import Plan, correct
from pontryagin.orbit_correction.plan.thrust import Thrust

STEPS = 8
"""Number of steps for which gauges are compared, about as many as the states need."""

STACK_SIZE = 1000
"""Number of states that are solved together, as many as in the aim."""

REACHED = 1 + 1e-7
"""A peer's gauge counts as at most 1 if it does not exceed this, which allows for the peer's tolerance."""


def peers(name: str, quick: bool) -> dict[str, Peer]:
    """The peers that can solve the problem for a set of impulses."""
    many, few = (20, 4) if quick else (200, 40)
    found: dict[str, Peer] = {}
    if not absent("clarabel"):
        found["Clarabel, impulses"] = Peer(cones.impulses, many)
        found["Clarabel, costate"] = Peer(cones.costate, many)
    if not (absent("cvxpy") or absent("clarabel")):
        found["CVXPY + Clarabel"] = Peer(modelled.by_cvxpy, few)
    if name == "box":
        found["HiGHS, linprog"] = Peer(linear.by_linprog, few)
        if not absent("highspy"):
            found["HiGHS, highspy"] = Peer(linear.by_highspy, many)
    return found


def given_steps(name: str, opponents: Mapping[str, Peer], count: int, rounds: int) -> list[Row]:
    """Gauges in `STEPS` steps, one by one and in a stack of `STACK_SIZE`."""
    engine, stack = thrust(name), states(STACK_SIZE)
    counts = np.full(STACK_SIZE, STEPS)
    exact = engine.gauges(stack, counts)
    single = one_gauge_each(engine, stack[:count], STEPS)
    together = repeated(one_call(lambda: engine.gauges(stack, counts), STACK_SIZE), 3)
    gap = worst_gap(exact.lower, exact.upper)
    entrants = {CALL: Contestant(single, gap, 1.0), STACK: Contestant(together, gap, 1.0)}
    for method, opponent in opponents.items():
        some = slice(opponent.count)
        entrants[method] = peer(opponent.make(name, STEPS), exact.upper[some], stack[some] / PEAK)
    return contest(f"gauge in {STEPS} steps, {name}", entrants, rounds)


def one_gauge_each(engine: Thrust, some: NDArray, steps: int) -> Callable[[], int]:
    """Our gauges of states (k, 3), one call for each."""
    counts = np.full(1, steps)
    return one_by_one(lambda state: engine.gauges(state[None], counts), some)


def fewest_steps(name: str, opponents: Mapping[str, Peer], count: int, rounds: int) -> list[Row]:
    """N_min and alpha(N_min), one by one and in a stack of `STACK_SIZE`; peers search as `search` does."""
    stack = states(STACK_SIZE)

    def solve(z0: NDArray) -> Plan:
        return correct(z0, INTERVAL, PEAK, name)

    exact = solve(stack)
    certificate = exact.certificate
    gap = worst_gap(certificate.dual_value, certificate.primal_value)
    sound = float(((certificate.primal_residual <= 1e-12) & (exact.shorter_gauge > 1)).mean())
    together = repeated(one_call(lambda: solve(stack), STACK_SIZE), 3)
    entrants = {
        CALL: Contestant(one_by_one(solve, stack[:count]), gap, sound),
        STACK: Contestant(together, gap, sound),
    }
    for method, opponent in opponents.items():
        entrants[method] = _search_entrant(name, opponent, exact)
    return contest(f"fewest steps, {name}", entrants, rounds)


def _search_entrant(name: str, opponent: Peer, exact: Plan) -> Contestant:
    made, scaled = cache(lambda steps: opponent.make(name, steps)), exact.z0[: opponent.count] / PEAK
    least = thrust(name).fewest
    run = one_by_one(lambda state: search(made, state, least), scaled)
    none = [(0, float("nan"))] * len(scaled)
    answers = answer(name, lambda: [search(made, state, least) for state in scaled], none)
    steps, alpha = (np.array(column) for column in zip(*answers, strict=True))
    right = steps == exact.steps[: len(steps)]
    return Contestant(run, worst((alpha / exact.gauge[: len(steps)] - 1)[right]), float(right.mean()))


def search(made: Callable[[int], Solver], state: NDArray, least: int) -> tuple[int, float]:
    """N_min and alpha(N_min) from a peer's gauges, by the method of our own search; (0, nan) if it fails."""
    too_few, enough, best, guess = least - 1, None, float("nan"), least
    while enough is None or enough - too_few > 1:
        alpha = made(guess)(state)
        if not alpha >= 0:
            return 0, float("nan")
        following = ceil(guess * min(alpha, 100.0))
        if alpha <= REACHED:
            enough, best = guess, alpha
        else:
            too_few = guess
        guess = max(following, too_few + 1)
        if enough is not None:
            guess = min(guess, max(enough - 1, 1))
    return enough, best
