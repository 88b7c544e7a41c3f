"""The exceptions of the package: a wrong argument, a problem without a solution, an iteration that failed.

Each keeps its constructor's arguments in ``args``, so that it can be pickled and passed between processes.
"""

from collections.abc import Sequence


class _AboutArgument(Exception):
    """An exception that keeps the name of the argument that it is about, after its message."""

    def __init__(self, message: str, argument: str | None = None, members: Sequence[int] = ()) -> None:
        super().__init__(message, argument, members)
        self.argument = argument
        self.members = members

    def __str__(self) -> str:
        return str(self.args[0])


class ArgumentValueError(_AboutArgument, ValueError):
    """An argument has a value that the function does not accept.

    Parameters
    ----------
    message : str
        Names the argument and says what is accepted and what was given.
    argument : str, optional
        The argument's name; None where no single argument is at fault.
    members : sequence of int, optional
        Which problems of a stack are at fault, by their places in the flattened stack, where that is known.

    Examples
    --------
    >>> from pontryagin.triple_integrator import Maneuver
    >>> try:
    ...     Maneuver([0, 0, 0], [1, 0, 0, 0], tf=1.0)
    ... except ValueError as error:
    ...     print(error.argument)
    xf
    """


class ArgumentTypeError(_AboutArgument, TypeError):
    """An argument has a type that the function does not accept; see `ArgumentValueError`."""


class Infeasible(_AboutArgument, ValueError):
    """The problem has no solution; the message says why.

    Attributes
    ----------
    argument : str or None
        The argument that makes the problem infeasible; None where no single one does.
    members : sequence of int
        As for `ArgumentValueError`.
    """


class NotConverged(RuntimeError):
    """The iteration stopped short of a solution.

    Attributes
    ----------
    residual : float
        The remaining residual of the equations, in the problem's scaled units.
    members : sequence of int
        As for `ArgumentValueError`.
    """

    def __init__(self, message: str, residual: float, members: Sequence[int] = ()) -> None:
        super().__init__(message, residual, members)
        self.residual = residual
        self.members = members

    def __str__(self) -> str:
        return f"{self.args[0]} (residual {self.residual:.3e})"
