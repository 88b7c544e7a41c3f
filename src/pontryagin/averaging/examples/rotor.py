"""Example 1, (3.1): a rotor with a mass and a potential that depend on its angle, sped up or braked."""

from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.averaging.averaged.solution import AveragedSolution
from pontryagin.averaging.averaged.solve import solved
from pontryagin.errors import ArgumentValueError
from pontryagin.validation import common_shape, finite, positive

if TYPE_CHECKING:
    import sympy as sp

POINTS = 1440
"""Number of points of a turn at which the potential's maximum and the mass's minimum are sought."""


def rotor(
    a0: ArrayLike,
    a1: ArrayLike,
    mass: Any = 1,
    potential: Any = 0,
    force: Any = 0,
    peak: ArrayLike | None = None,
    k: ArrayLike | None = None,
) -> AveragedSolution:
    """Bring the energy of m x'' + m' x'^2/2 + V' = epsilon (u + f) from a0 to a1, (3.1).

    Parameters
    ----------
    a0, a1 : (...) array
        Energies m x'^2/2 + V, above the potential's maximum.
    mass, potential : sympy.Expr or number
        m > 0 and V, 2 pi-periodic in the symbol ``x``.
    force : sympy.Expr or number
        f, 2 pi-periodic in ``x``; it may hold the rate x' > 0 as the symbol ``v``. Symbols are identified
        by their names, whatever their assumptions.
    peak : (...) array
        Bound on |u|, for the least time. Exactly one of peak and k must be given.
    k : (...) array
        Price of slow time, for the least k tau_1 + integral of u^2.

    Returns
    -------
    AveragedSolution
        In the slow variable a.

    Raises
    ------
    TypeError, ValueError
        Naming the argument: an unknown symbol, an energy that does not exceed the potential's maximum (omega
        vanishes on the way), a mass, peak or k that is not positive, both or none of peak and k.
    Infeasible
        If the mean drift leads away from the target somewhere on the way, and no control outweighs it.

    Examples
    --------
    >>> solution = rotor(1.0, 4.0, peak=1.0)
    >>> round(float(solution.duration), 12) == round(2**0.5, 12)
    True
    """
    from pontryagin.averaging.system import derived_systems

    if (peak is None) == (k is None):
        got = "neither" if peak is None else "both"
        raise ArgumentValueError(f"exactly one of peak and k must be given, got {got}", "peak")
    given = {name: value for name, value in (("peak", peak), ("k", k)) if value is not None}
    chosen = {name: positive(name, value) for name, value in given.items()}
    begin = finite("a0", a0, "a number or an array (...)")
    end = finite("a1", a1, "a number or an array (...)")
    common_shape(a0=begin.shape, a1=end.shape, **{name: value.shape for name, value in chosen.items()})
    m, V = _of("mass", mass, "x"), _of("potential", potential, "x")
    lightest = _over_a_turn(m).min()
    if not lightest > 0:
        raise ArgumentValueError(f"mass must be positive for every x, got {lightest:.6g}", "mass")
    top = _over_a_turn(V).max()
    for name, energy in (("a0", begin), ("a1", end)):
        if not (energy > top).all():
            raise ArgumentValueError(
                f"{name} must exceed the potential's maximum {top:.6g}, at which omega vanishes, "
                f"got {energy.min():.6g}",
                name,
            )
    f = _of("force", force, "xv")
    return solved(
        derived_systems.rotor_model(m, V, f, peak is not None),
        ("a",),
        begin[..., None],
        (end, *chosen.values()),
        partial(derived_systems.rotor, m, V, f, end, chosen.get("peak"), chosen.get("k")),
    )


def _of(name: str, value: Any, letters: str) -> "sp.Expr":
    """An expression in the derivation's own x and v."""

    from pontryagin.averaging.derivation import rotor as derivation
    from pontryagin.averaging.system.checks import require_periodic
    from pontryagin.averaging.system.expressions import real_expression

    expression = real_expression(name, value)
    known = {letter: getattr(derivation, letter) for letter in letters}
    unknown = sorted({str(symbol) for symbol in expression.free_symbols} - set(known))
    if unknown:
        message = f"{name} may hold {' and '.join(known)} only, got unknown symbols {', '.join(unknown)}"
        raise ArgumentValueError(message, name)
    own = expression.xreplace({symbol: known[str(symbol)] for symbol in expression.free_symbols})
    require_periodic(name, own, derivation.x, {})
    return own


@lru_cache(maxsize=64)
def _over_a_turn(expression: "sp.Expr") -> np.ndarray:
    from pontryagin.averaging.derivation import rotor as derivation
    from pontryagin.numerics import compile as compiler

    angles = 2 * np.pi * np.arange(POINTS) / POINTS
    (values,) = compiler.function("values", [derivation.x], {"value": expression})(angles)
    return np.asarray(values)
