"""Instructions of LLVM on vectors with one number for each trajectory, and sine and cosine of such vectors.

Sine and cosine are computed together, by the reduction and the polynomials of the C libraries that come from
Sun's fdlibm, to less than one unit in the last place. Functions without vector instructions are called once
for each lane.
"""

from collections.abc import Sequence
from functools import partial

from pontryagin.numerics import assembly
from pontryagin.numerics.lane_loop import LANES

VECTOR = f"<{LANES} x double>"
WHOLE = ("sqrt", "fabs", "copysign", "rint")
"""Functions that the processor evaluates on whole vectors."""

LARGEST = 800_000.0
"""Sine and cosine of larger arguments are the C library's."""
QUARTERS = (1.57079632673412561417, 6.07710050630396597660e-11, 2.02226624879595063154e-21)
"""pi/2 in three parts, of which the first two have 33 bits, so that their products are exact."""
SINE = (
    -1.66666666666666324348e-01,
    8.33333333332248946124e-03,
    -1.98412698298579493134e-04,
    2.75573137070700676789e-06,
    -2.50507602534068634195e-08,
    1.58969099521155010221e-10,
)
"""Coefficients of (sin x - x)/x^3 in powers of x^2, for |x| < pi/4."""
COSINE = (
    4.16666666666666019037e-02,
    -1.38888888888741095749e-03,
    2.48015872894767294178e-05,
    -2.75573143513906633035e-07,
    2.08757232129817482790e-09,
    -1.13596475577881948265e-11,
)
"""Coefficients of (cos x - 1 + x^2/2)/x^4 in powers of x^2, for |x| < pi/4."""


class Instructions:
    """Lines of a function's text, with a new name for each result."""

    def __init__(self, prefix: str) -> None:
        self.lines: list[str] = []
        self._prefix = prefix

    def write(self, text: str) -> str:
        """Add an instruction; the name of its result."""
        name = f"%{self._prefix}{len(self.lines)}"
        self.lines.append(f"  {name} = {text}")
        return name

    def binary(self, name: str, left: str, right: str) -> str:
        """A sum, difference, product or quotient of vectors."""
        return self.write(f"{assembly.BINARY[name]} {VECTOR} {left}, {right}")

    def chosen(self, condition: str, this: str, that: str) -> str:
        """In each lane one of two numbers."""
        return self.write(f"select <{LANES} x i1> {condition}, {VECTOR} {this}, {VECTOR} {that}")

    def function(self, name: str, *arguments: str) -> str:
        """A function of vectors."""
        if name in WHOLE:
            given = ", ".join(f"{VECTOR} {a}" for a in arguments)
            return self.write(f"call {VECTOR} @llvm.{name}.v{LANES}f64({given})")
        result = "poison"
        for lane in range(LANES):
            parts = [self.write(f"extractelement {VECTOR} {a}, i32 {lane}") for a in arguments]
            given = ", ".join(f"double {part}" for part in parts)
            value = self.write(f"call double {assembly.symbol(name)}({given})")
            result = self.write(f"insertelement {VECTOR} {result}, double {value}, i32 {lane}")
        return result


def constant(value: float) -> str:
    """A vector of equal numbers."""
    return "<" + ", ".join([f"double {assembly.number(value)}"] * LANES) + ">"


WIDE = f'"prefer-vector-width"="{64 * LANES}" "min-legal-vector-width"="{64 * LANES}"'
"""Attributes that let a function use the widest vectors of the processor."""


def sine_and_cosine() -> str:
    """The text of a function of a vector that returns its sine and its cosine."""
    text = Instructions("s")
    size, most = text.function("fabs", "%x"), constant(LARGEST)
    small = text.write(f"fcmp ole {VECTOR} {size}, {most}")
    whole = text.write(f"bitcast <{LANES} x i1> {small} to i{LANES}")
    every = text.write(f"icmp eq i{LANES} {whole}, -1")
    text.lines += [f"  br i1 {every}, label %near, label %far", "near:"]
    sine, cosine = _reduced(text)
    text.lines += [*_returned(text, sine, cosine), "far:"]
    text.lines += _returned(text, text.function("sin", "%x"), text.function("cos", "%x"))
    head = f"define internal {{{VECTOR}, {VECTOR}}} @sine_and_cosine({VECTOR} %x) alwaysinline {WIDE} {{"
    return "\n".join([head, *text.lines, "}"]) + "\n"


def _returned(text: Instructions, sine: str, cosine: str) -> list[str]:
    kind = f"{{{VECTOR}, {VECTOR}}}"
    first = text.write(f"insertvalue {kind} poison, {VECTOR} {sine}, 0")
    both = text.write(f"insertvalue {kind} {first}, {VECTOR} {cosine}, 1")
    return [f"  ret {kind} {both}"]


def _reduced(text: Instructions) -> tuple[str, str]:
    """Sine and cosine of %x, from those of its distance to the nearest multiple of pi/2."""
    turns = text.function("rint", text.binary("mul", "%x", constant(0.63661977236758134308)))
    first, second, third = (text.binary("mul", turns, constant(part)) for part in QUARTERS)
    rest = text.binary("sub", "%x", first)
    near = text.binary("sub", rest, second)
    lost = text.binary("sub", text.binary("sub", text.binary("sub", rest, near), second), third)
    head = text.binary("add", near, lost)
    tail = text.binary("add", text.binary("sub", near, head), lost)
    sine, cosine = _polynomials(text, head, tail)
    integers = f"<{LANES} x i32>"
    quarter = text.write(f"fptosi {VECTOR} {turns} to {integers}")

    def bit(value: str, mask: int) -> str:
        masked = text.write(f"and {integers} {value}, {_integers(mask)}")
        return text.write(f"icmp ne {integers} {masked}, zeroinitializer")

    swapped = bit(quarter, 1)
    next_quarter = text.write(f"add {integers} {quarter}, {_integers(1)}")
    results = []
    for value, other, at in ((sine, cosine, quarter), (cosine, sine, next_quarter)):
        taken = text.chosen(swapped, other, value)
        opposite = text.write(f"fneg {VECTOR} {taken}")
        results.append(text.chosen(bit(at, 2), opposite, taken))
    return results[0], results[1]


def _polynomials(text: Instructions, x: str, tail: str) -> tuple[str, str]:
    """Sine and cosine of x + tail, for |x| < pi/4 and a tail below its rounding."""
    add, subtract, multiply = (partial(text.binary, of) for of in ("add", "sub", "mul"))

    def horner(coefficients: Sequence[float]) -> str:
        total = constant(coefficients[-1])
        for coefficient in coefficients[-2::-1]:
            total = add(multiply(total, square), constant(coefficient))
        return total

    square, half = multiply(x, x), constant(0.5)
    cube = multiply(square, x)
    by_tail = subtract(multiply(half, tail), multiply(cube, horner(SINE[1:])))
    bent = subtract(multiply(square, by_tail), tail)
    sine = subtract(x, subtract(bent, multiply(cube, constant(SINE[0]))))
    halved = multiply(half, square)
    near_one = subtract(constant(1.0), halved)
    lost = subtract(subtract(constant(1.0), near_one), halved)
    quartic = subtract(multiply(multiply(square, square), horner(COSINE)), multiply(x, tail))
    return sine, add(near_one, add(lost, quartic))


def _integers(value: int) -> str:
    return "<" + ", ".join([f"i32 {value}"] * LANES) + ">"
