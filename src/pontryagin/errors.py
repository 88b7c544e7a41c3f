"""What a solver raises when it cannot hand out an answer."""


class Infeasible(ValueError):
    """The problem has no solution; the message says why."""


class NotConverged(RuntimeError):
    """The iteration stopped short of a solution.

    Attributes
    ----------
    residual : float
        What was left of the equations, in the problem's scaled units.
    """

    def __init__(self, message: str, residual: float) -> None:
        super().__init__(f"{message} (residual {residual:.3e})")
        self.residual = residual
