"""The formulas of the paper's routes, (3.6), (3.7), (3.16) and (3.19), compiled from the derivation."""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import sympy as sp

from pontryagin.numerics.compile import function
from pontryagin.triple_integrator.derivation import parabola
from pontryagin.triple_integrator.derivation.channel import tf
from pontryagin.triple_integrator.derivation.model import T, c


@cache
def area_from_zeros() -> Callable[..., tuple[Any, ...]]:
    """The function (t1, t2, c1, c2, c3, T) -> F of (3.6) with l from (3.5), dF/dt1, dF/dt2, and c0."""
    t1, t2 = parabola.t1, parabola.t2
    area = sp.cancel(parabola.objective((t1, t2), c, T))
    c0 = sp.expand(1 / parabola.multipliers_from_zeros()[0]).subs(tf, T)
    outputs = {"F": area, "F1": sp.diff(area, t1), "F2": sp.diff(area, t2), "c0": c0}
    return function("area_from_zeros", [t1, t2, *c, T], outputs)


@cache
def zeros_from_multiplier() -> Callable[..., tuple[Any, ...]]:
    """The function (lambda~, c1, c2, c3, T) -> t1, t2 of (3.18) and (3.19), and alpha_m of (3.16)."""
    curve = parabola.curve()
    apex, half_width = curve[parabola.apex], curve[parabola.half_width]
    outputs = {
        "t1": apex - half_width,
        "t2": apex + half_width,
        "alpha": parabola.curvature_on_the_curve().subs(curve),
    }
    return function("zeros_from_multiplier", [parabola.slope, *c, T], outputs)


@cache
def domain_conditions() -> Callable[..., tuple[Any, ...]]:
    """(c1, c2, c3, T) -> numerators of t1 and T - t2 over T + lambda~ c3, as coefficients of lambda~."""
    curve = parabola.curve()
    apex, half_width = curve[parabola.apex], curve[parabola.half_width]
    span = T + parabola.slope * c[2]
    outputs = {}
    for name, distance in (("start", apex - half_width), ("end", T - apex - half_width)):
        numerator = sp.Poly(sp.cancel(distance * span), parabola.slope)
        outputs[name] = sp.Matrix([[numerator.coeff_monomial(parabola.slope**i) for i in (2, 1, 0)]])
    raw = function("conditions", [*c, T], outputs)
    return lambda *values: tuple(np.ravel(part) for part in raw(*values))
