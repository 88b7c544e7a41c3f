"""Derivation of the fewest impulses (Ibragimov 2017) in SymPy, from first principles.

`satellite` leads from the equations of motion to the regrouped steps of section 7, whose names this package
hands on. `summands` has Lemma 1 and what follows from it for matrices of any size. `exact` builds systems on
which sections 2 to 6 are followed without rounding.
"""

from pontryagin.orbit_correction.derivation.satellite import (
    RADIAL,
    TRANSVERSE,
    angular_rate,
    equations_of_motion,
    factor_columns,
    impulse_directions,
    interval,
    linearised,
    r,
    schedule,
    step_inputs,
    step_matrix,
    t,
    transition,
    v_radial,
    v_transverse,
)

__all__ = [
    "RADIAL",
    "TRANSVERSE",
    "angular_rate",
    "equations_of_motion",
    "factor_columns",
    "impulse_directions",
    "interval",
    "linearised",
    "r",
    "schedule",
    "step_inputs",
    "step_matrix",
    "t",
    "transition",
    "v_radial",
    "v_transverse",
]
