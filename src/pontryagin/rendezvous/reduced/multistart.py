"""Many initial costates of one rendezvous: the ends of their extremals, and Newton's method from each."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pontryagin.arrays import Array
from pontryagin.errors import ArgumentValueError, NotConverged
from pontryagin.numerics.complex_step import jacobian
from pontryagin.numerics.newton_stack import Evaluated, newton_stack
from pontryagin.numerics.rotation import product
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.estimate import require_rendezvous
from pontryagin.rendezvous.problem.rendezvous import Rendezvous
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.reduced.conditions import SEEN, Setting
from pontryagin.rendezvous.reduced.flights import (
    Flights,
    fly_all,
)
from pontryagin.rendezvous.reduced.search_log import Search
from pontryagin.rendezvous.reduced.shooting import meet
from pontryagin.rendezvous.reduced.solution import (
    Extremal,
    distinct,
)
from pontryagin.validation import positive, vectors
from pontryagin.value import value_class

ITERATIONS, HALVINGS = 30, 6
FAINT = 1e-8
"""Value set for nu3 where nu is 0 and has no direction; the derivatives change by as much."""
NEAR = 1e-8
"""Residual below which Newton's method for a single flight takes over."""


@value_class
@dataclass(frozen=True, eq=False)
class Carried:
    """The ends of extremals with given initial costates.

    Attributes
    ----------
    reached : (...) array of bool
        Whether the extremal could be followed to its end; where not, its other rows hold nan.
    state : (..., 8) array
        r, v1, c, phi* and lambda (four numbers) at the end, in the user's units.
    costate : (..., 6) array
        rho, s1, e, nu1, nu2, nu3 at the end, in the user's units of the cost over those of the state.
    miss : (..., 6) array
        r - r*, v1 - v1*, c - c* of (5) in units with p* = c* = fM = 1, and vect(lambda~ o lambda*) of (6).
    slopes : (..., 6, 6) array
        Derivatives of the miss in the costates at t0, by the variational equations.
    switches : (...) array of int
        Number of times that the thrust met its bound or left it.

    Examples
    --------
    >>> import math
    >>> from pontryagin.rendezvous import Chaser, Orbit, Rendezvous, carry
    >>> target = Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6)
    >>> leap = Rendezvous(Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]), target, time_weight=0, energy_weight=1,
    ...                   peak=math.inf, duration=6.0)
    >>> there = carry(leap, np.zeros((2, 3, 6)))
    >>> there.state.shape, there.slopes.shape, int(there.switches.max())
    ((2, 3, 8), (2, 3, 6, 6), 0)
    """

    reached: NDArray[np.bool_]
    state: Array
    costate: Array
    miss: Array
    slopes: Array
    switches: NDArray[np.int64]


def carry(problem: Rendezvous, costates: ArrayLike, durations: ArrayLike | None = None) -> Carried:
    """Integrate many extremals, (2), (8)-(14), from their costates at t0 to their ends.

    Switches of the thrust are included.

    Parameters
    ----------
    problem : Rendezvous
        The problem, which gives the start, the bound, the weights and the target.
    costates : (..., 6) array_like
        rho, s1, e, nu1, nu2, nu3 at t0, in the user's units of the cost over those of the state.
    durations : (...) array_like, optional
        The duration of each; by default the problem's own fixed duration.

    Returns
    -------
    Carried
        The ends, one row for each start.

    Raises
    ------
    ValueError, TypeError
        If an argument is not as above; the message names it.

    Examples
    --------
    >>> import math
    >>> from pontryagin.rendezvous import Chaser, Orbit, Rendezvous, solve
    >>> target = Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6)
    >>> leap = Rendezvous(Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]), target, time_weight=0, energy_weight=1,
    ...                   peak=math.inf, duration=6.0)
    >>> costate = solve(leap).initial_costate
    >>> there = carry(leap, [costate, 2 * costate])
    >>> there.reached.tolist(), bool(np.abs(there.miss[0]).max() < 1e-12), there.slopes.shape
    ([True, True], True, (2, 6, 6))
    """
    require_rendezvous(problem)
    scaled = problem.scaled
    given = vectors("costates", costates, 6)
    given_durations = problem.duration if durations is None else durations
    if given_durations is None:
        raise ArgumentValueError(
            "durations must be given where the duration of the problem is free, got None", "durations"
        )
    ends_at = positive("durations", given_durations)
    try:
        shape = np.broadcast_shapes(given.shape[:-1], ends_at.shape)
    except ValueError:
        raise ArgumentValueError(
            f"durations must be one number or of shape {given.shape[:-1]} like the costates, "
            f"got shape {ends_at.shape}",
            "durations",
        ) from None
    inside = _directed(np.broadcast_to(given / scaled.costate_units, (*shape, 6)).reshape(-1, 6))
    times = np.broadcast_to(ends_at / scaled.time, shape).ravel()
    with np.errstate(all="ignore"):  # flights of too large costates overflow; `reached` marks them
        flights = fly_all(scaled, inside, times, scaled.peak, scaled.ratio == np.inf)
    miss, slopes = misses(scaled, flights)
    speed = scaled.length / scaled.time
    units = np.array([scaled.length, speed, scaled.length * speed, 1.0])
    attitude = product(problem.chaser.attitude, relative_attitude(flights))
    state = np.hstack([flights.ends[:, :4] * units, attitude])
    reached = flights.reached & np.isfinite(slopes).all(axis=(1, 2))
    for rows in (state, miss, slopes):
        rows[~reached] = np.nan
    return Carried(
        reached.reshape(shape),
        state.reshape(*shape, 8),
        (flights.ends[:, 4:10] * scaled.costate_units).reshape(*shape, 6),
        miss.reshape(*shape, 6),
        (slopes / scaled.costate_units).reshape(*shape, 6, 6),
        flights.switches.reshape(shape),
    )


