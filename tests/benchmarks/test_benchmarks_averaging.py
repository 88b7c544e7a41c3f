"""The third paper's benchmark: every method that is timed solves its problem."""

import numpy as np
import pytest
from benchmarks.averaging import collocation, enumeration, examples, figures, flows
from benchmarks.averaging.examples import EXAMPLES, OWN, SMOOTH
from benchmarks.table import by_heading
from numpy.testing import assert_allclose
from scipy.optimize import approx_fprime

EPSILON = 0.1


@pytest.fixture(scope="module")
def smooth():
    solution = EXAMPLES[SMOOTH].one()
    return solution, solution.exact(EPSILON)


@pytest.mark.parametrize("name", EXAMPLES)
def test_stacks_are_problems_that_have_solutions(name):
    example = EXAMPLES[name]
    first, again = example.stack(name, 3), example.stack(name, 3)
    for argument in example.spread:
        assert_allclose(first[argument], again[argument], rtol=0)
        assert np.ptp(first[argument], axis=0).max() > 0
    solution = example.solve(**first)
    assert solution.duration.shape == (3,)
    assert examples.worst_residual(solution) < 1e-9


def test_the_own_system_is_the_pendulum_between_its_levels():
    solution = examples.own_system(4.0)
    level = examples.own_expressions()["level"]
    assert solution.numbers[level] == 4.0
    assert EXAMPLES[OWN].one().start[0] == 2.0


def test_a_shot_of_the_best_extremal_hits(smooth):
    problem, theta, unknowns = enumeration.shot(*smooth)
    shot = problem.shoot(theta, unknowns)
    n = len(problem.start)
    assert np.abs(shot.residual[:, : len(problem.scale_m)]).max() < 1e-10
    assert shot.cost[0] == pytest.approx(smooth[1][0].cost, rel=1e-12)
    assert unknowns.shape == (1, n + len(problem.scale_m))


@pytest.mark.slow
@pytest.mark.parametrize("sensitivities", [False, True])
def test_integrators_agree_on_the_end(smooth, sensitivities):
    path = flows.trajectory(SMOOTH, EPSILON)
    runs, exact = flows.contestants(path, sensitivities)
    assert len(runs) >= 3
    for method, run in runs.items():
        assert flows.error(run(), exact) < 1e-8, method
    n = len(path.start)
    assert exact[n - 1] == pytest.approx(smooth[1][0].cost, rel=1e-10)
    assert exact.shape == ((n + n * len(path.wrt),) if sensitivities else (n,))


def test_solve_bvp_s_jacobian_is_the_derivative_of_its_right_hand_side():
    boundary, mesh, states, parameters = collocation.posed(EXAMPLES[SMOOTH].one(), EPSILON)
    some = [0, len(mesh) // 2]
    s, z = mesh[some], states[:, some]
    by_state, by_parameters = boundary.jacobians(s, z, parameters)
    for k in range(2):
        at = s[k : k + 1]
        slope = approx_fprime(
            z[:, k], lambda v, at=at: boundary.rates(at, v[:, None], parameters)[:, 0], 1e-7
        )
        assert_allclose(by_state[..., k], slope, atol=1e-4 * max(1, np.abs(slope).max()))
        here = z[:, k : k + 1]
        slope = approx_fprime(parameters, lambda q, at=at, here=here: boundary.rates(at, here, q)[:, 0], 1e-7)
        assert_allclose(by_parameters[..., k], slope, atol=1e-4 * max(1, np.abs(slope).max()))


def test_the_averaged_solution_is_posed_as_a_guess_that_starts_right(smooth):
    boundary, mesh, states, parameters = collocation.posed(smooth[0], EPSILON)
    assert mesh[0] == 0 and mesh[-1] == pytest.approx(1)
    missing = boundary.missing(states[:, 0], states[:, -1], parameters)
    assert missing.shape == (len(states) + len(parameters),)
    assert_allclose(missing[:2], 0, atol=1e-12)


def test_where_solve_bvp_ends_is_told_by_place_and_kind(smooth):
    solution, found = smooth
    answer = collocation.collocated(solution, EPSILON)
    place, extremal = collocation.landed(found, float(answer.p[0]), float(answer.y[-1, -1]))
    assert found[place - 1] is extremal
    assert extremal.cost == pytest.approx(float(answer.y[-1, -1]), rel=1e-5)
    worst = found[len(found) - 1]
    assert collocation.landed(found, worst.ending_anomaly, worst.cost)[0] == len(found)
    assert collocation.landed(found, worst.ending_anomaly + 0.1, worst.cost) is None


def test_rows_of_exact_and_averaged_and_their_figure(monkeypatch):
    monkeypatch.setattr(enumeration, "SHOTS", 1)
    monkeypatch.setattr(enumeration, "ROUNDS", 1)
    rows = list(enumeration.of_one(SMOOTH, (0.1, 0.05)))
    assert [(row["extremals"], row["minima"]) for row in rows] == [(3, 2), (7, 4)]
    assert all(row["error of J0 + epsilon J1"] < 2 * row["error of J0"] for row in rows)
    table = by_heading(rows)
    axis = figures.price_of_exactness(table).axes[0]
    assert [list(line.get_xdata()) for line in axis.lines] == [[0.1, 0.05]] * 3
    assert axis.get_ylabel() == "processor time, ms"


def test_the_landing_is_drawn_among_all_extremals(smooth):
    found = smooth[1]
    axis = figures.where_solve_bvp_lands({EPSILON: (found, (found[0].duration, found[0].cost))}).axes[0]
    assert sum(len(line.get_xdata()) for line in axis.lines) == len(found) + 2
