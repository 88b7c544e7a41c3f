"""Numeric kernels of the triple integrator.

Generated from the derivation by `make kernels`; do not edit.
"""


def coast(x10, x20, x30, T):
    """Phi(t, t0) x0, (1.4)."""
    x0 = T*x30
    x1 = T*((1/2)*x0 + x20) + x10
    x2 = x0 + x20
    x3 = x30
    return x1, x2, x3


def moments(x10, x20, x30, x1f, x2f, x3f, T, g1, g2):
    """c, (1.10); g1 and g2 are the disturbance's integrals (1.8)."""
    x0 = T*x30
    c1 = -T*((1/2)*x0 + x20) - g1 - x10 + x1f
    c2 = -g2 - x0 - x20 + x2f
    c3 = -x30 + x3f
    return c1, c2, c3


def dual_function(l1, l2, l3, s):
    """h(s) = l'h(s), (1.12), (3.3)."""
    h = (1/2)*l1*(s*s) + l2*s + l3
    return h


def energy_control(c1, c2, c3, T):
    """Coefficients of 1, s, s^2 in the least-energy control (2.2), (2.3)."""
    x0 = T*c2
    x1 = (T*T)*c3
    x2 = 3*x1
    u0 = 3*(20*c1 - 12*x0 + x2)/(T*T*T)
    u1 = -12*(30*c1 - 16*x0 + x2)/(T*T*T*T)
    u2 = 30*(12*c1 - 6*x0 + x1)/T**5
    return u0, u1, u2


def energy_multipliers(c1, c2, c3, T):
    """D^-1 c: multipliers up to a factor, before (2.2)."""
    x0 = 360/(T*T*T*T)
    x1 = 1/(T*T*T)
    x2 = 60*x1
    x3 = 36/(T*T)
    l1 = -c2*x0 + c3*x2 + 720*c1/T**5
    l2 = -c1*x0 + 192*c2*x1 - c3*x3
    l3 = c1*x2 - c2*x3 + 9*c3/T
    return l1, l2, l3


def gramian_form(l1, l2, l3, T):
    """l'Dl, the squared L2 norm of the dual function, (2.1)."""
    x0 = (1/2)*(T*T)
    x1 = (T*T*T)
    x2 = (1/6)*x1
    x3 = (1/8)*(T*T*T*T)
    form = l1*((1/20)*T**5*l1 + l2*x3 + l3*x2) + l2*(l1*x3 + (1/3)*l2*x1 + l3*x0) + l3*(T*l3 + l1*x2 + l2*x0)
    return form


def level_equation(t, k1, k2, k3):
    """G(t) = 0 at t = 1/v, convex, and its derivative."""
    x0 = k3*t - 1
    x1 = -x0
    x2 = 1/x1
    x3 = -k2*t + 1
    x4 = (3/4)*(x3*x3)
    g = k1*t - 1/16*(x0*x0*x0) + x2*x4 - 1
    slope = k1 - 3/2*k2*x2*x3 - 3/16*k3*(x0*x0) + k3*x4/(x1*x1)
    return g, slope


def near_constant_equation(y, k3, w, e2):
    """The same in y = 1 - k3 t, and its derivative in y."""
    x0 = 1 - y
    x1 = w/k3
    x2 = 1/y
    x3 = (e2*e2)
    x4 = 1/(k3*k3)
    x5 = (3/4)*(x0*x0)*x3*x4
    x6 = (y*y)
    g = x0*x1 + x2*x5 + (1/16)*(y*y*y) - 1/4*y
    slope = -x1 + (3/4)*x2*x3*x4*(2*y - 2) - x5/x6 + (3/16)*x6 - 1/4
    return g, slope


def bang_bang_moments(v, a, b):
    """Scaled moments of v outside [b, a] and -v inside."""
    k1 = -v*(2*(a*a*a) - 2*(b*b*b) - 1)
    k2 = -v*(2*(a*a) - 2*(b*b) - 1)
    k3 = -v*(2*a - 2*b - 1)
    return k1, k2, k3


def peak_bound(k1, k2, k3, a, b):
    """Lower bound (up to its sign) on the peak from the dual function (s - a)(s - b)."""
    x0 = a*b
    bound = ((1/3)*k1 + (1/2)*k2*(-a - b) + k3*x0)/((1/3)*(a*a*a) - (a*a)*b + a*(b*b) - 1/2*a - 1/3*(b*b*b) - 1/2*b + x0 + 1/3)
    return bound


def pairing(x, m0, m1, m2):
    """p.mu for p = 2 (1 - x sigma)^2 - 1."""
    value = m0 - 4*m1*x + 2*m2*(x*x)
    return value


def reversed_moments(m0, m1, m2):
    """Moments of the same control in 1 - sigma."""
    r0 = m0
    r1 = m0 - m1
    r2 = m0 - 2*m1 + m2
    return r0, r1, r2


def chebyshev_amplitudes(m0, m1, m2):
    """Impulses at sigma = 0, 1/2, 1 with these moments, (4.10)."""
    a_end = m0 - 3*m1 + 2*m2
    a_middle = 4*(m1 - m2)
    a_start = -m1 + 2*m2
    return a_end, a_middle, a_start


def two_impulses(m0, m1, m2):
    """Impulses at sigma = 0 and mu2/mu1 with these moments."""
    x0 = (m1*m1)/m2
    a_end = m0 - x0
    a_inside = x0
    return a_end, a_inside


def small_parts(x10, x20, x30, x1f, x2f, x3f, f, c3):
    """r2 = r20 + r21 z and w = w0 + w1 z + w2 z^2 in z = T - c3, for c3 >= 0."""
    x0 = c3*x30
    x1 = c3*x3f
    x2 = 2*f
    x3 = 6*c3
    x4 = (c3*c3)
    r20 = -c3*x2 - x0 - x1 - 2*x20 + 2*x2f
    r21 = -x2 - x30 - x3f
    w0 = 12*x10 - 12*x1f + x20*x3 + x2f*x3 + x30*x4 - x3f*x4
    w1 = 2*x0 - 2*x1 + 6*x20 + 6*x2f
    w2 = x30 - x3f
    return r20, r21, w0, w1, w2


def same_branch(r20, r21, w0, w1, w2, c3):
    """Quartic in z = T - c3 for the level of same sign as c3, constant term first."""
    q0 = -12*(r20*r20)
    q1 = -8*(3*r20*r21 - w0)
    q2 = -4*(-(c3*c3) + 3*(r21*r21) - 2*w1)
    q3 = 8*(c3 + w2)
    q4 = 3
    return q0, q1, q2, q3, q4


def opposite_branch(r20, r21, w0, w1, w2, c3):
    """Quartic in z = T - c3 for the level of opposite sign as c3, constant term first."""
    x0 = 4*c3
    x1 = 2*w1
    q0 = -12*(r20*r20) - 4*w0*x0
    q1 = 16*(c3*c3*c3) - 8*c3*x1 - 24*r20*r21 - 8*w0
    q2 = 28*(c3*c3) - 12*(r21*r21) - 4*w2*x0 - 4*x1
    q3 = -8*(-2*c3 + w2)
    q4 = 3
    return q0, q1, q2, q3, q4
