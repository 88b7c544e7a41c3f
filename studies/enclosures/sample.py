"""Random problems of every convex solver, with the proved interval of each."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np

from pontryagin import triple_integrator as ti
from pontryagin.arrays import Array
from pontryagin.orbit_correction import DiscreteSystem, correct, gauge
from pontryagin.orbit_correction.plan.thrust import THRUSTS
from studies.enclosures import gauges, norms
from studies.enclosures.ball import Enclosure
from studies.enclosures.least_time import time

Solved = tuple[str, Enclosure | None]
"""A problem as a line of Python with all digits, and its interval; None where the balls decide nothing."""
Draw = Callable[[np.random.Generator], Solved]

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


def written(m: ti.Maneuver) -> str:
    """The manoeuvre as a line of Python."""
    return f"Maneuver({m.x0.tolist()}, {m.xf.tolist()}, {float(m.tf)}, disturbance={m.disturbance})"


def of_maneuver(
    solver: Callable[[ti.Maneuver], Any],
    enclose: Callable[[Any], Enclosure],
    draw: Callable[[np.random.Generator], ti.Maneuver],
    rng: np.random.Generator,
) -> Solved:
    """A manoeuvre by a solver that takes it alone."""
    m = draw(rng)
    return f"{solver.__name__}({written(m)})", enclose(solver(m))


def of_any_exponent(rng: np.random.Generator) -> Solved:
    """A manoeuvre of least norm."""
    m, q = maneuver(rng), float(rng.choice(EXPONENTS))
    return f"minimum_norm({written(m)}, {q})", norms.power(ti.minimum_norm(m, q))


def transfer(rng: np.random.Generator) -> Solved:
    """A transfer of least time."""
    m = maneuver(rng)
    peak = float(10.0 ** rng.uniform(-2, 2) * np.abs(m.xf[2] - m.x0[2]) / m.duration)
    text = f"minimum_time({m.x0.tolist()}, {m.xf.tolist()}, {peak}, {m.disturbance})"
    return text, time(ti.minimum_time(m.x0, m.xf, peak, m.disturbance))


def general(rng: np.random.Generator) -> Solved:
    """A nonstationary system in up to five dimensions, with ellipsoids whose axes differ by up to 100."""
    n, steps = int(rng.integers(1, 6)), int(rng.integers(1, 9))

    def matrix(spread: float) -> Array:
        left, right = (np.linalg.qr(rng.standard_normal((n, n)))[0] for _ in range(2))
        return np.asarray(left * 10.0 ** rng.uniform(-spread, spread, n) @ right)

    A = np.array([matrix(0.2) for _ in range(steps)])
    H = np.array([np.linalg.inv(L @ L.T) for L in (matrix(1.0) for _ in range(steps))])
    H = (H + H.swapaxes(1, 2)) / 2
    system, x0 = DiscreteSystem(A, H), rng.standard_normal(n)
    text = f"gauge(DiscreteSystem({A.tolist()}, {H.tolist()}), {x0.tolist()}, {steps})"
    return text, gauges.gauge(system, x0, steps, gauge(system, x0, steps))


def correction(thrust: str, rng: np.random.Generator) -> Solved:
    """A deviation, an interval from 0.1 to 3 and a peak for some tens of steps at most."""
    z0 = rng.standard_normal(3) * 10.0 ** rng.uniform(-4, -1)
    interval, peak = float(rng.uniform(0.1, 3.0)), float(np.abs(z0).max() * rng.uniform(0.1, 1.0))
    text = f"correct({z0.tolist()}, {interval}, {peak}, {thrust!r})"
    return text, gauges.correction(correct(z0, interval, peak, thrust))


SOLVERS: Mapping[str, Draw] = {
    "least energy": partial(of_maneuver, ti.minimum_energy, norms.energy, maneuver),
    "least peak": partial(of_maneuver, ti.minimum_peak, norms.peak, maneuver),
    "least total impulse": partial(of_maneuver, ti.minimum_impulse, norms.impulse, maneuver),
    "least norm": of_any_exponent,
    "greatest entropy": partial(of_maneuver, ti.maximum_entropy, norms.entropy, one_signed),
    "least time": transfer,
    "gauge of ellipsoids": general,
    **{f"correction: {thrust}": partial(correction, thrust) for thrust in THRUSTS},
}
