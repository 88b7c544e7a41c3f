"""``pontryagin solve triple-integrator``: least norms and least time from the command line."""

import math
from pathlib import Path
from typing import Annotated, Any, NamedTuple

import numpy as np
import typer

from pontryagin.certificate import Certificate
from pontryagin.io import rows
from pontryagin.io.formula import Formula
from pontryagin.terminal import console
from pontryagin.terminal.console import File, Json, Out, Text
from pontryagin.triple_integrator import transcript

ARGUMENTS = {"disturbance": "--disturbance", "q": "--norm", "xf": "--xf"}
"""The command-line option for each argument that the solvers check."""

SOLVERS = {1.0: "minimum_impulse", 2.0: "minimum_energy", math.inf: "minimum_peak"}
"""The solvers for special exponents q of the norm; `minimum_norm` solves the others."""

CARRIED = 1e-9
"""Largest relative change of a duration by the rounding of the time at the end."""

without_warnings = np.errstate(all="ignore")
"""An overflow makes the certificate fail, which is reported as an error; a warning would repeat it."""


def solve(
    x0: Annotated[Text, typer.Option("--x0", metavar="X1,X2,X3", help="State at the start.")] = None,
    xf: Annotated[Text, typer.Option("--xf", metavar="X1,X2,X3", help="State at the end.")] = None,
    norm: Annotated[
        Text,
        typer.Option(
            metavar="1|2|inf|Q",
            help="Norm of u to minimise: 1 (impulse), 2 (energy), inf (peak) or any Q > 1.",
        ),
    ] = None,
    duration: Annotated[Text, typer.Option(metavar="T", help="Time from start to end.")] = None,
    t0: Annotated[
        Text, typer.Option("--t0", metavar="TIME", help="Time at the start; 0 unless given.")
    ] = None,
    peak: Annotated[
        Text,
        typer.Option(
            metavar="U", help="Find the least time under |u| <= U, instead of --norm and --duration."
        ),
    ] = None,
    disturbance: Annotated[
        Text, typer.Option(metavar="F", help="Disturbing acceleration f: a number or a formula in t.")
    ] = None,
    json: Json = False,
    samples: Annotated[
        int, typer.Option(metavar="N", min=0, help="With --json: control, state and costate at N times.")
    ] = 0,
    plot: Annotated[
        File, typer.Option(metavar="FILE", help="Draw control and state: .svg, .pdf, .png.")
    ] = None,
    record: Annotated[File, typer.Option(metavar="FILE", help="Record the motion: .rrd for rerun.")] = None,
    batch: Annotated[
        File,
        typer.Option(
            metavar="FILE", help="CSV file, or -, with one problem in each row, instead of --x0 and --xf."
        ),
    ] = None,
    out: Out = "-",
) -> None:
    """Steer x1' = x2, x2' = x3 + f(t), x3' = u between two states, optimally and with a proof.

    The least norm of u for a given duration (--norm, --duration), or the least time under a bound on
    |u| (--peak). Numbers may be written like pi/2 or 1e-3. Formulas may hold t, pi, + - * / ^ and
    abs, sign, sqrt, exp, log, sin, cos, tan, sinh, cosh, tanh, asin, acos, atan.

    A CSV file for --batch has the columns x10, x20, x30, x1f, x2f, x3f, for a given duration tf (and t0
    if not 0), and any others, which are kept; each row comes back with its solution and certificate.

    \b
    Examples:
      pontryagin solve triple-integrator --norm inf --x0 0,0,0 --xf 1,0,0 --duration 2
      pontryagin solve triple-integrator --norm 2 --x0 0,0,0 --xf pi/2,0,0 --duration 9 --disturbance "sin(t)"
      pontryagin solve triple-integrator --peak 32 --x0 -1,0,0 --xf 0,0,0 --json
      pontryagin solve triple-integrator --norm 1 --batch problems.csv --out results.csv
    """
    times: dict[str, object] = {"--duration": duration, "--t0": t0}
    goal = _goal(norm, peak, times)
    force = _force(disturbance, goal)
    if batch is not None:
        single = {"--x0": x0, "--xf": xf, "--samples": samples, "--plot": plot, "--record": record}
        console.excluded("--batch", times | single)
        _solve_batch(goal, batch, out, force, json)
        return
    console.required({"--x0": x0, "--xf": xf} | ({} if goal.least_time else {"--duration": duration}))
    console.together({"--samples": samples}, "--json", json)
    console.file_names(plot, record, out)
    solution = _solved(goal, _ends(goal, str(x0), str(xf), t0 or "0", str(duration)), force)
    console.require_proof(solution.certificate)
    _files(solution, plot, record)
    _print(solution, json, samples)


