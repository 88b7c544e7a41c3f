"""Newton's method on textbook problems: the solution, and the reported reason for stopping."""

from collections import namedtuple

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pontryagin.errors import NotConverged
from pontryagin.numerics.newton import expected, newton
from pontryagin.numerics.newton_stack import Evaluated, newton_stack, solved

Linear = namedtuple("Linear", ["residual", "jacobian"])


def scalar(function, slope):
    return lambda x: Linear(np.array([function(x[0])]), np.array([[slope(x[0])]]))


def rosenbrock(x):
    """Residuals of Rosenbrock's valley, zero at (1, 1)."""
    return Linear(np.array([10 * (x[1] - x[0] ** 2), 1 - x[0]]), np.array([[-20 * x[0], 10.0], [-1.0, 0.0]]))


def test_the_valley_is_left_at_its_lowest_point():
    found = newton(rosenbrock, np.array([-1.2, 1.0]))
    assert_allclose(found.unknowns, [1, 1], atol=1e-15)
    assert found.residual < 1e-15 and found.outcome in ("converged", "stalled")


def test_steps_are_halved_where_the_whole_step_overshoots():
    """For arctan, undamped Newton's method diverges from |x| > 1.39."""
    found = newton(scalar(np.arctan, lambda x: 1 / (1 + x**2)), np.array([20.0]))
    assert abs(found.unknowns[0]) < 1e-15


def test_a_step_to_where_the_equations_fail_is_shortened():
    def logarithm(x):
        if x[0] <= 0:
            raise NotConverged("not positive", 1.0)
        return Linear(np.log(x), np.array([[1 / x[0]]]))

    assert newton(logarithm, np.array([50.0])).unknowns[0] == pytest.approx(1, abs=1e-15)
    with pytest.raises(NotConverged):
        newton(logarithm, np.array([-1.0]))


def test_inadmissible_steps_are_not_made():
    """x^2 = 4 from 0.1, where the full first step goes to 20."""
    tried = []

    def square(x):
        tried.append(x[0])
        return Linear(x**2 - 4, np.diag(2 * x))

    found = newton(square, np.array([0.1]), admissible=lambda before, after: after[0] < 10 * before[0])
    assert found.unknowns[0] == pytest.approx(2, abs=1e-14) and max(tried) < 4


@pytest.mark.parametrize(
    ("problem", "start", "outcome"),
    [
        (scalar(lambda x: x**2 + 1, lambda x: 2 * x), 0.0, "singular"),
        (scalar(lambda x: x**2 + 1, lambda x: 2 * x), 1e-3, "stalled"),
        (scalar(lambda x: x**3, lambda x: 3 * x**2), 1.0, "iterations"),
        (scalar(lambda x: x - 3, lambda x: 1.0), 0.0, "stalled"),
        (scalar(lambda x: np.exp(x) - 2, np.exp), 0.5, "converged"),
    ],
    ids=["no slope", "no root", "triple root", "rounding at once", "simple root"],
)
def test_it_says_what_stopped_it(problem, start, outcome):
    assert newton(problem, np.array([start])).outcome == outcome


def test_the_first_steps_may_be_rough():
    """After the rough steps at most three accurate evaluations are needed."""
    exact = []

    def cubic(x, error=0.0):
        return Linear(x**3 - 2 + error, np.diag(3 * x**2))

    def counted(x):
        exact.append(x)
        return cubic(x)

    found = newton(counted, np.array([3.0]), rough=lambda x: cubic(x, 1e-10))
    assert found.unknowns[0] == pytest.approx(2 ** (1 / 3), abs=1e-15) and len(exact) <= 3


def test_the_expected_correction_is_that_of_quadratic_convergence():
    assert expected(1e-4, np.inf) == 1e-4
    assert expected(1e-4, 1e-2) == pytest.approx(1e-8)
    assert expected(1e-2, 1e-4) == 1e-2
    assert expected(1e-12, 0.0) == 1e-12 and expected(0.0, 0.0) == 0.0


def roots_of(targets):
    """The equations x^2 = target, with nan for x <= 0."""

    def evaluate(members, x):
        x = np.where(x > 0, x, np.nan)
        return Evaluated(x**2 - targets[members, None], 2 * x[:, :, None])

    return evaluate


def test_each_member_of_a_stack_has_its_own_damping():
    targets = np.array([2.0, 1e6, 1e-6, -1.0, 9.0])
    starts = np.array([1.0, 1e-3, 1.0, 1.0, -1.0])[:, None]
    found = newton_stack(roots_of(targets), starts, tolerance=1e-12, iterations=60, halvings=20)
    assert found.converged.tolist() == [True, True, True, False, False]
    assert_allclose(found.unknowns[:3, 0], np.sqrt(targets[:3]), rtol=1e-6)
    assert found.residual[3] >= 1 and np.isinf(found.residual[4])


def test_a_member_among_others_goes_as_if_alone():
    targets = np.random.default_rng(2).uniform(0.1, 50, 9)
    together = newton_stack(roots_of(targets), np.ones((9, 1)), tolerance=1e-11)
    for i in range(9):
        alone = newton_stack(roots_of(targets[i : i + 1]), np.ones((1, 1)), tolerance=1e-11)
        assert alone.unknowns[0, 0] == together.unknowns[i, 0]


def test_a_small_step_is_made_without_a_further_look():
    calls = []

    def evaluate(members, x):
        calls.append(len(members))
        return roots_of(np.array([4.0]))(members, x)

    found = newton_stack(evaluate, np.array([[2.0 + 1e-7]]), tolerance=0.0, step_tolerance=1e-6)
    assert found.converged.all() and calls == [1]
    assert found.unknowns[0, 0] == pytest.approx(2, abs=1e-14)


def test_members_are_finished_one_by_one_and_may_all_be_so_at_once():
    found = newton_stack(roots_of(np.array([1.0, 4.0])), np.array([[1.0], [2.0]]), tolerance=1e-12)
    assert found.converged.all() and np.isinf(found.correction).all()
    assert newton_stack(roots_of(np.ones(0)), np.ones((0, 1)), tolerance=1e-12).converged.shape == (0,)


def test_a_singular_system_of_a_stack_is_solved_by_least_squares():
    matrices = np.array([np.eye(2), [[1.0, 1.0], [1.0, 1.0]], [[np.nan, 0], [0, 1]]])
    result = solved(matrices, np.array([[1.0, 2.0], [2.0, 2.0], [1.0, 1.0]]))
    assert_allclose(result[:2], [[1, 2], [1, 1]])
    assert np.isnan(result[2]).all()


def test_a_step_that_reduces_nothing_is_halved_and_halved_again():
    """Beyond 1.4, Newton's step for atan goes further away."""
    seen = []

    def equations(x):
        seen.append(float(x[0]))
        return Linear(np.arctan(x), np.array([[1 / (1 + x[0] ** 2)]]))

    newton(equations, np.array([3.0]))
    full = -10 * np.arctan(3.0)
    first = [3.0 + full / 2**k for k in range(4)]
    better = next(k for k, x in enumerate(first) if abs(np.arctan(x)) < np.arctan(3.0))
    assert_allclose(seen[1 : better + 2], first[: better + 1], rtol=1e-14)
    assert better > 0
