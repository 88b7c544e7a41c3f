"""A solved rendezvous as the command line prints it: a table or JSON."""

import re
from collections import Counter
from typing import Any

import numpy as np

from pontryagin.arrays import Array
from pontryagin.rendezvous import schema
from pontryagin.rendezvous.reduced.search_log import INTERRUPTED
from pontryagin.rendezvous.reduced.solution import Extremal

Report = dict[str, dict[str, Any]]
"""The quantities under each heading, by name."""

CERTIFICATE = (
    "boundary",
    "attitude",
    "transversality",
    "hamiltonian",
    "maximality",
    "agreement",
    "cartesian",
    "cost",
    "residual",
    "condition",
)
"""The residuals of the certificate that are printed."""
LISTED = 6
"""Number of extremals besides the best one, and of reasons, that a table lists; JSON holds all."""
RESIDUAL = re.compile(r" \(residual [^)]*\)")
"""The end of a reason that tells a residual."""


def transcript(extremal: Extremal) -> Report:
    """One solution as headings with quantities, which are named as the attributes of the library's objects.

    Parameters
    ----------
    extremal : Extremal
        The solution that `solve` returned.

    Examples
    --------
    >>> import math
    >>> from pontryagin.rendezvous import Chaser, Orbit, Rendezvous, solve
    >>> problem = Rendezvous(Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]), Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6),
    ...                      time_weight=0, energy_weight=1, peak=math.inf, duration=6.0)
    >>> report = transcript(solve(problem))
    >>> report["solution"]["arcs"], round(report["solution"]["cost"], 6)
    (['unsaturated'], 0.023882)
    """
    report: Report = {
        "problem": schema.to_dict(extremal.problem),
        "solution": {
            "duration": extremal.duration,
            "cost": extremal.cost,
            "arrival_anomaly": extremal.arrival_anomaly,
            "revolutions": extremal.revolutions,
            "arcs": list(extremal.modes),
            "switch_times": extremal.switch_times,
            "initial_costate": extremal.initial_costate,
        },
        "certificate": {name: getattr(extremal.certificate, name) for name in CERTIFICATE},
        "others": {
            "count": len(extremal.others),
            "cost": [other.cost for other in extremal.others],
            "duration": [other.duration for other in extremal.others],
            "arrival_anomaly": [other.arrival_anomaly for other in extremal.others],
            "revolutions": [other.revolutions for other in extremal.others],
        },
    }
    if extremal.searched is not None:
        log, unit = extremal.searched, extremal.problem.scaled.time
        report["searched"] = {
            "durations": [unit * duration for duration in log.durations],
            "revolutions": sorted(set(log.revolutions)),
            "ends": list(log.ends),
            "given_up": list(log.given_up),
        }
    return report


def answers(extremal: Extremal) -> dict[str, Array]:
    """The columns of one solution in a table, (1,) or (1, 6) each, named as in the transcript."""
    names = ("duration", "cost", "arrival_anomaly", "revolutions", "initial_costate")
    values: dict[str, Any] = {f"solution.{name}": getattr(extremal, name) for name in names}
    values |= {f"certificate.{name}": getattr(extremal.certificate, name) for name in CERTIFICATE}
    values |= {"others.count": len(extremal.others)}
    return {name: np.asarray(value)[None] for name, value in values.items()}


def samples(extremal: Extremal, count: int) -> dict[str, Array]:
    """The solution at evenly spaced times.

    ``t`` (k,); ``state`` (k, 8): r, v1, c, phi* and lambda; ``costate`` (k, 6): rho, s1, e, nu1, nu2, nu3;
    ``control`` (k, 3): p in eta.
    """
    t = np.linspace(0.0, extremal.duration, count)
    parts = {"state": extremal.state, "costate": extremal.costate, "control": extremal.control}
    return {"t": t} | {name: part(t) for name, part in parts.items()}


def table(report: Report) -> Report:
    """The report as a table shows it: a line for each of the two craft, and one for each other extremal."""
    problem = {
        key: ", ".join(f"{name} {_short(item)}" for name, item in value.items())
        if isinstance(value, dict)
        else value
        for key, value in report["problem"].items()
    }
    problem["duration"] = "free" if problem["duration"] is None else problem["duration"]
    others = report["others"]
    lines: dict[str, Any] = {}
    columns = zip(others["cost"], others["duration"], others["revolutions"], strict=True)
    for place, (cost, duration, revolutions) in enumerate(columns, start=2):
        if place <= LISTED + 1:
            lines[f"{place}"] = f"cost {cost:.8g}, time {duration:.8g}, {revolutions:.2f} revolutions"
    if others["count"] > LISTED:
        lines["further"] = f"{others['count'] - LISTED}, with costs up to {max(others['cost']):.8g}"
    rows = report | {"problem": problem, "others found": lines or {"none": ""}}
    del rows["others"]
    if "searched" in report:
        searched = report["searched"]
        rows["searched"] = {
            "first durations": [float(f"{duration:.5g}") for duration in searched["durations"]],
            "laps": searched["revolutions"],
            "search ended": searched["ends"],
            "attempts given up": len(searched["given_up"]),
        }
        if searched["given_up"]:
            rows["searched"]["given up"] = _most_frequent(searched["given_up"])
    order = ("problem", "solution", "certificate", "others found", "searched")
    return {heading: rows[heading] for heading in order if heading in rows}


def _most_frequent(reasons: list[str]) -> list[str]:
    """What was given up and why, without residuals, the most frequent first, and how often if repeatedly."""
    counts = Counter(RESIDUAL.sub("", reason) for reason in reasons).most_common()
    lines = [f"{reason} ({count} times)" if count > 1 else reason for reason, count in counts[:LISTED]]
    return [*lines, f"and {len(counts) - LISTED} others"] if len(counts) > LISTED else lines


def _short(value: Any) -> str:
    values = value if isinstance(value, list) else [value]
    text = " ".join(f"{item + 0.0:.6g}" for item in values)
    return f"({text})" if isinstance(value, list) else text


def conclusion(report: Report) -> str:
    """The cost, the largest residual, and what is not claimed, as text.

    Examples
    --------
    >>> report = {"others": {"count": 0}, "solution": {"cost": 0.5}, "certificate": {"residual": 1e-13}}
    >>> conclusion(report)[:72]
    'The extremal found costs 0.5; every condition is met to 1e-13. Extremals'
    """
    count = report["others"]["count"] + 1
    found = f"The best of {count} extremals" if count > 1 else "The extremal found"
    unfinished = INTERRUPTED in report.get("searched", {}).get("ends", ())
    return ("The search is unfinished, as it was interrupted. " if unfinished else "") + (
        f"{found} costs {report['solution']['cost']:.10g}; every condition is met to "
        f"{float(report['certificate']['residual']):.0e}. Extremals satisfy necessary conditions; it is not "
        "claimed that no other control costs less."
    )
