"""The ledger of Gorelov & Morozova 2012: every formula, number and decidable claim, in the paper's order.

One module per section of the paper. A module transcribes and judges; what is derived comes from
`pontryagin.triple_integrator.derivation`.
"""

from pontryagin.triple_integrator.claims import energy, model, moments, parabola, peak, principle

ENTRIES = (*model.claim, *moments.claim, *principle.claim, *energy.claim, *peak.claim, *parabola.claim)
