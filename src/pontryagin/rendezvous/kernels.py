"""Numeric kernels of the rendezvous.

Generated from the derivation by `make kernels`; do not edit.
"""

from numpy import cos, sin, sqrt


def unsaturated(r, v1, c, phi, rho, s1, e, nu1, nu2, nu3, chi, fM, p_star, e_star, c_star, alpha2, chart):
    """Rates of (11), (12), (13), (14), phi* and chi, unsaturated."""
    x0 = 1/alpha2
    x1 = (1/2)*x0
    x2 = (r*r)
    x3 = 1/x2
    x4 = (c*c)
    x5 = 1/(r*r*r)
    x6 = 2*s1
    x7 = 1/x4
    x8 = x0*x7
    x9 = (nu1*nu1)
    x10 = c*x3
    x11 = (1/4)*x2*x8
    d0 = v1
    d1 = -fM*x3 + s1*x1 + x4*x5
    d2 = e*x1*x2
    d3 = c_star*((e_star*cos(phi) + 1)*(e_star*cos(phi) + 1))/(p_star*p_star)
    d4 = c*nu3*x5 - (e*e)*r*x1 - fM*x5*x6 - 1/8*r*x8*x9 + 3*s1*x4/(r*r*r*r)
    d5 = -rho
    d6 = -c*x5*x6 - 1/2*nu3*x3 + (1/8)*x0*x2*x9/(c*c*c)
    d7 = nu2*x10
    d8 = (1/4)*nu1*nu3*x0*x2*x7 - nu1*x10
    d9 = -nu1*nu2*x11
    d10 = x10 + x11*x9/(chart*sqrt((nu2*nu2) + (nu3*nu3) + x9) + nu3)
    return d0, d1, d2, d3, d4, d5, d6, d7, d8, d9, d10


def full_unsaturated(r, v1, c, phi, lambda0, lambda1, lambda2, lambda3, rho, s1, e, Phi, mu0, mu1, mu2, mu3, fM, p_star, e_star, c_star, alpha2):
    """Rates of the 16 equations, unsaturated."""
    x0 = 1/alpha2
    x1 = (1/2)*x0
    x2 = (r*r)
    x3 = 1/x2
    x4 = (c*c)
    x5 = 1/(r*r*r)
    x6 = e_star*cos(phi) + 1
    x7 = c_star/(p_star*p_star)
    x8 = (1/2)*x3
    x9 = lambda3*x8
    x10 = 1/x4
    x11 = lambda0*mu1 - lambda1*mu0 - lambda2*mu3 + lambda3*mu2
    x12 = (1/8)*x0*x10*x11
    x13 = x12*x2
    x14 = lambda2*x8
    x15 = lambda1*x8
    x16 = lambda0*x8
    x17 = c*x5
    x18 = r*x12
    x19 = 1/(c*c*c)
    x20 = (1/8)*x0*x11*x19*x2
    x21 = c*x8
    d0 = v1
    d1 = -fM*x3 + s1*x1 + x4*x5
    d2 = e*x1*x2
    d3 = (x6*x6)*x7
    d4 = -c*x9 - lambda1*x13
    d5 = c*x14 + lambda0*x13
    d6 = -c*x15 + (1/8)*lambda3*x0*x10*x11*x2
    d7 = c*x16 - lambda2*x13
    d8 = -(e*e)*r*x1 - mu0*(-lambda1*x18 + lambda3*x17) - mu1*((1/8)*lambda0*r*x0*x10*x11 - lambda2*x17) - mu2*(lambda1*x17 + lambda3*x18) - mu3*(-lambda0*x17 - lambda2*x18) - s1*(2*fM*x5 - 3*x4/(r*r*r*r))
    d9 = -rho
    d10 = -mu0*((1/8)*lambda1*x0*x11*x19*x2 - x9) - mu1*(-lambda0*x20 + x14) - mu2*(-lambda3*x20 - x15) - mu3*(lambda2*x20 + x16) - 2*s1*x17
    d11 = 2*Phi*e_star*x6*x7*sin(phi)
    d12 = -mu1*x13 - mu3*x21
    d13 = mu0*x13 + mu2*x21
    d14 = -mu1*x21 + (1/8)*mu3*x0*x10*x11*x2
    d15 = mu0*x21 - mu2*x13
    return d0, d1, d2, d3, d4, d5, d6, d7, d8, d9, d10, d11, d12, d13, d14, d15


def saturated(r, v1, c, phi, rho, s1, e, nu1, nu2, nu3, chi, fM, p_star, e_star, c_star, p_max, chart):
    """Rates of (11), (12), (13), (14), phi* and chi, saturated."""
    x0 = (r*r)
    x1 = 1/x0
    x2 = (c*c)
    x3 = 1/(r*r*r)
    x4 = (e*e)
    x5 = 1/x2
    x6 = x0*x5
    x7 = (nu1*nu1)
    x8 = (1/4)*x7
    x9 = 1/sqrt((s1*s1) + x0*x4 + x6*x8)
    x10 = p_max*x9
    x11 = 2*s1
    x12 = r*x10
    x13 = c*x1
    x14 = x10*x6
    d0 = v1
    d1 = -fM*x1 + s1*x10 + x2*x3
    d2 = e*x0*x10
    d3 = c_star*((e_star*cos(phi) + 1)*(e_star*cos(phi) + 1))/(p_star*p_star)
    d4 = c*nu3*x3 - fM*x11*x3 - x12*x4 - x12*x5*x8 + 3*s1*x2/(r*r*r*r)
    d5 = -rho
    d6 = -c*x11*x3 - 1/2*nu3*x1 + (1/4)*p_max*x0*x7*x9/(c*c*c)
    d7 = nu2*x13
    d8 = (1/2)*nu1*nu3*p_max*x0*x5*x9 - nu1*x13
    d9 = -1/2*nu1*nu2*x14
    d10 = x13 + (1/2)*x14*x7/(chart*sqrt((nu2*nu2) + (nu3*nu3) + x7) + nu3)
    return d0, d1, d2, d3, d4, d5, d6, d7, d8, d9, d10


