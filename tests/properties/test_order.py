"""Values that must grow or fall: norms with the time, times with the bound, gauges with the steps."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from pontryagin.orbit_correction import DiscreteSystem, correct, gauge
from pontryagin.orbit_correction.plan.thrust import THRUSTS, Thrust
from pontryagin.triple_integrator import (
    Maneuver,
    minimum_energy,
    minimum_impulse,
    minimum_norm,
    minimum_peak,
    minimum_time,
)
from strategies import angles, deviations, moments, states, systems

EXPONENTS = [1, 1.3, 2, 4.0, np.inf]
SOLVERS = {1: minimum_impulse, 2: minimum_energy, np.inf: minimum_peak}
factors = st.floats(1.0, 50.0)


def least(maneuver, q):
    """The least L_q norm."""
    return float(SOLVERS[q](maneuver).norm if q in SOLVERS else minimum_norm(maneuver, q).norm)


@pytest.mark.parametrize("q", EXPONENTS)
@given(place=angles, end=states(), T=st.floats(0.2, 4.0), longer=factors, back=st.booleans())
def test_who_may_wait_needs_no_larger_norm(q, place, end, T, longer, back):
    """From or to an equilibrium a longer manoeuvre can wait there without a control."""
    ends = [np.array([place, 0.0, 0.0]), end]
    early, late = (Maneuver(*(reversed(ends) if back else ends), duration) for duration in (T, longer * T))
    assert least(late, q) <= least(early, q) * (1 + 1e-12)


@given(c=moments(), pair=st.tuples(*[st.floats(1.02, 40.0)] * 2).map(sorted))
def test_the_power_mean_grows_with_the_exponent(c, pair):
    """For T = 1 a larger exponent gives no smaller norm of any control, hence none of the best."""
    maneuver = Maneuver([0, 0, 0], c, 1.0)
    norms = [least(maneuver, q) for q in (1, *pair, np.inf)]
    assert (np.diff(norms) >= -1e-11 * norms[-1]).all()


@given(x0=states(), xf=states(), force=angles, peak=st.floats(0.05, 20), more=factors)
def test_a_larger_bound_takes_no_longer(x0, xf, force, peak, more):
    assume(np.abs(xf - x0).max() > 1e-6)
    slow, fast = (float(minimum_time(x0, xf, bound, force).duration) for bound in (peak, more * peak))
    assert fast <= slow * (1 + 1e-12)


@given(x0=states(), xf=states(), force=angles, peak=st.floats(0.05, 20))
def test_the_bound_is_the_least_peak_of_the_least_time(x0, xf, force, peak):
    assume(np.abs(xf - x0).max() > 1e-3)
    found = minimum_time(x0, xf, peak, force)
    assert float(minimum_peak(found.maneuver).norm) == pytest.approx(peak, rel=1e-9)


@given(systems(), st.integers(0, 7))
def test_more_steps_need_no_larger_share_of_the_controls(drawn, fewer):
    system, x0, steps = drawn
    few, many = (float(gauge(system, x0, n).alpha) for n in (max(steps - fewer, 1), steps))
    assert many <= few * (1 + 1e-9)


@given(systems(), st.floats(0.0, 0.99))
def test_larger_ellipsoids_are_used_less(drawn, share):
    """The ellipsoid of H - d I, with d below the least eigenvalue of H, contains that of H."""
    system, x0, steps = drawn
    H = np.asarray(system.H)
    smaller = H - share * np.linalg.eigvalsh(H)[:, :1, None] * np.eye(len(x0))
    larger = DiscreteSystem(system.A, (smaller + smaller.swapaxes(1, 2)) / 2)
    assert gauge(larger, x0, steps).alpha <= gauge(system, x0, steps).alpha * (1 + 1e-9)


@given(
    deviations(least=1e-5),
    st.sampled_from([0.25, 1.0, np.pi / 2, 4.0]),
    st.floats(1.0, 20.0),
    st.sampled_from(THRUSTS),
)
def test_a_larger_peak_takes_no_more_steps(z0, interval, factor, thrust):
    weak, strong = (correct(z0, interval, peak, thrust) for peak in (0.0035, 0.0035 * factor))
    assert strong.steps <= weak.steps


@given(deviations(least=1e-5), st.sampled_from([0.25, 1.0, np.pi / 2, 4.0]), st.integers(1, 6))
def test_a_set_that_holds_another_is_used_less(z0, interval, pairs):
    """Ball, disc and box are nested: two steps of the ball have three impulses, each within the disc."""
    steps = {"ball": 2 * pairs, "disc": 3 * pairs, "box": 3 * pairs}
    found = [Thrust(name, interval, 0.0035).gauges(z0[None], np.array([steps[name]])) for name in steps]
    ball, disc, box = (float(gauges.upper[0]) for gauges in found)
    assert box <= disc * (1 + 1e-9)
    assert disc <= ball * (1 + 1e-9)
