"""Least L_q norm for any 1 < q < infinity, between least total impulse and least peak, (1.13) and (1.14).

With 1/p + 1/q = 1 and the minimal element h0 of (1.13), u = rho0^(-p) |h0|^(p-1) sign h0 is the only control
that attains the maximum in (1.14). The solver measures the time to go as a share of T, as `minimal_element`.
"""

from dataclasses import dataclass
from functools import cache, partial
from numbers import Real

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.certificate import Certificate
from pontryagin.errors import ArgumentTypeError, ArgumentValueError, NotConverged
from pontryagin.triple_integrator.norms.minimal_element import minimal_elements
from pontryagin.triple_integrator.norms.quadratic_programme import (
    BLOCK,
    Profile,
    QuadraticProgramme,
    certify,
    scaled_moments,
)
from pontryagin.triple_integrator.norms.quadrature import Quadratic, graded_rule, logistic_rule, orthonormal
from pontryagin.triple_integrator.problem.maneuver import Maneuver
from pontryagin.triple_integrator.problem.programme import breakpoints
from pontryagin.value import value_class

CONVERGED = 1e-10
"""Largest residual of the moments and largest relative gap of a solution that is returned."""


@value_class
@dataclass(frozen=True, eq=False)
class NormSolution(QuadraticProgramme):
    """Control of least L_q norm: u = peak |h|^(p-1) sign h for a quadratic h whose largest modulus is 1.

    Attributes
    ----------
    maneuver : Maneuver
        The problem that is solved.
    q : float
        Exponent of the norm, 1 < q < infinity.
    multipliers : (..., 3) array
        l0 of the minimal element h0 = l0'h(s), with l0'c = 1; zeros where c = 0.
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
    multipliers: Array
    peak: Array
    shape: Quadratic
    certificate: Certificate

    @property
    def breakpoints(self) -> Array:
        """Times within one manoeuvre at which u changes sign, (j,); for q > 2 u is not smooth there."""
        m = self.maneuver
        return breakpoints(m.tf[..., None] - m.duration[..., None] * self.shape.zeros)

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
        for every l.

    Raises
    ------
    TypeError, ValueError
        If q is not a finite number greater than 1; `minimum_impulse` and `minimum_peak` solve q = 1 and inf.
    pontryagin.NotConverged
        If the moments are missed by more than 1e-10, or the relative gap between norm and lower bound exceeds
        it. This was seen for q - 1 <= 1e-4, and for q = 1e6 next to a constant control.

    Examples
    --------
    >>> s = minimum_norm(Maneuver([0, 0, 0], [1, 0, 0], tf=1.0), q=2)
    >>> round(float(s.norm) ** 2, 9), s.certificate.holds(1e-12)
    (720.0, True)
    """
    q = exponent(q)
    targets = scaled_moments(maneuver)
    flat = targets.reshape(-1, 3)
    size = np.abs(flat).max(axis=1)
    moving = size > 0
    coefficients, discriminant = np.zeros_like(flat), np.zeros_like(size)
    peak, scale = np.zeros_like(size), np.zeros_like(size)
    if moving.any():
        w = (flat[moving] / size[moving, None]) @ from_scaled_moments().T
        length = np.linalg.norm(w, axis=1)
        element, _ = minimal_elements(w / length[:, None], q)
        top = largest(element)
        h = element.scaled(1 / top)
        coefficients[moving], discriminant[moving] = h.coefficients, h.discriminant
        peak[moving] = length * size[moving] / (top * integral_of_power(h, conjugate(q)))
        scale[moving] = top / (length * size[moving])
    stack = maneuver.shape
    shape = Quadratic(coefficients, discriminant).reshape(*stack)
    multipliers = _multipliers(shape, scale.reshape(stack), maneuver.duration)
    profile, peak = partial(signed_power, power=1 / (q - 1)), peak.reshape(stack)
    bound = dual_bound(maneuver, q, multipliers)
    certificate = certify(maneuver, shape, peak, profile, q, bound)
    _require_convergence(certificate, q)
    return NormSolution(maneuver, q, multipliers, peak, shape, certificate)


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


@cache
def from_scaled_moments() -> Array:
    """The matrix that takes scaled moments to moments in the orthonormal basis."""
    return np.asarray(orthonormal()[:, ::-1] / np.array([3.0, 2.0, 1.0]))


def largest(h: Quadratic) -> Array:
    """max |h| on [0, 1]."""
    return np.asarray(np.abs(h.cuts[1]).max(axis=-1))


def integral_of_power(h: Quadratic, p: float) -> Array:
    """Integral of |h|^p over [0, 1] by the logistic rule, (n,)."""
    blocks = []
    for start in range(0, len(h.discriminant), BLOCK):
        _, values, weights = h[start : start + BLOCK].sample(logistic_rule())
        blocks.append((np.abs(values) ** p * weights).sum(axis=(-2, -1)))
    return np.concatenate(blocks)


def _multipliers(shape: Quadratic, scale: Array, T: Array) -> Array:
    h0, h1, h2 = np.moveaxis(shape.coefficients, -1, 0)
    return np.stack([2 * h2 / T / T, h1 / T, h0], axis=-1) * (scale / T)[..., None]


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
    T, p = maneuver.duration, conjugate(q)
    l = np.broadcast_to(np.asarray(multipliers, dtype=float), (*maneuver.shape, 3))
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
        )
