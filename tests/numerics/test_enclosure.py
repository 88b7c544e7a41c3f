"""Disc arithmetic holds every value: random expressions against mpmath at 40 digits."""

import mpmath
import numpy as np
import pytest
import sympy as sp
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from pontryagin.errors import ArgumentValueError
from pontryagin.numerics.discs import Disc
from pontryagin.numerics.enclosure import enclosure

t, x = sp.symbols("t x", real=True)
SMOOTH = [sp.exp, sp.log, sp.sqrt, sp.sin, sp.cos, sp.tan, sp.sinh, sp.cosh, sp.tanh, sp.atan, sp.asinh]
SMOOTH += [sp.asin, sp.acos, sp.atanh, sp.acosh, sp.erf]
NUMBERS = [sp.Integer(k) for k in (-3, -1, 1, 2, 7)] + [sp.Rational(1, 3), sp.pi, sp.Float("0.1", 30)]
POWERS = [sp.Integer(k) for k in (-2, -1, 2, 3, 5)] + [sp.Rational(k, 3) for k in (-4, 1, 4)] + [sp.pi]


def trees(functions):
    leaves = st.sampled_from([t, x, t, x, *NUMBERS])

    def extended(inner):
        return st.one_of(
            st.builds(lambda a, b: a + b, inner, inner),
            st.builds(lambda a, b: a * b, inner, inner),
            st.builds(lambda a, n: a**n if a.free_symbols else a, inner, st.sampled_from(POWERS)),
            st.builds(lambda f, a: f(a) if a.free_symbols else a, st.sampled_from(functions), inner),
        )

    return st.recursive(leaves, extended, max_leaves=6)


def with_kinks(functions):
    smooth = trees(functions)
    kinked = st.one_of(
        st.builds(sp.Abs, smooth),
        st.builds(sp.sign, smooth),
        st.builds(sp.Max, smooth, smooth),
        st.builds(sp.Min, smooth, smooth),
        st.builds(lambda a, b, c: sp.Piecewise((a, b > c), (c, True)), smooth, smooth, smooth),
        st.builds(
            lambda a, b: sp.Piecewise((a, sp.And(t > 0, x < b)), (b, sp.Or(t < -1, x > 2)), (a + b, True)),
            smooth,
            smooth,
        ),
        st.builds(lambda a, b: a * sp.Heaviside(b, sp.S.Half), smooth, smooth),
    )
    return st.one_of(kinked, st.builds(lambda f, a, b: f(a) + b, st.sampled_from(functions), kinked, kinked))


CENTRES = st.tuples(st.floats(-4, 4), st.floats(-4, 4))
RADII = st.tuples(*(2 * [st.sampled_from([0.0, 1e-9, 1e-3, 0.1, 1.0, 3.0])]))


def known(expression):
    assume(isinstance(expression, sp.Expr) and expression.free_symbols)
    assume(not expression.has(sp.nan, sp.oo, sp.zoo, sp.I))
    return expression


def moderate(function):
    """The function, which gives up an example whose intermediate results are out of all proportion."""

    def bounded(*arguments):
        assume(all(abs(a) < 1e4 for a in arguments))
        return function(*arguments)

    return bounded


EXACT = {
    name: moderate(getattr(mpmath, name)) for name in ("exp", "sinh", "cosh", "tan", "sin", "cos", "erf")
}


def values(expression, points):
    """Exact values at pairs of numbers; None where the expression is not defined there."""
    evaluate = sp.lambdify([t, x], expression, [EXACT, "mpmath"])
    with mpmath.workdps(40):
        for point in points:
            try:
                yield mpmath.mpmathify(evaluate(*(mpmath.mpmathify(number) for number in point)))
            except (ZeroDivisionError, ValueError, OverflowError, TypeError):
                yield None


@settings(max_examples=50)
@given(with_kinks(SMOOTH), CENTRES, RADII)
def test_real_discs_hold_the_values(expression, centres, radii):
    expression = known(expression)
    (disc,) = enclosure([t, x], [expression])(
        *(Disc(np.array(c), np.array(r)) for c, r in zip(centres, radii, strict=True))
    )
    shares = [(a, b) for a in (-1, -0.4, 0, 0.7, 1) for b in (-1, -0.5, 0, 0.3, 1)]
    points = [
        tuple(mpmath.mpf(c) + mpmath.mpf(s) * r for c, r, s in zip(centres, radii, share, strict=True))
        for share in shares
    ]
    for value in values(expression, points):
        if value is None or mpmath.isnan(value) or mpmath.im(value):
            assert disc.radius == np.inf or expression.has(sp.Piecewise)
        else:
            assert disc.lower <= mpmath.re(value) <= disc.upper


