"""Figures and tables of Akulenko 1977, made from solutions."""

from pontryagin.averaging.figures import tables
from pontryagin.averaging.figures.drift import drift
from pontryagin.averaging.figures.extremals import extremal_figure
from pontryagin.averaging.figures.landscape import landscape
from pontryagin.averaging.figures.pictures import cost_over_end, end_condition
from pontryagin.averaging.figures.slopes import cost_convergence, error_slopes
from pontryagin.averaging.figures.spin import braking
from pontryagin.averaging.figures.spiral import spiral

__all__ = [
    "braking",
    "cost_convergence",
    "cost_over_end",
    "drift",
    "end_condition",
    "error_slopes",
    "extremal_figure",
    "landscape",
    "spiral",
    "tables",
]
