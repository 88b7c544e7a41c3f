"""``pontryagin solve triple-integrator``: the five problems of the folder from the command line."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer

from pontryagin import console
from pontryagin.errors import NotConverged

ACCEPTED = 1e-8
"""Largest residual and gap of an answer that is handed out."""

ARGUMENTS = {"tf": "--duration", "disturbance": "--disturbance", "q": "--norm", "peak": "--peak"}

Text = str | None
File = Path | None


def solve(
    x0: Annotated[Text, typer.Option("--x0", metavar="X1,X2,X3", help="State at the start.")] = None,
    xf: Annotated[Text, typer.Option("--xf", metavar="X1,X2,X3", help="State at the end.")] = None,
    norm: Annotated[
        Text, typer.Option(metavar="1|2|inf|Q", help="Norm of u to minimise: impulse, energy, peak, any Q > 1.")
    ] = None,
    duration: Annotated[Text, typer.Option(metavar="T", help="Time from start to end.")] = None,
    t0: Annotated[Text, typer.Option("--t0", metavar="TIME", help="Start; 0 unless given.")] = None,
    peak: Annotated[
        Text, typer.Option(metavar="U", help="Least time under |u| <= U, instead of --norm and --duration.")
    ] = None,
    disturbance: Annotated[
        Text, typer.Option(metavar="F", help="Acceleration f beside the control: a number or a formula in t.")
    ] = None,
    json: Annotated[bool, typer.Option("--json", help="Print JSON instead of a table.")] = False,
    samples: Annotated[
        int, typer.Option(metavar="N", min=0, help="With --json: control, state and costate at N times.")
    ] = 0,
    plot: Annotated[File, typer.Option(metavar="FILE", help="Draw control and state: .svg, .pdf, .png.")] = None,
    record: Annotated[File, typer.Option(metavar="FILE", help="Record the motion: .rrd for rerun.")] = None,
    batch: Annotated[
        File, typer.Option(metavar="FILE", help="Problems from a CSV file, a row each, instead of --x0, --xf.")
    ] = None,
    out: Annotated[
        str, typer.Option(metavar="FILE", help="With --batch: where the results go; - prints them.")
    ] = "-",
) -> None:
    """Steer x1' = x2, x2' = x3 + f(t), x3' = u between two states, optimally and with a proof.

    The least norm of u for a given duration (--norm, --duration), or the least time under a bound on
    |u| (--peak). Numbers may be written like pi/2 or 1e-3. Formulas hold t, pi, + - * / ^ and
    abs, sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, exp, log, sqrt.

    A CSV file for --batch has the columns x10, x20, x30, x1f, x2f, x3f, for a given duration tf (and t0
    if not 0), and any others, which are kept; each row comes back with its solution and certificate.

    \b
    Examples:
      pontryagin solve triple-integrator --norm inf --x0 0,0,0 --xf 1,0,0 --duration 2
      pontryagin solve triple-integrator --norm 2 --x0 0,0,0 --xf pi/2,0,0 --duration 10 --disturbance "0.01*sin(t)"
      pontryagin solve triple-integrator --peak 32 --x0 -1,0,0 --xf 0,0,0 --json
      pontryagin solve triple-integrator --norm 1 --batch problems.csv --out results.csv
    """
    chosen = _solver(norm, duration, t0, peak, batch)
    force = None if disturbance is None else console.formula("--disturbance", disturbance, "t")
    if peak and not isinstance(force, float | None):
        raise console.refusal("--disturbance", f"takes a number with --peak, got {disturbance!r}")
    if batch:
        one = {"--x0": x0, "--xf": xf, "--json": json, "--samples": samples}
        console.excluded("--batch", one | {"--plot": plot, "--record": record})
        _solve_batch(chosen, batch, out, force)
        return
    _require_single(x0, xf, out, json, samples)
    for option, path, takes in (("--plot", plot, console.FIGURES), ("--record", record, console.RECORDINGS)):
        if path:
            console.ending(option, path, takes)
    ends = console.vector("--x0", x0, 3), console.vector("--xf", xf, 3)
    if not peak:
        start = console.number("--t0", t0 or "0")
        ends += start, start + console.positive("--duration", duration)
    solution = _solved(chosen, ends, force)
    _require_proof(solution)
    _files(solution, plot, record)
    _print(solution, json, samples)


Solver = Callable[..., Any]
"""(x0, xf, t0, tf, disturbance), or (x0, xf, disturbance) for the least time -> solution."""


def _solver(norm: Text, duration: Text, t0: Text, peak: Text, batch: File) -> Solver:
    from pontryagin import triple_integrator as ti

    if peak:
        console.excluded("--peak", {"--norm": norm, "--duration": duration, "--t0": t0})
        bound = console.positive("--peak", peak)
        return lambda x0, xf, f: ti.minimum_time(x0, xf, bound, f)
    if batch:
        console.excluded("--batch", {"--duration": duration, "--t0": t0})
    else:
        console.required({"--duration": duration}, ": give it with --norm, or --peak for the least time")
    console.required({"--norm": norm}, ": takes 1, 2, inf or a number greater than 1")
    q = _exponent(norm)
    by_name = {1: "minimum_impulse", 2: "minimum_energy", math.inf: "minimum_peak"}
    if q in by_name:
        least = getattr(ti, by_name[q])
        return lambda x0, xf, t0, tf, f: least(ti.Maneuver(x0, xf, tf, t0, f))
    return lambda x0, xf, t0, tf, f: ti.minimum_norm(ti.Maneuver(x0, xf, tf, t0, f), q)


def _exponent(norm: str) -> float:
    if norm.strip().lower() in ("inf", "infinity", "oo"):
        return math.inf
    return console.number("--norm", norm, "1, 2, inf or a number greater than 1", at_least=1.0)


def _solved(chosen: Solver, ends: tuple, force: Any) -> Any:
    with console.blaming(ARGUMENTS), np.errstate(all="ignore"):
        try:
            return chosen(*ends, force)
        except ArithmeticError as reason:
            raise NotConverged(f"the numbers overflow: {reason}", math.inf) from reason


def _require_single(x0: Text, xf: Text, out: str, json: bool, samples: int) -> None:
    console.required({"--x0": x0, "--xf": xf})
    if out != "-":
        raise console.refusal("--out", "goes with --batch only")
    if samples and not json:
        raise console.refusal("--samples", "goes with --json only")


def _require_proof(solution: Any) -> None:
    with np.errstate(all="ignore"):
        proved = solution.certificate.holds(ACCEPTED)
        left = np.fmax(np.abs(solution.certificate.primal_residual), np.abs(solution.certificate.gap))
    if not proved:
        raise NotConverged("the certificate does not close: lost to rounding", float(np.max(left)))


def _files(solution: Any, plot: File, record: File) -> None:
    if (plot or record) and solution.certificate.primal_value == 0 and hasattr(solution, "duration"):
        raise console.refusal("--plot" if plot else "--record", "shows a motion, and the ends agree")
    if plot:
        from pontryagin.triple_integrator.figures import solution_figure

        console.save_figure("--plot", plot, lambda: solution_figure(solution))
    if record:
        from pontryagin.triple_integrator.playback import record_solution

        with console.writing("--record", record):
            record_solution(solution, record)


def _print(solution: Any, json: bool, samples: int) -> None:
    from pontryagin.triple_integrator import transcript

    told: dict[str, Any] = transcript.transcript(solution)
    if not json:
        console.show(transcript.account(solution).title, told)
        return
    if samples:
        told["samples"] = transcript.samples(solution, samples)
    typer.echo(console.to_json(told))


def _solve_batch(chosen: Solver, path: Path, out: str, force: Any) -> None:
    from pontryagin.triple_integrator import batch

    fixed_time = chosen.__code__.co_argcount == 5
    try:
        problems = batch.read(path, fixed_time)
    except (OSError, UnicodeDecodeError) as reason:
        raise console.refusal("--batch", f"cannot read '{path}': {reason}") from None
    except ValueError as reason:
        raise console.refusal("--batch", f"{path}, {reason}") from None
    ends: tuple = problems.stack(batch.START), problems.stack(batch.END)
    if fixed_time:
        tf = problems.columns["tf"]
        ends += problems.columns.get("t0", np.zeros_like(tf)), tf
    solution = _solved(chosen, ends, force)
    console.emit("--out", out, batch.to_csv(problems, solution))
    _require_proof(solution)
