"""The exceptions keep their attributes when they are pickled or copied."""

import copy
import pickle

import pytest

from pontryagin.errors import ArgumentTypeError, ArgumentValueError, Infeasible, NotConverged


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda error: pickle.loads(pickle.dumps(error))])
@pytest.mark.parametrize(
    ("error", "text"),
    [
        (ArgumentValueError("tf must be later than t0", "tf"), "tf must be later than t0"),
        (ArgumentTypeError("q must be a number, got None", "q"), "q must be a number, got None"),
        (Infeasible("4 steps are too few", argument="steps"), "4 steps are too few"),
        (Infeasible("no control exists"), "no control exists"),
        (NotConverged("stopped", 0.25), "stopped (residual 2.500e-01)"),
        (NotConverged("stopped", 0.25, (3, 5)), "stopped (residual 2.500e-01)"),
        (ArgumentValueError("tf must be later than t0", "tf", (2,)), "tf must be later than t0"),
    ],
)
def test_what_an_error_says_and_carries_survives(error, text, again):
    other = again(error)
    assert type(other) is type(error)
    assert str(other) == str(error) == text
    assert vars(other) == vars(error)


def test_the_errors_are_the_builtin_ones_for_a_caller():
    assert issubclass(ArgumentValueError, ValueError) and issubclass(ArgumentTypeError, TypeError)
    assert issubclass(Infeasible, ValueError) and Infeasible("no control exists").argument is None
