"""The turn of a rigid body about a fixed axis, planned by one channel's programme.

`fixed_axis` plans the turn and integrates it; `rigid_body` holds Euler's equations and the integrator.
"""

from pontryagin.triple_integrator.attitude.fixed_axis import Turn, disturbance_of, impulses, single, turn
from pontryagin.triple_integrator.attitude.rigid_body import Commands, Motion, RigidBody, simulate
from pontryagin.triple_integrator.problem.programme import Programme

__all__ = [
    "Commands",
    "Motion",
    "Programme",
    "RigidBody",
    "Turn",
    "disturbance_of",
    "impulses",
    "simulate",
    "single",
    "turn",
]