def full_saturated(r, v1, c, phi, lambda0, lambda1, lambda2, lambda3, rho, s1, e, Phi, mu0, mu1, mu2, mu3, fM, p_star, e_star, c_star, p_max):
    """Rates of the 16 equations, saturated."""
    x0 = (r*r)
    x1 = 1/x0
    x2 = (c*c)
    x3 = 1/(r*r*r)
    x4 = (e*e)
    x5 = lambda0*mu1 - lambda1*mu0 - lambda2*mu3 + lambda3*mu2
    x6 = 1/x2
    x7 = (1/4)*x6
    x8 = x0*x7
    x9 = 1/sqrt((s1*s1) + x0*x4 + (x5*x5)*x8)
    x10 = p_max*x9
    x11 = x0*x10
    x12 = e_star*cos(phi) + 1
    x13 = c_star/(p_star*p_star)
    x14 = (1/2)*x1
    x15 = lambda3*x14
    x16 = lambda1*x5
    x17 = x10*x8
    x18 = lambda2*x14
    x19 = x17*x5
    x20 = lambda1*x14
    x21 = lambda0*x14
    x22 = r*x10
    x23 = c*x3
    x24 = x22*x7
    x25 = x24*x5
    x26 = 1/(c*c*c)
    x27 = (1/4)*x11*x26*x5
    x28 = c*x14
    d0 = v1
    d1 = -fM*x1 + s1*x10 + x2*x3
    d2 = e*x11
    d3 = (x12*x12)*x13
    d4 = -c*x15 - x16*x17
    d5 = c*x18 + lambda0*x19
    d6 = -c*x20 + (1/4)*lambda3*p_max*x0*x5*x6*x9
    d7 = c*x21 - lambda2*x19
    d8 = -mu0*(lambda3*x23 - x16*x24) - mu1*((1/4)*lambda0*p_max*r*x5*x6*x9 - lambda2*x23) - mu2*(lambda1*x23 + lambda3*x25) - mu3*(-lambda0*x23 - lambda2*x25) - s1*(2*fM*x3 - 3*x2/(r*r*r*r)) - x22*x4
    d9 = -rho
    d10 = -mu0*((1/4)*lambda1*p_max*x0*x26*x5*x9 - x15) - mu1*(-lambda0*x27 + x18) - mu2*(-lambda3*x27 - x20) - mu3*(lambda2*x27 + x21) - 2*s1*x23
    d11 = 2*Phi*e_star*x12*x13*sin(phi)
    d12 = -mu1*x19 - mu3*x28
    d13 = mu0*x19 + mu2*x28
    d14 = -mu1*x28 + (1/4)*mu3*p_max*x0*x5*x6*x9
    d15 = mu0*x28 - mu2*x19
    return d0, d1, d2, d3, d4, d5, d6, d7, d8, d9, d10, d11, d12, d13, d14, d15


def attitude(nu1_0, nu2_0, nu3_0, nu1, nu2, nu3, chi, chart):
    """lambda0~ o lambda of nu and chi."""
    x0 = (nu1_0*nu1_0) + (nu2_0*nu2_0) + (nu3_0*nu3_0)
    x1 = x0**(-1/4)
    x2 = (1/2)*chi
    x3 = x1*cos(x2)
    x4 = (nu1*nu1) + (nu2*nu2) + (nu3*nu3)
    x5 = sqrt(chart*nu3 + sqrt(x4))
    x6 = x4**(-1/4)
    x7 = x5*x6
    x8 = sqrt(chart*nu3_0 + sqrt(x0))
    x9 = (1/2)*x8
    x10 = (1/2)*sqrt(2)
    x11 = chart*x10
    x12 = x11/x8
    x13 = nu1_0*x12
    x14 = sin(x2)
    x15 = x1*x14
    x16 = nu2_0*x12
    x17 = x13*x3 + x15*x16
    x18 = x6/x5
    x19 = x11*x18
    x20 = nu1*x19
    x21 = x13*x15 - x16*x3
    x22 = nu2*x19
    x23 = chart*x18*x9
    x24 = x15*x23
    x25 = x23*x3
    x26 = x10*x7
    q0 = x17*x20 - x21*x22 + x3*x7*x9
    q1 = nu1*x24 + nu2*x25 + x21*x26
    q2 = -nu1*x25 + nu2*x24 + x17*x26
    q3 = (1/2)*x1*x14*x5*x6*x8 - x17*x22 - x20*x21
    return q0, q1, q2, q3


def target(phi, p_star, e_star, c_star, Lambda0, Lambda1, Lambda2, Lambda3):
    """r*, v1*, c* of (5), phi*', lambda* of (6)."""
    x0 = e_star*cos(phi) + 1
    x1 = (1/2)*phi
    x2 = cos(x1)
    x3 = sin(x1)
    r_goal = p_star/x0
    v_goal = c_star*e_star*sin(phi)/p_star
    c_goal = c_star
    rate = c_star*(x0*x0)/(p_star*p_star)
    q0 = Lambda0*x2 - Lambda3*x3
    q1 = Lambda1*x2 + Lambda2*x3
    q2 = -Lambda1*x3 + Lambda2*x2
    q3 = Lambda0*x3 + Lambda3*x2
    return r_goal, v_goal, c_goal, rate, q0, q1, q2, q3


def mismatch(r, v1, c, nu1, nu2, nu3, chi, nu1_0, nu2_0, nu3_0, chart, r_goal, v_goal, c_goal, q0_goal, q1_goal, q2_goal, q3_goal):
    """(5), and (6) by nu and chi, towards any goal."""
    x0 = (nu1_0*nu1_0) + (nu2_0*nu2_0) + (nu3_0*nu3_0)
    x1 = x0**(-1/4)
    x2 = (1/2)*chi
    x3 = x1*sin(x2)
    x4 = sqrt(chart*nu3_0 + sqrt(x0))
    x5 = (1/2)*x4
    x6 = (nu1*nu1) + (nu2*nu2) + (nu3*nu3)
    x7 = x6**(-1/4)
    x8 = sqrt(chart*nu3 + sqrt(x6))
    x9 = 1/x8
    x10 = x7*x9
    x11 = chart*x10*x5
    x12 = cos(x2)
    x13 = x1*x12
    x14 = nu2*x11
    x15 = (1/2)*sqrt(2)
    x16 = chart*x15
    x17 = x16/x4
    x18 = nu1_0*x17
    x19 = nu2_0*x17
    x20 = -x13*x19 + x18*x3
    x21 = x7*x8
    x22 = x15*x21
    x23 = -nu1*x11*x3 - x13*x14 - x20*x22
    x24 = x13*x18 + x19*x3
    x25 = (1/2)*chart*nu1*x1*x12*x4*x7*x9 - x14*x3 - x22*x24
    x26 = x21*x5
    x27 = x10*x16
    x28 = nu1*x27
    x29 = nu2*x27
    x30 = x13*x26 - x20*x29 + x24*x28
    x31 = x20*x28 + x24*x29 - x26*x3
    f0 = r - r_goal
    f1 = v1 - v_goal
    f2 = c - c_goal
    f3 = q0_goal*x23 + q1_goal*x30 - q2_goal*x31 + q3_goal*x25
    f4 = q0_goal*x25 + q1_goal*x31 + q2_goal*x30 - q3_goal*x23
    f5 = q0_goal*x31 - q1_goal*x25 + q2_goal*x23 + q3_goal*x30
    return f0, f1, f2, f3, f4, f5


def anomaly_constant(rho, s1, nu3, phi, p_star, e_star, c_star):
    """C_phi at a meeting, (16)."""
    x0 = e_star*cos(phi)
    x1 = ((x0 + 1)*(x0 + 1))
    constant = -c_star*s1*x0*x1/p_star - e_star*p_star*rho*sin(phi) - 1/2*nu3*x1
    return constant


def switching(r, c, s1, e, nu1):
    """n_eta of (9)."""
    n0 = s1
    n1 = e*r
    n2 = (1/2)*nu1*r/c
    return n0, n1, n2


def switching_square(r, c, s1, e, nu1):
    """|n_eta|^2."""
    x0 = (r*r)
    square = (e*e)*x0 + (s1*s1) + (1/4)*(nu1*nu1)*x0/(c*c)
    return square


