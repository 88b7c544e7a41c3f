"""The ledger of Akulenko 1977: every formula, number and decidable claim, in the paper's order.

There is one module per step of the paper. It transcribes what is printed and judges it; the derived formulas
come from `pontryagin.averaging.derivation`. `worked` holds the rippled smooth example in numbers, `instances`
small examples with exact solutions.
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
"""All entries of the paper, from the introduction to the third example."""
