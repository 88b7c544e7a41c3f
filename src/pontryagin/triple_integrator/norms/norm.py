"""Least L_q norm for any 1 < q < infinity, between least total impulse and least peak, (1.13) and (1.14).

With 1/p + 1/q = 1 and the minimal element h0 of (1.13), u = rho0^(-p) |h0|^(p-1) sign h0 is the only control
that attains the maximum in (1.14). The solver measures the time to go as a share of T, as `minimal_element`.
"""

from dataclasses import dataclass
from functools import cached_property, partial
from numbers import Real
from struct import Struct
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.certificate import Certificate
from pontryagin.errors import ArgumentTypeError, ArgumentValueError, NotConverged
from pontryagin.numerics.jit import batched
from pontryagin.triple_integrator.norms.minimal_element import solve_norm
from pontryagin.triple_integrator.norms.power_rules import table
from pontryagin.triple_integrator.norms.quadratic_programme import BLOCK, Profile, QuadraticProgramme
from pontryagin.triple_integrator.norms.quadrature import Quadratic, graded_rule
from pontryagin.triple_integrator.problem.maneuver import Maneuver
from pontryagin.triple_integrator.problem.programme import normalise, numbers_of, over_stack
from pontryagin.validation import members_of, vectors
from pontryagin.value import Packed, value_class

solve_stack = batched(solve_norm, outputs=8, groups=(4,), packed=True, tables=1)

LAST_THREE = Struct("3d")
"""Residual, norm and bound at the end of the numbers of one problem."""

CONVERGED = 1e-10
"""Largest residual of the moments and largest relative gap of a solution that is returned."""


@value_class
@dataclass(frozen=True, eq=False)
class NormSolution(Packed, QuadraticProgramme):
    """Control of least L_q norm: u = peak |h|^(p-1) sign h for a quadratic h whose largest modulus is 1.

    Attributes
    ----------
    maneuver : Maneuver
        The problem that is solved.
    q : float
        Exponent of the norm, 1 < q < infinity.
    peak : (...) array
        max |u|.
    shape : Quadratic
        h in the time to go as a share of T.
    certificate : Certificate
        Residual of the moments, relative to the largest of 6 c1/T^3, 2 c2/T^2, c3/T; the norm; and the
        bound l'c / ||l'h||_p. Norm and bound come from a quadrature rule that the solver does not use.
    """

    maneuver: Maneuver
    q: float
    peak: Array
    shape: Quadratic
    certificate: Certificate

    def _unpacked(self, numbers: Array) -> dict[str, Any]:
        return _answer(numbers[4:])

    @cached_property
    def multipliers(self) -> Array:
        """l0 of the minimal element h0 = l0'h(s), with l0'c = 1, (..., 3); zeros where c = 0."""
        h0, h1, h2 = np.moveaxis(self.shape.coefficients, -1, 0)
        return normalise(np.stack([2 * h2, h1, h0], axis=-1), self.maneuver.moments, self.maneuver.duration)

    @property
    def _knots(self) -> Array:
        """Times since the start at which u changes sign, (..., 2), where for q > 2 it is not smooth."""
        whole = self.maneuver.duration[..., None]
        return whole - whole * self.shape.zeros

    @property
    def _law(self) -> tuple[Quadratic, Profile]:
        return self.shape, partial(signed_power, power=1 / (self.q - 1))


def minimum_norm(maneuver: Maneuver, q: float) -> NormSolution:
    """Control of least L_q norm that performs the manoeuvre, (1.13) and (1.14) for any 1 < q < infinity.

    Parameters
    ----------
    maneuver : Maneuver
        One manoeuvre or a stack of them.
    q : float
        Exponent of the norm.

    Returns
    -------
    NormSolution
        The dual value of its certificate is l'c / ||l'h||_p for the multipliers found; this is a lower bound
        for every l. A stack takes 5 to 11 microseconds a manoeuvre for q from 1.1 to 1e5, and up to 80 below.

    Raises
    ------
    TypeError, ValueError
        If q is not a finite number greater than 1; `minimum_impulse` and `minimum_peak` solve q = 1 and inf.
    pontryagin.NotConverged
        If the moments are missed by more than 1e-10, or the relative gap between norm and lower bound exceeds
        it. Of 20000 random manoeuvres this happened to none for q from 1.0001 to 1e6, and to 2000 for
        q = 1.00001, where rounding in the exponent p = 100001 costs as much.

    Examples
    --------
    >>> s = minimum_norm(Maneuver([0, 0, 0], [1, 0, 0], tf=1.0), q=2)
    >>> round(float(s.norm) ** 2, 9), s.certificate.holds(1e-12)
    (720.0, True)
    """
    q = exponent(q)
    rules = table(q)
    numbers = solve_stack.call(numbers_of(maneuver), rules)
    if numbers is not None:
        solution = NormSolution.from_numbers(numbers)
        solution.__dict__.update(maneuver=maneuver, q=q)
        residual, norm, bound = LAST_THREE.unpack_from(numbers, len(numbers) - LAST_THREE.size)
        if residual <= CONVERGED and abs(norm - bound) <= CONVERGED * norm:
            return solution
    else:
        result = over_stack(solve_stack, maneuver, rules)
        solution = NormSolution(maneuver, q, **_answer(result))
    _require_convergence(solution.certificate, q)
    return solution


