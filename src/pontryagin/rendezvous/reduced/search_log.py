"""Where a search for extremals looked and what it gave up, which tells whether a better one may be missed."""

from dataclasses import dataclass, field


@dataclass
class Search:
    """Where extremals were looked for; filled in as the search goes on.

    Attributes
    ----------
    durations : list of float
        Durations at which a first extremal was sought, in the solver's unit.
    revolutions : list of int
        Revolutions of the extremals of the unbounded problem, counted from those of the first.
    ends : list of str
        Where the curve through the revolutions was left, each way, and why.
    given_up : list of str
        What could not be reached or was not taken on, and why.
    """

    durations: list[float] = field(default_factory=list)
    revolutions: list[int] = field(default_factory=list)
    ends: list[str] = field(default_factory=list)
    given_up: list[str] = field(default_factory=list)
