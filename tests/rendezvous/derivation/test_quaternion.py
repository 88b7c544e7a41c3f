"""Hamilton's product."""

import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from pontryagin.rendezvous.derivation import (
    quaternion,
)
from rendezvous_derived import multiplied


@given(*[st.tuples(*[st.integers(-3, 3)] * 4)] * 3)
def test_the_product_of_quaternions_is_hamilton_s_and_associative(a, b, c):
    p, q, s = (sp.Matrix(x) for x in (a, b, c))
    product, conjugate = quaternion.product, quaternion.conjugate
    assert list(product(p, q)) == multiplied(a, b).tolist()
    assert product(p, product(q, s)) == product(p, q, s)
    assert conjugate(product(p, q)) == product(conjugate(q), conjugate(p))
    assert quaternion.rotated(quaternion.vect(q), p).dot(quaternion.rotated(quaternion.vect(q), p)) == (
        p.dot(p) ** 2 * quaternion.vect(q).dot(quaternion.vect(q))
    )
