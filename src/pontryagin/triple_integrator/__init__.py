"""Optimal control of the triple integrator (Gorelov & Morozova 2012), as a moment problem.

One channel of a spacecraft's attitude, x1' = x2, x2' = x3 + f(t), x3' = u, is steered between given
states in a given time with the least energy (L2), the least peak (L-infinity) or the least total impulse
(L1) of u, or in the least time under a bound on |u|. Krasovskii's maximum principle makes each a moment
problem: u must have the moments c against the impulse response h(s), and its least norm is the inverse of
the least dual norm of l'h over l'c = 1.

paper           here                meaning
--------------  ------------------  -----------------------------------------------------------
gamma, omega    x1, x2              angle and rate
m               x3                  relative control moment (control acceleration)
u               control             rate of the control acceleration
f               disturbance         disturbing and cross-coupling acceleration
T               duration            tf - t0
tf - tau        s                   time to go
h(tau)          dual function       response of the state at tf to an impulse at tau
c               moments             what the integral of h u must be
l, l0           multipliers         coefficients of the dual function; of the minimal element
rho0            1 / norm            norm of the minimal element
psi             costate             psi_3 = h
D, W            gramian             controllability Gramian
u0              norm                least peak of |u|
t1, t2          switch_times        zeros of the minimal element
a0, am, aT      impulses            at the start, in the middle, at the end
R               norm                total impulse
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
