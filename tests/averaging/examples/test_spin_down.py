"""The spin-down refuses invalid arguments by name."""

import pytest

from pontryagin.averaging import spin_down

NAN, INFINITE = float("nan"), float("inf")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([1.0, 2.0], [1, 1, 1], 0.5), r"omega0 must be an array \(\.\.\., 3\)"),
        (([1.0, 2.0, NAN], [1, 1, 1], 0.5), "omega0 must be .* finite"),
        (([1.0, 2.0, 0.0], [1, 1, 1], 0.5), "omega0 must have w_z other than 0"),
        (([1.0, 2.0, 3.0], [1, 0, 1], 0.5), "semiaxes must be positive"),
        (([1.0, 2.0, 3.0], [1, 1], 0.5), r"semiaxes must be an array \(\.\.\., 3\)"),
        (([1.0, 2.0, 3.0], [1, 1, 1], 1.0), "ratio must differ from 1"),
        (([1.0, 2.0, 3.0], [1, 1, 1], -0.5), "ratio must be positive"),
        (([[1.0, 2.0, 3.0]] * 2, [1, 1, 1], [0.5] * 3), "ratio: the leading shapes do not broadcast"),
    ],
)
def test_spin_down_names_what_is_wrong(arguments, message):
    with pytest.raises(ValueError, match=message):
        spin_down(*arguments)
