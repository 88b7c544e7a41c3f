"""Derivation of the fewest impulses (Ibragimov 2017) in SymPy, from first principles.

`satellite` derives the regrouped steps of section 7 from the equations of motion; this package exports its
names. `summands` has Lemma 1 and its consequences for matrices of any size. `exact` builds systems on which
sections 2 to 6 are checked without rounding.
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
