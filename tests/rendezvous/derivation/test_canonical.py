"""The costates are those of a canonical transformation from Cartesian ones."""

import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from pontryagin.rendezvous.derivation import (
    canonical,
    model,
    quaternion,
)


@pytest.mark.slow
@given(*[st.fractions(1, 2, max_denominator=9)] * 3)
@settings(max_examples=3, deadline=None)
def test_the_costates_transformed_from_cartesian_ones_obey_the_16_equations(r, v1, c):
    numbers = [sp.Rational(x.numerator, x.denominator) for x in (r, v1, c)]
    lengths = dict(zip((model.r, model.v1, model.c), numbers, strict=True))
    point = lengths | dict(zip(model.attitude, (sp.Rational(k, 7) for k in (2, -3, 6, 0)), strict=True))
    assert canonical.state_gap(point).is_zero_matrix
    assert canonical.costate_gap(point).is_zero_matrix


def test_the_axes_made_of_place_and_velocity_are_eta():
    point = dict(zip(model.attitude, (sp.Rational(k, 5) for k in (1, 2, 2, 4)), strict=True))
    axes = canonical.axes(canonical.place_and_velocity().subs(point)).applyfunc(sp.simplify)
    eta = [quaternion.rotated(axis, model.attitude).subs(point) for axis in (model.EX, model.EY, model.EZ)]
    assert axes == sp.Matrix.hstack(*eta)
