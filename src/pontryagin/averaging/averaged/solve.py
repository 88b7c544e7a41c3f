"""The solver of the first approximation: from a system, or its compiled average, to an `AveragedSolution`."""

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.certificate import ENTRIES, AveragedCertificate
from pontryagin.averaging.averaged.extremals import extremals
from pontryagin.averaging.averaged.solution import AveragedSolution
from pontryagin.averaging.system.model import Model
from pontryagin.errors import ArgumentTypeError
from pontryagin.validation import angles, common_shape, finite, vectors

if TYPE_CHECKING:
    from pontryagin.averaging.averaged.reference import ReferenceExtremal
    from pontryagin.averaging.system.phase_system import PhaseSystem


def solve_averaged(system: "PhaseSystem", start: ArrayLike, *, kappa: ArrayLike = 0.0) -> AveragedSolution:
    """Solve the averaged boundary value problem (2.11), (2.4), (2.12) for the free end time.

    The search starts from a guess along the straight line to the target; where that fails, it continues the
    extremals to nearer levels of the target. The extremal found is normal (the costate of the cost is -1) and
    satisfies the necessary conditions; if a system has several averaged extremals, the others are not sought.
    At kappa = 0 it is the first approximation to the optimum, (2.17). Controls may switch within a turn;
    extremals whose controls switch in slow time, or are singular, are not found.

    Features of the system that are narrower than the spacing of points are looked for: its functions are
    enclosed in disc arithmetic along the whole extremal and over the whole turn. This shows the frequency and
    the weight to be positive, and where a function has a narrow feature the problem is solved again with it.
    What could not be decided is told by ``certificate.unresolved``, a share of the way or of a turn.

    Parameters
    ----------
    system : PhaseSystem
        Its numbers may be arrays.
    start : (..., n) array
        a_0; leading axes, with those of the numbers and of kappa, make a stack of problems.
    kappa : (...) array
        Parameter of the family (2.11): zero for the optimum, other values for its other members.

    Raises
    ------
    ValueError
        If the frequency or the weight is not positive along the whole way, the running cost is not positive
        on average, or an input is not finite or wrongly shaped.
    Infeasible
        If the target cannot be reached: the mean drift leads away from it, and no control outweighs it.
    NotConverged
        If no extremal was found, with the residual of the equations or the distance left to the target.

    Examples
    --------
    The rotating pendulum of `PhaseSystem` is sped up from the energy 2 to 5:

    >>> import sympy as sp
    >>> from pontryagin.averaging import PhaseSystem, Quadratic, solve_averaged
    >>> a, x, u = sp.symbols("a x u", real=True)
    >>> speed = sp.sqrt(2 * (a + sp.cos(x)))
    >>> pendulum = PhaseSystem(f=[speed * (u - speed / 5)], anomaly_rate=speed, control_set=Quadratic(),
    ...                        slow=[a], control=[u], phase=x, target=[a - 5])
    >>> solution = solve_averaged(pendulum, [2.0])
    >>> solution.certificate.holds(1e-10)
    True
    """
    from pontryagin.averaging.system.phase_system import PhaseSystem

    if not isinstance(system, PhaseSystem):
        raise ArgumentTypeError(f"system must be a PhaseSystem, got {system!r}", "system")
    begin = vectors("start", start, len(system.slow))
    names = tuple(str(symbol) for symbol in system.slow)
    numbers = tuple(np.asarray(value) for value in system.numbers.values())
    return solved(
        system.model,
        names,
        begin,
        numbers,
        partial(_identity, system),
        kappa=kappa,
    )


def solved(
    model: Model,
    names: tuple[str, ...],
    start: Array,
    numbers: tuple[Array, ...],
    make_system: Callable[[], "PhaseSystem"],
    *,
    kappa: ArrayLike = 0.0,
    initial_phase: ArrayLike = 0.0,
    frame: Callable[[AveragedSolution], "ReferenceExtremal"] | None = None,
) -> AveragedSolution:
    """Solve a problem given by its kernels; start (..., n) and the numbers broadcast."""
    family = finite("kappa", kappa, "a number or an array (...)")
    phase = angles("initial_phase", initial_phase, "a number or an array (...)")
    shape = common_shape(
        start=start.shape[:-1],
        numbers=np.broadcast_shapes(*(number.shape for number in numbers)),
        kappa=family.shape,
        initial_phase=phase.shape,
    )
    n = len(names)
    each = [np.broadcast_to(number, shape) for number in (*numbers, family)]
    begin = np.broadcast_to(start, (*shape, n))
    *flat_numbers, flat_kappa = (number.reshape(-1) for number in each)
    found = extremals(model, names, begin.reshape(-1, n), tuple(flat_numbers), flat_kappa)
    residuals = (getattr(found.certificate, entry) for entry in ENTRIES)
    return AveragedSolution(
        duration=found.duration.reshape(shape),
        cost=found.cost.reshape(shape),
        start=begin,
        multipliers=found.multipliers.reshape(*shape, model.target),
        kappa=each[-1],
        certificate=AveragedCertificate(*(residual.reshape(shape) for residual in residuals)),
        names=names,
        initial_phase=np.broadcast_to(phase, shape),
        numbers=tuple(each[:-1]),
        model=model.with_turn(found.turn),
        edges=found.edges.reshape(*shape, -1),
        series=found.series.reshape(*shape, *found.series.shape[1:]),
        make_system=make_system,
        frame=frame,
    )


def _identity(system: "PhaseSystem") -> "PhaseSystem":
    return system