class Goal(NamedTuple):
    """The quantity to minimise: the norm with exponent q, or the time under a bound on |u|."""

    q: float | None = None
    peak: float | None = None

    @property
    def least_time(self) -> bool:
        """Whether the duration is minimised."""
        return self.peak is not None


class Ends(NamedTuple):
    """Both states and, for a given duration, both times, of one problem or of a stack."""

    x0: Any
    xf: Any
    t0: Any = None
    tf: Any = None


def _goal(norm: Text, peak: Text, times: dict[str, object]) -> Goal:
    if peak is not None:
        console.excluded("--peak", {"--norm": norm} | times)
        return Goal(peak=console.positive("--peak", peak))
    if norm is None:
        raise console.Refusal("--norm", "is missing: takes 1, 2, inf or a number above 1; or give --peak")
    if norm.strip().lower() in ("inf", "infinity", "oo"):
        return Goal(math.inf)
    return Goal(console.number("--norm", norm, "1, 2, inf or a number greater than 1", at_least=1.0))


def _force(disturbance: Text, goal: Goal) -> Any:
    force = None if disturbance is None else console.formula("--disturbance", disturbance, "t")
    if goal.least_time and not isinstance(force, float | None):
        raise console.Refusal("--disturbance", f"takes a number if --peak is given, got {disturbance!r}")
    return force


def _ends(goal: Goal, x0: str, xf: str, t0: str, duration: str) -> Ends:
    start, end = console.vector("--x0", x0, 3), console.vector("--xf", xf, 3)
    if goal.least_time:
        return Ends(start, end)
    first, elapsed = console.number("--t0", t0), console.positive("--duration", duration)
    flown = (first + elapsed) - first
    if not flown > 0:
        raise console.Refusal("--duration", f"is lost to rounding when added to --t0 {t0}, got {duration!r}")
    if abs(flown - elapsed) > CARRIED * elapsed:
        took = f"would become {flown:.9g} on a clock that starts at --t0 {t0}"
        raise console.Refusal("--duration", f"{took}; solve from --t0 0, got {duration!r}")
    return Ends(start, end, first, first + elapsed)


def _solved(goal: Goal, ends: Ends, force: Any) -> Any:
    from pontryagin import triple_integrator as ti

    with console.solving(ARGUMENTS):
        if goal.least_time:
            return ti.minimum_time(ends.x0, ends.xf, goal.peak, force)  # type: ignore[arg-type]
        maneuver = ti.Maneuver(ends.x0, ends.xf, ends.tf, ends.t0, force)
        if goal.q in SOLVERS:
            return getattr(ti, SOLVERS[goal.q])(maneuver)
        return ti.minimum_norm(maneuver, goal.q)  # type: ignore[arg-type]


@without_warnings
def _files(solution: Any, plot: File, record: File) -> None:
    if (plot or record) and not transcript.moves(solution):
        option = "--plot" if plot else "--record"
        raise console.Refusal(option, "needs a motion, but --x0 and --xf are the same state")
    if plot:
        from pontryagin.triple_integrator.figures import solution_figure

        console.save_figure("--plot", plot, solution_figure(solution))
    if record:
        from pontryagin.triple_integrator.playback import record_solution

        console.save_recording("--record", record, lambda path: record_solution(solution, path))


@without_warnings
def _print(solution: Any, json: bool, samples: int) -> None:
    report: dict[str, Any] = transcript.transcript(solution)
    if samples:
        report["samples"] = transcript.samples(solution, samples)
    console.answer(json, transcript.account(solution).title, report, transcript.conclusion(solution))


@without_warnings
def _solve_batch(goal: Goal, path: Path, out: str, force: Any, json: bool) -> None:
    from pontryagin.terminal import batches
    from pontryagin.triple_integrator import batch

    def solved(block: rows.Rows) -> tuple[dict[str, Any], Certificate]:
        start, end = block.stack(batch.START), block.stack(batch.END)
        ends = Ends(start, end, block.columns.get("t0", 0.0), block.columns.get("tf"))
        solution = _solved(goal, ends, force)
        return batch.answers(solution), solution.certificate

    # A formula is integrated over the times of all rows at once, from the first start to the last end.
    whole = isinstance(force, Formula)
    shared = ("--norm", "--peak", "--disturbance")
    batches.run(path, out, batch.blocks(path, goal.least_time, whole), solved, json, shared, (goal, force))
