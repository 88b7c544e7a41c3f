"""The paper's own numerical routes to the least peak, (3.6) to (3.19), and where they arrive.

`formulas` compiles what the routes evaluate from the derivation; `routes` follows and judges them.
"""

from pontryagin.triple_integrator.search.routes import (
    AGREES,
    GRID,
    REASONS,
    ROUTES,
    SearchResult,
    Survey,
    multiplier_range,
    search,
    survey,
)

__all__ = [
    "AGREES",
    "GRID",
    "REASONS",
    "ROUTES",
    "SearchResult",
    "Survey",
    "multiplier_range",
    "search",
    "survey",
]
