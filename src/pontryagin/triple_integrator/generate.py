"""Writes `kernels.py` from the derivation: ``python -m pontryagin.triple_integrator.generate``."""

from pathlib import Path

import sympy as sp

from pontryagin.io.files import write
from pontryagin.numerics.compile import source
from pontryagin.triple_integrator.derivation import energy, impulse, model, peak, time

HEADER = '''"""Numeric kernels of the triple integrator.

Generated from the derivation by `make kernels`; do not edit.
"""
'''

G1, G2 = sp.symbols("g1 g2", real=True)
K = (peak.k1, peak.k2, peak.k3)
MU = (impulse.m0, impulse.m1, impulse.m2)


def kernels() -> str:
    """The text of `kernels.py`."""
    parts = [*_model(), *_energy(), *_peak(), *_impulse(), *_time()]
    return HEADER + "\n\n" + "\n\n\n".join(parts) + "\n"


def _model() -> list[str]:
    start = sp.Matrix(sp.symbols("x10 x20 x30", real=True))
    end = sp.Matrix(sp.symbols("x1f x2f x3f", real=True))
    coast = (model.transition(model.T) * start).applyfunc(lambda x: sp.horner(x, wrt=model.T))
    moments = end - coast - sp.Matrix([G1, G2, 0])
    return [
        source(
            "coast",
            [*start, model.T],
            dict(zip(("x1", "x2", "x3"), coast, strict=True)),
            "Phi(t, t0) x0, (1.4).",
        ),
        source(
            "moments",
            [*start, *end, model.T, G1, G2],
            dict(zip(("c1", "c2", "c3"), moments, strict=True)),
            "c, (1.10); g1 and g2 are the disturbance's integrals (1.8).",
        ),
        source(
            "dual_function",
            [*model.multipliers, model.s],
            {"h": model.dual_function()},
            "h(s) = l'h(s), (1.12), (3.3).",
        ),
    ]


def _energy() -> list[str]:
    control = sp.Poly(sp.expand(energy.minimum_energy_control()), model.s)
    coefficients = [sp.factor(control.coeff_monomial(model.s**i)) for i in range(3)]
    gramian = energy.gramian()
    multipliers = gramian.inv() * model.c
    return [
        source(
            "energy_control",
            [*model.c, model.T],
            {f"u{i}": value for i, value in enumerate(coefficients)},
            "Coefficients of 1, s, s^2 in the least-energy control (2.2), (2.3).",
        ),
        source(
            "energy_multipliers",
            [*model.c, model.T],
            {f"l{i + 1}": value for i, value in enumerate(multipliers)},
            "D^-1 c: multipliers up to a factor, before (2.2).",
        ),
        source(
            "gramian_form",
            [*model.multipliers, model.T],
            {"form": (model.multipliers.T * gramian * model.multipliers)[0]},
            "l'Dl, the squared L2 norm of the dual function, (2.1).",
        ),
    ]


def _peak() -> list[str]:
    equation = peak.level_equation()
    near = peak.near_constant_equation().subs(peak.t, (1 - peak.y) / peak.k3)
    moments = peak.bang_bang_moments()
    return [
        source(
            "level_equation",
            [peak.t, *K],
            {"g": equation, "slope": sp.diff(equation, peak.t)},
            "G(t) = 0 at t = 1/v, convex, and its derivative.",
        ),
        source(
            "near_constant_equation",
            [peak.y, peak.k3, peak.w, peak.e2],
            {"g": near, "slope": sp.diff(near, peak.y)},
            "The same in y = 1 - k3 t, and its derivative in y.",
        ),
        source(
            "bang_bang_moments",
            [peak.v, peak.a, peak.b],
            dict(zip(("k1", "k2", "k3"), moments, strict=True)),
            "Scaled moments of v outside [b, a] and -v inside.",
        ),
        source(
            "peak_bound",
            [*K, peak.a, peak.b],
            {"bound": peak.dual_bound()},
            "Lower bound (up to its sign) on the peak from the dual function (s - a)(s - b).",
        ),
    ]


def _impulse() -> list[str]:
    reversed_moments = impulse.reversed_moments()
    return [
        source(
            "pairing",
            [impulse.x, *MU],
            {"value": sp.expand(impulse.pairing(impulse.extreme_quadratic()))},
            "p.mu for p = 2 (1 - x sigma)^2 - 1.",
        ),
        source(
            "reversed_moments",
            list(MU),
            {f"r{i}": value for i, value in enumerate(reversed_moments)},
            "Moments of the same control in 1 - sigma.",
        ),
        source(
            "chebyshev_amplitudes",
            list(MU),
            dict(zip(("a_end", "a_middle", "a_start"), impulse.chebyshev_amplitudes(), strict=True)),
            "Impulses at sigma = 0, 1/2, 1 with these moments, (4.10).",
        ),
        source(
            "two_impulses",
            list(MU),
            dict(zip(("a_end", "a_inside"), impulse.two_impulses().applyfunc(sp.expand), strict=True)),
            "Impulses at sigma = 0 and mu2/mu1 with these moments.",
        ),
    ]


def _time() -> list[str]:
    ends = [time.x10, time.x20, time.x30, time.x1f, time.x2f, time.x3f, time.f]
    r20, r21, w0, w1, w2, c3 = time.coefficient_symbols()
    branches = time.in_excess_time()
    return [
        source(
            "small_parts",
            [*ends, c3],
            dict(zip(("r20", "r21", "w0", "w1", "w2"), time.small_part_coefficients(), strict=True)),
            "r2 = r20 + r21 z and w = w0 + w1 z + w2 z^2 in z = T - c3, for c3 >= 0.",
        ),
        *(
            source(
                f"{name}_branch",
                [r20, r21, w0, w1, w2, c3],
                {f"q{i}": value for i, value in enumerate(coefficients)},
                f"Quartic in z = T - c3 for the level of {name} sign as c3, constant term first.",
            )
            for name, coefficients in branches.items()
        ),
    ]


def main() -> None:
    """Write the file beside this one."""
    write(Path(__file__).with_name("kernels.py"), kernels())


if __name__ == "__main__":
    main()
