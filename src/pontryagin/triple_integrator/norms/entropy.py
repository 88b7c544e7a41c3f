"""The control of one sign with the greatest entropy, the limit of the least-L_q-norm control for q -> 1.

In the interior of the moment cone every control of one sign with the moments c has the least total impulse
|c3|, so that problem 3, (1.20), has many solutions. The optimum |h0|^(p-1) in L_q selects one of them as
q -> 1 and p -> infinity: with h0 ~ 1 + (k1 s + k2 s^2)/(p - 1) it tends to exp(k0 + k1 s + k2 s^2), which
is the control of greatest entropy - (integral of |u| log |u|) with these moments.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.certificate import Certificate
from pontryagin.errors import Infeasible, NotConverged
from pontryagin.triple_integrator.norms.newton import CHUNK, minimise
from pontryagin.triple_integrator.norms.quadratic_programme import Profile, QuadraticProgramme, certify
from pontryagin.triple_integrator.norms.quadrature import (
    Quadratic,
    basis_at,
    first_moments,
    logistic_rule,
    orthonormal,
    second_moments,
)
from pontryagin.triple_integrator.problem.maneuver import Maneuver
from pontryagin.triple_integrator.problem.programme import normalise, numbers_of
from pontryagin.triple_integrator.problem.scales import require_levels
from pontryagin.validation import require_digits
from pontryagin.value import value_class

CONVERGED = 1e-10
"""Largest residual of the moments of a solution that is returned."""

BOUNDARY = 4e-15
"""For c3 = 1, a distance of the moments to the boundary of the moment cone below this is rounding."""


@value_class
@dataclass(frozen=True, eq=False)
class EntropySolution(QuadraticProgramme):
    """Control u = +-exp(k0 + k1 s + k2 s^2) in the time to go s.

    Attributes
    ----------
    maneuver : Maneuver
        The problem that is solved.
    peak : (...) array
        The u of largest modulus, with its sign; 0 where c = 0.
    exponent : Quadratic
        log(u / peak) in the time to go as a share of T; its largest value is 0.
    certificate : Certificate
        Residual of the moments, relative to the largest of 6 c1/T^3, 2 c2/T^2, c3/T; the total impulse, by a
        quadrature rule that the solver does not use; and the bound |c3|, which l = (0, 0, 1) proves.
    """

    maneuver: Maneuver
    peak: Array
    exponent: Quadratic
    certificate: Certificate

    @cached_property
    def multipliers(self) -> Array:
        """l0 = (0, 0, 1/c3): the dual function is constant, (..., 3); zeros where c = 0."""
        c = self.maneuver.moments
        return normalise(np.broadcast_to([0.0, 0.0, 1.0], c.shape), c, self.maneuver.duration)

    @property
    def coefficients(self) -> Array:
        """k0, k1, k2, (..., 3); where c = 0 k0 is -inf."""
        T = self.maneuver.duration
        require_digits("xf", "coefficients of the exponent", self.peak != 0, 1 / T / T)
        with np.errstate(divide="ignore"):
            level = np.log(np.abs(self.peak))
        k0, k1, k2 = np.moveaxis(self.exponent.coefficients, -1, 0)
        return np.stack([k0 + level, k1 / T, k2 / T / T], axis=-1)

    @property
    def entropy(self) -> Array:
        """Entropy of |u|/|c3| relative to that of a constant control, (...): at most 0; 0 where c = 0."""
        c1, c2, c3 = np.moveaxis(self.maneuver.moments, -1, 0)
        T = self.maneuver.duration
        still = c3 == 0
        total = np.where(still, 1.0, c3)
        shares = np.stack([np.ones_like(total), c2 / T / total, 2 * c1 / T / T / total], axis=-1)
        mean = (self.exponent.coefficients * shares).sum(axis=-1)
        return np.where(still, 0.0, -mean - np.log(np.where(still, 1.0, self.peak * T / total)))

    @property
    def _law(self) -> tuple[Quadratic, Profile]:
        return self.exponent, np.exp


def maximum_entropy(maneuver: Maneuver) -> EntropySolution:
    """Control of one sign and least total impulse that has the greatest entropy among all of them.

    Parameters
    ----------
    maneuver : Maneuver
        One manoeuvre or a stack of them, with moments inside the moment cone or c = 0. Inside means
        mu0 mu2 > mu1^2 and mu0 (mu1 - mu2) > 0 for mu = (c3, c2/T, 2 c1/T^2).

    Returns
    -------
    EntropySolution
        The limit of `minimum_norm` for q -> 1; the two differ by a term of order q - 1.

    Raises
    ------
    pontryagin.Infeasible
        If the moments are not inside the cone: then one control alone has the least total impulse, the
        impulses of `minimum_impulse`.
    pontryagin.NotConverged
        If the moments are missed by more than 1e-10, because they lie so close to the boundary of the cone.

    Examples
    --------
    >>> s = maximum_entropy(Maneuver([0, 0, 0], [1, 3, 6], tf=1.0))
    >>> s.control([0.0, 1.0]).round(9).tolist(), round(float(s.norm), 12)
    ([6.0, 6.0], 6.0)
    """
    numbers_of(maneuver)
    require_levels(maneuver.moments, maneuver.duration)
    c1, c2, c3 = (part.reshape(-1) for part in np.moveaxis(maneuver.moments, -1, 0))
    T = maneuver.duration.reshape(-1)
    moving = (c1 != 0) | (c2 != 0) | (c3 != 0)
    total = np.where(c3 == 0, 1.0, c3)
    mean, square = c2 / T / total, 2 * c1 / T / T / total
    _require_inside(maneuver.moments.reshape(-1, 3), moving, mean, square)
    coefficients = np.zeros((len(T), 3))
    moments = np.stack([np.ones_like(mean), mean, square], axis=-1)
    for start in range(0, len(T), CHUNK):
        part = np.flatnonzero(moving[start : start + CHUNK]) + start
        if part.size:
            coefficients[part] = _exponent(moments[part] @ orthonormal().T)
    exponent = Quadratic.of(coefficients)
    exponent = exponent.plus(-exponent.cuts[1].max(axis=-1)[:, None] * np.array([1.0, 0.0, 0.0]))
    peak = np.where(moving, c3 / T / _integral(exponent), 0.0)
    stack = maneuver.shape
    exponent, peak = exponent.reshape(*stack), peak.reshape(stack)
    certificate = certify(maneuver, exponent, peak, np.exp, 1.0, np.abs(maneuver.moments[..., 2]))
    worst = float(np.max(certificate.primal_residual, initial=0.0))
    if not worst <= CONVERGED:
        reason = "maximum_entropy: the moments lie too close to the boundary of the cone to be met"
        raise NotConverged(f"{reason} to {CONVERGED:g}", worst)
    return EntropySolution(maneuver, peak, exponent, certificate)


def _require_inside(c: Array, moving: NDArray[np.bool_], mean: Array, square: Array) -> None:
    """Check the inequalities of the cone's interior; the error names the first one that fails."""
    for holds, reason in (
        (c[:, 2] != 0, "c3 = 0 although c is not 0"),
        (square - mean * mean > BOUNDARY, "2 c1 c3 - c2^2 is not positive"),
        (mean - square > BOUNDARY, "c3 (T c2 - 2 c1) is not positive"),
    ):
        outside = moving & ~holds
        if outside.any():
            first = int(np.argmax(outside))
            which = f" (manoeuvre {first} of the stack)" if outside.size > 1 else ""
            raise Infeasible(
                f"maneuver must have moments c that a control of one sign without impulses can have, "
                f"got c = {c[first].tolist()}{which}: {reason}",
                "maneuver",
            )


def _exponent(w: Array) -> Array:
    """The exponent h whose density exp(h) has the moments w (n, 3), w0 = 1, in the orthonormal basis."""

    def derivatives(h: Quadratic, which: NDArray[np.intp]) -> tuple[Array, Array, Array]:
        """Scale, gradient and Hessian of log (integral of exp h) - <h, w>."""
        s, values, weights = h.sample(logistic_rule())
        density = weights * np.exp(values - values.max(axis=(-2, -1), keepdims=True))
        density /= density.sum(axis=(-2, -1), keepdims=True)
        basis = basis_at(s) - w[which, None, :]
        gradient = first_moments(basis, density)
        hessian = second_moments(basis, density) - gradient[:, :, None] * gradient[:, None, :]
        return np.ones(len(s)), gradient, hessian

    directions = np.broadcast_to(np.eye(3)[:, 1:], (len(w), 3, 2))
    h, _ = minimise(derivatives, directions, Quadratic.of(np.zeros_like(w)), tolerance=1e-15)
    return h.coefficients


def _integral(exponent: Quadratic) -> Array:
    _, values, weights = exponent.sample(logistic_rule())
    return np.asarray((np.exp(values) * weights).sum(axis=(-2, -1)))
