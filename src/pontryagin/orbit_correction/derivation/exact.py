"""Ellipsoids, and rational systems on which sections 2 to 6 are checked without rounding.

An ellipsoid is L B, where B is the unit ball, and has the support function sqrt(p'LL'p). A system can be
built so that this root is rational for one initial costate psi_0 and the costates that follow from it. Then
all support points, states and controls of the theory are rational, in any dimension.
"""

from dataclasses import dataclass
from functools import cached_property
from random import Random

import sympy as sp

from pontryagin.orbit_correction.derivation.summands import backward_product


@dataclass(frozen=True)
class Ellipsoid:
    """{L w : |w| <= 1} for a nonsingular factor L (n, n): strictly convex, compact, 0 inside."""

    factor: sp.ImmutableMatrix

    @cached_property
    def shape(self) -> sp.Matrix:
        """H = (L L')^-1, so that the set is (x, H x) <= 1."""
        return (self.factor * self.factor.T).inv()

    def level(self, x: sp.Matrix) -> sp.Expr:
        """(x, H x), the square of the Minkowski functional: below 1 inside, 1 on the boundary."""
        return (x.T * self.shape * x)[0]

    def support(self, p: sp.Matrix) -> sp.Expr:
        """s(p): the largest (p, x) in the set."""
        return sp.sqrt((p.T * self.factor * self.factor.T * p)[0])

    def point(self, p: sp.Matrix) -> sp.Matrix:
        """The support point rho(p) of Lemma 2, where (p, x) is largest, for p other than 0."""
        return self.factor * self.factor.T * p / self.support(p)

    def normal(self, x: sp.Matrix) -> sp.Matrix:
        """A normal at the boundary point x, half the gradient of (x, H x)."""
        return self.shape * x

    def image(self, A: sp.Matrix) -> "Ellipsoid":
        """A X, an ellipsoid by Lemma 8, whose normals are carried by A^-T, Lemma 3."""
        return Ellipsoid(sp.ImmutableMatrix(A * self.factor))


@dataclass(frozen=True)
class ExactSystem:
    """System (1) with ellipsoids U(k), and a costate along which all support functions are rational.

    Examples
    --------
    >>> system = exact_system(3, steps=3, seed=1)
    >>> all(part.is_Rational for part in system.boundary_state())
    True
    >>> system.fly(system.boundary_state(), system.controls())[-1].is_zero_matrix
    True
    """

    A: tuple[sp.ImmutableMatrix, ...]
    U: tuple[Ellipsoid, ...]
    psi0: sp.ImmutableMatrix

    @property
    def steps(self) -> int:
        """The number of steps."""
        return len(self.A)

    @cached_property
    def costates(self) -> list[sp.Matrix]:
        """psi(k) by the recursion of Theorem 2 and (6), for k = 0 to the number of steps."""
        costates = [sp.Matrix(self.psi0)]
        for A in self.A:
            costates.append(A.inv().T * costates[-1])
        return costates

    def summands(self, N: int, k: int = 0) -> list[Ellipsoid]:
        """The ellipsoids -A^-1(k) ... A^-1(i+k) U(i+k) whose sum is X(N, k), Lemma 1."""
        return [self.U[k + i].image(-backward_product(self.A[k : k + i + 1])) for i in range(N)]

    def support(self, p: sp.Matrix, N: int, k: int = 0) -> sp.Expr:
        """Support function of X(N, k) of (2)."""
        return sum((part.support(p) for part in self.summands(N, k)), sp.S.Zero)

    def point(self, p: sp.Matrix, N: int, k: int = 0) -> sp.Matrix:
        """Support point of X(N, k): the sum of those of the summands, Lemma 4, Lemma 5 and (10)."""
        return sum((part.point(p) for part in self.summands(N, k)), sp.zeros(*self.psi0.shape))

    def boundary_state(self) -> sp.Matrix:
        """x0 on the boundary of X(N, 0) for all N steps, with normal -psi_0 (9): Lemma 9, (8) and (11)."""
        return self.point(-self.costates[0], self.steps)

    @cached_property
    def inner_gauge(self) -> sp.Expr:
        """An alpha below 1 for which alpha times the boundary state still needs all the steps."""
        p = -self.costates[0]
        whole, shorter = (self.support(p, N) for N in (self.steps, self.steps - 1))
        return (whole + shorter) / (2 * whole)

    def inner_state(self) -> sp.Matrix:
        """x0 of the case (5): inside X(N, 0), with the gauge `inner_gauge`, and outside X(N - 1, 0)."""
        return self.inner_gauge * self.boundary_state()

    def controls(self) -> list[sp.Matrix]:
        """u(k) = arg max over U(k) of (A^-T(k) psi(k), u), Theorem 3; for ellipsoids this is Lemma 10.

        By (4) the normal psi(k+1) = A^-T(k) psi(k) of U(k) at u(k) is, but for its sign, one at x(k+1).
        """
        return [U.point(costate) for U, costate in zip(self.U, self.costates[1:], strict=True)]

    def fly(self, x0: sp.Matrix, controls: list[sp.Matrix]) -> list[sp.Matrix]:
        """The states from x0 under the controls, by (1); from the boundary the steps (3) of Theorem 1."""
        states = [x0]
        for A, u in zip(self.A, controls, strict=True):
            states.append(A * states[-1] + u)
        return states


