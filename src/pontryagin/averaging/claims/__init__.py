"""The ledger of Akulenko 1977: every formula, number and decidable claim, in the paper's order.

One module per step of the paper. A module transcribes and judges; what is derived comes from
`pontryagin.averaging.derivation`. `worked` is the rippled smooth example in numbers, `instances` are small
examples with exact solutions.
"""

from itertools import chain

from pontryagin.averaging.claims import (
    averaged,
    discontinuous,
    family,
    integral,
    kepler_controls,
    kepler_elements,
    kepler_motion,
    kepler_optimum,
    kepler_principle,
    optimum,
    principle,
    statement,
)

IN_ORDER = (
    statement,
    principle,
    family,
    averaged,
    integral,
    optimum,
    discontinuous,
    kepler_motion,
    kepler_elements,
    kepler_principle,
    kepler_controls,
    kepler_optimum,
)

ENTRIES = tuple(chain.from_iterable(part.claim for part in IN_ORDER))
"""From the introduction to the third example."""
