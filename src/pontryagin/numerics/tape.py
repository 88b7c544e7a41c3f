"""The elementary operations of a function of numbers, recorded by running it, and their derivatives.

A `Tape` holds each operation once. `derivatives` adds the operations of the forward mode of automatic
differentiation, along one direction or along several at once, whose numbers are side by side in vectors.
`pontryagin.numerics.assembly` turns a tape into native code.
"""

import math
import types
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

Operand = Any
"""A `Recorded` number or a plain one."""


class Tape:
    """Operations in their order; each is its name and the places of its operands, or a constant.

    Attributes
    ----------
    operations : list of tuple
        ("state", i), ("parameter", i), ("time",), ("constant", value), ("column", i), or the name of an
        operation and the places of its operands. Columns are vectors: directions in state i.
    vectors : list of bool
        Whether each result is a vector.
    """

    def __init__(self) -> None:
        self.operations: list[tuple[Any, ...]] = []
        self.vectors: list[bool] = []
        self._known: dict[tuple[Any, ...], Recorded] = {}

    def record(self, name: str, *operands: Any, vector: bool = False) -> "Recorded":
        """The result of an operation, which is recorded unless it was before."""
        operation = (name, *operands)
        if operation not in self._known:
            self._known[operation] = Recorded(self, len(self.operations))
            self.operations.append(operation)
            self.vectors.append(vector)
        return self._known[operation]

    def number(self, value: Operand) -> "Recorded":
        """A recorded number as it is, a plain one as a constant."""
        return value if isinstance(value, Recorded) else self.record("constant", float(value))

    def derivatives(
        self, results: Iterable["Recorded"], seeds: dict["Recorded", "Recorded"]
    ) -> list["Recorded"]:
        """Derivatives of the results, given those of the numbers that they are computed from."""
        found: dict[int, Recorded | None] = {number.place: slope for number, slope in seeds.items()}
        results = list(results)
        for place in self.needed(results):
            if place not in found:
                found[place] = self._derivative(place, found)
        return [found[result.place] or self.number(0.0) for result in results]

    def needed(self, results: Iterable["Recorded"]) -> list[int]:
        """Places of the operations that lead to the results, in their order."""
        places: set[int] = set()
        waiting = [result.place for result in results]
        while waiting:
            place = waiting.pop()
            if place not in places:
                places.add(place)
                waiting += operands(self.operations[place])
        return sorted(places)

    def _derivative(self, place: int, known: dict[int, "Recorded | None"]) -> "Recorded | None":
        """Derivative of one result by the chain rule, or None if it does not change."""
        name, *_ = self.operations[place]
        places = operands(self.operations[place])
        if not any(known[p] for p in places):
            return None
        numbers = [Recorded(self, p) for p in places]
        slopes = SLOPES[name](*numbers, Recorded(self, place))
        terms = [slope * known[p] for slope, p in zip(slopes, places, strict=True) if known[p] is not None]
        total = terms[0]
        for term in terms[1:]:
            total = total + term
        return self.number(total)


INPUTS = ("state", "parameter", "time", "constant", "column")
"""Operations without operands."""


def operands(operation: tuple[Any, ...]) -> list[int]:
    """Places of the operands of an operation."""
    return [] if operation[0] in INPUTS else list(operation[1:])


@dataclass(frozen=True)
class Recorded:
    """A number on a tape."""

    tape: Tape
    place: int

    @property
    def constant(self) -> float | None:
        """Its value, if it is a constant."""
        name, *rest = self.tape.operations[self.place]
        return float(rest[0]) if name == "constant" else None

    def _with(self, name: str, left: Operand, right: Operand) -> "Recorded":
        a, b = self.tape.number(left), self.tape.number(right)
        vector = self.tape.vectors[a.place] or self.tape.vectors[b.place]
        return self.tape.record(name, a.place, b.place, vector=vector)

    def __add__(self, other: Operand) -> "Recorded":
        return self._with("add", self, other)

    def __radd__(self, other: Operand) -> "Recorded":
        return self._with("add", other, self)

    def __sub__(self, other: Operand) -> "Recorded":
        return self._with("sub", self, other)

    def __rsub__(self, other: Operand) -> "Recorded":
        return self._with("sub", other, self)

    def __mul__(self, other: Operand) -> "Recorded":
        return _product(self, other) or self._with("mul", self, other)

    def __rmul__(self, other: Operand) -> "Recorded":
        return _product(self, other) or self._with("mul", other, self)

    def __truediv__(self, other: Operand) -> "Recorded":
        return self._with("div", self, other)

    def __rtruediv__(self, other: Operand) -> "Recorded":
        return self._with("div", other, self)

    def __neg__(self) -> "Recorded":
        return self.tape.record("neg", self.place, vector=self.tape.vectors[self.place])

    def __pos__(self) -> "Recorded":
        return self

    def __abs__(self) -> "Recorded":
        result: Recorded = call("fabs", self)
        return result

    def __pow__(self, exponent: Operand) -> "Recorded":
        power = exponent.constant if isinstance(exponent, Recorded) else float(exponent)
        if power is None or abs(power) > LARGEST_POWER or (2 * power) % 1:
            return self._with("pow", self, exponent)
        whole = _whole_power(self, int(abs(power)))
        if power % 1:
            root = call("sqrt", self)
            whole = root if whole is None else whole * root
        if whole is None:
            return self.tape.number(1.0)
        return whole if power > 0 else 1.0 / whole

    def __rpow__(self, base: Operand) -> "Recorded":
        return self._with("pow", base, self)


