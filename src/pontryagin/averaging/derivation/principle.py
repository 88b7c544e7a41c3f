"""The maximum principle of a general system, and its reduction to (2.1) (Akulenko 1977, section 1 and (2.1)).

here           meaning
-------------  --------------------------------------------------------------------------
a, p           slow variables and costates, two of each; no formula couples more than two
psi, q         rotating phase and its costate
u              control; one component stands for all of them
f, F, omega    undefined functions: rates of a and psi per epsilon, frequency
M, g, alpha    one target condition (1.2), terminal cost (1.3), multiplier; further ones add like terms
h_star         h after the maximum over u, (1.5), at given q and epsilon

The costate of the cost is -1, so that H is maximised.
"""

from functools import cache

import sympy as sp

t, epsilon, psi, q, u, alpha = sp.symbols("t epsilon psi q u alpha", real=True)
a, p = sp.symbols("a1:3", real=True), sp.symbols("p1:3", real=True)
omega = sp.Function("omega", positive=True)(*a)
f = sp.Matrix([sp.Function(f"f{i}", real=True)(*a, psi, u, epsilon) for i in (1, 2)])
F = sp.Function("F", real=True)(*a, psi, u, epsilon)
M, g = (sp.Function(name, real=True)(*a) for name in "Mg")
u_star = sp.Function("u", real=True)(*a, psi, *p, q, epsilon)
h_star = sp.Function("h^*", real=True)(*a, psi, *p, q, epsilon)


# --- the canonical equations, from the first variation -------------------------------------------------


def rates() -> sp.Matrix:
    """(a', psi') of the standard system, (1.1)."""
    return sp.Matrix([*(epsilon * f), omega + epsilon * F])


def hamiltonian() -> sp.Expr:
    """H: the costates (p, q) times the rates, (1.4)."""
    return sp.Matrix([*p, q]).dot(rates())


def small_part() -> sp.Expr:
    """h of H = omega q + epsilon h, (1.4)."""
    return sp.expand((hamiltonian() - omega * q) / epsilon)


@cache
def costate_rates() -> sp.Matrix:
    """(p', q'), (1.6): where the first variation of the integral of p a' + q psi' - H vanishes.

    The motion is displaced by s delta(t). After integration by parts the integrand of the variation is the
    displacement times a factor, which has to be zero.
    """
    place, costate, moved = ([sp.Function(f"{name}{i}")(t) for i in range(3)] for name in "xyd")
    s = sp.Symbol("s")
    at = dict(zip((*a, psi), [x + s * d for x, d in zip(place, moved, strict=True)], strict=True))
    at |= dict(zip((*p, q), costate, strict=True))
    paired = sum(y * (x + s * d).diff(t) for x, y, d in zip(place, costate, moved, strict=True))
    integrand = paired - hamiltonian().subs(at, simultaneous=True)
    by_parts = sum(y * d for y, d in zip(costate, moved, strict=True)).diff(t)
    left = sp.expand(integrand.diff(s).subs(s, 0).doit() - by_parts)
    back = dict(zip((*place, *costate), (*a, psi, *p, q), strict=True))
    found = [sp.solve(left.coeff(d), y.diff(t))[0].subs(back) for d, y in zip(moved, costate, strict=True)]
    return sp.Matrix([rate.doit() for rate in found])


@cache
def end_conditions() -> tuple[sp.Matrix, sp.Expr]:
    """(p, q) at t1, (1.6), and the expression that vanishes there, (1.7), by variation of g + alpha M and t1.

    The end is displaced by (A1, A2, Psi) and the end time by T; the motion at fixed time is then displaced by
    (A1, A2, Psi) minus its rate times T.
    """
    displaced, speeds = sp.Matrix(sp.symbols("A1 A2 Psi")), sp.Matrix(sp.symbols("v1:4"))
    time = sp.Symbol("T")
    costate = sp.Matrix([*p, q])
    outer = sp.Matrix([(g + alpha * M).diff(coordinate) for coordinate in (*a, psi)])
    lagrangian = costate.dot(speeds) - hamiltonian()
    change = sp.expand(outer.dot(displaced) + costate.dot(displaced - time * speeds) + time * lagrangian)
    found = sp.solve([change.coeff(part) for part in displaced], list(costate), dict=True)[0]
    return costate.subs(found), -sp.collect(change.coeff(time), q)


# --- the maximum over the control --------------------------------------------------------------------


def envelope() -> list[sp.Expr]:
    """dh(u*)/d(a, psi, p, q) minus the derivative of h at constant u and minus (dh/du) du*: all vanish.

    At an inner maximum dh/du = 0; on the boundary of U the maximiser moves along it, and (dh/du) du* = 0.
    """
    h = small_part()
    differences = []
    for variable in (*a, psi, *p, q):
        whole = _partials(h.subs(u, u_star).diff(variable).doit())
        held = _partials(h.diff(variable).subs(u, u_star).doit())
        stationary = _partials(h.diff(u).subs(u, u_star).doit())
        differences.append(sp.expand(whole - held - stationary * u_star.diff(variable)))
    return differences


def _partials(expression: sp.Expr) -> sp.Expr:
    """An expression with symbols for the partials of f and F at u*, which SymPy writes in two ways."""
    named = {}
    for atom in expression.atoms(sp.Subs):
        function, variable = atom.expr.expr, atom.expr.variables[0]
        named[atom] = sp.Symbol(f"d{function.func}/d{function.args.index(variable)}")
    return expression.subs(named)


def along(quantity: sp.Expr) -> sp.Expr:
    """Rate of a quantity along the canonical equations of H* = omega q + epsilon h*."""
    H = omega * q + epsilon * h_star
    states, costates = (*a, psi), (*p, q)
    pairs = zip(states, costates, strict=True)
    return sum(
        quantity.diff(x) * H.diff(y) - quantity.diff(y) * H.diff(x) for x, y in pairs
    )  # Poisson's bracket with H


# --- without the phase's costate -----------------------------------------------------------------------


def leading(expression: sp.Expr) -> sp.Expr:
    """An expression at q = 0 and epsilon = 0; for the control u_star it is u0* of (2.17)."""
    return expression.subs({q: 0, epsilon: 0}).doit()


@cache
def phase_costate() -> tuple[sp.Expr, sp.Expr]:
    """q1 and q2 of q = epsilon q1 + epsilon^2 q2 + ..., solved from omega q + epsilon h* = 0, (1.8)."""
    q1, q2 = sp.symbols("q1 q2")
    level = (omega * q + epsilon * h_star).subs(q, epsilon * q1 + epsilon**2 * q2)
    first, second = (level.diff(epsilon, k).doit().subs(epsilon, 0).doit() for k in (1, 2))
    found = sp.solve(first, q1)[0]
    return found, sp.solve(second.subs(q1, found).doit(), q2)[0]


@cache
def standard_costate_rates() -> list[sp.Expr]:
    """p' per epsilon with q = epsilon q1, to the leading order, (2.1): -omega' q1 - dh*/da."""
    H = omega * q + epsilon * h_star
    whole = [-H.diff(coordinate).subs(q, epsilon * phase_costate()[0]) for coordinate in a]
    return [sp.expand(rate.diff(epsilon).doit().subs(epsilon, 0).doit()) for rate in whole]


def leading_h() -> sp.Expr:
    """(p f0*): h* at q = 0 and epsilon = 0, a function of a, psi and p, which (2.2) makes zero at t1."""
    return leading(h_star)
