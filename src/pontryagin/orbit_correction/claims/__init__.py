"""The ledger of Ibragimov 2017: every formula, number and decidable claim, in the paper's order.

One module for each step of the paper. A module transcribes and judges; what is derived comes from
`pontryagin.orbit_correction.derivation`. The numbers of the worked example are those of `printed`, its plans
come from the solver, and their certificates from `worked`.
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
