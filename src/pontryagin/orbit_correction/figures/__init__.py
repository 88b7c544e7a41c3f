"""Figures and tables of Ibragimov 2017, made from states and plans."""

from pontryagin.orbit_correction.figures import tables
from pontryagin.orbit_correction.figures.ergodic import ergodic_limit
from pontryagin.orbit_correction.figures.flight import nonlinear_residual, replanning
from pontryagin.orbit_correction.figures.growth import gauge_over_impulses
from pontryagin.orbit_correction.figures.impulses import alternatives, hodograph, plan_figure
from pontryagin.orbit_correction.figures.injection import injection_impulses
from pontryagin.orbit_correction.figures.sets import controllable_sets, remaining_sets
from pontryagin.orbit_correction.figures.spacing import impulses_over_interval
from pontryagin.orbit_correction.figures.wasted import wasted_impulses

__all__ = [
    "alternatives",
    "controllable_sets",
    "ergodic_limit",
    "gauge_over_impulses",
    "hodograph",
    "impulses_over_interval",
    "injection_impulses",
    "nonlinear_residual",
    "plan_figure",
    "remaining_sets",
    "replanning",
    "tables",
    "wasted_impulses",
]