def hamiltonian(r, v1, c, rho, s1, e, nu1, nu2, nu3, p1, p2, p3, C_phi, fM, p_star, c_star, alpha1, alpha2):
    """H of (17) at any thrust."""
    x0 = 1/(r*r)
    value = C_phi*c_star/(p_star*p_star) - alpha1 - alpha2*(p1*p1) - alpha2*(p2*p2) - alpha2*(p3*p3) + (c*c)*s1/(r*r*r) + (1/2)*c*nu3*x0 + e*p2*r - fM*s1*x0 + p1*s1 + rho*v1 + (1/2)*nu1*p3*r/c
    return value


def terminal_law(r, c, s1, e, nu1, p1, p2, p3, alpha1, alpha2):
    """(n, p) - alpha1 - alpha2 p^2."""
    value = -alpha1 - alpha2*((p1*p1) + (p2*p2) + (p3*p3)) + e*p2*r + p1*s1 + (1/2)*nu1*p3*r/c
    return value


def cartesian_unsaturated(x, y, z, u, v, w, psi_x, psi_y, psi_z, psi_u, psi_v, psi_w, fM, alpha2):
    """Rates of R, V, psi_R and psi_V, unsaturated."""
    x0 = 1/alpha2
    x1 = (x*x)
    x2 = (y*y)
    x3 = (z*z)
    x4 = x1 + x2 + x3
    x5 = fM/x4**(3/2)
    x6 = 3*fM/x4**(5/2)
    x7 = x*x6
    x8 = x7*y
    x9 = psi_w*z
    x10 = -x5
    x11 = x6*y
    d0 = u
    d1 = v
    d2 = w
    d3 = (1/2)*psi_u*x0 - x*x5
    d4 = (1/2)*psi_v*x0 - x5*y
    d5 = (1/2)*psi_w*x0 - x5*z
    d6 = -psi_u*(x1*x6 + x10) - psi_v*x8 - x7*x9
    d7 = -psi_u*x8 - psi_v*(x10 + x2*x6) - x11*x9
    d8 = -psi_u*x7*z - psi_v*x11*z - psi_w*(x10 + x3*x6)
    d9 = -psi_x
    d10 = -psi_y
    d11 = -psi_z
    return d0, d1, d2, d3, d4, d5, d6, d7, d8, d9, d10, d11


def cartesian_saturated(x, y, z, u, v, w, psi_x, psi_y, psi_z, psi_u, psi_v, psi_w, fM, p_max):
    """Rates of R, V, psi_R and psi_V, saturated."""
    x0 = (x*x)
    x1 = (y*y)
    x2 = (z*z)
    x3 = x0 + x1 + x2
    x4 = fM/x3**(3/2)
    x5 = 1/sqrt((psi_u*psi_u) + (psi_v*psi_v) + (psi_w*psi_w))
    x6 = 3*fM/x3**(5/2)
    x7 = x*x6
    x8 = x7*y
    x9 = psi_w*z
    x10 = -x4
    x11 = x6*y
    d0 = u
    d1 = v
    d2 = w
    d3 = p_max*psi_u*x5 - x*x4
    d4 = p_max*psi_v*x5 - x4*y
    d5 = p_max*psi_w*x5 - x4*z
    d6 = -psi_u*(x0*x6 + x10) - psi_v*x8 - x7*x9
    d7 = -psi_u*x8 - psi_v*(x1*x6 + x10) - x11*x9
    d8 = -psi_u*x7*z - psi_v*x11*z - psi_w*(x10 + x2*x6)
    d9 = -psi_x
    d10 = -psi_y
    d11 = -psi_z
    return d0, d1, d2, d3, d4, d5, d6, d7, d8, d9, d10, d11


def cartesian(r, v1, c, lambda0, lambda1, lambda2, lambda3):
    """R and V of r, v1, c and lambda."""
    x6 = 2*r
    x7 = lambda0*x6
    x8 = c/r
    x9 = lambda0*v1 - lambda3*x8
    x10 = lambda1*x8 - lambda2*v1
    x11 = lambda0*x8 + lambda3*v1
    x12 = -lambda1*v1 - lambda2*x8
    x0 = (lambda0*lambda0)*r + (lambda1*lambda1)*r - (lambda2*lambda2)*r - (lambda3*lambda3)*r
    x1 = lambda1*lambda2*x6 + lambda3*x7
    x2 = 2*lambda1*lambda3*r - lambda2*x7
    x3 = lambda0*x9 - lambda1*x12 + lambda2*x10 - lambda3*x11
    x4 = lambda0*x11 - lambda1*x10 - lambda2*x12 + lambda3*x9
    x5 = lambda0*x10 + lambda1*x11 - lambda2*x9 - lambda3*x12
    return x0, x1, x2, x3, x4, x5


def primer(r, v1, c, rho, s1, e, nu1, nu2, nu3):
    """psi_R and psi_V, seen in eta."""
    x0 = 1/r
    x1 = (1/2)*x0
    x2 = (1/2)*nu1/c
    psi0 = c*e*x0 + rho
    psi1 = c*s1/(r*r) - e*v1 + nu3*x1
    psi2 = -nu2*x1 - v1*x2
    psi3 = s1
    psi4 = e*r
    psi5 = r*x2
    return psi0, psi1, psi2, psi3, psi4, psi5


def attraction(x, y, z, m0, m1, m2):
    """g = -R/r^3, its derivatives gx_x, gx_y, gx_z, gy_y, gy_z, gz_z, and the second ones of (m, g)."""
    x0 = (x*x)
    x1 = (y*y)
    x2 = (z*z)
    x3 = x0 + x1 + x2
    x4 = x3**(-3/2)
    x5 = -x4
    x6 = 3/x3**(5/2)
    x7 = x*x6
    x8 = -m1*y
    x9 = -m2*z
    x10 = 5/x3
    x11 = m1*y
    x12 = x0*x10
    x13 = m2*z
    x14 = x*x10
    x15 = m0*y
    x16 = x1*x10
    x17 = x14*z
    x18 = x10*x2
    x19 = -m0*x
    x20 = m0*x
    g0 = -x*x4
    g1 = -x4*y
    g2 = -x4*z
    s0 = x0*x6 + x5
    s1 = x7*y
    s2 = x7*z
    s3 = x1*x6 + x5
    s4 = x6*y*z
    s5 = x2*x6 + x5
    c0 = x6*(-m0*(x*x*x)*x10 + 3*m0*x - x11*x12 - x12*x13 - x8 - x9)
    c1 = x6*(m0*y - m1*x*x16 + m1*x - x12*x15 - x13*x14*y)
    c2 = x6*(-m0*x12*z + m0*z - m2*x*x18 + m2*x - x11*x17)
    c3 = x6*(-m1*x10*(y*y*y) + 3*m1*y - x13*x16 - x16*x20 - x19 - x9)
    c4 = x6*(-m1*x16*z + m1*z - m2*x18*y + m2*y - x15*x17)
    c5 = x6*(-m2*x10*(z*z*z) + 3*m2*z - x11*x18 - x18*x20 - x19 - x8)
    return g0, g1, g2, s0, s1, s2, s3, s4, s5, c0, c1, c2, c3, c4, c5


