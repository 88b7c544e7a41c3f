"""Names, colours and labels that the figures of this paper share."""

from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from pontryagin.display.plotting import BLUE, GREEN, ORANGE, PURPLE, RED

COLOURS = {"ball": BLUE, "disc": GREEN, "box": RED}
NAMES = {"ball": "ball (the paper)", "disc": "disc", "box": "square"}
MARKERS = {"ball": "o", "disc": "D", "box": "s"}
POWERS = {8.0: PURPLE, 16.0: ORANGE}

STATES = (r"$\Delta r$", r"$\Delta v_R$", r"$\Delta v_T$")
IMPULSES = "number of impulses"
TIME = r"$t$, rad of the orbit"
DEVIATION = r"$|z_0|$, radii and speeds of the orbit"


def whole_numbers(ax: Axes) -> None:
    """Ticks of the horizontal axis at whole numbers only."""
    ax.xaxis.set_major_locator(MaxNLocator(integer=True))
