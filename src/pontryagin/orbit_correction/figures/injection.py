"""Figure of the numbers of impulses over random injection errors."""

import numpy as np
from matplotlib.figure import Figure

from pontryagin.display.plotting import GREY, styled, subplots
from pontryagin.orbit_correction.figures import labels
from pontryagin.orbit_correction.montecarlo import Distribution


@styled
def injection_impulses(found: Distribution, sure: float = 0.99) -> Figure:
    """Left: share of the errors that need each number of impulses. Right: share for which it suffices.

    Parameters
    ----------
    found : Distribution
        Numbers of impulses of random errors.
    sure : float
        Share of the errors whose quantile is marked.
    """
    figure, (left, right) = subplots(1, 2, height=3.1)
    most = max(int(counts.max()) for counts in found.counts.values())
    numbers = np.arange(most + 1)
    for place, (name, counts) in enumerate(found.counts.items()):
        shares = np.bincount(counts, minlength=most + 1) / len(counts)
        words = f"{labels.NAMES[name]}: mean {found.mean(name):.2f}"
        left.bar(numbers + 0.28 * (place - 1), shares, 0.28, color=labels.COLOURS[name], label=words)
        right.step(numbers, np.cumsum(shares), where="post", color=labels.COLOURS[name])
        enough = found.quantile(name, sure)
        right.plot(enough, sure, labels.MARKERS[name], color=labels.COLOURS[name])
        right.annotate(
            str(enough), (enough, sure), (4, -14), textcoords="offset points", color=labels.COLOURS[name]
        )
    right.axhline(sure, color=GREY, linewidth=0.8, linestyle=":")
    left.set(xlabel=labels.IMPULSES, ylabel="share of injections", ylim=(0, 1.45 * left.get_ylim()[1]))
    right.set(xlabel=labels.IMPULSES, ylabel="share corrected", ylim=(0, 1.04))
    left.legend()
    for ax in (left, right):
        labels.whole_numbers(ax)
    return figure