def cartesian_pace(x, y, z):
    """dt/ds, its slopes, and its second derivatives xx, xy, xz, yy, yz, zz."""
    x0 = (x*x)
    x1 = (y*y)
    x2 = (z*z)
    x3 = x0 + x1 + x2
    x4 = x3**(-1/4)
    x5 = (3/2)*x4
    x6 = 1/x3
    x7 = (3/4)*x4
    x8 = x3**(-5/4)
    x9 = (3/4)*x*x8
    weight = x3**(3/4)
    s0 = x*x5
    s1 = x5*y
    s2 = x5*z
    c0 = x7*(-x0*x6 + 2)
    c1 = -x9*y
    c2 = -x9*z
    c3 = x7*(-x1*x6 + 2)
    c4 = -3/4*x8*y*z
    c5 = x7*(-x2*x6 + 2)
    return weight, s0, s1, s2, c0, c1, c2, c3, c4, c5


def element_rates(A0, A1, A2, A3, B0, B1, B2, B3, a0, a1, a2, a3, b0, b1, b2, b3, varphi, p1, p2, p3):
    """Rates of A, B, a and b by phi at any thrust, (1), and dt/dphi."""
    x0 = cos(varphi)
    x1 = sin(varphi)
    x2 = A0*x0 + B0*x1
    x3 = A2*x0 + B2*x1
    x4 = A3*x0 + B3*x1
    x5 = p1*x2 - p2*x4 + p3*x3
    x6 = A1*x0 + B1*x1
    x7 = (x2*x2) + (x3*x3) + (x4*x4) + (x6*x6)
    x8 = -A0*x1 + B0*x0
    x9 = x5*x8
    x10 = -A1*x1 + B1*x0
    x11 = p1*x6 + p2*x3 + p3*x4
    x12 = x10*x11
    x13 = -A2*x1 + B2*x0
    x14 = -p1*x3 + p2*x6 + p3*x2
    x15 = x13*x14
    x16 = -A3*x1 + B3*x0
    x17 = -p1*x4 - p2*x2 + p3*x6
    x18 = x16*x17
    x19 = x12 + x15 + x18
    x20 = x19 + x9
    x21 = x20*x8 + x5*x7
    x22 = (A0*A0) + (A1*A1) + (A2*A2) + (A3*A3) + (B0*B0) + (B1*B1) + (B2*B2) + (B3*B3)
    x23 = x1*x22
    x24 = x10*x20 + x11*x7
    x25 = x13*x20 + x14*x7
    x26 = x16*x20 + x17*x7
    x27 = x0*x22
    x28 = -a1*x1 + b1*x0
    x29 = x22*x28
    x30 = x10*x29
    x31 = -a2*x1 + b2*x0
    x32 = x22*x31
    x33 = x13*x32
    x34 = -a3*x1 + b3*x0
    x35 = x22*x34
    x36 = x16*x35
    x37 = -a0*x1 + b0*x0
    x38 = x22*x37
    x39 = x24*x28
    x40 = x21*x37
    x41 = x25*x31
    x42 = x26*x34
    x43 = x10*(a1*x0 + b1*x1) + x13*(a2*x0 + b2*x1) + x16*(a3*x0 + b3*x1) - x2*x37 + x22*x39 + x22*x40 + x22*x41 + x22*x42 - x28*x6 - x3*x31 - x34*x4 + x8*(a0*x0 + b0*x1)
    x44 = 2*x39 + 2*x40 + 2*x41 + 2*x42 - x43/x22
    x45 = x30*x5 + x33*x5 + x36*x5 + x38*(x19 + 2*x9) + x44*x8
    x46 = 2*x2
    x47 = p1*x8 - p2*x16 + p3*x13
    x48 = p1*x7
    x49 = p3*x7
    x50 = p2*x7
    x51 = -x50
    x52 = x43/x7
    x53 = x2*x44 + x29*(x10*x47 + x11*x46) + x32*(x13*x47 + x14*x46 + x49) + x35*(x16*x47 + x17*x46 + x51) + x38*(x46*x5 + x47*x8 + x48) - x46*x52
    x54 = x38*x8
    x55 = x18 + x9
    x56 = x10*x44 + x11*x33 + x11*x36 + x11*x54 + x29*(2*x12 + x15 + x55)
    x57 = 2*x6
    x58 = p1*x10 + p2*x13 + p3*x16
    x59 = x29*(x10*x58 + x11*x57 + x48) + x32*(x13*x58 + x14*x57 + x50) + x35*(x16*x58 + x17*x57 + x49) + x38*(x5*x57 + x58*x8) + x44*x6 - x52*x57
    x60 = x13*x44 + x14*x30 + x14*x36 + x14*x54 + x32*(x12 + 2*x15 + x55)
    x61 = 2*x3
    x62 = -p1*x13 + p2*x10 + p3*x8
    x63 = -x48
    x64 = x29*(x10*x62 + x11*x61 + x50) + x3*x44 + x32*(x13*x62 + x14*x61 + x63) + x35*(x16*x62 + x17*x61) + x38*(x49 + x5*x61 + x62*x8) - x52*x61
    x65 = x16*x44 + x17*x30 + x17*x33 + x17*x54 + x35*(x12 + x15 + 2*x18 + x9)
    x66 = 2*x4
    x67 = -p1*x16 - p2*x8 + p3*x10
    x68 = x29*(x10*x67 + x11*x66 + x49) + x32*(x13*x67 + x14*x66) + x35*(x16*x67 + x17*x66 + x63) + x38*(x5*x66 + x51 + x67*x8) + x4*x44 - x52*x66
    d0 = -x21*x23
    d1 = -x23*x24
    d2 = -x23*x25
    d3 = -x23*x26
    d4 = x21*x27
    d5 = x24*x27
    d6 = x25*x27
    d7 = x26*x27
    d8 = -x0*x53 + x1*x45
    d9 = -x0*x59 + x1*x56
    d10 = -x0*x64 + x1*x60
    d11 = -x0*x68 + x1*x65
    d12 = -x0*x45 - x1*x53
    d13 = -x0*x56 - x1*x59
    d14 = -x0*x60 - x1*x64
    d15 = -x0*x65 - x1*x68
    clock = sqrt(2)*sqrt(x22)*x7
    return d0, d1, d2, d3, d4, d5, d6, d7, d8, d9, d10, d11, d12, d13, d14, d15, clock


def element_switching(A0, A1, A2, A3, B0, B1, B2, B3, a0, a1, a2, a3, b0, b1, b2, b3, varphi):
    """n in inertial axes."""
    x0 = cos(varphi)
    x1 = sin(varphi)
    x2 = A0*x0 + B0*x1
    x3 = A1*x0 + B1*x1
    x4 = A2*x0 + B2*x1
    x5 = A3*x0 + B3*x1
    x6 = (x2*x2) + (x3*x3) + (x4*x4) + (x5*x5)
    x7 = x2*x6
    x8 = -A0*x1 + B0*x0
    x9 = -A1*x1 + B1*x0
    x10 = -A2*x1 + B2*x0
    x11 = -A3*x1 + B3*x0
    x12 = -x10*x4 - x11*x5 + x2*x8 + x3*x9
    x13 = (A0*A0) + (A1*A1) + (A2*A2) + (A3*A3) + (B0*B0) + (B1*B1) + (B2*B2) + (B3*B3)
    x14 = x13*(-a0*x1 + b0*x0)
    x15 = x3*x6
    x16 = x13*(-a1*x1 + b1*x0)
    x17 = x4*x6
    x18 = x13*(-a2*x1 + b2*x0)
    x19 = x5*x6
    x20 = -x19
    x21 = x13*(-a3*x1 + b3*x0)
    x22 = (1/2)*sqrt(2)/(sqrt(x13)*x6)
    x23 = x10*x3 - x11*x2 + x4*x9 - x5*x8
    x24 = x10*x2 + x11*x3 + x4*x8 + x5*x9
    n0 = x22*(x14*(x12*x8 + x7) + x16*(x12*x9 + x15) + x18*(x10*x12 - x17) + x21*(x11*x12 + x20))
    n1 = x22*(x14*(x20 + x23*x8) + x16*(x17 + x23*x9) + x18*(x10*x23 + x15) + x21*(x11*x23 - x7))
    n2 = x22*(x14*(x17 + x24*x8) + x16*(x19 + x24*x9) + x18*(x10*x24 + x7) + x21*(x11*x24 + x15))
    return n0, n1, n2


