"""Rendezvous over all inclinations and eccentricities to 0.9: of least energy, and of least time."""

import math
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from types import FrameType
from typing import Any

import numpy as np
from benchmarks.peers import installed

from pontryagin.certificate import ACCEPTED
from pontryagin.rendezvous import Chaser, Orbit, Rendezvous, solve
from studies.part import Found, Part
from studies.soak import cartesian
from studies.soak.averaged import attempted
from studies.soak.outcome import Input, Outcome, text

WANTED = 150
"""Meetings of each kind; a chunk is one of them."""
PATIENCE = 300.0
"""Seconds of processor time after which a search counts as one that does not end."""
ALLOWED = cartesian.ENOUGH
"""Largest disagreement that is no failure: the spline of the thrust has such errors."""
DIRECTLY = 15
"""Every so many meetings are sought by the direct method too."""
CHEAPER = 1e-3
"""A meeting that the direct method finds cheaper by this share was missed."""


def drawn(rng: np.random.Generator, number: int, free: bool) -> dict[str, Any]:
    """A problem as numbers: inclinations in turn over 0 to 180 degrees, the rest at random."""
    inclination = math.pi * ((number + rng.random()) / WANTED if number % 10 else rng.integers(0, 7) / 6)
    given: dict[str, Any] = {
        "parameter": rng.uniform(0.7, 1.8),
        "eccentricity": rng.uniform(0, 0.9) * rng.integers(0, 5) / 4,
        "angles": [rng.uniform(0, 2 * math.pi), inclination, rng.uniform(0, 2 * math.pi)],
        "anomaly": rng.uniform(0, 2 * math.pi),
        "chaser": [rng.uniform(0, 0.5) * rng.integers(0, 2), rng.uniform(0, 2 * math.pi)],
    }
    if free:
        return {**given, "peak": rng.uniform(0.05, 0.5), "duration": None}
    return {**given, "peak": None, "duration": rng.uniform(3, 20)}


def problem_of(given: Input) -> Rendezvous:
    """The rendezvous of such numbers."""
    node, inclination, pericentre = given["angles"]
    target = Orbit.from_angles(
        given["parameter"], given["eccentricity"], node, inclination, pericentre, given["anomaly"]
    )
    e, anomaly = given["chaser"]
    attitude = [math.cos(anomaly / 2), 0.0, 0.0, math.sin(anomaly / 2)]
    chaser = Chaser(1 / (1 + e * math.cos(anomaly)), e * math.sin(anomaly), 1.0, attitude)
    if given["duration"] is None:
        return Rendezvous(chaser, target, time_weight=1.0, energy_weight=0.0, peak=given["peak"])
    return Rendezvous(
        chaser, target, time_weight=0.0, energy_weight=1.0, peak=math.inf, duration=given["duration"]
    )


def line(given: Input) -> str:
    """A line of Python that solves the problem."""
    problem = problem_of(given)
    chaser, target = problem.chaser, problem.target
    craft = ", ".join(map(text, (chaser.r, chaser.v1, chaser.c, chaser.attitude)))
    orbit = ", ".join(map(text, (target.parameter, target.eccentricity, target.attitude, target.anomaly)))
    limits = ", ".join(
        f"{name}={text(value)}"
        for name, value in (
            ("time_weight", problem.time_weight),
            ("energy_weight", problem.energy_weight),
            ("peak", problem.peak),
            *([] if problem.duration is None else [("duration", problem.duration)]),
        )
    )
    return (
        "from pontryagin.rendezvous import Chaser, Orbit, Rendezvous, solve; h = float.fromhex; "
        f"b = solve(Rendezvous(Chaser({craft}), Orbit({orbit}), {limits})); print(b.cost, b.certificate)"
    )


@contextmanager
def patience(seconds: float) -> Iterator[None]:
    """Raise `TimeoutError` in what takes more processor time, where the system has such alarms."""
    if not hasattr(signal, "setitimer"):
        yield
        return

    def over(number: int, frame: FrameType | None) -> None:
        raise TimeoutError(f"no answer in {seconds:.0f} s of processor time")

    before = signal.signal(signal.SIGPROF, over)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)


def chunk(free: bool, rng: np.random.Generator, number: int) -> Found:
    """One meeting: its certificate, the flight under its thrust, and for a few the direct method."""
    outcome, given = Outcome(line), drawn(rng, number, free)
    outcome.problems = 1
    best = attempted(outcome, partial(_found, given), given)
    if best is None:
        return outcome.found()
    outcome.measured("residual", float(best.certificate.residual), given)
    if not best.certificate.holds():
        outcome.failed(f"the certificate does not hold to {ACCEPTED}: {best.certificate.residual:.1e}", given)
    apart = attempted(outcome, lambda: cartesian.disagreement(best), given)
    if apart is not None:
        outcome.judged(apart, given, ALLOWED, "SciPy")
    if number % DIRECTLY == 0:
        _directly(outcome, best, given)
    return outcome.found()


def _found(given: Input) -> Any:
    with patience(PATIENCE):
        return solve(problem_of(given))


def _directly(outcome: Outcome, best: Any, given: Input) -> None:
    """Seek cheaper meetings by the direct method from cold starts with more and fewer turns."""
    if not installed("casadi"):
        outcome.absent.add("casadi")
        return
    from pontryagin.rendezvous.judge.collocation import direct

    costs = []
    for turns in {max(0.25, best.revolutions + more) for more in (-1, 0, 1)}:
        found = _quietly(lambda turns=turns: direct(best.problem, best.duration, turns))
        costs += [found.cost] if found else []
    if costs and min(costs) < best.cost * (1 - CHEAPER):
        share = 1 - min(costs) / best.cost
        outcome.failed(f"CasADi finds a meeting that is cheaper by {100 * share:.2g} %", given)


def _quietly(call: Callable[[], Any]) -> Any:
    """What the direct method finds; None where it does not converge, which it need not."""
    try:
        with patience(PATIENCE):
            return call()
    except Exception:  # Ipopt's failures are not ours
        return None


def parts() -> list[Part]:
    """The rows of the table."""
    kinds = {"rendezvous, least energy": False, "rendezvous, least time": True}
    return [Part(name, [__name__], WANTED, partial(chunk, free), share=4.0) for name, free in kinds.items()]
