"""Orbit correction with the fewest impulses (Ibragimov 2017), by 0-controllable sets.

A satellite near a circular orbit fires impulses at equal intervals. The states that N steps bring back to the
circle form a sum of ellipsoids. N steps suffice if the gauge alpha(N) of the initial state in this set is at
most 1, and the normal of the set at the scaled state is the costate of a discrete maximum principle.

derivation   from the equations of motion to the summands, in SymPy
claims       the ledger's entries; printed: the paper's worked example
system       the satellite and its regrouped steps (12); any system (1) with ellipsoids
gauges       alpha for each shape of the controls, Lemma 7 and Lemma 9
plan         the three sets of impulses, N_min, Theorem 4, other plans of the same length
flight       plans on the nonlinear equations, and the closed loop
ergodic, intervals, montecarlo, waste   studies: many steps, the interval, random injections, wasted impulses
sets         boundaries of controllable sets, for figures and playback

paper             here               meaning
----------------  -----------------  ----------------------------------------------------------------
z                 z0, states         deviations (dr, dv_R, dv_T) from the circle
w1, w2            impulses           radial and transverse impulse
alpha_max         peak               bound on an impulse
Delta t           interval           time between impulses
u~(k)             step_controls      three successive impulse components of step k
A(k), B(k)        step_transition,   matrices of step k
                  step_input
U(k), H(k)        DiscreteSystem.H   ellipsoid (u, H u) <= 1 of admissible controls
E_k, H~(k)        factors G_k        ellipsoid G_k B that step k adds, with H~^-1 = G G'
X(N, k)           -                  states brought to 0 from step k in N steps
alpha, mu         gauge              Minkowski functional of X(N, 0) at the state
psi(k)            costates           adjoint vectors, -psi normal to X
N_min             steps              fewest steps
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