def exact_system(n: int, steps: int, seed: int) -> ExactSystem:
    """A system in R^n, n at least 2, of random rational matrices that a seed determines.

    A(k) is chosen so that it carries psi(k) to a psi(k+1) for which L(k)'psi(k+1) has rational length.
    """
    draw = Random(seed)
    psi = _vector(draw, n)
    start = psi
    transitions: list[sp.ImmutableMatrix] = []
    controls: list[Ellipsoid] = []
    while len(transitions) < steps:
        L = sp.Matrix([[_lower_triangular(draw, i, j) for j in range(n)] for i in range(n)])
        following = L.inv().T * _rational_direction(draw, n) * draw.randint(1, 3)
        any_matrix = 2 * sp.eye(n) + sp.Matrix(n, n, [draw.randint(-2, 2) for _ in range(n * n)])
        inverse = any_matrix + (following - any_matrix * psi) * psi.T / (psi.T * psi)[0]
        if inverse.det() == 0:
            continue
        transitions.append(sp.ImmutableMatrix(inverse.inv().T))
        controls.append(Ellipsoid(sp.ImmutableMatrix(L)))
        psi = following
    return ExactSystem(tuple(transitions), tuple(controls), sp.ImmutableMatrix(start))


def _lower_triangular(draw: Random, i: int, j: int) -> int:
    if i == j:
        return draw.randint(1, 3)
    return draw.randint(-1, 1) if i > j else 0


def _vector(draw: Random, n: int) -> sp.Matrix:
    return sp.Matrix([draw.choice([-3, -2, -1, 1, 2, 3]) for _ in range(n)])


def _rational_direction(draw: Random, n: int) -> sp.Matrix:
    """A rational point of the unit sphere, by stereographic projection."""
    t = _vector(draw, n - 1)
    square = (t.T * t)[0]
    return sp.Matrix([*(2 * t), square - 1]) / (square + 1)


LENS_CENTRES = (sp.Matrix([-sp.Rational(3, 5), 0]), sp.Matrix([sp.Rational(3, 5), 0]))
"""Centres of the two unit discs whose intersection is the lens, a strictly convex set with corners."""

LENS_CORNER = sp.Matrix([0, sp.Rational(4, 5)])
"""The upper corner of the lens."""


def lens_level(x: sp.Matrix) -> sp.Expr:
    """The larger of the squared distances from the two centres: at most 1 in the lens."""
    return sp.Max(*((x - centre).dot(x - centre) for centre in LENS_CENTRES))


def lens_corner_normals() -> tuple[sp.Matrix, sp.Matrix]:
    """The edges of the normal cone at the corner: the outer normals of the two discs."""
    return (LENS_CORNER - LENS_CENTRES[0], LENS_CORNER - LENS_CENTRES[1])


def normal_at_lens_corner(p: sp.Matrix) -> bool:
    """Whether p is normal at the corner: a nonnegative combination of the edges of its normal cone."""
    weights = sp.Matrix.hstack(*lens_corner_normals()).solve(p)
    return bool(p.norm() > 0 and min(weights) >= 0)
