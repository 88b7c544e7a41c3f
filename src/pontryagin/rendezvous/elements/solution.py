"""A rendezvous solved in Sapunkov's elements: the first functional, alpha1 + alpha2 p^2."""

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.errors import Infeasible, NotConverged
from pontryagin.numerics.rotation import conjugate, product, rotated
from pontryagin.rendezvous.elements.certificate import (
    ElementsCertificate,
    certify,
)
from pontryagin.rendezvous.elements.elements import (
    Elements,
    place_gradient,
)
from pontryagin.rendezvous.elements.flight import (
    ElementFlight,
    basis,
    start_of,
    switching,
)
from pontryagin.rendezvous.elements.law import Law
from pontryagin.rendezvous.elements.shooting import (
    Root,
    Setting,
    follow,
    newton,
)
from pontryagin.rendezvous.elements.start import (
    energy,
    marched,
)
from pontryagin.rendezvous.problem.rendezvous import Rendezvous
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.reduced.first_extremal import (
    first_duration,
    require_apart,
)
from pontryagin.rendezvous.reduced.quadrature import half_anomaly
from pontryagin.rendezvous.reduced.search import END_SHARES
from pontryagin.rendezvous.reduced.solution import (
    Extremal,
    require_extremal,
)
from pontryagin.rendezvous.witness.cartesian import start_of as cartesian_start
from pontryagin.validation import integer, times

DOUBLINGS = 12
"""Of alpha1/alpha2 on the way to least time."""


@dataclass(frozen=True, eq=False)
class ElementsExtremal:
    """A rendezvous in the elements that satisfies the maximum principle.

    Attributes
    ----------
    problem : Rendezvous
        What was asked for.
    root : Root
        The meeting in the solver's units.
    value : float
        The unit of the cost.
    smoothed : tuple of Root
        Extremals with the thrust's jump smoothed, by falling width, that led here; of `least_fuel` alone.

    Examples
    --------
    >>> import math
    >>> from pontryagin.rendezvous import Chaser, Orbit, Rendezvous, solve_in_elements
    >>> target = Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6)
    >>> leap = Rendezvous(Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]), target, time_weight=0, energy_weight=1,
    ...                   peak=math.inf, duration=6.0)
    >>> found = solve_in_elements(leap)
    >>> found.elements([0.0, 6.0]).A.shape, found.control([0.0, 6.0]).shape, found.switch_times.shape
    ((2, 4), (2, 3), (0,))
    """

    problem: Rendezvous
    root: Root = field(repr=False)
    value: float = field(repr=False)
    smoothed: tuple[Root, ...] = field(default=(), repr=False)

    @property
    def flight(self) -> ElementFlight:
        """The extremal in the solver's units and in the axes eta of t0."""
        return self.root.flight

    @property
    def duration(self) -> float:
        """t_k, in the user's unit of time."""
        fixed = self.problem.duration
        return self.flight.duration * self.problem.scaled.time if fixed is None else fixed

    @property
    def cost(self) -> float:
        """The integral of alpha1 + alpha2 p^2, or of alpha1 + alpha2 |p|."""
        return self.flight.cost * self.value

    @property
    def switch_times(self) -> Array:
        """Where the thrust meets its bound or leaves it, or goes on or off, (k,)."""
        return self.flight.switch_times * self.problem.scaled.time

    @property
    def modes(self) -> tuple[str, ...]:
        """ "unsaturated", "saturated" or "coast" for each arc between the switches."""
        return tuple(piece.mode for piece in self.flight.pieces)

    @cached_property
    def certificate(self) -> ElementsCertificate:
        """Every condition of the maximum principle evaluated anew; see `ElementsCertificate`."""
        return certify(self.root, self.problem.free)

    def _sampled(self, t: ArrayLike) -> tuple[Array, Array]:
        """phi (..., k) and the states (..., k, n) at the times t."""
        inside = times("t", t, np.array(0.0), np.array(self.duration)) / self.problem.scaled.time
        grid, back = np.unique(np.clip(inside, 0.0, self.flight.duration), return_inverse=True)
        phi = self.flight.angle_at(grid)
        return phi[back], self.flight.sample(phi)[back]

    def elements(self, t: ArrayLike) -> Elements:
        """A, B and phi at the times t (..., k), of the inertial axes, in the user's units."""
        scaled = self.problem.scaled
        phi, states = self._sampled(t)
        back = conjugate(self.problem.chaser.attitude)
        A, B = (math.sqrt(scaled.length) * product(states[..., i : i + 4], back) for i in (0, 4))
        return Elements(A, B, phi, self.problem.gravity)

    def _inertial(self, vectors: Array) -> Array:
        return rotated(vectors, np.broadcast_to(self.problem.chaser.attitude, (*vectors.shape[:-1], 4)))

    def control(self, t: ArrayLike) -> Array:
        """p in inertial axes at the times t (..., k), (..., k, 3)."""
        phi, _ = self._sampled(t)
        order, back = np.unique(phi, return_inverse=True)
        thrust = self.flight.thrust(self.flight.sample(order), order)[back]
        return self._inertial(thrust) * self.problem.scaled.acceleration

    def switching(self, t: ArrayLike) -> Array:
        """n in inertial axes at the times t (..., k), (..., k, 3), in units of the cost over velocity."""
        phi, states = self._sampled(t)
        scaled = self.problem.scaled
        return self._inertial(switching(states, phi)) * (self.value * scaled.time / scaled.length)


