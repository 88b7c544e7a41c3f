"""Solutions of the first approximation, (2.17)."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from pontryagin.arrays import Array
from pontryagin.averaging.averaged.certificate import AveragedCertificate
from pontryagin.averaging.system.anomaly import anomaly_at, phase_at
from pontryagin.averaging.system.jets import evaluate
from pontryagin.averaging.system.model import Model
from pontryagin.certificate import ACCEPTED
from pontryagin.errors import ArgumentValueError, NotConverged
from pontryagin.numerics.collocation import evaluate as evaluate_series
from pontryagin.numerics.periodic_means import SOLVING
from pontryagin.numerics.rotation import within_a_turn
from pontryagin.validation import angles, finite, times
from pontryagin.value import value_class

if TYPE_CHECKING:
    from pontryagin.averaging.averaged.reference import ReferenceExtremal
    from pontryagin.averaging.exact.extremal import Extremals
    from pontryagin.averaging.system.phase_system import PhaseSystem

MOST_TURNS = 100_000
"""Largest number of turns that extremals may have; following so many takes minutes."""


@value_class
@dataclass(frozen=True, eq=False)
class AveragedSolution:
    """The averaged extremal of a problem or of a stack (...) of them, with n slow variables.

    Attributes
    ----------
    duration : (...) array
        tau_1, in slow time tau = epsilon t.
    cost : (...) array
        J_0.
    start : (..., n) array
        a_0.
    multipliers : (..., r) array
        alpha, the multipliers of the target's r conditions.
    kappa : (...) array
        Minus the mean of the phase's costate over epsilon; zero at the optimum.
    certificate : AveragedCertificate
        Residuals of the maximum principle between the collocation points, by other quadratures, and whether
        the system can have features between them.
    names : tuple of str
        The slow variables, in the order of `slow` and `costate`. They are the system's own: the cost, which
        the paper counts among them, has the costate -1 and is left out.
    initial_phase : (...) array
        psi_0 where the problem states it (`spin_down`), else zero.
    numbers : tuple of (...) arrays
        Values of the system's numbers, in their order.
    model : Model
        The averaged system, compiled.
    edges : array
        Ends of the pieces of (0, tau_1), as fractions of tau_1.
    series : array
        Chebyshev coefficients, on the pieces, of xi, eta and the integral of omega over the fraction.
    make_system : callable
        Makes the `PhaseSystem` at the first use of `system`.
    frame : callable or None
        Where the slow variables are not regular at the target: a function from this solution to the same
        solution in regular variables.
    """

    duration: Array
    cost: Array
    start: Array
    multipliers: Array
    kappa: Array
    certificate: AveragedCertificate
    names: tuple[str, ...]
    initial_phase: Array
    numbers: tuple[Array, ...]
    model: Model
    edges: Array
    series: Array
    make_system: Callable[[], "PhaseSystem"]
    frame: Callable[["AveragedSolution"], "ReferenceExtremal"] | None = None

    @cached_property
    def system(self) -> "PhaseSystem":
        """The `PhaseSystem` that was averaged."""
        return self.make_system()

    @property
    def turn(self) -> tuple[float, ...]:
        """Ends of cells of a turn that hold narrow features of the system; empty if there are none."""
        return SOLVING.on(self.model.turn).edges

    def slow(self, tau: ArrayLike) -> Array:
        """xi at slow times tau (k,) or (..., k), as (..., k, n)."""
        return self._at(tau)[..., : len(self.names)]

    def costate(self, tau: ArrayLike) -> Array:
        """eta at slow times tau (k,) or (..., k), as (..., k, n)."""
        return self._z(tau)[..., len(self.names) :]

    def frequency(self, tau: ArrayLike) -> Array:
        """omega(xi) at slow times tau (k,) or (..., k), as (..., k)."""
        return self.model.averaged(self._z(tau), self._numbers)[1].value

    def phase(self, tau: ArrayLike, epsilon: float, phase: ArrayLike | None = None) -> Array:
        """psi_0 + integral of omega d tau / epsilon, (2.5), with an error of O(1), as (..., k).

        Raises
        ------
        ValueError
            If epsilon is not positive.
        """
        small = _positive_epsilon(epsilon)
        begin = self.initial_phase if phase is None else angles("phase", phase, "a number or an array (...)")
        turned = self._at(tau)[..., -1]
        return np.asarray(begin)[..., None] + self.duration[..., None] * turned / small

    def control(self, tau: ArrayLike, anomaly: ArrayLike) -> Array:
        """u*(xi, x, eta) of (2.17) at slow times and anomalies x (k,) or (..., k), as (..., k, m)."""
        x = angles("anomaly", anomaly, "a number or an array (k,) of anomalies")
        z = np.moveaxis(self._z(tau), -1, 0)
        return evaluate(self.model.control, *z, x, *self._numbers)

    def mean_rate(self, tau: ArrayLike) -> Array:
        """d xi / d tau, the mean of f under u*, as (..., k, n)."""
        z = self._z(tau)
        return self.model.averaged(z, self._numbers)[0].gradient[..., len(self.names) :]

    def anomaly(self, tau: ArrayLike, epsilon: float, phase: ArrayLike | None = None) -> Array:
        """The anomaly x of `phase`, as (..., k), counted from a phase that is reduced to within a turn."""
        begin = self.initial_phase if phase is None else angles("phase", phase, "a number or an array (...)")
        psi = self.phase(tau, epsilon, within_a_turn(begin))
        return anomaly_at(self.model, self.slow(tau), psi, self._numbers)

    def phase_of(self, tau: ArrayLike, anomaly: ArrayLike) -> Array:
        """psi of an anomaly x (k,) or (..., k) at slow times tau, as (..., k)."""
        x = angles("anomaly", anomaly, "a number or an array (k,) of anomalies")
        return phase_at(self.model, self.slow(tau), x, self._numbers)

    def correction(self, phase: ArrayLike | None = None, ending: ArrayLike | None = None) -> Array:
        """J_1, (...): the least cost is cost + epsilon J_1 + O(epsilon^2).

        Parameters
        ----------
        phase : (...) array, optional
            psi_0; `initial_phase` by default.
        ending : (...) array, optional
            Anomaly at the end; by default the optimum's. It must be given where the control cannot choose it
            (least time with one slow variable); J_1 then depends on it.

        Raises
        ------
        ValueError
            If kappa is not zero, an argument is not finite, or `ending` must be given.
        """
        return np.asarray(np.add.reduce(np.broadcast_arrays(*self.correction_terms(phase, ending).values())))

    def correction_terms(
        self, phase: ArrayLike | None = None, ending: ArrayLike | None = None
    ) -> dict[str, Array]:
        """The three terms whose sum is J_1, (...) each, by name: "start", "end" and "way".

        Parameters and errors are those of `correction`. "way" is an integral along the extremal; it vanishes
        for systems that are reversed when the anomaly is reversed.
        """
        from pontryagin.averaging.averaged.correction import terms

        begin = self.initial_phase if phase is None else angles("phase", phase, "a number or an array (...)")
        last = None if ending is None else angles("ending", ending, "a number or an array (...)")
        if not (self.kappa == 0).all():
            other = self.kappa[self.kappa != 0].flat[0]
            raise ArgumentValueError(
                f"kappa must be 0 for a correction, which is known for the optimum alone, got {other:g}",
                "kappa",
            )
        start = anomaly_at(self.model, self.start, within_a_turn(begin), self.numbers)
        return terms(self._regular, start, last)

    def exact(self, epsilon: float, phase: float | None = None) -> "Extremals":
        """All extremals of the unaveraged problem around the averaged optimum, best first; not for stacks.

        Parameters
        ----------
        epsilon : float
            Positive.
        phase : float, optional
            psi_0; `initial_phase` by default. Anomalies of the extremals are counted from a phase that is
            reduced to within a turn.

        Raises
        ------
        ValueError
            If epsilon is not positive, or leaves more turns than can be followed, or the solution is a stack.
        NotConverged
            If no extremal is found, or one passes over features of the phase narrower than its steps.
        """
        small = _positive_epsilon(epsilon)
        if self.duration.shape:
            raise ArgumentValueError(f"exact takes one problem, got a stack of shape {self.duration.shape}")
        begin = self.initial_phase if phase is None else angles("phase", phase, "a number")
        if begin.ndim:
            raise ArgumentValueError(
                f"phase must be one number, got an array of shape {begin.shape}", "phase"
            )
        if not self.duration > 0:
            raise ArgumentValueError(
                "exact takes a problem of positive duration, got one whose start already meets the target"
            )
        turns = float(self.phase(self.duration, small, 0.0)[0]) / (2 * np.pi)
        if turns > MOST_TURNS:
            raise ArgumentValueError(
                f"epsilon must leave at most {MOST_TURNS} turns of the phase, which exact follows, "
                f"got {small:g}, which leaves {turns:.3g}",
                "epsilon",
            )
        begin = within_a_turn(begin)
        from pontryagin.averaging.exact.roots import extremals

        found = extremals(
            self._regular,
            small,
            float(begin),
            start=float(anomaly_at(self.model, self.start, begin, self.numbers)),
            end=float(self.anomaly(self.duration, small, begin)[0]),
            to_phase=partial(phase_at, self.model, numbers=self.numbers),
        )
        if self.turn:
            _require_certified(found)
        return found

    @property
    def _regular(self) -> "ReferenceExtremal":
        return self if self.frame is None else self.frame(self)

    @property
    def _numbers(self) -> tuple[Array, ...]:
        return tuple(number[..., None] for number in self.numbers)

    def _z(self, tau: ArrayLike) -> Array:
        return self._at(tau)[..., :-1]

    def _at(self, tau: ArrayLike) -> Array:
        """(xi, eta, integral of omega) at slow times, (..., k, 2n + 1)."""
        inside = times("tau", tau, np.zeros_like(self.duration), self.duration)
        duration = self.duration[..., None]
        share = np.divide(inside, duration, out=np.zeros(inside.shape), where=duration > 0)
        return evaluate_series(self.edges, self.series, share)


def _require_certified(found: "Extremals") -> None:
    """Raise if an extremal, found with steps of any length, passes over narrow features of the phase."""
    worst = max((float(extremal.certificate.residual) for extremal in found), default=0.0)
    if not worst <= ACCEPTED:
        raise NotConverged(
            "exact extremals were found only with steps that pass over narrow features of the phase", worst
        )


def _positive_epsilon(epsilon: float) -> float:
    value = finite("epsilon", epsilon, "a positive number")
    if value.shape or not value > 0:
        raise ArgumentValueError(f"epsilon must be a positive number, got {epsilon!r}", "epsilon")
    return float(value)
