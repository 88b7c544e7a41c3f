"""What the correction and the exact problem need of an averaged extremal, which is regular at the target."""

from typing import TYPE_CHECKING, Protocol

from numpy.typing import ArrayLike

from pontryagin.arrays import Array

if TYPE_CHECKING:
    from pontryagin.averaging.system.phase_system import PhaseSystem


class ReferenceExtremal(Protocol):
    """An averaged extremal about which exact ones are sought; its members are those of `AveragedSolution`."""

    @property
    def system(self) -> "PhaseSystem":
        """The system in these variables."""

    @property
    def numbers(self) -> tuple[Array, ...]:
        """Values of the system's numbers, (...) each."""

    @property
    def duration(self) -> Array:
        """tau_1, (...)."""

    @property
    def cost(self) -> Array:
        """J_0, (...)."""

    @property
    def start(self) -> Array:
        """a_0, (..., n)."""

    @property
    def multipliers(self) -> Array:
        """alpha of the target's conditions, (..., r)."""

    @property
    def turn(self) -> tuple[float, ...]:
        """Ends of cells of a turn that hold narrow features of the system; empty if there are none."""

    def slow(self, tau: ArrayLike) -> Array:
        """xi at slow times (k,) or (..., k), as (..., k, n)."""

    def costate(self, tau: ArrayLike) -> Array:
        """eta at slow times (k,) or (..., k), as (..., k, n)."""
