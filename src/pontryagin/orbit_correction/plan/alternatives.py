"""Plans with the fewest steps and, among those, the least peak, the least energy or the least fuel.

A state inside X(N_min, 0), the case (5), has many plans of N_min steps. Each of the three problems is convex,
and its dual has three variables, the costate psi. With f* the conjugate of a step's cost over its set of
impulses, (b, psi) - sum f*(G_k'psi) is a lower bound for every psi.
"""

from dataclasses import dataclass
from math import ceil, log2

import numpy as np

from pontryagin.arrays import Array
from pontryagin.certificate import Certificate
from pontryagin.errors import NotConverged
from pontryagin.orbit_correction.gauges.columns import Columns, mixture, whitened
from pontryagin.orbit_correction.plan.correction import Plan, single
from pontryagin.value import value_class

ITERATIONS = 200
"""Largest number of iterations of Newton's method, and of rounds of column generation."""

CLOSED = 1e-10
"""Iterations end when the gap, relative to the value, is at most this."""


@value_class
@dataclass(frozen=True, eq=False)
class Alternative:
    """A plan with the same number of steps as a given one, and the least value of another measure.

    Peak, energy and fuel are in units of the bound on impulses, alpha_max.

    Attributes
    ----------
    plan : Plan
        The given plan.
    least : str
        "peak", "energy" or "fuel".
    step_controls : (N, components) array
        Impulse components of each step, orbital speeds.
    certificate : Certificate
        The residual is what remains of the state at the end, relative to z0; the value is that of the
        measure; the bound is the one that a costate proves.
    """

    plan: Plan
    least: str
    step_controls: Array
    certificate: Certificate

    @property
    def impulses(self) -> Array:
        """Radial and transverse impulse at the start of each interval, (M, 2)."""
        flat = self.step_controls.ravel()
        return np.append(flat, np.zeros(flat.size % 2)).reshape(-1, 2)

    @property
    def peak(self) -> float:
        """The largest gauge of a step in the set of impulses."""
        return float(_sizes(self.plan, self._relative).max(initial=0.0))

    @property
    def energy(self) -> float:
        """Sum of the squares of the impulses."""
        return float((self._relative**2).sum())

    @property
    def fuel(self) -> float:
        """Sum of the lengths of the impulses for the disc, else sum of the moduli of all components."""
        return _fuel(self.plan, self._relative)

    @property
    def _relative(self) -> Array:
        return self.step_controls / self.plan.thrust.peak


def least_peak(plan: Plan) -> Alternative:
    """The given plan itself: by the definition of the gauge no plan of its length has a smaller peak.

    Parameters
    ----------
    plan : Plan
        Of one state.

    Raises
    ------
    ValueError
        If the plan is that of a stack.
    """
    return Alternative(single(plan), "peak", plan.step_controls, plan.certificate)


def least_energy(plan: Plan) -> Alternative:
    """The plan with the least sum of squares of admissible impulses.

    If no bound is active, the plan is the closed form G' (sum G G')^-1 b. Otherwise Newton's method solves
    the dual; the controls are the projections of G_k'psi on the set.

    Parameters
    ----------
    plan : Plan
        Of one state.

    Raises
    ------
    ValueError
        If the plan is that of a stack.
    pontryagin.NotConverged
        If the upper and the lower bound on the energy do not meet.

    Examples
    --------
    >>> from pontryagin.orbit_correction.plan.correction import correct
    >>> plan = correct([-0.0037787, -0.0039109, 0.0141512])
    >>> f"{least_energy(plan).energy:.4f} {least_peak(plan).energy:.4f}"
    '3.3991 3.4490'
    """
    factors, target = _whitened(plan)
    controls, value = _least_energy(factors, target, plan.thrust.name == "box")
    return _alternative(plan, "energy", controls, float((controls**2).sum()), value)


def least_fuel(plan: Plan) -> Alternative:
    """The plan with the least sum of admissible impulses, by a linear or a cone programme.

    The method is column generation. HiGHS finds the best mixture of given impulses. From its multipliers
    follows for each step the impulse that, added to the mixture, lowers the fuel most. The mixture is a plan,
    and the multipliers prove a bound.

    Parameters
    ----------
    plan : Plan
        Of one state.

    Raises
    ------
    ValueError
        If the plan is that of a stack.
    pontryagin.NotConverged
        If the gap between the bounds does not close. This happens for the ball if the gauge is within 1e-8 of
        1, so that hardly more than one plan exists.

    Examples
    --------
    >>> from pontryagin.orbit_correction.plan.correction import correct
    >>> plan = correct([-0.0037787, -0.0039109, 0.0141512], thrust="disc")
    >>> least_fuel(plan).fuel < least_peak(plan).fuel
    True
    """
    factors, target = _whitened(plan)
    shape = (len(factors), factors.shape[2])
    if plan.thrust.name == "box":
        factors = np.moveaxis(factors, 1, 2).reshape(-1, 3, 1)
    gauge = max(float(plan.gauge), 1e-300)
    scale = 2.0 ** ceil(log2(gauge))
    start = plan.step_controls.reshape(len(factors), factors.shape[2]) / (gauge * plan.thrust.peak)
    controls, bound = _generate(factors, target / scale, start, 1 / scale, plan.thrust.name == "disc")
    controls = controls.reshape(shape)
    return _alternative(plan, "fuel", scale * controls, scale * _fuel(plan, controls), scale * bound)


