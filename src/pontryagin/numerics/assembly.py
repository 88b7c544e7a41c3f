"""A tape as LLVM's text: a function that reads numbers and directions and writes its results.

Vectors are LLVM's own, so that the processor computes several directions in one instruction. Every operation
is rounded as in plain arithmetic, and none is reordered.
"""

import struct
from collections.abc import Sequence

from pontryagin.numerics.tape import FUNCTIONS, Recorded, Tape, operands

BINARY = {"add": "fadd", "sub": "fsub", "mul": "fmul", "div": "fdiv"}
INTRINSIC = ("sqrt", "sin", "cos", "exp", "log", "pow", "fabs", "copysign")
"""Functions that LLVM knows; the others are the C library's."""
TWO = ("pow", "atan2", "copysign")
"""Functions of two numbers."""


def declarations() -> str:
    """The functions of numbers that a tape may call, declared."""
    numbers = {name: "double, double" if name in TWO else "double" for name in (*FUNCTIONS, "pow")}
    return "\n".join(f"declare double {symbol(name)}({taken})" for name, taken in numbers.items()) + "\n"


def symbol(name: str) -> str:
    """What a function is called in LLVM's text."""
    return f"@llvm.{name}.f64" if name in INTRINSIC else f"@{name}"


def function(
    name: str,
    tape: Tape,
    states: int,
    numbers: Sequence[Recorded],
    directions: Sequence[Recorded] = (),
    width: int = 1,
) -> str:
    """The text of a function (t, x, p, out) of pointers to doubles, but for the time t.

    Parameters
    ----------
    name : str
        Its name.
    tape : Tape
        What it computes.
    states : int
        Number of states in x. A vector for each state may follow them.
    numbers, directions : sequence of Recorded
        The numbers that it writes to ``out``, and the vectors that it writes after them.
    width : int
        Length of the vectors.
    """
    lines = [f"define void @{name}(double %t, ptr noalias %x, ptr noalias %p, ptr noalias %out) {{"]
    held: dict[int, str] = {}
    spread: dict[int, str] = {}
    vector = f"<{width} x double>"

    def write(place: str, text: str) -> str:
        lines.append(f"  {place} = {text}")
        return place

    def taken(place: int, as_vector: bool) -> str:
        """An operand, a number being repeated where a vector is needed."""
        if not as_vector or tape.vectors[place]:
            return held[place]
        if place not in spread:
            first = write(f"%f{place}", f"insertelement {vector} poison, double {held[place]}, i32 0")
            mask = f"<{width} x i32> zeroinitializer"
            spread[place] = write(f"%s{place}", f"shufflevector {vector} {first}, {vector} poison, {mask}")
        return spread[place]

    def load(place: int, pointer: str, index: int, kind: str) -> str:
        at = write(f"%a{place}", f"getelementptr double, ptr {pointer}, i64 {index}")
        return write(f"%v{place}", f"load {kind}, ptr {at}, align 8")

    for place in tape.needed([*numbers, *directions]):
        operation, is_vector = tape.operations[place], tape.vectors[place]
        kind, what = vector if is_vector else "double", operation[0]
        if what == "constant":
            held[place] = number(operation[1])
        elif what == "time":
            held[place] = "%t"
        elif what == "state":
            held[place] = load(place, "%x", operation[1], kind)
        elif what == "parameter":
            held[place] = load(place, "%p", operation[1], kind)
        elif what == "column":
            held[place] = load(place, "%x", states + width * operation[1], kind)
        else:
            given = [taken(operand, is_vector) for operand in operands(operation)]
            if what in BINARY:
                text = f"{BINARY[what]} {kind} {given[0]}, {given[1]}"
            elif what == "neg":
                text = f"fneg {kind} {given[0]}"
            else:
                text = f"call double {symbol(what)}({', '.join(f'double {value}' for value in given)})"
            held[place] = write(f"%v{place}", text)
    for i, result in enumerate((*numbers, *directions)):
        beyond = i - len(numbers)
        kind, at = ("double", i) if beyond < 0 else (vector, len(numbers) + width * beyond)
        target = write(f"%o{i}", f"getelementptr double, ptr %out, i64 {at}")
        lines.append(f"  store {kind} {taken(result.place, beyond >= 0)}, ptr {target}, align 8")
    return "\n".join([*lines, "  ret void", "}"]) + "\n"


def number(value: float) -> str:
    """A double in LLVM's text, by its bits."""
    return f"0x{struct.unpack('<Q', struct.pack('<d', value))[0]:016X}"
