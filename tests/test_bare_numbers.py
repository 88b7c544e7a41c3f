"""Masked entries and units of measurement are refused by every solver, with the argument's name."""

import numpy as np
import pytest

from pontryagin.orbit_correction import correct
from pontryagin.triple_integrator import Maneuver, minimum_time
from pontryagin.validation import finite, integer


class Length(np.ndarray):
    """An array with a unit, made as astropy makes its quantities."""

    unit = "km"


class Quantity:
    """A number or an array with units, as pint holds it: NumPy strips them."""

    units = "kilometer"

    def __init__(self, value):
        self.value = value

    def __array__(self, dtype=None, copy=None):
        return np.array(self.value, dtype)

    def __float__(self):
        return float(self.value)


CARRIERS = {
    "masked array": np.ma.array([1.0, 5.0, 2.0], mask=[False, True, False]),
    "masked entry": [1.0, np.ma.masked, 2.0],
    "subclass with a unit": np.array([1.0, 5.0, 2.0]).view(Length),
    "entry with a unit": [np.array(1.0).view(Length), 5.0, 2.0],
    "nested entry with a unit": [[1.0, 2.0, 3.0], [1.0, Quantity(5.0), 2.0]],
    "quantity": Quantity([1.0, 5.0, 2.0]),
    "objects with units": np.array([1.0, Quantity(5.0), 2.0], dtype=object),
}
USES = {
    "xf": lambda value: Maneuver([0, 0, 0], value, 2.0),
    "x0": lambda value: minimum_time(value, [0, 0, 0], 1.0),
    "z0": correct,
}


@pytest.mark.parametrize("carrier", CARRIERS)
@pytest.mark.parametrize("argument", USES)
def test_masks_and_units_are_refused(argument, carrier):
    with pytest.raises(
        (TypeError, ValueError), match=rf"^{argument} must be .*(masked entries|in k)"
    ) as caught:
        USES[argument](CARRIERS[carrier])
    assert caught.value.argument == argument


def test_masks_and_units_are_refused_by_native_code_too():
    for _ in range(600):
        minimum_time([0, 0, 0], [1, 0, 0], 1.0)
    test_masks_and_units_are_refused("x0", "masked array")
    test_masks_and_units_are_refused("x0", "subclass with a unit")


def test_an_array_without_masked_entries_is_an_array():
    assert finite("x", np.ma.array([1.0, 2.0]), "an array").tolist() == [1.0, 2.0]


def test_whole_numbers_have_no_mask():
    with pytest.raises(ValueError, match=r"^steps must be a whole number, got masked entries"):
        integer("steps", np.ma.array(3, mask=True))