def _alternative(plan: Plan, least: str, controls: Array, value: float, bound: float) -> Alternative:
    residual = plan.thrust.miss(plan.z0[None], plan.steps[None], controls[None])[0]
    certificate = Certificate(np.array(residual), np.array(value), np.array(bound))
    return Alternative(plan, least, plan.thrust.peak * controls, certificate)


def _whitened(plan: Plan) -> tuple[Array, Array]:
    """G_k and b = -z0 in the coordinates in which the sum of G_k G_k' is the identity."""
    if not int(single(plan).steps):
        return np.zeros((0, 3, plan.step_controls.shape[-1])), np.zeros(3)
    return whitened(plan.thrust.factors(int(plan.steps)), -plan.z0)


def _sizes(plan: Plan, controls: Array) -> Array:
    """The gauge of each control in the set of impulses; for the square the modulus of each component."""
    return np.abs(controls) if plan.thrust.name == "box" else np.linalg.norm(controls, axis=1)


def _fuel(plan: Plan, controls: Array) -> float:
    measure = _length if plan.thrust.name == "disc" else _total
    return float(measure(controls).sum())


def _least_energy(factors: Array, target: Array, square: bool) -> tuple[Array, float]:
    """Controls of least energy within the unit sets, and the bound that the costate proves."""
    project = _onto_box if square else _onto_balls

    def bound(psi: Array) -> tuple[float, Array, Array]:
        """2 (b, psi) - sum of max over u in the set of (2 (G_k'psi, u) - |u|^2), the u and their slopes."""
        along = np.einsum("kij,i->kj", factors, psi)
        controls, slopes = project(along)
        return float(2 * (target @ psi) - (2 * along * controls - controls**2).sum()), controls, slopes

    psi = target
    there = bound(psi)
    for _ in range(ITERATIONS):
        value, controls, slopes = there
        miss = target - np.einsum("kij,kj->i", factors, controls)
        if np.abs(miss).max() <= 1e-14 * max(1.0, np.abs(target).max()):
            return controls, value
        curvature = np.einsum("kij,kjl,kml->im", factors, slopes, factors)
        step = np.linalg.solve(curvature + 1e-14 * np.eye(3), miss)
        for halving in range(40):
            trial = psi + step / 2**halving
            there = bound(trial)
            if there[0] - value >= -1e-13 * abs(value):
                break
        psi = trial
    if np.abs(miss).max() > 1e-10:
        reason = f"the controls of least energy were not found in {ITERATIONS} iterations"
        raise NotConverged(reason, float(np.abs(miss).max()))
    return controls, value


def _onto_box(along: Array) -> tuple[Array, Array]:
    """The projections of vectors on the unit square, and the derivatives of the projections."""
    inside = (np.abs(along) <= 1).astype(float)
    return np.clip(along, -1, 1), inside[:, :, None] * np.eye(along.shape[1])


def _onto_balls(along: Array) -> tuple[Array, Array]:
    """The projections of vectors on the unit ball, and the derivatives of the projections."""
    size = np.maximum(np.linalg.norm(along, axis=1), 1.0)[:, None]
    unit = along / size
    outward = np.where(size[:, :, None] > 1, unit[:, :, None] * unit[:, None, :], 0.0)
    return unit, (np.eye(along.shape[1]) - outward) / size[:, :, None]


def _generate(factors: Array, target: Array, start: Array, room: float, turning: bool) -> tuple[Array, float]:
    """Controls (N, m) of sizes up to `room` with the least total fuel, and the best bound on it.

    psi proves the bound (b, psi) - room * sum of gains. Scaled down until no gain is left it proves (b, psi).
    """
    steps, width = start.shape
    if not steps:
        return start, 0.0
    offer, cost = (_longest, _length) if turning else (_beyond, _total)
    axes = np.tile(np.concatenate([np.eye(width), -np.eye(width)]), (steps, 1))
    columns = Columns(np.arange(steps), start, cost(start))
    columns = columns.joined(np.repeat(np.arange(steps), 2 * width), axes, cost(axes))
    bound = -np.inf
    for _ in range(ITERATIONS):
        value, psi, controls = mixture(factors, target, columns, room)
        offered, gains = offer(np.einsum("kij,i->kj", factors, psi))
        paired = float(target @ psi)
        bound = max(bound, paired - room * float(gains.sum()), paired / (1 + float(gains.max())))
        if value - bound <= CLOSED * value:
            return controls, bound
        new = np.flatnonzero(gains > 0)
        columns = columns.joined(new, offered[new], cost(offered[new]))
    raise NotConverged(f"the controls of least fuel were not found in {ITERATIONS} iterations", value - bound)


def _length(points: Array) -> Array:
    """The fuel of one engine that turns: the length of each impulse."""
    return np.asarray(np.linalg.norm(points, axis=1))


def _total(points: Array) -> Array:
    """The fuel of separate engines: for each impulse the sum of the moduli of its components."""
    return np.asarray(np.abs(points).sum(axis=1))


def _longest(along: Array) -> tuple[Array, Array]:
    """For each v the impulse u of the unit disc with the largest gain (v, u) - |u|, and this gain."""
    unit, size = _directions(along)
    return unit, np.maximum(size - 1, 0.0)


def _beyond(along: Array) -> tuple[Array, Array]:
    """For each v the u of the unit ball with the largest gain (v, u) - sum of |u_i|, and this gain."""
    return _directions(np.sign(along) * np.maximum(np.abs(along) - 1, 0.0))


def _directions(along: Array) -> tuple[Array, Array]:
    """Unit vectors along the given vectors, and the lengths of the given vectors."""
    size = np.linalg.norm(along, axis=1)
    return along / np.maximum(size, 1e-300)[:, None], size