def element_phase(A0, A1, A2, A3, B0, B1, B2, B3, a0, a1, a2, a3, b0, b1, b2, b3, varphi):
    """kappa over dt/dphi."""
    x0 = cos(varphi)
    x1 = sin(varphi)
    x2 = A0*x0 + B0*x1
    x3 = A1*x0 + B1*x1
    x4 = A2*x0 + B2*x1
    x5 = A3*x0 + B3*x1
    value = (1/2)*sqrt(2)*(-x2*(-a0*x1 + b0*x0) - x3*(-a1*x1 + b1*x0) - x4*(-a2*x1 + b2*x0) - x5*(-a3*x1 + b3*x0) + (-A0*x1 + B0*x0)*(a0*x0 + b0*x1) + (-A1*x1 + B1*x0)*(a1*x0 + b1*x1) + (-A2*x1 + B2*x0)*(a2*x0 + b2*x1) + (-A3*x1 + B3*x0)*(a3*x0 + b3*x1))/(((x2*x2) + (x3*x3) + (x4*x4) + (x5*x5))*sqrt((A0*A0) + (A1*A1) + (A2*A2) + (A3*A3) + (B0*B0) + (B1*B1) + (B2*B2) + (B3*B3)))
    return value


def element_place(A0, A1, A2, A3, B0, B1, B2, B3, varphi):
    """R, V."""
    x6 = cos(varphi)
    x7 = sin(varphi)
    x8 = A2*x6 + B2*x7
    x9 = (x8*x8)
    x10 = A3*x6 + B3*x7
    x11 = (x10*x10)
    x12 = A0*x6 + B0*x7
    x13 = A1*x6 + B1*x7
    x14 = (x12*x12) + (x13*x13)
    x15 = 2*x12
    x16 = 2*x13
    x17 = -A0*x7 + B0*x6
    x18 = -A1*x7 + B1*x6
    x19 = -A2*x7 + B2*x6
    x20 = 2*x8
    x21 = -A3*x7 + B3*x6
    x22 = 2*x10
    x23 = (1/2)*sqrt(2)/((x11 + x14 + x9)*sqrt((A0*A0) + (A1*A1) + (A2*A2) + (A3*A3) + (B0*B0) + (B1*B1) + (B2*B2) + (B3*B3)))
    x0 = -x11 + x14 - x9
    x1 = -x10*x15 + 2*x13*x8
    x2 = x10*x16 + x15*x8
    x3 = x23*(x15*x17 + x16*x18 - x19*x20 - x21*x22)
    x4 = x23*(2*x13*x19 - x15*x21 - x17*x22 + 2*x18*x8)
    x5 = x23*(x15*x19 + x16*x21 + x17*x20 + x18*x22)
    return x0, x1, x2, x3, x4, x5


def oscillation_ahead(x, y, z, u, v, w):
    """u and w of R and V, fM = 1; R may not lie along -i1."""
    x0 = (x*x) + (y*y) + (z*z)
    x1 = x0**(1/4)
    x2 = 1/sqrt(x0)
    x3 = x*x2
    x4 = x3 + 1
    x5 = 1/sqrt(2*x3 + 2)
    x6 = x1*x4*x5
    x7 = x5/x1
    x8 = x7*z
    x9 = x7*y
    x10 = (1/2)*v
    x11 = (1/2)*w
    x12 = (1/2)*x6
    x13 = sqrt(2)*sqrt(-1/((1/2)*(u*u) + (1/2)*(v*v) + (1/2)*(w*w) - x2))
    x14 = (1/2)*u
    u0 = x6
    u1 = 0
    u2 = x8
    u3 = -x9
    w0 = x13*(u*x12 + x10*x9 + x11*x8)
    w1 = x13*(x10*x8 - x11*x9)
    w2 = x13*((1/2)*w*x1*x4*x5 - x14*x8)
    w3 = x13*(-v*x12 + x14*x9)
    return u0, u1, u2, u3, w0, w1, w2, w3


def oscillation_behind(x, y, z, u, v, w):
    """u and w of R and V, fM = 1; R may not lie along +i1."""
    x0 = (x*x) + (y*y) + (z*z)
    x1 = 1/sqrt(x0)
    x2 = x*x1
    x3 = 1/sqrt(2 - 2*x2)
    x4 = x0**(1/4)
    x5 = 1/x4
    x6 = x3*x5
    x7 = x6*z
    x8 = x6*y
    x9 = x3*x4*(1 - x2)
    x10 = (1/2)*u
    x11 = (1/2)*x9
    x12 = sqrt(2)*sqrt(-1/((1/2)*(u*u) + (1/2)*(v*v) + (1/2)*(w*w) - x1))
    x13 = (1/2)*x7
    u0 = x7
    u1 = x8
    u2 = x9
    u3 = 0
    w0 = x12*(w*x11 + x10*x7)
    w1 = x12*(v*x11 + x10*x8)
    w2 = x12*((1/2)*v*x8 + w*x13 - x10*x9)
    w3 = x12*(-v*x13 + (1/2)*w*x3*x5*y)
    return u0, u1, u2, u3, w0, w1, w2, w3


def equinoctial_place(p, f, g, h, k, L):
    """R, V of equinoctial elements, fM = 1."""
    x6 = sin(L)
    x7 = (k*k)
    x8 = (h*h)
    x9 = x8 + 1
    x10 = 1/(x7 + x9)
    x11 = 2*x10
    x12 = k*x11
    x13 = h*x12
    x14 = cos(L)
    x15 = x10*(-x7 + x9)
    x16 = p/(f*x14 + g*x6 + 1)
    x17 = x12*x14
    x18 = x10*(x7 - x8 + 1)
    x19 = h*x11
    x20 = 1/sqrt(p)
    x21 = f + x14
    x22 = -g - x6
    x23 = x12*x22
    x0 = x16*(x13*x6 + x14*x15)
    x1 = x16*(h*x17 + x18*x6)
    x2 = x16*(-x17 + x19*x6)
    x3 = x20*(x13*x21 + x15*x22)
    x4 = x20*(h*x23 + x18*x21)
    x5 = x20*(x19*x21 - x23)
    return x0, x1, x2, x3, x4, x5


