"""What a search looked at, for whoever asks whether a better extremal may have been missed."""

from dataclasses import dataclass, field


@dataclass
class Search:
    """What was looked at: filled in as the search goes on.

    Attributes
    ----------
    durations : list of float
        Of the first extremals, in the solver's unit.
    revolutions : list of int
        Of the extremals of the unbounded problem, more than the first one's.
    ends : list of str
        Where each walk through the revolutions ended, and why.
    given_up : list of str
        What was not reached or not followed on, and why.
    """

    durations: list[float] = field(default_factory=list)
    revolutions: list[int] = field(default_factory=list)
    ends: list[str] = field(default_factory=list)
    given_up: list[str] = field(default_factory=list)
