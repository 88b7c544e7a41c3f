"""The paper's examples as phase systems, each a function of the values of its numbers.

Generated from the derivations by `make kernels`; do not edit.
"""

# fmt: off
# ruff: noqa: E501
from numpy.typing import ArrayLike
from sympy import Rational, Symbol, cos, sin, sqrt

from pontryagin.averaging.system.control_sets import Ellipsoid, Quadratic
from pontryagin.averaging.system.phase_system import PhaseSystem


def smooth(*values: ArrayLike) -> PhaseSystem:
    """Section 3, smooth example, with values of v1, k, ripple."""
    v = Symbol("v", positive=True)
    u = Symbol("u", real=True)
    x = Symbol("x", real=True)
    v1 = Symbol("v1", real=True)
    k = Symbol("k", positive=True)
    ripple = Symbol("ripple", real=True)
    return PhaseSystem(
        f=[ripple*cos(x) + u],
        slow=[v],
        control=[u],
        target=[v - v1],
        phase=x,
        omega=v,
        weight=1,
        running_cost=k,
        terminal_cost=0,
        phase_rate=0,
        control_set=Quadratic(weight=1),
        numbers=dict(zip((v1, k, ripple, ), values, strict=True)),
    )


def kepler(*values: ArrayLike) -> PhaseSystem:
    """Example 2, with values of E1, l."""
    E = Symbol("E", negative=True)
    K = Symbol("K", positive=True)
    u_r = Symbol("u_r", real=True)
    u_phi = Symbol("u_phi", real=True)
    xi = Symbol("xi", real=True)
    E1 = Symbol("E1", real=True)
    l = Symbol("l", positive=True)
    return PhaseSystem(
        f=[2*E*K*u_phi/(sqrt(2*E*K**2 + 1)*cos(xi) - 1) - sqrt(2)*u_r*sqrt(-E)*sqrt(2*E*K**2 + 1)*sin(xi)/(sqrt(2*E*K**2 + 1)*cos(xi) - 1), u_phi*(sqrt(2*E*K**2 + 1)*cos(xi) - 1)/(2*E)],
        slow=[E, K],
        control=[u_r, u_phi],
        target=[E - E1],
        phase=xi,
        omega=2*sqrt(2)*(-E)**(Rational(3, 2)),
        weight=-sqrt(2*E*K**2 + 1)*cos(xi) + 1,
        running_cost=l,
        terminal_cost=0,
        phase_rate=-K*u_phi*(sqrt(2*E*K**2 + 1)*cos(xi) - 2)*sin(xi)/(sqrt(2*E*K**2 + 1)*(sqrt(2*E*K**2 + 1)*cos(xi) - 1)) - sqrt(2)*u_r*(-2*sqrt(2*E*K**2 + 1) + (2*E*K**2 + 1)*cos(xi) + cos(xi))/(2*sqrt(-E)*sqrt(2*E*K**2 + 1)*(sqrt(2*E*K**2 + 1)*cos(xi) - 1)),
        control_set=Quadratic(weight=1),
        numbers=dict(zip((E1, l, ), values, strict=True)),
    )


def spin_down(*values: ArrayLike) -> PhaseSystem:
    """Example 3, with values of l_x, l_y, l_z, d, sense."""
    a = Symbol("a", positive=True)
    c = Symbol("c", real=True)
    u_x = Symbol("u_x", real=True)
    u_y = Symbol("u_y", real=True)
    u_z = Symbol("u_z", real=True)
    psi = Symbol("psi", real=True)
    l_x = Symbol("l_x", positive=True)
    l_y = Symbol("l_y", positive=True)
    l_z = Symbol("l_z", positive=True)
    d = Symbol("d", positive=True)
    sense = Symbol("sense", real=True)
    return PhaseSystem(
        f=[sense*u_y*sin(psi) + u_x*cos(psi), u_z],
        slow=[a, c],
        control=[u_x, u_y, u_z],
        target=[a],
        phase=psi,
        omega=c*sense*(d - 1),
        weight=1,
        running_cost=1,
        terminal_cost=0,
        phase_rate=sense*u_y*cos(psi)/a - u_x*sin(psi)/a,
        control_set=Ellipsoid(semiaxes=(l_x, l_y, l_z)),
        numbers=dict(zip((l_x, l_y, l_z, d, sense, ), values, strict=True)),
    )
