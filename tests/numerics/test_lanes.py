"""Many trajectories at once end where single ones do, in any order, whatever the others do."""

import math

import mpmath
import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose, assert_array_equal

from pontryagin.errors import NotConverged
from pontryagin.numerics import arc_loop, lane_loop, runge_kutta, trajectory
from pontryagin.numerics.flow import integrator
from pontryagin.numerics.lane_loop import LANES
from pontryagin.numerics.lane_text import LARGEST
from pontryagin.numerics.lanes import FEW, compiled_lanes, ends, stacked
from pontryagin.numerics.symbolic import Symbolic
from pontryagin.numerics.tape import FUNCTIONS

x, v, k, t = sp.symbols("x v k t")
PENDULUM = Symbolic((x, v), (v, -k * sp.sin(x) + sp.cos(t) / 7), (k,), t, (x, v))


def carried(states, rates, wrt, starts, begin, end):
    """The ends by the lanes, whatever the number of starts is."""
    starts = np.asarray(starts, dtype=float)
    begin, end = (np.full(len(starts), time, dtype=float) for time in (begin, end))
    equations = Symbolic(tuple(states), tuple(rates), wrt=tuple(wrt))
    return compiled_lanes(equations).run(starts, begin, end, np.empty((len(starts), 0)), 1e-14)


def test_what_is_given_once_is_given_to_every_trajectory():
    starts, begin, end, values = stacked([[1.0, 0.0], [2.0, 0.0]], 0.0, [1.0, 2.0], [3.0], 1)
    assert starts.shape == (2, 2) and begin.tolist() == [0.0, 0.0] and end.tolist() == [1.0, 2.0]
    assert values.tolist() == [[3.0], [3.0]]


@pytest.mark.parametrize("count", [1, FEW, FEW + 1, LANES, LANES + 1, 2 * LANES + 3])
def test_many_trajectories_reach_the_ends_of_their_own_spans(count):
    carry = ends([x, v], [v, -(k**2) * x + sp.sin(t)], [k], clock=t, wrt=[x, v])
    rng = np.random.default_rng(count)
    starts, rate = rng.standard_normal((count, 2)), rng.uniform(1.5, 3.0, count)
    begin, span = rng.uniform(-2, 2, count), rng.uniform(-5, 5, count)
    states, slopes = carry(starts, begin, begin + span, rate[:, None])
    c, s = np.cos(rate * span), np.sin(rate * span)
    free = np.array([[c, s / rate], [-rate * s, c]]).transpose(2, 0, 1)

    def forced(time):
        return np.array([np.sin(time), np.cos(time)]).T / (rate**2 - 1)[:, None]

    expected = (free @ (starts - forced(begin))[..., None])[..., 0] + forced(begin + span)
    assert_allclose(slopes, free, atol=1e-11)
    assert_allclose(states, expected, atol=1e-11)


def test_each_trajectory_has_its_own_steps():
    """Beside others, a trajectory ends where it does alone; the spans differ by a factor of 1e5."""
    along, parameters = integrator(PENDULUM), np.array([1.3])
    starts = np.array([[0.2, 0.9], [3.1, 0.0], [1e-8, 0.0], [0.2, 0.9]])
    end = np.array([1e-3, 30.0, 100.0, 0.0])
    states, slopes = compiled_lanes(PENDULUM).run(
        starts, np.zeros(4), end, np.broadcast_to(parameters, (4, 1)), 1e-14
    )
    for i in range(3):
        alone = along.run(np.append(starts[i], [1.0, 0.0, 0.0, 1.0]), 0.0, end[i], parameters).whole
        size = 1e-13 * max(1.0, np.abs(alone).max()) * max(1.0, end[i])
        assert_allclose(np.append(states[i], slopes[i]), alone, rtol=0, atol=size)
    assert_array_equal(states[3], starts[3])
    assert_array_equal(slopes[3], np.eye(2))


