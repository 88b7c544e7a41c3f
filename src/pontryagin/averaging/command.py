"""``pontryagin solve averaging``: the paper's examples, averaged and exact, from the command line."""

from pathlib import Path
from typing import Annotated, Any

import typer

from pontryagin.averaging import schema, transcript
from pontryagin.averaging.schema import EXAMPLES, ExampleSchema
from pontryagin.io import rows
from pontryagin.terminal import bar, console
from pontryagin.terminal.console import File, Json, Out, Text


def solve(
    example: Annotated[
        str | None,
        typer.Option(metavar="kepler|smooth|rotor|spin-down", help="Which of the paper's examples."),
    ] = None,
    E0: Annotated[Text, typer.Option("--E0", metavar="E", help="kepler: energy at the start.")] = None,
    K0: Annotated[
        Text, typer.Option("--K0", metavar="K", help="kepler: angular momentum at the start.")
    ] = None,
    E1: Annotated[Text, typer.Option("--E1", metavar="E", help="kepler: energy at the end.")] = None,
    l: Annotated[Text, typer.Option("--l", metavar="L", help="kepler: price of a unit of slow time.")] = None,
    v0: Annotated[Text, typer.Option("--v0", metavar="V", help="smooth: speed at the start.")] = None,
    v1: Annotated[Text, typer.Option("--v1", metavar="V", help="smooth: speed at the end.")] = None,
    ripple: Annotated[
        Text,
        typer.Option(metavar="R", help="smooth: amplitude of the force R cos x; 0 unless given."),
    ] = None,
    a0: Annotated[Text, typer.Option("--a0", metavar="A", help="rotor: energy at the start.")] = None,
    a1: Annotated[Text, typer.Option("--a1", metavar="A", help="rotor: energy at the end.")] = None,
    mass: Annotated[
        Text, typer.Option(metavar="M", help="rotor: m(x), a formula in x; 1 unless given.")
    ] = None,
    potential: Annotated[
        Text, typer.Option(metavar="V", help="rotor: V(x), a formula in x; 0 unless given.")
    ] = None,
    force: Annotated[
        Text, typer.Option(metavar="F", help="rotor: f(x, v), v the rate x'; 0 unless given.")
    ] = None,
    peak: Annotated[Text, typer.Option(metavar="U", help="rotor: bound on |u|, for the least time.")] = None,
    k: Annotated[
        Text,
        typer.Option(
            "--k",
            metavar="K",
            help="rotor, smooth: cost of a unit of slow time, added to u^2; smooth: 1 unless given.",
        ),
    ] = None,
    omega0: Annotated[
        Text,
        typer.Option("--omega0", metavar="X,Y,Z", help="spin-down: angular velocity, body axes."),
    ] = None,
    semiaxes: Annotated[
        Text, typer.Option(metavar="X,Y,Z", help="spin-down: semiaxes of the ellipsoid of controls.")
    ] = None,
    ratio: Annotated[
        Text,
        typer.Option(metavar="D", help="spin-down: ratio I_z/I_x of the moments of inertia, other than 1."),
    ] = None,
    epsilon: Annotated[
        Text,
        typer.Option(metavar="EPS", help="Small parameter; adds the exact extremals and the correction."),
    ] = None,
    phase: Annotated[
        Text, typer.Option(metavar="PSI", help="With --epsilon: phase at the start; 0 unless given.")
    ] = None,
    json: Json = False,
    plot: Annotated[
        File, typer.Option(metavar="FILE", help="Draw slow variables and control, as .svg, .pdf or .png.")
    ] = None,
    record: Annotated[
        File, typer.Option(metavar="FILE", help="With --epsilon: record the motion for rerun, as .rrd.")
    ] = None,
    batch: Annotated[
        File, typer.Option(metavar="FILE", help="CSV file, or -, with one problem in each row.")
    ] = None,
    out: Out = "-",
) -> None:
    """Time-optimal control of nonlinear oscillations: averaged and, with --epsilon, exact extremals.

    Durations are in slow time, epsilon times t. Numbers may be written like pi/2 or 1e-3; formulas hold their
    variables, pi, + - * / ^ and abs, sign, sqrt, exp, log, sin, cos, tan, sinh, cosh, tanh, asin, acos, atan.
    After Ctrl-C in the search for exact extremals the averaged solution is printed; the exit code is 130.

    A CSV file for --batch has a column for each number of the example that is not given as an option
    (omega_x, omega_y, omega_z for --omega0, l_x, l_y, l_z for --semiaxes) and any others, which are kept;
    with --epsilon each row also gets the corrected cost, but no exact extremals are computed.

    \b
    Examples:
      pontryagin solve averaging --example kepler --E0 -0.5 --K0 0.95 --E1 -0.35 --l 0.1 --epsilon 0.05
      pontryagin solve averaging --example smooth --v0 1 --v1 2 --ripple 0.5 --epsilon 0.1 --plot speed.svg
      pontryagin solve averaging --example rotor --a0 2 --a1 4 --potential "cos(x)" --force "-v/5" --k 1
      pontryagin solve averaging --example spin-down --omega0 3,4,2 --semiaxes 1,1,0.5 --ratio 0.5 --json
      pontryagin solve averaging --example kepler --l 0.1 --batch orbits.csv --out costs.csv
    """
    given = {
        "E0": E0,
        "K0": K0,
        "E1": E1,
        "l": l,
        "v0": v0,
        "v1": v1,
        "ripple": ripple,
        "a0": a0,
        "a1": a1,
        "mass": mass,
        "potential": potential,
        "force": force,
        "peak": peak,
        "k": k,
        "omega0": omega0,
        "semiaxes": semiaxes,
        "ratio": ratio,
    }
    chosen = _chosen(example, given, phase)
    console.together({"--phase": phase, "--record": record}, "--epsilon", epsilon is not None)
    small = None if epsilon is None else console.positive("--epsilon", epsilon)
    start = None if phase is None else console.number("--phase", phase)
    if batch is not None:
        console.excluded("--batch", {"--plot": plot, "--record": record})
        _solve_batch(chosen, given, batch, out, json, small, start)
        return
    console.file_names(plot, record, out)
    values = chosen.read(given)
    solution = schema.solve(chosen, values)
    exact, unfinished = (None, False) if small is None else _exact(solution, small, start)
    if not unfinished:
        _files(solution, exact, plot, record)
    settings = {"epsilon": small, "phase": start}
    problem = {"example": example} | values | {n: v for n, v in settings.items() if v is not None}
    report = transcript.transcript(problem, solution, small, start, exact)
    console.answer(json, chosen.title, report, transcript.conclusion(report), transcript.shown(report))
    if unfinished:
        raise console.interrupted("the averaged solution alone is printed")


