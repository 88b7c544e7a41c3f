"""Numeric kernels of the paper's examples.

Generated from the derivations by `make kernels`; do not edit.
"""

from numpy import cos, sin, sqrt

SIZES = {
    "smooth": (1, 1),
    "kepler": (2, 1),
    "spin_down": (2, 1),
}
"""Numbers of slow variables and of conditions at the end."""


def smooth_mean(v, p_v, v1, k, ripple):
    """Section 3, smooth example: h0, its gradient and the upper triangle of its Hessian in (a, p), (2.3)."""
    c0 = -k + (1/4)*(p_v*p_v)
    c1 = 0
    c2 = (1/2)*p_v
    c3 = 0
    c4 = 0
    c5 = 1/2
    return c0, c1, c2, c3, c4, c5


def smooth_frequency(v, v1, k, ripple):
    """Section 3, smooth example: omega, its gradient and Hessian in a."""
    c0 = v
    c1 = 1
    c2 = 0
    return c0, c1, c2


def smooth_boundary(v, v1, k, ripple):
    """Section 3, smooth example: M and g, each with its gradient and Hessian in a, (1.2), (1.3)."""
    c0 = v - v1
    c1 = 1
    c2 = 0
    c3 = 0
    c4 = 0
    c5 = 0
    return c0, c1, c2, c3, c4, c5


def smooth_control(v, p_v, x, v1, k, ripple):
    """Section 3, smooth example: u*(a, x, p) at q = 0, (1.5)."""
    c0 = (1/2)*p_v
    return c0


def smooth_rates(v, x, u, v1, k, ripple):
    """Section 3, smooth example: f and the running cost, (1.1)."""
    c0 = ripple*cos(x) + u
    c1 = k + (u*u)
    return c0, c1


def smooth_pace(v, x, v1, k, ripple):
    """Section 3, smooth example: dt/dx at epsilon = 0."""
    c0 = 1/v
    return c0


def kepler_mean(E, K, p_E, p_K, E1, l):
    """Example 2: h0, its gradient and the upper triangle of its Hessian in (a, p), (2.3)."""
    x0 = (1/2)*p_K
    x1 = p_E*x0
    x2 = (1/2)*(p_E*p_E)
    x3 = 1/(E*E)
    x4 = (p_K*p_K)
    x5 = x3*x4
    x6 = 1/E
    x7 = (K*K)
    x8 = (3/16)*x7
    x9 = 1/(E*E*E)
    x10 = x4*x9
    x11 = (3/8)*x6
    x12 = x11*x4
    x13 = (1/2)*p_E
    x14 = (5/16)*x3
    x15 = x11*x7
    x16 = (3/8)*x7
    c0 = -E*x2 + K*x1 - l + x4*x6*x8 + (5/32)*x5
    c1 = -5/16*x10 - x2 - x5*x8
    c2 = K*x12 + x1
    c3 = -E*p_E + (1/2)*K*p_K
    c4 = K*x13 + p_K*x14 + p_K*x15
    c5 = x10*x16 + (15/16)*x4/(E*E*E*E)
    c6 = -3/8*K*x5
    c7 = -p_E
    c8 = -p_K*x16*x3 - 5/8*p_K*x9
    c9 = x12
    c10 = x0
    c11 = (3/4)*K*p_K*x6 + x13
    c12 = -E
    c13 = (1/2)*K
    c14 = x14 + x15
    return c0, c1, c2, c3, c4, c5, c6, c7, c8, c9, c10, c11, c12, c13, c14


def kepler_frequency(E, K, E1, l):
    """Example 2: omega, its gradient and Hessian in a."""
    x0 = sqrt(2)*(-E)**(3/2)
    c0 = 2*x0
    c1 = 3*x0/E
    c2 = 0
    c3 = (3/2)*x0/(E*E)
    c4 = 0
    c5 = 0
    return c0, c1, c2, c3, c4, c5


def kepler_boundary(E, K, E1, l):
    """Example 2: M and g, each with its gradient and Hessian in a, (1.2), (1.3)."""
    c0 = E - E1
    c1 = 1
    c2 = 0
    c3 = 0
    c4 = 0
    c5 = 0
    c6 = 0
    c7 = 0
    c8 = 0
    c9 = 0
    c10 = 0
    c11 = 0
    return c0, c1, c2, c3, c4, c5, c6, c7, c8, c9, c10, c11


def kepler_control(E, K, p_E, p_K, xi, E1, l):
    """Example 2: u*(a, x, p) at q = 0, (1.5)."""
    x0 = sqrt(2*E*(K*K) + 1)
    x1 = x0*cos(xi) - 1
    x2 = p_E/x1
    c0 = -1/2*sqrt(2)*x0*x2*sqrt(-E)*sin(xi)
    c1 = E*K*x2 + (1/4)*p_K*x1/E
    return c0, c1