def test_derivatives_of_a_nonlinear_flow_are_those_of_its_ends():
    carry = ends([x, v], [v, -k * sp.sin(x) + sp.cos(t)], [k], clock=t, wrt=[v])
    plain = ends([x, v], [v, -k * sp.sin(x) + sp.cos(t)], [k], clock=t)
    start, step = np.array([1.0, 0.3]), 1e-5
    _, slopes = carry([start] * 3, 0.0, 6.0, [1.3])
    around = [start + np.array([0, step]), start - np.array([0, step]), start]
    (above, below, _), empty = plain(around, 0.0, 6.0, [1.3])
    assert_allclose(slopes[0, :, 0], (above - below) / (2 * step), rtol=0, atol=2e-8)
    assert_array_equal(slopes[0], slopes[2])
    assert empty.shape == (3, 2, 0)


@pytest.mark.parametrize("count", [1, 5])
def test_a_flow_that_ends_in_a_singularity_is_not_handed_out(count):
    with np.errstate(all="ignore"), pytest.raises(NotConverged):
        ends([x], [x**2])([[1.0]] * count, 0.0, 2.0)


def test_one_trajectory_into_a_singularity_is_enough():
    starts = [[0.1], [0.2], [1.0], [0.3]]
    with pytest.raises(NotConverged):
        ends([x], [x**2])(starts, 0.0, 2.0)
    found, _ = ends([x], [x**2])(starts, 0.0, 0.5)
    assert_allclose(found[:, 0], [1 / (1 / s - 0.5) for (s,) in starts], rtol=1e-13)


def test_fractions_are_taken_as_they_are():
    grow = ends([x], [x * sp.Rational(1, 3) * k], [k])
    assert_allclose(grow([[1.0]] * 3, 0.0, 3.0, [2.0])[0], [[np.exp(2.0)]] * 3, rtol=1e-13)


# --- sines, cosines and other functions of vectors ------------------------------------------------------


def values_of(function, points):
    """Values of a function of x, which is the rate of another state over a unit of time."""
    starts = np.array([[point, 0.0] for point in points])
    return carried((x, v), (sp.Integer(0), function), (), starts, 0.0, 1.0)[0][:, 1]


def test_sines_and_cosines_are_right_to_a_unit_in_the_last_place():
    rng = np.random.default_rng(11)
    points = [*rng.uniform(-1, 1, 200), *rng.uniform(-200, 200, 200), *rng.uniform(-LARGEST, LARGEST, 200)]
    points += [*(np.pi / 2 * rng.integers(-500_000, 500_000, 200)), 0.0, 1e-300, np.pi / 4, LARGEST]
    points += [1e6, -1e9, 1e22, np.nextafter(LARGEST, np.inf), 7e5, -3.0]
    with mpmath.workdps(60):
        for function, exact in ((sp.sin, mpmath.sin), (sp.cos, mpmath.cos)):
            for value, point in zip(direct(function, points), points, strict=True):
                right = exact(mpmath.mpf(float(point)))
                assert abs(mpmath.mpf(float(value)) - right) <= max(np.spacing(abs(float(right))), 5e-324)


def direct(function, points):
    """Values of a function by the rates themselves, to their last digit."""
    native = compiled_lanes(Symbolic((x,), (function(x),)))
    found = []
    for first in range(0, len(points), LANES):
        lanes = np.resize(np.array(points[first : first + LANES], dtype=float), LANES)
        out = np.empty(LANES)
        native.evaluate(np.zeros(LANES), lanes, np.empty(0), out)
        found += out.tolist()
    return found[: len(points)]


def test_infinite_and_missing_arguments_give_no_number_in_their_lane_alone():
    found = direct(sp.sin, [np.inf, -np.inf, np.nan, 1.0, 2.0])
    assert np.isnan(found[:3]).all()
    assert_allclose(found[3:], [math.sin(1.0), math.sin(2.0)], rtol=1e-15)


@pytest.mark.parametrize("name", [name for name in FUNCTIONS if name not in ("copysign", "atan2")])
def test_every_function_has_its_value_and_its_derivative_in_every_lane(name):
    points = np.linspace(1.2, 1.9, LANES) if name == "acosh" else np.linspace(0.1, 0.8, LANES)
    of = getattr(sp, name)(x) if name != "fabs" else sp.Abs(x)
    starts = np.column_stack([points, np.zeros(LANES)])
    states, slopes = carried((x, v), (sp.Integer(0), of), (x,), starts, 0.0, 1.0)
    with mpmath.workdps(30):
        plain = getattr(mpmath, name)
        expected = [[float(plain(p)), float(mpmath.diff(plain, p))] for p in map(mpmath.mpf, points)]
    assert_allclose(np.column_stack([states[:, 1], slopes[:, 1, 0]]), expected, rtol=1e-13)


