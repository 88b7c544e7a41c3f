"""The rippled smooth example in numbers: every extremal of the unaveraged problem, found in two ways.

v' = eps (u + cos(x)/2), x' = v, b' = eps (1 + u^2); v rises from 1 to 2, x(0) = 0, b(t1) is to be least. With
H = 0 and v as the independent variable the family (2.1) is obtained by integration alone: each initial
costate p gives one member, and the members with q(t1) = 0 are the extremals. The extremals that the solver
finds are integrated again with SciPy, and their number is compared with the sign changes of h*.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
import sympy as sp
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp

from pontryagin.arrays import Array
from pontryagin.averaging import smooth_example
from pontryagin.averaging.derivation import ripple, smooth

START, END, PAY, RIPPLE = 1.0, 2.0, 1.0, 0.5
EPSILONS = (0.1, 0.05, 0.02)
NUMBERS = {smooth.v0: 1, smooth.v1: 2, smooth.k: 1, ripple.rise: 1, ripple.c: sp.Rational(1, 2)}
LOW, HIGH = 1.6, 2.8
"""Range of initial costates that covers the window of kappa and in which v rises all the way."""

FINE, RESIDUAL = 1e-11, 1e-8
"""Tolerance of the integration, and the largest |h*| at the end that is accepted at a root."""


@dataclass(frozen=True)
class Members:
    """Members of the family: initial costates (n,), and x, p, b, tau and h* at the end, each (n,)."""

    start: Array
    phase: Array
    costate: Array
    cost: Array
    duration: Array
    level: Array

    @property
    def phase_costate(self) -> Array:
        """q(t1) per epsilon, which H = 0 makes -h*/v."""
        return -self.level / END


def level(x: Array, p: Array) -> Array:
    """h* at q = 0: the maximum over u of p (u + cos(x)/2) - 1 - u^2."""
    return p**2 / 4 + RIPPLE * p * np.cos(x) - PAY


def _motion(start: Array, epsilon: float, tolerance: float, at: Array | None = None) -> Array:
    """x, p, b, tau of the members at speeds `at` (or at the end): (4, n, k)."""
    n = start.size

    def rates(v: float, y: Array) -> Array:
        x, p, _, _ = y.reshape(4, n)
        force = p / 2 + RIPPLE * np.cos(x)
        return np.concatenate(
            [v / (epsilon * force), level(x, p) / (v * force), (PAY + p**2 / 4) / force, 1 / force]
        )

    begin = np.concatenate([np.zeros(n), start, np.zeros(2 * n)])
    done = solve_ivp(
        rates, (START, END), begin, "DOP853", t_eval=at, rtol=tolerance, atol=tolerance
    )  # fmt: skip
    if not done.success:
        raise ArithmeticError(done.message)
    return done.y.reshape(4, n, -1)


def members(start: ArrayLike, epsilon: float, tolerance: float = FINE) -> Members:
    """Members of the family with given initial costates (n,)."""
    begin = np.atleast_1d(np.asarray(start, dtype=float))
    x, p, b, tau = _motion(begin, epsilon, tolerance)[..., -1]
    return Members(begin, x, p, b, tau, level(x, p))


@cache
def family(epsilon: float) -> Members:
    """Members across the whole window, several for each half turn of the phase at the end."""
    return members(np.linspace(LOW, HIGH, int(2 / epsilon) + 20), epsilon, 1e-8)


@cache
def roots(epsilon: float) -> Members:
    """All extremals in the order of their final phase: found by the solver, integrated again here.

    Raises ArithmeticError unless h* is 0 at the end of each, and `family` has as many sign changes of h* as
    there are extremals.
    """
    found = smooth_example(START, END, k=PAY, ripple=RIPPLE).exact(epsilon, 0.0)
    start = np.array([float(one.costate(np.zeros(1))[0, 0]) for one in found])
    flown = members(start, epsilon)
    signs = np.sign(family(epsilon).level)
    if np.abs(flown.level).max() > RESIDUAL or (signs[1:] != signs[:-1]).sum() != start.size:
        raise ArithmeticError(f"epsilon = {epsilon}: {start.size} extremals do not stand up to a second look")
    order = np.argsort(flown.phase)
    return Members(*(getattr(flown, name)[order] for name in Members.__dataclass_fields__))


def best(epsilon: float) -> int:
    """Index of the root that costs least."""
    return int(roots(epsilon).cost.argmin())


@cache
def optimum(epsilon: float, samples: int = 4001) -> dict[str, Array]:
    """The optimal motion at equidistant speeds: v, x, p, b, tau (samples,)."""
    v = np.linspace(START, END, samples)
    start = roots(epsilon).start[[best(epsilon)]]
    x, p, b, tau = _motion(start, epsilon, FINE, v)[:, 0]
    return {"v": v, "x": x, "p": p, "b": b, "tau": tau}


def averaged(form: sp.Expr, kappa: ArrayLike) -> Array:
    """Values at kappa of a closed form of `ripple` (a function of A0 and A1)."""
    function = sp.lambdify(smooth.kappa, ripple.of_kappa(form).subs(NUMBERS))
    return np.asarray(function(np.asarray(kappa, dtype=float)))


@cache
def window() -> tuple[float, float]:
    """The ends kappa' and kappa'' of the window."""
    low, high = (float(end.subs(NUMBERS)) for end in ripple.window())
    return low, high


def predicted_roots(epsilon: float) -> float:
    """Predicted number of roots, (Psi(kappa'') - Psi(kappa'))/(pi epsilon)."""
    return float(ripple.roots_in_the_window().subs(NUMBERS)) / epsilon


def kappa_of(duration: ArrayLike) -> Array:
    """kappa of the averaged member with a given duration: tau_1(kappa) increases, and a table inverts it."""
    low, high = window()
    kappa = np.linspace(2 * low, (high + PAY / END) / 2, 20001)
    return np.asarray(np.interp(np.asarray(duration), averaged(ripple.duration(), kappa), kappa))


def in_window(epsilon: float) -> Members:
    """Members of `family` whose averaged kappa lies in the window."""
    scan = family(epsilon)
    kappa = kappa_of(scan.duration)
    inside = (window()[0] < kappa) & (kappa < window()[1])
    return Members(*(getattr(scan, name)[inside] for name in Members.__dataclass_fields__))


def deviations(epsilon: float) -> dict[str, float]:
    """Largest differences at the end between members in the window and averaged members of equal duration."""
    scan = in_window(epsilon)
    kappa = kappa_of(scan.duration)
    expected = {
        "phase": averaged(ripple.turned(), kappa) / epsilon,
        "costate": averaged(2 * ripple.A1, kappa),
        "cost": averaged(ripple.cost(), kappa),
    }
    return {name: float(np.abs(getattr(scan, name) - value).max()) for name, value in expected.items()}
