"""Which of the guesses became roots."""

import numpy as np
from numpy.testing import assert_array_equal

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