def equinoctial_switching(p, f, g, h, k, L, l_p, l_f, l_g, l_h, l_k, l_L):
    """n in radial, transverse and normal components."""
    x0 = sin(L)
    x1 = sqrt(p)
    x2 = l_f*x1
    x3 = cos(L)
    x4 = l_g*x1
    x5 = f*x3 + g*x0 + 1
    x6 = 1/x5
    x7 = x2*x6
    x8 = x4*x6
    x9 = h*x0 - k*x3
    x10 = x1*x6
    x11 = (1/2)*x10*((h*h) + (k*k) + 1)
    n0 = x0*x2 - x3*x4
    n1 = 2*l_p*p**(3/2)*x6 + x7*(f + x3*x5 + x3) + x8*(g + x0*x5 + x0)
    n2 = f*x8*x9 - g*x7*x9 + l_L*x10*x9 + l_h*x11*x3 + l_k*x0*x11
    return n0, n1, n2


def equinoctial_weight(p, f, g, L):
    """dt/ds."""
    weight = p**(3/2)/((f*cos(L) + g*sin(L) + 1)*(f*cos(L) + g*sin(L) + 1))
    return weight


SWITCHING_SLOPES = ((0, 0), (0, 5), (0, 7), (0, 8), (1, 0), (1, 1), (1, 2), (1, 5), (1, 6), (1, 7), (1, 8), (2, 0), (2, 1), (2, 2), (2, 3), (2, 4), (2, 5), (2, 7), (2, 8), (2, 9), (2, 10), (2, 11))
"""Component and variable of each slope of n."""


def equinoctial_switching_slopes(p, f, g, h, k, L, l_p, l_f, l_g, l_h, l_k, l_L):
    """n and its slopes in elements and costates that do not vanish."""
    x0 = sin(L)
    x1 = sqrt(p)
    x2 = x0*x1
    x3 = l_f*x2
    x4 = cos(L)
    x5 = x1*x4
    x6 = l_g*x5
    x7 = f*x4
    x8 = g*x0
    x9 = x7 + x8 + 1
    x10 = 1/x9
    x11 = 2*p**(3/2)
    x12 = x10*x11
    x13 = x4*x9 + x4
    x14 = f + x13
    x15 = x1*x10
    x16 = x14*x15
    x17 = x0*x9 + x0
    x18 = g + x17
    x19 = x15*x18
    x20 = h*x0
    x21 = k*x4
    x22 = x20 - x21
    x23 = x15*x22
    x24 = x10*x5
    x25 = l_h*x24
    x26 = (h*h) + (k*k) + 1
    x27 = (1/2)*x26
    x28 = x10*x2
    x29 = l_k*x28
    x30 = l_f*x23
    x31 = 1/x1
    x32 = (1/2)*x31
    x33 = l_f*x32
    x34 = l_g*x32
    x35 = l_f*x5
    x36 = l_g*x2
    x37 = x10*x33
    x38 = x10*x34
    x39 = 1/(x9*x9)
    x40 = x39*x4
    x41 = l_p*x11
    x42 = (x4*x4)
    x43 = x14*x39
    x44 = x18*x39
    x45 = x39*x41
    x46 = (x0*x0)
    x47 = f*x0 - g*x4
    x48 = x1*x47
    x49 = l_f*x48
    x50 = l_g*x48
    x51 = -x47
    x52 = l_g*x15
    x53 = l_f*x15
    x54 = l_L*x10
    x55 = (1/4)*x26*x31
    x56 = x22*x39
    x57 = l_L*x56
    x58 = l_h*x27
    x59 = x1*x39
    x60 = l_k*x27
    x61 = x2*x40
    x62 = f*x36
    x63 = h*x4 + k*x0
    x64 = x27*x28
    x65 = x24*x27
    x66 = x39*x47
    n0 = x3 - x6
    n1 = l_f*x16 + l_g*x19 + l_p*x12
    n2 = f*l_g*x23 - g*x30 + l_L*x23 + x25*x27 + x27*x29
    s0 = x0*x33 - x34*x4
    s1 = x35 + x36
    s2 = x2
    s3 = -x5
    s4 = 3*l_p*x15 + x14*x37 + x18*x38
    s5 = l_f*x1*x10*(x42 + 1) + l_g*x0*x1*x10*x4 - x35*x43 - x40*x41 - x44*x6
    s6 = l_f*x0*x1*x10*x4 + l_g*x1*x10*(x46 + 1) - x0*x45 - x3*x43 - x36*x44
    s7 = x43*x49 + x44*x50 + x45*x47 + x52*(x0*x51 + x13) + x53*(-x17 + x4*x51)
    s8 = x12
    s9 = x16
    s10 = x19
    s11 = f*x22*x38 - g*x22*x37 + l_h*x10*x4*x55 + l_k*x0*x10*x55 + x22*x32*x54
    s12 = g*l_f*x1*x22*x39*x4 + l_g*x1*x10*x22 - l_g*x1*x56*x7 - x42*x58*x59 - x5*x57 - x60*x61
    s13 = g*l_f*x0*x1*x22*x39 - x2*x57 - x30 - x46*x59*x60 - x56*x62 - x58*x61
    s14 = h*x25 + l_k*x15*x20 + x10*x62 + x2*x54 - x53*x8
    s15 = g*x10*x35 + k*x29 + l_h*x15*x21 - x5*x54 - x52*x7
    s16 = f*x50*x56 + f*x52*x63 - g*x49*x56 - g*x53*x63 + l_L*x15*x63 - l_h*x64 + l_k*x65 + x2*x60*x66 + x48*x57 + x5*x58*x66
    s17 = -g*x23
    s18 = f*x23
    s19 = x65
    s20 = x64
    s21 = x23
    return n0, n1, n2, s0, s1, s2, s3, s4, s5, s6, s7, s8, s9, s10, s11, s12, s13, s14, s15, s16, s17, s18, s19, s20, s21


SWITCHING_CURVATURES = ((0, 0), (0, 1), (0, 2), (0, 3), (0, 4), (0, 5), (0, 6), (0, 7), (0, 8), (0, 9), (0, 10), (0, 11), (1, 1), (1, 2), (1, 3), (1, 4), (1, 5), (1, 6), (1, 7), (1, 8), (1, 9), (1, 10), (1, 11), (2, 2), (2, 3), (2, 4), (2, 5), (2, 6), (2, 7), (2, 8), (2, 9), (2, 10), (2, 11), (3, 3), (3, 5), (3, 7), (3, 8), (3, 9), (3, 10), (3, 11), (4, 4), (4, 5), (4, 7), (4, 8), (4, 9), (4, 10), (4, 11), (5, 5), (5, 6), (5, 7), (5, 8), (5, 9), (5, 10), (5, 11))
"""Both variables of each second derivative of n."""


