"""Least energy, peak, impulse and L4 norm for a given time: our solvers, certified, and any other."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from numpy.typing import ArrayLike, NDArray

from benchmarks.clock import one_by_one, one_call, repeated
from benchmarks.contest import CALL, STACK, Contestant, Row, contest, worst_gap
from benchmarks.contest import peer as judged
from benchmarks.triple_integrator import problems
from pontryagin.triple_integrator import Maneuver, minimum_energy, minimum_impulse, minimum_norm, minimum_peak

Solver = Callable[[NDArray, NDArray], float]
"""A function from both states (3,) of a manoeuvre of unit duration to the least cost, nan if it fails."""

OURS: dict[str, Callable[[Maneuver], Any]] = {
    "least energy": minimum_energy,
    "least peak": minimum_peak,
    "least impulse": minimum_impulse,
    "least L4 norm": partial(minimum_norm, q=4.0),
}


@dataclass(frozen=True)
class Peer:
    """A solver and the number of problems that it is timed on, which is smaller for slow solvers."""

    solve: Solver
    count: int


def rows(problem: str, peers: Mapping[str, Peer], count: int, large: int, rounds: int) -> list[Row]:
    """One of `OURS` in single calls and in a stack of `large`, and the peers, all on the same problems."""
    exact = OURS[problem]
    x0, xf = problems.ends(problem, large)

    def solve(start: ArrayLike, end: ArrayLike) -> Any:
        return exact(Maneuver(start, end, 1.0))

    solution = solve(x0, xf)
    certificate = solution.certificate
    gap = worst_gap(certificate.dual_value, certificate.primal_value)
    sound = float((certificate.primal_residual <= 1e-12).mean())
    single = one_by_one(solve, x0[:count].tolist(), xf[:count].tolist())
    contestants = {
        CALL: Contestant(single, gap, sound),
        STACK: Contestant(repeated(one_call(lambda: solve(x0, xf), large), 10), gap, sound),
    }
    for method, peer in peers.items():
        some = slice(peer.count)
        contestants[method] = judged(peer.solve, solution.norm[some], x0[some], xf[some])
    return contest(problem, contestants, rounds)
