"""Independent references for the tests: SciPy's integrators, HiGHS, roots of exact polynomials."""

from fractions import Fraction
from itertools import pairwise

import mpmath as mp
import numpy as np
from scipy.integrate import quad, solve_ivp
from scipy.optimize import linprog


def force_of(maneuver):
    """The disturbance of a manoeuvre as a function of time."""
    f = maneuver.disturbance
    if f is None:
        return lambda t: 0.0
    return f if callable(f) else lambda t: float(f)


def propagate(maneuver, control, breakpoints=(), impulses=()):
    """Final state of x1' = x2, x2' = x3 + f, x3' = u by SciPy, restarted at breakpoints and impulses of u.

    Returns the state and the largest modulus that any coordinate took.
    """
    start, end = float(maneuver.t0), float(maneuver.tf)
    jumps = dict(impulses)
    force = force_of(maneuver)
    x = np.array(maneuver.x0, dtype=float)
    x[2] += jumps.get(start, 0.0)
    largest = np.abs(x)
    edges = [start, *sorted({*map(float, breakpoints), *(t for t in jumps if start < t < end)}), end]
    for low, high in pairwise(edges):
        last = np.nextafter(high, low)

        def rate(t, x, last=last):
            return [x[1], x[2] + force(t), control(min(t, last))]

        run = solve_ivp(rate, (low, high), x, method="DOP853", rtol=1e-12, atol=1e-13)
        largest = np.maximum(largest, np.abs(run.y).max(axis=1))
        x = run.y[:, -1].copy()
        x[2] += jumps.get(high, 0.0)
    return x, np.maximum(largest, np.abs(x))


def pieces(solution):
    """Ends of the intervals on which the control of a solution is smooth."""
    m = solution.maneuver
    return pairwise([float(m.t0), *solution.breakpoints, float(m.tf)])


def integral(solution, weight):
    """Integral of weight(t, u(t)) over the manoeuvre of a solution, by QUADPACK."""
    return sum(
        quad(lambda t: weight(t, solution.control([t])[0]), a, b, epsabs=1e-13, epsrel=1e-12, limit=400)[0]
        for a, b in pieces(solution)
    )


def moments_of(solution):
    """Integrals of u times (tf - t)^2/2, tf - t and 1, by QUADPACK."""
    tf = float(solution.maneuver.tf)
    return np.array([integral(solution, lambda t, u, j=j: u * (tf - t) ** j / max(j, 1)) for j in (2, 1, 0)])


def bang_bang_moments(level, a, b):
    """Moments (T = 1) of the control that is -level while the time to go is in [b, a], level otherwise."""
    return level * np.array([(1 - 2 * (a**3 - b**3)) / 6, (1 - 2 * (a**2 - b**2)) / 2, 1 - 2 * (a - b)])


def response(s):
    """The impulse response h(s) = (s^2/2, s, 1), (..., 3)."""
    s = np.asarray(s, dtype=float)
    return np.stack([s**2 / 2, s, np.ones_like(s)], axis=-1)


def least_scale(factors, target, normals):
    """The least s for which w_k with normals w_k <= s have the sum of G_k w_k = target, by HiGHS.

    Parameters
    ----------
    factors : (steps, n, width) array
        The matrices G_k.
    target : (n,) array
        The sum to reach.
    normals : (sides, width) array
        Normals of a polytope {w: normals w <= 1}.
    """
    steps, n, width = factors.shape
    within = np.kron(np.eye(steps), normals)
    answer = linprog(
        np.r_[np.zeros(steps * width), 1],
        A_ub=np.c_[within, -np.ones(len(within))],
        b_ub=np.zeros(len(within)),
        A_eq=np.c_[np.moveaxis(factors, 0, 1).reshape(n, -1), np.zeros(n)],
        b_eq=target,
        bounds=[*[(None, None)] * (steps * width), (0, None)],
    )
    assert answer.success
    return answer.fun


def cube(n):
    """Normals of the cube |w_i| <= 1."""
    return np.vstack([np.eye(n), -np.eye(n)])


