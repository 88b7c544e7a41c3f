"""The rendezvous: craft and target, the functional (7), the bound (1) on the thrust, the duration."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from pontryagin.errors import ArgumentTypeError, ArgumentValueError
from pontryagin.rendezvous.problem.chaser import Chaser
from pontryagin.rendezvous.problem.checks import number
from pontryagin.rendezvous.problem.orbit import Orbit
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.validation import TINY
from pontryagin.value import value_class


@value_class
@dataclass(frozen=True, eq=False)
class Rendezvous:
    """The problem (1)-(7): reach the target at the least integral of alpha1 + alpha2 p^2, |p| <= p_max.

    Lengths and times are in any consistent units.

    Parameters
    ----------
    chaser, target : Chaser, Orbit
        The craft under control and its target, both at t0 = 0.
    time_weight, energy_weight : float
        alpha1 and alpha2, neither negative nor both zero. With ``energy_weight=0`` the duration
        is minimised.
    peak : float
        p_max, in units of acceleration; ``math.inf`` for no bound, if ``energy_weight`` is positive.
    gravity : float
        fM, in units of length cubed over time squared; positive.
    duration : float, optional
        t_k, if it is prescribed. By default it is free.

    Raises
    ------
    ValueError, TypeError
        If an argument is not as above; the message names it.

    Examples
    --------
    >>> target = Orbit(1.5, 0.1, [1, 0, 0, 0], 0.6)
    >>> Rendezvous(Chaser(1.0, 0.0, 1.0, [1, 0, 0, 0]), target, peak=0.05).free
    True
    """

    chaser: Chaser
    target: Orbit
    time_weight: float = 1.0
    energy_weight: float = 0.0
    peak: float = 0.1
    gravity: float = 1.0
    duration: float | None = None

    def __post_init__(self) -> None:
        for name, kind in (("chaser", Chaser), ("target", Orbit)):
            if not isinstance(getattr(self, name), kind):
                value = getattr(self, name)
                raise ArgumentTypeError(f"{name} must be of type {kind.__name__}, got {value!r}", name)
        unbounded = isinstance(self.peak, float | np.floating) and self.peak == math.inf
        checked = {
            "time_weight": number("time_weight", self.time_weight, 0.0),
            "energy_weight": number("energy_weight", self.energy_weight, 0.0),
            "peak": math.inf if unbounded else number("peak", self.peak, 0.0, excluded=True),
            "gravity": number("gravity", self.gravity, 0.0, excluded=True),
        }
        if self.duration is not None:
            checked["duration"] = number("duration", self.duration, 0.0, excluded=True)
        for name, value in checked.items():
            object.__setattr__(self, name, value)
        self._check_consistency()
        self._check_sizes()

    def _check_consistency(self) -> None:
        """Refuse problems with nothing to minimise, and a craft that does not start on an ellipse."""
        if self.time_weight == 0 and self.energy_weight == 0:
            raise ArgumentValueError(
                "time_weight and energy_weight must not both be 0: nothing would be minimised then",
                "time_weight",
            )
        if self.energy_weight == 0 and self.peak == math.inf:
            raise ArgumentValueError("peak must be finite where energy_weight is 0, got inf", "peak")
        if self.energy_weight == 0 and self.duration is not None:
            raise ArgumentValueError(
                f"duration must be left free where energy_weight is 0, got {self.duration:g}: every control "
                "would cost the same",
                "duration",
            )
        craft = self.chaser
        with np.errstate(over="ignore"):
            energy = (np.square(craft.v1) + np.square(craft.c / craft.r)) / 2 - self.gravity / craft.r
        if energy >= 0:
            raise ArgumentValueError(
                "chaser must start on an ellipse, with the energy v1^2/2 + c^2/(2 r^2) - gravity/r negative, "
                f"got {energy:.6g}",
                "chaser",
            )

    def _check_sizes(self) -> None:
        """Refuse numbers that overflow or vanish in units of the target's orbit."""
        try:
            scaled = self.scaled
            r, v1, c = scaled.start.tolist()
            units = [scaled.time, scaled.acceleration, scaled.value, r, c]
            units += [] if scaled.duration is None else [scaled.duration]
            units += [] if self.peak == math.inf else [scaled.peak]
            units += [scaled.ratio] if self.time_weight and self.energy_weight else []
            # A radial speed that underflows is nothing beside c/r, which is at least 1e-154.
            sound = all(TINY <= abs(x) < math.inf for x in units) and abs(v1) < math.inf
        except (OverflowError, ZeroDivisionError):
            sound = False
        if not sound:
            raise ArgumentValueError(
                "parameter, gravity, the weights, the start and the duration must be of sizes that double "
                f"precision holds in units of the target's orbit, got parameter {self.target.parameter:g}, "
                f"gravity {self.gravity:g}, r {self.chaser.r:g}, v1 {self.chaser.v1:g}, c {self.chaser.c:g}"
            )

    @property
    def free(self) -> bool:
        """Whether the duration is free."""
        return self.duration is None

    @cached_property
    def scaled(self) -> Scaled:
        """The same problem in the solver's units."""
        return Scaled.of(
            self.chaser,
            self.target,
            self.time_weight,
            self.energy_weight,
            self.peak,
            self.gravity,
            self.duration,
        )
