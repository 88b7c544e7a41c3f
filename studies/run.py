"""A bounded run of a study: the part that is furthest behind its share of the time does its next chunk."""

from collections.abc import Callable
from dataclasses import dataclass, field
from time import monotonic

from studies.part import Part, Study, generator
from studies.records import Records

Told = Callable[[Part, int, float], None]
"""What is called after each chunk: with its part, its number and its seconds."""


@dataclass
class Progress:
    """How far a part is.

    Attributes
    ----------
    left : list of int
        Chunks that are not finished, the next one last.
    spent : float
        Seconds of the finished ones.
    finished : int
        Their number.
    """

    part: Part
    left: list[int]
    spent: float
    finished: int = field(default=0)

    @property
    def behind(self) -> float:
        """Seconds spent, relative to the part's share: the part with the least is next."""
        return self.spent / self.part.share

    def fits(self, seconds: float) -> bool:
        """Whether a chunk is expected to end within some seconds; the first one always is."""
        return self.finished == 0 or self.spent / self.finished <= seconds


def run(study: Study, records: Records, seconds: float, told: Told = lambda *_: None) -> None:
    """Do chunks until the time is over or all are finished; each finished one is kept at once.

    Parameters
    ----------
    study : Study
        What is done.
    records : Records
        Where the finished chunks are kept.
    seconds : float
        The time. A chunk that is expected to take longer than what is left is not begun.
    told : callable, optional
        Is called after each chunk.
    """
    end = monotonic() + seconds
    at_work = [_progress(part, records) for part in study.parts]
    while monotonic() < end:
        open_parts = [one for one in at_work if one.left and one.fits(end - monotonic())]
        if not open_parts:
            return
        following = min(open_parts, key=lambda one: one.behind)
        number, begun = following.left.pop(), monotonic()
        found = following.part.run(generator(study, following.part, number), number)
        taken = monotonic() - begun
        records.write(following.part, number, taken, found)
        following.spent += taken
        following.finished += 1
        told(following.part, number, taken)


def _progress(part: Part, records: Records) -> Progress:
    known = records.read(part)
    left = sorted({*range(part.chunks)} - {record["chunk"] for record in known}, reverse=True)
    return Progress(part, left, sum(record["seconds"] for record in known), len(known))
