"""The log of a search for extremals: where it looked, what it gave up, and why."""

from dataclasses import dataclass, field

INTERRUPTED = "the search was interrupted"
"""The last of the `ends` of a search that was stopped before its end."""


@dataclass(frozen=True)
class Search:
    """Where extremals were sought, and with what result.

    It shows where a better extremal may have been missed.

    Attributes
    ----------
    durations : tuple of float
        Durations at which first transfers were sought, in the solver's unit.
    revolutions : tuple of int
        The laps of the extremals found: turns in addition to those after which the craft meets the target at
        the longitude next ahead.
    ends : tuple of str
        Up to which lap extremals were sought in each direction.
    given_up : tuple of str
        Extremals that could not be reached, and why: which walk broke off and where, or what Newton's method
        met.
    """

    durations: tuple[float, ...] = ()
    revolutions: tuple[int, ...] = ()
    ends: tuple[str, ...] = ()
    given_up: tuple[str, ...] = ()


@dataclass
class SearchLog:
    """The same as lists, which a search under way fills."""

    durations: list[float] = field(default_factory=list)
    revolutions: list[int] = field(default_factory=list)
    ends: list[str] = field(default_factory=list)
    given_up: list[str] = field(default_factory=list)

    def closed(self) -> Search:
        """What was logged, as it hangs on a solution."""
        return Search(*(tuple(entries) for entries in vars(self).values()))
