"""Enclosures of SymPy expressions: all values that they take where their symbols lie in discs.

`enclosure` compiles expressions once; the function that it makes evaluates them in disc arithmetic on arrays.
Real discs give ranges of values. Complex discs give bounds of the analytic continuation, and a bound on a
complex neighbourhood says how fast series and quadratures converge: no feature can hide between their nodes.
"""

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.errors import ArgumentValueError
from pontryagin.numerics import disc_functions as functions
from pontryagin.numerics import discs
from pontryagin.numerics.discs import ROUNDING, Disc

if TYPE_CHECKING:
    import sympy as sp

Step = Callable[[list[Any]], Any]
"""One operation: from all results so far to the next one, a disc or a condition."""
Enclosure = Callable[..., list[Disc]]
"""From discs or exact arrays, one for each symbol, to a disc for each expression."""

LARGEST_POWER = 1024
"""Whole powers up to this are taken as such, larger ones through the logarithm."""


def enclosure(
    symbols: Sequence["sp.Symbol"],
    expressions: Iterable["sp.Expr"],
    across: Iterable["sp.Symbol"] = (),
) -> Enclosure:
    """A function from discs, one for each symbol, to discs that hold all values of the expressions.

    Parameters
    ----------
    symbols : sequence of sympy.Symbol
        Real symbols. Arguments of the function made are a `Disc` or an array for each; arrays are exact.
    expressions : iterable of sympy.Expr
    across : iterable of sympy.Symbol
        Symbols across whose kinks (of Abs, sign, Max, Min, Heaviside, Piecewise) a complex disc is continued:
        the result holds the continuation of every piece. Other kinks have no continuation, and complex discs
        that hold one have an infinite result. Real discs hold the values of all pieces in any case.

    Returns
    -------
    function of discs
        It gives a list of discs, (...) each, the shape that the arguments broadcast to or a smaller one. A
        radius is infinite where an expression is not defined on the whole disc, or holds a function that is
        not known here.

    Examples
    --------
    >>> import sympy as sp
    >>> t = sp.Symbol("t", real=True)
    >>> ranges = enclosure([t], [1 + 99 * sp.exp(-10**5 * (t - sp.Rational(3, 2)) ** 2)])
    >>> ends = np.array([1.0, 1.4, 1.6, 2.0])
    >>> (bump,) = ranges(Disc.between(ends[:-1], ends[1:]))
    >>> bump.upper.round(3).tolist()
    [1.0, 100.0, 1.0]
    """
    program = _Program(symbols, set(across))
    places = [program.place(expression) for expression in expressions]
    steps, count = tuple(program.steps), len(symbols)

    def enclosed(*arguments: Disc | ArrayLike) -> list[Disc]:
        if len(arguments) != count:
            raise TypeError(f"the enclosure takes {count} arguments, got {len(arguments)}")
        results: list[Any] = [a if isinstance(a, Disc) else exact(a) for a in arguments]
        with np.errstate(all="ignore"):
            for step in steps:
                results.append(step(results))
            return [results[place].settled for place in places]

    return enclosed


def exact(value: ArrayLike) -> Disc:
    """Discs of radius zero."""
    centre = np.asarray(value, np.complex128) if np.iscomplexobj(value) else np.asarray(value, np.float64)
    return Disc(centre, np.zeros(centre.shape))


