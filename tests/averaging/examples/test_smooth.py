"""The smooth example refuses invalid arguments by name."""

import pytest

from pontryagin.averaging import smooth_example

NAN, INFINITE = float("nan"), float("inf")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((-1.0, 2.0), "v0 must be positive, got -1"),
        ((1.0, 0.0), "v1 must be positive, got 0"),
        ((1.0, 2.0, -1.0), "k must be positive"),
        ((1.0, 2.0, 0.0), "k must be positive"),
        ((NAN, 2.0), "v0 must be .* finite"),
        ((1.0, 2.0, 1.0, INFINITE), "ripple must be .* finite"),
        (([1.0, 2.0], [1.0, 2.0, 3.0]), "v1: the leading shapes do not broadcast"),
    ],
)
def test_the_smooth_example_names_what_is_wrong(arguments, message):
    with pytest.raises(ValueError, match=message):
        smooth_example(*arguments)
