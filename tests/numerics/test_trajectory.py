"""The native loop: its coefficients, its plain source, its order, its events and its steps."""

import math
import threading

import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose, assert_array_equal
from scipy.integrate import DOP853

from pontryagin.errors import NotConverged
from pontryagin.numerics import arc_loop, object_code, runge_kutta, trajectory
from pontryagin.numerics.equations import Kernel
from pontryagin.numerics.flow import integrator
from pontryagin.numerics.symbolic import Symbolic

x, v, k, t = sp.symbols("x v k t", real=True)
PENDULUM = Symbolic((x, v), (v, -k * sp.sin(x) + sp.cos(t) / 7), (k,), t, (x, v), (x - sp.Rational(1, 2),))


def test_the_coefficients_are_scipys_and_have_the_order_8():
    table, full = trajectory.table(), np.zeros((15, 13))
    c, rows = table[:12], table[12:].reshape(15, 2, 12)
    for row, (weights, stages) in zip(full, rows, strict=True):
        row[stages[weights != 0].astype(int)] = weights[weights != 0]
        assert weights[: np.count_nonzero(weights)].all()
    assert_array_equal(c, DOP853.C[:12])
    assert_array_equal(full[:12, :12], DOP853.A[:12, :12])
    assert_array_equal(full[runge_kutta.STEP, :12], DOP853.B)
    assert_array_equal(full[runge_kutta.FIFTH], DOP853.E5)
    assert_array_equal(full[runge_kutta.THIRD], DOP853.E3)
    assert not full[[runge_kutta.STEP, runge_kutta.FIFTH, runge_kutta.THIRD], 1:3].any()
    assert_allclose(full[:12].sum(axis=1), c, atol=1e-14)
    for order in range(1, 9):  # Conditions of quadrature.
        assert_allclose(full[runge_kutta.STEP, :12] @ c ** (order - 1), 1 / order, atol=1e-14)


def test_the_native_loop_computes_what_its_source_does():
    """The same numbers up to the rounding of the rates, of which NumPy and LLVM share no order."""
    native = trajectory.compiled(PENDULUM)
    whole, grid = np.array([0.2, 0.9, 1.0, 0.0, 0.0, 1.0]), np.array([0.0, 0.1, 0.4])
    found = native.follow(whole, 0.0, 3.0, np.array([1.5]), 1e-10, 0.3, 1000, grid)

    def rates(time, flat, p, out):
        table = PENDULUM.variational(time, flat[:2], flat[2:6].reshape(2, 2), p[:1])
        out[:6] = np.append(table[:, 0], table[:, 1:])

    def plain(time, state, p, out):
        out[:2] = PENDULUM.rates(time, state[:2], p[:1])

    def guards(time, state, p, out):
        gradient, by_time = PENDULUM.event_gradient(0, time, state[:2], p[:1])
        slope = gradient @ PENDULUM.rates(time, state[:2], p[:1]) + by_time
        out[:2] = PENDULUM.event(0, time, state[:2], p[:1]), slope

    y, report, rows = whole.copy(), np.zeros(4), np.zeros(6)
    room = [np.zeros(6 * 13), np.zeros(2 * 12), trajectory.table(), *np.zeros((2, 6)), np.zeros(6), report]
    code = arc_loop.follow(
        rates, plain, guards, 1, 6, 6, y, np.array([1.5]), 3.0, 0.3, 1e-10, 1000, grid, 3, 2, rows, *room
    )
    assert code == found.code == arc_loop.EVENT
    assert (report[1], report[2], report[3]) == (found.steps, found.event, len(found.rows))
    assert_allclose(report[0], found.time, rtol=1e-14)
    assert_allclose(y, found.whole, rtol=1e-13)
    assert_allclose(rows.reshape(3, 2)[: len(found.rows)], found.rows, rtol=1e-13)


def test_an_event_lies_on_its_zero_whatever_the_steps_are():
    follow = integrator(PENDULUM)
    times = []
    for longest in (math.inf, 0.1, 0.013):
        reached = follow.run(np.array([0.0, 1.0]), 0.0, 5.0, [1.5], longest)
        assert reached.event == 0 and 0 <= reached.whole[0] - 0.5 < 1e-15
        times.append(reached.time)
    assert_allclose(times, times[0], rtol=1e-14)


def test_an_event_that_comes_and_goes_within_one_step_is_found():
    """x = t (2 - t) - 1 + 1e-3 is above zero for |t - 1| < 0.0316; rates are polynomials, steps long."""
    arch = Kernel(("x",), lambda of, t, z, p: [2.0 - 2.0 * t], 0, (), (lambda of, t, z, p: z[0],))
    reached = integrator(arch).run(np.array([-1 + 1e-3]), 0.0, 2.0, ())
    assert reached.event == 0
    assert_allclose(reached.time, 1 - math.sqrt(1e-3), rtol=1e-13)


def test_an_event_at_the_beginning_ends_nothing_but_the_next_one_does():
    """x = sin t grows through zero at 0, where the arc begins, and at 2 pi."""
    wave = Kernel(("x",), lambda of, t, z, p: [z[0] * 0.0 + cosine(t)], 0, (), (lambda of, t, z, p: z[0],))
    reached = integrator(wave).run(np.array([0.0]), 0.0, 10.0, ())
    assert reached.event == 0
    assert_allclose(reached.time, 2 * math.pi, rtol=1e-13)
    falling = integrator(wave).run(np.array([1e-18]), math.pi, 10.0, ())
    assert_allclose(falling.time, 2 * math.pi, rtol=1e-13)


