"""The layout of a recording: its panels and their settings when it is opened."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from pontryagin.errors import ArgumentTypeError

TIMELINE = "time"

Point = tuple[float, float, float]


@dataclass(frozen=True)
class View:
    """A panel of the layout.

    Attributes
    ----------
    title : str
        Title of the panel.
    entity : str
        The entity that it shows, with all entities below it.
    share : float
        Height relative to the other panels of the column.
    """

    title: str
    entity: str
    share: float = field(default=1.0, kw_only=True)


@dataclass(frozen=True)
class Scene(View):
    """Bodies, arrows, ellipsoids and paths in 3-D.

    Attributes
    ----------
    title, entity, share
        As in `View`.
    eye : (Point, Point), optional
        Initial position of the eye and the point it looks at; by default rerun chooses.
    trails : tuple of str
        Entities that are shown for all times up to the present, as `Recording.trail` writes them.
    grid : bool
        Whether a grid is drawn on the floor.
    """

    eye: tuple[Point, Point] | None = None
    trails: tuple[str, ...] = field(default=(), kw_only=True)
    grid: bool = field(default=True, kw_only=True)


@dataclass(frozen=True)
class Plot(View):
    """Curves against time.

    Attributes
    ----------
    title, entity, share
        As in `View`.
    span : (lowest, highest), optional
        Limits of the vertical axis; by default rerun chooses them, and magnifies the noise of a constant.
    whole : bool
        Whether all times are shown, instead of a window around the present.
    legend : str
        Corner of the legend, as rerun names it.
    """

    span: tuple[float, float] | None = None
    whole: bool = field(default=False, kw_only=True)
    legend: str = field(default="RightTop", kw_only=True)


@dataclass(frozen=True)
class Events(View):
    """A list of events, described in words, in the order of time."""


def blueprint(columns: Sequence[Sequence[View]], speed: float, shares: Sequence[float] | None = None) -> Any:
    """Columns of panels as rerun's blueprint; it plays when opened, `speed` units of time in each second."""
    import rerun.blueprint as rrb

    stacks = [
        rrb.Vertical(*[_panel(view) for view in column], row_shares=[view.share for view in column])
        for column in columns
    ]
    time = rrb.TimePanel(
        timeline=TIMELINE, loop_mode="all", play_state="playing", state="collapsed", playback_speed=speed
    )
    return rrb.Blueprint(rrb.Horizontal(*stacks, column_shares=shares), time, collapse_panels=True)


def _panel(view: View) -> Any:
    import rerun.blueprint as rrb

    place: dict[str, Any] = {"origin": view.entity, "name": view.title}
    match view:
        case Plot(span=span, whole=whole, legend=legend):
            values = None if span is None else rrb.ScalarAxis(range=span, zoom_lock=True)
            everything = rrb.TimeRange(rrb.TimeRangeBoundary.infinite(), rrb.TimeRangeBoundary.infinite())
            times = rrb.TimeAxis(view_range=everything) if whole else None
            return rrb.TimeSeriesView(
                **place, plot_legend=rrb.Corner2D.auto(legend), axis_x=times, axis_y=values
            )
        case Events():
            words = rrb.archetypes.TextLogColumns(text_log_columns=["Body"])
            return rrb.TextLogView(**place, columns=words)
        case Scene(eye=eye, trails=trails, grid=grid):
            past = rrb.VisibleTimeRanges(
                timeline=TIMELINE,
                start=rrb.TimeRangeBoundary.infinite(),
                end=rrb.TimeRangeBoundary.cursor_relative(),
            )
            controls = None
            if eye is not None:
                controls = rrb.EyeControls3D(position=eye[0], look_target=eye[1])
            return rrb.Spatial3DView(
                **place,
                eye_controls=controls,
                overrides=dict.fromkeys(trails, past) or None,
                line_grid=None if grid else False,
            )
    raise ArgumentTypeError(f"columns: a panel must be a Scene, a Plot or Events, got {view!r}", "columns")
