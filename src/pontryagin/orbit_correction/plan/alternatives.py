"""Other plans of the same length: an interior state has many, of least peak, least energy and least fuel.

Each is a convex problem whose dual has three variables, the costate. With |.|* the conjugate of a step's
cost over its set of impulses, (b, psi) - sum |G_k'psi|* is a bound from below for every psi.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.certificate import Certificate
from pontryagin.errors import NotConverged
from pontryagin.orbit_correction.gauges.columns import Columns, mixture, whitened
from pontryagin.orbit_correction.plan.correction import Plan, single

ITERATIONS = 200
CLOSED = 1e-10
"""Gap, relative to the value, at which an iteration ends."""


@dataclass(frozen=True, eq=False)
class Alternative:
    """A plan with the impulses of another, spread to make another measure least.

    Peak, energy and fuel are in units of the bound on impulses, alpha_max.

    Attributes
    ----------
    plan : Plan
        The plan whose length it keeps.
    least : str
        "peak", "energy" or "fuel".
    step_controls : (N, components) array
        Impulse components of each step, orbital speeds.
    certificate : Certificate
        What remains of the state, relative to it; the measure; the bound that a costate proves.
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
        """Gauge of the largest step in the set of impulses."""
        return float(_sizes(self.plan, self._relative).max(initial=0.0))

    @property
    def energy(self) -> float:
        """Sum of the squares of the impulses."""
        return float((self._relative**2).sum())

    @property
    def fuel(self) -> float:
        """Sum of the impulses: of their lengths for the engine that turns, else of both components."""
        return _fuel(self.plan, self._relative)

    @property
    def _relative(self) -> Array:
        return self.step_controls / self.plan.thrust.peak