def solve_in_elements(
    problem: Rendezvous, start: Extremal | None = None, revolutions: int = 0
) -> ElementsExtremal:
    """A rendezvous of least integral of alpha1 + alpha2 p^2 in Sapunkov's elements, his (1).

    The elements of the goal are led from the craft's to the target's; then the duration is changed until the
    terminal law holds, and the bound lowered. One family of extremals is followed; `solve` looks at several.

    Parameters
    ----------
    problem : Rendezvous
        What is to be solved.
    start : Extremal, optional
        A solution by `solve`; its costates, carried over to A and B, are then where Newton's method starts.
    revolutions : int
        How many more than the number nearest to what the craft would make coasting; without ``start``.

    Returns
    -------
    ElementsExtremal
        The one extremal that the family leads to.

    Raises
    ------
    TypeError
        If ``problem`` is no `Rendezvous`, ``start`` no `Extremal`, or ``revolutions`` no integer.
    ValueError
        If the duration is free and the craft is with the target at the start.
    Infeasible
        If the duration is free and costs nothing (``time_weight=0``).
    NotConverged
        If the family turns back or ends before the problem asked for.

    Examples
    --------
    >>> import math
    >>> from pontryagin.rendezvous import Chaser, Orbit, Rendezvous, solve_in_elements
    >>> target = Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6)
    >>> leap = Rendezvous(Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]), target, time_weight=0, energy_weight=1,
    ...                   peak=math.inf, duration=6.0)
    >>> found = solve_in_elements(leap)
    >>> round(found.cost, 6), found.certificate.holds(1e-10)
    (0.023882, True)
    """
    require(problem)
    integer("revolutions", revolutions)
    scaled = problem.scaled
    law = Law("square", scaled.ratio, scaled.peak)
    if start is not None:
        require_extremal("start", start)
        return ElementsExtremal(
            problem, newton(Setting(scaled, law, scaled.duration), carried(start)), scaled.value
        )
    return ElementsExtremal(problem, _found(scaled, law, revolutions), scaled.value)


def require(problem: Rendezvous) -> None:
    """Raise unless it is a rendezvous that has a best duration.

    Raises
    ------
    TypeError
        If it is none.
    Infeasible
        If the duration is free and costs nothing.
    ValueError
        If it is free and the craft is with the target at the start.
    """
    if not isinstance(problem, Rendezvous):
        raise TypeError(f"problem must be of type Rendezvous, got {problem!r}")
    if problem.free and problem.time_weight == 0:
        raise Infeasible(
            "time_weight is 0 and the duration is free: a longer flight is always cheaper, so that there is "
            "no best one; fix the duration, or give time_weight a positive value"
        )
    if problem.free:
        require_apart(problem.scaled)


def carried(start: Extremal) -> Array:
    """A solution's costates as those of A and B, and phi at its end: the unknowns (7,).

    With M the derivative of R and V in A and B, a and b are M' psi.

    Raises
    ------
    Infeasible
        Where the start leaves the ellipses.
    """
    flight = start.flight
    craft = start_of(flight.scaled)
    costates = basis(craft).T @ place_gradient(craft).T @ cartesian_start(flight)[6:]
    phi = half_anomaly(flight)
    if math.isnan(phi):
        raise Infeasible(
            "start flies through a parabola or a hyperbola, on which the elements A and B do not exist"
        )
    return np.append(costates, phi)


def _found(scaled: Scaled, law: Law, revolutions: int) -> Root:
    if not law.bang:
        return bounded(scaled, law, _loose(scaled, law.ratio, revolutions))
    reason: NotConverged | None = None
    for share in END_SHARES:
        mixed = law.but(ratio=(share * law.peak) ** 2)
        try:
            root = bounded(scaled, mixed, _loose(scaled, mixed.ratio, revolutions))
            return _least_time(scaled, mixed, root)
        except NotConverged as failure:
            reason = reason or failure
    raise reason or NotConverged("no extremal was reached", float("inf"))


def _loose(scaled: Scaled, ratio: float, revolutions: int) -> Root:
    """The extremal without bound."""
    law = Law("square", ratio, np.inf)
    if scaled.duration is not None:
        root = energy(scaled, scaled.duration, revolutions)
        return newton(Setting(scaled, law, scaled.duration), root.unknowns)
    return marched(scaled, law, energy(scaled, first_duration(scaled, ratio), revolutions))


def bounded(scaled: Scaled, law: Law, root: Root) -> Root:
    """The bound lowered from the largest thrust to p_max."""
    highest = 1.001 * largest_thrust(root.flight)
    if highest < law.peak:
        return newton(Setting(scaled, law, scaled.duration), root.unknowns)

    def family(logarithm: float) -> Setting:
        return Setting(scaled, law.but(peak=math.exp(logarithm)), scaled.duration)

    return follow(family, root, math.log(highest), math.log(law.peak))


def largest_thrust(flight: ElementFlight) -> float:
    """Largest |p| on a fine grid."""
    grid = np.linspace(0, flight.phi, 200 + int(40 * flight.phi))
    return float(np.linalg.norm(flight.thrust(flight.sample(grid), grid), axis=1).max())


def _least_time(scaled: Scaled, mixed: Law, root: Root) -> Root:
    """alpha1/alpha2 raised until the thrust is saturated throughout; then alpha2 = 0."""

    def raised(ratio: float) -> Setting:
        return Setting(scaled, mixed.but(ratio=ratio))

    ratio = mixed.ratio
    for _ in range(DOUBLINGS):
        if [piece.mode for piece in root.flight.pieces] == ["saturated"]:
            law = mixed.but(ratio=np.inf)
            scale = law.end_switching / mixed.but(ratio=ratio).end_switching
            return newton(Setting(scaled, law), root.unknowns * np.append(np.full(6, scale), 1.0))
        root, ratio = follow(raised, root, ratio, 2 * ratio), 2 * ratio
    raise NotConverged("the thrust is never saturated throughout", float("inf"))
