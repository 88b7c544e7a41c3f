"""Recordings that replay in 3-D, written from arrays: a small layer over rerun.

A recording holds curves, bodies, arrows, ellipsoids and paths on one timeline, and its own layout. Times are
in the problem's units (dimensionless unless the paper says otherwise) and are shown as seconds. Attitudes are
unit quaternions, scalar part first, that rotate body axes into the axes of the scene.

    with record(path, "turn", [[Scene("the turn", "turn")], [Plot("angle", "angle")]]) as recording:
        recording.body("turn/craft", t, attitude, size=(2.0, 1.2, 0.6))
        recording.curve("angle/energy", t, angle, "least energy", plotting.BLUE)
        recording.event("events", 0.5, "impulse 3.2")
"""

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from matplotlib.colors import to_rgb
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.display.views import TIMELINE, blueprint
from pontryagin.display.views import Events as Events
from pontryagin.display.views import Plot as Plot
from pontryagin.display.views import Point as Point
from pontryagin.display.views import Scene as Scene
from pontryagin.display.views import View as View
from pontryagin.errors import ArgumentValueError
from pontryagin.io import files

_CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
_FACES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
_SHADES = (0.55, 1.0, 0.65, 0.9, 0.5, 0.8)


class Recording:
    """An open recording, from `record`; each method writes one entity for all times at once.

    Times are (k,) in increasing order. Arrays of another shape, or with entries that are not finite, raise
    `ValueError`.
    """

    def __init__(self, stream: Any) -> None:
        self._rr = _rerun()
        self._stream = stream

    def curve(self, entity: str, t: ArrayLike, values: ArrayLike, name: str, colour: str) -> None:
        """A curve of `values` (k,) over `t` (k,) with a `name` for the legend and a Matplotlib `colour`."""
        style = self._rr.SeriesLines(colors=[_rgb(colour)], names=[name], widths=[2.0])
        self._stream.log(entity, style, static=True)
        times = _times(t)
        scalars = _array("values", values, (times.size,))
        self._send(entity, times, self._rr.Scalars.columns(scalars=scalars))

    def body(
        self,
        entity: str,
        t: ArrayLike,
        attitude: ArrayLike,
        size: ArrayLike,
        position: ArrayLike | None = None,
        colour: str = "#8fa3b8",
    ) -> None:
        """A box with edges `size` (3,), `attitude` (k, 4) with the scalar first, centre `position` (k, 3)."""
        times = _times(t)
        quaternions = _array("attitude", attitude, (times.size, 4))
        moves = {"quaternion": np.roll(quaternions, -1, axis=-1)}
        if position is not None:
            moves["translation"] = _array("position", position, (times.size, 3))
        self._send(entity, times, self._rr.Transform3D.columns(**moves))
        self._stream.log(entity, self._box(_array("size", size, (3,)), colour), static=True)

    def arrow(
        self,
        entity: str,
        t: ArrayLike,
        vector: ArrayLike,
        colour: str,
        origin: ArrayLike | None = None,
        label: str = "",
    ) -> None:
        """An arrow `vector` (k, 3) from `origin` (k, 3), by default the origin of its parent entity."""
        times = _times(t)
        vectors = _array("vector", vector, (times.size, 3))
        origins = np.zeros_like(vectors) if origin is None else _array("origin", origin, (times.size, 3))
        look = self._rr.Arrows3D.from_fields(colors=[_rgb(colour)], labels=[label] if label else None)
        self._stream.log(entity, look, static=True)
        self._send(entity, times, self._rr.Arrows3D.columns(vectors=vectors, origins=origins))

    def ellipsoid(
        self,
        entity: str,
        t: ArrayLike,
        semiaxes: ArrayLike,
        centre: ArrayLike,
        attitude: ArrayLike,
        colour: str,
    ) -> None:
        """An ellipsoid with `semiaxes` (k, 3), `centre` (k, 3) and the `attitude` (k, 4) of its axes."""
        times = _times(t)
        look = self._rr.Ellipsoids3D.from_fields(
            colors=[_rgb(colour)], fill_mode=self._rr.components.FillMode.MajorWireframe
        )
        self._stream.log(entity, look, static=True)
        columns = self._rr.Ellipsoids3D.columns(
            half_sizes=_array("semiaxes", semiaxes, (times.size, 3)),
            centers=_array("centre", centre, (times.size, 3)),
            quaternions=np.roll(_array("attitude", attitude, (times.size, 4)), -1, axis=-1),
        )
        self._send(entity, times, columns)

    def path(self, entity: str, points: ArrayLike, colour: str, radius: float = 0.0) -> None:
        """A line through `points` (k, 3), shown at all times; with `radius` 0 it is 1.5 pixels wide."""
        strip = _array("points", points, (len(np.asarray(points)), 3))
        width = radius if radius > 0 else self._rr.Radius.ui_points(1.5)
        self._stream.log(
            entity, self._rr.LineStrips3D([strip], colors=[_rgb(colour)], radii=[width]), static=True
        )

    def trail(self, entity: str, t: ArrayLike, points: ArrayLike, colour: str, width: float = 2.0) -> None:
        """A line through `points` (k, 3) up to the present; the `Scene` must list `entity` in its trails."""
        times = _times(t)
        vertices = _array("points", points, (times.size, 3))
        pieces = np.stack([vertices[:-1], vertices[1:]], axis=1)
        self._lines(entity, colour, width)
        self._send(entity, times[1:], self._rr.LineStrips3D.columns(strips=pieces))

    def net(self, entity: str, t: ArrayLike, strips: ArrayLike, colour: str, width: float = 0.7) -> None:
        """Moving lines: `strips` (k, lines, points, 3), `width` in pixels."""
        times = _times(t)
        shape = np.asarray(strips).shape
        moving = _array("strips", strips, (times.size, *shape[1:3], 3))
        self._lines(entity, colour, width)
        columns = self._rr.LineStrips3D.columns(strips=moving.reshape(-1, *shape[2:]))
        self._send(entity, times, columns.partition([shape[1]] * times.size))

    def event(self, entity: str, t: float, text: str) -> None:
        """A line of text at the instant `t`."""
        self._stream.set_time(TIMELINE, duration=float(t))
        self._stream.log(entity, self._rr.TextLog(text))

    def _lines(self, entity: str, colour: str, width: float) -> None:
        look = self._rr.LineStrips3D.from_fields(
            colors=[_rgb(colour)], radii=[self._rr.Radius.ui_points(width)]
        )
        self._stream.log(entity, look, static=True)

    def _send(self, entity: str, times: Array, columns: Any) -> None:
        self._stream.send_columns(
            entity, indexes=[self._rr.TimeColumn(TIMELINE, duration=times)], columns=columns
        )

    def _box(self, size: Array, colour: str) -> Any:
        base = np.array(_rgb(colour), dtype=float)
        vertices = np.concatenate([_CORNERS[list(face)] for face in _FACES]) * size / 2
        halves = np.array([(0, 1, 2), (0, 2, 3)])
        triangles = np.concatenate([4 * face + halves for face in range(len(_FACES))])
        colours = np.repeat([base * shade for shade in _SHADES], 4, axis=0).astype(np.uint8)
        return self._rr.Mesh3D(vertex_positions=vertices, triangle_indices=triangles, vertex_colors=colours)


