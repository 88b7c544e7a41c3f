"""The paper's worked example and certificates of its plans, computed with the derived matrices."""

import functools
from collections.abc import Callable

import numpy as np
import sympy as sp
from scipy.optimize import linprog

from pontryagin.arrays import Array
from pontryagin.ledger import Unsupported
from pontryagin.ledger.evidence import Steps
from pontryagin.orbit_correction import derivation, printed
from pontryagin.orbit_correction.gauges.general import Gauge, gauge_of_factors
from pontryagin.orbit_correction.plan.correction import Plan, correct

Z0, INTERVAL, PEAK = np.array(printed.Z0), float(printed.INTERVAL), float(printed.PEAK)
EXACT = {derivation.interval: sp.Rational(printed.INTERVAL)}
SPARSE = (0, 2, 3, 5)
"""Four of the first six intervals: impulses at their starts alone suffice."""

ROUNDING = 1e-12
"""Values of alpha that differ by at most this differ by rounding only."""

Inputs = Callable[[int], sp.Matrix]
"""B(k) as a function of k."""


def numbers(matrix: sp.Matrix) -> Array:
    """A derived matrix with the numbers of the example's interval."""
    return np.array(sp.Matrix(matrix).subs(EXACT).evalf(20).tolist(), dtype=float)


@functools.cache
def step_matrix(k: int) -> Array:
    """A(k) in numbers."""
    return numbers(derivation.step_matrix(k % 2))


@functools.cache
def step_inputs(k: int) -> Array:
    """B(k) in numbers."""
    return numbers(derivation.step_inputs(k % 2))


def interval_matrix() -> Array:
    """A~ in numbers."""
    return step_matrix(1)


@functools.cache
def columns(j: int) -> Array:
    """The effects on the initial state of the two impulse components at the start of interval j, (3, 2)."""
    return numbers(sp.Matrix(derivation.transition(-j * derivation.interval)))[:, 1:]


def ball_plan() -> Plan:
    """The plan of Theorem 4 for the worked example."""
    return correct(Z0, INTERVAL, PEAK, "ball")


def box_plan() -> Plan:
    """The plan with the fewest impulses in the square, the paper's own constraint."""
    return correct(Z0, INTERVAL, PEAK, "box")


def factors(steps: int, inputs: Inputs = derivation.step_inputs, shift: int = 0) -> Array:
    """G_k = (A(k) ... A(0))^-1 B(k + shift) alpha_max for k < steps."""
    back, result = np.eye(3), []
    for k in range(steps):
        back = back @ np.linalg.inv(step_matrix(k))
        result.append(PEAK * back @ numbers(inputs((k + shift) % 2)))
    return np.array(result)


def gauge_with(steps: int, inputs: Inputs = derivation.step_inputs, shift: int = 0, z0: Array = Z0) -> Gauge:
    """alpha(steps) of z0 and its costate for given B(k); its lower and upper bound agree."""
    found = gauge_of_factors(factors(steps, inputs, shift), z0)
    if not found.certificate.holds(1e-9):
        raise Unsupported(f"the bounds on the gauge differ by {found.certificate.gap}")
    return found


def bound(G: Array, psi: Array) -> float:
    """The lower bound (-z0, psi) / sum |G_k'psi| on alpha that psi proves."""
    return float(-Z0 @ psi / np.linalg.norm(np.einsum("kij,i->kj", G, psi), axis=1).sum())


def ball_certificate() -> Steps:
    """Four steps suffice with the plan's share of the peak and with no smaller one; three do not suffice."""
    plan = ball_plan()
    alpha, state = float(plan.gauge), Z0
    for k, control in enumerate(plan.step_controls):
        state = step_matrix(k) @ state + step_inputs(k) @ control
    sizes = np.linalg.norm(plan.step_controls, axis=1)
    yield "four steps, flown one by one, bring z0 to 0", bool(np.abs(state).max() < 1e-16) and len(sizes) == 4
    yield f"with |ũ(k)| at most {alpha:.5f} α_max", bool(sizes.max() <= alpha * PEAK * (1 + ROUNDING))
    proved = bound(factors(4), plan.initial_costate)
    yield "ψ0 proves that no smaller share does", alpha - ROUNDING <= proved <= alpha + ROUNDING
    shorter = bound(factors(3), gauge_with(3).costate)
    yield f"three steps would need {shorter:.3f} α_max", shorter > 1.26


def impulses_to_rest(impulses: dict[int, Array]) -> float:
    """The largest component left of z0 after the impulses at the starts of their intervals."""
    state = Z0
    for j in range(max(impulses) + 1):
        state = interval_matrix() @ (state + np.array([0.0, *impulses.get(j, np.zeros(2))]))
    return float(np.abs(state).max())


def box_certificate() -> Steps:
    """Five impulses in the square suffice and four in a row do not; the ball's four steps fire six."""
    plan = box_plan()
    left = impulses_to_rest(dict(enumerate(plan.impulses)))
    yield "five impulses bring z0 to 0", left < 1e-16 and len(plan.impulses) == 5
    share = np.abs(plan.impulses).max() / PEAK
    yield f"each within {share:.3f} of the square |w1|, |w2| ≤ α_max", share < 0.8
    four = np.stack([columns(j) for j in range(4)])
    psi = shortest_box_costate(four)
    proved = -Z0 @ psi / (PEAK * np.abs(np.einsum("kij,i->kj", four, psi)).sum())
    yield f"four in a row would need {proved:.3f} α_max", proved > 1.17
    yield "the ball's four steps fire six impulses", int(ball_plan().impulse_count) == 6


def shortest_box_costate(columns: Array) -> Array:
    """The psi with the largest bound for the square, by HiGHS: least sum |g.psi| with (-z0, psi) = 1."""
    g = np.moveaxis(columns, 1, 2).reshape(-1, 3)
    cost = np.concatenate([np.zeros(3), np.ones(len(g))])
    above = np.block([[g, -np.eye(len(g))], [-g, -np.eye(len(g))]])
    right = np.concatenate([-Z0, np.zeros(len(g))])[None]
    free = [(None, None)] * 3 + [(0, None)] * len(g)
    scaled = linprog(cost, A_ub=above, b_ub=np.zeros(len(above)), A_eq=100 * right, b_eq=[1.0], bounds=free)
    if scaled.x is None:
        raise Unsupported(f"HiGHS found no costate: {scaled.message}")
    return np.asarray(scaled.x[:3])


def sparse_impulses() -> dict[int, Array]:
    """Impulses of least peak at the starts of the intervals `SPARSE`, by HiGHS."""
    g = PEAK * np.hstack([columns(j) for j in SPARSE])
    count = g.shape[1]
    above = np.block([[np.eye(count), -np.ones((count, 1))], [-np.eye(count), -np.ones((count, 1))]])
    answer = linprog(
        np.append(np.zeros(count), 1.0),
        A_ub=above,
        b_ub=np.zeros(2 * count),
        A_eq=100 * np.hstack([g, np.zeros((3, 1))]),
        b_eq=-100 * Z0,
        bounds=[(None, None)] * count + [(0, None)],
    )
    if answer.x is None:
        raise Unsupported(f"HiGHS found no impulses: {answer.message}")
    w = np.asarray(answer.x[:count])
    w += np.linalg.pinv(g) @ (-Z0 - g @ w)
    return dict(zip(SPARSE, PEAK * w.reshape(-1, 2), strict=True))
