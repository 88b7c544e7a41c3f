"""`PhaseSystem`: a system with a rotating phase as the user states it, checked and compiled."""

from dataclasses import dataclass
from functools import cached_property

from pontryagin.averaging.system.average import compiled_model
from pontryagin.averaging.system.checks import checked
from pontryagin.averaging.system.model import Model
from pontryagin.averaging.system.standard_form import StandardForm
from pontryagin.value import value_class


@value_class
@dataclass(frozen=True, eq=False)
class PhaseSystem(StandardForm):
    """Slow variables a driven by a control u through a rotating phase, (1.1) to (1.3).

    a' = epsilon f(a, x, u),  x' = r(a, x) + epsilon F(a, x, u),  M(a(t1)) = 0,  and the cost
    g(a(t1)) + integral of (L(a, x) + cost of u) over the slow time epsilon t is to be least. The anomaly x is
    any angle that turns with the phase; r = omega / weight is its rate at epsilon = 0.

    Parameters
    ----------
    f : sequence of n expressions
        Rates of the slow variables per epsilon, affine in the control, 2 pi-periodic in the anomaly.
    omega : expression, optional
        Frequency of the phase, in the slow variables.
    control_set : ControlSet
        `Quadratic`, `Ball`, `Ellipsoid`, `Box`, `BoundedQuadratic` or `Custom`.
    slow, control : sequence of real sympy.Symbol
        a (n) and u (m).
    phase : real sympy.Symbol
        The anomaly x; the phase psi is zero at x = 0.
    target : sequence of r expressions in the slow variables
        M, 1 <= r <= n.
    running_cost : expression in the slow variables and the anomaly
        L; 1 for the least time.
    terminal_cost : expression in the slow variables
        g.
    phase_rate : expression, affine in the control
        F; the averaged problem does not depend on it, the correction and the exact extremals do.
    weight : expression
        dpsi/dx, positive, of mean one over a turn of x.
    anomaly_rate : expression, optional
        r(a, x), instead of omega and weight where the frequency is known only as the integral
        omega = 2 pi / oint dx / r.
    numbers : mapping of real sympy.Symbol to number or (...) array, optional
        Values of the other symbols; arrays make a stack of problems.

    Raises
    ------
    TypeError, ValueError
        Naming the argument: an unknown symbol, a rate that is not affine in the control or not periodic, a
        frequency that is not positive, a control set that is not convex, a wrong number of entries.

    Examples
    --------
    A pendulum that rotates in a resisting medium is sped up: its energy a = x'^2/2 - cos x is raised against
    the drag -x'/5, at the cost rate 1 + u^2. This problem is not in the paper.

    >>> import sympy as sp
    >>> from pontryagin.averaging import PhaseSystem, Quadratic
    >>> a, x, u = sp.symbols("a x u", real=True)
    >>> speed = sp.sqrt(2 * (a + sp.cos(x)))
    >>> pendulum = PhaseSystem(f=[speed * (u - speed / 5)], anomaly_rate=speed, control_set=Quadratic(),
    ...                        slow=[a], control=[u], phase=x, target=[a - 5])
    >>> pendulum.maximiser[0]
    p_a*sqrt(2*a + 2*cos(x))/2
    >>> from pontryagin.averaging import solve_averaged
    >>> solution = solve_averaged(pendulum, start=[2.0])
    >>> f"{solution.duration:.6f} {solution.cost:.6f}"
    '1.049933 3.849810'
    """

    def __post_init__(self) -> None:
        for name, value in checked(self).items():
            object.__setattr__(self, name, value)

    @cached_property
    def model(self) -> Model:
        """The kernels of the averaged system, compiled."""
        return compiled_model(self)
