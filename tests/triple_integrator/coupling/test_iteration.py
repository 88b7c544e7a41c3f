"""Coupled channels: the cross-coupling, and the iteration by which the full equations reach the target."""

from functools import cache
from itertools import pairwise

import mpmath as mp
import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from pontryagin import NotConverged
from pontryagin.triple_integrator import Maneuver, minimum_energy, minimum_impulse, minimum_peak
from pontryagin.triple_integrator.attitude.rigid_body import RigidBody
from pontryagin.triple_integrator.coupling import couple, spherical_factor
from pontryagin.triple_integrator.coupling.channels import Channels
from pontryagin.triple_integrator.derivation import rigid_body as derivation

BODY = RigidBody([[4.0, 0.3, -0.2], [0.3, 3.0, 0.1], [-0.2, 0.1, 2.0]])
NEARLY_SPHERICAL = RigidBody(np.diag([0.999, 1.0, 1.001]))
ENDS = np.array([0.2, -0.15, 0.25])
REST = minimum_energy(Maneuver([0, 0, 0], [0, 0, 0], tf=2.0))
coordinates = st.floats(-1.0, 1.0)
vectors = st.tuples(coordinates, coordinates, coordinates).map(np.array)


def rest_to_rest(ends, tf=2.0, t0=0.0):
    return [Maneuver([0, 0, 0], [end, 0, 0], tf=t0 + tf, t0=t0) for end in ends]


def skew_turn(angle, tf=2.0):
    return rest_to_rest(angle * np.array([1.0, 2.0, 2.0]) / 3, tf)


def motion_by_matrices(body, programmes, edges, jumps):
    """Rotation matrix, momentum and m integrated as 9 + 3 + 3 numbers, independently."""

    def rate(t, y, low, high):
        R, H, m = y[:9].reshape(3, 3), y[9:12], y[12:]
        w = np.linalg.solve(body.inertia, R.T @ H)
        spin = np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
        inside = min(max(t, low + 1e-12), high - 1e-12)
        u = [programme.control([inside])[0] for programme in programmes]
        return np.concatenate([(R @ spin).ravel(), R @ body.inertia @ m, u])

    y = np.concatenate([np.eye(3).ravel(), np.zeros(6)])
    y[12:] += jumps(edges[0])
    for low, high in pairwise(edges):
        run = solve_ivp(rate, (low, high), y, args=(low, high), method="DOP853", rtol=1e-12, atol=1e-13)
        y = run.y[:, -1]
        y[12:] += jumps(high)
    R = y[:9].reshape(3, 3)
    return R, np.linalg.solve(body.inertia, R.T @ y[9:12]), y[12:]


def impulses_at(programmes):
    def jumps(time):
        return [
            sum(p.impulses[p.impulse_times == time]) if hasattr(p, "impulses") else 0.0 for p in programmes
        ]

    return jumps


# --- the cross-coupling ------------------------------------------------------------------------------------


def numbers_for(phi, phi_rate=(), m=()):
    """Values of the derivation's symbols for a motion of BODY."""
    inverse = np.linalg.inv(BODY.inertia)
    names = [*derivation.inertia, *derivation.inverse_inertia, *derivation.rotation_vector, derivation.angle]
    values = [*BODY.inertia.ravel(), *inverse.ravel(), *phi, np.linalg.norm(phi)]
    names += [*derivation.rotation_vector_rate, *derivation.control_acceleration]
    return dict(zip(names, [*values, *phi_rate, *m], strict=False))


@cache
def derived(modules="numpy"):
    """The derived cross-coupling and its leading part as functions of the values of `numbers_for`."""
    names = list(numbers_for([0, 0, 1], [0] * 3, [0] * 3))
    expressions = [derivation.cross_coupling(), derivation.leading_cross_coupling()]
    return sp.lambdify(names, expressions, modules, cse=True)