def equinoctial_switching_curvatures(p, f, g, h, k, L, l_p, l_f, l_g, l_h, l_k, l_L, m0, m1, m2):
    """Second derivatives of (m, n) in elements and costates that do not vanish."""
    x0 = p**(3/2)
    x1 = 1/x0
    x2 = (1/4)*x1
    x3 = sin(L)
    x4 = l_f*x3
    x5 = cos(L)
    x6 = sqrt(p)
    x7 = 1/x6
    x8 = f*x5
    x9 = g*x3
    x10 = x8 + x9
    x11 = x10 + 1
    x12 = 1/x11
    x13 = x12*x2
    x14 = x11*x5 + x5
    x15 = f + x14
    x16 = l_f*x15
    x17 = x11*x3
    x18 = x17 + x3
    x19 = g + x18
    x20 = l_g*x19
    x21 = h*x3
    x22 = k*x5
    x23 = x21 - x22
    x24 = l_L*x23
    x25 = (h*h) + (k*k) + 1
    x26 = l_h*x25
    x27 = x26*x5
    x28 = (1/8)*x1*x12
    x29 = l_k*x25
    x30 = x29*x3
    x31 = f*l_g
    x32 = 1/(x11*x11)
    x33 = x5*x6
    x34 = x32*x33
    x35 = 3*l_p
    x36 = (x5*x5)
    x37 = x36 + 1
    x38 = (1/2)*x7
    x39 = l_f*x5
    x40 = x38*x39
    x41 = x15*x32
    x42 = l_g*x5
    x43 = x19*x32
    x44 = x38*x5
    x45 = x24*x32
    x46 = (1/4)*x26
    x47 = x32*x7
    x48 = (1/4)*x47
    x49 = x30*x48
    x50 = l_g*x8
    x51 = x23*x32*x38
    x52 = x3*x6
    x53 = x32*x52
    x54 = (x3*x3)
    x55 = x54 + 1
    x56 = x3*x38
    x57 = l_g*x56
    x58 = x12*x7
    x59 = (1/2)*x58
    x60 = l_f*x59
    x61 = (1/4)*x29
    x62 = x27*x48
    x63 = f*x3
    x64 = l_g*x63
    x65 = l_L*x59
    x66 = l_g*x59
    x67 = h*x5
    x68 = l_h*x59
    x69 = l_k*x59
    x70 = g*x5
    x71 = k*x3
    x72 = -g*x5 + x63
    x73 = x32*x6
    x74 = x72*x73
    x75 = x38*x72
    x76 = x32*x75
    x77 = -x72
    x78 = x3*x77
    x79 = x14 + x78
    x80 = -x18 + x5*x77
    x81 = x67 + x71
    x82 = x3*x58
    x83 = x5*x58
    x84 = x23*x76
    x85 = g*l_f
    x86 = x12*x6
    x87 = m2*x23
    x88 = x59*x87
    x89 = m1*x59
    x90 = (1/4)*m2*x25
    x91 = 1/(x11*x11*x11)
    x92 = x36*x91
    x93 = l_p*x0
    x94 = 4*x93
    x95 = l_g*x53
    x96 = 2*x95
    x97 = 2*x16
    x98 = x6*x92
    x99 = 2*x98
    x100 = x6*x91
    x101 = l_g*x33
    x102 = x101*x32
    x103 = 2*x23
    x104 = x52*x92
    x105 = x23*x99
    x106 = l_f*x52
    x107 = x106*x32
    x108 = l_f*x34
    x109 = x33*x91
    x110 = x109*x54
    x111 = l_f*x9
    x112 = x36*x73
    x113 = l_h*x112
    x114 = x21*x34
    x115 = l_L*x34
    x116 = -x108*x9 + x115*x3 + x8*x95
    x117 = l_k*x22
    x118 = l_g*x86
    x119 = x5*x86
    x120 = 2*x63 - 2*x70
    x121 = x120*x91
    x122 = 2*x121*x93
    x123 = x109*x120
    x124 = x73*x81
    x125 = (1/2)*x29
    x126 = x23*x73
    x127 = x126*x9
    x128 = (1/2)*x26
    x129 = x100*x120
    x130 = x129*x23
    x131 = 2*x32
    x132 = m1*x0*x131
    x133 = x73*x87
    x134 = x15*x34
    x135 = -x12*x3*x5*x6
    x136 = -x23*x86
    x137 = x126*x8
    x138 = (1/2)*x25
    x139 = m2*x138
    x140 = -x139*x3*x34
    x141 = 2*x54
    x142 = x100*x54
    x143 = x100*x141
    x144 = x100*x29
    x145 = x103*x142
    x146 = l_L*x73
    x147 = x54*x73
    x148 = l_k*x147
    x149 = l_h*x22
    x150 = x131*x93
    x151 = l_f*x86
    x152 = x121*x52
    x153 = x81*x86
    x154 = l_L*x53
    x155 = x23*x74
    x156 = x123*x128
    x157 = l_h*x119
    x158 = x3*x86
    x159 = l_k*x158
    x160 = m2*(x157 + x159)
    x161 = x67*x86
    x162 = x21*x86
    x163 = l_g*x74
    x164 = l_k*x74
    x165 = m2*x86
    x166 = x10*x73
    x167 = x129*x72
    x168 = 2*x74
    x169 = -x10
    x170 = -x23
    x171 = x10*x126
    x172 = x34*x72
    x173 = x168*x81
    x174 = x53*x72
    x175 = x167*x23
    c0 = m0*((1/4)*l_g*x1*x5 - x2*x4) + m1*((3/2)*l_p*x12*x7 - x13*x16 - x13*x20) + m2*((1/4)*g*l_f*x1*x12*x23 - x13*x23*x31 - x13*x24 - x27*x28 - x28*x30)
    c1 = m1*((1/2)*l_f*x12*x37*x7 + (1/2)*l_g*x12*x3*x5*x7 - x34*x35 - x38*x42*x43 - x40*x41) + m2*((1/2)*g*l_f*x23*x32*x5*x7 + (1/2)*l_g*x12*x23*x7 - x36*x46*x47 - x44*x45 - x49*x5 - x50*x51)
    c2 = m1*((1/2)*l_f*x12*x3*x5*x7 + (1/2)*l_g*x12*x55*x7 - x35*x53 - x38*x4*x41 - x43*x57) + m2*((1/2)*g*l_f*x23*x3*x32*x7 - x23*x60 - x3*x62 - x45*x56 - x47*x54*x61 - x51*x64)
    c3 = m2*(x21*x69 + x3*x65 - x60*x9 + x63*x66 + x67*x68)
    c4 = m2*(x22*x68 - x5*x65 + x60*x70 - x66*x8 + x69*x71)
    c5 = m0*(x40 + x57) + m1*(x16*x76 + x20*x76 + x35*x74 + x60*x80 + x66*x79) + m2*(f*x66*x81 - g*x60*x81 + x31*x84 + x45*x75 - x46*x82 + x49*x72 + x61*x83 + x62*x72 + x65*x81 - x84*x85)
    c6 = 3*m1*x86
    c7 = -g*x88 + m0*x56 + x15*x89
    c8 = f*x88 - m0*x44 + x19*x89
    c9 = x83*x90
    c10 = x82*x90
    c11 = x88
    c12 = m1*(-2*l_f*x34*x37 + x20*x99 - x36*x96 + x92*x94 + x97*x98) + m2*(x100*x26*(x5*x5*x5) - x102*x103 + x104*x29 + x105*x31 - x105*x85 + x24*x99)
    c13 = m1*(2*l_f*x15*x3*x5*x6*x91 + 2*l_g*x19*x3*x5*x6*x91 + 4*l_p*x0*x3*x5*x91 - x102*x54 - x102*x55 - x107*x36 - x107*x37) + m2*(-x103*x109*x111 + x103*x50*x52*x91 + x104*x26 + x108*x23 + 2*x109*x24*x3 + x110*x29 - x23*x95)
    c14 = m2*(-h*x113 + l_g*x12*x3*x6 - l_k*x114 - x116)
    c15 = m2*(f*l_g*x32*x36*x6 - k*x113 + l_L*x32*x36*x6 - x112*x85 - x117*x53 - x42*x86)
    c16 = m1*(l_f*x15*x3*x32*x6 + l_f*x32*x37*x6*x72 + l_g*x12*x36*x6 + l_g*x19*x3*x32*x6 + l_g*x3*x32*x5*x6*x72 + 2*l_p*x0*x3*x32 - x101*x121*x19 - x102*x79 - x108*x80 - x118*x54 - 2*x119*x4 - x122*x5 - x123*x16) + m2*(f*l_g*x23*x3*x32*x6 + g*l_f*x120*x23*x5*x6*x91 + g*l_f*x32*x5*x6*x81 + l_L*x23*x3*x32*x6 - l_f*x127 + l_g*x12*x6*x81 + l_g*x23*x32*x6*x72 + l_h*x25*x3*x32*x5*x6 + (1/2)*l_k*x25*x32*x54*x6 - x112*x125 - x115*x81 - x120*x128*x98 - x123*x24 - 1/2*x123*x30 - x124*x50 - x130*x50)
    c17 = -x132*x5
    c18 = m1*(-x134 + x37*x86) + x133*x70
    c19 = m1*(-x135 - x19*x34) + m2*(-x136 - x137)
    c20 = -x112*x139
    c21 = x140
    c22 = -x34*x87
    c23 = m1*(-x108*x141 + x142*x97 + x143*x20 + x54*x91*x94 - x55*x96) + m2*(x103*x107 + x110*x26 + x143*x24 + x144*(x3*x3*x3) + x145*x31 - x145*x85)
    c24 = m2*(g*l_f*x32*x54*x6 - h*x148 - l_h*x114 - x146*x54 - x147*x31 - x4*x86)
    c25 = m2*(-k*x148 + x116 - x149*x53 + x39*x86)
    c26 = m1*(l_f*x12*x36*x6 - l_f*x134 + l_f*x3*x32*x5*x6*x72 + 2*l_g*x12*x3*x5*x6 + l_g*x32*x55*x6*x72 - x102*x19 - x106*x121*x15 - x107*x80 - x122*x3 - x150*x5 - x151*x54 - x152*x20 - x79*x95) + m2*(g*l_f*x120*x23*x3*x6*x91 + g*l_f*x23*x32*x5*x6 + g*l_f*x3*x32*x6*x81 - l_f*x153 - l_f*x155 - l_g*x137 + (1/2)*l_h*x25*x32*x54*x6 - x112*x128 - 1/2*x120*x144*x54 - x124*x64 - x130*x64 - x152*x24 - x154*x81 - x156*x3 - x24*x34 - x30*x34)
    c27 = -x132*x3
    c28 = m1*(-x135 - x15*x53) + m2*(x127 + x136)
    c29 = m1*(-x19*x53 + x55*x86) - x133*x63
    c30 = x140
    c31 = -x139*x147
    c32 = -x53*x87
    c33 = x160
    c34 = m2*(l_L*x119 - l_h*x162 + l_h*x67*x74 + l_k*x161 - x111*x74 + x118*x8 - x151*x70 + x154*x72 + x163*x63 + x164*x21)
    c35 = -x165*x9
    c36 = x165*x63
    c37 = m2*x161
    c38 = m2*x162
    c39 = m2*x158
    c40 = x160
    c41 = m2*(l_L*x158 + l_f*x70*x74 - l_h*x71*x86 - x115*x72 + x117*x86 + x118*x63 + x149*x74 - x151*x9 - x163*x8 + x164*x71)
    c42 = x165*x70
    c43 = -x165*x8
    c44 = x165*x22
    c45 = x165*x71
    c46 = -m2*x119
    c47 = m0*(l_g*x5*x6 - x106) + m1*(l_f*x168*x80 + x10*x150 + x118*(x169*x3 - x17 - x3 + 2*x5*x77) + x122*x72 + x151*(-x14 + x169*x5 - 2*x78) + x16*x166 + x16*x167 + 2*x163*x79 + x166*x20 + x167*x20) + m2*(f*x118*x170 - g*x151*x170 + l_L*x170*x86 + x10*x125*x53 + x10*x128*x34 + x10*x146*x23 + x125*x152*x72 - x138*x157 - x138*x159 + 2*x146*x72*x81 + x156*x72 + x167*x24 + x171*x31 - x171*x85 + x172*x29 + x173*x31 - x173*x85 - x174*x26 + x175*x31 - x175*x85)
    c48 = x132*x72
    c49 = m0*x33 + m1*(x15*x74 + x80*x86) + m2*(-g*x153 - g*x155)
    c50 = m0*x52 + m1*(x19*x74 + x79*x86) + m2*(f*x153 + f*x155)
    c51 = m2*(-x138*x158 + x138*x172)
    c52 = m2*(x119*x138 + x138*x174)
    c53 = m2*(x153 + x155)
    return c0, c1, c2, c3, c4, c5, c6, c7, c8, c9, c10, c11, c12, c13, c14, c15, c16, c17, c18, c19, c20, c21, c22, c23, c24, c25, c26, c27, c28, c29, c30, c31, c32, c33, c34, c35, c36, c37, c38, c39, c40, c41, c42, c43, c44, c45, c46, c47, c48, c49, c50, c51, c52, c53


