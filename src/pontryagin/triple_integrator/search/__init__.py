"""The paper's own numerical methods ("routes") for the least peak, (3.6) to (3.19), and whether they find it.

`formulas` compiles the formulas that the routes evaluate from the derivation; `routes` runs the routes and
compares their results with the certified least peak.
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
