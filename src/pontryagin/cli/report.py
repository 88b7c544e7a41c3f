"""``pontryagin report``: executing the notebooks and building the report in a checkout."""

from typing import Annotated

import typer

from pontryagin.terminal import console


def report(
    stage: Annotated[
        str,
        typer.Argument(
            metavar="[STAGE]", help="The last stage to make: notebooks, figures, recordings or report."
        ),
    ] = "report",
    workers: Annotated[
        int, typer.Option(metavar="N", min=1, help="Number of notebooks or recordings made at the same time.")
    ] = 2,
) -> int:
    """Execute the notebooks and build the report, in a checkout of the project.

    \b
    Example:
      pontryagin report figures
    """
    try:
        from pontryagin.report import build
    except ModuleNotFoundError as missing:
        needs = f"the report needs {missing.name}, which is not installed: pip install 'pontryagin[report]'"
        raise typer.TyperException(needs) from missing
    if stage not in build.STAGES:
        raise console.Refusal("STAGE", f"takes {', '.join(build.STAGES)}, got {stage!r}")
    try:
        return build.main([stage, "--workers", str(workers)])
    except ValueError as reason:
        raise typer.TyperException(str(reason)) from reason
