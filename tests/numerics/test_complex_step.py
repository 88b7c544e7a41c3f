"""Derivatives by a complex step against the derivatives known in closed form."""

import numpy as np
from numpy.testing import assert_allclose

from pontryagin.numerics.complex_step import derivative, jacobian


def wave(x):
    return np.array([np.sin(x[0]) * x[1], np.exp(x[0] / x[1])])


def slopes(x):
    grown = np.exp(x[0] / x[1])
    rows = [[np.cos(x[0]) * x[1], np.sin(x[0])], [grown / x[1], -grown * x[0] / x[1] ** 2]]
    return np.array(rows)


def test_the_jacobian_is_exact_to_rounding():
    point = np.array([0.7, 1.3])
    value, found = jacobian(wave, point)
    assert_allclose(value, wave(point), rtol=1e-15)
    assert_allclose(found, slopes(point), rtol=1e-15)


def test_a_stack_of_points_is_differentiated_side_by_side():
    points = np.random.default_rng(1).uniform(0.5, 2.0, (2, 3, 4))
    value, found = jacobian(wave, points)
    assert value.shape == (2, 3, 4) and found.shape == (2, 2, 3, 4)
    assert_allclose(found, slopes(points), rtol=1e-14)


def test_directions_are_combined_as_by_the_chain_rule():
    point, directions = np.array([0.7, 1.3]), np.array([[1.0, 2.0, 0.5], [-1.0, 0.0, 3.0]])
    _, along = jacobian(wave, point, directions)
    assert_allclose(along, slopes(point) @ directions, rtol=1e-14)
    value, one = derivative(wave, point, directions[:, 0])
    assert_allclose(value, wave(point), rtol=1e-15)
    assert_allclose(one, along[:, 0], rtol=1e-15)