def exponent(q: float) -> float:
    """q as a float, checked to be finite and greater than 1."""
    if isinstance(q, bool) or not isinstance(q, Real):
        raise ArgumentTypeError(f"q must be a number, 1 < q < inf, got {q!r}", "q")
    value = float(q)
    if not 1 < value < np.inf:
        ends = {1.0: "; q = 1 is minimum_impulse", np.inf: "; q = inf is minimum_peak"}
        message = f"q must be a number, 1 < q < inf, got {q!r}{ends.get(value, '')}"
        raise ArgumentValueError(message, "q")
    return value


def conjugate(q: float) -> float:
    """p with 1/p + 1/q = 1."""
    return q / (q - 1)


def signed_power(h: Array, power: float) -> Array:
    """|h|^power sign h."""
    return np.sign(h) * np.abs(h) ** power


def _answer(result: Array) -> dict[str, Any]:
    """The fields of a solution from the results of `solve_norm`, (..., 8)."""
    certificate = Certificate(result[..., 5], result[..., 6], result[..., 7])
    shape = Quadratic(result[..., :3], result[..., 3])
    return {
        "peak": result[..., 4],
        "shape": shape,
        "certificate": certificate,
    }


def dual_bound(maneuver: Maneuver, q: float, multipliers: ArrayLike) -> Array:
    """l'c / ||l'h||_p, (...): for every l a lower bound on the L_q norm of all controls with moments c.

    Parameters
    ----------
    maneuver : Maneuver
        One manoeuvre or a stack of them.
    q : float
        Exponent of the control's norm.
    multipliers : (..., 3) array_like
        Any l; for l = 0 the result is 0.

    Examples
    --------
    >>> m = Maneuver([0, 0, 0], [1, 0, 0], tf=1.0)
    >>> bool(dual_bound(m, 3.0, [1.0, 0.0, 0.0]) < minimum_norm(m, 3.0).norm)
    True
    """
    numbers_of(maneuver)
    T, p = maneuver.duration, conjugate(q)
    l = np.broadcast_to(vectors("multipliers", multipliers, 3), (*maneuver.shape, 3))
    h = np.stack([l[..., 2], l[..., 1] * T, l[..., 0] * T * T / 2], axis=-1).reshape(-1, 3)
    norm = np.empty(len(h))
    for start in range(0, len(h), BLOCK):
        part = h[start : start + BLOCK]
        s, _, weights = Quadratic.of(part).sample(graded_rule())
        values = np.abs(part[:, 0, None, None] + s * (part[:, 1, None, None] + s * part[:, 2, None, None]))
        top = np.maximum(values.max(axis=(-2, -1)), np.finfo(float).tiny)
        mean = (weights * (values / top[:, None, None]) ** p).sum(axis=(-2, -1))
        norm[start : start + BLOCK] = top * mean ** (1 / p)
    norm = norm.reshape(T.shape) * T ** (1 / p)
    pairing = (l * maneuver.moments).sum(axis=-1)
    return np.asarray(np.divide(pairing, norm, out=np.zeros_like(norm), where=pairing != 0))


def _require_convergence(certificate: Certificate, q: float) -> None:
    lost = np.abs(certificate.primal_value - certificate.dual_value)
    norm = certificate.primal_value
    relative = np.divide(lost, norm, out=np.zeros_like(lost), where=norm > 0)
    left = np.maximum(certificate.primal_residual, relative)
    bad = ~(left <= CONVERGED)
    if bad.any():
        raise NotConverged(
            f"minimum_norm did not solve {bad.sum()} of {bad.size} manoeuvres for q = {q}",
            float(left[bad].max()),
            members_of(bad),
        )