@settings(max_examples=30, deadline=None)
@given(vectors.filter(lambda v: np.linalg.norm(v) > 0.05), vectors, vectors, st.floats(0.01, 100))
def test_the_coupling_is_homogeneous_so_that_the_duration_does_not_matter(phi, phi_rate, m, k):
    f, _ = derived()(*numbers_for(phi, phi_rate, m).values())
    scaled, _ = derived()(*numbers_for(phi, k * phi_rate, k**2 * m).values())
    assert_allclose(scaled, k**2 * f, rtol=1e-9, atol=1e-9 * k**2)


def test_the_coupling_begins_at_second_order():
    phi, phi_rate, m = np.array([1, -2, 2]) / 3, np.array([0.2, -0.4, 0.8]), np.array([0.7, 0.3, -1.6])
    motion = [*derivation.rotation_vector, *derivation.rotation_vector_rate, *derivation.control_acceleration]
    with mp.workdps(60):
        size = mp.mpf(10) ** -8
        values = {x: mp.mpf(float(value)) for x, value in numbers_for(phi, phi_rate, m).items()}
        values |= {x: size * values[x] for x in motion}
        values[derivation.angle] = mp.sqrt(sum(values[x] ** 2 for x in derivation.rotation_vector))
        f, leading = derived("mpmath")(*values.values())
        assert mp.norm(f - leading) < 10 * size**3
        assert mp.norm(leading) > size**2 / 10


@settings(max_examples=30, deadline=None)
@given(vectors.filter(lambda v: np.linalg.norm(v) > 0.05), vectors, vectors)
def test_the_coupling_in_numbers_is_that_derived(phi, phi_rate, m):
    B = np.linalg.inv(np.array(derivation.inverse_rate_matrix().subs(numbers_for(phi)), dtype=float))
    f, _ = derived()(*numbers_for(phi, phi_rate, m).values())
    ours = Channels(BODY, (REST,) * 3, (0, 1, 2)).coupling(phi, B @ phi_rate, m)
    assert_allclose(ours, f.ravel(), atol=1e-9)


@given(st.tuples(*[st.floats(0.05, 2.0)] * 3), vectors)
def test_no_body_has_a_gyroscopic_acceleration_above_the_product_of_two_rates(second_moments, rate):
    x, y, z = second_moments
    body = RigidBody(np.diag([y + z, x + z, x + y]))
    free = body.acceleration(rate, np.zeros(3))
    bound = np.abs(np.array([rate[1] * rate[2], rate[0] * rate[2], rate[0] * rate[1]]))
    assert np.all(np.abs(free) <= bound + 1e-14)


