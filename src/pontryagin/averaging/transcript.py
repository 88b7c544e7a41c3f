"""Reports of an averaged solution and its exact extremals: as a table, as JSON, as columns of CSV."""

from collections.abc import Mapping
from typing import Any

import numpy as np

Report = dict[str, dict[str, Any]]

PROOF = ("boundary", "transversality", "hamiltonian", "maximality", "unresolved")
SHOWN = 6
"""Number of extremals that a table lists; JSON lists all of them."""


def transcript(
    problem: Mapping[str, Any],
    solution: Any,
    epsilon: float | None = None,
    phase: float | None = None,
    exact: Any = None,
) -> Report:
    """Report one solution: quantities under headings, named like the attributes of the library.

    Parameters
    ----------
    problem : mapping
        The example and its arguments; reported unchanged.
    solution : AveragedSolution
        The averaged solution of one problem.
    epsilon : float, optional
        If given together with `exact`, the correction and the exact extremals are reported too.
    phase : float, optional
        Phase at the start.
    exact : Extremals, optional
        The exact extremals, best first. Where the anomaly at the end cannot be chosen, the correction is the
        one for the best extremal's anomaly.

    Examples
    --------
    >>> from pontryagin.averaging import smooth_example
    >>> report = transcript({"example": "smooth"}, smooth_example(1.0, 2.0))
    >>> report["averaged"]["slow_end"].round(12).tolist()
    [2.0]
    """
    ends = np.array([0.0, float(solution.duration)])
    slow, costate = solution.slow(ends), solution.costate(ends)
    report: Report = {
        "problem": dict(problem),
        "averaged": {
            "duration": solution.duration,
            "cost": solution.cost,
            "slow_names": list(solution.names),
            "slow_end": slow[-1],
            "initial_costate": costate[0],
            "multipliers": solution.multipliers,
        },
        "certificate": {name: getattr(solution.certificate, name) for name in PROOF},
    }
    if epsilon is None or exact is None:
        return report
    correction = solution.correction(phase, exact[0].ending_anomaly if exact.family is None else None)
    report["corrected"] = {"correction": correction, "cost": solution.cost + epsilon * correction}
    report["exact"] = {
        "count": len(exact),
        "minima": sum(extremal.kind == "minimum" for extremal in exact),
        "kind": [extremal.kind for extremal in exact],
        "cost": [float(extremal.cost) for extremal in exact],
        "duration": [float(extremal.duration) for extremal in exact],
        "residual": [float(extremal.certificate.residual) for extremal in exact],
    }
    return report


def shown(report: Report) -> Report:
    """The report as a table shows it, with a line for each of the best `SHOWN` extremals."""
    if "exact" not in report:
        return report
    exact = report["exact"]
    lines: dict[str, Any] = {"extremals": exact["count"], "of them minima": exact["minima"]}
    columns = zip(exact["kind"], exact["cost"], exact["duration"], exact["residual"], strict=True)
    for place, (kind, cost, duration, residual) in enumerate(columns, start=1):
        if place <= SHOWN:
            lines[f"{place}"] = f"{kind}: cost {cost:.8g}, time {duration:.6g}, residual {residual:.0e}"
    if exact["count"] > SHOWN:
        lines["further"] = f"{exact['count'] - SHOWN}, with costs up to {max(exact['cost']):.10g}"
    rest = {heading: quantities for heading, quantities in report.items() if heading != "exact"}
    return rest | {"exact, best first": lines}


def conclusion(report: Report) -> str:
    """State the costs that were found, in one or two sentences.

    Examples
    --------
    >>> from pontryagin.averaging import smooth_example
    >>> conclusion(transcript({"example": "smooth"}, smooth_example(1.0, 2.0)))
    'The least cost is 2 + O(epsilon).'
    """
    averaged = float(report["averaged"]["cost"])
    if "exact" not in report:
        return f"The least cost is {averaged:.12g} + O(epsilon)."
    best, corrected = report["exact"]["cost"][0], float(report["corrected"]["cost"])
    count = report["exact"]["count"]
    found = f"The best of {count} extremals" if count > 1 else "The extremal found"
    return (
        f"{found} costs {best:.10g}. It differs by {best - averaged:+.2e} from the "
        f"averaged cost and by {best - corrected:+.2e} from the corrected one. "
        "Extremals satisfy necessary conditions; no bound from below is claimed."
    )


def answers(solution: Any, epsilon: float | None = None, phase: float | None = None) -> dict[str, Any]:
    """Result columns, (n,) each, for a stack of n solutions."""
    report = {"duration": solution.duration, "cost": solution.cost}
    if epsilon is not None:
        correction = solution.correction(phase)
        report |= {"correction": correction, "corrected_cost": solution.cost + epsilon * correction}
    return report | {"residual": solution.certificate.residual}
