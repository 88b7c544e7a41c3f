"""Averaged problems over random systems, and the averaged equations built anew and integrated by SciPy."""

from collections.abc import Callable
from dataclasses import asdict
from typing import Any

import numpy as np
import sympy as sp
from scipy.integrate import quad_vec, solve_ivp

from pontryagin.arrays import Array
from pontryagin.averaging import solve_averaged
from studies.part import Found, Part
from studies.soak import systems
from studies.soak.outcome import Outcome
from studies.soak.systems import NAMES, PHASE, Problem

WANTED = 1_000
"""A chunk is one problem."""
EVERY = 20
"""Every so many problems are judged by the oracle, and those that are suspicious."""
ALLOWED = 1e-6
"""Largest disagreement with the integrated equations that is no failure: they are integrated to 1e-9."""
KINKS = 64
"""Pieces of a turn that the means are taken over: controls may jump anywhere within it."""


class Averaged:
    """The averaged Hamiltonian of a problem, with means by SciPy's adaptive rule."""

    def __init__(self, problem: Problem) -> None:
        self.n = len(problem.f)
        u, p = list(problem.control), list(sp.symbols("p0:2", real=True))[: self.n]
        f = [sp.sympify(text, NAMES) for text in problem.f]
        drift = [rate.subs(dict.fromkeys(u, 0)) for rate in f]
        effect = [[sp.diff(rate, control) for control in u] for rate in f]
        loss = sp.sympify(problem.running_cost, NAMES)
        pushed = [sp.Add(*(p[i] * effect[i][j] for i in range(self.n))) for j in range(len(u))]
        inner = sp.Add(*(p[i] * f[i] for i in range(self.n))) - loss
        at = [*problem.slow, *p, PHASE]
        weight = sp.sympify(problem.weight, NAMES)
        self._push = sp.lambdify(at, pushed, "math")
        slopes = [sp.diff(inner, a) for a in problem.slow]
        self._rest = sp.lambdify([*at, *u], [inner, *f, *slopes, weight, *drift], "math")
        self._set, self._sizes = problem.control_set, np.array(problem.sizes)

    def control(self, s: Array) -> tuple[Array, float]:
        """The control that attains the maximum of s'u - cost, and its cost."""
        if self._set == "Box":
            return self._sizes * np.sign(s), 0.0
        if self._set in ("Ball", "Ellipsoid"):
            scaled = self._sizes * s
            size = float(np.linalg.norm(scaled))
            return (self._sizes * scaled / size if size else 0 * s), 0.0
        price = self._sizes[0] if self._set == "Quadratic" else 1.0
        u = s / (2 * price)
        size = float(np.linalg.norm(u))
        if self._set == "BoundedQuadratic" and size > self._sizes[0]:
            u = u * (self._sizes[0] / size)
        return u, price * float(u @ u)

    def means(self, z: Array) -> Array:
        """Means over a turn: the Hamiltonian, the rates, its slopes in the slow variables, the cost."""

        def integrand(x: float) -> Array:
            u, cost = self.control(np.array(self._push(*z, x)))
            inner, *rest = self._rest(*z, x, *u)
            rates, slopes, weight = rest[: self.n], rest[self.n : 2 * self.n], rest[2 * self.n]
            push = float(np.dot(z[self.n :], rates))
            return weight * np.array([inner - cost, *rates, *slopes, push - inner + cost])

        edges = np.linspace(0, 2 * np.pi, KINKS + 1)
        found, _ = quad_vec(
            integrand, 0, 2 * np.pi, epsabs=1e-10, epsrel=1e-10, points=edges[1:-1], limit=2000
        )
        return np.asarray(found) / (2 * np.pi)


def disagreement(problem: Problem, solution: Any) -> float:
    """How far a solution is from an averaged extremal, relative to its size."""
    model, n, duration = Averaged(problem), len(problem.f), float(solution.duration)
    ends = np.concatenate([solution.slow([0.0, duration]), solution.costate([0.0, duration])], axis=-1)
    first, last = ends
    size = np.maximum(1.0, np.abs(ends).max(axis=0))

    def rate(_: float, z: Array) -> Array:
        found = model.means(z[: 2 * n])
        return np.concatenate([found[1 : n + 1], -found[n + 1 : 2 * n + 1], found[-1:]])

    begin = np.append(first, 0.0)
    flown = solve_ivp(rate, (0, duration), begin, method="DOP853", rtol=1e-9, atol=1e-10).y[:, -1]
    a = dict(zip(problem.slow, last[:n], strict=True))
    conditions = [sp.sympify(text, NAMES) for text in problem.target]
    terminal = sp.sympify(problem.terminal_cost, NAMES)
    normals = np.array([[float(sp.diff(c, s).subs(a)) for s in problem.slow] for c in conditions])
    price = np.array([float(sp.diff(terminal, s).subs(a)) for s in problem.slow])
    beside = last[n:] + price
    left = beside - normals.T @ np.linalg.lstsq(normals.T, beside, rcond=None)[0]
    parts: list[Any] = [
        (flown[: 2 * n] - last) / size,
        first[:n] - np.array(problem.start),
        [float(c.subs(a)) for c in conditions],
        left / size[n:],
        [model.means(first)[0], model.means(last)[0]],
        [(flown[-1] + float(terminal.subs(a)) - float(solution.cost)) / max(1.0, abs(float(solution.cost)))],
    ]
    return float(max(np.abs(part).max() for part in parts))


def chunk(rng: np.random.Generator, number: int) -> Found:
    """One system: it is compiled, solved and, if its turn has come, judged."""
    outcome, problem = Outcome(systems.line), systems.drawn(rng)
    outcome.problems, given = 1, asdict(problem)
    solution = attempted(outcome, lambda: solve_averaged(problem.system(), problem.start), given)
    if solution is None:
        return outcome.found()
    suspicious = outcome.certified(solution.certificate, [given])
    if suspicious or number % EVERY == 0:
        found = attempted(outcome, lambda: disagreement(problem, solution), given)
        if found is not None:
            outcome.judged(found, given, ALLOWED, "SciPy")
    return outcome.found()


def attempted(outcome: Outcome, call: Callable[[], Any], given: Any) -> Any:
    """What a call returns; None if it raises, which is kept."""
    try:
        return call()
    except Exception as error:  # whatever is raised is what is looked for
        outcome.raised(error, given)
        return None


def parts() -> list[Part]:
    """The row of the table."""
    return [Part("averaged", [__name__], WANTED, chunk, share=4.0)]
