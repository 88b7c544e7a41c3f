"""A solution as headings, names and values, which the command line prints as a table or as JSON."""

from typing import Any, NamedTuple

import numpy as np

Report = dict[str, dict[str, Any]]
"""Quantities by their heading and, below it, by their name."""


class Account(NamedTuple):
    """How a kind of solution is reported: its solver, a title, and its attributes in order."""

    solver: str
    title: str
    quantities: tuple[str, ...]


SWITCHES = ("switch_times", "switch_offsets", "first_sign", "switch_condition")
"""The attributes that only bang-bang solutions have."""

ACCOUNTS = {
    "EnergySolution": Account(
        "minimum_energy", "Least energy, the L2 norm of u", ("norm", "coefficients", "multipliers")
    ),
    "PeakSolution": Account(
        "minimum_peak", "Least peak, the L-infinity norm of u", ("norm", *SWITCHES, "multipliers")
    ),
    "ImpulseSolution": Account(
        "minimum_impulse",
        "Least total impulse, the L1 norm of u",
        ("norm", "regime", "unique", "impulse_times", "impulse_offsets", "impulses", "multipliers"),
    ),
    "NormSolution": Account(
        "minimum_norm",
        "Least L_q norm of u",
        ("q", "norm", "peak", "breakpoints", "breakpoint_offsets", "multipliers"),
    ),
    "TimeSolution": Account(
        "minimum_time", "Least time under a bound on |u|", ("duration", "norm", *SWITCHES, "multipliers")
    ),
}


def account(solution: Any) -> Account:
    """How a solution is reported, by its class."""
    return ACCOUNTS[type(solution).__name__]


def moves(solution: Any) -> bool:
    """Whether the solution takes any time; a least time is 0 where the ends agree."""
    return account(solution).solver != "minimum_time" or bool(solution.duration > 0)


def transcript(solution: Any) -> Report:
    """One solution as headings with their quantities, named as the attributes of the library.

    Parameters
    ----------
    solution : EnergySolution, PeakSolution, ImpulseSolution, NormSolution or TimeSolution
        The solution of one problem, not of a stack.

    Returns
    -------
    dict of dicts
        ``problem`` (the arguments), ``solution`` (the attributes that `ACCOUNTS` lists), ``states`` (at the
        start and at the end, propagated with the control) and ``certificate``.

    Examples
    --------
    >>> from pontryagin.triple_integrator import minimum_time
    >>> report = transcript(minimum_time([0, 0, 0], [1, 0, 0], peak=32.0))
    >>> report["solution"]["duration"].tolist(), report["states"]["end"].round(12).tolist()
    (1.0, [1.0, 0.0, 0.0])
    """
    kind = account(solution)
    moving = moves(solution)
    return {
        "problem": {"solver": kind.solver, **_problem(solution, kind)},
        "solution": {name: _quantity(solution, name, moving) for name in kind.quantities},
        "states": _states(solution) if moving else {"start": solution.x0, "end": solution.xf},
        "certificate": certificate_of(solution),
    }


def certificate_of(solution: Any) -> dict[str, Any]:
    """The numbers of a solution's certificate by name."""
    names = ("primal_residual", "primal_value", "dual_value", "gap")
    return {name: getattr(solution.certificate, name) for name in names}


def conclusion(solution: Any) -> str:
    """A sentence that says what the certificate proves.

    Examples
    --------
    >>> from pontryagin.triple_integrator import Maneuver, minimum_peak
    >>> conclusion(minimum_peak(Maneuver([0, 0, 0], [1, 0, 0], tf=2.0)))
    'No control does better than 4, and this one costs 4.'
    """
    proof = solution.certificate
    return (
        f"No control does better than {proof.dual_value:.12g}, and this one costs {proof.primal_value:.12g}."
    )


def samples(solution: Any, count: int) -> dict[str, Any]:
    """Control (k,), state and costate (k, 3) at evenly spaced times ``t`` (k,)."""
    m = solution.maneuver
    t = np.linspace(m.t0, m.tf, count)
    return {"t": t} | {name: getattr(solution, name)(t) for name in ("control", "state", "costate")}


def _problem(solution: Any, kind: Account) -> dict[str, Any]:
    if kind.solver == "minimum_time":
        return {name: getattr(solution, name) for name in ("x0", "xf", "peak", "disturbance")}
    m = solution.maneuver
    names = ("x0", "xf", "t0", "tf", "duration", "disturbance", "moments")
    return {name: getattr(m, name) for name in names}


def _quantity(solution: Any, name: str, moving: bool) -> Any:
    return getattr(solution, name) if moving or name != "multipliers" else np.zeros(3)


def _states(solution: Any) -> dict[str, Any]:
    m = solution.maneuver
    start, end = solution.state(np.array([float(m.t0), float(m.tf)]))
    return {"start": start, "end": end}
