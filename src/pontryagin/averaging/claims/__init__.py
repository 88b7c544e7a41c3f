"""The ledger of Akulenko 1977: every formula, number and decidable claim, in the paper's order.

One module per step of the paper. A module transcribes and judges; what is derived comes from
`pontryagin.averaging.derivation`. `worked` is the rippled smooth example in numbers, `instances` are small
examples with exact solutions.
"""

from itertools import chain

from pontryagin.averaging.claims import (
    approximation,
    averaged,
    discontinuous,
    family,
    integral,
    kepler_controls,
    kepler_elements,
    kepler_motion,
    kepler_optimum,
    kepler_principle,
    least_time,
    optimum,
    principle,
    rigid,
    rigid_cylinder,
    rigid_ellipsoid,
    roots,
    rotor,
    smooth,
    statement,
    window,
)

IN_ORDER = (
    statement,
    principle,
    family,
    roots,
    averaged,
    window,
    integral,
    optimum,
    approximation,
    discontinuous,
    rotor,
    least_time,
    smooth,
    kepler_motion,
    kepler_elements,
    kepler_principle,
    kepler_controls,
    kepler_optimum,
    rigid,
    rigid_ellipsoid,
    rigid_cylinder,
)

ENTRIES = tuple(chain.from_iterable(part.claim for part in IN_ORDER))
"""From the introduction to the third example."""
