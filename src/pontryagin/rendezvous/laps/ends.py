"""What a transcription needs to know of a transfer: its ends and its Hamiltonian in some coordinates."""

from typing import Protocol

from pontryagin.arrays import Array
from pontryagin.rendezvous.laps.hamiltonian import Cost, Hamiltonian


class Ends(Protocol):
    """The ends of a transfer in coordinates (6,); nodes are coordinates and their costates, (12, ...)."""

    @property
    def start(self) -> Array:
        """The craft at t0."""

    def meeting(self, duration: float) -> tuple[Array, Array]:
        """The target after a time, and the rates of its coordinates."""

    def hamiltonian(self, cost: Cost, nodes: Array, price: float) -> Hamiltonian:
        """K, which vanishes along extremals, with its derivatives at nodes (12, n)."""

    def square(self, nodes: Array) -> Array:
        """|n|^2 at nodes."""

    def weight(self, nodes: Array) -> Array:
        """dt/ds at nodes."""

    def admissible(self, nodes: Array) -> bool:
        """Whether nodes keep away from where the coordinates are singular."""
