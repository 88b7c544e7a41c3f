"""The least-energy programme, (2.1) to (2.5): a quadratic problem, solved by the inverse of the Gramian.

paper   here            meaning
------  --------------  ----------------------------------------------------------
D       gramian         controllability Gramian W(t_f, t_0)
lambda  stationary      multiplier of the condition l'c = 1
rho_0   dual_norm       least norm of the dual function
h_0     minimal_element the dual function that attains it
u*      minimum_energy_control
"""

from functools import cache

import sympy as sp

from pontryagin.triple_integrator.derivation.model import CHAIN, INPUT, T, c, impulse_response, multipliers, s


@cache
def gramian() -> sp.Matrix:
    """D = integral of h h' over the manoeuvre, (2.1)."""
    h = impulse_response()
    return (h * h.T).applyfunc(lambda entry: sp.integrate(entry, (s, 0, T)))


def lyapunov_residual(candidate: sp.Matrix) -> sp.Matrix:
    """dD/dT - A D - D A' - b b': zero for the Gramian, which starts from zero at T = 0."""
    return candidate.diff(T) - CHAIN * candidate - candidate * CHAIN.T - INPUT * INPUT.T


@cache
def stationary() -> tuple[sp.Expr, sp.Matrix]:
    """Multiplier lambda and vector l0 where l'Dl + lambda (c'l - 1) is stationary; c'l0 = 1 is (1.16)."""
    price = sp.Symbol("lambda", real=True)
    lagrangian = (multipliers.T * gramian() * multipliers)[0] + price * ((c.T * multipliers)[0] - 1)
    unknowns = [*multipliers, price]
    solution = sp.solve([sp.diff(lagrangian, unknown) for unknown in unknowns], unknowns, dict=True)[0]
    return solution[price], multipliers.subs(solution)


def dual_norm() -> sp.Expr:
    """rho_0 of (1.13), the least L2 norm of a dual function with l'c = 1, by integrating its square."""
    square = sp.integrate(sp.expand(minimal_element() ** 2), (s, 0, T))
    return sp.sqrt(sp.factor(square))


def minimal_element() -> sp.Expr:
    """h0 = l0' h(s), the dual function of least L2 norm."""
    return (stationary()[1].T * impulse_response())[0]


@cache
def minimum_energy_control() -> sp.Expr:
    """The least-energy programme u = h0 / rho_0^2, (2.2) and (2.3), as a polynomial in s.

    It is the solution of (1.14) for problem 1, (1.18).
    """
    square = sp.integrate(sp.expand(minimal_element() ** 2), (s, 0, T))
    return sp.collect(sp.expand(sp.cancel(minimal_element() / square)), s)