def _directed(costates: Array) -> Array:
    """Costates with a small nu along i3 where nu is 0, so that chi has an axis; the flight is the same."""
    given = np.array(costates)
    given[~given[:, 3:].any(axis=1), 5] = FAINT
    return given


def relative_attitude(flights: Flights) -> Array:
    """lambda0~ o lambda at the ends, (k, 4)."""
    inputs = [*flights.costates.T[3:], *flights.ends.T[7:11], flights.charts]
    with np.errstate(all="ignore"):  # the ends of failed flights are nan
        return np.stack(kernels.attitude(*inputs), axis=-1)


def misses(scaled: Scaled, flights: Flights) -> tuple[Array, Array]:
    """Residuals of (5), (6) at the ends, (k, 6), and their derivatives in the costates at t0, (k, 6, 6)."""
    assert flights.slopes is not None
    count = len(flights.ends)
    with np.errstate(all="ignore"):
        values = kernels.target(flights.ends[:, 3], 1.0, scaled.eccentricity, 1.0, *scaled.orientation)
    goal = np.delete(np.array([np.broadcast_to(value, count) for value in values]), 3, axis=0)
    inputs = np.vstack([flights.ends.T[SEEN], flights.costates.T[3:]])
    with np.errstate(all="ignore"):  # nu may be in the singular direction of its chart
        values, missed = jacobian(lambda x: kernels.mismatch(*[*x, flights.charts, *goal]), inputs)
    by_input = np.moveaxis(missed, -1, 0)
    slopes = by_input[..., :7] @ flights.slopes[:, SEEN, :6]
    slopes[..., 3:] += by_input[..., 7:]
    return values.T, slopes


def multistart(problem: Rendezvous, costates: ArrayLike) -> tuple[Extremal, ...]:
    """The extremals of a fixed duration that Newton's method reaches from many starts, cheapest first.

    All flights are integrated together; each start takes its own step, halved while the miss does not fall.

    Parameters
    ----------
    problem : Rendezvous
        A problem with a fixed duration.
    costates : (k, 6) array_like
        Starts: rho, s1, e, nu1, nu2, nu3 at t0, in the user's units of the cost over those of the state.

    Returns
    -------
    tuple of Extremal
        Each extremal once; empty if none was reached. `searched` of the first one counts the failed starts.

    Raises
    ------
    ValueError, TypeError
        If an argument is not as above; the message names it.

    Examples
    --------
    >>> import math
    >>> from pontryagin.rendezvous import Chaser, Orbit, Rendezvous
    >>> target = Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6)
    >>> leap = Rendezvous(Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]), target, time_weight=0, energy_weight=1,
    ...                   peak=math.inf, duration=6.0)
    >>> starts = 0.1 * np.random.default_rng(1).standard_normal((8, 6))
    >>> round(multistart(leap, starts)[0].cost, 6)
    0.023882
    """
    require_rendezvous(problem)
    if problem.duration is None:
        raise ArgumentValueError(
            "problem must have a fixed duration, got one whose duration is free", "problem"
        )
    starts = vectors("costates", costates, 6)
    if starts.ndim != 2:
        raise ArgumentValueError(f"costates must be an array (k, 6), got shape {starts.shape}", "costates")
    scaled = problem.scaled
    setting = Setting(scaled, scaled.ratio, scaled.peak, duration=scaled.duration)
    ends, sizes = newton_from_all(setting, _directed(starts / scaled.costate_units))
    found: list[Extremal] = []
    for unknowns in ends[sizes < NEAR]:
        try:
            found.append(Extremal(problem, meet(setting, unknowns)))
        except NotConverged:
            continue
    best, *others = distinct(found) or (None,)
    if best is None:
        return ()
    lost = f"no meeting was reached from {len(starts) - len(found)} of the {len(starts)} starts"
    searched = Search(durations=(setting.duration or 0.0,), given_up=(lost,))
    return (replace(best, others=tuple(others), searched=searched), *others)


def newton_from_all(setting: Setting, starts: Array) -> tuple[Array, Array]:
    """Newton's method with halved steps from the starts (k, 6): final costates and sizes of the residual.

    The size is inf where not even the flight of the start can be integrated.
    """

    def evaluate(_: NDArray[np.intp], costates: Array) -> Evaluated:
        duration = setting.duration or 0.0
        flights = fly_all(setting.scaled, costates, duration, setting.peak, setting.bang)
        miss, slopes = misses(setting.scaled, flights)
        lost = ~(flights.reached & np.isfinite(slopes).all(axis=(1, 2)))
        miss[lost] = np.nan
        return Evaluated(miss, slopes)

    found = newton_stack(evaluate, starts, tolerance=NEAR, iterations=ITERATIONS, halvings=HALVINGS)
    return found.unknowns, found.residual