def _chosen(example: str | None, given: schema.Given, phase: str | None) -> ExampleSchema:
    console.required({"--example": example})
    if example not in EXAMPLES:
        raise console.Refusal("--example", f"takes {', '.join(EXAMPLES)}, got {example!r}")
    chosen = EXAMPLES[str(example)]
    foreign = {schema.option(name): text for name, text in given.items() if name not in chosen.options}
    console.excluded(f"--example {example}", foreign | ({} if chosen.phase else {"--phase": phase}))
    return chosen


def _exact(solution: Any, epsilon: float, phase: float | None) -> tuple[Any, bool]:
    """The exact extremals, None if their search was interrupted, and whether it was."""
    with console.solving({"epsilon": "--epsilon", "phase": "--phase"}):
        try:
            with bar.shown():
                return solution.exact(epsilon, phase), False
        except KeyboardInterrupt:
            return None, True


def _files(solution: Any, exact: Any, plot: File, record: File) -> None:
    if (plot or record) and not float(solution.duration) > 0:
        raise console.Refusal(
            "--plot" if plot else "--record", "needs a motion, but the start already meets the target"
        )
    if plot:
        from pontryagin.averaging.figures.drift import drift

        console.save_figure("--plot", plot, drift(solution, exact[0] if exact else None))
    if record:
        from pontryagin.averaging.playback import record_solution

        console.save_recording("--record", record, lambda path: record_solution(solution, exact[0], path))


def _solve_batch(
    chosen: ExampleSchema,
    given: schema.Given,
    path: Path,
    out: str,
    json: bool,
    epsilon: float | None,
    phase: float | None,
) -> None:
    from pontryagin.terminal import batches

    shared = [schema.option(name) for name, text in given.items() if text is not None]

    def solved(block: rows.Rows) -> tuple[dict[str, Any], None]:
        values = chosen.of_block(given, block)
        solution = schema.solve(chosen, values)
        if epsilon is not None and "peak" in values:
            raise console.Refusal(
                "--epsilon",
                "cannot be combined with --batch and --peak: "
                "the correction then depends on the angle at the end",
            )
        return transcript.answers(solution, epsilon, phase), None

    shared += ["--epsilon", "--phase"]
    settings = (chosen, sorted(given.items()), epsilon, phase)
    batches.run(path, out, chosen.stacks(given, path), solved, json, shared, settings)
