"""Trajectories of smooth arcs in several modes, with switches at the zeros of event functions.

A mode is the right-hand side, with its parameters, that holds between two switches. `SwitchedFlow` states the
equations of each mode and which mode follows it; `follow` finds the arcs of a trajectory with its derivatives
in the initial values, and `sample` evaluates it. Where the rates jump at a switch, f- before and f+ after,
the derivatives jump as well, by the saltation matrix: with the event function g,

    dx+ = dx- + (f+ - f-) (grad g, dx-)/g',    g' = (grad g, f-) + dg/dt.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Generic, NamedTuple, TypeVar

import numpy as np

from pontryagin.arrays import Array
from pontryagin.errors import NotConverged
from pontryagin.numerics.equations import Values
from pontryagin.numerics.flow import Integrator, Reached
from pontryagin.value import value_class

Mode = TypeVar("Mode")


class Arc(NamedTuple):
    """How one mode is integrated.

    Attributes
    ----------
    integrator : Integrator
        The integrator of the mode's equations, whose event functions are negative on the arc.
    parameters : (p,) sequence
        Values of the parameters in this mode.
    longest : float
        Longest step of the integrator.
    """

    integrator: Integrator
    parameters: Values
    longest: float = math.inf


@value_class
@dataclass(frozen=True, eq=False)
class Piece(Generic[Mode]):
    """One arc of a trajectory.

    Attributes
    ----------
    begin : float
        Time at which the arc begins.
    mode : Mode
        The mode of the arc.
    whole : (n + n m,) array
        The states at the beginning, followed by the rows of their derivatives.
    """

    begin: float
    mode: Mode
    whole: Array


@dataclass(frozen=True)
class SwitchedFlow(Generic[Mode]):
    """A flow of several modes.

    Attributes
    ----------
    arc : function (mode) -> Arc
        How a mode is integrated.
    following : function (mode, event) -> mode
        The mode after the event with a given index.
    jumps : bool
        Whether the rates jump at a switch, and with them the derivatives.
    grazing : float
        A switch counts as a tangency if the event function's rate there is at most this.
    most : int
        A trajectory with more switches than this is given up.
    """

    arc: Callable[[Mode], Arc]
    following: Callable[[Mode, int], Mode]
    jumps: bool = False
    grazing: float = 0.0
    most: int = 200

    def crossed(self, mode: Mode, reached: Reached) -> Piece[Mode]:
        """The arc that begins after the event that ended the arc before."""
        assert reached.event is not None
        after = self.following(mode, reached.event)
        n = len(self.arc(mode).integrator.equations.identity)
        if not self.jumps or len(reached.whole) == n:
            return Piece(reached.time, after, reached.whole)
        state, columns = reached.whole[:n], reached.whole[n:].reshape(n, -1)
        equations, parameters, _ = self.arc(mode)
        gradient, by_time = equations.equations.event_gradient(reached.event, reached.time, state, parameters)
        before, behind = (rates(self.arc(m), reached.time, state) for m in (mode, after))
        pace = float(gradient @ before) + by_time
        if abs(pace) <= self.grazing:
            raise NotConverged("a switching function touches zero without crossing it", abs(pace))
        jumped = columns + np.outer(behind - before, gradient @ columns / pace)
        return Piece(reached.time, after, np.concatenate([state, jumped.ravel()]))


def rates(arc: Arc, time: float, state: Array) -> Array:
    """x', (n,), in the mode of an arc."""
    return arc.integrator.equations.rates(time, state, arc.parameters)


def follow(
    flow: SwitchedFlow[Mode], whole: Array, mode: Mode, begin: float, end: float
) -> tuple[tuple[Piece[Mode], ...], Array]:
    """The arcs of a trajectory, and the states and derivatives at its end.

    Parameters
    ----------
    flow : SwitchedFlow
    whole : (n + n m,) array
        States and derivatives at the beginning.
    mode : Mode
        The mode at the beginning.
    begin, end : float
        Times.

    Raises
    ------
    NotConverged
        Where an integrator stops short, a switching function touches zero without crossing it, or there are
        more switches than ``flow.most``.
    """
    pieces = [Piece(begin, mode, whole)]
    while True:
        piece = pieces[-1]
        integrator, parameters, longest = flow.arc(piece.mode)
        reached = integrator.run(piece.whole, piece.begin, end, parameters, longest)
        if reached.event is None:
            return tuple(pieces), reached.whole
        pieces.append(flow.crossed(piece.mode, reached))
        if len(pieces) - 1 > flow.most:
            raise NotConverged(
                f"the right-hand side switches more than {flow.most} times", abs(end - reached.time)
            )


def follow_on_grid(flow: SwitchedFlow[Mode], whole: Array, mode: Mode, times: Array) -> Array:
    """The states, (k, n), at ascending times of the trajectory that begins at the first of them.

    The trajectory is integrated once; `follow` and `sample` together would integrate it twice.
    """
    n = len(flow.arc(mode).integrator.equations.identity)
    rows = np.empty((len(times), n))
    rows[0] = whole[:n]
    piece, done, switches = Piece(float(times[0]), mode, whole), 1, 0
    while done < len(times):
        integrator, parameters, longest = flow.arc(piece.mode)
        grid = np.append(piece.begin, times[done:])
        found, reached = integrator.sample(piece.whole, grid, parameters, longest)
        rows[done : done + len(found) - 1] = found[1:]
        done += len(found) - 1
        if reached.event is None:
            break
        piece, switches = flow.crossed(piece.mode, reached), switches + 1
        while done < len(times) and times[done] <= piece.begin:  # a point of the grid is the switch itself
            rows[done] = piece.whole[:n]
            done += 1
        if switches > flow.most:
            raise NotConverged(
                f"the right-hand side switches more than {flow.most} times", float(times[-1]) - piece.begin
            )
    return rows


def sample(flow: SwitchedFlow[Mode], pieces: Sequence[Piece[Mode]], times: Array) -> Array:
    """The states, (k, n), of a trajectory with known arcs at times in any order."""
    which = places(pieces, times)
    n = len(flow.arc(pieces[0].mode).integrator.equations.identity)
    rows = np.empty((len(times), n))
    for i in np.unique(which):
        piece, chosen = pieces[i], np.flatnonzero(which == i)
        grid, back = np.unique(np.append(times[chosen], piece.begin), return_inverse=True)
        integrator, parameters, longest = flow.arc(piece.mode)
        states, reached = integrator.sample(piece.whole, grid, parameters, longest)
        missing = len(grid) - len(states)  # by rounding, the event may come just before the end of the arc
        states = np.vstack([states, *[reached.whole[:n]] * missing])
        rows[chosen] = states[back[:-1]]
    return rows


def places(pieces: Sequence[Piece[Mode]], times: Array) -> Array:
    """Index of the arc that each time belongs to, (k,)."""
    begins = np.array([piece.begin for piece in pieces])
    return np.clip(np.searchsorted(begins, times, side="right") - 1, 0, None)