def least_peak(plan: Plan) -> Alternative:
    """The plan itself: scaled by 1/alpha, no step could stay in its set.

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
    """The plan of least sum of squares within the set of impulses.

    Where no bound is met it is the closed form G' (sum G G')^-1 b; else Newton's method on the dual, whose
    controls are the projections of G_k'psi on the set.

    Parameters
    ----------
    plan : Plan
        Of one state.

    Raises
    ------
    ValueError
        If the plan is that of a stack.
    pontryagin.NotConverged
        If the bounds do not meet.

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
    """The plan of least sum of impulses within the set: a linear or cone programme.

    Columns are generated: HiGHS mixes impulses on the sets' boundaries, and its multipliers name, for each
    step, the impulse that would help most. The mixture is a plan, the multipliers a bound.

    Parameters
    ----------
    plan : Plan
        Of one state.

    Raises
    ------
    ValueError
        If the plan is that of a stack.
    pontryagin.NotConverged
        If the bounds do not meet: for the ball, where the gauge is within 1e-8 of 1 and hardly more than
        one plan exists.

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
    outward = plan.thrust.peak * max(float(plan.gauge), 1e-300)
    start = plan.step_controls.reshape(len(factors), factors.shape[2]) / outward
    controls, value = _generate(factors, target, start, plan.thrust.name == "disc")
    controls = controls.reshape(shape)
    return _alternative(plan, "fuel", controls, _fuel(plan, controls), value)


def _alternative(plan: Plan, least: str, controls: NDArray, value: float, bound: float) -> Alternative:
    residual = plan.thrust.miss(plan.z0[None], plan.steps[None], controls[None])[0]
    certificate = Certificate(np.array(residual), np.array(value), np.array(bound))
    return Alternative(plan, least, plan.thrust.peak * controls, certificate)


def _whitened(plan: Plan) -> tuple[NDArray, NDArray]:
    """G_k and b = -z0, whitened."""
    if not int(single(plan).steps):
        return np.zeros((0, 3, plan.step_controls.shape[-1])), np.zeros(3)
    return whitened(plan.thrust.factors(int(plan.steps)), -plan.z0)


def _sizes(plan: Plan, controls: NDArray) -> Array:
    return np.abs(controls) if plan.thrust.name == "box" else np.linalg.norm(controls, axis=1)


def _fuel(plan: Plan, controls: NDArray) -> float:
    measure = _length if plan.thrust.name == "disc" else _total
    return float(measure(controls).sum())


def _least_energy(factors: NDArray, target: NDArray, square: bool) -> tuple[NDArray, float]:
    project = _onto_box if square else _onto_balls
    psi = target.copy()
    for _ in range(ITERATIONS):
        along = np.einsum("kij,i->kj", factors, psi)
        controls, slopes = project(along)
        value = _energy_bound(psi, along, controls, target)
        miss = target - np.einsum("kij,kj->i", factors, controls)
        if np.abs(miss).max() <= 1e-14 * max(1.0, np.abs(target).max()):
            return controls, value
        curvature = np.einsum("kij,kjl,kml->im", factors, slopes, factors)
        step = np.linalg.solve(curvature + 1e-14 * np.eye(3), miss)
        length = 1.0
        while length > 1e-12:
            trial = psi + length * step
            pushed = np.einsum("kij,i->kj", factors, trial)
            gain = _energy_bound(trial, pushed, project(pushed)[0], target) - value
            if gain >= -1e-13 * abs(value):
                break
            length *= 0.5
        psi = trial
    if np.abs(miss).max() > 1e-10:
        raise NotConverged("the least energy within the bounds was not found", float(np.abs(miss).max()))
    return controls, value


def _energy_bound(psi: NDArray, along: NDArray, controls: NDArray, target: NDArray) -> float:
    """What psi proves: 2 (b, psi) - sum of max over the set of 2 (G_k'psi, u) - |u|^2."""
    return float(2 * (target @ psi) - (2 * along * controls - controls**2).sum())


def _onto_box(along: NDArray) -> tuple[NDArray, NDArray]:
    inside = (np.abs(along) <= 1).astype(float)
    return np.clip(along, -1, 1), inside[:, :, None] * np.eye(along.shape[1])


def _onto_balls(along: NDArray) -> tuple[NDArray, NDArray]:
    size = np.maximum(np.linalg.norm(along, axis=1), 1.0)[:, None]
    unit = along / size
    outward = np.where(size[:, :, None] > 1, unit[:, :, None] * unit[:, None, :], 0.0)
    return unit, (np.eye(along.shape[1]) - outward) / size[:, :, None]


def _generate(factors: NDArray, target: NDArray, start: NDArray, turning: bool) -> tuple[NDArray, float]:
    """Least sum of fuel by generated columns: controls (N, m) and the best bound."""
    steps, width = start.shape
    if not steps:
        return start, 0.0
    offer, cost = (_longest, _length) if turning else (_beyond, _total)
    axes = np.tile(np.concatenate([np.eye(width), -np.eye(width)]), (steps, 1))
    columns = Columns(np.arange(steps), start, cost(start))
    columns = columns.joined(np.repeat(np.arange(steps), 2 * width), axes, cost(axes))
    bound = -np.inf
    for _ in range(ITERATIONS):
        value, psi, controls = mixture(factors, target, columns, shared=False)
        offered, gains = offer(np.einsum("kij,i->kj", factors, psi))
        bound = max(bound, float(target @ psi - gains.sum()))
        if value - bound <= CLOSED * max(1.0, value):
            return controls, bound
        new = np.flatnonzero(gains > 0)
        columns = columns.joined(new, offered[new], cost(offered[new]))
    raise NotConverged("the least fuel was not found", value - bound)


def _length(points: NDArray) -> Array:
    return np.asarray(np.linalg.norm(points, axis=1))


def _total(points: NDArray) -> Array:
    return np.asarray(np.abs(points).sum(axis=1))


def _longest(along: NDArray) -> tuple[NDArray, NDArray]:
    """The impulse u of the unit disc with the most (v, u) - |u|, and how much that is."""
    unit, size = _directions(along)
    return unit, np.maximum(size - 1, 0.0)


def _beyond(along: NDArray) -> tuple[NDArray, NDArray]:
    """The same for the unit ball with the sum of the components for fuel."""
    return _directions(np.sign(along) * np.maximum(np.abs(along) - 1, 0.0))


def _directions(along: NDArray) -> tuple[NDArray, NDArray]:
    size = np.linalg.norm(along, axis=1)
    return along / np.maximum(size, 1e-300)[:, None], size
