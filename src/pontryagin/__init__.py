"""Optimal spacecraft control: four papers derived in SymPy, solved, and certified from the other side.

Each paper is a subpackage (``pontryagin.triple_integrator``, ...); ``pontryagin.ledger`` holds what the
papers print next to what is derived.
"""

from pontryagin.errors import Infeasible, NotConverged

__version__ = "0.1.0"
__all__ = ["Infeasible", "NotConverged", "__version__"]
