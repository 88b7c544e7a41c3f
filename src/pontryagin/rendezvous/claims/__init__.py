"""The ledger of Pimkina & Chelnokov and of Sapunkov: every formula and decidable claim, in their order.

One module per step of the texts. A module transcribes and judges; what is derived comes from
`pontryagin.rendezvous.derivation`. `meetings` holds the meetings, true and false, that settle what is said
in words, `spirals` the slow transfers that leave the problem of least energy without a solution.
"""

from itertools import chain

from pontryagin.rendezvous.claims import (
    boundary,
    conclusion,
    elements,
    functional,
    principle,
    reduction,
    statement,
)

IN_ORDER = (statement, functional, principle, reduction, boundary, conclusion, elements)

ENTRIES = tuple(chain.from_iterable(part.claim for part in IN_ORDER))
