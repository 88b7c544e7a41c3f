"""Manoeuvres of any duration and amplitude: fifty-digit answers, or a refusal that names the argument."""

import mpmath as mp
import numpy as np
import pytest
from numpy.testing import assert_allclose

from independent import exact_energy, exact_impulse, exact_moments, exactly
from pontryagin.triple_integrator import (
    Maneuver,
    maximum_entropy,
    minimum_energy,
    minimum_impulse,
    minimum_norm,
    minimum_peak,
    minimum_time,
)

DURATIONS = [10.0**k for k in (-150, -107, -60, -8, 0, 9, 60, 107, 150)]
AMPLITUDES = [10.0**k for k in (-300, -200, -109, -30, 0, 30, 109, 200, 300)]
DIRECTIONS = [([0, 0, 0], [1, 0, 0]), ([0, 0, 0], [0.3, -0.2, 0.5]), ([1, 2, 3], [4, -5, 6])]
LEAST, MOST = mp.mpf(2) ** -1022, mp.mpf(2) ** 1023
MARGIN = 1e3


def turns():
    """Ends and durations over 300 decades of time and 600 of amplitude, in one unit or in three."""
    for T in DURATIONS:
        for size in AMPLITUDES:
            for start, end in DIRECTIONS:
                for unit in (np.ones(3), np.array([T, 1.0, 1 / T])):
                    with np.errstate(over="ignore", invalid="ignore"):
                        ends = np.array([start, end]) * (size * unit)
                    sizes = np.abs(ends[np.array([start, end]) != 0])
                    if np.isfinite(ends).all() and sizes.min() > 1e-305 and sizes.max() < 1e305:
                        yield *ends, T


def unit_of(c, T):
    """The largest of c1/T^2, c2/T and c3."""
    return max(abs(6 * c[0] / T**2), abs(2 * c[1] / T), abs(c[2]))


def in_units(solve, q):
    """The norm of a manoeuvre of duration 1 and size 1, times the exact unit of L_q norms."""

    def norm(c, T):
        size = unit_of(c, T)
        share = [float(x / size) for x in (c[0] / T**2, c[1] / T, c[2])]
        return size * T ** (1 / mp.mpf(q) - 1) * exactly(solve(Maneuver(np.zeros(3), share, 1.0)).norm)

    return norm


def least(q):
    """The solver for the least L_q norm."""
    return lambda maneuver: minimum_norm(maneuver, q)


NORMS = {
    "energy": (minimum_energy, exact_energy),
    "peak": (minimum_peak, in_units(minimum_peak, mp.inf)),
    "impulse": (minimum_impulse, exact_impulse),
    **{f"q = {q}": (least(q), in_units(least(q), q)) for q in (1.2, 2.0, 7.0)},
}


def held(name, sizes, c, T, norm):
    """Whether double precision holds motion, control and norm: True, False, or None next to the edge."""
    size = unit_of(c, T)
    needed = [norm, size, size * T**2, max(sizes)]
    needed += [] if name == "impulse" else [size / T]
    if all(LEAST * MARGIN < x < MOST / MARGIN for x in needed):
        return True
    return None if all(LEAST / MARGIN < x < MOST * MARGIN for x in needed) else False


def exact_case(name, x0, xf, T):
    """What `held` says, the norm, and by how much rounding of the terms of the moments enlarges its error."""
    with mp.workdps(50):
        T = exactly(T)
        c, sizes = exact_moments(x0, xf, T), exact_moments(-np.abs(x0), np.abs(xf), T)
        norm = NORMS[name][1](c, T)
        return held(name, sizes, c, T, norm), norm, float(unit_of(sizes, T) / unit_of(c, T))


@pytest.mark.parametrize("name", NORMS)
def test_norms_of_any_scale_are_right_or_refused(name):
    answers = refusals = 0
    for x0, xf, T in turns():
        right, norm, lost = exact_case(name, x0, xf, T)
        try:
            solution = NORMS[name][0](Maneuver(x0, xf, T))
        except ValueError as error:
            assert not right, (name, x0, xf, T)
            assert error.argument == "xf"
            refusals += 1
            continue
        assert right is not False, (name, x0, xf, T)
        answers += 1
        assert_allclose(
            float(mp.mpf(float(solution.norm)) / norm), 1, rtol=1e-13 * (1 + lost), err_msg=f"{x0}{xf}{T}"
        )
        assert solution.certificate.holds(1e-10)
    assert answers > 50
    assert refusals > 40


SOLVERS = {name: solve for name, (solve, _) in NORMS.items()} | {"entropy": maximum_entropy}


def answered(solve, turns):
    """The manoeuvres that the solver does not refuse, with their solutions."""
    for x0, xf, T in turns:
        try:
            yield (maneuver := Maneuver(x0, xf, T)), solve(maneuver)
        except ValueError:
            continue


