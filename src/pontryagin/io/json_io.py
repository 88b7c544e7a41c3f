"""JSON as the command line prints and reads it: arrays as lists, null for what is not finite."""

import json
import math
from collections.abc import Mapping
from typing import Any

import numpy as np

Report = Mapping[str, Mapping[str, Any]]
"""Headings, and the quantities under each by name: what a table shows and a JSON object holds."""


def plain(value: Any) -> Any:
    """Arrays as lists and numbers as Python's own; a number that is not finite becomes None.

    Examples
    --------
    >>> plain({"t": np.array([0.5, np.nan]), "unique": np.True_})
    {'t': [0.5, None], 'unique': True}
    """
    if isinstance(value, Mapping):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist())
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value if isinstance(value, bool | int | float | str | None) else str(value)


def to_json(report: Report) -> str:
    """A JSON object of objects with one quantity on each line; numbers have all their digits.

    Examples
    --------
    >>> print(to_json({"solution": {"norm": np.float64(4.0), "switch_times": np.array([0.5, np.inf])}}))
    {
     "solution": {
      "norm": 4.0,
      "switch_times": [0.5, null]
     }
    }
    """
    headings = []
    for heading, quantities in report.items():
        lines = (f"  {_dumped(name)}: {_dumped(value)}" for name, value in quantities.items())
        headings.append(f" {_dumped(heading)}: {{\n" + ",\n".join(lines) + "\n }")
    return "{\n" + ",\n".join(headings) + "\n}"


def _dumped(value: Any) -> str:
    return json.dumps(plain(value), ensure_ascii=False, allow_nan=False)


def from_json(text: str) -> Any:
    """The value that a JSON text stands for.

    Raises
    ------
    ValueError
        If the text is not JSON (with the line and column), if its objects are nested too deeply, or if an
        object has a key twice.

    Examples
    --------
    >>> from_json('{"peak": 0.1, "peak": 0.2}')
    Traceback (most recent call last):
        ...
    ValueError: peak occurs twice in one object
    """
    try:
        return json.loads(text, object_pairs_hook=_without_duplicates)
    except json.JSONDecodeError as reason:
        raise ValueError(f"line {reason.lineno}, column {reason.colno}: {reason.msg}") from None
    except RecursionError:
        raise ValueError("the objects are nested too deeply") from None


def _without_duplicates(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """The key-value pairs of a JSON object as a dict; a key that occurs twice is an error."""
    keys = [key for key, _ in pairs]
    twice = next((key for i, key in enumerate(keys) if key in keys[:i]), None)
    if twice is not None:
        raise ValueError(f"{twice} occurs twice in one object")
    return dict(pairs)
