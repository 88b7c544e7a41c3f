"""Figure of the impulses that the paper's ball wastes, over random states."""

import numpy as np
from matplotlib.figure import Figure

from pontryagin.display.plotting import BLUE, INK, styled, subplots
from pontryagin.orbit_correction.figures import labels
from pontryagin.orbit_correction.waste import Waste

AREA = 5.0
"""Area of the dot of one state, in square points."""


@styled
def wasted_impulses(found: Waste) -> Figure:
    """Left: impulses that the square saves against those of the ball. Right: shares of numbers saved.

    Parameters
    ----------
    found : Waste
        Of a stack (n,) of states.
    """
    figure, (left, right) = subplots(1, 2, height=3.1, width_ratios=(1.3, 1))
    ball, saved = found.counts["ball"], found.wasted("box")
    pairs, counts = np.unique(np.column_stack([ball, saved]), axis=0, return_counts=True)
    left.scatter(*pairs.T, s=AREA * counts, color=BLUE, alpha=0.75, linewidths=0)
    for number in (1, 10, 50):
        left.scatter([], [], s=AREA * number, color=BLUE, alpha=0.75, linewidths=0, label=f"{number}")
    left.legend(title="states", loc="upper left", labelspacing=0.8)
    size = np.array([0, 1.02 * ball.max()])
    share = float(saved.sum() / ball.sum())
    left.plot(size, share * size, color=INK, linewidth=0.9)
    left.annotate(f"line: {100 * share:.0f} % of all impulses", (size[1], 0.1), ha="right")
    left.set(xlabel="impulses fired under the ball", ylabel="impulses saved by the square")
    labels.whole_numbers(left)
    numbers = np.arange(0, saved.max() + 1)
    for name, shift in (("disc", -0.2), ("box", 0.2)):
        shares = [(found.wasted(name) == number).mean() for number in numbers]
        words = f"{labels.NAMES[name]}: mean {found.wasted(name).mean():.2f}"
        right.bar(numbers + shift, shares, 0.4, color=labels.COLOURS[name], label=words)
    right.set(xlabel="impulses saved against the ball", ylabel="share of states")
    labels.whole_numbers(right)
    right.legend()
    return figure
