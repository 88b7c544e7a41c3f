"""The family of solutions over the anomaly at the end: its members, solved or interpolated, and extremals."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pontryagin.averaging import kepler, smooth_example
from pontryagin.averaging.exact import family as families
from pontryagin.averaging.exact.shooting import shooting

RIPPLED = smooth_example(1.0, 2.0, ripple=0.5)
CASES = [
    pytest.param(RIPPLED, 0.004, id="rippled flywheel"),
    pytest.param(kepler(-0.5, 0.95, -0.35, 0.1), 0.004, id="Kepler orbit", marks=pytest.mark.slow),
]


@pytest.mark.parametrize(("solution", "epsilon"), CASES)
def test_members_between_solved_turns_meet_the_conditions(solution, epsilon):
    """Each member, flown from its initial costates, ends as the family says, with the cost that it says."""
    found = solution.exact(epsilon)
    family = found.traced
    problem = shooting(solution, epsilon, found[0].starting_anomaly)
    shot = problem.shoot(family.theta, family.unknowns)
    assert shot.error.max() < 1e-4
    assert_allclose(shot.y, family.y, rtol=0, atol=1e-3 * np.ptp(family.y))
    assert_allclose(shot.cost, family.cost, rtol=1e-5)


@pytest.mark.parametrize(("solution", "epsilon"), CASES)
def test_the_curvature_is_that_of_the_cost(solution, epsilon):
    """dJ = p_x dtheta: the curvature is the slope of p_x over the anomaly at the end."""
    found = solution.exact(epsilon)
    family = found.traced
    ends = np.array([one.ending_anomaly for one in found])
    step = 1e-4
    problem = shooting(solution, epsilon, found[0].starting_anomaly)
    for theta, one in zip(ends[:6], found[:6], strict=True):
        nearest = np.argmin(np.abs(family.theta - theta))
        guess = family.unknowns[nearest][None]
        sides = []
        for side in (theta - step, theta + step):
            w, at = guess, np.array([side])
            for _ in range(4):
                slopes = problem.slopes(at, w)
                w = w - np.linalg.solve(slopes.residual_w, problem.shoot(at, w).residual[..., None])[..., 0]
            sides.append(problem.shoot(at, w).y[0])
        expected = epsilon * (sides[1] - sides[0]) / (2 * step)
        assert one.curvature == pytest.approx(expected, rel=0.02)
        assert one.kind == ("minimum" if expected > 0 else "maximum")


def test_turns_to_be_solved_hardly_grow_as_epsilon_falls(monkeypatch):
    """Members depend smoothly on epsilon times the turn: turns grow in number, those to be solved do not."""
    counts, solved = [], []
    filled = families.filled

    def watched(turns, size):
        solved.append(len(turns))
        return filled(turns, size)

    monkeypatch.setattr(families, "filled", watched)
    for epsilon in (0.008, 0.002):
        counts.append(np.ptp(RIPPLED.exact(epsilon).traced.theta) / (2 * np.pi))
    (few, more), (short, long) = solved, counts
    assert long > 3.5 * short
    assert more < 1.6 * few


@pytest.mark.parametrize("epsilon", [0.05, 0.01, 0.003])
def test_no_extremal_is_left_out_between_solved_turns(epsilon):
    """With every turn solved the same extremals are found."""
    found = RIPPLED.exact(epsilon)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(families, "_leap", lambda *_: None)
        every = RIPPLED.exact(epsilon)
    assert_allclose([one.ending_anomaly for one in found], [one.ending_anomaly for one in every], atol=1e-7)
    assert_allclose([one.cost for one in found], [one.cost for one in every], rtol=1e-10)
