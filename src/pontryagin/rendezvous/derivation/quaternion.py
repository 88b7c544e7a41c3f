"""Hamilton's quaternions as columns (scalar first): what the papers' formulas need of them, and no more.

paper     here            meaning
--------  --------------  ----------------------------------------------------------------
a o b     product         Hamilton's product
a~        conjugate       conjugate
scal      scal            scalar part
vect      vect            vector part, a column of three
i1 i2 i3  I1, I2, I3      the units
"""

import sympy as sp

ONE = sp.Matrix([1, 0, 0, 0])
I1, I2, I3 = (sp.Matrix([int(k == j) for k in range(4)]) for j in (1, 2, 3))


def pure(vector: sp.Matrix) -> sp.Matrix:
    """The quaternion without scalar part that stands for a vector."""
    return sp.Matrix([0, *vector])


def scal(a: sp.Matrix) -> sp.Expr:
    """Scalar part."""
    return a[0]


def vect(a: sp.Matrix) -> sp.Matrix:
    """Vector part."""
    return sp.Matrix(a[1:])


def conjugate(a: sp.Matrix) -> sp.Matrix:
    """a~, the conjugate."""
    return sp.Matrix([scal(a), *(-vect(a))])


def product(*factors: sp.Matrix) -> sp.Matrix:
    """Hamilton's product of two quaternions or more, from the left."""
    first, *rest = factors
    for b in rest:
        first = sp.Matrix(
            [
                scal(first) * scal(b) - vect(first).dot(vect(b)),
                *(scal(first) * vect(b) + scal(b) * vect(first) + vect(first).cross(vect(b))),
            ]
        )
    return first


def turn(axis: sp.Matrix, angle: sp.Expr) -> sp.Matrix:
    """The quaternion of the turn by an angle about a unit axis."""
    return sp.Matrix([sp.cos(angle / 2), *(sp.sin(angle / 2) * axis)])


def rotated(vector: sp.Matrix, attitude: sp.Matrix) -> sp.Matrix:
    """a o x o a~: a vector given in the axes of an attitude, in inertial axes."""
    return vect(product(attitude, pure(vector), conjugate(attitude)))