def kepler_rates(E, K, xi, u_r, u_phi, E1, l):
    """Example 2: f and the running cost, (1.1)."""
    x0 = 2*E
    x1 = sqrt((K*K)*x0 + 1)
    x2 = x1*cos(xi) - 1
    x3 = 1/x2
    c0 = K*u_phi*x0*x3 - sqrt(2)*u_r*x1*x3*sqrt(-E)*sin(xi)
    c1 = (1/2)*u_phi*x2/E
    c2 = l + (u_phi*u_phi) + (u_r*u_r)
    return c0, c1, c2


def kepler_pace(E, K, xi, E1, l):
    """Example 2: dt/dx at epsilon = 0."""
    c0 = (1/4)*sqrt(2)*(-sqrt(2*E*(K*K) + 1)*cos(xi) + 1)/(-E)**(3/2)
    return c0


def spin_down_density(a, c, p_a, p_c, psi, l_x, l_y, l_z, d, sense):
    """Example 3: h* dpsi/dx at q = 0, its gradient and Hessian in (a, p), and its derivative in x."""
    x0 = (l_z*l_z)
    x1 = (p_c*p_c)
    x2 = (p_a*p_a)
    x3 = (l_x*l_x)
    x4 = cos(psi)
    x5 = x3*(x4*x4)
    x6 = sin(psi)
    x7 = (sense*sense)
    x8 = (l_y*l_y)
    x9 = (x6*x6)*x7*x8
    x10 = x0*x1 + x2*x5 + x2*x9
    x11 = sqrt(x10)
    x12 = p_a*x5 + p_a*x9
    x13 = 1/x11
    x14 = x10**(-3/2)
    x15 = x12*x14
    c0 = x11 - 1
    c1 = 0
    c2 = 0
    c3 = x12*x13
    c4 = p_c*x0*x13
    c5 = 0
    c6 = 0
    c7 = 0
    c8 = 0
    c9 = 0
    c10 = 0
    c11 = 0
    c12 = -x12*x15 + x13*(x5 + x9)
    c13 = -p_c*x0*x15
    c14 = -(l_z*l_z*l_z*l_z)*x1*x14 + x0*x13
    c15 = x13*(-x2*x3*x4*x6 + x2*x4*x6*x7*x8)
    return c0, c1, c2, c3, c4, c5, c6, c7, c8, c9, c10, c11, c12, c13, c14, c15


def spin_down_frequency(a, c, l_x, l_y, l_z, d, sense):
    """Example 3: omega, its gradient and Hessian in a."""
    x0 = sense*(d - 1)
    c0 = c*x0
    c1 = 0
    c2 = x0
    c3 = 0
    c4 = 0
    c5 = 0
    return c0, c1, c2, c3, c4, c5


def spin_down_boundary(a, c, l_x, l_y, l_z, d, sense):
    """Example 3: M and g, each with its gradient and Hessian in a, (1.2), (1.3)."""
    c0 = a
    c1 = 1
    c2 = 0
    c3 = 0
    c4 = 0
    c5 = 0
    c6 = 0
    c7 = 0
    c8 = 0
    c9 = 0
    c10 = 0
    c11 = 0
    return c0, c1, c2, c3, c4, c5, c6, c7, c8, c9, c10, c11


def spin_down_control(a, c, p_a, p_c, psi, l_x, l_y, l_z, d, sense):
    """Example 3: u*(a, x, p) at q = 0, (1.5)."""
    x0 = (l_x*l_x)
    x1 = cos(psi)
    x2 = (l_z*l_z)
    x3 = (p_a*p_a)
    x4 = (l_y*l_y)
    x5 = sin(psi)
    x6 = 1/sqrt((p_c*p_c)*x2 + (sense*sense)*x3*x4*(x5*x5) + x0*(x1*x1)*x3)
    x7 = p_a*x6
    c0 = x0*x1*x7
    c1 = sense*x4*x5*x7
    c2 = p_c*x2*x6
    return c0, c1, c2


def spin_down_rates(a, c, psi, u_x, u_y, u_z, l_x, l_y, l_z, d, sense):
    """Example 3: f and the running cost, (1.1)."""
    c0 = sense*u_y*sin(psi) + u_x*cos(psi)
    c1 = u_z
    c2 = 1
    return c0, c1, c2


def spin_down_pace(a, c, psi, l_x, l_y, l_z, d, sense):
    """Example 3: dt/dx at epsilon = 0."""
    c0 = 1/(c*sense*(d - 1))
    return c0