@contextmanager
def record(
    path: Path,
    name: str,
    columns: Sequence[Sequence[View]],
    speed: float = 1.0,
    shares: Sequence[float] | None = None,
) -> Iterator[Recording]:
    """Write a recording to `path`; the file appears when the block ends without an error.

    Parameters
    ----------
    path : Path
        File to write, ending in ``.rrd``.
    name : str
        Name of the recording in the viewer.
    columns : sequence of sequences of View
        The layout: columns from left to right, each with its panels from top to bottom.
    speed : float
        Units of time that pass in each second of the replay.
    shares : sequence of float, optional
        Relative widths of the columns; equal by default.

    Yields
    ------
    Recording

    Raises
    ------
    RuntimeError
        When rerun is not installed.
    OSError
        When the file cannot be written whole.

    Examples
    --------
    >>> import tempfile
    >>> target = Path(tempfile.mkdtemp()) / "line.rrd"
    >>> with record(target, "a line", [[Plot("position", "position")]]) as recording:
    ...     recording.curve("position/x", [0.0, 1.0], [0.0, 2.0], "x", "#0072B2")
    >>> read_back(target)["/position/x"]["scalars"].tolist()
    [0.0, 2.0]
    """
    rr = _rerun()
    with files.replacing(Path(path)) as draft:
        draft.touch()  # Where nothing can be written, this is known before the recording is made.
        # rerun's own writer neither tells where the disk becomes full, nor always ends then.
        with rr.RecordingStream("pontryagin", recording_id=name) as stream:
            memory = stream.memory_recording()
            # The viewer meets the recording first, and would keep the layout that it made up by then.
            stream.send_blueprint(blueprint(columns, speed, shares), make_active=True)
            yield Recording(stream)
            draft.write_bytes(memory.drain_as_bytes())
        stream.disconnect()


