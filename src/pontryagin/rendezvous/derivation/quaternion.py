"""Hamilton's quaternions as columns, scalar part first.

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
    """The quaternion with scalar part 0 and a given vector part."""
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
    """Hamilton's product of two or more quaternions, in their order."""
    a, *others = factors
    for b in others:
        a = sp.Matrix(
            [
                scal(a) * scal(b) - vect(a).dot(vect(b)),
                *(scal(a) * vect(b) + scal(b) * vect(a) + vect(a).cross(vect(b))),
            ]
        )
    return a


def turn(axis: sp.Matrix, angle: sp.Expr) -> sp.Matrix:
    """The quaternion of the rotation by an angle about a unit axis."""
    return sp.Matrix([sp.cos(angle / 2), *(sp.sin(angle / 2) * axis)])


def rotated(vector: sp.Matrix, attitude: sp.Matrix) -> sp.Matrix:
    """a o x o a~: the inertial components of a vector x that is given in the axes of the attitude a."""
    return vect(product(attitude, pure(vector), conjugate(attitude)))
