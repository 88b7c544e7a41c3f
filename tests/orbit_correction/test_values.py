"""Problems and solutions as values: pickles, copies, comparison, hashes, arrays that cannot be changed."""

import copy
import pickle
from dataclasses import fields

import numpy as np
import pytest

from pontryagin import orbit_correction as oc
from pontryagin.orbit_correction import printed
from pontryagin.orbit_correction.intervals import sweep

SYSTEM = oc.DiscreteSystem([np.eye(2), 2 * np.eye(2)], np.eye(2))

MAKERS = {
    "Plan": lambda: oc.correct([printed.Z0, (0.0, 0.0, 0.0)]),
    "Alternative": lambda: oc.least_energy(oc.correct(printed.Z0)),
    "DiscreteSystem": lambda: oc.DiscreteSystem([np.eye(2), 2 * np.eye(2)], np.eye(2)),
    "Gauge": lambda: oc.gauge(SYSTEM, [3.0, 4.0], 2),
    "PowerGauge": lambda: oc.power_gauge(printed.Z0, 4, 8),
    "ClosedLoop": lambda: oc.close_loop(printed.Z0, thrust="box"),
    "Sweep": lambda: sweep(printed.Z0, [0.25, 2 * np.pi]),
    "Distribution": lambda: oc.impulse_distribution(1e-5 * np.eye(3), 5),
    "Waste": lambda: oc.count_impulses(printed.Z0),
}


@pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
def test_equal_inputs_make_equal_values(make):
    one, other = make(), make()
    assert one == other and hash(one) == hash(other) and one is not other
    for twin in (pickle.loads(pickle.dumps(one)), copy.deepcopy(one)):
        assert twin == one and hash(twin) == hash(one)


@pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
def test_arrays_cannot_be_changed(make):
    value = make()
    arrays = [getattr(value, field.name) for field in fields(value)]
    arrays += [value.states, value.impulses] if isinstance(value, oc.Plan) else []
    for array in arrays:
        if isinstance(array, np.ndarray):
            with pytest.raises(ValueError, match="read-only"):
                array[...] = 0


def test_a_system_does_not_change_with_the_arrays_that_it_was_made_from():
    A = np.eye(2)
    system = oc.DiscreteSystem(A, np.eye(2))
    A[:] = 5
    assert system == oc.DiscreteSystem(np.eye(2), np.eye(2)) != oc.DiscreteSystem(A, np.eye(2))


@pytest.mark.parametrize(
    ("call", "argument"),
    [
        (lambda: oc.correct([1.0]), "z0"),
        (lambda: oc.correct(printed.Z0, peak=-1.0), "peak"),
        (lambda: oc.correct(printed.Z0, interval=[1.0]), "interval"),
        (lambda: oc.correct(printed.Z0, thrust="cone"), "thrust"),
        (lambda: oc.correct(printed.Z0, interval=2 * np.pi), "interval"),
        (lambda: oc.least_energy(oc.correct([printed.Z0])), "plan"),
        (lambda: oc.power_gauge(printed.Z0, 4, 0.5), "p"),
        (lambda: oc.fly(printed.Z0, [1.0, 2.0], 0.25), "impulses"),
        (lambda: oc.gauge(SYSTEM, [1.0, 2.0], 0), "steps"),
        (lambda: oc.gauge(SYSTEM, [1.0, 2.0], 3), "A"),
        (lambda: oc.DiscreteSystem(np.eye(2), [1.0]), "H"),
        (lambda: oc.random_states(0), "count"),
        (lambda: oc.impulse_distribution(-np.eye(3)), "covariance"),
    ],
)
def test_errors_carry_their_argument(call, argument):
    with pytest.raises((ValueError, TypeError)) as raised:
        call()
    assert raised.value.argument == argument
