"""From the channel's equations of motion to three moments of the control, (0.6) to (1.10).

paper   here            meaning
------  --------------  ----------------------------------------------------------
T       T               duration t_f - t_0
-       s               time to go, s = t_f - tau
h       response        effect of a unit impulse on each state after the time s, (1.6)
c       moments         required moments of the control, (1.10)
l       multipliers     coefficients of the dual function h = l' h(s)
"""

import sympy as sp

T, s = sp.symbols("T s", positive=True)
c = sp.Matrix(sp.symbols("c1:4", real=True))
multipliers = sp.Matrix(sp.symbols("l1:4", real=True))

CHAIN = sp.Matrix(3, 3, lambda i, j: int(j == i + 1))
INPUT = sp.Matrix([0, 0, 1])


def transition(duration: sp.Expr = T) -> sp.Matrix:
    """Phi = exp(A t) of the chain of three integrators, (1.4)."""
    return (CHAIN * T).exp().subs(T, duration)


def impulse_response() -> sp.Matrix:
    """h(s) = exp(A s) b, (1.5) and (1.6)."""
    return transition(s) * INPUT


def moments_of(control: sp.Expr) -> sp.Matrix:
    """The three moments of a control u(s): the left-hand sides of (1.9) and (1.11)."""
    return impulse_response().applyfunc(lambda h: sp.integrate(sp.expand(h * control), (s, 0, T)))


def dual_function() -> sp.Expr:
    """h(s) = l' h(s), the third costate as a function of the time to go, (1.12) and (3.3).

    It is the third component of the solution of (1.15) with the end value l, whose norm (1.17) minimises.
    """
    return (multipliers.T * impulse_response())[0]