# --- the loop -------------------------------------------------------------------------------------------


def test_the_native_loop_of_lanes_computes_what_its_source_does():
    """The same steps and ends up to the rounding of sums, with the step of `runge_kutta` in each lane."""
    table, size = trajectory.table(), 6
    starts = np.array([[0.1 * i, 1.0 - 0.2 * i] for i in range(LANES)])
    begin, end = np.linspace(0, 1, LANES), np.linspace(3, -2, LANES)
    values = np.linspace(1, 2, LANES)[:, None]

    def one(time, flat, p, out):
        columns = PENDULUM.variational(time, flat[:2], flat[2:6].reshape(2, 2), p)
        out[:6] = np.append(columns[:, 0], columns[:, 1:])

    def rates(time, flat, p, out):
        states, target = flat[: 6 * LANES].reshape(6, LANES), out[: 6 * LANES].reshape(6, LANES)
        for lane in range(LANES):
            column = np.empty(6)
            one(time[lane], states[:, lane], [p[lane]], column)
            target[:, lane] = column

    def step(time, h, y, p, k, new, off, tolerance):
        for lane in range(LANES):
            before, stages, after = y[lane::LANES].copy(), np.zeros(13 * 6), np.zeros(6)
            stages[:6] = k[: 6 * LANES][lane::LANES]
            runge_kutta.step(one, 6, time[lane], h[lane], before, [p[lane]], stages, table, after)
            one(time[lane] + h[lane], after, [p[lane]], stages[72:])
            k[6 * LANES :][lane::LANES], new[lane::LANES] = stages[72:], after
            off[lane] = runge_kutta.error(6, 6, h[lane], before, after, stages, table, tolerance)

    identity = np.tile(np.eye(2).ravel(), (LANES, 1))
    y = np.concatenate([starts, identity], axis=1).T.ravel()
    rooms = [np.zeros(n * LANES) for n in (2 * size, size, size, 1, 1, lane_loop.HELD, 1)]
    reached = begin.copy()
    failed = lane_loop.follow_lanes(rates, step, size, y, values[:, 0], reached, end, 1e-9, 1000, *rooms)
    states, slopes = compiled_lanes(PENDULUM).run(starts, begin, end, values, 1e-9)
    assert failed == 0 and not rooms[-1].any()
    assert_array_equal(reached, end)
    found = np.concatenate([states, slopes.reshape(LANES, 4)], axis=1)
    assert_allclose(y.reshape(6, LANES).T, found, rtol=1e-12, atol=1e-13)
    for lane in range(LANES):
        alone = trajectory.compiled(PENDULUM).follow(
            np.append(starts[lane], identity[lane]),
            begin[lane],
            end[lane],
            values[lane],
            1e-9,
            math.inf,
            1000,
            np.empty(0),
        )
        assert rooms[5][lane_loop.STEPS * LANES + lane] == alone.steps
        assert_allclose(found[lane], alone.whole, rtol=1e-12, atol=1e-13)


def test_too_many_steps_are_told_of_the_lane_alone():
    """A lane that may make no further step stops there; the others go on to their ends."""

    def rates(time, flat, p, out):
        out[:LANES] = flat[:LANES]

    def step(time, h, y, p, k, new, off, tolerance):
        new[:LANES] = y * np.exp(h)
        k[LANES:], off[:] = new, 0.5

    y, t_ = np.ones(LANES), np.zeros(LANES)
    end = np.array([1e6, *np.linspace(0.1, 1.0, LANES - 1)])
    rooms = [np.zeros(n * LANES) for n in (2, 1, 1, 1, 1, lane_loop.HELD, 1)]
    assert lane_loop.follow_lanes(rates, step, 1, y, np.empty(0), t_, end, 1e-6, 12, *rooms) == 1
    assert rooms[-1].tolist() == [arc_loop.MANY, *[0] * (LANES - 1)]
    assert_allclose(y[1:], np.exp(end[1:]), rtol=1e-14)
