"""Orbit correction with the fewest impulses (Ibragimov 2017), by 0-controllable sets.

A satellite near a circular orbit fires impulses at equal intervals. The states that can be brought back in
N steps form a sum of ellipsoids; the gauge alpha(N) of the initial state in that set tells whether N steps
do, and the normal there is the costate of a discrete maximum principle.

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
alpha, mu         gauge              Minkowski functional of X(N, 0)
psi(k)            costates           adjoint vectors, -psi normal to X
N_min             steps              fewest steps
"""

from pontryagin import lazy

__getattr__, __dir__, __all__ = lazy.attach(
    __name__,
    {
        "correct": "plan.correction",
        "Plan": "plan.correction",
        "gauge": "gauges.general",
        "Gauge": "gauges.general",
        "DiscreteSystem": "system.discrete",
        "least_peak": "plan.alternatives",
        "least_energy": "plan.alternatives",
        "least_fuel": "plan.alternatives",
        "power_gauge": "gauges.pball",
        "fewest_power_steps": "gauges.pball",
        "fly": "flight",
        "fly_plan": "flight",
        "close_loop": "flight",
        "count_impulses": "waste",
        "random_states": "waste",
        "impulse_distribution": "montecarlo",
        "derivation": "",
        "ergodic": "",
        "figures": "",
        "intervals": "",
        "playback": "",
    },
)