# --- the target is reached ---------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("solve", [minimum_energy, minimum_peak, minimum_impulse])
def test_the_full_equations_reach_the_target(solve):
    coupled = couple(BODY, rest_to_rest(ENDS), solve)
    assert coupled.misses[-1] <= 1e-9 < 1e-3 < coupled.misses[0]
    R, rate, m = motion_by_matrices(
        BODY, coupled.programmes, coupled.motion.edges, impulses_at(coupled.programmes)
    )
    left = Rotation.from_matrix(Rotation.from_rotvec(ENDS).as_matrix().T @ R).magnitude()
    assert left < 3e-9
    assert_allclose(rate, 0, atol=3e-9)
    assert_allclose(m, 0, atol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("solve", [minimum_energy, minimum_impulse])
def test_each_programme_is_the_optimum_of_its_channel_along_the_motion(solve):
    coupled = couple(BODY, rest_to_rest(ENDS, t0=-1.0), solve)
    t = np.linspace(-1.0, 1.0, 17)
    for programme, state in zip(coupled.programmes, coupled.state(t), strict=True):
        assert programme.certificate.holds(1e-10)
        assert_allclose(programme.state(t), state, atol=1e-8)


@pytest.mark.slow
def test_ends_in_motion_are_met():
    starts = np.array([[0.1, 0.2, 0.3], [0.0, -0.1, 0.0], [0.05, 0.0, -0.2]])
    ends = np.array([[0.3, 0.1, 0.0], [-0.2, 0.2, 0.1], [0.1, -0.1, 0.3]])
    coupled = couple(
        BODY, [Maneuver(a, b, tf=1.0) for a, b in zip(starts, ends, strict=True)], minimum_energy
    )
    assert_allclose(coupled.state([0.0])[:, 0], starts, atol=1e-12)
    assert_allclose(coupled.state([1.0])[:, 0], ends, atol=1e-8)


@pytest.mark.slow
def test_the_coupling_is_what_the_angle_gains_on_the_control():
    coupled = couple(BODY, rest_to_rest(ENDS), minimum_energy)
    t, step = np.array([0.3, 0.9, 1.6]), 1e-4
    change = (coupled.state(t + step)[..., 1] - coupled.state(t - step)[..., 1]) / (2 * step)
    assert_allclose(coupled.coupling(t), change - coupled.state(t)[..., 2], atol=1e-7)
    assert_allclose(coupled.torque(t), coupled.state(t)[..., 2].T @ BODY.inertia, atol=1e-12)


def test_each_iteration_takes_the_miss_off_the_moments():
    plain = tuple(minimum_energy(maneuver) for maneuver in rest_to_rest(ENDS))
    system = Channels(BODY, plain, (0, 1, 2))
    motion = system.move()
    couplings = system.couplings_along(motion, 0.0)
    informed = [
        Maneuver(m.x0, m.xf, m.tf, m.t0, f) for m, f in zip(rest_to_rest(ENDS), couplings, strict=True)
    ]
    phi = Rotation.from_quat(motion.end[:4], scalar_first=True).as_rotvec()
    angle = np.linalg.norm(phi)
    across = np.cross(phi, np.cross(phi, motion.end[4:7]))
    curvature = (1 - angle / 2 / np.tan(angle / 2)) / angle**2
    phi_rate = motion.end[4:7] + np.cross(phi, motion.end[4:7]) / 2 + curvature * across
    taken = np.array([p.maneuver.moments - m.moments for p, m in zip(plain, informed, strict=True)])
    assert_allclose(taken[:, 0], phi - ENDS, atol=1e-12)
    assert_allclose(taken[:, 1], phi_rate, atol=1e-12)


# --- the motion of the other channels given ----------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("solve", [minimum_energy, minimum_impulse])
def test_one_channel_is_programmed_against_the_given_motion_of_another(solve):
    given_motion = minimum_peak(Maneuver([0, 0, 0], [0.5, 0, 0], tf=2.0))
    coupled = couple(BODY, [Maneuver([0, 0, 0], [0.3, 0, 0], tf=2.0), REST, given_motion], solve)
    t = np.linspace(0.0, 2.0, 13)
    state = coupled.state(t)
    assert coupled.programmed == (0,)
    assert_allclose(state[2, :, :2], given_motion.state(t)[:, :2], atol=1e-9)
    assert_allclose(state[1, :, :2], 0, atol=1e-9)
    assert_allclose(state[0, -1], [0.3, 0, 0], atol=1e-8)
    assert np.abs(coupled.coupling(t)[0]).max() > 1e-2


@pytest.mark.slow
def test_a_steady_spin_may_be_given():
    spin = minimum_energy(Maneuver([0, 0.2, 0], [0.4, 0.2, 0], tf=2.0))
    coupled = couple(BODY, [Maneuver([0, 0, 0], [0.3, 0, 0], tf=2.0), REST, spin], minimum_energy)
    target = Rotation.from_rotvec([0.3, 0.0, 0.4])
    reached = Rotation.from_quat(coupled.attitude([2.0])[0], scalar_first=True)
    assert (target.inv() * reached).magnitude() < 1e-9


# --- the rate of convergence -------------------------------------------------------------------------------


def test_a_spherical_body_turned_from_rest_to_rest_needs_no_iteration():
    coupled = couple(RigidBody(3 * np.eye(3)), skew_turn(2.5), minimum_energy)
    assert coupled.misses.size == 1
    assert coupled.factor == 0.0


@pytest.mark.slow
@pytest.mark.parametrize("solve", [minimum_energy, minimum_impulse])
@pytest.mark.parametrize("angle", [0.2, 0.8])
def test_the_miss_of_a_nearly_spherical_body_falls_by_the_derived_factor(solve, angle):
    coupled = couple(NEARLY_SPHERICAL, skew_turn(angle), solve, tol=2e-11)
    assert coupled.factor == pytest.approx(float(spherical_factor(angle)), rel=0.05)


def test_the_spherical_factor_is_the_spectral_radius_of_one_less_the_rate_matrix():
    for angle in (0.3, 1.5, 3.0, 5.0):
        numbers = dict(zip(derivation.rotation_vector, [0, 0, angle], strict=True)) | {
            derivation.angle: angle
        }
        matrix = np.array(derivation.inverse_rate_matrix().subs(numbers), dtype=float)
        assert np.abs(np.linalg.eigvals(np.eye(3) - matrix)).max() == pytest.approx(
            float(spherical_factor(angle))
        )


@pytest.mark.slow
def test_the_factor_is_linear_in_the_angle():
    factors = [couple(BODY, skew_turn(angle), minimum_energy, tol=2e-11).factor for angle in (0.1, 0.2)]
    assert factors[1] / factors[0] == pytest.approx(2.0, rel=0.15)
    assert float(spherical_factor(1e-3)) == pytest.approx(5e-4, rel=1e-3)


@pytest.mark.slow
def test_the_iteration_does_not_depend_on_the_duration():
    misses = [couple(BODY, skew_turn(0.3, tf), minimum_energy, tol=1e-6).misses for tf in (0.01, 1.0, 500.0)]
    assert_allclose(misses[0], misses[1], rtol=1e-5)
    assert_allclose(misses[2], misses[1], rtol=1e-5)


def test_the_factor_of_a_spherical_body_is_one_at_108_degrees():
    assert np.degrees(brentq(lambda angle: float(spherical_factor(angle)) - 1, 1, 3)) == pytest.approx(
        108.60, abs=0.01
    )


@pytest.mark.slow
def test_beyond_the_threshold_the_miss_grows_and_is_told():
    with pytest.raises(NotConverged, match="did not settle in 8 iterations") as failure:
        couple(BODY, skew_turn(2.6), minimum_energy, iterations=8)
    assert failure.value.residual > 1e-2


# --- invalid arguments -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("channels", "kind", "word"),
    [
        (rest_to_rest(ENDS)[:2], ValueError, "three"),
        ([*rest_to_rest(ENDS)[:2], 0.3], TypeError, "float at index 2"),
        ([REST] * 3, ValueError, "to be programmed"),
        ([*rest_to_rest(ENDS)[:2], Maneuver([0, 0, 0], [1, 0, 0], tf=3.0)], ValueError, "one interval"),
        (
            [*rest_to_rest(ENDS)[:2], Maneuver([0, 0, 0], [1, 0, 0], 2.0, disturbance=1.0)],
            ValueError,
            "disturbance, .* got .*1.* at index 2",
        ),
        ([*rest_to_rest(ENDS)[:2], Maneuver([[0, 0, 0]], [1, 0, 0], 2.0)], ValueError, "single"),
        (
            [*rest_to_rest(ENDS)[:2], minimum_energy(Maneuver([[0, 0, 0]], [1, 0, 0], 2.0))],
            ValueError,
            "single",
        ),
        (rest_to_rest([4.0, 4.0, 4.0]), ValueError, "less than 2 pi.* at xf"),
    ],
)
def test_channels_that_make_no_manoeuvre_are_named(channels, kind, word):
    with pytest.raises(kind, match=f"channels must.*{word}"):
        couple(BODY, channels, minimum_energy)


@pytest.mark.parametrize(("angle", "got"), [(0.0, "0.0"), (7.0, "7.0"), ([1.0, 7.0], "7.0"), (np.nan, "nan")])
def test_an_angle_without_a_factor_is_named(angle, got):
    with pytest.raises(ValueError, match=f"angle must.*, got {got}"):
        spherical_factor(angle)