def read_back(path: Path) -> dict[str, dict[str, NDArray[Any]]]:
    """The arrays in a recording: entity -> {"time": (k,), component: (k, ...)}.

    Components have rerun's names: ``scalars``, ``quaternion`` (scalar first), ``translation``, ``vectors``,
    ``text`` and so on. Lengths and attitudes are in single precision, curves in double. Components that
    are shown at all times have length 1, or their entity has no ``time``.

    Parameters
    ----------
    path : Path
        A file that `record` wrote.
    """
    _rerun()
    from rerun.chunk import RrdReader

    entities: dict[str, dict[str, list[NDArray[Any]]]] = {}
    for chunk in RrdReader(str(path)).stream().to_chunks():
        if chunk.entity_path.startswith("/__"):
            continue
        batch = chunk.to_record_batch()
        parts = entities.setdefault(chunk.entity_path, {})
        for column in batch.schema.names:
            if column == TIMELINE:
                parts.setdefault("time", []).append(_seconds(batch[column]))
            elif ":" in column:
                component = column.split(":")[1]
                parts.setdefault(component, []).append(_values(component, batch[column]))
    return {entity: _joined(parts) for entity, parts in entities.items()}


def _rerun() -> ModuleType:
    os.environ.setdefault("RERUN_ANALYTICS", "0")
    try:
        import rerun
    except ImportError as missing:
        raise RuntimeError(
            "recordings need the package rerun-sdk: pip install 'pontryagin[recording]'"
        ) from missing
    return rerun


def _times(t: ArrayLike) -> Array:
    times = np.asarray(t, dtype=float)
    if times.ndim != 1 or not np.all(np.isfinite(times)) or np.any(np.diff(times) < 0):
        raise ArgumentValueError(
            f"t: got shape {times.shape}; takes finite times (k,) in ascending order", "t"
        )
    return times


def _array(argument: str, values: ArrayLike, shape: tuple[int, ...]) -> Array:
    array = np.asarray(values, dtype=float)
    if array.shape != shape or not np.all(np.isfinite(array)):
        raise ArgumentValueError(
            f"{argument}: got shape {array.shape}; takes finite numbers of shape {shape}", argument
        )
    return array


def _rgb(colour: str) -> list[int]:
    return [round(255 * part) for part in to_rgb(colour)]


def _joined(parts: dict[str, list[NDArray[Any]]]) -> dict[str, NDArray[Any]]:
    arrays = {component: np.concatenate(pieces) for component, pieces in parts.items()}
    if "time" not in arrays:
        return arrays
    order = np.argsort(arrays["time"], kind="stable")
    return {c: values[order] if len(values) == order.size else values for c, values in arrays.items()}


def _seconds(column: Any) -> Array:
    return np.asarray(column.cast("int64"), dtype=np.int64) / 1e9


def _values(component: str, column: Any) -> NDArray[Any]:
    values = np.array([row[0] if row is not None and len(row) == 1 else row for row in column.to_pylist()])
    return np.roll(values, 1, axis=-1) if component in ("quaternion", "quaternions") else values
