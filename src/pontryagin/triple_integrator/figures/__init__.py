"""Figures and tables of Gorelov & Morozova 2012, made from solutions and manoeuvres."""

from pontryagin.triple_integrator.figures import tables
from pontryagin.triple_integrator.figures.coupling import attempts, attempts_table, coupling_convergence
from pontryagin.triple_integrator.figures.duality import dual_functions
from pontryagin.triple_integrator.figures.duration import peak_over_duration
from pontryagin.triple_integrator.figures.homotopy import norm_family
from pontryagin.triple_integrator.figures.level import convex_level_equation
from pontryagin.triple_integrator.figures.onesigned import equally_cheap
from pontryagin.triple_integrator.figures.overpayment import printed_impulses
from pontryagin.triple_integrator.figures.programmes import solution_figure, three_programmes
from pontryagin.triple_integrator.figures.regimes import impulse_regimes
from pontryagin.triple_integrator.figures.search import search_routes
from pontryagin.triple_integrator.figures.turn import real_turn

__all__ = [
    "attempts",
    "attempts_table",
    "convex_level_equation",
    "coupling_convergence",
    "dual_functions",
    "equally_cheap",
    "impulse_regimes",
    "norm_family",
    "peak_over_duration",
    "printed_impulses",
    "real_turn",
    "search_routes",
    "solution_figure",
    "tables",
    "three_programmes",
]
