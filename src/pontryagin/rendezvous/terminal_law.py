"""The terminal law of a free duration, (16) and (17): how large the switching function n is at the meeting.

For the cost alpha1 + alpha2 p^2 with alpha2 = 1, |n(t_k)| is 2 sqrt(alpha1) if the thrust is unsaturated
there, and alpha1/p_max + p_max if it is saturated. For least time, alpha2 = 0 and alpha1 = 1, it is 1/p_max.
`pontryagin.rendezvous.derivation.terminal` derives it.
"""

import math


def end_switching(ratio: float, peak: float) -> float:
    """|n(t_k)| for given alpha1/alpha2 (inf for least time) and p_max."""
    if ratio == math.inf:
        return 1 / peak
    root = math.sqrt(ratio)
    return 2 * root if root <= peak else ratio / peak + peak
