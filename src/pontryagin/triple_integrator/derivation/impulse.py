"""Least total impulse: the complete solution, of which (4.10) is a part.

In sigma = s/T the control's moments of 1, sigma, sigma^2 are mu = (c3, c2/T, 2 c1/T^2). The least total
impulse is the largest p.mu over the quadratics with |p| <= 1 on [0, 1], and the optimal impulses act where
the best p touches its bounds. Up to sign and reversal of time, the extreme points of that set of quadratics
are the constant 1 and the family

    p(sigma) = 2 (1 - x sigma)^2 - 1,      1 <= x <= 2,

which starts at +1, touches -1 at 1/x and ends at or below +1. So the least total impulse is a maximum of
closed forms: |mu0|; the values at the two ends of the family and, if it lies between them, at its stationary
point x = mu1/mu2; and the same values with time reversed.
"""

import sympy as sp

from pontryagin.triple_integrator.derivation import model

m0, m1, m2, x, sigma = sp.symbols("m0 m1 m2 x sigma", real=True)
c1, c2, c3 = model.c


def scaled_moments() -> sp.Matrix:
    """mu = (c3, c2/T, 2 c1/T^2), the moments of 1, sigma and sigma^2."""
    powers = sp.Matrix([1, model.s / model.T, (model.s / model.T) ** 2])
    response = model.impulse_response()
    weights = [sp.Poly(power, model.s) for power in powers]
    return sp.Matrix(
        [
            sum(
                poly.coeff_monomial(model.s**i) * moment / sp.Poly(h, model.s).coeff_monomial(model.s**i)
                for i, (h, moment) in enumerate(zip(reversed(response), reversed(model.c), strict=True))
            )
            for poly in weights
        ]
    )


def extreme_quadratic() -> sp.Expr:
    """p(sigma) = 2 (1 - x sigma)^2 - 1."""
    return 2 * (1 - x * sigma) ** 2 - 1


def pairing(polynomial: sp.Expr) -> sp.Expr:
    """p.mu of a quadratic in sigma."""
    poly = sp.Poly(sp.expand(polynomial), sigma)
    return sum(poly.coeff_monomial(sigma**i) * moment for i, moment in enumerate((m0, m1, m2)))


def best_touching_point() -> sp.Expr:
    """The x at which the bound by the family is stationary: x = mu1/mu2."""
    return sp.solve(sp.diff(pairing(extreme_quadratic()), x), x)[0]


def reversed_moments() -> sp.Matrix:
    """Moments of the same control in 1 - sigma."""
    return sp.Matrix([pairing((1 - sigma) ** i) for i in range(3)])


def amplitudes(places: list[sp.Expr]) -> sp.Matrix:
    """Impulses at up to three places in sigma, from as many of the first moments mu as there are places."""
    count = len(places)
    system = sp.Matrix(count, count, lambda i, j: places[j] ** i)
    return system.LUsolve(sp.Matrix([m0, m1, m2][:count])).applyfunc(sp.factor)


def chebyshev_amplitudes() -> sp.Matrix:
    """Impulses at sigma = 0, 1/2, 1, (4.10)."""
    return amplitudes([sp.Integer(0), sp.Rational(1, 2), sp.Integer(1)])


def two_impulses() -> sp.Matrix:
    """Impulses at sigma = 0 and mu2/mu1: their sizes fit the first two moments, the place the third."""
    return amplitudes([sp.Integer(0), m2 / m1])
