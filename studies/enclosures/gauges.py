"""Gauges of sums of ellipsoids, discs and squares: a costate's bound, and controls completed to reach b.

What controls w miss of b is added with the least energy, y = (sum G G')^-1 (b - sum G w) and w + G'y. Then
the largest size of a control is an upper bound on the gauge.
"""

from collections.abc import Callable, Sequence
from typing import Any

from flint import arb, arb_mat

from pontryagin.orbit_correction import DiscreteSystem, Gauge, Plan
from studies.enclosures.ball import Enclosure, dot, exact, greatest, length, row, solved

Vector = list[arb]
Factor = list[Vector]
"""The columns of G_k."""
Size = Callable[[Sequence[arb]], arb]


def total(vector: Sequence[arb]) -> arb:
    """The sum of the moduli, the support function of the square."""
    return sum((abs(x) for x in vector), arb(0))


def extent(vector: Sequence[arb]) -> arb:
    """The largest modulus, the gauge of the square."""
    return greatest([abs(x) for x in vector])


def along(factor: Factor, psi: Sequence[arb]) -> Vector:
    """G'psi."""
    return [dot(column, psi) for column in factor]


def reached(factors: Sequence[Factor], controls: Sequence[Sequence[arb]]) -> Vector:
    """The sum of G w."""
    columns = [column for factor in factors for column in factor]
    shares = [w for control in controls for w in control]
    return [dot([column[i] for column in columns], shares) for i in range(len(columns[0]))]


def lower_bound(factors: Sequence[Factor], b: Sequence[arb], psi: Sequence[arb], support: Size) -> arb:
    """(b, psi) over the support function of the sum."""
    return dot(b, psi) / sum((support(along(factor, psi)) for factor in factors), arb(0))


def upper_bound(
    factors: Sequence[Factor], b: Sequence[arb], controls: Sequence[Sequence[arb]], size: Size
) -> arb:
    """The largest size of the completed controls."""
    n = len(b)
    columns = [column for factor in factors for column in factor]
    gram = [[dot([c[i] for c in columns], [c[j] for c in columns]) for j in range(n)] for i in range(n)]
    missing = [x - y for x, y in zip(b, reached(factors, controls), strict=True)]
    y = solved(gram, missing)
    completed = (
        [w + more for w, more in zip(control, along(factor, y), strict=True)]
        for factor, control in zip(factors, controls, strict=True)
    )
    return greatest([size(control) for control in completed])


def ellipsoid_factors(system: DiscreteSystem, steps: int, n: int) -> list[Factor]:
    """The columns of (A(k) ... A(0))^-1 L(k), with L L' = H(k)^-1."""
    product = arb_mat([[arb(i == j) for j in range(n)] for i in range(n)])
    factors = []
    for k in range(steps):
        A, H = (arb_mat([row(line) for line in given[k]]) for given in (system.A, system.H))
        product = product * A.inv()
        root = _cholesky(H).inv().transpose()
        factor = (product * root).transpose().tolist()
        factors.append(factor)
    return factors


def _cholesky(matrix: arb_mat) -> arb_mat:
    """C with C C' = matrix, lower triangular."""
    n = matrix.nrows()
    C = [[arb(0)] * n for _ in range(n)]
    for j in range(n):
        for i in range(j, n):
            rest = matrix[i, j] - dot(C[i][:j], C[j][:j])
            C[i][j] = rest.sqrt() if i == j else rest / C[j][j]
    return arb_mat(C)


def gauge(system: DiscreteSystem, x0: Any, steps: int, found: Gauge) -> Enclosure:
    """The gauge of a state in a sum of ellipsoids. The controls are those of the costate, by Lemma 10."""
    b, psi = [-x for x in row(x0)], row(found.costate)
    factors = ellipsoid_factors(system, steps, len(b))
    lower = lower_bound(factors, b, psi, length)
    controls = []
    for factor in factors:
        direction = along(factor, psi)
        size = length(direction)
        controls.append([lower * w / size for w in direction])
    return Enclosure(float(found.alpha), lower, upper_bound(factors, b, controls, length))


def impulse_factors(plan: Plan, steps: int) -> list[Factor]:
    """The columns of G_k for a peak of 1: effects e^(-A j interval) of impulses on the initial deviation."""
    interval = exact(plan.thrust.interval)
    columns = []
    for j in range(-(-3 * steps // 2) if plan.thrust.name == "ball" else steps):
        sine, cosine = (-j * interval).sin(), (-j * interval).cos()
        columns += [[sine, cosine, -sine], [2 * (1 - cosine), 2 * sine, 2 * cosine - 1]]
    width = 3 if plan.thrust.name == "ball" else 2
    return [columns[width * k : width * (k + 1)] for k in range(steps)]


def _sizes(plan: Plan) -> tuple[Size, Size]:
    """Support function and gauge of the set of impulses."""
    return (total, extent) if plan.thrust.name == "box" else (length, length)


def correction(plan: Plan) -> Enclosure:
    """The gauge of a plan of `correct`, from its impulses and its costate."""
    steps, bound = int(plan.steps), exact(plan.thrust.peak)
    factors, b = impulse_factors(plan, steps), [-x / bound for x in row(plan.z0)]
    support, size = _sizes(plan)
    controls = [[w / bound for w in row(control)] for control in plan.step_controls[:steps]]
    lower = lower_bound(factors, b, row(plan.initial_costate), support)
    return Enclosure(float(plan.gauge), lower, upper_bound(factors, b, controls, size))


def fewest(plan: Plan, costate: Any) -> bool:
    """Whether a costate proves that one step less does not suffice."""
    support, _ = _sizes(plan)
    factors = impulse_factors(plan, int(plan.steps) - 1)
    b = [-x / exact(plan.thrust.peak) for x in row(plan.z0)]
    return bool(lower_bound(factors, b, row(costate), support) > 1)
