"""Certificates of solutions: dual bounds for convex problems, maximum-principle residuals for others."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from pontryagin.arrays import Array
from pontryagin.value import value_class

ACCEPTED = 1e-8
"""Largest residual, and largest gap relative to the value, at which a solution is accepted by default."""

TINY = np.finfo(float).tiny  # keeps the gap of two zeros from being 0/0


@value_class
@dataclass(frozen=True, eq=False)
class Certificate:
    """How far a solution of a convex problem can be from the optimum.

    Parameters
    ----------
    primal_residual : (...) array
        Largest violation of the constraints, in the problem's own scaled units (dimensionless).
    primal_value : (...) array
        Cost of the solution returned.
    dual_value : (...) array
        A lower bound on the cost of every admissible control, evaluated from the dual variable by a
        formula that does not use the primal solution.

    Examples
    --------
    >>> proof = Certificate(np.array(1e-15), np.array(32.0), np.array(31.0))
    >>> float(proof.gap), proof.holds(), proof.holds(0.1)
    (0.03125, False, True)
    """

    primal_residual: Array
    primal_value: Array
    dual_value: Array

    @cached_property
    def gap(self) -> Array:
        """|primal - dual| / max(|primal|, |dual|), (...); 0 where both are 0.

        It does not depend on the unit of the cost. A dual value above the primal value counts like one below
        it: at an optimum the two are equal.
        """
        primal, dual = self.primal_value, self.dual_value
        gap: Array = np.abs(primal - dual) / np.maximum(np.maximum(np.abs(primal), np.abs(dual)), TINY)
        return gap

    @cached_property
    def residual(self) -> Array:
        """The larger of |primal_residual| and the gap, (...)."""
        residual: Array = np.maximum(np.abs(self.primal_residual), self.gap)
        return residual

    def holds(self, tol: float = ACCEPTED) -> bool:
        """Whether every residual and every gap of the stack is within `tol`; nan never is."""
        return bool(np.all(self.residual <= tol))


@value_class
@dataclass(frozen=True, eq=False)
class MaximumPrinciple:
    """How exactly an extremal satisfies the necessary conditions of the maximum principle.

    The problems are not convex: no bound on the cost of all controls follows, and none is claimed. Every
    entry is (...), in the problem's own scaled units (dimensionless).

    Parameters
    ----------
    boundary : (...) array
        Largest violation of the equations of motion and of the conditions on the state at both ends.
    transversality : (...) array
        Largest violation of the conditions on the costate at the ends.
    hamiltonian : (...) array
        Largest modulus of the Hamiltonian, which must vanish throughout where the duration is free.
    maximality : (...) array
        Largest gap between the Hamiltonian's maximum over the controls and its value at the control used.

    Examples
    --------
    >>> extremal = MaximumPrinciple(np.array(1e-15), np.array(3e-14), np.array(0.0), np.array(2e-15))
    >>> float(extremal.residual), extremal.holds()
    (3e-14, True)
    """

    boundary: Array
    transversality: Array
    hamiltonian: Array
    maximality: Array

    @cached_property
    def residual(self) -> Array:
        """The largest of the four, (...)."""
        parts = (self.boundary, self.transversality, self.hamiltonian, self.maximality)
        residual: Array = np.max(np.broadcast_arrays(*parts), axis=0)
        return residual

    def holds(self, tol: float = ACCEPTED) -> bool:
        """Whether every residual of the stack is within `tol`; nan never is."""
        return bool(np.all(self.residual <= tol))