@settings(max_examples=50)
@given(trees(SMOOTH), st.tuples(*4 * [st.floats(-3, 3)]), RADII)
def test_complex_discs_hold_the_continuation(expression, parts, radii):
    expression = known(expression)
    assume(not expression.has(sp.Abs, sp.sign))
    centres = [complex(parts[0], parts[1]), complex(parts[2], parts[3])]
    (disc,) = enclosure([t, x], [expression])(
        *(Disc(np.array(c), np.array(r)) for c, r in zip(centres, radii, strict=True))
    )
    if not np.isfinite(disc.radius):
        return
    turns = [(a, b) for a in (0, 1.0, 2.5, 4.0, 5.0) for b in (0.5, 2.0, 3.5, 5.5)]
    points = [
        tuple(
            mpmath.mpmathify(c) + r * mpmath.expj(s) * 0.999999
            for c, r, s in zip(centres, radii, turn, strict=True)
        )
        for turn in turns
    ]
    for value in values(expression, points):
        assert value is not None and abs(value - mpmath.mpmathify(complex(disc.centre))) <= disc.radius


@given(trees([sp.exp, sp.sin, sp.tanh, sp.sqrt]), CENTRES)
def test_a_point_has_a_disc_of_rounding_size(expression, centres):
    expression = known(expression)
    (disc,) = enclosure([t, x], [expression])(*map(np.array, centres))
    (value, *slopes) = (
        next(values(e, [centres])) for e in (expression, expression.diff(t), expression.diff(x))
    )
    assume(all(v is not None and mpmath.isfinite(v) and abs(v) < 1e3 for v in (value, *slopes)))
    assume(not mpmath.im(value))
    assert disc.radius <= 1e-9 * (1 + abs(value))


def test_subdivision_closes_in_on_the_range():
    """1 + 99 exp(-1e5 (t - 3/2)^2): far from its bump, and near it, the bounds close in on the values."""
    ranges = enclosure([t], [1 + 99 * sp.exp(-(10**5) * (t - sp.Rational(3, 2)) ** 2)])
    for count in (10, 100, 1000):
        edges = np.linspace(1, 2, count + 1)
        (disc,) = ranges(Disc.between(edges[:-1], edges[1:]))
        away = np.abs(edges[:-1] + edges[1:] - 3) > 0.08 + 1 / count
        assert disc.upper[away].max() < 1 + 1e-12 and disc.lower.min() > 1 - 1e-12
        assert 100 <= disc.upper.max() < 101


def test_a_bump_is_seen_in_the_complex_plane():
    """A disc beside the bump bounds it; one that reaches over it in the imaginary direction does not."""
    (disc,) = enclosure([t], [sp.exp(-(10**5) * t**2)])(Disc(np.array([0.5 + 0j, 0.0]), np.array([0.1, 0.1])))
    assert disc.size[0] < 1e-100 and disc.size[1] > 1e100


def test_kinks_are_continued_across_the_chosen_symbols_only():
    steps = [sp.Piecewise((value, t > 0), (0, True)) for value in (t, 1)]
    disc = Disc(np.array([0.0 + 0j, 2.0]), np.array([0.5, 0.5]))
    for kink in (sp.Abs(t), sp.sign(t), sp.Max(t, 0), *steps, sp.Heaviside(t)):
        (strict,) = enclosure([t], [kink])(disc)
        (continued,) = enclosure([t], [kink], across=[t])(disc)
        assert strict.radius.tolist()[0] == np.inf and strict.size[1] <= 2.6
        assert continued.size.max() <= 2.6


def test_an_unknown_function_gives_everything():
    (disc,) = enclosure([t], [sp.Function("f")(t) + sp.floor(t)])(np.zeros(3))
    assert disc.radius.shape == (3,) and (disc.radius == np.inf).all()


def test_an_unknown_symbol_is_refused():
    with pytest.raises(ArgumentValueError, match=r"no symbols but t, got x") as error:
        enclosure([t], [x + t])
    assert error.value.argument == "expressions"


def test_many_discs_are_those_of_each():
    ranges = enclosure([t, x], [sp.sin(t) / (2 + x), sp.Abs(x) ** sp.Rational(3, 2), sp.Integer(3)])
    centre, radius = np.linspace(-1, 2, 7), np.linspace(0, 1, 7)
    together = ranges(Disc(centre, radius), centre)
    for i in range(7):
        alone = ranges(Disc(centre[i], radius[i]), centre[i])
        for one, many in zip(alone, together, strict=True):
            assert (one.lower == np.broadcast_to(many.lower, 7)[i]).all()
            assert (one.upper == np.broadcast_to(many.upper, 7)[i]).all()
