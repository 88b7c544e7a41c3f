"""The ledger of Gorelov & Morozova 2012: every formula, number and decidable claim, in the paper's order.

There is one module for each step of the paper. It holds the printed statements and the verdicts on them;
derived quantities come from `pontryagin.triple_integrator.derivation`.
"""

from itertools import chain

from pontryagin.triple_integrator.claims import (
    areas,
    chebyshev,
    cramer,
    energy,
    example_1,
    example_2,
    impulse,
    model,
    moments,
    norms,
    peak,
    principle,
    problems,
    reach,
    search,
    vertex,
    zeros,
)

IN_ORDER = (
    model,
    moments,
    norms,
    principle,
    problems,
    energy,
    example_1,
    peak,
    zeros,
    vertex,
    areas,
    search,
    example_2,
    chebyshev,
    cramer,
    impulse,
    reach,
)

ENTRIES = tuple(chain.from_iterable(part.claim for part in IN_ORDER))
