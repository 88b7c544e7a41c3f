"""Four forms of one system, compiled to native code in the same way, and their residuals at a meeting.

The costates at t0 are rho, s1, e, nu in every form: with lambda = 1 at t0, mu equals nu, and nu0 = 0. In the
form with eight costates, Phi* and mu0 are free as well.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
import sympy as sp

from pontryagin.arrays import Array
from pontryagin.numerics import complex_step, trajectory
from pontryagin.numerics.flow import NO_TIMES, TOLERANCE
from pontryagin.numerics.rotation import conjugate, product
from pontryagin.numerics.symbolic import Symbolic
from pontryagin.numerics.trajectory import ArcEnd, Compiled
from pontryagin.rendezvous import kernels
from pontryagin.rendezvous.derivation import forms, principle, repair
from pontryagin.rendezvous.derivation.forms import Form
from pontryagin.rendezvous.derivation.principle import Mode
from pontryagin.rendezvous.generate import chart, in_any_chart
from pontryagin.rendezvous.problem.scaled import Scaled
from pontryagin.rendezvous.reduced.flight import chart_of

STEPS = 2000
"""Maximum number of steps of a flight."""

EIGHT, FULL, LONG, REPAIRED, REDUCED = (
    "16, eight costates",
    "16, nu0 = 0",
    "14, with lambda",
    "11, with chi",
    "10, with (15)",
)


Symbols = tuple[sp.Symbol, ...]


def _repaired(mode: Mode) -> Form:
    """The repaired form with the chart, +1 or -1, as an additional parameter."""
    plain = forms.repaired(mode)
    rate = repair.with_length(in_any_chart(repair.chi_rate())).subs(forms.thrust(mode))
    return Form(plain.states, (*plain.rates[:-1], rate), (*plain.parameters, chart))


SYSTEMS = {"16": forms.full, "14": forms.with_attitude, "11": cache(_repaired), "10": forms.reduced}
SIX = (principle.rho, principle.s1, principle.e, *principle.nu)
EIGHT_COSTATES = tuple(principle.COSTATE)


def costates_of(size: str) -> tuple[sp.Symbol, ...]:
    """The costates at t0 by which a form is differentiated."""
    if size == "16":
        return (principle.rho, principle.s1, principle.e, *principle.COSTATE[5:])
    return SIX


@cache
def expressions(size: str, mode: Mode) -> tuple[Form, tuple[sp.Expr, ...]]:
    """A form and the six columns of its variational equations, with symbols for the derivatives."""
    form = SYSTEMS[size](mode)
    states = sp.Matrix(form.states)
    columns = sp.Matrix(len(form.states), 6, lambda i, j: sp.Symbol(f"w{i}_{j}"))
    return form, tuple(sp.Matrix(form.rates).jacobian(states) * columns)


@cache
def compiled(size: str, mode: Mode, derivatives: bool, wrt: Symbols = ()) -> Compiled:
    """The native code of a form, with derivatives by the initial values ``wrt``."""
    form = SYSTEMS[size](mode)
    chosen = (wrt or costates_of(size)) if derivatives else ()
    return trajectory.compiled(Symbolic(form.states, tuple(form.rates), form.parameters, wrt=tuple(chosen)))


def initial_state(size: str, scaled: Scaled, costates: Array) -> Array:
    """The state at t0 of a form for costates rho, s1, e, nu, or rho, s1, e, Phi*, mu."""
    one = [1.0, 0.0, 0.0, 0.0]
    place = [*scaled.start, scaled.anomaly]
    if size == "16":
        eight = costates if len(costates) == 8 else [*costates[:3], 0.0, 0.0, *costates[3:]]
        return np.array([*place, *one, *eight])
    tail: dict[str, list[float]] = {"14": one, "11": [0.0], "10": []}
    return np.array([*place, *costates, *tail[size]])


def fly(
    size: str, mode: Mode, scaled: Scaled, start: Array, duration: float, scale: float, wrt: Symbols = ()
) -> tuple[Array, Array, int] | None:
    """The end of a flight of a form, its derivatives and the number of steps; None if it stops early."""
    state = np.concatenate([start, identity(size, wrt).ravel()])
    pars = parameters(size, scaled, scale, start)
    reached = carried(compiled(size, mode, True, wrt), state, pars, duration)
    n = len(start)
    if reached.code or not np.isfinite(reached.whole).all():
        return None
    return reached.whole[:n], reached.whole[n:].reshape(n, -1), reached.steps


def carried(native: Compiled, state: Array, pars: Sequence[float], duration: float) -> ArcEnd:
    """How a flight ended."""
    return native.follow(state, 0.0, duration, np.array(pars), TOLERANCE, np.inf, STEPS, NO_TIMES)


def parameters(size: str, scaled: Scaled, scale: float, start: Array) -> list[float]:
    """fM, p*, e*, c*, alpha2 or p_max, and for 11 equations the sign of the chart."""
    own = [float(chart_of(start[4:10]))] if size == "11" else []
    return [1.0, 1.0, scaled.eccentricity, 1.0, scale, *own]


@cache
def identity(size: str, wrt: Symbols = ()) -> Array:
    """Derivatives of the state at t0 by ``wrt``, or by default by `costates_of` the form."""
    form = SYSTEMS[size]("unsaturated")
    return np.array([[float(x == y) for y in wrt or costates_of(size)] for x in form.states])


@dataclass(frozen=True)
class Problem:
    """One form of the boundary value problem.

    Attributes
    ----------
    name : str
        The label, which determines the unknowns.
    size : str
        Number of equations.
    """

    name: str
    size: str

    @property
    def unknowns(self) -> tuple[sp.Symbol, ...]:
        """The costates at t0 that are free."""
        return EIGHT_COSTATES if self.name == EIGHT else costates_of(self.size)

    def start(self, six: Array) -> Array:
        """The unknowns of this form for rho, s1, e, nu."""
        return np.array([*six[:3], 0.0, 0.0, *six[3:]]) if self.name == EIGHT else np.array(six)

    def six(self, unknowns: Array) -> Array:
        """The values of rho, s1, e, nu among the unknowns."""
        return np.delete(unknowns, [3, 4]) if self.name == EIGHT else unknowns

    def residual(self, scaled: Scaled, unknowns: Array, duration: float) -> tuple[Array, Array] | None:
        """The residual of this form's conditions at t_k, and its derivatives by the unknowns."""
        start = initial_state(self.size, scaled, unknowns)
        flown = fly(self.size, "unsaturated", scaled, start, duration, 1.0, self.unknowns)
        if flown is None:
            return None
        end, slopes, _ = flown
        inputs = np.concatenate([end, unknowns])

        def each(columns: np.ndarray) -> np.ndarray:
            return np.stack([_ends(self, scaled, column, len(end)) for column in columns.T], axis=-1)

        with np.errstate(all="ignore"):
            residual, by_input = complex_step.jacobian(each, inputs)
        jacobian = by_input[:, : len(end)] @ slopes + by_input[:, len(end) :]
        return (residual, jacobian) if np.isfinite(jacobian).all() else None


