"""Quaternions against SciPy's rotations and against their defining identities."""

import mpmath as mp
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.spatial.transform import Rotation

from pontryagin.numerics import rotation

RANDOM = np.random.default_rng(4)
A, B = RANDOM.standard_normal((2, 5, 3, 4))
X = RANDOM.standard_normal((5, 3, 3))
I, J, K = np.eye(4)[1:]


def unit(q):
    return q / np.linalg.norm(q, axis=-1, keepdims=True)


def test_the_units_multiply_as_hamilton_carved_them():
    assert_allclose(rotation.product(I, J), K)
    assert_allclose(rotation.product(J, I), -K)
    assert_allclose(rotation.product(rotation.product(I, J), K), [-1, 0, 0, 0])


def test_products_of_stacks_and_of_complex_numbers():
    both = rotation.product(A, B)
    assert_allclose(both[2, 1], rotation.product(A[2, 1], B[2, 1]), rtol=1e-14)
    assert_allclose(np.linalg.norm(both, axis=-1), np.linalg.norm(A, axis=-1) * np.linalg.norm(B, axis=-1))
    assert_allclose(rotation.conjugate(both), rotation.product(rotation.conjugate(B), rotation.conjugate(A)))
    assert_allclose(rotation.product(A, 1j * B), 1j * both)


def test_vectors_turn_as_by_scipys_rotations():
    theirs = Rotation.from_quat(unit(A).reshape(-1, 4), scalar_first=True).apply(X.reshape(-1, 3))
    assert_allclose(rotation.rotated(X, unit(A)), theirs.reshape(X.shape), atol=1e-14)


def test_turns_about_the_third_axis_add_their_angles():
    a, b = RANDOM.standard_normal((2, 6))
    both = rotation.product(rotation.about_third(a), rotation.about_third(b))
    assert_allclose(both, rotation.about_third(a + b), atol=1e-14)
    assert_allclose(rotation.about_third(a), rotation.quaternion(np.stack([0 * a, 0 * a, a], axis=-1)))


@pytest.mark.parametrize("angle", [1e5, -123456789.125, 1e12, -1e15, 9007199254740991.0])
def test_angles_of_any_size_are_reduced_as_in_sixty_digits(angle):
    with mp.workdps(60):
        exact = mp.atan2(mp.sin(mp.mpf(angle)), mp.cos(mp.mpf(angle)))
        assert abs(exact - mp.mpf(float(rotation.within_a_turn(angle)))) <= 1e-15
    assert float(rotation.within_a_turn(-6.25)) == -6.25
