"""What must hold along the straight line to the target before an averaged extremal is sought."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.collocation import Problem
from pontryagin.averaging.averaged.guess import Guess
from pontryagin.errors import ArgumentValueError, Infeasible


def require_sound(
    problem: Problem, guess: Guess, names: Sequence[str], there: NDArray[np.bool_], first: int
) -> None:
    """Raise if the frequency or the running cost is not positive, or the target out of reach.

    Parameters
    ----------
    problem, guess
        A stack (s), and guesses along straight lines to the target.
    names : sequence of str
        Of the slow variables.
    there : (s) array of bool
        Problems whose start meets the target.
    first : int
        Place of the first problem in the whole stack.
    """
    single = problem.model.slow == 1
    seen = slice(None) if single else slice(0, 1)
    stopped = ~(guess.frequency[:, seen] > 0)
    if stopped.any():
        member, place = (int(i[0]) for i in np.nonzero(stopped))
        raise ArgumentValueError(
            f"omega must be positive along the whole trajectory, got {guess.frequency[member, place]:.6g} at "
            f"{point(names, guess.slow[member, place])}{which(problem, first + member)}",
            "omega",
        )
    idle = ~(guess.idle < 0)
    if idle.any():
        member = int(np.nonzero(idle)[0][0])
        kappa, rate = problem.kappa[member], -guess.idle[member]
        where = which(problem, first + member)
        if kappa:
            raise ArgumentValueError(
                f"kappa must be less than the mean running cost over omega, got {kappa:.6g}: the mean of the "
                f"running cost minus kappa omega is {rate:.6g} at the start{where}",
                "kappa",
            )
        raise ArgumentValueError(
            f"running_cost must be positive on average over a turn, got {rate:.6g} at the start{where}",
            "running_cost",
        )
    stuck = guess.stuck & ~there[:, None]
    if single and stuck.any():
        member, place = (int(i[0]) for i in np.nonzero(stuck))
        raise Infeasible(
            f"the target cannot be reached: at {point(names, guess.slow[member, place])} the mean drift "
            f"leads away from it, and no control outweighs the drift{which(problem, first + member)}"
        )


def point(names: Sequence[str], values: Array) -> str:
    """The slow variables and their values, in words."""
    return ", ".join(f"{name} = {value:.6g}" for name, value in zip(names, values, strict=True))


def which(problem: Problem, member: int) -> str:
    """Which problem of a stack is meant, in words."""
    return f" (problem {member} of the stack)" if len(problem.start) > 1 else ""
