"""Kinds of evidence: what has to be true for a verdict of the ledger, checked by SymPy.

A printed formula is a mapping from left-hand sides (LaTeX) to SymPy expressions or matrices, transcribed as
it stands; its derivation is a function that returns the same left-hand sides and never looks at the print.
A claim in words is decided by steps: sentences, each with the truth of what it says.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import sympy as sp

from pontryagin.ledger import Unsupported, Verdict

Sides = Mapping[str, Any]
Steps = Iterator[tuple[str, bool]]


def vanishes(difference: Any) -> bool:
    """Whether an expression, or every entry of a matrix, simplifies to zero."""
    if isinstance(difference, sp.MatrixBase):
        return all(vanishes(entry) for entry in difference)
    difference = sp.sympify(difference)
    somewhere = difference.subs(sample_point(difference))
    if somewhere.is_Rational and somewhere != 0:
        return False
    return any(rule(difference) == 0 for rule in (sp.expand, sp.cancel, sp.simplify))


def sample_point(expression: sp.Expr) -> dict[sp.Symbol, sp.Rational]:
    """Positive rationals for the symbols of an expression, in which little cancels by chance."""
    symbols = sorted(expression.free_symbols, key=str)
    return {symbol: sp.Rational(sp.prime(k + 5), sp.prime(k + 3)) for k, symbol in enumerate(symbols)}


def followed(steps: Steps) -> list[tuple[str, bool]]:
    """Run the steps of an argument; raise at the first that is not true."""
    done = []
    for words, truth in steps:
        if bool(truth) is not True:
            raise Unsupported(f"this step fails: {words}")
        done.append((words, True))
    if not done:
        raise Unsupported("an argument without steps proves nothing")
    return done


def no_steps() -> Steps:
    """The argument that says nothing: alone, it is refused."""
    yield from ()


def _told(value: Any) -> str:
    """A number or a column of numbers, in words."""
    return str(tuple(value)) if isinstance(value, sp.MatrixBase) else str(value)


class Evidence:
    """What all kinds share: a printed form or None, its derivation, its LaTeX, its steps, its finding."""

    printed: Any
    display: str

    def derivation(self) -> Any:
        """The derived form, or None for a claim in words."""
        return None

    def finding(self) -> Verdict:
        """The verdict that the mathematics supports; `Unsupported` where the evidence breaks."""
        raise NotImplementedError

    def steps(self) -> Steps:
        """What was shown, a sentence each."""
        yield from ()

    def shown(self) -> str:
        """The print as LaTeX: `display` where SymPy has no words for it."""
        return self.display or self.latex(self.printed)

    def latex(self, sides: Any) -> str:
        """The printed or derived form as LaTeX without delimiters; empty where there is none."""
        if sides is None:
            return ""
        return r",\quad ".join(f"{left} = {sp.latex(right)}" for left, right in sides.items())


@dataclass(frozen=True)
class Equality(Evidence):
    """Printed and derived right-hand sides are the same: `holds`."""

    printed: Sides
    derived: Callable[[], Sides]
    display: str = field(default="", kw_only=True)

    def derivation(self) -> Sides:
        """The derived right-hand sides."""
        return self.derived()

    def differences(self) -> dict[str, Any]:
        """Printed minus derived, for the left-hand sides where it does not simplify to zero."""
        derived = self.derived()
        if list(derived) != list(self.printed):
            raise Unsupported(f"printed {list(self.printed)}, but derived {list(derived)}")
        differences = {left: self.printed[left] - derived[left] for left in derived}
        return {left: rest for left, rest in differences.items() if not vanishes(rest)}

    def finding(self) -> Verdict:
        """`holds`, or what is left of printed minus derived."""
        if left_over := self.differences():
            raise Unsupported(f"printed minus derived leaves {left_over}")
        return "holds"

    def steps(self) -> Steps:
        """One step per equation."""
        left_over = self.differences()
        for left in self.printed:
            yield f"printed and derived ${left}$ agree", left not in left_over


@dataclass(frozen=True)
class Consequence:
    """What the printed form would do, in numbers, next to what is required."""

    words: str
    printed: Any
    required: Any


@dataclass(frozen=True)
class Misprint(Equality):
    """Printed and derived differ by exactly the stated defect, and it shows in numbers: `misprint`."""

    defect: Sides
    consequence: Callable[[], Consequence]

    def finding(self) -> Verdict:
        """`misprint`, unless the difference is none, or another than the stated one."""
        left_over = self.differences()
        if not left_over:
            raise Unsupported("printed and derived agree: no misprint")
        if list(left_over) != list(self.defect) or any(
            not vanishes(left_over[left] - defect) for left, defect in self.defect.items()
        ):
            raise Unsupported(f"printed minus derived is {left_over}, not {dict(self.defect)}")
        shown = self.consequence()
        if sp.sympify(shown.printed).free_symbols | sp.sympify(shown.required).free_symbols:
            raise Unsupported(f"{shown.words}: {shown.printed} and {shown.required} are not numbers")
        if vanishes(shown.printed - shown.required):
            raise Unsupported(f"{shown.words}: the print gives {shown.printed}, as required")
        return "misprint"

    def steps(self) -> Steps:
        """The defect, and the numbers."""
        for left, defect in self.defect.items():
            yield f"printed minus derived ${left}$ is ${sp.latex(defect)}$", True
        shown = self.consequence()
        yield (
            f"{shown.words}: the print gives {_told(shown.printed)}, required is {_told(shown.required)}",
            True,
        )


@dataclass(frozen=True)
class Unreadable(Equality):
    """The scan cannot be read: what is legible agrees with the derivation, the rest cannot be meant."""

    legible: Sequence[str]

    def finding(self) -> Verdict:
        """`unreadable`, unless all of it agrees, or something legible does not."""
        garbled = self.differences()
        if not garbled:
            raise Unsupported("all of it agrees with the derivation: it can be read")
        if wrong := [left for left in self.legible if left in garbled]:
            raise Unsupported(f"{wrong} can be read, and differ from the derivation")
        return "unreadable"

    def steps(self) -> Steps:
        """What can be read."""
        yield f"what can be read ({', '.join(self.legible)}) agrees with the derivation", True


@dataclass(frozen=True)
class LinearSystem(Evidence):
    """Printed linear equations, each ``expression = 0``, have the solutions of the derived ones: `holds`."""

    printed: Sequence[sp.Expr]
    derived: Callable[[], Sequence[sp.Expr]]
    unknowns: Sequence[sp.Symbol]
    display: str = field(default="", kw_only=True)

    def derivation(self) -> Sequence[sp.Expr]:
        """The derived expressions that are to vanish."""
        return self.derived()

    def _solution(self, equations: Sequence[sp.Expr]) -> tuple[sp.Expr, ...]:
        solutions = list(sp.linsolve(list(equations), list(self.unknowns)))
        if len(solutions) != 1 or any(part.has(*self.unknowns) for part in solutions[0]):
            raise Unsupported(f"{equations} do not fix {self.unknowns}")
        return solutions[0]

    def finding(self) -> Verdict:
        """`holds` where both systems have one solution, the same."""
        printed, derived = self._solution(self.printed), self._solution(self.derived())
        if not all(vanishes(a - b) for a, b in zip(printed, derived, strict=True)):
            raise Unsupported(f"the printed system gives {printed}, the derived one {derived}")
        return "holds"

    def steps(self) -> Steps:
        """The one step there is."""
        yield "the printed and the derived system have the same solution", True

    def latex(self, sides: Any) -> str:
        """Each expression set equal to zero."""
        return r",\quad ".join(f"{sp.latex(side)} = 0" for side in sides)


@dataclass(frozen=True)
class Proof(Evidence):
    """A claim in words, proved step by step: `holds`. A formula may stand with it."""

    argument: Callable[[], Steps]
    formula: Equality | None = None
    display: str = field(default="", kw_only=True)

    @property
    def printed(self) -> Any:  # type: ignore[override]
        """The formula's printed form, where there is one."""
        return self.formula.printed if self.formula else None

    def derivation(self) -> Any:
        """The formula's derivation, where there is one."""
        return self.formula.derivation() if self.formula else None

    def finding(self) -> Verdict:
        """`holds` when every step is true and the formula holds."""
        if self.formula:
            self.formula.finding()
        followed(self.argument())
        return "holds"

    def steps(self) -> Steps:
        """The argument's steps."""
        yield from self.argument()


