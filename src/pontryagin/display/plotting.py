"""The style of all figures, and saving the figures and tables of a notebook.

A figure function belongs to a paper, is decorated with `styled`, and returns a Matplotlib figure. The
notebook passes it to `show`, which writes ``figures/<notebook>/<name>.svg`` and displays the same picture.
`show_table` does the same for a table, as ``figures/<notebook>/<name>.csv``.
"""

import functools
import io
import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, ParamSpec

import matplotlib as mpl
from cycler import cycler
from matplotlib.figure import Figure

from pontryagin.display.tables import (
    Columns,
    csv_table,
    markdown_table,
)
from pontryagin.errors import ArgumentValueError
from pontryagin.io import files

P = ParamSpec("P")

BLUE, ORANGE, GREEN, RED = "#0072B2", "#E69F00", "#009E73", "#D55E00"
PURPLE, SKY, INK, GREY = "#CC79A7", "#56B4E9", "#222222", "#888888"
PALETTE = (BLUE, RED, GREEN, PURPLE, ORANGE, SKY, INK)
"""Okabe and Ito's colours, which readers of every colour vision tell apart; GREY is for what is secondary."""

SEQUENTIAL = "cividis"
"""Colour map of quantities that grow from a least value."""

WIDTH = 6.8
"""Width of a figure in inches: the text column of the report."""

STYLE: dict[Any, Any] = {
    "figure.figsize": (WIDTH, 3.4),
    "figure.constrained_layout.use": True,
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "savefig.bbox": "standard",
    "svg.hashsalt": "pontryagin",
    "svg.fonttype": "path",
    "font.family": "STIXGeneral",
    "mathtext.fontset": "stix",
    "font.size": 10.5,
    "axes.titlesize": 10.5,
    "axes.labelsize": 10.5,
    "xtick.labelsize": 9.5,
    "ytick.labelsize": 9.5,
    "legend.fontsize": 9.5,
    "axes.prop_cycle": cycler(color=PALETTE),
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": "#555555",
    "axes.labelcolor": INK,
    "axes.linewidth": 0.8,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.formatter.use_mathtext": True,
    "axes.unicode_minus": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.6,
    "lines.markersize": 4.5,
    "patch.linewidth": 0.8,
    "xtick.color": INK,
    "ytick.color": INK,
    "legend.frameon": False,
    "image.cmap": SEQUENTIAL,
}
"""Matplotlib's settings for the figures of all papers."""

_NAME = re.compile(r"[a-z0-9]+([-_.][a-z0-9]+)*")


def apply_style() -> None:
    """Set `STYLE` for everything that this process draws from now on."""
    mpl.rcParams.update(STYLE)


def styled(draw: Callable[P, Figure]) -> Callable[P, Figure]:
    """Decorate a figure function: it draws with `STYLE`, whatever the caller's settings are.

    The figure's label is the function's name; `show` and `save` name the file after it.

    Examples
    --------
    >>> @styled
    ... def dual_function() -> Figure:
    ...     figure = Figure()
    ...     figure.subplots().plot([0, 1], [0, 1])
    ...     return figure
    >>> dual_function().get_label()
    'dual-function'
    """

    @functools.wraps(draw)
    def styled_draw(*args: P.args, **kwargs: P.kwargs) -> Figure:
        with mpl.rc_context(STYLE):
            figure = draw(*args, **kwargs)
        if not figure.get_label():
            figure.set_label(draw.__name__.replace("_", "-"))
        return figure

    return styled_draw


def subplots(rows: int = 1, columns: int = 1, height: float = 3.4, **options: Any) -> tuple[Figure, Any]:
    """A figure as wide as the report's column, and its axes; pyplot does not keep it open.

    Parameters
    ----------
    rows, columns : int
        Grid of axes.
    height : float
        Height in inches.
    **options
        Passed to `matplotlib.figure.Figure.subplots` (``sharex``, ``width_ratios``, ...).

    Returns
    -------
    figure, axes
        One Axes, or an array of them.

    Examples
    --------
    >>> figure, axes = subplots(2, sharex=True, height=4.0)
    >>> axes.shape, float(figure.get_figheight())
    ((2,), 4.0)
    """
    figure = Figure(figsize=(WIDTH, height), layout="constrained")
    return figure, figure.subplots(rows, columns, **options)


