"""Three channels of one rigid body; the cross-coupling between them is the disturbance f(t) of each.

`channels` holds the equations of a body under three programmes; `iteration` finds the programmes whose
cross-coupled motion reaches the target.
"""

from pontryagin.triple_integrator.coupling.channels import Channels, Coupling
from pontryagin.triple_integrator.coupling.iteration import CoupledManeuver, Solver, couple, spherical_factor

__all__ = ["Channels", "CoupledManeuver", "Coupling", "Solver", "couple", "spherical_factor"]