@dataclass(frozen=True)
class Refutation(Evidence):
    """A claim that fails, by a counterexample whose certificate is checked anew: `false`."""

    counterexample: Callable[[], Steps]
    printed: Sides | None = None
    derived: Callable[[], Sides] | None = None
    display: str = field(default="", kw_only=True)

    def derivation(self) -> Any:
        """What is true instead of the printed form."""
        return self.derived() if self.derived else None

    def finding(self) -> Verdict:
        """`false` when every step of the counterexample is true, and any printed form is not the true one."""
        followed(self.counterexample())
        if self.printed and self.derived and not Equality(self.printed, self.derived).differences():
            raise Unsupported("the printed form is the derived one: nothing is refuted")
        return "false"

    def steps(self) -> Steps:
        """The counterexample's steps."""
        yield from self.counterexample()


@dataclass(frozen=True)
class Conditional(Proof):
    """A claim proved on a stated region, with a certified counterexample outside it: `conditional`."""

    counterexample: Callable[[], Steps] = no_steps

    def finding(self) -> Verdict:
        """`conditional` when both arguments go through."""
        super().finding()
        followed(self.counterexample())
        return "conditional"

    def steps(self) -> Steps:
        """The proof's steps, then the counterexample's."""
        yield from self.argument()
        yield from self.counterexample()


@dataclass(frozen=True)
class Slip(Conditional):
    """A misprint that is no formula: what is meant is proved, what is printed refuted: `misprint`."""

    def finding(self) -> Verdict:
        """`misprint` when both arguments go through."""
        super().finding()
        return "misprint"
