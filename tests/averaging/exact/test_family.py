"""The family of solutions over the anomaly at the end: its members, solved or interpolated, and extremals."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from pontryagin.averaging import kepler, smooth_example, spin_down
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


@pytest.mark.parametrize(
    ("v1", "ripple", "epsilon", "phase"),
    [
        (1.2, 0.7, 0.9, 0.0),
        (1.25, 0.6, 1.5, 0.5),
        (1.1, 0.7, 1.8, 0.0),
        (1.3, 0.6, 0.35, -1.1),
        (1.00086, 0.02, 1.96, -2.45),
    ],
)
def test_an_extremal_that_ends_shortly_after_the_start_is_found(v1, ripple, epsilon, phase):
    """Over so short a way the force is nearly c = ripple cos x, and the best control nearly constant.

    For speeds that change at the rate w the cost is (1 + (w - c)^2)/w for each unit of speed, at least
    2 (sqrt(1 + c^2) - c). Extremals are minima and maxima in turn, and the first one is a minimum.
    """
    found = smooth_example(1.0, v1, ripple=ripple).exact(epsilon, phase=phase)
    best = found[0]
    c = ripple * np.cos((phase + best.ending_anomaly) / 2)
    assert best.cost == pytest.approx(2 * (v1 - 1) * (np.sqrt(1 + c**2) - c), rel=0.03)
    assert all(one.certificate.holds(1e-9) for one in found)
    kinds = [one.kind for one in sorted(found, key=lambda one: one.ending_anomaly)]
    assert kinds == [("minimum", "maximum")[i % 2] for i in range(len(found))]


@pytest.mark.parametrize(
    ("v1", "k", "ripple", "epsilon", "phase"),
    [
        (0.869, 2.99, 0.571, 1.0368, 0.0384),
        (0.709, 1.85, 0.489, 0.649, -2.459),
        (0.9667, 0.477, 0.268, 1.125, -0.253),
    ],
)
def test_a_family_may_begin_closer_to_the_start_than_its_members_are_apart(v1, k, ripple, epsilon, phase):
    found = smooth_example(1.0, v1, k, ripple).exact(epsilon, phase=phase)
    kinds = [one.kind for one in sorted(found, key=lambda one: one.ending_anomaly)]
    assert kinds == [("minimum", "maximum")[i % 2] for i in range(len(found))]
    assert all(one.certificate.holds(1e-9) for one in found)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("semiaxes", "ratio", "epsilon", "phase"),
    [
        ([1.0, 0.5, 0.4], 0.7, 0.2, -0.93),
        ([0.869747933819063, 1.0635438455364925, 0.4696698728259383], 1.4, 0.3074521, 0.1266758644605961),
        ([1.0393931956705647, 1.058671273995086, 0.6062622019365801], 0.8, 0.128058057, 2.0164537943518575),
    ],
)
def test_extremals_that_end_within_the_first_turn_change_smoothly_with_epsilon(
    semiaxes, ratio, epsilon, phase
):
    body = spin_down([0.3, 0.4, 1.2], semiaxes, ratio)
    found = [body.exact(epsilon * share, phase=phase) for share in (0.985, 0.995, 1.005, 1.015)]
    assert [one.kind for some in found for one in some] == ["minimum"] * 4
    costs = np.array([some[0].cost for some in found])
    assert_allclose(np.diff(costs, 3), 0, atol=1e-5)
    assert np.abs(np.diff(costs)).min() > 1e-5
