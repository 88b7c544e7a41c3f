"""Low-thrust rendezvous (Pimkina & Chelnokov; Sapunkov): posed, repaired and solved.

A craft under thrust meets another that coasts on a Kepler ellipse, at a free place of its orbit. The
functional is the integral of alpha1 + alpha2 p^2, the thrust is bounded. Pimkina & Chelnokov write the
motion in axes eta that turn with the craft (eta1 along the radius, eta3 along R x V, attitude quaternion
lambda) and reduce the 16 equations of the maximum principle to ten; the condition that is to stand for the
attitude is one short, and one more equation restores it. Sapunkov uses orbital elements A, B that come from
the Kustaanheimo-Stiefel regularisation; in them the same problem is solved, and that of least fuel.

paper            here                       meaning
---------------  -------------------------  ------------------------------------------------------
r, v1, c         r, v1, c                   distance, radial velocity, areal constant |R x V|
lambda           attitude                   quaternion of eta in inertial axes, scalar first
omega_eta        -                          angular velocity of eta
p_eta, p_max     thrust, peak               acceleration by thrust, in eta, and its bound
fM               gravity                    gravitational parameter
p*, e*, c*       parameter, eccentricity,   of the target's orbit; c*^2 = fM p*
                 areal
Lambda*          orientation                quaternion of the target's orbit
phi*             anomaly                    the target's true anomaly; phi*_k arrival_anomaly
t_k              duration                   time of the meeting, from t0 = 0
alpha1, alpha2   time_weight,               weights of the functional
                 energy_weight
rho, s1, e       rho, s1, e                 costates of r, v1, c
mu, Phi*         mu, anomaly_costate        costates of lambda and phi*
nu = lambda~mu   nu1, nu2, nu3              (the scan prints nu as v)
nu*              -                          mu lambda~, constant
n_eta            switching                  what the thrust lies along: the primer vector
-                chi                        angle about nu*: what the ten equations do not know
A, B, w, Q       A, B, w, Q                 Sapunkov's elements; Q = A^2 + B^2, twice the semi-axis
phi              phi                        half the eccentric anomaly, up to a constant
-                a, b                       costates of A and B
-                switching                  n in inertial axes, of the solutions in the elements
"""

from pontryagin import lazy

__getattr__, __dir__, __all__ = lazy.attach(
    __name__,
    {
        "Orbit": "problem",
        "Chaser": "problem",
        "Rendezvous": "problem",
        "solve": "solution",
        "Extremal": "solution",
        "RendezvousCertificate": "certify",
        "carry": "many",
        "Carried": "many",
        "multistart": "many",
        "false_meeting": "misled",
        "false_family": "meetings",
        "Elements": "elements",
        "solve_in_elements": "elements_solve",
        "least_fuel": "elements_fuel",
        "ElementsExtremal": "elements_solve",
        "ElementsCertificate": "elements_certify",
        "derivation": "",
    },
)