def one_sided():
    """Manoeuvres of which a control of one sign is optimal."""
    for T in DURATIONS:
        for size in AMPLITUDES:
            with np.errstate(over="ignore", under="ignore"):
                end = size * np.array([0.17 * T * T, 0.5 * T, 1.0])
            if np.isfinite(end).all() and end.min() > 1e-300:
                yield np.zeros(3), end, T


@pytest.mark.parametrize("name", SOLVERS)
def test_motion_control_and_multipliers_of_any_scale(name):
    """The motion ends at the target, the control is that of size one, and l'c = 1."""
    solved = 0
    for m, s in answered(SOLVERS[name], one_sided() if name == "entropy" else turns()):
        T, c = float(m.duration), m.moments
        size = max(abs(c[0] / T / T), abs(c[1] / T), abs(c[2]))
        reach = np.abs(m.x0) + np.abs(m.xf) + size * np.array([T, 1.0, 0.0]) * [T, T, 0.0] + [0.0, 0.0, size]
        reach += np.array([abs(m.x0[1]) * T + abs(m.x0[2]) * T * T, abs(m.x0[2]) * T, 0.0])
        assert (np.abs(s.state([m.tf])[0] - m.xf) <= 1e-12 * reach).all(), (m, reach)
        unit = SOLVERS[name](Maneuver(np.zeros(3), np.array([c[0] / T / T, c[1] / T, c[2]]) / size, 1.0))
        if name != "impulse":
            share = np.array([0.0, 0.3, 0.6, 1.0])
            expected = unit.control(share) * (size / T)
            assert_allclose(
                s.control(m.t0 + share * T), expected, rtol=1e-6, atol=1e-9 * np.abs(expected).max()
            )
        pairing = sum(exactly(a) * exactly(b) for a, b in zip(s.multipliers, c, strict=True))
        assert_allclose(float(pairing), 1, rtol=1e-9)
        solved += 1
    assert solved > 30


@pytest.mark.parametrize("name", SOLVERS)
def test_a_stack_of_all_scales_is_its_members(name):
    members = list(answered(SOLVERS[name], one_sided() if name == "entropy" else turns()))
    x0, xf, tf = (np.array([getattr(m, field) for m, _ in members]) for field in ("x0", "xf", "tf"))
    stack = SOLVERS[name](Maneuver(x0, xf, tf))
    rounding = 1e-14 if name == "entropy" else 0.0
    assert_allclose(stack.norm, [s.norm for _, s in members], rtol=rounding)


@pytest.mark.parametrize("name", SOLVERS)
def test_a_stack_names_the_member_that_it_refuses(name):
    """The duration of the second one makes its control, or its moments, too small."""
    end = np.array([[0.17, 0.5, 1.0], [1.7e-279, 5e-289, 1e-298]])
    with pytest.raises(ValueError, match=r"^xf must give.* at index \[1\]") as caught:
        SOLVERS[name](Maneuver(np.zeros(3), end * 1e-12, [1.0, 1e10]))
    assert caught.value.argument == "xf"


def transfers():
    """Five transfers in many units of time: ends, peak, duration, and the unit of the angle."""
    cases = [([0, 0, 0], [1, 0, 0]), ([0, 0, 0], [0.3, -0.2, 0.5]), ([1, 2, 3], [4, -5, 6])]
    for start, end in [*cases, ([0, 1, 0], [0, 0, 0]), ([0, 0, 1], [0, 0, 0.5])]:
        least = float(minimum_time(start, end, 2.0).duration)
        for k in range(-150, 151, 30):
            for n in range(-300, 301, 50):
                unit = [mp.mpf(10) ** (n + power * k) for power in (3, 2, 1)]
                ends = [[float(x * u) for x, u in zip(state, unit, strict=True)] for state in (start, end)]
                sizes = np.abs(np.array(ends)[np.array([start, end]) != 0])
                if sizes.min() > 1e-305 and sizes.max() < 1e305:
                    yield *ends, 2.0 * 10.0**n, least, k, unit[0]


def test_least_times_of_any_scale_are_right_or_refused():
    answers = refusals = 0
    for x0, xf, peak, least, k, motion in transfers():
        try:
            solution = minimum_time(x0, xf, peak)
        except ValueError as error:
            assert not 1e-300 < motion < 1e300
            assert error.argument == "xf"
            refusals += 1
            continue
        assert 1e-310 < motion < 1e310
        assert_allclose(float(solution.duration), float(mp.mpf(least) * mp.mpf(10) ** k), rtol=1e-12)
        assert solution.certificate.holds(1e-9)
        reached = solution.state([solution.duration])[0]
        size = [float(motion / mp.mpf(10) ** (j * k)) for j in range(3)]
        assert (np.abs(reached - xf) <= 1e-9 * np.array(size)).all()
        answers += 1
    assert answers > 200
    assert refusals > 40
