"""The exact systems on which the set theory of sections 2 to 6 is checked."""

import functools

from pontryagin.orbit_correction.derivation.exact import ExactSystem, exact_system


@functools.cache
def family() -> tuple[ExactSystem, ...]:
    """Nonstationary systems in 2 to 5 dimensions, three or four steps each."""
    return tuple(exact_system(n, steps, seed=n) for n, steps in ((2, 4), (3, 3), (4, 3), (5, 3)))


def named(system: ExactSystem) -> str:
    """The system in words."""
    return f"n = {system.psi0.shape[0]}, N = {system.steps}"
