"""What a study consists of: parts, each so many chunks of seeded work, and how their records make a table."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

Found = Mapping[str, Any]
"""What a chunk found, ready for JSON: texts, whole numbers, finite numbers, lists and mappings of these."""


@dataclass(frozen=True)
class Part:
    """One line of work of a study: a row of its table.

    Attributes
    ----------
    name : str
        Its name in the table, and that of its folder of records.
    modules : sequence of str
        Dotted names of the modules on which its results depend; what these import is counted too.
    chunks : int
        How many chunks the whole part has.
    run : callable
        Does a chunk: from a generator that is seeded for it alone, and its number, to what it found.
    share : float
        Share of the time that it gets, relative to those of the other parts.
    holds : callable
        Whether what a chunk found still holds, where that is seen from what it found; else it is done again.
    """

    name: str
    modules: Sequence[str]
    chunks: int
    run: Callable[[np.random.Generator, int], Found]
    share: float = 1.0
    holds: Callable[[Found], bool] = lambda found: True


@dataclass(frozen=True)
class Study:
    """A study: its parts, and what its table says of them.

    Attributes
    ----------
    name, title : str
        Name of its folders; heading in the report.
    note : str
        What its columns mean, one paragraph.
    seed : int
        From which the generators of all chunks are made.
    parts : sequence of Part
        In the order of the table; where two may be next, the earlier one is.
    row : callable
        From a part and what its finished chunks found, in their order, to the cells of its row by heading.
    cases : callable
        From the same to the cases that are kept with their exact inputs: ready for JSON.
    """

    name: str
    title: str
    note: str
    seed: int
    parts: Sequence[Part]
    row: Callable[[Part, Sequence[Found]], Mapping[str, Any]]
    cases: Callable[[Part, Sequence[Found]], Sequence[Mapping[str, Any]]]


def generator(study: Study, part: Part, number: int) -> np.random.Generator:
    """The random numbers of a chunk: the same whenever and in whatever order the chunks are done."""
    return np.random.default_rng([study.seed, number, *part.name.encode()])
