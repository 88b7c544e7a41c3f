"""Random problems of every convex solver, with the proved interval of each."""

from collections.abc import Callable, Mapping
from functools import partial

import numpy as np

from pontryagin import triple_integrator as ti
from pontryagin.orbit_correction import DiscreteSystem, correct, gauge
from pontryagin.orbit_correction.plan.thrust import THRUSTS
from studies.enclosures import gauges, norms
from studies.enclosures.ball import Enclosure
from studies.enclosures.least_time import time

Draw = Callable[[np.random.Generator], Enclosure | None]
"""Draws a problem, solves it and encloses the optimum; None where the balls decide nothing."""

EXPONENTS = (1.2, 1.5, 3.0, 10.0)


def maneuver(rng: np.random.Generator) -> ti.Maneuver:
    """Ends of size one, in a unit of angle and a unit of time of any size, under a constant force."""
    unit, angle = 10.0 ** rng.uniform(-3, 3), 10.0 ** rng.uniform(-6, 6)
    by_time = angle / unit ** np.arange(3)
    x0, xf = rng.standard_normal((2, 3)) * by_time
    force = float(rng.standard_normal() * by_time[2])
    return ti.Maneuver(x0, xf, unit * rng.uniform(0.3, 3.0), disturbance=force)


def one_signed(rng: np.random.Generator) -> ti.Maneuver:
    """Moments inside the moment cone."""
    mean, T, total = rng.uniform(0.2, 0.8), 10.0 ** rng.uniform(-3, 3), 10.0 ** rng.uniform(-3, 3)
    square = mean**2 + rng.uniform(0.1, 0.8) * (mean - mean**2)
    c = total * np.array([T * T * square / 2, T * mean, 1.0])
    return ti.Maneuver([0, 0, 0], c if rng.random() < 0.5 else -c, T)


def transfer(rng: np.random.Generator) -> Enclosure | None:
    """A transfer of least time."""
    m = maneuver(rng)
    peak = 10.0 ** rng.uniform(-2, 2) * float(np.abs(m.xf[2] - m.x0[2]) / m.duration)
    return time(ti.minimum_time(m.x0, m.xf, peak, m.disturbance))


def general(rng: np.random.Generator) -> Enclosure:
    """A nonstationary system in up to five dimensions, with ellipsoids whose axes differ by up to 100."""
    n, steps = int(rng.integers(1, 6)), int(rng.integers(1, 9))

    def matrix(spread: float) -> np.ndarray:
        left, right = (np.linalg.qr(rng.standard_normal((n, n)))[0] for _ in range(2))
        return np.asarray(left * 10.0 ** rng.uniform(-spread, spread, n) @ right)

    A = np.array([matrix(0.2) for _ in range(steps)])
    H = [np.linalg.inv(L @ L.T) for L in (matrix(1.0) for _ in range(steps))]
    system = DiscreteSystem(A, np.array([(h + h.T) / 2 for h in H]))
    x0 = rng.standard_normal(n)
    return gauges.gauge(system, x0, steps, gauge(system, x0, steps))


def correction(thrust: str, rng: np.random.Generator) -> Enclosure:
    """A deviation, an interval from 0.1 to 3 and a peak for some tens of steps at most."""
    z0 = rng.standard_normal(3) * 10.0 ** rng.uniform(-4, -1)
    peak = float(np.abs(z0).max()) * rng.uniform(0.1, 1.0)
    return gauges.correction(correct(z0, rng.uniform(0.1, 3.0), peak, thrust))


SOLVERS: Mapping[str, Draw] = {
    "least energy": lambda rng: norms.energy(ti.minimum_energy(maneuver(rng))),
    "least peak": lambda rng: norms.peak(ti.minimum_peak(maneuver(rng))),
    "least total impulse": lambda rng: norms.impulse(ti.minimum_impulse(maneuver(rng))),
    "least norm": lambda rng: norms.power(ti.minimum_norm(maneuver(rng), float(rng.choice(EXPONENTS)))),
    "greatest entropy": lambda rng: norms.entropy(ti.maximum_entropy(one_signed(rng))),
    "least time": transfer,
    "gauge of ellipsoids": general,
    **{f"correction: {thrust}": partial(correction, thrust) for thrust in THRUSTS},
}
