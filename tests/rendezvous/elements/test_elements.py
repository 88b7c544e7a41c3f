"""Elements of a state, and the state back."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pontryagin.rendezvous import (
    Elements,
)

component = st.floats(-2, 2).map(lambda x: round(x, 3))


@settings(max_examples=60, deadline=None)
@given(st.tuples(*[component] * 3), st.tuples(*[component] * 3), st.floats(0, 6), st.floats(0.5, 4))
def test_the_elements_of_a_state_give_the_state_back_also_when_turned(position, velocity, angle, gravity):
    R, V = np.array(position), np.array(velocity)
    r = np.linalg.norm(R)
    if r < 0.1:
        return
    V = V * min(1.0, 1.2 * math.sqrt(gravity / r) / (np.linalg.norm(V) + 1e-9))
    for found in (one := Elements.from_state(R, V, gravity), one.turned(angle)):
        assert np.allclose(found.position, R, atol=1e-12)
        assert np.allclose(found.velocity, V, atol=1e-12)
        assert abs(float(found.relation)) < 1e-12
    assert float(one.Q) == pytest.approx(-gravity / (V @ V / 2 - gravity / r), rel=1e-10)


def test_elements_broadcast():
    many = Elements.from_state(np.tile([1.0, 0.2, -0.4], (5, 2, 1)), [0.1, 0.8, 0.3])
    assert many.A.shape == (5, 2, 4) and many.Q.shape == (5, 2)
    assert many.at(np.zeros((3, 1, 1))).position.shape == (3, 5, 2, 3)


def test_states_on_the_first_axis_have_elements():
    for sign in (1, -1):
        found = Elements.from_state([sign * 1.0, 0, 0], [0.1, 0.7, 0.2])
        assert np.allclose(found.position, [sign, 0, 0], atol=1e-15)


def test_elements_that_are_no_orbit_are_refused():
    with pytest.raises(ValueError, match="A and B must not both be zero"):
        Elements([0] * 4, [0] * 4)
    with pytest.raises(ValueError, match="got -1"):
        Elements([1, 0, 0, 0], [0, 1, 0, 0])
    with pytest.raises(ValueError, match="gravity must be one number"):
        Elements.from_state([1, 0, 0], [0, 1, 0], [1, 1])
    with pytest.raises(ValueError, match="angle must be"):
        Elements.from_state([1, 0, 0], [0, 1, 0]).turned(math.nan)


BAD = {
    "velocity must leave the energy": lambda: Elements.from_state([1, 0, 0], [0, 2, 0]),
    "position must not be the centre": lambda: Elements.from_state([0, 0, 0], [0, 1, 0]),
    "phi must be a number": lambda: Elements([1, 0, 0, 0], [0, 0, 0, 1], math.nan),
    "A must be an array": lambda: Elements([1, 0, 0], [0, 0, 0, 1]),
    "gravity must be": lambda: Elements.from_state([1, 0, 0], [0, 1, 0], gravity=-1.0),
}


@pytest.mark.parametrize("message", BAD)
def test_the_error_of_a_wrong_argument_names_it(message):
    with pytest.raises(ValueError, match=message):
        BAD[message]()
