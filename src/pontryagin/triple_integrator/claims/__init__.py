"""The ledger of Gorelov & Morozova 2012: every formula, number and decidable claim, in the paper's order.

One module per step of the paper. A module transcribes and judges; what is derived comes from
`pontryagin.triple_integrator.derivation`.
"""

from pontryagin.triple_integrator.claims import (
    chebyshev,
    energy,
    model,
    moments,
    parabola,
    peak,
    principle,
    search,
)

ENTRIES = (
    *model.claim,
    *moments.claim,
    *principle.claim,
    *energy.claim,
    *peak.claim,
    *parabola.claim,
    *search.claim,
    *chebyshev.claim,
)
