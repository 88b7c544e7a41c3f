"""Threads get the answers of one thread, from solutions that they share and from solvers that they call."""

import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from functools import partial

import numpy as np
import pytest

import rendezvous_problems
from pontryagin import averaging, orbit_correction, rendezvous, triple_integrator
from strategies import random_system

THREADS = 4
CHASER = rendezvous.Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0])


@pytest.fixture(autouse=True)
def frequent_switches():
    """Threads take turns after a microsecond, so that those that share a state meet in it."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    yield
    sys.setswitchinterval(before)


def in_threads(calls):
    """The results of the calls, which begin together in `THREADS` threads."""
    barrier = threading.Barrier(THREADS)
    with ThreadPoolExecutor(THREADS, initializer=barrier.wait) as pool:
        return list(pool.map(lambda call: call(), calls))


def same(first, second):
    """Whether two results are equal to the last bit."""
    if isinstance(first, tuple):
        return len(first) == len(second) and all(map(same, first, second))
    return np.array_equal(np.asarray(first), np.asarray(second), equal_nan=True)


def leap(anomaly, **given):
    target = rendezvous.Orbit(1.2, 0.05, [1, 0, 0, 0], anomaly)
    return rendezvous.Rendezvous(CHASER, target, time_weight=0, energy_weight=1, peak=np.inf, **given)


@pytest.fixture(scope="module")
def meeting():
    return rendezvous.solve(leap(0.5, duration=6.0))


@pytest.fixture(scope="module")
def extremal():
    return averaging.smooth_example(1.0, 2.0, ripple=0.5).exact(0.05)[0]


@pytest.mark.parametrize("name", ["state", "control", "costate"])
def test_a_meeting_is_sampled_by_many_threads(meeting, name):
    times = [np.linspace(0, share * meeting.flight.duration, 40) for share in np.linspace(0.1, 1, 24)]
    calls = [partial(getattr(meeting, name), t) for t in times]
    assert all(map(same, [call() for call in calls], in_threads(calls)))


@pytest.mark.parametrize("name", ["slow", "costate", "control"])
def test_an_extremal_is_sampled_by_many_threads(extremal, name):
    times = [np.linspace(0, share * extremal.duration, 40) for share in np.linspace(0.1, 1, 24)]
    calls = [partial(getattr(extremal, name), t) for t in times]
    assert all(map(same, [call() for call in calls], in_threads(calls)))


def test_meetings_are_solved_by_many_threads():
    calls = [partial(rendezvous.solve, leap(anomaly, duration=6.0)) for anomaly in (0.3, 0.5, 0.7, 0.9)]
    costs = [found.cost for found in in_threads(calls)]
    assert costs == [call().cost for call in calls]


def test_extremals_are_searched_by_many_threads():
    def costs(epsilon):
        return tuple(e.cost for e in averaging.smooth_example(1.0, 2.0, ripple=0.5).exact(epsilon))

    calls = [partial(costs, epsilon) for epsilon in (0.1, 0.08, 0.06, 0.05)]
    assert all(map(same, [call() for call in calls], in_threads(calls)))


def test_turns_are_solved_by_many_threads():
    rng = np.random.default_rng(5)
    stacks = [triple_integrator.Maneuver(*rng.standard_normal((2, 3000, 3)), 2.0) for _ in range(8)]
    for solve in (
        triple_integrator.minimum_peak,
        triple_integrator.minimum_energy,
        triple_integrator.minimum_impulse,
    ):
        calls = [lambda stack=stack, solve=solve: solve(stack).norm for stack in stacks]
        assert all(map(same, [call() for call in calls], in_threads(calls)))


def test_steps_of_a_discrete_system_are_checked_by_many_threads():
    def system():
        turn = np.array([[0.8, 0.3], [-0.3, 0.8]])
        return orbit_correction.DiscreteSystem(lambda k: turn / (1 + k), lambda k: np.eye(2) * (1 + k))

    for _ in range(20):
        shared, alone = system(), system()
        calls = [partial(shared.step, k) for k in (9, 3, 7, 1, 5, 8)] + [partial(shared.factors, 6)]
        expected = [alone.step(k) for k in (9, 3, 7, 1, 5, 8)] + [alone.factors(6)]
        assert all(map(same, expected, in_threads(calls)))


def stacks():
    """Manoeuvres inside the moment cone, which every solver takes."""
    rng = np.random.default_rng(6)
    c = np.array([0.2, 0.5, 1.0]) + rng.uniform(-0.03, 0.03, (6, 4, 3))
    return [triple_integrator.Maneuver([0, 0, 0], part, 1.0) for part in c]


def deviations():
    return 0.01 * np.random.default_rng(7).standard_normal((8, 20, 3))


def braked(ratio):
    found = averaging.spin_down([0.3, 0.4, 1.2], [1.0, 0.5, 0.4], ratio)
    return found.cost, tuple(one.cost for one in found.exact(0.2))


def drawn_gauge(seed):
    A, H, x0 = random_system(seed, 3, 6, 2)
    return orbit_correction.gauge(orbit_correction.DiscreteSystem(A, H), x0, 6)


SOLVERS = {
    "norm": (lambda m: triple_integrator.minimum_norm(m, 3.0).norm, stacks),
    "entropy": (lambda m: triple_integrator.maximum_entropy(m).entropy, stacks),
    "time": (lambda m: triple_integrator.minimum_time(m.x0, m.xf, 5.0).duration, stacks),
    "ball": (lambda z: orbit_correction.correct(z).impulses, deviations),
    "disc": (lambda z: orbit_correction.correct(z, thrust="disc").impulses, deviations),
    "box": (lambda z: orbit_correction.correct(z, thrust="box").impulses, deviations),
    "gauge": (lambda seed: drawn_gauge(seed).alpha, lambda: range(8)),
    "rotor": (lambda a: averaging.rotor(1.0, a, mass=2, peak=1.0).cost, lambda: np.linspace(2, 3, 6)),
    "spin down": (braked, lambda: (0.5, 0.6, 0.75, 0.8)),
    "elements": (
        lambda anomaly: rendezvous.solve_in_elements(leap(anomaly, duration=6.0)).cost,
        lambda: (0.3, 0.5, 0.7, 0.9),
    ),
    "flights": (
        lambda size: rendezvous.carry(leap(0.5, duration=6.0), size * rendezvous_problems.starts(4)).state,
        lambda: (0.2, 0.4, 0.6, 0.8),
    ),
}


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[pytest.mark.slow] if name == "spin down" else []) for name in SOLVERS]
)
def test_every_solver_in_many_threads_is_the_one_of_one_thread(name):
    solve, problems = SOLVERS[name]
    calls = [partial(solve, one) for one in problems()]
    assert all(map(same, in_threads(calls), [call() for call in calls]))


FIRST = """
import sys, threading
from concurrent.futures import ThreadPoolExecutor
import numpy as np
from pontryagin import averaging, triple_integrator as t
sys.setswitchinterval(1e-6)
barrier = threading.Barrier(4)
a, b = np.random.default_rng(3).standard_normal((2, 2000, 3))
def one(i):
    barrier.wait()
    norms = t.minimum_peak(t.Maneuver(a, b, 2.0)).norm
    return norms.sum(), averaging.smooth_example(1.0, 2.0).exact(0.1)[0].cost
with ThreadPoolExecutor(4) as pool:
    found = set(pool.map(one, range(4)))
assert len(found) == 1, found
"""


@pytest.mark.slow
def test_threads_fill_an_empty_cache_together(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    done = subprocess.run([sys.executable, "-c", FIRST], capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    assert not list(tmp_path.rglob("*.tmp"))
