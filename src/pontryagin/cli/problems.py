"""The papers' commands below ``pontryagin solve``, each imported when it is called."""

from typing import Any

import typer
from typer.core import TyperGroup
from typer.main import get_command

from pontryagin import papers


class Problems(TyperGroup):
    """The commands of all papers; a paper's command imports its solvers inside its function ``solve``."""

    def list_commands(self, ctx: Any) -> list[str]:
        """Names in the order of the chapters."""
        return list(papers.commands())

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """The command of a paper, imported now; None if there is no such paper."""
        package = papers.commands().get(cmd_name)
        if package is None:
            return None
        one = typer.Typer(add_completion=False, rich_markup_mode=None)
        one.command(cmd_name)(papers.room(package, "command").solve)
        return get_command(one)
