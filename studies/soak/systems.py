"""Random systems: trigonometric polynomials in the phase, rational in the slow variables.

All coefficients are multiples of 1/16, so that their texts are exact.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy as sp

from pontryagin.averaging import Ball, BoundedQuadratic, Box, Ellipsoid, PhaseSystem, Quadratic

SLOW, CONTROL, PHASE = sp.symbols("a b", real=True), sp.symbols("u v", real=True), sp.Symbol("x", real=True)
SETS = {
    "Quadratic": Quadratic,
    "Ball": Ball,
    "Ellipsoid": Ellipsoid,
    "Box": Box,
    "BoundedQuadratic": BoundedQuadratic,
}
GRID = 16


@dataclass(frozen=True)
class Problem:
    """A problem as texts and numbers.

    Attributes
    ----------
    f, target : tuple of str
        Rates, affine in the controls; conditions at the end.
    weight, running_cost, terminal_cost, omega : str
        The others of `PhaseSystem`.
    control_set : str
        Of `SETS`.
    sizes : tuple of float
        Its arguments.
    start : tuple of float
        Slow variables at the start.
    """

    f: tuple[str, ...]
    target: tuple[str, ...]
    omega: str
    weight: str
    running_cost: str
    terminal_cost: str
    control_set: str
    sizes: tuple[float, ...]
    start: tuple[float, ...]

    @property
    def slow(self) -> tuple[sp.Symbol, ...]:
        """The slow variables."""
        return SLOW[: len(self.f)]

    @property
    def control(self) -> tuple[sp.Symbol, ...]:
        """The controls that occur."""
        return tuple(u for u in CONTROL if any(u in sp.sympify(f, NAMES).free_symbols for f in self.f))

    def system(self) -> PhaseSystem:
        """The system, made of the texts."""
        made = SETS[self.control_set]
        sizes = [list(self.sizes)] if self.control_set in ("Ellipsoid", "Box") else list(self.sizes)
        return PhaseSystem(
            f=[sp.sympify(text, NAMES) for text in self.f],
            omega=sp.sympify(self.omega, NAMES),
            control_set=made(*sizes),
            slow=list(self.slow),
            control=list(self.control),
            phase=PHASE,
            target=[sp.sympify(text, NAMES) for text in self.target],
            running_cost=sp.sympify(self.running_cost, NAMES),
            terminal_cost=sp.sympify(self.terminal_cost, NAMES),
            weight=sp.sympify(self.weight, NAMES),
        )


NAMES = {str(symbol): symbol for symbol in (*SLOW, *CONTROL, PHASE)}


def line(problem: Any) -> str:
    """A line of Python that solves a problem, from its fields."""
    sizes = list(problem["sizes"])
    inside = str(sizes) if problem["control_set"] in ("Ellipsoid", "Box") else ", ".join(map(str, sizes))
    n = len(problem["f"])
    controls = [u for u in ("u", "v") if any(u in text for text in problem["f"])]

    def each(texts: Any) -> str:
        return "[" + ", ".join(f'S("{text}")' for text in texts) + "]"

    return (
        'import sympy as sp; a, b, u, v, x = sp.symbols("a b u v x", real=True); '
        "S = lambda text: sp.sympify(text, dict(a=a, b=b, u=u, v=v, x=x)); "
        f"from pontryagin.averaging import PhaseSystem, solve_averaged, {problem['control_set']}; "
        f'system = PhaseSystem(f={each(problem["f"])}, omega=S("{problem["omega"]}"), '
        f"control_set={problem['control_set']}({inside}), slow=[{', '.join('ab'[:n])}], "
        f"control=[{', '.join(controls)}], phase=x, target={each(problem['target'])}, "
        f'running_cost=S("{problem["running_cost"]}"), terminal_cost=S("{problem["terminal_cost"]}"), '
        f'weight=S("{problem["weight"]}")); s = solve_averaged(system, {list(problem["start"])}); '
        "print(s.cost, s.certificate)"
    )


def coefficient(rng: np.random.Generator, largest: float) -> sp.Rational:
    """A multiple of 1/16 of at most this size."""
    return sp.Rational(int(rng.integers(-int(largest * GRID), int(largest * GRID) + 1)), GRID)


def rational(rng: np.random.Generator, n: int, largest: float) -> sp.Expr:
    """A rational function of the slow variables without poles."""
    a = SLOW[int(rng.integers(n))]
    below = 1 + sp.Rational(int(rng.integers(1, GRID + 1)), GRID) * a**2
    kinds = (1, a / below, 1 / below)
    return coefficient(rng, largest) * kinds[int(rng.integers(3))]


def trigonometric(rng: np.random.Generator, n: int, largest: float, terms: int) -> sp.Expr:
    """A trigonometric polynomial of degree up to 3 in the phase, with such coefficients."""
    found = sp.Integer(0)
    for _ in range(terms):
        wave = sp.cos if rng.random() < 0.5 else sp.sin
        found += rational(rng, n, largest) * wave(int(rng.integers(0, 4)) * PHASE)
    return found


def drawn(rng: np.random.Generator) -> Problem:
    """A random problem: one or two slow variables and controls, any control set, weak drift."""
    n, m = int(rng.integers(1, 3)), int(rng.integers(1, 3))
    f = []
    for i in range(n):
        rate = trigonometric(rng, n, 1 / 8, int(rng.integers(0, 3)))
        for j in range(m):
            lead = 1 if i == j or m == 1 else int(rng.integers(0, 2))
            wave = (sp.cos, sp.sin)[(i + j) % 2](int(rng.integers(1, 3)) * PHASE)
            steady = sp.Rational(int(rng.integers(8, 24)), GRID) * wave
            rate += (lead * steady + trigonometric(rng, n, 1 / 4, int(rng.integers(0, 3)))) * CONTROL[j]
        f.append(rate)
    used = [u for u in CONTROL[:m] if any(u in rate.free_symbols for rate in f)]
    kind = [*SETS][int(rng.integers(len(SETS)))]
    sizes = tuple(
        int(rng.integers(8, 33)) / GRID for _ in range(len(used) if kind in ("Ellipsoid", "Box") else 1)
    )
    start = tuple(int(rng.integers(-32, 33)) / GRID for _ in range(n))
    far = [int(rng.choice([-1, 1])) * int(rng.integers(2, 25)) / GRID for _ in range(n)]
    conditions = n if rng.random() < 0.6 else 1
    target = [SLOW[i] - sp.Rational(str(start[i] + far[i])) for i in range(conditions)]
    slow = SLOW[int(rng.integers(n))]
    ripple = sp.Rational(int(rng.integers(0, 13)), GRID) * sp.cos(int(rng.integers(1, 3)) * PHASE)
    return Problem(
        tuple(map(str, f)),
        tuple(map(str, target)),
        str(1 + sp.Rational(int(rng.integers(0, 17)), GRID) / (1 + slow**2)),
        str(1 + ripple if rng.random() < 0.3 else sp.Integer(1)),
        str(1 + (rational(rng, n, 1) * sp.cos(PHASE)) ** 2 if rng.random() < 0.4 else sp.Integer(1)),
        str(rational(rng, n, 1 / 4) if rng.random() < 0.2 else sp.Integer(0)),
        kind,
        sizes,
        start,
    )
