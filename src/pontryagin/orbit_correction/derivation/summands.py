"""Lemma 1, Theorem 2, Lemma 7 and Lemma 8 for matrices of any size, as noncommuting symbols of SymPy.

A sum of linear images of U(k), ..., U(k+N-1) is represented by the same sum of images of u(k), ..., u(k+N-1).
"""

from collections.abc import Sequence
from functools import reduce
from operator import mul
from typing import Any

import sympy as sp

x = sp.Symbol("x", commutative=False)
alpha = sp.Symbol("alpha", positive=True)


def A(k: int) -> sp.Symbol:
    """The matrix of step k."""
    return sp.Symbol(f"A_{k}", commutative=False)


def A_transposed(k: int) -> sp.Symbol:
    """The transpose of `A`."""
    return sp.Symbol(f"A'_{k}", commutative=False)


def H(k: int) -> sp.Symbol:
    """The matrix of the ellipsoid U(k)."""
    return sp.Symbol(f"H_{k}", commutative=False)


def u(k: int) -> sp.Symbol:
    """The control of step k."""
    return sp.Symbol(f"u_{k}", commutative=False)


def forward_product(matrices: Sequence[Any]) -> Any:
    """The last matrix times ... times the first."""
    return reduce(mul, reversed(matrices))


def backward_product(matrices: Sequence[Any]) -> Any:
    """The inverse of the first times ... times the inverse of the last."""
    return reduce(mul, (matrix**-1 for matrix in matrices))


def final_state(N: int) -> sp.Expr:
    """x(N) from x(0) = x, by applying (1) step by step."""
    state = x
    for k in range(N):
        state = A(k) * state + u(k)
    return sp.expand(state)


def state_brought_to_zero(N: int, k: int = 0, size: sp.Expr = sp.S.One) -> sp.Expr:
    """The x(k) of (2) that the controls (times `size`) of steps k to k+N-1 bring to 0, by (1) backwards.

    With the `size` alpha it is the state of the system (7), Lemma 7. A single step of it is Corollary 1.
    """
    state = sp.S.Zero
    for step in reversed(range(k, k + N)):
        state = A(step) ** -1 * (state - size * u(step))
    return sp.expand(state)


def adjoint(k: int) -> sp.Expr:
    """The product that takes psi(0) to psi(k), by the recursion of Theorem 2 and (6)."""
    state = sp.S.One
    for step in range(k):
        state = A_transposed(step) ** -1 * state
    return state


def carried_back(k: int) -> sp.Expr:
    """H~(k) of E_k, the states that A(k-1) ... A(0) carries into U(k-1), by Lemma 8."""
    shape = H(k - 1)
    for step in reversed(range(k)):
        shape = A_transposed(step) * shape * A(step)
    return shape