PROBLEMS = (
    Problem(EIGHT, "16"),
    Problem(FULL, "16"),
    Problem(LONG, "14"),
    Problem(REPAIRED, "11"),
    Problem(REDUCED, "10"),
)


def _ends(problem: Problem, scaled: Scaled, inputs: Array, count: int) -> Array:
    """The residuals of (5), of (6) or (15), and with eight costates of (16), for real or complex inputs."""
    end, unknowns = inputs[:count], inputs[count:]
    goal = np.array(kernels.target(end[3], 1.0, scaled.eccentricity, 1.0, *scaled.orientation), dtype=complex)
    place, attitude = end[:3] - goal[:3], goal[4:]
    if problem.size == "10":
        nu, first = (np.concatenate([[0.0], x]) for x in (end[7:10], unknowns[3:]))
        invariant = product(product(attitude, nu), conjugate(attitude))
        return np.concatenate([place, (invariant - first)[1:]])
    if problem.size == "11":
        nu = [*end[7:10], end[10], *unknowns[3:]]
        goals = [*goal[:3], *attitude]
        return np.array(kernels.mismatch(*[*end[:3], *nu, chart_of(unknowns.real), *goals]))
    own = end[4:8] if problem.size == "16" else end[10:14]
    missed = product(conjugate(own), attitude)[1:]
    if problem.name != EIGHT:
        return np.concatenate([place, missed])
    rho, s1, _, pair = end[8:12]
    nu3 = product(conjugate(own), end[12:])[3]
    wanted = kernels.anomaly_constant(rho, s1, nu3, end[3], 1.0, scaled.eccentricity, 1.0)
    law = pair * (1 + scaled.eccentricity * np.cos(end[3])) ** 2 - wanted
    return np.concatenate([place, missed, [law]])