class _Program:
    """The operations of expressions in their order, each subexpression once."""

    def __init__(self, symbols: Sequence["sp.Symbol"], across: set["sp.Symbol"]) -> None:
        self.across = across
        self.inputs = len(symbols)
        self.steps: list[Step] = []
        self.known: dict[Any, int] = {symbol: i for i, symbol in enumerate(symbols)}

    def place(self, expression: Any) -> int:
        """The place of the result of an expression."""
        if expression not in self.known:
            if expression.is_Symbol:
                known = ", ".join(map(str, list(self.known)[: self.inputs]))
                raise ArgumentValueError(
                    f"expressions must hold no symbols but {known}, got {expression}", "expressions"
                )
            step = self._step(expression)
            self.known[expression] = self.inputs + len(self.steps)
            self.steps.append(step)
        return self.known[expression]

    def _do(self, function: Callable[..., Any], *operands: Any) -> Step:
        places = [self.place(operand) for operand in operands]
        if len(places) == 1:
            (only,) = places
            return lambda results: function(results[only])
        return lambda results: function(*(results[place] for place in places))

    def _step(self, e: Any) -> Step:
        import sympy as sp

        if e.is_number and not e.has(sp.core.relational.Relational, sp.Piecewise):
            return _constant(e)
        if isinstance(e, sp.Add):
            return self._sum(e)
        if isinstance(e, sp.Mul):
            return self._product(e)
        if isinstance(e, sp.Pow | sp.exp):
            return self._power(*e.as_base_exp())
        if isinstance(e, sp.Piecewise):
            return self._pieces(e)
        if isinstance(e, sp.Max | sp.Min):
            return self._extreme(e)
        across = bool(e.free_symbols & self.across)
        if isinstance(e, sp.Abs):
            return self._do(lambda disc: discs.magnitude(disc, across), e.args[0])
        if isinstance(e, sp.sign):
            return self._do(lambda disc: discs.sign(disc, across), e.args[0])
        if isinstance(e, sp.Heaviside):
            return self._do(lambda disc: discs.sign(disc, across).shifted(1.0).scaled(0.5), e.args[0])
        if isinstance(e, sp.atan2):
            return self._do(functions.atan2, *e.args)
        name = type(e).__name__
        if name in FUNCTIONS and len(e.args) == 1:
            return self._do(FUNCTIONS[name], e.args[0])
        return self._do(lambda *operands: _unknown(*operands), *(a for a in e.args if a.free_symbols))

    def _sum(self, e: "sp.Add") -> Step:
        constant, rest = e.as_coeff_Add()
        terms = rest.args if rest.is_Add else (rest,)
        total = self._chain(lambda a, b: a + b, [self.place(term) for term in terms])
        if not constant:
            return total
        exactly = _float(constant)
        if exactly is not None:
            return lambda results: total(results).shifted(exactly)
        added = _constant(constant)
        return lambda results: total(results) + added(results)

    def _product(self, e: "sp.Mul") -> Step:
        factor, rest = e.as_coeff_Mul()
        above: list[int] = []
        below: list[int] = []
        for part in rest.args if rest.is_Mul else (rest,):
            base, exponent = part.as_base_exp()
            inverted = exponent.is_number and exponent.is_negative and not part.is_number
            (below if inverted else above).append(self.place(base**-exponent if inverted else part))
        numerator = self._chain(lambda a, b: a * b, above) if above else _constant(factor)
        denominator = self._chain(lambda a, b: a * b, below) if below else None
        exactly, scale = _float(factor), _constant(factor)

        def product(results: list[Any]) -> Disc:
            disc: Disc = numerator(results)
            if above and factor != 1:
                disc = disc * scale(results) if exactly is None else disc.scaled(exactly)
            return disc if denominator is None else disc / denominator(results)

        return product

    def _chain(self, operation: Callable[[Disc, Disc], Disc], places: list[int]) -> Step:
        first, *others = places

        def chained(results: list[Any]) -> Disc:
            total: Disc = results[first]
            for place in others:
                total = operation(total, results[place])
            return total

        return chained

    def _power(self, base: Any, exponent: Any) -> Step:
        import sympy as sp

        if base is sp.E:
            return self._do(functions.exp, exponent)
        if exponent.is_Integer and 0 < abs(exponent) <= LARGEST_POWER:
            whole = int(exponent)
            return self._do(lambda disc: discs.whole_power(disc, whole), base)
        real = _float(exponent) if exponent.is_number else None
        if real is not None and not exponent.is_Integer:
            if base.is_Mul and base.as_numer_denom()[1].free_symbols:
                return self._do(lambda a, b: functions.quotient_power(a, b, real), *base.as_numer_denom())
            return self._do(functions.sqrt if real == 0.5 else lambda d: functions.real_power(d, real), base)
        return self._do(lambda b, x: functions.exp(functions.log(b) * x), base, exponent)

    def _extreme(self, e: Any) -> Step:
        import sympy as sp

        across = bool(e.free_symbols & self.across)
        if isinstance(e, sp.Max):
            return self._chain(lambda a, b: discs.larger(a, b, across), [self.place(a) for a in e.args])
        return self._chain(lambda a, b: -discs.larger(-a, -b, across), [self.place(a) for a in e.args])

    def _pieces(self, e: "sp.Piecewise") -> Step:
        deciding = set().union(*(condition.free_symbols for _, condition in e.args))
        across = bool(deciding & self.across)
        symbols = [self.place(symbol) for symbol in sorted(deciding, key=str)]
        values = [self.place(value) for value, _ in e.args]
        conditions = [self._condition(condition) for _, condition in e.args]

        def joined(results: list[Any]) -> Disc:
            known = across or all(discs.is_real(results[symbol]) for symbol in symbols)
            return discs.joined([results[v] for v in values], [c(results) for c in conditions], known)

        return joined

    def _condition(self, condition: Any) -> Callable[[list[Any]], discs.Condition]:
        import sympy as sp

        if condition in (sp.true, sp.false):
            held = np.asarray(bool(condition))
            return lambda results: (held, ~held)
        if isinstance(condition, sp.And | sp.Or):
            parts = [self._condition(part) for part in condition.args]
            all_of = isinstance(condition, sp.And)
            return lambda results: discs.combined([part(results) for part in parts], all_of)
        if isinstance(condition, sp.Not):
            inner = self._condition(condition.args[0])
            return lambda results: inner(results)[::-1]
        if isinstance(condition, sp.StrictGreaterThan | sp.GreaterThan | sp.StrictLessThan | sp.LessThan):
            place = self.place(condition.gts - condition.lts)
            return lambda results: (results[place].lower > 0, results[place].upper < 0)
        operands = [self.place(a) for a in condition.args if hasattr(a, "free_symbols") and a.free_symbols]

        def undecided(results: list[Any]) -> discs.Condition:
            shape = np.broadcast_shapes(*(np.shape(results[place].centre) for place in operands))
            return np.zeros(shape, bool), np.zeros(shape, bool)

        return undecided


