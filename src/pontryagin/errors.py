"""The exceptions of the package: a wrong argument, a problem without a solution, an iteration that failed.

Each keeps its constructor's arguments in ``args``, so that it can be pickled and passed between processes.
"""


class _AboutArgument(Exception):
    """An exception that keeps the name of the argument that it is about, after its message."""

    def __init__(self, message: str, argument: str | None = None) -> None:
        super().__init__(message, argument)
        self.argument = argument

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
    """


class NotConverged(RuntimeError):
    """The iteration stopped short of a solution.

    Attributes
    ----------
    residual : float
        The remaining residual of the equations, in the problem's scaled units.
    """

    def __init__(self, message: str, residual: float) -> None:
        super().__init__(message, residual)
        self.residual = residual

    def __str__(self) -> str:
        return f"{self.args[0]} (residual {self.residual:.3e})"
