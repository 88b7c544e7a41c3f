"""``pontryagin solve rendezvous``: a case of the report, or problems from a file."""

from pathlib import Path
from typing import Annotated, Any

import typer

from pontryagin.io import files, rows
from pontryagin.terminal import bar, console
from pontryagin.terminal.console import File, Json, Out, Text


def solve(
    case: Annotated[
        Text, typer.Option(metavar="NAME", help="One of the report's cases, which --list prints.")
    ] = None,
    file: Annotated[
        File, typer.Option(metavar="FILE", help="Solve the problem of a JSON file; - is standard input.")
    ] = None,
    listed: Annotated[bool, typer.Option("--list", help="Print the cases and solve none.")] = False,
    json: Json = False,
    samples: Annotated[
        int, typer.Option(metavar="N", min=0, help="With --json: adds state, costate and control at N times.")
    ] = 0,
    plot: Annotated[
        File, typer.Option(metavar="FILE", help="Draw orbit, thrust, |n| and H, as .svg, .pdf or .png.")
    ] = None,
    record: Annotated[
        File, typer.Option(metavar="FILE", help="Record the flight for rerun, as .rrd.")
    ] = None,
    batch: Annotated[
        File,
        typer.Option(
            metavar="FILE", help="CSV file, or -, with one problem in each row, in place of --file."
        ),
    ] = None,
    out: Out = "-",
) -> None:
    """Meet a target on a Kepler orbit under low thrust, at the least cost of time and thrust.

    The best extremal found is printed with its certificate, the other extremals found, and the extent of the
    search. After Ctrl-C that is the best one so far, marked as such, and the exit code is 130.

    A file for --file is a JSON object like this one; angles are in radians, and a number may be a text such
    as "20*pi/180":

    \b
      {"chaser": {"r": 1, "v1": 0, "c": 1, "attitude": [1, 0, 0, 0]},
       "target": {"parameter": 1.5, "eccentricity": 0.1, "anomaly": 0.6,
                  "node": 0, "inclination": "20*pi/180", "pericentre": 0},
       "time_weight": 0, "energy_weight": 1, "peak": "inf", "gravity": 1, "duration": 9}

    An orbit may have "attitude", its quaternion with the scalar part first, in place of the three angles; the
    chaser may be given like the target, and is then on that orbit at its anomaly. By default time_weight is
    1, energy_weight 0 and gravity 1; the duration is free, which may be written as null. The problem that
    --json prints is such an object.

    A CSV file for --batch has a column for each key, such as peak, chaser.r, target.inclination and
    target.attitude_1 to target.attitude_4, and any others, which are kept. An empty cell is a key left out.
    Each row comes back with its best extremal.

    \b
    Examples:
      pontryagin solve rendezvous --list
      pontryagin solve rendezvous --case circle-energy
      pontryagin solve rendezvous --case circle-energy --json --samples 101
      pontryagin solve rendezvous --file problem.json --plot thrust.svg --record flight.rrd
      pontryagin solve rendezvous --batch problems.csv --out flights.csv
    """
    single = {"--case": case, "--file": file, "--samples": samples, "--plot": plot, "--record": record}
    if listed:
        console.excluded("--list", single | {"--batch": batch})
        _list(json)
        return
    if batch is not None:
        console.excluded("--batch", single)
        _solve_batch(batch, out, json)
        return
    console.together({"--samples": samples}, "--json", json)
    console.file_names(plot, record, out)
    problem = _problem(case, file)
    extremal, unfinished = _solved(problem, "--case" if file is None else "--file")
    _files(extremal, plot, record)
    from pontryagin.rendezvous import transcript

    report = transcript.transcript(extremal)
    sampled = {"samples": transcript.samples(extremal, samples)} if samples else {}
    conclusion = transcript.conclusion(report)
    console.answer(json, _title(problem, case), report | sampled, conclusion, transcript.table(report))
    if unfinished:
        raise console.interrupted("the best extremal found so far is printed")


def _list(json: bool) -> None:
    from pontryagin.rendezvous.problem.cases import cases

    titles = {name: one.title for name, one in cases().items()}
    console.answer(json, "Cases of the report", {"cases": titles}, "--case NAME solves one of them.")


def _problem(case: Text, file: File) -> Any:
    from pontryagin.rendezvous import schema
    from pontryagin.rendezvous.problem.cases import cases

    if file is None:
        if case is None:
            raise console.Refusal("--case", "or --file must be given")
        known = cases()
        if case not in known:
            raise console.Refusal("--case", f"takes {', '.join(known)}, got {case!r}")
        return known[case].problem
    console.excluded("--file", {"--case": case is not None})
    with console.reading("--file", file), console.solving({}), files.reading(file) as text:
        return schema.read(text.read())


def _solved(problem: Any, option: str) -> tuple[Any, bool]:
    """The best extremal found, and whether its search was interrupted."""
    from pontryagin.errors import Infeasible, NotConverged
    from pontryagin.rendezvous.reduced.solve import solve as solve_problem

    unfinished = False
    with console.solving({}):
        try:
            with bar.shown():
                extremal = solve_problem(problem)
        except KeyboardInterrupt as stop:
            if not stop.args:
                raise console.interrupted("no extremal was found so far") from None
            (extremal,), unfinished = stop.args, True
        except Infeasible as reason:
            if problem.free and not problem.time_weight:
                raise console.Refusal(option, f": {reason}") from reason
            raise
        if not extremal.certificate.holds():
            raise NotConverged(
                "the certificate does not hold: its residual is too large",
                float(extremal.certificate.residual),
            )
    return extremal, unfinished


def _solve_batch(path: Path, out: str, json: bool) -> None:
    from pontryagin.rendezvous import schema, transcript
    from pontryagin.terminal import batches

    def solved(block: rows.Rows) -> tuple[dict[str, Any], None]:
        problem = schema.of_row(dict(zip(block.header, block.rows[0], strict=True)))
        extremal, unfinished = _solved(problem, "--batch")
        if unfinished:
            raise KeyboardInterrupt
        return transcript.answers(extremal), None

    # A search takes long: one problem in each block, so that Ctrl-C finds those before it done.
    batches.run(path, out, rows.blocks(path, [], size=1), solved, json)


def _title(problem: Any, case: Text) -> str:
    if case is not None:
        from pontryagin.rendezvous.problem.cases import cases

        return f"Rendezvous {case!r}: {cases()[case].title}"
    if not problem.energy_weight:
        return "Rendezvous in the least time"
    if not problem.time_weight or not problem.free:
        return f"Rendezvous with the least energy in the time {problem.duration:.6g}"
    return "Rendezvous at the least cost of time and energy"


def _files(extremal: Any, plot: File, record: File) -> None:
    if plot:
        from pontryagin.rendezvous.figures.profile import profile

        console.save_figure("--plot", plot, profile(extremal))
    if record:
        from pontryagin.rendezvous.playback import record_extremal

        console.save_recording("--record", record, lambda path: record_extremal(extremal, path))
