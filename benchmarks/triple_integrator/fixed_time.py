"""Least energy, peak and impulse for a given time: our solvers, certified, and any other solver."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from benchmarks.clock import repeated
from benchmarks.contest import CALL, STACK, Contestant, Row, contest, worst
from benchmarks.triple_integrator import problems
from pontryagin.triple_integrator import Maneuver, minimum_energy, minimum_impulse, minimum_peak

Solver = Callable[[NDArray, NDArray], float]
"""A function from both states (3,) of a manoeuvre of unit duration to the least cost, nan if it fails."""

OURS = {"least energy": minimum_energy, "least peak": minimum_peak, "least impulse": minimum_impulse}


@dataclass(frozen=True)
class Peer:
    """A solver and the number of problems that it is timed on, which is smaller for slow solvers."""

    solve: Solver
    count: int


def rows(problem: str, peers: Mapping[str, Peer], count: int, large: int, rounds: int) -> list[Row]:
    """One of `OURS` in single calls and in a stack of `large`, and the peers, all on the same problems."""
    exact = OURS[problem]
    x0, xf = problems.ends(problem, large)
    starts, targets = x0[:count].tolist(), xf[:count].tolist()

    def one_by_one() -> int:
        for start, end in zip(starts, targets, strict=True):
            exact(Maneuver(start, end, 1.0))
        return count

    def stack() -> int:
        exact(Maneuver(x0, xf, 1.0))
        return large

    solution = exact(Maneuver(x0, xf, 1.0))
    certificate = solution.certificate
    gap = worst(1 - certificate.dual_value / certificate.primal_value)
    sound = float((certificate.primal_residual <= 1e-12).mean())
    contestants = {
        CALL: Contestant(one_by_one, gap, sound),
        STACK: Contestant(repeated(stack, 10), gap, sound),
    }
    for method, peer in peers.items():
        contestants[method] = _entrant(peer, x0, xf, solution.norm)
    return contest(problem, contestants, rounds)


def _entrant(peer: Peer, x0: NDArray, xf: NDArray, optimum: NDArray) -> Contestant:
    starts, targets = x0[: peer.count], xf[: peer.count]
    count = len(starts)

    def run() -> int:
        for ends in zip(starts, targets, strict=True):
            peer.solve(*ends)
        return count

    values = np.array([peer.solve(*ends) for ends in zip(starts, targets, strict=True)])
    found = np.isfinite(values)
    error = worst((values / optimum[:count] - 1)[found])
    return Contestant(run, error, float(found.mean()))
