"""The cases of the report, by name.

Lengths and times are such that fM = 1 and the craft starts near r = 1, except for two cases in km and s.
Angles are in radians, but in degrees in the names.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from pontryagin.errors import ArgumentValueError
from pontryagin.numerics.rotation import about_third, product
from pontryagin.rendezvous.problem.chaser import Chaser
from pontryagin.rendezvous.problem.orbit import Orbit
from pontryagin.rendezvous.problem.rendezvous import Rendezvous

ONE = (1.0, 0.0, 0.0, 0.0)
"""The unit quaternion."""
SUN = 1.32712440018e11
"""fM of the Sun, km^3/s^2."""
EARTH = 398600.4418
"""fM of the Earth, km^3/s^2."""
DAY = 86400.0
"""A day in s."""
ASTRONOMICAL_UNIT = 1.495978707e8
"""The astronomical unit in km."""


@dataclass(frozen=True)
class Case:
    """A rendezvous of the report.

    Attributes
    ----------
    name : str
        The key of `cases`.
    title : str
        A description.
    problem : Rendezvous
        The problem.
    guess, revolutions : float
        Approximate duration and number of revolutions, for the cold start of the direct method.
    """

    name: str
    title: str
    problem: Rendezvous
    guess: float
    revolutions: float


@dataclass(frozen=True)
class FuelCase(Case):
    """A case of least fuel, in which alpha2 is the weight of |p|.

    Attributes
    ----------
    name, title, problem, guess, revolutions
        As for `Case`.
    more : int
        The argument `revolutions` of `least_fuel`: how many revolutions more than a coasting craft.
    """

    more: int = 0


def circle(radius: float = 1.0) -> Chaser:
    """A craft on a circular orbit, fM = 1."""
    return Chaser(radius, 0.0, math.sqrt(radius), ONE)


def chaser_on(orbit: Orbit, gravity: float = 1.0) -> Chaser:
    """A craft on a given orbit, at the anomaly of that orbit."""
    areal = math.sqrt(gravity * orbit.parameter)
    growth = 1 + orbit.eccentricity * math.cos(orbit.anomaly)
    radial = areal / orbit.parameter * orbit.eccentricity * math.sin(orbit.anomaly)
    attitude = product(orbit.attitude, about_third(orbit.anomaly))
    return Chaser(orbit.parameter / growth, radial, areal, attitude)


def _orbit(
    parameter: float, eccentricity: float, inclination: float, anomaly: float, node: float = 0.0
) -> Orbit:
    return Orbit.from_angles(parameter, eccentricity, node, math.radians(inclination), 0.0, anomaly)


def _to_circle() -> Case:
    problem = Rendezvous(circle(), _orbit(1.5, 0.0, 0, 0.8), peak=0.1)
    return Case("circle", "coplanar circle to circle, least time", problem, 6.0, 0.6)


def _to_circle_energy() -> Case:
    problem = Rendezvous(
        circle(), _orbit(1.5, 0.0, 0, 0.8), time_weight=0, energy_weight=1, peak=math.inf, duration=8.0
    )
    return Case("circle-energy", "coplanar circle to circle, least energy in fixed time", problem, 8.0, 0.8)


def _to_ellipse() -> Case:
    problem = Rendezvous(circle(), _orbit(1.5, 0.2, 0, 0.6), peak=0.1)
    return Case("ellipse", "coplanar circle to ellipse, least time", problem, 6.0, 0.6)


def _to_ellipse_mixed() -> Case:
    problem = Rendezvous(
        circle(), _orbit(1.5, 0.2, 0, 0.6), time_weight=0.002, energy_weight=1, peak=math.inf
    )
    return Case("ellipse-mixed", "coplanar circle to ellipse, mixed, without bound", problem, 14.0, 2.2)


def _inclined(degrees: int, guess: float, revolutions: float) -> Callable[[], Case]:
    def make() -> Case:
        problem = Rendezvous(circle(), _orbit(1.5, 0.1, degrees, 0.6), peak=0.1)
        return Case(
            f"inclined-{degrees}",
            f"circle to an ellipse inclined by {degrees}°, least time",
            problem,
            guess,
            revolutions,
        )

    return make


def _inclined_mixed() -> Case:
    problem = Rendezvous(
        circle(), _orbit(1.5, 0.1, 20, 0.6), time_weight=0.0036, energy_weight=1, peak=math.inf
    )
    return Case("mixed", "inclined by 20°, mixed, without bound", problem, 10.0, 1.0)


def _inclined_bounded() -> Case:
    problem = Rendezvous(circle(), _orbit(1.5, 0.1, 20, 0.6), time_weight=0.0036, energy_weight=1, peak=0.08)
    return Case("mixed-bounded", "inclined by 20°, mixed, the bound met", problem, 10.0, 1.0)


def _inclined_energy() -> Case:
    problem = Rendezvous(
        circle(), _orbit(1.5, 0.1, 60, 0.6), time_weight=0, energy_weight=1, peak=math.inf, duration=12.0
    )
    return Case("inclined-energy", "inclined by 60°, least energy in fixed time", problem, 12.0, 1.5)


def _bounded_energy() -> Case:
    problem = Rendezvous(
        circle(), _orbit(1.5, 0.1, 20, 0.6), time_weight=0, energy_weight=1, peak=0.08, duration=9.0
    )
    return Case(
        "energy-bounded", "inclined by 20°, least energy in fixed time, the bound met", problem, 9.0, 0.9
    )


def _ellipses() -> Case:
    craft = Orbit.from_angles(1.0, 0.3, 0.4, math.radians(10), 0.7, 0.5)
    target = Orbit.from_angles(1.4, 0.25, 0.1, math.radians(25), 2.0, 0.3)
    problem = Rendezvous(chaser_on(craft), target, peak=0.08)
    return Case("ellipses", "ellipse to ellipse, least time", problem, 7.0, 0.7)


def _mars() -> Case:
    """From the Earth to Mars, both on Kepler orbits, with a thrust of 0.6 mm/s^2."""
    unit, degree = ASTRONOMICAL_UNIT, math.pi / 180
    earth = Orbit.from_angles(unit * (1 - 0.0167**2), 0.0167, 0.0, 0.0, 102.9 * degree, 10 * degree)
    mars = Orbit.from_angles(
        1.5237 * unit * (1 - 0.0934**2), 0.0934, 49.6 * degree, 1.85 * degree, 286.5 * degree, 180 * degree
    )
    problem = Rendezvous(chaser_on(earth, SUN), mars, peak=0.6e-6, gravity=SUN)
    return Case("mars", "Earth to Mars, least time, km and s", problem, 350 * DAY, 0.7)


def _glonass() -> Case:
    """From a lower circle to an orbit like GLONASS's: r = 25507 km, inclined by 64.8 deg; 0.02 m/s^2."""
    degree = math.pi / 180
    start = Orbit.from_angles(21000.0, 0.0, 0.0, 60.0 * degree, 0.0, 0.0)
    target = Orbit.from_angles(25507.0, 0.001, 2.0 * degree, 64.8 * degree, 0.0, 40 * degree)
    problem = Rendezvous(chaser_on(start, EARTH), target, peak=2e-5, gravity=EARTH)
    return Case(
        "glonass", "a lower circle to an orbit like GLONASS's, least time, km and s", problem, 50000.0, 1.2
    )


