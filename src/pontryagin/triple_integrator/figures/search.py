"""Results of the paper's own numerical routes to the least peak, over the directions of the moments."""

import numpy as np
from matplotlib.figure import Figure

from pontryagin.display.plotting import BLUE, GREEN, INK, ORANGE, PURPLE, RED, SKY, styled, subplots
from pontryagin.triple_integrator.figures import sphere
from pontryagin.triple_integrator.search import Survey

OUTCOMES = {
    "": (SKY, "least peak found"),
    "singular": (RED, "runs to $c_0 = 0$"),
    "sign": (PURPLE, "curvature of the wrong sign"),
    "crossed": (GREEN, "$t_1$ passes $t_2$"),
    "outside": (ORANGE, "a switch outside"),
    "boundary": (BLUE, "stuck at an end"),
    "early": (INK, "stops early"),
}
WORDS = {
    "zeros": "over $t_1, t_2$, free",
    "zeros within": "over $t_1, t_2$, bounded",
    "multiplier": r"over $\tilde\lambda$, $F$ as printed",
    "multiplier modulus": r"over $\tilde\lambda$, $|F|$",
    "multiplier within": r"over all $\tilde\lambda$, $|F|$",
}


@styled
def search_routes(survey: Survey) -> Figure:
    """Outcome of each route over the directions of a survey; opposite directions are drawn as one.

    Parameters
    ----------
    survey : Survey
        Returned by `search.survey`.
    """
    figure, grid = subplots(2, 3, height=5.3)
    axes = grid.ravel()
    front = np.sign(survey.directions @ sphere.frame()[2])
    points = sphere.to_disc(survey.directions * front[:, None])
    for ax, (route, results) in zip(axes, survey.results.items(), strict=False):
        sphere.prepare(ax)
        ax.set_title(f"{WORDS[route]}\nright: {survey.share_right(route):.1%}".replace("%", " %"))
        reasons = np.array([result.reason for result in results])
        for reason, (colour, _) in OUTCOMES.items():
            chosen = reasons == reason
            size, shade = (3.0, 0.9) if reason else (1.6, 0.8)
            ax.plot(*points[chosen].T, "o", color=colour, markersize=size, alpha=shade, markeredgewidth=0)
    axes[-1].axis("off")
    happened = {result.reason for results in survey.results.values() for result in results}
    for reason, (colour, words) in OUTCOMES.items():
        if reason in happened:
            axes[-1].plot([], [], "o", color=colour, label=words)
    axes[-1].legend(loc="center", labelspacing=0.8)
    return figure
