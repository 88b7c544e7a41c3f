"""The log of a search for extremals: where it looked, what it gave up, and why."""

from dataclasses import dataclass, field


@dataclass
class Search:
    """Where extremals were sought, and with what result; filled in during the search.

    It shows where a better extremal may have been missed.

    Attributes
    ----------
    durations : list of float
        Durations at which a first extremal was sought, in the solver's unit.
    revolutions : list of int
        Revolutions of the extremals of the unbounded problem, counted from those of the first.
    ends : list of str
        Where the curve over the revolutions was left in each direction, and why.
    given_up : list of str
        Extremals that could not be reached or were not continued, and why.
    """

    durations: list[float] = field(default_factory=list)
    revolutions: list[int] = field(default_factory=list)
    ends: list[str] = field(default_factory=list)
    given_up: list[str] = field(default_factory=list)