def grid_peak(c, duration=1.0, cells=160):
    """The least peak of controls that are constant on the cells of a grid of [0, T]."""
    edges = np.linspace(0, duration, cells + 1)
    moments = np.diff([edges**3 / 6, edges**2 / 2, edges], axis=1)
    return least_scale(moments.T[:, :, None], c, cube(1))


def grid_impulse(c, duration=1.0, cells=160):
    """The least total impulse at the instants of a grid of [0, T]."""
    h = response(np.linspace(0, duration, cells + 1)).T
    return linprog(np.ones(2 * cells + 2), A_eq=np.c_[h, -h], b_eq=c, bounds=(0, None)).fun


def peak_bracket(c, duration, cells=160):
    """Lower and upper bound on the least peak, by two linear programmes on a grid of [0, T].

    The upper bound is the best control that is constant on each cell. The lower bound is the best dual
    function h; the integral of |h| is at most that of the interpolated |h| plus |h''| step^2 / 8.
    """
    step = duration / cells
    h = response(np.linspace(0, duration, cells + 1))
    weights = np.r_[step / 2, np.full(cells - 1, step), step / 2]
    below = linprog(
        np.r_[-np.asarray(c, dtype=float), np.zeros(cells + 2)],
        A_ub=np.vstack(
            [
                np.c_[h, -np.eye(cells + 1), np.zeros(cells + 1)],
                np.c_[-h, -np.eye(cells + 1), np.zeros(cells + 1)],
                [[1, 0, 0, *np.zeros(cells + 1), -1], [-1, 0, 0, *np.zeros(cells + 1), -1]],
                [[0, 0, 0, *weights, duration * step**2 / 8]],
            ]
        ),
        b_ub=np.r_[np.zeros(2 * cells + 4), 1],
        bounds=(None, None),
    )
    return -below.fun, grid_peak(c, duration, cells)


def impulse_bracket(c, duration, cells=160):
    """Lower and upper bound on the least total impulse, by two linear programmes on a grid of [0, T].

    The upper bound has impulses on the grid. The lower bound is the best dual function h with |h| at most
    1 - |h''| step^2 / 8 on the grid.
    """
    h = response(np.linspace(0, duration, cells + 1))
    slack = np.full((cells + 1, 1), (duration / cells) ** 2 / 8)
    below = linprog(
        np.r_[-np.asarray(c, dtype=float), 0],
        A_ub=np.vstack([np.c_[h, slack], np.c_[-h, slack], [[1, 0, 0, -1], [-1, 0, 0, -1]]]),
        b_ub=np.r_[np.ones(2 * cells + 2), 0, 0],
        bounds=(None, None),
    )
    return -below.fun, grid_impulse(c, duration, cells)


def exactly(number):
    """A float as an mpmath number, without rounding."""
    ratio = Fraction(float(number))
    return mp.mpf(ratio.numerator) / ratio.denominator


