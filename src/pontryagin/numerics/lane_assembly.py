"""A tape as LLVM's text for several trajectories side by side: every number is a vector, one for each lane.

The rates of all lanes are one function, a step of the Runge-Kutta method and its error another, both without
loops. Arithmetic is rounded as in plain numbers, and none of it is reordered.
"""

from collections.abc import Sequence
from functools import partial, reduce

from pontryagin.numerics import assembly, dop853
from pontryagin.numerics.lane_loop import LANES
from pontryagin.numerics.lane_text import VECTOR, WHOLE, WIDE, Instructions, constant, sine_and_cosine
from pontryagin.numerics.tape import Recorded, Tape, operands


def declarations() -> str:
    """The functions that the text of `function` may call, declared or defined."""
    taken = {name: f"{VECTOR}, {VECTOR}" if name in assembly.TWO else VECTOR for name in WHOLE}
    whole = (f"declare {VECTOR} @llvm.{name}.v{LANES}f64({kinds})" for name, kinds in taken.items())
    return assembly.declarations() + "\n".join(whole) + "\n" + sine_and_cosine()


def function(name: str, tape: Tape, states: int, columns: int, results: Sequence[Recorded]) -> str:
    """The text of a function (t, x, p, out) of pointers to vectors.

    Parameters
    ----------
    name : str
        Its name.
    tape : Tape
        What it computes.
    states, columns : int
        Number of states in x, and of the derivatives of each that follow them, row by row.
    results : sequence of Recorded
        What it writes to ``out``.
    """
    text = Instructions("v")
    held: dict[int, str] = {}
    pairs: dict[int, tuple[str, str]] = {}

    def load(pointer: str, index: int) -> str:
        at = text.write(f"getelementptr {VECTOR}, ptr {pointer}, i64 {index}")
        return text.write(f"load {VECTOR}, ptr {at}, align 8")

    def turned(operand: int) -> tuple[str, str]:
        """Sine and cosine of an operand, computed once."""
        if operand not in pairs:
            kind = f"{{{VECTOR}, {VECTOR}}}"
            both = text.write(f"call {kind} @sine_and_cosine({VECTOR} {held[operand]})")
            first, second = (text.write(f"extractvalue {kind} {both}, {i}") for i in range(2))
            pairs[operand] = first, second
        return pairs[operand]

    for place in tape.needed(results):
        what, *rest = tape.operations[place]
        given = [held[operand] for operand in operands(tape.operations[place])]
        if what == "constant":
            held[place] = constant(rest[0])
        elif what == "time":
            held[place] = load("%t", 0)
        elif what == "parameter":
            held[place] = load("%p", rest[0])
        elif what == "state":
            held[place] = load("%x", rest[0])
        elif what == "column":
            held[place] = load("%x", states + columns * rest[0] + rest[1])
        elif what in assembly.BINARY:
            held[place] = text.binary(what, *given)
        elif what == "neg":
            held[place] = text.write(f"fneg {VECTOR} {given[0]}")
        elif what in ("sin", "cos"):
            held[place] = turned(rest[0])[what == "cos"]
        else:
            held[place] = text.function(what, *given)
    for i, result in enumerate(results):
        at = text.write(f"getelementptr {VECTOR}, ptr %out, i64 {i}")
        text.lines.append(f"  store {VECTOR} {held[result.place]}, ptr {at}, align 8")
    head = f"define void @{name}(ptr noalias %t, ptr noalias %x, ptr noalias %p, ptr noalias %out)"
    return "\n".join([f"{head} {WIDE} {{", *text.lines, "  ret void", "}"]) + "\n"