LARGEST_POWER = 64
"""Whole and half powers up to this are products and square roots."""


def _whole_power(base: Recorded, exponent: int) -> Recorded | None:
    """The product of equal factors, by squares; None for none of them."""
    result: Recorded | None = None
    while exponent:
        if exponent % 2:
            result = base if result is None else result * base
        base, exponent = base * base, exponent // 2
    return result


def _product(number: Recorded, other: Operand) -> Recorded | None:
    """A product with 1 or -1, which is none; None for any other one."""
    for factor, kept in ((other, number), (number, other)):
        value = factor.constant if isinstance(factor, Recorded) else factor
        if value == 1:
            return number.tape.number(kept)
        if value == -1:
            return -number.tape.number(kept)
    return None


Slopes = Callable[..., Sequence[Operand]]

SLOPES: dict[str, Slopes] = {
    "add": lambda a, b, y: (1.0, 1.0),
    "sub": lambda a, b, y: (1.0, -1.0),
    "mul": lambda a, b, y: (b, a),
    "div": lambda a, b, y: (1.0 / b, -(y / b)),
    "neg": lambda a, y: (-1.0,),
    "pow": lambda a, b, y: (
        b * a ** (b - 1.0) if b.constant is None else b.constant * a ** (b.constant - 1.0),
        0.0 if b.constant is not None else y * call("log", a),
    ),
    "sqrt": lambda a, y: (0.5 / y,),
    "exp": lambda a, y: (y,),
    "log": lambda a, y: (1.0 / a,),
    "sin": lambda a, y: (call("cos", a),),
    "cos": lambda a, y: (-call("sin", a),),
    "tan": lambda a, y: (1.0 + y * y,),
    "asin": lambda a, y: (1.0 / call("sqrt", 1.0 - a * a),),
    "acos": lambda a, y: (-1.0 / call("sqrt", 1.0 - a * a),),
    "atan": lambda a, y: (1.0 / (1.0 + a * a),),
    "atan2": lambda a, b, y: (b / (a * a + b * b), -a / (a * a + b * b)),
    "sinh": lambda a, y: (call("cosh", a),),
    "cosh": lambda a, y: (call("sinh", a),),
    "tanh": lambda a, y: (1.0 - y * y,),
    "asinh": lambda a, y: (1.0 / call("sqrt", a * a + 1.0),),
    "acosh": lambda a, y: (1.0 / call("sqrt", a * a - 1.0),),
    "atanh": lambda a, y: (1.0 / (1.0 - a * a),),
    "fabs": lambda a, y: (call("copysign", 1.0, a),),
    "copysign": lambda a, b, y: (call("copysign", 1.0, a) * call("copysign", 1.0, b), 0.0),
    "erf": lambda a, y: (2.0 / math.sqrt(math.pi) * call("exp", -(a * a)),),
    "erfc": lambda a, y: (-2.0 / math.sqrt(math.pi) * call("exp", -(a * a)),),
}
"""Derivatives of each operation in its operands, as functions of the operands and of the result."""

FUNCTIONS = tuple(name for name in SLOPES if hasattr(math, name) and name != "pow")
"""The functions that can be recorded, by their names in the `math` module."""


def call(name: str, *arguments: Operand) -> Any:
    """A function of numbers: recorded if one of them is, otherwise evaluated."""
    recorded = [a for a in arguments if isinstance(a, Recorded)]
    if not recorded:
        return getattr(math, name)(*arguments)
    tape = recorded[0].tape
    return tape.record(name, *(tape.number(a).place for a in arguments))


def functions() -> dict[str, Callable[..., Any]]:
    """Each of `FUNCTIONS` by its name, for numbers on a tape and for plain ones."""
    return {name: lambda *arguments, of=name: call(of, *arguments) for name in FUNCTIONS}


def lifted(kernel: Callable[..., Any]) -> Callable[..., Any]:
    """A kernel's own code with functions that take recorded numbers."""
    assert isinstance(kernel, types.FunctionType)
    return types.FunctionType(kernel.__code__, functions(), kernel.__name__)