MAKERS: tuple[Callable[[], Case], ...] = (
    _to_circle,
    _to_circle_energy,
    _to_ellipse,
    _to_ellipse_mixed,
    _inclined(1, 6.0, 0.6),
    _inclined(10, 6.0, 0.6),
    _inclined(30, 8.0, 0.8),
    _inclined(60, 12.0, 1.1),
    _inclined_energy,
    _inclined_mixed,
    _inclined_bounded,
    _bounded_energy,
    _ellipses,
    _mars,
    _glonass,
)


def leap() -> Rendezvous:
    """From a circle to an ellipse inclined by 20 degrees in the prescribed time 12, with a peak of 0.15."""
    return Rendezvous(
        circle(), _orbit(1.5, 0.1, 20, 0.6), time_weight=0, energy_weight=1, peak=0.15, duration=12.0
    )


def _fuel_coplanar() -> FuelCase:
    problem = replace(leap(), target=_orbit(1.5, 0.1, 0, 0.6), duration=6.0)
    return FuelCase("fuel", "coplanar, fixed time", problem, 6.0, 0.7)


def _fuel_free() -> FuelCase:
    problem = replace(_fuel_coplanar().problem, time_weight=0.01, duration=None)
    return FuelCase("fuel-free", "coplanar, free time, $\\alpha_1 = 0.01$", problem, 6.0, 0.7)


def _fuel_inclined() -> FuelCase:
    return FuelCase("fuel-inclined", "inclined by 20°, fixed time", leap(), 12.0, 1.2, more=-1)


def _fuel_ellipses() -> FuelCase:
    problem = replace(_ellipses().problem, duration=9.0, time_weight=0, energy_weight=1, peak=0.15)
    return FuelCase("fuel-ellipses", "ellipse to ellipse, fixed time", problem, 9.0, 0.9)


FUEL_MAKERS: tuple[Callable[[], FuelCase], ...] = (_fuel_coplanar, _fuel_free, _fuel_inclined, _fuel_ellipses)


def cases() -> dict[str, Case]:
    """All cases of the report, by name.

    Examples
    --------
    >>> len(cases()), cases()["mixed"].problem.peak
    (15, inf)
    """
    made = [make() for make in MAKERS]
    return {case.name: case for case in made}


def fuel_cases() -> dict[str, FuelCase]:
    """The cases of least fuel, by name.

    Examples
    --------
    >>> list(fuel_cases())
    ['fuel', 'fuel-free', 'fuel-inclined', 'fuel-ellipses']
    """
    made = [make() for make in FUEL_MAKERS]
    return {case.name: case for case in made}


def case(name: str) -> Case:
    """The case of a given name.

    Raises
    ------
    ValueError
        If there is no case of this name.

    Examples
    --------
    >>> case("mars").title
    'Earth to Mars, least time, km and s'
    """
    known = cases()
    if name not in known:
        raise ArgumentValueError(f"name must be one of {', '.join(known)}, got {name!r}", "name")
    return known[name]
