"""Time-optimal control of nonlinear oscillations by averaging (Akulenko 1977).

A weak control acts for a long time on a system with a rotating phase: the slow variables drift over times
of order 1/epsilon while the phase turns. The maximum principle of such a problem has of the order of
1/epsilon extremals. Averaged over the phase it is a small Hamiltonian system free of epsilon, whose one
boundary value problem gives the optimal cost to O(epsilon), and with the first correction to O(epsilon^2).

paper            here                     meaning
---------------  -----------------------  ------------------------------------------------------------
a                slow                     slow variables, constant at epsilon = 0
psi              phase                    rotating phase; here any anomaly x, with weight dpsi/dx
omega            omega                    frequency of the phase
f, F             f, phase_rate            rates per epsilon, of the slow variables and of the anomaly
u, U             control, control_set     control and the convex set it is taken from
M                target                   what vanishes at the end
g                terminal_cost            what is minimised; its integral part is running_cost
p, q             costates, phase_costate  variables conjugate to a and to the anomaly
H, h*            hamiltonian              h*: max over u of what epsilon multiplies in H, (1.4)
u*               maximiser                the control that attains it, (1.5)
alpha            multipliers              of the target in the transversality conditions (1.6)
tau = eps t      tau                      slow time
xi, eta          slow(tau), costate(tau)  a and p of the first approximation, (2.3)
h0 = (eta f0)    averaged                 mean of h* over the phase at q = 0
kappa            kappa                    minus the mean of q / epsilon, (2.10); zero at the optimum
tau_1            duration                 slow time of arrival
J_0              cost                     (2.9)

`system` turns equations of motion into the averaged Hamiltonian h0, `averaged` solves its boundary value
problem, `exact` finds the extremals of the original system, `examples` holds the paper's problems.

The costate of the cost is -1 throughout, and the costs that the paper carries as further components of a
are integrals here, so that a system's slow variables are its physical ones.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
