"""A convex set of controls given by its support function."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import sympy as sp

from pontryagin.averaging.system.control_checks import Numbers, listed, refusal
from pontryagin.averaging.system.control_sets import Bounded
from pontryagin.averaging.system.expressions import expression, vector
from pontryagin.averaging.system.jets import restored, with_constant_signs
from pontryagin.errors import ArgumentTypeError
from pontryagin.numerics import compile as compiler
from pontryagin.value import value_class


@value_class
@dataclass(frozen=True, eq=False)
class Custom(Bounded):
    """Any compact convex set, given by its support function.

    Parameters
    ----------
    of : callable
        From m SymPy expressions s to sigma(s) as a SymPy expression, convex and homogeneous of degree one.
        Write its kinks with Abs, Max or Piecewise: the average is split there.

    Examples
    --------
    The cylinder of the paper's third example, a disc in x, y times an interval in z:

    >>> p, q, r = sp.symbols("p q r", real=True)
    >>> cylinder = Custom(lambda s: sp.sqrt(s[0]**2 + s[1]**2) + 2 * sp.Abs(s[2]))
    >>> list(cylinder.maximiser([p, q, r]))
    [p/sqrt(p**2 + q**2), q/sqrt(p**2 + q**2), 2*sign(r)]
    """

    of: Callable[[Sequence[sp.Expr]], sp.Expr]

    def __post_init__(self) -> None:
        if not callable(self.of):
            raise ArgumentTypeError(f"Custom: of must be a function of expressions, got {self.of!r}", "of")

    def support(self, s: Sequence[sp.Expr]) -> sp.Expr:
        """The given support function, with its Max and Min written with Abs."""
        value = expression("Custom: the support function's value", self.of(vector("s", s)), "of")
        return value.rewrite((sp.Max, sp.Min), sp.Abs)

    def maximiser(self, s: Sequence[sp.Expr]) -> sp.Matrix:
        """The gradient of the support function, by the envelope theorem."""
        free = [sp.Dummy(f"s{i}", real=True) for i in range(len(s))]
        value, signs = with_constant_signs(self.support(free))
        at = dict(zip(free, vector("s", s), strict=True))
        return sp.Matrix([restored(value.diff(part), signs).xreplace(at) for part in free])

    def require_convex(self, dimension: int, numbers: Numbers) -> None:
        """Sigma must be homogeneous and subadditive, hence convex; tested in random directions."""
        free = [sp.Dummy(f"s{i}", real=True) for i in range(dimension)]
        value = self.support(free)
        unknown = value.free_symbols - set(free) - set(numbers)
        if unknown:
            raise refusal(
                f"Custom: the support function holds unknown symbols {listed(unknown)}; beside its "
                f"arguments it may hold {listed(numbers) or 'numbers only'}"
            )
        symbols = sorted(value.free_symbols & set(numbers), key=str)
        evaluate = compiler.function("support", [*free, *symbols], {"sigma": value})
        constants = [np.asarray(numbers[symbol], dtype=float)[..., None] for symbol in symbols]
        pairs = np.random.default_rng(1977).standard_normal((2, dimension, 512))
        first, second, both, tripled, opposite = (
            evaluate(*s, *constants)[0]
            for s in (pairs[0], pairs[1], pairs[0] + pairs[1], 3 * pairs[0], -pairs[0])
        )
        scale = 1e-12 * (np.abs(first) + np.abs(second) + np.abs(both))
        if not (np.abs(tripled - 3 * first) <= 3 * scale).all():
            raise refusal(
                "Custom: the support function must be homogeneous of degree one, got a sigma with "
                "sigma(3 s) other than 3 sigma(s)"
            )
        if not (both <= first + second + scale).all() or not (first + opposite >= -scale).all():
            raise refusal(
                "Custom: the support function must be convex, as that of every convex set is, "
                "got one that is not"
            )
