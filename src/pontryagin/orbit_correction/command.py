"""``pontryagin solve orbit-correction``: the fewest impulses from the command line."""

from pathlib import Path
from typing import Annotated, Any

import typer

from pontryagin.certificate import Certificate
from pontryagin.io import rows
from pontryagin.orbit_correction import transcript
from pontryagin.terminal import console
from pontryagin.terminal.console import File, Json, Out, Text

ARGUMENTS = {"z0": "--z0", "interval": "--interval", "peak": "--peak"}
"""The command-line option for each argument of `correct` that the solver checks."""


def solve(
    z0: Annotated[
        Text,
        typer.Option(
            "--z0",
            metavar="DR,DVR,DVT",
            help="Deviations of the radius, of the radial and of the transverse speed.",
        ),
    ] = None,
    interval: Annotated[
        str, typer.Option(metavar="DT", help="Time between impulses, in radians of the orbit.")
    ] = "0.25",
    peak: Annotated[
        str, typer.Option(metavar="W", help="Bound on an impulse, in units of the orbit's speed.")
    ] = "0.0035",
    thrust: Annotated[
        str,
        typer.Option(
            metavar="ball|disc|box", help="Set of impulses: ball (as in the paper), disc, or box (a square)."
        ),
    ] = "ball",
    json: Json = False,
    samples: Annotated[
        int, typer.Option(metavar="N", min=0, help="With --json: state and costate at N times.")
    ] = 0,
    plot: Annotated[
        File, typer.Option(metavar="FILE", help="Draw deviations and impulses: .svg, .pdf, .png.")
    ] = None,
    record: Annotated[File, typer.Option(metavar="FILE", help="Record the flight: .rrd for rerun.")] = None,
    batch: Annotated[
        File,
        typer.Option(metavar="FILE", help="CSV file, or -, with one state in each row, instead of --z0."),
    ] = None,
    out: Out = "-",
) -> None:
    """Bring a satellite back to its circular orbit with the fewest impulses, and prove that fewer fail.

    Deviations are in units of the orbit's radius and speed. Numbers may be written like pi/2 or 1e-3.

    A CSV file for --batch has the columns dr, dv_R, dv_T and any others, which are kept; each row comes
    back with its plan and certificate.

    \b
    Examples:
      pontryagin solve orbit-correction --z0 -0.0037787,-0.0039109,0.0141512
      pontryagin solve orbit-correction --z0 0.01,0,0 --interval pi/2 --peak 0.0035 --thrust disc --json
      pontryagin solve orbit-correction --z0 0,0.004,0 --thrust box --plot impulses.svg
      pontryagin solve orbit-correction --batch states.csv --out plans.csv
    """
    engine = _engine(interval, peak, thrust)
    if batch is not None:
        console.excluded("--batch", {"--z0": z0, "--samples": samples, "--plot": plot, "--record": record})
        _solve_batch(batch, out, engine, json)
        return
    console.required({"--z0": z0})
    console.together({"--samples": samples}, "--json", json)
    console.file_names(plot, record, out)
    plan = _planned(console.vector("--z0", str(z0), 3), engine)
    console.require_proof(plan.certificate)
    _files(plan, plot, record)
    report: dict[str, Any] = transcript.transcript(plan)
    if samples:
        report["samples"] = transcript.samples(plan, samples)
    console.answer(json, transcript.TITLES[thrust], report, transcript.conclusion(plan))


def _engine(interval: str, peak: str, thrust: str) -> tuple[float, float, str]:
    if thrust not in transcript.TITLES:
        raise console.Refusal("--thrust", f"takes {', '.join(transcript.TITLES)}, got {thrust!r}")
    return console.positive("--interval", interval), console.positive("--peak", peak), thrust


def _planned(z0: Any, engine: tuple[float, float, str]) -> Any:
    from pontryagin.orbit_correction.plan.correction import correct

    with console.solving(ARGUMENTS):
        return correct(z0, *engine)


def _files(plan: Any, plot: File, record: File) -> None:
    if (plot or record) and not int(plan.impulse_count):
        option = "--plot" if plot else "--record"
        raise console.Refusal(option, "needs a plan with impulses, but this --z0 needs no correction")
    if plot:
        from pontryagin.orbit_correction.figures.impulses import plan_figure

        console.save_figure("--plot", plot, plan_figure(plan))
    if record:
        from pontryagin.orbit_correction.playback import record_plan

        console.save_recording("--record", record, lambda path: record_plan(plan, path))


def _solve_batch(path: Path, out: str, engine: tuple[float, float, str], json: bool) -> None:
    from pontryagin.terminal import batches

    def solved(block: rows.Rows) -> tuple[dict[str, Any], Certificate]:
        plan = _planned(block.stack(transcript.COLUMNS), engine)
        return transcript.answers(plan), plan.certificate

    shared = ("--interval", "--peak")
    batches.run(path, out, rows.blocks(path, transcript.COLUMNS), solved, json, shared, engine)