def _like(*operands: Disc) -> Disc:
    """A disc of the shape and kind that the operands have together."""
    total = exact(0.0)
    for operand in operands:
        total = total + operand
    return total


def _unknown(*operands: Disc) -> Disc:
    return discs.whole(_like(*operands))


def _float(number: "sp.Expr") -> float | None:
    """A real number as a float if that is exact, else None."""
    import sympy as sp

    if not (number.is_Rational or number.is_Float):
        return None
    value = float(number)
    return value if np.isfinite(value) and sp.Rational(value) == sp.Rational(number) else None


def _constant(number: "sp.Expr") -> Step:
    """A number, with the rounding of its value."""
    exactly = _float(number)
    if exactly is not None:
        disc = exact(exactly)
    else:
        digits = number.evalf(20)
        value = float(digits) if digits.is_real and digits.is_finite else np.inf
        disc = Disc(np.asarray(value), np.asarray(ROUNDING * abs(value) + discs.TINY)).settled
    return lambda results: disc


FUNCTIONS: dict[str, Callable[[Disc], Disc]] = {
    name: getattr(functions, name)
    for name in (
        *("log", "sin", "cos", "tan", "sinh", "cosh", "tanh"),
        *("asin", "acos", "atan", "asinh", "acosh", "atanh", "erf"),
    )
}
"""Functions of one argument, by SymPy's names."""