def svg_of(figure: Figure) -> str:
    """The figure as SVG; the same figure gives the same bytes."""
    drawn = io.StringIO()
    with mpl.rc_context(STYLE):
        figure.savefig(drawn, format="svg", metadata={"Date": None, "Creator": None})
    return re.sub(r"[ \t]+$", "", drawn.getvalue(), flags=re.MULTILINE)


def save(figure: Figure, notebook: str, name: str | None = None) -> Path:
    """Write ``figures/<notebook>/<name>.svg``.

    Parameters
    ----------
    figure : Figure
        What to write.
    notebook : str
        File name of the notebook without its ending.
    name : str, optional
        Lower-case name of the file without ending; by default the figure's label.

    Raises
    ------
    ValueError
        When `name` or `notebook` is no valid file name.
    """
    path = _place(notebook, _name_of(figure, name), ".svg")
    files.write(path, svg_of(figure))
    return path


def save_table(columns: Columns, notebook: str, name: str) -> Path:
    """Write ``figures/<notebook>/<name>.csv``, numbers with twelve digits.

    Parameters
    ----------
    columns : mapping of str to sequences of one length
        Heading and entries of each column.
    notebook, name : str
        Folder and file.

    Raises
    ------
    ValueError
        When the columns differ in length or a name is no valid file name.
    """
    path = _place(notebook, name, ".csv")
    files.write(path, csv_table(columns))
    return path


def show(figure: Figure, name: str | None = None, caption: str | None = None) -> None:
    """Save a notebook's figure and display it.

    The file is written if the notebook is known, as in ``make report``, ``make figures`` and JupyterLab.
    Otherwise the figure is only displayed.

    Parameters
    ----------
    figure : Figure
        What a figure function returned.
    name : str, optional
        Name of the file, unique in the notebook; by default the figure's label.
    caption : str, optional
        Caption of the figure; Markdown with formulas ``$...$``.
    """
    name, drawn, notebook = _name_of(figure, name), svg_of(figure), current_notebook()
    if notebook:
        files.write(_place(notebook, name, ".svg"), drawn)
    _display({"image/svg+xml": drawn}, "figure", notebook, name, caption)


def show_table(columns: Columns, name: str, caption: str | None = None) -> None:
    """Save a notebook's table and display it; headings and texts are Markdown with formulas ``$...$``.

    Parameters
    ----------
    columns : mapping of str to sequences of one length
        Heading and entries of each column.
    name, caption
        As in `show`.
    """
    notebook = current_notebook()
    if notebook:
        save_table(columns, notebook, name)
    _display({"text/markdown": markdown_table(columns)}, "table", notebook, name, caption)


def current_notebook() -> str | None:
    """Name of the notebook that this kernel executes, or None if its environment does not tell."""
    path = os.environ.get("PONTRYAGIN_NOTEBOOK") or os.environ.get("JPY_SESSION_NAME")
    return Path(path).stem if path else None


def _display(data: dict[str, str], kind: str, notebook: str | None, name: str, caption: str | None) -> None:
    from IPython.display import display

    caption = caption or name.replace("-", " ").replace("_", " ").capitalize() + "."
    kept = {"kind": kind, "notebook": notebook, "name": name, "caption": caption}
    display({**data, "text/plain": caption}, metadata={"pontryagin": kept}, raw=True)  # type: ignore[no-untyped-call]


def _name_of(figure: Figure, name: str | None) -> str:
    chosen = name or str(figure.get_label())
    if not chosen:
        raise ArgumentValueError(
            "name: got none, and the figure has no label in its place; takes a lower-case name", "name"
        )
    return chosen


def _place(notebook: str, name: str, ending: str) -> Path:
    for argument, value in (("notebook", notebook), ("name", name)):
        if not _NAME.fullmatch(value):
            takes = "lower-case letters, digits, '-', '_' and '.'"
            raise ArgumentValueError(f"{argument}: got {value!r}; takes {takes}", argument)
    return files.figures_folder() / notebook / (name + ending)
