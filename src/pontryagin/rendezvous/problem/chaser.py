"""The state of the craft under control at the start, (4)."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.rendezvous.problem.checks import number, unit_quaternion
from pontryagin.value import value_class


@value_class
@dataclass(frozen=True, eq=False)
class Chaser:
    """The place and the velocity of the craft at t0, (4).

    Parameters
    ----------
    r : float
        Distance from the centre of attraction, in units of length; positive.
    v1 : float
        Radial velocity, in units of length over time.
    c : float
        Areal constant |R x V|, in units of length squared over time; positive.
    attitude : (4,) array_like
        lambda, the unit quaternion of the axes eta (first along R, third along R x V) in inertial axes,
        scalar part first.

    Raises
    ------
    ValueError, TypeError
        If an argument is not as above; the message names it.

    Examples
    --------
    >>> Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]).r
    1.0
    """

    r: float
    v1: float
    c: float
    attitude: Array

    if TYPE_CHECKING:

        def __init__(self, r: float, v1: float, c: float, attitude: ArrayLike) -> None: ...

    def __post_init__(self) -> None:
        checked = {
            "r": number("r", self.r, 0.0, excluded=True),
            "v1": number("v1", self.v1),
            "c": number("c", self.c, 0.0, excluded=True),
            "attitude": unit_quaternion("attitude", self.attitude),
        }
        for name, value in checked.items():
            object.__setattr__(self, name, value)
