"""Reading and writing a rendezvous as JSON; errors name the key whose value is refused.

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
``attitude``, or in its place ``node``, ``inclination`` and ``pericentre`` in radians; the chaser may also be
given as an orbit, on which it is at its ``anomaly``. ``peak`` is required, ``"inf"`` for no bound. By default
``time_weight`` is 1, ``energy_weight`` 0, ``gravity`` 1, and ``duration`` null, which leaves it free. A
number may be written as a text, like ``"20*pi/180"``.
"""

import json
import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from pontryagin.errors import ArgumentTypeError, ArgumentValueError
from pontryagin.io import formula, json_io
from pontryagin.rendezvous.problem.cases import chaser_on
from pontryagin.rendezvous.problem.chaser import Chaser
from pontryagin.rendezvous.problem.checks import number
from pontryagin.rendezvous.problem.orbit import Orbit
from pontryagin.rendezvous.problem.rendezvous import Rendezvous

Keys = tuple[str, ...]

REQUIRED: Keys = ("chaser", "target", "peak")
OPTIONAL: Keys = ("time_weight", "energy_weight", "gravity", "duration")
STATE: Keys = ("r", "v1", "c", "attitude")
ORBIT: Keys = ("parameter", "eccentricity", "anomaly", "attitude")
ANGLES: Keys = ("parameter", "eccentricity", "anomaly", "node", "inclination", "pericentre")


def read(text: str) -> Rendezvous:
    """The rendezvous that a JSON text describes.

    Raises
    ------
    ValueError
        If the text is not JSON, a key is missing, unknown or repeated, or a value is refused; the message
        names the key, as in ``target.eccentricity``.

    Examples
    --------
    >>> problem = read('{"chaser": {"r": 1, "v1": 0, "c": 1, "attitude": [1, 0, 0, 0]}, "peak": 0.1,'
    ...                ' "target": {"parameter": 1.5, "eccentricity": 0, "attitude": [1, 0, 0, 0],'
    ...                ' "anomaly": "pi/4"}}')
    >>> problem.free, problem.peak, round(problem.target.anomaly, 6)
    (True, 0.1, 0.785398)
    """
    return of(json_io.from_json(text))


def of(value: Any) -> Rendezvous:
    """The rendezvous that a JSON object describes; see `read`."""
    given = _object("", value, REQUIRED, OPTIONAL)
    present = [key for key in OPTIONAL if key in given and (key, given[key]) != ("duration", None)]
    values = {key: _number(key, given[key]) for key in present}
    unbounded = given["peak"] == "inf"
    values["peak"] = math.inf if unbounded else _number("peak", given["peak"], ', or "inf" for no bound')
    gravity = number("gravity", values.get("gravity", 1.0), 0.0, excluded=True)
    target = _orbit("target", given["target"])
    return Rendezvous(_chaser(given["chaser"], gravity), target, **values)


def of_row(cells: Mapping[str, str]) -> Rendezvous:
    """The rendezvous that a row of a table describes.

    A column is named as the key that it holds, ``peak`` or ``target.eccentricity``, and the parts of a
    quaternion as ``target.attitude_1`` to ``target.attitude_4``. Columns of other names are left out, and so
    are empty cells.

    Raises
    ------
    ValueError
        As `read`.

    Examples
    --------
    >>> row = {"name": "a", "peak": "1/10", "duration": "", "chaser.parameter": "1", "chaser.anomaly": "0"}
    >>> row |= {"chaser.eccentricity": "0", "target.parameter": "3/2", "target.eccentricity": "0.1"}
    >>> crafts = ("chaser", "target")
    >>> row |= {f"{craft}.attitude_{i}": str(int(i == 1)) for craft in crafts for i in range(1, 5)}
    >>> row |= {"target.anomaly": "pi/5"}
    >>> problem = of_row(row)
    >>> problem.peak, problem.free, problem.target.parameter
    (0.1, True, 1.5)
    """
    value: dict[str, Any] = {}
    for name, text in cells.items():
        craft, dot, key = name.partition(".")
        if not text.strip() or craft not in ((*REQUIRED[:2],) if dot else (*REQUIRED[2:], *OPTIONAL)):
            continue
        place = value.setdefault(craft, {}) if dot else value
        part = key.removeprefix("attitude_")
        if part in ("1", "2", "3", "4") and part != key:
            place.setdefault("attitude", [None] * 4)[int(part) - 1] = text
        else:
            place[key if dot else craft] = text.strip()
    return of(value)


def to_dict(problem: Rendezvous) -> dict[str, Any]:
    """The JSON object from which `read` makes the problem.

    Examples
    --------
    >>> problem = Rendezvous(Chaser(1, 0, 1, [1, 0, 0, 0]), Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6))
    >>> read(json.dumps(to_dict(problem))).target.parameter
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
    with _prefixed("chaser."):
        return Chaser(**numbers, attitude=attitude)


def _orbit(name: str, given: Any, why: str = "the target moves on an ellipse") -> Orbit:
    by_angles = isinstance(given, Mapping) and bool(set(given) & set(ANGLES[3:]))
    keys = ANGLES if by_angles else ORBIT
    values = _object(name, given, keys)
    numbers = {key: _number(f"{name}.{key}", values[key]) for key in keys if key != "attitude"}
    if numbers["eccentricity"] >= 1:
        raise ArgumentValueError(
            f"{name}.eccentricity must be less than 1: {why}, got {numbers['eccentricity']:g}",
            f"{name}.eccentricity",
        )
    with _prefixed(f"{name}."):
        if by_angles:
            return Orbit.from_angles(**numbers)
    attitude = _quaternion(f"{name}.attitude", values["attitude"])
    with _prefixed(f"{name}."):
        return Orbit(**numbers, attitude=attitude)


def _object(name: str, given: Any, required: Keys, optional: Keys = ()) -> Mapping[str, Any]:
    """Check that a value is a JSON object with all required keys and no unknown ones; return it."""
    takes = ", ".join((*required, *optional))
    if not isinstance(given, Mapping):
        place = name or "the text"
        raise ArgumentValueError(
            f"{place} takes an object with the keys {takes}, got {_excerpt(given)}", name or None
        )
    dot = f"{name}." if name else ""
    for key in given:
        if key not in (*required, *optional):
            raise ArgumentValueError(f"{dot}{key} is an unknown key; known are {takes}", f"{dot}{key}")
    for key in required:
        if key not in given:
            raise ArgumentValueError(f"{dot}{key} is missing", f"{dot}{key}")
    return given


def _number(name: str, value: Any, alternative: str = "") -> float:
    """A JSON number, or the value of a text such as "pi/4"."""
    try:
        if isinstance(value, str):
            return formula.number(value)
        if isinstance(value, int | float) and not isinstance(value, bool):
            return float(value)
    except (ValueError, OverflowError):
        pass
    raise ArgumentValueError(f"{name} takes a number{alternative}, got {_excerpt(value)}", name)


def _quaternion(name: str, value: Any) -> list[float]:
    if not isinstance(value, list) or len(value) != 4:
        raise ArgumentValueError(f"{name} takes four numbers, scalar part first, got {_excerpt(value)}", name)
    return [_number(f"{name}[{i}]", entry) for i, entry in enumerate(value)]


def _excerpt(value: Any) -> str:
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= 60 else f"{text[:57]}..."


@contextmanager
def _prefixed(place: str) -> Iterator[None]:
    """Prefix the argument that an error of the library names with the name of the enclosing object."""
    try:
        yield
    except (ArgumentTypeError, ArgumentValueError) as reason:
        raise ArgumentValueError(f"{place}{reason}", f"{place}{reason.argument}") from None
