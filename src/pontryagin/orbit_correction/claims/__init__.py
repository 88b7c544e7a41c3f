"""The ledger of Ibragimov 2017: every formula, number and decidable claim, in the paper's order.

One module per step of the paper. A module transcribes and judges; what is derived comes from
`pontryagin.orbit_correction.derivation`, `summands` and `exact`; the plans of the worked example come
from the solver, their certificates from `worked`.
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
"""Section by section, from the abstract to the second table."""