def step(name: str, rates: str, size: int) -> str:
    """The text of a function (t, h, y, p, k, new, off, tolerance) that makes a step of all lanes.

    Parameters
    ----------
    name, rates : str
        Its name, and that of the function that computes the rates.
    size : int
        Number of numbers of a trajectory.
    """
    text = Instructions("v")
    pointers = ", ".join(f"ptr noalias %{of}" for of in ("t", "h", "y", "p", "k", "new", "off"))
    head = f"define void @{name}({pointers}, double %tolerance) {WIDE} {{"
    clock, there, slopes = (text.write(f"alloca [{n} x {VECTOR}], align 64") for n in (1, size, size))

    def load(pointer: str, index: int = 0) -> str:
        return text.write(f"load {VECTOR}, ptr {at(pointer, index)}, align 8")

    def at(pointer: str, index: int) -> str:
        return text.write(f"getelementptr {VECTOR}, ptr {pointer}, i64 {index}")

    def store(value: str, pointer: str, index: int = 0) -> None:
        text.lines.append(f"  store {VECTOR} {value}, ptr {at(pointer, index)}, align 8")

    def weighted(weights: dict[int, float], i: int) -> str:
        """The sum of the rates of number i at the stages with these weights."""
        terms = [text.binary("mul", constant(weight), stages[s][i]) for s, weight in weights.items()]
        return reduce(partial(text.binary, "add"), terms)

    def moved(weights: dict[int, float], i: int) -> str:
        return text.binary("add", y[i], text.binary("mul", h, weighted(weights, i)))

    def evaluated(share: float, states: str) -> list[str]:
        """The rates at the given share of the step."""
        store(text.binary("add", t, text.binary("mul", constant(share), h)), clock)
        text.lines.append(f"  call void @{rates}(ptr {clock}, ptr {states}, ptr %p, ptr {slopes})")
        return [load(slopes, i) for i in range(size)]

    t, h = load("%t"), load("%h")
    y, stages = [load("%y", i) for i in range(size)], [[load("%k", i) for i in range(size)]]
    for node, weights in zip(dop853.NODES[1:], dop853.STAGES[1:], strict=True):
        for i in range(size):
            store(moved(weights, i), there, i)
        stages.append(evaluated(node, there))
    new = [moved(dop853.STEP, i) for i in range(size)]
    for i in range(size):
        store(new[i], "%new", i)
    for i, rate in enumerate(evaluated(1.0, "%new")):
        store(rate, "%k", size + i)
    estimates = [(weighted(dop853.FIFTH, i), weighted(dop853.THIRD, i)) for i in range(size)]
    store(_error(text, h, list(zip(y, new, strict=True)), estimates), "%off")
    return "\n".join([head, *text.lines, "  ret void", "}"]) + "\n"


def _error(
    text: Instructions, h: str, states: Sequence[tuple[str, str]], estimates: Sequence[tuple[str, str]]
) -> str:
    """The estimated error of a step as a share of what is allowed, as in `runge_kutta.error`.

    It is made of the states before and after the step, and of the estimates of order 5 and 3 of each of them.
    """
    first = text.write(f"insertelement {VECTOR} poison, double %tolerance, i32 0")
    mask = f"<{LANES} x i32> zeroinitializer"
    tolerance = text.write(f"shufflevector {VECTOR} {first}, {VECTOR} poison, {mask}")
    squares: list[tuple[str, str]] = []
    for pair, estimate in zip(states, estimates, strict=True):
        before, after = (text.function("fabs", value) for value in pair)
        larger = text.chosen(text.write(f"fcmp ogt {VECTOR} {after}, {before}"), after, before)
        allowed = text.binary("mul", tolerance, text.binary("add", constant(0.1), larger))
        five, three = (text.binary("div", value, allowed) for value in estimate)
        squares.append((text.binary("mul", five, five), text.binary("mul", three, three)))
    fifth, third = (reduce(partial(text.binary, "add"), column) for column in zip(*squares, strict=True))
    whole = text.binary("add", fifth, text.binary("mul", constant(0.01), third))
    root = text.function("sqrt", text.binary("mul", whole, constant(float(len(states)))))
    share = text.binary("div", text.binary("mul", text.function("fabs", h), fifth), root)
    none = text.write(f"fcmp oeq {VECTOR} {whole}, zeroinitializer")
    return text.chosen(none, "zeroinitializer", share)
