"""The generated examples: averages that load without SymPy, and phase systems that need it."""

from collections.abc import Callable, Sequence
from dataclasses import MISSING, fields
from functools import cache, partial
from typing import TYPE_CHECKING, Any

from pontryagin.arrays import Array
from pontryagin.averaging import kernels
from pontryagin.averaging.system.model import Model

if TYPE_CHECKING:
    from pontryagin.averaging.system.phase_system import PhaseSystem


@cache
def example_model(name: str) -> Model:
    """The compiled average of an example: "smooth", "kepler" or "spin_down"."""
    slow, target = kernels.SIZES[name]
    given: dict[str, Any] = {"slow": slow, "target": target, "origin": partial(example_model, name)}
    functions = {
        f.name: getattr(kernels, f"{name}_{f.name}", None)
        for f in fields(Model)
        if f.name not in given and f.default is MISSING
    }
    return Model(**given | functions)


def example_system(name: str, numbers: Sequence[Array]) -> "PhaseSystem":
    """An example as a `PhaseSystem` with values of its numbers in their order; this loads SymPy."""
    from pontryagin.averaging.system import generated_systems

    build: Callable[..., PhaseSystem] = getattr(generated_systems, name)
    return build(*numbers)
