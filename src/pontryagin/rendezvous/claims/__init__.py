"""The ledger of Pimkina & Chelnokov and of Sapunkov: formulas and decidable claims, in their order.

There is one module for each step of the texts. A module transcribes and judges; derived formulas come from
`pontryagin.rendezvous.derivation`. `meetings` holds true and false meetings that decide claims in words,
`spirals` holds the slow transfers that show that the problem of least energy in free time has no solution.
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
