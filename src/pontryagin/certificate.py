"""Certificates: the primal residual, the dual bound and the gap that make an answer an answer."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Certificate:
    """How far a solution of a convex problem can be from the optimum.

    Parameters
    ----------
    primal_residual : (...) array
        Largest violation of the constraints, in the problem's own scaled units (dimensionless).
    primal_value : (...) array
        Cost of the solution handed out.
    dual_value : (...) array
        A lower bound on the cost of every admissible control, evaluated from the dual variable by a
        formula that does not use the primal solution.

    Examples
    --------
    >>> Certificate(np.array(1e-15), np.array(32.0), np.array(32.0)).holds()
    True
    """

    primal_residual: NDArray[np.float64]
    primal_value: NDArray[np.float64]
    dual_value: NDArray[np.float64]

    @cached_property
    def gap(self) -> NDArray[np.float64]:
        """(primal - dual) / max(1, |primal|), elementwise."""
        return (self.primal_value - self.dual_value) / np.maximum(1.0, np.abs(self.primal_value))

    def holds(self, tol: float = 1e-10) -> bool:
        """Whether every residual and every gap of the stack is within `tol`; nan never is."""
        return bool(np.all(np.abs(self.primal_residual) <= tol) and np.all(np.abs(self.gap) <= tol))
