"""A rendezvous as a JSON text: read with every mistake named by its key, and written.

::

    {
      "chaser": {"r": 1, "v1": 0, "c": 1, "attitude": [1, 0, 0, 0]},
      "target": {"parameter": 1.5, "eccentricity": 0.1, "anomaly": 0.6,
                 "node": 0, "inclination": "20*pi/180", "pericentre": 0},
      "time_weight": 0.0036,
      "energy_weight": 1,
      "peak": 0.08,
      "gravity": 1,
      "duration": null
    }

The keys are the arguments of `Chaser`, `Orbit`, `Orbit.from_angles` and `Rendezvous`. An orbit has its
``attitude``, or in its place ``node``, ``inclination`` and ``pericentre`` in radians; the chaser may be given
as an orbit too, on which it is at its ``anomaly``. ``peak`` must be there, ``"inf"`` for no bound; the other
keys of the outermost object may be left out and are then 1, 0, 1 and null, a duration left free. A number may
be written as a text, like ``"20*pi/180"``.
"""

import json
import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from pontryagin.io import formula, json_io
from pontryagin.rendezvous.problem.cases import chaser_on
from pontryagin.rendezvous.problem.chaser import Chaser
from pontryagin.rendezvous.problem.checks import number
from pontryagin.rendezvous.problem.orbit import Orbit
from pontryagin.rendezvous.problem.rendezvous import Rendezvous

Keys = tuple[str, ...]

NEEDED: Keys = ("chaser", "target", "peak")
OPTIONAL: Keys = ("time_weight", "energy_weight", "gravity", "duration")
STATE: Keys = ("r", "v1", "c", "attitude")
ORBIT: Keys = ("parameter", "eccentricity", "anomaly", "attitude")
ANGLES: Keys = ("parameter", "eccentricity", "anomaly", "node", "inclination", "pericentre")


def read(text: str) -> Rendezvous:
    """The rendezvous that a JSON text asks for.

    Raises
    ------
    ValueError
        If the text is not JSON, a key is missing, unknown or there twice, or a value is not what it should
        be: named by its key, as in ``target.eccentricity``.

    Examples
    --------
    >>> asked = read('{"chaser": {"r": 1, "v1": 0, "c": 1, "attitude": [1, 0, 0, 0]}, "peak": 0.1, "target":'
    ...              '{"parameter": 1.5, "eccentricity": 0, "attitude": [1, 0, 0, 0], "anomaly": "pi/4"}}')
    >>> asked.free, asked.peak, round(asked.target.anomaly, 6)
    (True, 0.1, 0.785398)
    """
    whole = json_io.from_json(text)
    given = _object("", whole, NEEDED, OPTIONAL)
    there = [key for key in OPTIONAL if key in given and (key, given[key]) != ("duration", None)]
    values = {key: _number(key, given[key]) for key in there}
    unbounded = given["peak"] == "inf"
    values["peak"] = math.inf if unbounded else _number("peak", given["peak"], ', or "inf" for no bound')
    gravity = number("gravity", values.get("gravity", 1.0), 0.0, excluded=True)
    target = _orbit("target", given["target"])
    return Rendezvous(_chaser(given["chaser"], gravity), target, **values)


def written(problem: Rendezvous) -> dict[str, Any]:
    """The problem as `read` takes it.

    Examples
    --------
    >>> problem = Rendezvous(Chaser(1, 0, 1, [1, 0, 0, 0]), Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6))
    >>> read(json.dumps(written(problem))).target.parameter
    1.5
    """
    parts = {
        name: {key: _plain(getattr(part, key)) for key in keys}
        for name, part, keys in (("chaser", problem.chaser, STATE), ("target", problem.target, ORBIT))
    }
    rest = {key: getattr(problem, key) for key in ("time_weight", "energy_weight", "gravity", "duration")}
    return parts | rest | {"peak": problem.peak if math.isfinite(problem.peak) else "inf"}


def _plain(value: Any) -> Any:
    return value if isinstance(value, float) else value.tolist()


def _chaser(given: Any, gravity: float) -> Chaser:
    if isinstance(given, Mapping) and not set(given) & {"r", "v1", "c"}:
        return chaser_on(_orbit("chaser", given, "the craft starts on an ellipse"), gravity)
    values = _object("chaser", given, STATE)
    numbers = {key: _number(f"chaser.{key}", values[key]) for key in STATE[:3]}
    attitude = _quaternion("chaser.attitude", values["attitude"])
    with _named("chaser."):
        return Chaser(**numbers, attitude=attitude)


def _orbit(name: str, given: Any, why: str = "the target moves on an ellipse") -> Orbit:
    turned = isinstance(given, Mapping) and bool(set(given) & set(ANGLES[3:]))
    keys = ANGLES if turned else ORBIT
    values = _object(name, given, keys)
    numbers = {key: _number(f"{name}.{key}", values[key]) for key in keys if key != "attitude"}
    if numbers["eccentricity"] >= 1:
        raise ValueError(f"{name}.eccentricity must be less than 1: {why}, got {numbers['eccentricity']:g}")
    with _named(f"{name}."):
        if turned:
            return Orbit.from_angles(**numbers)
    attitude = _quaternion(f"{name}.attitude", values["attitude"])
    with _named(f"{name}."):
        return Orbit(**numbers, attitude=attitude)


def _object(name: str, given: Any, needed: Keys, optional: Keys = ()) -> Mapping[str, Any]:
    """A JSON object that has the keys needed and no others."""
    takes = ", ".join((*needed, *optional))
    if not isinstance(given, Mapping):
        raise ValueError(f"{name or 'the text'} takes an object with {takes}, got {_shown(given)}")
    dot = f"{name}." if name else ""
    for key in given:
        if key not in (*needed, *optional):
            raise ValueError(f"{dot}{key} is unknown here: takes {takes}")
    for key in needed:
        if key not in given:
            raise ValueError(f"{dot}{key} is missing")
    return given


def _number(name: str, value: Any, otherwise: str = "") -> float:
    """A JSON number, or a text that stands for one."""
    try:
        if isinstance(value, str):
            return formula.number(value)
        if isinstance(value, int | float) and not isinstance(value, bool):
            return float(value)
    except (ValueError, OverflowError):
        pass
    raise ValueError(f"{name} takes a number{otherwise}, got {_shown(value)}")


def _quaternion(name: str, value: Any) -> list[float]:
    if not isinstance(value, list) or len(value) != 4:
        raise ValueError(f"{name} takes four numbers, scalar part first, got {_shown(value)}")
    return [_number(f"{name}[{i}]", entry) for i, entry in enumerate(value)]


def _shown(value: Any) -> str:
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= 60 else f"{text[:57]}..."


@contextmanager
def _named(place: str) -> Iterator[None]:
    """Put the place of an object before the key that the library names."""
    try:
        yield
    except (TypeError, ValueError) as reason:
        raise ValueError(f"{place}{reason}") from None
