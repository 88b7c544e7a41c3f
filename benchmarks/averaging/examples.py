"""The paper's examples (the rotor with two costs), a system of a user's own, and stacks of each."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import sympy as sp

from pontryagin.averaging import (
    AveragedSolution,
    PhaseSystem,
    Quadratic,
    kepler,
    rotor,
    smooth_example,
    solve_averaged,
    spin_down,
)

SEED = 19770406
"""Seed of the random numbers; together with an example's name it determines the example's stack."""

ROTOR: dict[str, Any] = {
    "mass": 1 + sp.cos(sp.Symbol("x")) / 3,
    "potential": -sp.cos(sp.Symbol("x")),
    "force": -sp.Symbol("v") / 5,
}
"""A rotor whose mass and potential depend on its angle, braked in proportion to its rate."""

SMOOTH, LEAST_TIME, PAID, KEPLER, BODY, OWN = (
    "rippled smooth example",
    "rotor, least time",
    "rotor, paid control",
    "Kepler transfer",
    "rigid body",
    "own system",
)


@dataclass(frozen=True)
class Example:
    """One problem, and the arguments that vary in a stack of problems like it.

    Attributes
    ----------
    solve : callable
        The averaged solve; takes the arguments in `given`.
    given : mapping
        Arguments of the single problem.
    spread : mapping
        Relative variation of each argument that varies in a stack.
    """

    solve: Callable[..., AveragedSolution]
    given: Mapping[str, Any]
    spread: Mapping[str, float]

    def one(self) -> AveragedSolution:
        """The averaged solution of the single problem."""
        return self.solve(**self.given)

    def stack(self, name: str, count: int) -> dict[str, Any]:
        """Arguments of a stack of `count` problems drawn around the single one."""
        rng = np.random.default_rng([SEED, *name.encode()])
        drawn = dict(self.given)
        for argument, share in self.spread.items():
            middle = np.asarray(self.given[argument], dtype=float)
            drawn[argument] = middle * (1 + share * rng.uniform(-1, 1, (count, *middle.shape)))
        return drawn


@lru_cache(maxsize=1)
def own_expressions() -> dict[str, Any]:
    """A rotating pendulum in a resisting medium, sped up at the running cost 1 + u^2; not in the paper."""
    a, x, u, level = sp.symbols("a x u level", real=True)
    speed = sp.sqrt(2 * (a + sp.cos(x)))
    return {
        "f": [speed * (u - speed / 5)],
        "anomaly_rate": speed,
        "control_set": Quadratic(),
        "slow": [a],
        "control": [u],
        "phase": x,
        "target": [a - level],
        "level": level,
    }


def own_system(end: Any = 5.0) -> PhaseSystem:
    """The user's own system with a given final energy."""
    given = own_expressions()
    level = given["level"]
    return PhaseSystem(numbers={level: end}, **{k: v for k, v in given.items() if k != "level"})


@lru_cache(maxsize=1)
def _own_once() -> PhaseSystem:
    return own_system()


def _own(start: Any, end: Any = None) -> AveragedSolution:
    system = _own_once() if end is None else own_system(end)
    return solve_averaged(system, np.asarray(start)[..., None])


EXAMPLES = {
    SMOOTH: Example(smooth_example, {"v0": 1.0, "v1": 2.0, "ripple": 0.5}, {"v0": 0.2, "v1": 0.2}),
    LEAST_TIME: Example(
        lambda **given: rotor(**given, **ROTOR), {"a0": 2.0, "a1": 5.0, "peak": 1.0}, {"a0": 0.2, "a1": 0.2}
    ),
    PAID: Example(
        lambda **given: rotor(**given, **ROTOR), {"a0": 2.0, "a1": 5.0, "k": 1.0}, {"a0": 0.2, "a1": 0.2}
    ),
    KEPLER: Example(kepler, {"E0": -0.5, "K0": 0.9, "E1": -0.3, "l": 0.1}, {"K0": 0.05, "E1": 0.1, "l": 0.5}),
    BODY: Example(
        spin_down,
        {"omega0": [1.0, 0.4, 2.0], "semiaxes": [1.0, 0.5, 0.7], "ratio": 1.6},
        {"omega0": 0.2, "semiaxes": 0.2},
    ),
    OWN: Example(_own, {"start": 2.0}, {"start": 0.2}),
}


def worst_residual(solution: AveragedSolution) -> float:
    """The largest residual of the maximum principle in a solution or a stack of solutions."""
    return float(np.max(solution.certificate.residual))
