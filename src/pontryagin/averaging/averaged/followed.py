"""A guess by integration with adapted steps, on a mesh that is as fine as the trajectory asks for.

Where slow variables change by orders of magnitude in a small share of the time, as K does near E = 0 of
Kepler's problem, neither a straight line nor equal steps come close to the extremal.
"""

from typing import Any

import numpy as np

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.collocation import Problem, Trajectories
from pontryagin.averaging.averaged.guess import initial_costate, multipliers_at
from pontryagin.numerics.collocation import Mesh

ACCURACY = 1e-10
"""Relative accuracy of the integration."""
ROUGH = 1e-5
"""A panel of the guess is halved while its last coefficients, relative to the variable, exceed this."""
MOST = 32
"""Largest number of panels of a guess."""
HALVINGS = 60
"""Number of bisections for the place at a given time."""


def followed(problem: Problem, degree: int) -> Trajectories | None:
    """The extremal of one problem (1) with one condition at the end, from the costate of `straight`.

    It is integrated over the value of the condition. The result is None if the extremal does not approach the
    target all the way.
    """
    from scipy.integrate import solve_ivp

    model, n = problem.model, problem.model.slow
    costate = initial_costate(problem)
    if model.target != 1 or costate is None:
        return None
    target, _ = model.ends(problem.start, problem.numbers)
    begin, end = float(target.value[0, 0]), float(problem.level[0, 0])

    def rates(_: float, state: Array) -> Array:
        z = state[None, None, :-1]
        gradient = problem.hamiltonian(z).gradient[0, 0]
        flow = np.concatenate([gradient[n:], -gradient[:n]])
        along = float(model.ends(state[None, :n], problem.numbers)[0].gradient[0, 0] @ flow[:n])
        towards = along * (end - begin) > 0
        return np.append(flow, 1.0) / along if towards else np.full(2 * n + 1, np.nan)

    state = np.concatenate([problem.start[0], costate[0], [0.0]])
    with np.errstate(all="ignore"):
        run = solve_ivp(
            rates,
            (begin, end),
            state,
            method="DOP853",
            rtol=ACCURACY,
            atol=ACCURACY * np.append(_sizes(state[:-1], n), 0.0),
            dense_output=True,
            first_step=1e-6 * abs(end - begin),
        )
    if not run.success or not np.isfinite(run.y).all() or not run.y[-1, -1] > 0:
        return None
    return _on_a_mesh(problem, run, Mesh((0.0, 1.0), degree))


def _sizes(z: Array, n: int) -> Array:
    xi, eta = np.abs(z[:n]), np.abs(z[n:])
    xi = np.where(xi > 0, xi, 1.0)
    return np.concatenate([xi, np.maximum(eta, (xi * eta).max() / xi)])


def _on_a_mesh(problem: Problem, run: Any, mesh: Mesh) -> Trajectories:
    duration = np.array([run.y[-1, -1]])
    while True:
        z = _at(run, mesh.points * duration)[None, :, :-1]
        path = Trajectories(mesh, z, duration, multipliers_at(problem, z[:, -1]))
        rough = (path.tails() > ROUGH)[0]
        if not rough.any() or mesh.panels >= MOST:
            return path
        mesh = mesh.bisected(rough)


def _at(run: Any, times: Array) -> Array:
    """The states at given times, (k, 2n + 1)."""
    low, high = np.full(len(times), run.t[0]), np.full(len(times), run.t[-1])
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        late = run.sol(middle)[-1] > times
        low, high = np.where(late, low, middle), np.where(late, middle, high)
    return np.asarray(run.sol(high)).T