def cosine(time):
    """The cosine on a tape and of a number."""
    from pontryagin.numerics.tape import call

    return call("cos", time)


def test_backwards_and_forwards_is_where_it_began():
    free = Symbolic(PENDULUM.states, PENDULUM.expressions, (k,), t)
    there = integrator(free).run(np.array([0.2, 0.9]), 0.0, 7.0, [1.5])
    back = integrator(free).run(there.whole, 7.0, 0.0, [1.5])
    assert_allclose(back.whole, [0.2, 0.9], atol=2e-13)


def test_samples_end_where_runs_end_to_the_bit():
    whole = np.array([0.2, -0.9, 1.0, 0.0, 0.0, 1.0])
    follow = integrator(PENDULUM)
    grid = np.linspace(0.0, 2.9, 57)
    rows, reached = follow.sample(whole, grid, [1.5])
    assert_array_equal(rows[-1], follow.run(whole, 0.0, 2.9, [1.5]).whole[:2])
    assert_array_equal(reached.whole[:2], rows[-1])
    alone = [follow.run(whole, 0.0, time, [1.5]).whole[:2] for time in grid[1:]]
    assert_allclose(rows[1:], alone, atol=1e-13)


@pytest.mark.parametrize("columns", range(1, 10))
def test_any_number_of_derivatives_has_room(columns):
    """x_i' = a_i x_i: the derivative of each end in its own start is exp(a_i t), in others 0."""
    rates = np.linspace(-1.0, 1.0, 9)
    names = tuple(f"x{i}" for i in range(9))
    system = Kernel(
        names,
        lambda of, t, z, p: [a * one for a, one in zip(rates, z, strict=True)],
        0,
        tuple(range(columns)),
    )
    reached = integrator(system).run(np.append(np.ones(9), system.identity), 0.0, 1.5, ())
    assert_allclose(reached.whole[:9], np.exp(1.5 * rates), rtol=1e-13)
    assert_allclose(
        reached.whole[9:].reshape(9, -1), np.exp(1.5 * rates)[:, None] * system.identity, atol=1e-12
    )


def test_a_singularity_and_a_limit_of_steps_stop_the_integrator():
    blows_up = Symbolic((x,), (x**2,))
    with pytest.raises(NotConverged, match="stopped before the end") as stopped:
        integrator(blows_up).run(np.array([1.0]), 0.0, 2.0, ())
    assert stopped.value.residual == pytest.approx(1.0)
    with pytest.raises(NotConverged):
        integrator(PENDULUM, steps_per_unit=1).run(np.array([0.2, -0.9]), 0.0, 2.9, [1.5])


def test_an_arc_shorter_than_the_resolution_of_time_is_no_singularity():
    end = np.nextafter(2.0, 3.0)
    reached = integrator(PENDULUM).run(np.array([0.2, -0.9]), 2.0, end, [1.5])
    assert reached.time == end and reached.event is None


def test_numbers_that_are_missing_are_asked_for():
    with pytest.raises(ValueError, match="2 states, with 4 derivatives or none, and 1 parameters, got 2"):
        integrator(PENDULUM).run(np.array([0.2, -0.9]), 0.0, 1.0, ())
    with pytest.raises(ValueError, match="got 3 numbers and 1 parameters"):
        integrator(PENDULUM).run(np.array([0.2, -0.9, 0.0]), 0.0, 1.0, [1.5])


def test_threads_share_one_integrator():
    follow, found = integrator(PENDULUM), {}

    def work(start):
        found[start] = follow.run(np.array([0.0, -start]), 0.0, 2.0, [1.5]).whole

    threads = [threading.Thread(target=work, args=(s,)) for s in np.linspace(0.1, 1.0, 8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for start, whole in found.items():
        assert_array_equal(whole, follow.run(np.array([0.0, -start]), 0.0, 2.0, [1.5]).whole)


def test_code_for_vectors_and_for_any_processor_computes_the_same(tmp_path, monkeypatch):
    """No operation is reordered or fused, so that figures are the same on every machine."""
    whole = np.append([0.2, -0.9], PENDULUM.identity)
    ends = []
    for flags in (object_code.instructions(), ""):
        monkeypatch.setattr(object_code, "instructions", lambda flags=flags: flags)
        monkeypatch.setattr(object_code, "cache_folder", lambda flags=flags: tmp_path / str(bool(flags)))
        object_code.cache_folder().mkdir(exist_ok=True)
        trajectory.compiled.cache_clear()
        native = trajectory.compiled(PENDULUM)
        ends.append(native.follow(whole, 0.0, 2.0, np.array([1.5]), 1e-13, math.inf, 1000, np.empty(0)).whole)
    trajectory.compiled.cache_clear()
    assert_array_equal(*ends)


def test_without_a_linker_the_same_code_is_loaded_by_llvmlite(tmp_path, monkeypatch):
    whole, arguments = np.array([0.2, -0.9]), (0.0, 2.0, np.array([1.5]), 1e-13, math.inf, 1000, np.empty(0))
    expected = trajectory.compiled(PENDULUM).follow(whole, *arguments)
    monkeypatch.setattr(object_code, "cache_folder", lambda: tmp_path)
    monkeypatch.setattr(object_code.shutil, "which", lambda _: None)
    for _ in range(2):  # It is made, and then it is opened.
        trajectory.compiled.cache_clear()
        assert_array_equal(trajectory.compiled(PENDULUM).follow(whole, *arguments).whole, expected.whole)
    trajectory.compiled.cache_clear()
    assert [path.suffix for path in tmp_path.iterdir()] == [".o"]
