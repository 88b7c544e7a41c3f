"""Example 1, the rotor (3.1): from Lagrange's equation to the averaged system (Akulenko 1977, section 3).

here            meaning
--------------  ----------------------------------------------------------------------------
x, v            generalised coordinate and rate of turning v = x' > 0; x is the anomaly
a               energy m v^2/2 + V, the one slow variable
m(x), V(x)      mass and potential; undefined functions unless the caller names them
u, f(x, v)      control and perturbing force, per epsilon
psi             rotating phase: psi' = omega(a) at epsilon = 0

Rates are per epsilon except those of x and psi. The rate of the anomaly, x' = speed(a, x), is exact: it is
not perturbed. Averages over psi are taken over x with the weight dpsi/dx = omega/speed.
"""

import sympy as sp

t = sp.Symbol("t", real=True)
x = sp.Symbol("x", real=True)
a = sp.Symbol("a", positive=True)
v = sp.Symbol("v", positive=True)
u, x0, p, p_x = sp.symbols("u x_0 p p_x", real=True)
second = sp.Symbol("x''", real=True)
epsilon = sp.Symbol("epsilon", positive=True)

MASS: sp.Expr = sp.Function("m", positive=True)(x)
POTENTIAL: sp.Expr = sp.Function("V", real=True)(x)
FORCE: sp.Expr = sp.Function("f", real=True)(x, v)


def equation_of_motion(mass: sp.Expr = MASS, potential: sp.Expr = POTENTIAL) -> sp.Expr:
    """d/dt dL/dx' - dL/dx for L = m x'^2/2 - V, in x, v = x' and the symbol for x'': left side of (3.1)."""
    place = sp.Function("x")(t)
    rate = place.diff(t)
    lagrangian = (mass * v**2 / 2 - potential).subs(x, place)
    momentum = lagrangian.diff(v).subs(v, rate)
    left = momentum.diff(t) - lagrangian.diff(place).subs(v, rate)
    return sp.expand(left.doit().subs(rate.diff(t), second).subs(rate, v).subs(place, x))


def acceleration(
    mass: sp.Expr = MASS, potential: sp.Expr = POTENTIAL, force: sp.Expr = FORCE, control: sp.Expr = u
) -> sp.Expr:
    """x'' in terms of x and v, from (3.1)."""
    balance = equation_of_motion(mass, potential) - epsilon * (control + force)
    return sp.solve(balance, second)[0]


def energy(mass: sp.Expr = MASS, potential: sp.Expr = POTENTIAL) -> sp.Expr:
    """Kinetic plus potential energy in terms of x and v."""
    return mass * v**2 / 2 + potential


def speed(mass: sp.Expr = MASS, potential: sp.Expr = POTENTIAL) -> sp.Expr:
    """x', the rate of the anomaly, in terms of a and x; positive while the rotor turns."""
    square = sp.Symbol("w", positive=True)
    general = sp.solve(energy().subs(v, sp.sqrt(square)) - a, square)[0]
    return sp.sqrt(_inserted(general, mass, potential, FORCE))


def energy_rate(
    mass: sp.Expr = MASS, potential: sp.Expr = POTENTIAL, force: sp.Expr = FORCE, control: sp.Expr = u
) -> sp.Expr:
    """da/dt along the motion, in terms of x and v."""
    whole = energy(mass, potential)
    rate = whole.diff(x) * v + whole.diff(v) * acceleration(mass, potential, force, control)
    return sp.factor(sp.expand(rate))


def slow_rate(
    mass: sp.Expr = MASS, potential: sp.Expr = POTENTIAL, force: sp.Expr = FORCE, control: sp.Expr = u
) -> sp.Expr:
    """a' per epsilon in terms of a, x and the control: the f of (1.1).

    It is derived for every mass, potential and force first, where it holds no derivative of theirs: they may
    have kinks.
    """
    general = energy_rate(control=control) / epsilon
    return _inserted(general, mass, potential, force).subs(v, speed(mass, potential))


