"""Solve a rendezvous in Sapunkov's elements for the first functional, alpha1 + alpha2 p^2.

It is solved first without a bound on the thrust, then with it, and for least time with alpha2 = 0.
"""

import math

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import Infeasible, NotConverged
from pontryagin.rendezvous.elements.conditions import ElementsSetting
from pontryagin.rendezvous.elements.elements import place_gradient
from pontryagin.rendezvous.elements.flight import ElementFlight, basis, start_of
from pontryagin.rendezvous.elements.law import Law
from pontryagin.rendezvous.elements.shooting import SHOOTING, meet
from pontryagin.rendezvous.elements.solution import ElementsExtremal
from pontryagin.rendezvous.elements.space import in_space
from pontryagin.rendezvous.elements.start import unbounded
from pontryagin.rendezvous.estimate import require_solvable
from pontryagin.rendezvous.families import bounded, loose_ratios
from pontryagin.rendezvous.problem.rendezvous import Rendezvous
from pontryagin.rendezvous.reduced.quadrature import half_anomaly
from pontryagin.rendezvous.reduced.solution import Extremal, require_extremal
from pontryagin.rendezvous.root import Root
from pontryagin.rendezvous.witness.cartesian import start_of as cartesian_start
from pontryagin.validation import integer


def solve_in_elements(
    problem: Rendezvous, start: Extremal | None = None, revolutions: int = 0
) -> ElementsExtremal:
    """A rendezvous of least integral of alpha1 + alpha2 p^2 in Sapunkov's elements, his (1).

    The elements of the goal are moved from the craft's to the target's; then a free duration is changed until
    the terminal law holds, and the bound is lowered. Unlike `solve`, it follows one family of extremals only.
    If that ends before, the first extremal that a path in space leads to is taken; such a path may lose its
    angular momentum on the way, as between planes of opposite senses, where `solve` has no variables.

    Parameters
    ----------
    problem : Rendezvous
        The problem to be solved.
    start : Extremal, optional
        A solution by `solve`. Newton's method then starts from its costates, converted to those of A and B.
    revolutions : int
        Revolutions in addition to the number nearest to that of the coasting craft; not used with ``start``.

    Returns
    -------
    ElementsExtremal
        The extremal at the end of the family.

    Raises
    ------
    TypeError
        If ``problem`` is not a `Rendezvous`, ``start`` not an `Extremal`, or ``revolutions`` not an integer.
    ValueError
        If the duration is free and the craft is with the target at the start.
    Infeasible
        If the duration is free and costs nothing (``time_weight=0``).
    NotConverged
        If the family turns back or ends before it reaches the given problem.

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
    require_solvable(problem)
    integer("revolutions", revolutions)
    scaled = problem.scaled
    setting = ElementsSetting(scaled, Law("square", scaled.ratio, scaled.peak), scaled.duration)
    if start is not None:
        require_extremal("start", start)
        return ElementsExtremal(problem, meet(setting, carried(start)), scaled.value)
    return ElementsExtremal(problem, _extremal(setting, revolutions), scaled.value)


def carried(start: Extremal) -> Array:
    """The unknowns (7,) for a solution by `solve`: its costates as those of A and B, and phi at the end.

    With M the derivative of R and V in A and B, a and b are M' psi.

    Raises
    ------
    Infeasible
        If the start flies through a parabola or a hyperbola, where A and B do not exist.
    """
    flight = start.flight
    craft = start_of(flight.scaled)
    costates = basis(craft).T @ place_gradient(craft).T @ cartesian_start(flight)[6:]
    phi = half_anomaly(flight)
    if math.isnan(phi):
        raise Infeasible(
            "start must stay on osculating ellipses, got a flight through a parabola or a hyperbola, on "
            "which the elements A and B do not exist",
            "start",
        )
    return np.append(costates, phi)


def _extremal(setting: ElementsSetting, revolutions: int) -> Root[ElementFlight]:
    """The extremal that the families reach; for least time from the first unbounded problem that succeeds."""
    reason: NotConverged | None = None
    for ratio in loose_ratios(setting.ratio, setting.peak):
        loose = setting.replace(ratio=ratio, peak=math.inf)
        try:
            return bounded(SHOOTING, setting, loose, unbounded(loose, revolutions))
        except NotConverged as failure:
            reason = reason or failure
    if revolutions == 0:
        for unknowns in in_space(setting.scaled):
            try:
                return meet(setting, unknowns)
            except NotConverged:
                continue
    raise reason or NotConverged("no extremal was found", float("inf"))
