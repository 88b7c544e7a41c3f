"""The layout of a recording: its panels, and how they look when it is opened."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

TIMELINE = "time"

Point = tuple[float, float, float]


@dataclass(frozen=True)
class View:
    """A panel of the layout: its title and the entity whose branch it shows."""

    title: str
    entity: str


@dataclass(frozen=True)
class Scene(View):
    """Bodies, arrows, ellipsoids and paths in 3-D.

    Attributes
    ----------
    trails : tuple of str
        Entities of which everything up to the present is shown, as `Recording.trail` writes them.
    eye : Point, optional
        Where it is first seen from, towards `target`; by default rerun chooses.
    target : Point
    """

    trails: tuple[str, ...] = ()
    eye: Point | None = None
    target: Point = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Plot(View):
    """Curves against time, between the lowest and the highest value of `limits` if they are given."""

    limits: tuple[float, float] | None = None


@dataclass(frozen=True)
class Events(View):
    """Events in words, in the order of time."""


def blueprint(columns: Sequence[Sequence[View]], speed: float) -> Any:
    """Columns of panels as rerun's blueprint, which plays at once, so many units of time a second."""
    import rerun.blueprint as rrb

    stacks = [rrb.Vertical(*[_panel(view) for view in column]) for column in columns]
    time = rrb.TimePanel(
        timeline=TIMELINE, loop_mode="all", play_state="playing", state="collapsed", playback_speed=speed
    )
    return rrb.Blueprint(rrb.Horizontal(*stacks), time, collapse_panels=True)


def _panel(view: View) -> Any:
    import rerun.blueprint as rrb

    place: dict[str, Any] = {"origin": view.entity, "name": view.title}
    match view:
        case Plot(limits=limits):
            axis = None if limits is None else rrb.ScalarAxis(range=limits, zoom_lock=True)
            return rrb.TimeSeriesView(**place, plot_legend=rrb.Corner2D.RightTop, axis_y=axis)
        case Events():
            words = rrb.archetypes.TextLogColumns(text_log_columns=["Body"])
            return rrb.TextLogView(**place, columns=words)
        case Scene(trails=trails, eye=eye, target=target):
            past = rrb.VisibleTimeRanges(
                timeline=TIMELINE,
                start=rrb.TimeRangeBoundary.infinite(),
                end=rrb.TimeRangeBoundary.cursor_relative(),
            )
            controls = None
            if eye is not None:
                controls = rrb.EyeControls3D(
                    kind=rrb.Eye3DKind.Orbital, position=eye, look_target=target, eye_up=(0.0, 0.0, 1.0)
                )
            return rrb.Spatial3DView(
                **place, eye_controls=controls, overrides=dict.fromkeys(trails, past) or None
            )
    raise TypeError(f"columns: a panel must be a Scene, a Plot or Events, got {view!r}")
