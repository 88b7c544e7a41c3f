"""Hypothesis strategies: numbers of every size, manoeuvres, moments of every structure, bodies."""

import numpy as np
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from independent import bang_bang_moments
from pontryagin.orbit_correction import DiscreteSystem
from pontryagin.triple_integrator import Maneuver
from pontryagin.triple_integrator.attitude import RigidBody

shares = st.floats(0, 1, allow_subnormal=False).map(lambda x: round(x, 6))
signs = st.sampled_from([-1.0, 1.0])
angles = st.floats(-4, 4, allow_subnormal=False).map(lambda x: round(x, 4))
multipliers = st.tuples(angles, angles, angles).map(np.array)


@st.composite
def wide(draw, decades=3):
    """Zero, or a number of either sign between 10**-decades and 10**decades."""
    if draw(st.integers(0, 9)) == 0:
        return 0.0
    return draw(signs) * draw(st.floats(1, 10)) * 10.0 ** draw(st.integers(-decades, decades - 1))


def states(coordinate=angles):
    """A state (3,)."""
    return st.tuples(coordinate, coordinate, coordinate).map(np.array)


@st.composite
def maneuvers(draw, coordinate=angles):
    """One manoeuvre between arbitrary ends, from any start, with a constant force or none."""
    start = draw(st.sampled_from([0.0, -1.5, 2.25]))
    duration = draw(st.floats(0.3, 3.0))
    force = draw(st.one_of(st.none(), angles))
    return Maneuver(
        draw(states(coordinate)), draw(states(coordinate)), start + duration, t0=start, disturbance=force
    )


@st.composite
def places(draw):
    """Switches a >= b as fractions of T, counted back from the end: apart, close, at the ends, or none."""
    kind = draw(st.sampled_from(["apart", "narrow", "first only", "last only", "none", "ends"]))
    width = 10.0 ** -draw(st.floats(1, 8))
    at = draw(st.floats(0.0, 1.0))
    if kind == "apart":
        other = draw(shares)
        return max(at, other), min(at, other)
    return {
        "narrow": (at * (1 - width) + width, at * (1 - width)),
        "first only": (at, 0.0),
        "last only": (1.0, at),
        "none": (0.0, 0.0),
        "ends": (1 - width * at, width * (1 - at)),
    }[kind]


@st.composite
def moments(draw):
    """Moments (c1, c2, c3) for T = 1: any numbers, degenerate ones, or the moments of a known control."""
    kind = draw(st.sampled_from(["any", "wide", "bang-bang", "impulses", "degenerate"]))
    if kind == "any":
        return draw(states())
    if kind == "wide":
        return draw(states(wide()))
    if kind == "degenerate":
        return draw(states(st.sampled_from([0.0, 0.0, 1.0, -1.0, 0.5, 1 / 6])))
    level = draw(signs)
    if kind == "bang-bang":
        return bang_bang_moments(level, *draw(places()))
    at = np.array([0.0, draw(shares), 1.0])
    amplitudes = np.array(draw(states()))
    return np.array([at**2 / 2, at, np.ones(3)]) @ amplitudes


@st.composite
def bodies(draw):
    """Any mass distribution: principal moments are sums of pairs of second moments of the mass."""
    x, y, z = (draw(st.floats(0.1, 2.0)) for _ in range(3))
    frame = Rotation.from_rotvec(draw(states(st.floats(-2.0, 2.0)))).as_matrix()
    return RigidBody(frame @ np.diag([y + z, x + z, x + y]) @ frame.T)


def deviations(size=0.02, least=0.0):
    """A deviation (3,) from the circle, of which some coordinate exceeds `least` in modulus."""
    coordinate = st.floats(-size, size, allow_subnormal=False)
    return states(coordinate).filter(lambda z: np.abs(z).max() >= least)


def random_system(seed, n, steps, decades):
    """Matrices A of moderate condition, matrices H of ellipsoids whose axes span the decades, and a state."""
    generator = np.random.default_rng(seed)

    def matrix(spread):
        left, right = (np.linalg.qr(generator.normal(size=(n, n)))[0] for _ in range(2))
        return left * 10.0 ** generator.uniform(-spread, spread, n) @ right

    A = np.array([matrix(0.2) for _ in range(steps)])
    H = [np.linalg.inv(L @ L.T) for L in (matrix(decades / 2) for _ in range(steps))]
    return A, np.array([(shape + shape.T) / 2 for shape in H]), generator.normal(size=n)


@st.composite
def systems(draw, most=8):
    """A nonstationary system of `most` steps, a state, and a number of steps."""
    n, decades = draw(st.integers(1, 5)), draw(st.integers(0, 3))
    A, H, x0 = random_system(draw(st.integers(0, 10_000)), n, most, decades)
    return DiscreteSystem(A, H), x0, draw(st.integers(1, most))


def maneuver_with(c, duration=1.0):
    """The manoeuvre from rest at the origin whose moments are c."""
    return Maneuver(np.zeros(np.shape(c)), c, duration)


def stacked(members):
    """Single manoeuvres as one stack."""
    force = [0.0 if m.disturbance is None else m.disturbance for m in members]
    x0, xf, tf, t0 = ([getattr(m, name) for m in members] for name in ("x0", "xf", "tf", "t0"))
    return Maneuver(x0, xf, tf, t0, force)
