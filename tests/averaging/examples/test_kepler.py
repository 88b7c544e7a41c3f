"""The transfer between Kepler orbits refuses invalid arguments by name."""

import pytest

from pontryagin.averaging import kepler

NAN, INFINITE = float("nan"), float("inf")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((0.5, 0.9, -0.3, 0.1), "E0 must be negative"),
        ((-0.5, 0.9, 0.0, 0.1), "E1 must be negative, as the energy of a bound orbit is, got 0"),
        ((-0.5, 0.9, [-0.3, 0.2], 0.1), "E1 must be negative, as the energy of a bound orbit is, got 0.2"),
        ((-0.5, -0.9, -0.3, 0.1), "K0 must be positive"),
        ((-0.5, 1.1, -0.3, 0.1), "K0 must be below that of the round orbit .* = 1, got 1.1"),
        ((-0.5, 1.0, -0.3, 0.1), "K0 must leave an eccentricity above"),
        ((-0.5, 1 - 1e-14, -0.3, 0.1), "K0 must leave an eccentricity above"),
        ((-0.5, 1e-9, -0.3, 0.1), "K0 must leave an eccentricity below 1"),
        ((-0.5, 0.9, -0.3, 0.0), "l must be positive"),
        ((-0.5, 0.9, -0.3, NAN), "l must be .* finite"),
        ((NAN, 0.9, -0.3, 0.1), "E0 must be .* finite"),
        (([-0.5, -0.4], [0.9, 0.8, 0.7], -0.3, 0.1), "K0: the leading shapes do not broadcast"),
    ],
)
def test_kepler_names_what_is_wrong(arguments, message):
    with pytest.raises(ValueError, match=message):
        kepler(*arguments)
