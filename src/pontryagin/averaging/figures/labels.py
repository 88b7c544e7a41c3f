"""Labels and colours that the figures of this paper share."""

from typing import Any

from pontryagin.display.plotting import (
    BLUE,
    GREEN,
    INK,
    ORANGE,
    RED,
)

SLOW_TIME = r"slow time $\tau = \varepsilon t$"
END_TIME = r"end time $\tau_1$"
EXACT, MEAN = BLUE, RED
MINIMUM = {"color": GREEN, "marker": "o", "linestyle": "none", "zorder": 4}
MAXIMUM = {"color": ORANGE, "marker": "s", "markerfacecolor": "white", "linestyle": "none", "zorder": 4}
KINDS: dict[str, dict[str, Any]] = {"minimum": MINIMUM, "maximum": MAXIMUM}
THRUST = INK