def exact_peak(c, digits=60):
    """Least peak for T = 1: the largest |v| of the real roots of a quartic P(v) that no paper prints."""
    with mp.workdps(digits):
        c1, c2, c3 = map(exactly, c)
        quartic = [
            mp.mpf(3),
            48 * c2 - 96 * c1 - 12 * c3,
            96 * c1 * c3 - 48 * c2**2 - 6 * c3**2,
            4 * c3**3,
            -(c3**4),
        ]
        while quartic[-1] == 0 and len(quartic) > 1:
            quartic.pop()
        roots = mp.polyroots(quartic, maxsteps=1000, extraprec=800) if len(quartic) > 1 else []
        real = [abs(mp.re(r)) for r in roots if abs(mp.im(r)) <= mp.mpf(10) ** (-digits // 3) * abs(r)]
        return max(real, default=mp.mpf(0))


def exact_bang_bang_times(x0, xf, peak, force=0.0, digits=60):
    """Durations T of all controls |u| = peak with at most two switches that steer x0 to xf.

    They are roots of the quartic 16 v^2 p1 p3 - 12 v^2 p2^2 - p3^4 = 0 for either sign of v, with exact
    coefficients. Returns pairs (violation, T); the violation is the amount by which the switches leave
    [0, T], and zero or less is admissible.
    """
    with mp.workdps(digits):
        start, end = [exactly(x) for x in x0], [exactly(x) for x in xf]
        k = start[2] + exactly(force)
        dx, dv, c3 = end[0] - start[0], end[1] - start[1], end[2] - start[2]
        found = []
        for v in (exactly(peak), -exactly(peak)):
            p1, p2, p3 = [v, 3 * k, 6 * start[1], -6 * dx], [v, 2 * k, -2 * dv], [v, -c3]
            square = product(p3, p3)
            parts = (
                [16 * v * v * x for x in product(p1, p3)],
                [-12 * v * v * x for x in product(p2, p2)],
                [-x for x in product(square, square)],
            )
            quartic = [sum(column) for column in zip(*parts, strict=True)]
            while quartic[-1] == 0:
                quartic.pop()
            for root in mp.polyroots(quartic, maxsteps=2000, extraprec=800) if len(quartic) > 1 else []:
                T = mp.re(root)
                if abs(mp.im(root)) > mp.mpf(10) ** (-digits // 3) * abs(root) or T <= 0:
                    continue
                difference = v * T - c3
                d = difference / (2 * v * T)
                if abs(d) < mp.mpf(10) ** (-digits // 3):
                    c1, c2 = dx - start[1] * T - k * T**2 / 2, dv - k * T
                    found.append((max(abs(v * T**2 - 2 * c2), abs(v * T**3 - 6 * c1)), T))
                    continue
                m = (v * T - 2 * (dv - k * T) / T) / difference
                found.append((max((d - m) / 2, (m + d) / 2 - 1, -d), T))
        return found


def product(p, q):
    """Coefficients of the product of two polynomials."""
    result = [mp.mpf(0)] * (len(p) + len(q) - 1)
    for i, x in enumerate(p):
        for j, y in enumerate(q):
            result[i + j] += x * y
    return result


def exact_moments(x0, xf, T):
    """The moments c in extended precision, from ends given as floats."""
    a, b, T = [exactly(x) for x in x0], [exactly(x) for x in xf], exactly(T)
    return [b[0] - a[0] - T * a[1] - T * T * a[2] / 2, b[1] - a[1] - T * a[2], b[2] - a[2]]


def exact_energy(c, T):
    """sqrt(c' D^-1 c) with D of (2.1), by solving for T = 1 in fifty digits."""
    powers = [2, 1, 0]
    scale = [mp.mpf(1) / 2, 1, 1]
    D = mp.matrix(3, 3)
    for i in range(3):
        for j in range(3):
            D[i, j] = scale[i] * scale[j] / (powers[i] + powers[j] + 1)
    shares = mp.matrix([c[0] / T**2, c[1] / T, c[2]])
    return mp.sqrt((shares.T * mp.lu_solve(D, shares))[0] / T)


def exact_impulse(c, T):
    """Largest p.mu over the extreme quadratics, from the closed form of the theory, in fifty digits."""
    m = [c[2], c[1] / T, 2 * c[0] / T**2]

    def one_side(m0, m1, m2):
        bounds = [abs(m0 - 4 * m1 + 2 * m2), abs(m0 - 8 * m1 + 8 * m2)]
        if m2 != 0 and 1 < m1 / m2 < 2:
            bounds.append(abs(m0 - 2 * m1**2 / m2))
        return max(bounds)

    return max(abs(m[0]), one_side(*m), one_side(m[0], m[0] - m[1], m[0] - 2 * m[1] + m[2]))


def exact_peak_of(c, T):
    """The least peak for any T, from the roots of the quartic after scaling to T = 1."""
    scaled = [c[0] / T**3, c[1] / T**2, c[2] / T]
    size = max(map(abs, scaled))
    return size * exact_peak([x / size for x in scaled]) if size else mp.mpf(0)
