"""Newton's method on pykep's least-time problem, run by another interpreter, with input and output in JSON.

pykep requires a version of heyoka other than ours. The wheel of its version 3.0.1 lacks the data of the
module ``pykep.trajopt.gym``, without which it cannot be imported; that module is not needed here, so an empty
one replaces it. The gradient of pykep passes two parameters to a function of three, which raises an error:
the third one is supplied here. An exhaust velocity of 1e15 keeps the mass practically constant.
"""

import json
import statistics
import sys
import time
import types
from typing import Any

import numpy as np

EXACT, ITERATIONS = 1e-11, 20


def main() -> None:
    """Read a problem in units with fM = 1 and p* = 1, solve it, and write the solution and the times."""
    sys.modules["pykep.trajopt.gym"] = types.ModuleType("pykep.trajopt.gym")
    import pykep as pk

    given = json.load(sys.stdin)
    length, gravity, mass = pk.AU, pk.MU_SUN, 1500.0
    unit = np.sqrt(length**3 / gravity)
    speed = length / unit

    def planet(place: list[float], velocity: list[float]) -> Any:
        posvel = [[x * length for x in place], [x * speed for x in velocity]]
        return pk.planet(pk.udpla.keplerian(when=pk.epoch(0), posvel=posvel, mu_central_body=gravity))

    problem = pk.trajopt.pontryagin_cartesian_time(
        source=planet(*given["craft"]),
        target=planet(*given["target"]),
        t0=pk.epoch(0),
        tof_guess=given["duration"] * unit * pk.SEC2DAY,
        T_max=given["peak"] * mass * speed / unit,
        Isp=1e15 * speed / pk.G0,
        m0=mass,
        MASS=mass,
        with_gradient=True,
    )
    rates = problem.dyn_func
    problem.dyn_func = lambda state, pars: rates(state, pars=problem.ta_var.pars[:3])
    costates = -np.array(given["costates"])
    start = np.array([*costates / np.linalg.norm(costates), 0.0, given["duration"]])

    def newton() -> tuple[np.ndarray, float]:
        x = start.copy()
        for _ in range(ITERATIONS):
            residual = np.array(problem.fitness(x)[1:])
            if np.abs(residual).max() < EXACT:
                break
            jacobian = np.array(problem.gradient(x)).reshape(7, 8)
            x = x + np.linalg.lstsq(jacobian, -residual, rcond=None)[0]
        return x, float(np.abs(residual).max())

    x, residual = newton()
    seconds = []
    for _ in range(given["rounds"]):
        begun = time.process_time()
        newton()
        seconds.append(time.process_time() - begun)
    answer = {
        "version": pk.__version__,
        "duration": float(x[-1]),
        "residual": residual,
        "typical": statistics.median(seconds),
        "least": min(seconds),
    }
    json.dump(answer, sys.stdout)


if __name__ == "__main__":
    main()
