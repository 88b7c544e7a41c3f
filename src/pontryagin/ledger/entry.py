"""Entries of the ledger: one formula, number or claim of a paper with the verdict that its evidence earns.

The evidence, one of the kinds in `pontryagin.ledger.evidence`, finds a verdict by mathematics; `Entry.check`
raises when it differs from the stated one.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeVar

from pontryagin.io.kept_results import between_processes
from pontryagin.ledger.verdict import Unsupported, Verdict, kind

if TYPE_CHECKING:
    from pontryagin.ledger.evidence import Evidence, Steps

T = TypeVar("T")


@dataclass(frozen=True)
class Entry:
    """One formula, number or claim of a paper.

    Parameters
    ----------
    paper, label, statement : str
        The paper, the equation number or place in it, and what stands there.
    verdict : str
        One of `VERDICTS`.
    remark : str
        What is printed, what is right, and why; required unless the verdict is "holds".
    build : callable
        Returns the evidence, or None; called at the first use of `evidence`.

    Raises
    ------
    ValueError
        If there is no such verdict.

    Examples
    --------
    >>> from pontryagin.ledger import entries
    >>> entry = entries(paper="Gorelov", verdict="misprint")[0]
    >>> entry.verdict
    'misprint'
    >>> entry.check()
    """

    paper: str
    label: str
    statement: str
    verdict: Verdict
    remark: str
    build: "Callable[[], Evidence | None]"

    def __post_init__(self) -> None:
        kind(self.verdict)

    @cached_property
    def evidence(self) -> "Evidence | None":
        """The printed form, its derivation and the proofs; None if nothing is checked."""
        return self.build()

    def check(self) -> None:
        """Find the verdict from the evidence and compare it with the stated one.

        Raises
        ------
        Unsupported
            If a step of the evidence fails, if it supports another verdict, if its class is none of those
            that the table admits for the verdict, or if a remark is missing.
        """
        if self.verdict != "holds" and not self.remark:
            raise Unsupported(f"{self.label}: a verdict of {self.verdict!r} needs a remark that says why")
        try:
            found = self.evidence.finding() if self.evidence else "not checked"
        except Unsupported as broken:
            raise Unsupported(f"{self.label}: {broken}") from broken
        if found != self.verdict:
            raise Unsupported(f"{self.label}: the ledger says {self.verdict!r}, the evidence says {found!r}")
        if self.evidence and type(self.evidence).__name__ not in kind(self.verdict).evidence:
            name = type(self.evidence).__name__
            raise Unsupported(
                f"{self.label}: {name} is no evidence that the table of verdicts admits for {found!r}"
            )

    @property
    def printed(self) -> Any:
        """What the paper prints: left-hand sides to SymPy expressions; None for a claim in words."""
        return self.evidence.printed if self.evidence else None

    @property
    def derived(self) -> Any:
        """What first principles give, in the form of `printed`; None for a claim in words."""
        return self.evidence.derivation() if self.evidence else None

    @property
    def printed_latex(self) -> str:
        """`printed` as LaTeX without delimiters; empty for a claim in words."""
        return self.evidence.printed_latex() if self.evidence else ""

    @property
    def derived_latex(self) -> str:
        """`derived` as LaTeX without delimiters; empty for a claim in words. Runs the derivation."""
        return self.evidence.latex(self.evidence.derivation()) if self.evidence else ""

    def proof(self) -> list[str]:
        """Run the check and return its steps, each a sentence."""
        self.check()
        return self._steps()

    def _steps(self) -> list[str]:
        return [words for words, _ in self.evidence.steps()] if self.evidence else []

    def checked_forms(self) -> tuple[str, str]:
        """`printed_latex` and `derived_latex` after a check; a build keeps them under the sources' hash."""
        return self._kept("forms", self._check_forms)

    def checked_steps(self) -> list[str]:
        """The steps of `proof`; a build keeps them under the sources' hash."""
        self.checked_forms()
        return self._kept("steps", self._steps)

    def _check_forms(self) -> tuple[str, str]:
        self.check()
        return self.printed_latex, self.derived_latex

    def _kept(self, what: str, compute: Callable[[], T]) -> T:
        name = f"{what} of {self.paper}, {self.label}: {self.verdict}"
        return between_processes(self.build.__module__, name, compute)

    def as_dict(self) -> dict[str, str]:
        """The entry as strings: paper, label, statement, verdict, remark and `printed` in LaTeX."""
        return {
            "paper": self.paper,
            "label": self.label,
            "statement": self.statement,
            "verdict": self.verdict,
            "remark": self.remark,
            "printed": self.printed_latex,
        }


class Page(list[Entry]):
    """The entries of one paper, in its order; called as a decorator, it appends one.

    Examples
    --------
    >>> claim = Page("A paper")
    >>> @claim("(1)", "a statement of taste", verdict="not checked", remark="no mathematics decides it")
    ... def taste():
    ...     return None
    >>> claim[0].check()
    """

    def __init__(self, paper: str) -> None:
        super().__init__()
        self.paper = paper

    def __call__(
        self, label: str, statement: str, *, verdict: Verdict, remark: str = ""
    ) -> "Callable[[Callable[[], Evidence | None]], Entry]":
        """Decorate a function that returns the evidence; its name then stands for the entry."""

        def append(build: "Callable[[], Evidence | None]") -> Entry:
            entry = Entry(self.paper, label, statement, verdict, remark, build)
            self.append(entry)
            return entry

        return append

    def proof(
        self, label: str, statement: str, *, remark: str = "", display: str = ""
    ) -> "Callable[[Callable[[], Steps]], Entry]":
        """Decorate the steps of a proof: the verdict is "holds", the evidence a `Proof` of these steps.

        Examples
        --------
        >>> claim = Page("A paper")
        >>> @claim.proof("after (1)", "the area of a square grows with its side")
        ... def growth():
        ...     yield "3² > 2²", 3**2 > 2**2
        >>> growth.proof()
        ['3² > 2²']
        """

        def append(argument: "Callable[[], Steps]") -> Entry:
            def build() -> "Evidence":
                from pontryagin.ledger.evidence import Proof

                return Proof(argument, display=display)

            build.__module__ = argument.__module__
            return self(label, statement, verdict="holds", remark=remark)(build)

        return append
