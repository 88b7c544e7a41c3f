"""Which of the guesses became roots, and what is done about those that did not."""

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal

from pontryagin.averaging import smooth_example
from pontryagin.averaging.exact import roots
from pontryagin.averaging.exact.shooting import Shot


def shots(count):
    return Shot(*[np.arange(float(count))] * 9)


def test_a_guess_that_the_last_exact_flights_lose_is_no_root(monkeypatch):
    """Of four guesses the first stage keeps three, and the second loses the middle one of these."""
    stages = iter([np.array([True, False, True, True]), np.array([True, False, True])])

    def newton(problem, guess, *rest):
        kept = next(stages)
        return shots(len(kept)), np.arange(float(len(kept))), kept

    monkeypatch.setattr(roots, "_newton", newton)
    monkeypatch.setattr(roots, "along", lambda derivatives: (None, derivatives))
    given = roots._Guess(*[np.arange(4.0)] * 5)
    found, became = roots._polished(None, given, 1.0)
    assert_array_equal(became, [True, False, False, True])
    assert_array_equal(found.shot.theta, [0, 2])


def test_an_extremal_that_newton_loses_is_found_between_closer_members(monkeypatch):
    """The first guess of all is lost once; the family is refined there, and the same extremals come out."""
    problem = smooth_example(1.0, 2.0, ripple=0.5)
    plain = problem.exact(0.1)
    polished, calls = roots._polished, []

    def losing(problem, guess, size):
        reached, good = polished(problem, guess, size)
        calls.append(len(good))
        if len(calls) > 1:
            return reached, good
        kept = np.flatnonzero(good)[1:]
        lost = roots.Roots(reached.shot[1:], reached.slope[1:])
        return lost, np.isin(np.arange(len(good)), kept)

    plainly, between = roots.with_members, []
    monkeypatch.setattr(roots, "with_members", lambda *given: between.append(given[2]) or plainly(*given))
    monkeypatch.setattr(roots, "_polished", losing)
    again = smooth_example(1.0, 2.0, ripple=0.5).exact(0.1)
    assert len(calls) > 1 and [len(theta) for theta in between] == [1], "one member more where one was lost"
    assert_allclose([one.cost for one in again], [one.cost for one in plain], rtol=1e-12)