WEIGHT_SLOPES, WEIGHT_CURVATURES = (0, 1, 2, 5), ((0, 0), (0, 1), (0, 2), (0, 5), (1, 1), (1, 2), (1, 5), (2, 2), (2, 5), (5, 5))
"""The variables of the derivatives of dt/ds."""


def equinoctial_weight_slopes(p, f, g, L):
    """dt/ds with its first and second derivatives that do not vanish."""
    x0 = p**(3/2)
    x1 = cos(L)
    x2 = f*x1
    x3 = sin(L)
    x4 = g*x3
    x5 = x2 + x4 + 1
    x6 = 1/(x5*x5)
    x7 = sqrt(p)
    x8 = (3/2)*x7
    x9 = 1/(x5*x5*x5)
    x10 = x0*x9
    x11 = 2*x10
    x12 = x1*x11
    x13 = -x11*x3
    x14 = f*x3
    x15 = g*x1
    x16 = 2*x14 - 2*x15
    x17 = 3*x7*x9
    x18 = x0/(x5*x5*x5*x5)
    x19 = 6*x18
    x20 = x18*(3*x14 - 3*x15)
    x21 = 2*x20
    weight = x0*x6
    s0 = x6*x8
    s1 = -x12
    s2 = x13
    s3 = x10*x16
    c0 = (3/4)*x6/x7
    c1 = -x1*x17
    c2 = -x17*x3
    c3 = x16*x8*x9
    c4 = (x1*x1)*x19
    c5 = x1*x19*x3
    c6 = -x1*x21 - x13
    c7 = x19*(x3*x3)
    c8 = -x12 - x21*x3
    c9 = x10*(2*x2 + 2*x4) + x16*x20
    return weight, s0, s1, s2, s3, c0, c1, c2, c3, c4, c5, c6, c7, c8, c9