def _inserted(general: sp.Expr, mass: sp.Expr, potential: sp.Expr, force: sp.Expr) -> sp.Expr:
    """An expression in a general mass, potential and force for these ones."""
    return general.subs(FORCE, force).subs({MASS: mass, POTENTIAL: potential})


def frequency(mass: sp.Expr = MASS, potential: sp.Expr = POTENTIAL) -> sp.Expr:
    """omega(a) = 2 pi over the time of a turn."""
    return 2 * sp.pi / over_a_turn(1 / speed(mass, potential))


def phase_weight(mass: sp.Expr = MASS, potential: sp.Expr = POTENTIAL) -> sp.Expr:
    """dpsi/dx at a fixed energy, where psi is 2 pi times the elapsed fraction of the time of a turn."""
    return frequency(mass, potential) / speed(mass, potential)


def phase_rate(
    mass: sp.Expr = MASS, potential: sp.Expr = POTENTIAL, force: sp.Expr = FORCE, control: sp.Expr = u
) -> sp.Expr:
    """F, which is psi' - omega per epsilon: at fixed x the phase changes with the energy."""
    share = sp.Symbol("y", real=True)
    phase = sp.Integral(phase_weight(mass, potential).subs(x, share), (share, x0, x))
    return phase.diff(a) * slow_rate(mass, potential, force, control)


def over_a_turn(integrand: sp.Expr) -> sp.Expr:
    """Integral over x from 0 to 2 pi, left unevaluated where x is in radicals or undefined functions."""
    turn = sp.Integral(integrand, (x, 0, 2 * sp.pi))
    radicals = [part for part in integrand.atoms(sp.Pow) if not part.exp.is_nonnegative and part.has(x)]
    radicals += [part for part in integrand.atoms(sp.Pow) if not part.exp.is_integer and part.has(x)]
    return turn if radicals or integrand.has(sp.core.function.AppliedUndef) else turn.doit()


def mean(quantity: sp.Expr, mass: sp.Expr = MASS, potential: sp.Expr = POTENTIAL) -> sp.Expr:
    """Average over the phase at a fixed energy, by dpsi = omega dx/x'."""
    over_speed = sp.expand(quantity / v).subs(v, speed(mass, potential))
    return frequency(mass, potential) / (2 * sp.pi) * over_a_turn(over_speed)


def mean_over_angle(quantity: sp.Expr, mass: sp.Expr = MASS, potential: sp.Expr = POTENTIAL) -> sp.Expr:
    """Average over the angle x at a fixed energy."""
    return over_a_turn(quantity.subs(v, speed(mass, potential))) / (2 * sp.pi)


def period_slope(mass: sp.Expr = MASS, potential: sp.Expr = POTENTIAL) -> sp.Expr:
    """-d/da of the time of a turn 2 pi/omega, the integral of 1/(m x'^3): positive for every rotor."""
    return over_a_turn(-(1 / speed(mass, potential)).diff(a))


def averaged_rate(
    mass: sp.Expr = MASS, potential: sp.Expr = POTENTIAL, force: sp.Expr = FORCE, control: sp.Expr = u
) -> sp.Expr:
    """d xi/d tau for a control that does not depend on the phase: `slow_rate` averaged, term by term."""
    return sum((mean(v * term, mass, potential) for term in (control, force)), sp.S.Zero)


def rate_by_angle(force: sp.Expr = FORCE, control: sp.Expr = u) -> sp.Expr:
    """da/dx = epsilon (u + f) of the exact motion, on which the comparison of controls rests."""
    return sp.simplify(energy_rate(force=force, control=control) / v)


def costate_rate(force: sp.Expr = FORCE) -> sp.Expr:
    """p' on a least-time extremal of the exact problem, in terms of x and v, linear in p.

    The cost is epsilon t; p_x is eliminated by H = 0.
    """
    hamiltonian = epsilon * p * slow_rate(force=force) + p_x * speed() - epsilon
    along = sp.solve(hamiltonian, p_x)[0]
    rate = -hamiltonian.diff(a).subs(p_x, along)
    return sp.simplify(rate.subs(a, energy()).doit())
