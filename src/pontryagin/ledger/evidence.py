"""Kinds of evidence: what SymPy has to confirm before an entry of the ledger earns its verdict.

A printed formula is a mapping from left-hand sides (LaTeX) to SymPy expressions or matrices, transcribed as
it stands. Its derivation is a function that returns the right-hand sides without using the printed form.
A claim in words is decided by steps: pairs of a sentence and whether it is true.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import sympy as sp

from pontryagin.ledger.verdict import Unsupported, Verdict

Sides = Mapping[str, Any]

RightSides = Any
"""The right-hand side of the one printed equation, those of several in the printed order, or `Sides`."""

Steps = Iterator[tuple[str, bool]]


def vanishes(difference: Any) -> bool:
    """Whether an expression, or every entry of a matrix, simplifies to zero."""
    if isinstance(difference, sp.MatrixBase):
        return all(vanishes(entry) for entry in difference)
    difference = sp.sympify(difference, strict=True)
    somewhere = difference.subs(sample_point(difference))
    if somewhere.is_Rational and somewhere != 0:
        return False
    return any(rule(difference) == 0 for rule in (sp.expand, sp.cancel, sp.simplify))


def sample_point(expression: sp.Expr) -> dict[sp.Symbol, sp.Rational]:
    """Distinct positive rationals for the symbols of an expression, so that terms rarely cancel by chance."""
    symbols = sorted(expression.free_symbols, key=str)
    return {symbol: sp.Rational(sp.prime(k + 5), sp.prime(k + 3)) for k, symbol in enumerate(symbols)}


def require(steps: Steps) -> None:
    """Run the steps of an argument; raise `Unsupported` at the first false one, or if there is none."""
    empty = True
    for words, truth in steps:
        empty = False
        if bool(truth) is not True:
            raise Unsupported(f"this step fails: {words}")
    if empty:
        raise Unsupported("there are no steps, so that nothing is proved")


def no_steps() -> Steps:
    """An argument without steps, which `require` refuses."""
    yield from ()


def _as_text(value: Any) -> str:
    """A number or a column of numbers as text."""
    return str(tuple(value)) if isinstance(value, sp.MatrixBase) else str(value)


class Evidence:
    """The common interface: a printed form or None, its derivation and LaTeX, the steps and the verdict."""

    printed: Any
    display: str

    def derivation(self) -> Any:
        """The derived form, or None for a claim in words."""
        return None

    def finding(self) -> Verdict:
        """The verdict that the mathematics supports; raises `Unsupported` if the evidence breaks."""
        raise NotImplementedError

    def steps(self) -> Steps:
        """The steps of the argument: sentences, each with whether it is true."""
        yield from ()

    def printed_latex(self) -> str:
        """The printed form as LaTeX: `display` if given, for what SymPy cannot typeset."""
        return self.display or self.latex(self.printed)

    def latex(self, sides: Any) -> str:
        """A printed or derived form as LaTeX without delimiters; empty for None."""
        if sides is None:
            return ""
        return r",\quad ".join(f"{left} = {sp.latex(right)}" for left, right in sides.items())


@dataclass(frozen=True)
class Equality(Evidence):
    """Printed and derived right-hand sides are equal: `holds`."""

    printed: Sides
    derived: Callable[[], RightSides]
    display: str = field(default="", kw_only=True)

    def derivation(self) -> Sides:
        """The derived right-hand sides, by the left-hand ones."""
        found = self.derived()
        if isinstance(found, Mapping):
            return found
        return dict(zip(self.printed, [found] if len(self.printed) == 1 else found, strict=True))

    def differences(self) -> dict[str, Any]:
        """Printed minus derived, for the left-hand sides where it does not simplify to zero."""
        derived = self.derivation()
        if list(derived) != list(self.printed):
            raise Unsupported(f"the printed sides are {list(self.printed)}, the derived ones {list(derived)}")
        differences = {left: self.printed[left] - derived[left] for left in derived}
        return {left: rest for left, rest in differences.items() if not vanishes(rest)}

    def finding(self) -> Verdict:
        """`holds`, if printed minus derived vanishes."""
        if left_over := self.differences():
            raise Unsupported(f"printed minus derived leaves {left_over}")
        return "holds"

    def steps(self) -> Steps:
        """One step for each equation."""
        left_over = self.differences()
        for left in self.printed:
            yield f"printed and derived ${left}$ agree", left not in left_over


@dataclass(frozen=True)
class Consequence:
    """What the printed form gives in a numerical example, and what is required there."""

    words: str
    printed: Any
    required: Any


@dataclass(frozen=True)
class Misprint(Equality):
    """Printed minus derived is the stated defect, and numbers show its consequence: `misprint`."""

    defect: Sides
    consequence: Callable[[], Consequence]

    def finding(self) -> Verdict:
        """`misprint`, if printed minus derived is the stated defect and the consequence is wrong."""
        left_over = self.differences()
        if not left_over:
            raise Unsupported("printed and derived agree: no misprint")
        if list(left_over) != list(self.defect) or any(
            not vanishes(left_over[left] - defect) for left, defect in self.defect.items()
        ):
            raise Unsupported(f"printed minus derived is {left_over}, not {dict(self.defect)}")
        shown = self.consequence()
        if (
            sp.sympify(shown.printed, strict=True).free_symbols
            | sp.sympify(shown.required, strict=True).free_symbols
        ):
            raise Unsupported(f"{shown.words}: {shown.printed} and {shown.required} are not numbers")
        if vanishes(shown.printed - shown.required):
            raise Unsupported(f"{shown.words}: the print gives {shown.printed}, as required")
        return "misprint"

    def steps(self) -> Steps:
        """The defect, then the consequence in numbers."""
        for left, defect in self.defect.items():
            yield f"printed minus derived ${left}$ is ${sp.latex(defect)}$", True
        shown = self.consequence()
        printed, required = _as_text(shown.printed), _as_text(shown.required)
        yield f"{shown.words}: the print gives {printed}, required is {required}", True


@dataclass(frozen=True)
class Unreadable(Equality):
    """A scan of which only the legible sides agree with the derivation: `unreadable`."""

    legible: Sequence[str]

    def finding(self) -> Verdict:
        """`unreadable`, if some sides differ from the derivation and no legible one does."""
        garbled = self.differences()
        if not garbled:
            raise Unsupported("every printed side agrees with the derivation: nothing is unreadable")
        if wrong := [left for left in self.legible if left in garbled]:
            raise Unsupported(f"the sides {wrong} are called legible, but differ from the derivation")
        return "unreadable"

    def steps(self) -> Steps:
        """One step for all legible sides."""
        yield f"what can be read ({', '.join(self.legible)}) agrees with the derivation", True


@dataclass(frozen=True)
class LinearSystem(Evidence):
    """Printed linear equations ``expression = 0`` with the unique solution of the derived ones: `holds`."""

    printed: Sequence[sp.Expr]
    derived: Callable[[], Sequence[sp.Expr]]
    unknowns: Sequence[sp.Symbol]
    display: str = field(default="", kw_only=True)

    def derivation(self) -> Sequence[sp.Expr]:
        """The derived expressions, which vanish at the solution."""
        return self.derived()

    def _solution(self, equations: Sequence[sp.Expr]) -> tuple[sp.Expr, ...]:
        solutions = list(sp.linsolve(list(equations), list(self.unknowns)))
        if len(solutions) != 1 or any(part.has(*self.unknowns) for part in solutions[0]):
            raise Unsupported(f"{equations} have no unique solution for {self.unknowns}")
        return tuple(solutions[0])

    def finding(self) -> Verdict:
        """`holds`, if both systems have the same unique solution."""
        printed, derived = self._solution(self.printed), self._solution(self.derived())
        if not all(vanishes(a - b) for a, b in zip(printed, derived, strict=True)):
            raise Unsupported(f"the printed system gives {printed}, the derived one {derived}")
        return "holds"

    def steps(self) -> Steps:
        """A single step."""
        yield "the printed and the derived system have the same solution", True

    def latex(self, sides: Any) -> str:
        """Each expression set equal to zero."""
        return r",\quad ".join(f"{sp.latex(side)} = 0" for side in sides)


@dataclass(frozen=True)
class Proof(Evidence):
    """A claim in words, proved step by step, with or without a printed formula: `holds`."""

    argument: Callable[[], Steps]
    formula: Equality | None = None
    display: str = field(default="", kw_only=True)

    @property
    def printed(self) -> Any:
        """The printed form of the formula, if there is one."""
        return self.formula.printed if self.formula else None

    def derivation(self) -> Any:
        """The derived form of the formula, if there is one."""
        return self.formula.derivation() if self.formula else None

    def finding(self) -> Verdict:
        """`holds`, if every step is true and the formula holds."""
        if self.formula:
            self.formula.finding()
        require(self.argument())
        return "holds"

    def steps(self) -> Steps:
        """The argument's steps."""
        yield from self.argument()


@dataclass(frozen=True)
class Refutation(Evidence):
    """A claim that a counterexample refutes; its certificate is checked each time: `false`."""

    counterexample: Callable[[], Steps]
    printed: Sides | None = None
    derived: Callable[[], Sides] | None = None
    display: str = field(default="", kw_only=True)

    def derivation(self) -> Any:
        """The true form in place of the printed one."""
        return self.derived() if self.derived else None

    def finding(self) -> Verdict:
        """`false`, if the counterexample's steps are true and the printed form differs from the true one."""
        require(self.counterexample())
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
        """`conditional`, if every step of the proof and of the counterexample is true."""
        super().finding()
        require(self.counterexample())
        return "conditional"

    def steps(self) -> Steps:
        """The proof's steps, then the counterexample's."""
        yield from self.argument()
        yield from self.counterexample()


@dataclass(frozen=True)
class Slip(Conditional):
    """A misprint in words: the intended claim is proved, the printed one refuted: `misprint`."""

    def finding(self) -> Verdict:
        """`misprint`, if every step of the proof and of the counterexample is true."""
        super().finding()
        return "misprint"
