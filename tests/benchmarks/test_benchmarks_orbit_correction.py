"""The second paper's benchmark: peers agree with our gauges and plans, root finders end where reported."""

import numpy as np
import pytest
from benchmarks.contest import CALL, STACK, worst
from benchmarks.orbit_correction import aims, cones, figures, gauges, growth, linear, modelled, roots
from benchmarks.orbit_correction.states import PEAK, states, thrust
from numpy.testing import assert_allclose
from scipy.optimize import approx_fprime

from benchmarks import peers
from pontryagin.orbit_correction import correct
from pontryagin.orbit_correction.plan.thrust import THRUSTS

MAKERS = {
    "clarabel": (cones.impulses, cones.costate),
    "cvxpy": (modelled.by_cvxpy,),
    "highspy": (linear.by_highspy,),
    "scipy": (linear.by_linprog,),
}


def makers(name):
    found = [make for package, made in MAKERS.items() if not peers.absent(package) for make in made]
    return [make for make in found if name == "box" or make.__module__ != linear.__name__]


@pytest.mark.slow
@pytest.mark.parametrize("steps", [2, 5, 12])
@pytest.mark.parametrize("name", THRUSTS)
def test_each_peer_finds_our_gauge(name, steps):
    some = states(3)
    exact = thrust(name).gauges(some, np.full(3, steps)).upper
    for make in makers(name):
        solver = make(name, steps)
        assert_allclose([solver(state / PEAK) for state in some], exact, rtol=2e-6, err_msg=make.__name__)


def test_only_the_square_is_a_linear_programme():
    with pytest.raises(ValueError, match="ball"):
        linear.by_linprog("ball", 3)


def test_the_peers_that_are_installed_take_part():
    for name in THRUSTS:
        methods = " ".join(gauges.peers(name, quick=True))
        assert ("Clarabel" in methods) == (not peers.absent("clarabel"))
        assert ("linprog" in methods) == (name == "box")


@pytest.mark.parametrize("name", THRUSTS)
def test_the_search_with_exact_gauges_finds_the_fewest_steps(name):
    some = states(12)
    plan = correct(some, thrust=name)

    def made(steps):
        return lambda state: float(thrust(name).gauges(PEAK * state[None], np.array([steps])).upper[0])

    found = [gauges.search(made, state / PEAK, thrust(name).fewest) for state in some]
    assert [steps for steps, _ in found] == plan.steps.tolist()
    assert_allclose([alpha for _, alpha in found], plan.gauge, rtol=1e-12)


def test_a_peer_that_gives_up_has_solved_nothing():
    steps, alpha = gauges.search(lambda steps: lambda state: float("nan"), np.ones(3), 1)
    assert steps == 0 and np.isnan(alpha)


@pytest.mark.slow
def test_rows_hold_ours_and_a_peer_on_the_same_problem(monkeypatch):
    monkeypatch.setattr(gauges, "STACK_SIZE", 20)
    opponent = {"HiGHS, linprog": gauges.Peer(linear.by_linprog, 2)}
    for measured in (gauges.given_steps, gauges.fewest_steps):
        rows = measured("box", opponent, 3, 1)
        assert [row.method for row in rows] == [CALL, STACK, "HiGHS, linprog"]
        assert [row.count for row in rows] == [3, 60, 2]
        assert all(row.solved == 1 and row.error < 1e-9 for row in rows)


def test_the_system_11_vanishes_at_both_roots_and_its_jacobian_is_its_derivative():
    for task in roots.tasks(3, 2):
        plan = correct(PEAK * task.state)
        right = np.append(plan.initial_costate, plan.gauge)
        assert worst(task.equations(right)) < 1e-10 and worst(task.equations(-right)) < 1e-10
        value, jacobian = task.with_jacobian(task.starts[0])
        assert_allclose(value, task.equations(task.starts[0]), rtol=1e-12)
        assert_allclose(jacobian, approx_fprime(task.starts[0], task.equations, 1e-7), atol=1e-4)


def test_a_finder_is_judged_by_the_root_where_it_ends():
    (task,) = roots.tasks(1, 1)
    plan = correct(PEAK * task.state)
    right = np.append(plan.initial_costate, plan.gauge)
    both = roots.Task(task.factors, task.state, task.gauge, np.array([right, -right]))
    found = roots.ends([both], "lm, Jacobian")
    assert (found.right, found.spurious, found.starts) == (1, 1, 2)
    assert found.error < 1e-9


@pytest.mark.slow
def test_shares_of_starts_add_up(monkeypatch):
    monkeypatch.setattr(roots, "FINDERS", {"hybr": {}, "lm, Jacobian": {"jac": True}})
    table = roots.table(quick=True)
    shares = np.array([table[heading] for heading in ("right root", "spurious root", "no root")])
    assert_allclose(shares.sum(axis=0), 1)
    assert (np.array(table["right root"]) > 0).all()
    axis = figures.root_finders(table, "random").axes[0]
    assert sum(bar.get_width() for bar in axis.patches) == pytest.approx(200)


@pytest.mark.parametrize("name", THRUSTS)
def test_far_states_need_the_steps_that_are_measured(name, monkeypatch):
    monkeypatch.setattr(aims, "MANY", 60)
    assert correct(aims.far_states(name), thrust=name).steps.tolist() == [60] * aims.FAR


@pytest.mark.slow
def test_growth_shows_every_method_in_every_panel(monkeypatch):
    monkeypatch.setattr(growth, "QUICK", (3, 6))
    monkeypatch.setattr(
        gauges, "peers", lambda name, quick: {"HiGHS, linprog": gauges.Peer(linear.by_linprog, 1)}
    )
    monkeypatch.setattr(growth, "THRUSTS", ("box",))
    table = growth.table(quick=True)
    assert table["steps"] == [3, 3, 6, 6]
    assert max(table["worst relative error"]) < 1e-9
    (axis,) = figures.growth(table, (10, 0.02)).axes
    assert [list(line.get_xdata()) for line in axis.get_lines()] == [[3, 6], [3, 6], [10]]
