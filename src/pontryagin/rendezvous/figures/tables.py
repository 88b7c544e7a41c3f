"""Tables of this paper: columns for `plotting.show_table`."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from pontryagin.rendezvous import small_weight
from pontryagin.rendezvous.false_meetings.family import FalseFamily
from pontryagin.rendezvous.figures.labels import Units, units
from pontryagin.rendezvous.judge.table import (
    MESHES,
    direct_results,
)
from pontryagin.rendezvous.problem.cases import cases
from pontryagin.rendezvous.reduced.solution import Extremal

Columns = dict[str, list[Any]]


def titles() -> Columns:
    """Names and titles of the cases."""
    known = cases()
    return {"case": list(known), "": [one.title for one in known.values()]}


def solutions(found: Mapping[str, Extremal]) -> Columns:
    """Duration, cost, direct cost on the finer mesh, arrival anomaly and arcs of every case."""
    several, kept = list(found.values()), direct_results()
    return {
        "case": list(found),
        "$t_k$": [_time(one.duration, units(one.problem)) for one in several],
        "$J$": [f"{one.cost:.10g}" for one in several],
        "direct $J$": [f"{kept[name].costs[-1]:.7g}" for name in found],
        "$\\varphi^*_k$ [°]": [f"{np.degrees(one.arrival_anomaly):.2f}" for one in several],
        "revolutions": [f"{one.revolutions:.3f}" for one in several],
        "arcs": [_arcs(one) for one in several],
        "others": [len(one.others) for one in several],
    }


def certificates(found: Mapping[str, Extremal]) -> Columns:
    """Every residual of every case, and the condition number."""
    several = [one.certificate for one in found.values()]
    residuals = {
        "(5)": "boundary",
        "(6)": "attitude",
        "(16), end": "transversality",
        "$H$": "hamiltonian",
        "maximality": "maximality",
        "on the way": "agreement",
        "Cartesian": "cartesian",
        "$J$": "cost",
    }
    columns: Columns = {"case": list(found)}
    for title, name in residuals.items():
        columns[title] = [f"{float(getattr(one, name)):.0e}" for one in several]
    columns["condition"] = [f"{float(one.condition):.0f}" for one in several]
    return columns


def _time(duration: float, own: Units) -> str:
    return f"{duration / own.time:.6f} {own.time_name}".strip()


def _arcs(extremal: Extremal) -> str:
    """One letter for each arc: S on the bound, U within it."""
    return "".join(mode[0].upper() for mode in extremal.modes)


def judge(found: Mapping[str, Extremal]) -> Columns:
    """Direct costs at two meshes, and their relative differences from the nearest of our extremals."""
    kept = direct_results()
    rows = [(name, one, kept[name]) for name, one in found.items()]
    columns: Columns = {
        "case": [name for name, _, _ in rows],
        "$J$": [f"{one.cost:.10g}" for _, one, _ in rows],
    }
    for j, mesh in enumerate(MESHES):
        columns[f"direct, {mesh} intervals"] = [f"{found.costs[j]:.10g}" for _, _, found in rows]
        columns[f"direct/J − 1, {mesh}"] = [
            f"{excess(one, found.costs[j]):+.0e}"
            + ("" if nearest(one, found.costs[j]) is one else " (another)")
            for _, one, found in rows
        ]
    columns["Ipopt's iterations"] = [" + ".join(map(str, one.iterations)) for _, _, one in rows]
    return columns


def nearest(extremal: Extremal, cost: float) -> Extremal:
    """The extremal found whose cost is nearest to that of the direct method."""
    return min([extremal, *extremal.others], key=lambda one: abs(one.cost - cost))


def excess(extremal: Extremal, cost: float) -> float:
    """Relative difference of a direct cost from that of the nearest extremal."""
    return cost / nearest(extremal, cost).cost - 1


def others(found: Mapping[str, Extremal]) -> Columns:
    """All extremals of every case for which several were found, best first."""
    rows = [
        (name, one, own)
        for name, best in found.items()
        if best.others
        for own in [units(best.problem)]
        for one in [best, *best.others]
    ]
    return {
        "case": [name for name, _, _ in rows],
        "$J$": [f"{one.cost:.8g}" for _, one, _ in rows],
        "$t_k$": [_time(one.duration, own) for _, one, own in rows],
        "revolutions": [f"{one.revolutions:.3f}" for _, one, _ in rows],
        "residual": [f"{float(one.certificate.residual):.0e}" for _, one, _ in rows],
    }


def small_weights() -> Columns:
    """The case `mixed` at decreasing weights of time."""
    kept = small_weight.rows()
    return {
        "$\\alpha_1$": [f"$10^{{{np.log10(one.time_weight):.0f}}}$" for one in kept],
        "$t_k$": [f"{one.duration:.6f}" for one in kept],
        "$J$": [f"{one.cost:.8g}" for one in kept],
        "revolutions": [f"{one.revolutions:.3f}" for one in kept],
        "condition": [f"{one.condition:.0f}" for one in kept],
        "largest residual": [f"{one.residual:.0e}" for one in kept],
    }


def family(*families: FalseFamily) -> Columns:
    """Members of families of false meetings: residuals of the conditions, and the distance missed."""
    members = [member for one in families for member in one.members]
    return {
        "turned by [°]": [f"{np.degrees(member.angle):.0f}" for member in members],
        "$t_k$": [f"{member.duration:.6f}" for member in members],
        "$J$": [f"{member.cost:.6f}" for member in members],
        "(5), (15), (16), (17)": [f"{member.printed:.0e}" for member in members],
        "(6) [°]": [_angle(member.mismatch) for member in members],
        "missed by": [_small(member.distance) for member in members],
        "velocity off by": [_small(member.drift) for member in members],
    }


def _angle(radians: float) -> str:
    return _small(float(np.degrees(radians)), ".1f")


def _small(value: float, form: str = ".4f") -> str:
    return f"{value:{form}}" if value > 1e-6 else f"{value:.0e}"


def ranks(families: Mapping[str, FalseFamily]) -> Columns:
    """Smallest and largest singular values of both Jacobians at the true meetings."""
    several: Sequence[FalseFamily] = list(families.values())
    printed = [one.printed_singular_values for one in several]
    repaired = [one.repaired_singular_values for one in several]
    return {
        "case": list(families),
        "printed, smallest": [f"{values[-1] / values[0]:.0e}" for values in printed],
        "printed, next": [f"{values[-2] / values[0]:.0e}" for values in printed],
        "repaired, smallest": [f"{values[-1] / values[0]:.0e}" for values in repaired],
    }
