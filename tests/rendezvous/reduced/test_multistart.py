"""Many costates at once: ends, derivatives, and Newton's method from each."""

import math

import numpy as np
import pytest

from pontryagin.rendezvous import (
    carry,
    multistart,
    solve,
)
from rendezvous_problems import FALLING, LEAP, in_units, starts


def test_the_starts_that_did_not_converge_are_counted(leap):
    starts = np.vstack([leap.initial_costate, np.full(6, 40.0)])
    (found, *_) = multistart(LEAP, starts)
    assert found.searched.given_up == ("no meeting was reached from 1 of the 2 starts",)
    assert multistart(LEAP, starts[1:]) == ()


def test_costates_that_are_zero_give_a_coasting_craft(leap):
    there = carry(LEAP, np.zeros((2, 6)))
    assert there.reached.all() and np.isfinite(there.slopes).all()
    assert multistart(LEAP, np.zeros((1, 6)))[0].cost == pytest.approx(leap.cost, rel=1e-12)
    assert not carry(LEAP, np.full(6, 1e300)).reached


@pytest.fixture(scope="module")
def best():
    """The best extremal found lap by lap, without random starts."""
    return solve(in_units())


@pytest.mark.parametrize("peak", [math.inf, 0.06])
def test_the_slopes_are_the_derivatives_of_the_miss(peak):
    given, h = in_units(peak=peak), 1e-6
    start = starts(3)[:, None, :]
    exact = carry(given, start[:, 0])
    there, back = (carry(given, start + x * np.eye(6)).miss for x in (h, -h))
    slopes = np.moveaxis((there - back) / (2 * h), 1, 2)
    np.testing.assert_allclose(exact.slopes, slopes, rtol=1e-5, atol=1e-5)


def test_the_costates_of_a_solution_lead_to_the_target(best):
    given = best.problem
    there = carry(given, best.initial_costate)
    assert there.reached and there.miss.shape == (6,) and there.slopes.shape == (6, 6)
    assert np.abs(there.miss).max() < 1e-12
    np.testing.assert_allclose(there.state, best.state([best.duration])[0], atol=1e-12)
    np.testing.assert_allclose(there.costate, best.costate([best.duration])[0], atol=1e-12)
    assert np.abs(carry(given, best.initial_costate + 1e-6).miss).max() > 1e-7


def test_the_flights_do_not_depend_on_the_units():
    here, far = in_units(), in_units(length=7000.0, gravity=398600.0)
    costates = starts(4)
    durations = np.array([1.0, 2.0, 3.0, 4.0])
    units = far.scaled.costate_units / here.scaled.costate_units
    ours = carry(here, costates, durations)
    theirs = carry(far, costates * units, durations * far.scaled.time / here.scaled.time)
    np.testing.assert_allclose(theirs.miss, ours.miss, atol=1e-12)
    np.testing.assert_allclose(theirs.state[:, 0], 7000 * ours.state[:, 0], rtol=1e-12)
    np.testing.assert_allclose(theirs.costate, ours.costate * units, rtol=1e-10)


@pytest.mark.slow
def test_newton_s_method_from_many_starts_finds_the_extremal_found_from_coasting(best):
    found, *others = multistart(best.problem, starts(8))
    assert found.cost <= best.cost * (1 + 1e-10)
    assert any(x.cost == pytest.approx(best.cost, rel=1e-10) for x in (found, *others))
    assert found.others == tuple(others) and others
    assert [x.cost for x in others] == sorted(x.cost for x in others)
    assert all(x.certificate.holds(1e-9) for x in (found, *others))


def test_starts_that_fail_give_no_extremals():
    assert multistart(in_units(), FALLING[None]) == ()


@pytest.mark.parametrize(
    ("call", "error", "match"),
    [
        (lambda: carry("leap", starts(1)), TypeError, "problem must be of type Rendezvous, got 'leap'"),
        (lambda: carry(in_units(), np.zeros(5)), ValueError, r"costates must be an array \(..., 6\)"),
        (lambda: carry(in_units(), np.full(6, np.nan)), ValueError, "costates .* got nan"),
        (lambda: carry(in_units(), starts(2), -1.0), ValueError, "durations must be positive, got -1"),
        (
            lambda: carry(in_units(), starts(2), [1.0, 2.0, 3.0]),
            ValueError,
            "durations must be one number or",
        ),
        (lambda: carry(in_units(duration=None), starts(2)), ValueError, "durations must be given"),
        (lambda: multistart(in_units(duration=None), starts(2)), ValueError, "problem must have a fixed dur"),
        (lambda: multistart(in_units(), np.zeros(6)), ValueError, r"costates must be an array \(k, 6\)"),
        (lambda: multistart(None, starts(2)), TypeError, "problem must be of type Rendezvous, got None"),
    ],
)
def test_the_error_of_a_wrong_argument_names_it(call, error, match):
    with pytest.raises(error, match=match):
        call()
