"""Low-thrust rendezvous (Pimkina & Chelnokov; Sapunkov): the problem, the repaired equations, the solvers.

A craft under thrust meets another one that coasts on a Kepler ellipse, at a free place of its orbit. The
functional is the integral of alpha1 + alpha2 p^2, and the thrust is bounded. Pimkina & Chelnokov write the
motion in rotating axes eta (eta1 along the radius, eta3 along R x V, attitude quaternion lambda) and reduce
the 16 equations of the maximum principle to ten. Their condition (15), meant to replace the condition on the
attitude, has rank two instead of three; an eleventh equation restores the lost condition. Sapunkov uses
orbital elements A, B from the Kustaanheimo-Stiefel regularisation; both the same problem and the least-fuel
problem are solved in them.

paper            here                       meaning
---------------  -------------------------  ------------------------------------------------------
r, v1, c         r, v1, c                   distance, radial velocity, areal constant |R x V|
r*, v1*          goal                       r and v1 of the target at the meeting; c* below
lambda           attitude                   quaternion of eta in inertial axes, scalar first
lambda*          goal                       the target's attitude at the meeting
omega_eta        -                          angular velocity of eta
p_eta, p_max     thrust, peak               acceleration by thrust, in eta, and its bound
fM               gravity                    gravitational parameter
p*, e*, c*       parameter, eccentricity,   of the target's orbit; c*^2 = fM p*
                 areal
Lambda*          attitude, orientation      quaternion of the target's orbit
Omega_u*, I*,    node, inclination,         angles of the target's orbit
omega_pi*        pericentre
phi*             anomaly                    the target's true anomaly; phi*_k arrival_anomaly
t_k              duration                   time of the meeting, from t0 = 0
alpha1, alpha2   time_weight,               weights of the functional
                 energy_weight
g, psi0          -                          running value of the functional and its costate, -1
rho, s1, e       rho, s1, e                 costates of r, v1, c
mu, Phi*         mu, anomaly_costate        costates of lambda and phi*
nu = lambda~mu   nu1, nu2, nu3              (the scan prints nu as v)
nu*              -                          mu lambda~, constant
n_eta            switching                  the primer vector, along which the thrust lies
C_phi            anomaly_constant           Phi* (1 + e* cos phi*)^2, constant along a flight
H0               hamiltonian                Hamiltonian at the optimal thrust, 0 where t_k is free
-                chi                        angle about nu*, which the ten equations do not contain
A, B, Q          A, B, Q                    Sapunkov's elements; Q = A^2 + B^2, twice the semi-axis
u, w             u, w                       place R = u~ i1 u, and du/dphi
phi, t           phi, t                     half the eccentric anomaly, up to a constant; time
p, epsilon       thrust, -                  acceleration by thrust, in inertial axes; its unit, 1 here
q, P(u)          lifted_force, lifting      q = P(u) p = -i1 u p; in the derivation
F1               driving                    u^2 q + (w, q) w; in the derivation driving is Q F1
-                a, b                       costates of A and B
-                switching                  n in inertial axes, of the solutions in the elements
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
