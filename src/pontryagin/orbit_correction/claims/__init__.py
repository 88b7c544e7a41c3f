"""The ledger of Ibragimov 2017: every formula, number and decidable claim, in the paper's order.

There is one module for each step of the paper. It holds the printed statements and the verdicts on them.
Derived quantities come from `pontryagin.orbit_correction.derivation`, the numbers of the worked example from
`printed`, its plans from the solver, and their certificates from `worked`.
"""

from itertools import chain

from pontryagin.orbit_correction.claims import (
    boundary,
    controllable,
    controls,
    convexity,
    costate,
    images,
    interior,
    orbit,
    principle,
    reduction,
    regrouping,
    scaled,
    shapes,
    statement,
    sums,
    tables,
)

IN_ORDER = (
    statement,
    controllable,
    convexity,
    images,
    sums,
    boundary,
    principle,
    interior,
    scaled,
    shapes,
    costate,
    controls,
    orbit,
    regrouping,
    reduction,
    tables,
)

ENTRIES = tuple(chain.from_iterable(part.claim for part in IN_ORDER))
"""All entries in the paper's order, from the abstract to the second table."""
