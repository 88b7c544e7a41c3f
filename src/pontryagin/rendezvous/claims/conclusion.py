"""The conclusion: the condition that the reduced problem loses, its repair, and the number of operations."""

import sympy as sp

from pontryagin.ledger import Page
from pontryagin.ledger.evidence import (
    Refutation,
    Steps,
    vanishes,
)
from pontryagin.rendezvous.claims import meetings
from pontryagin.rendezvous.claims.statement import at_unit_norm
from pontryagin.rendezvous.derivation import forms, repair, terminal, transversality
from pontryagin.rendezvous.derivation.model import attitude, c, r, thrust
from pontryagin.rendezvous.derivation.principle import nu
from pontryagin.rendezvous.derivation.quaternion import conjugate, product, pure, turn, vect

claim = Page("Pimkina & Chelnokov")

nu1, _, nu3 = nu
p3 = thrust[2]
tilde = conjugate(attitude)


@claim(
    "conclusion: reduced",
    "the boundary value problem of 16 equations is reduced to one of ten",
    verdict="false",
    remark="(15) compares two vectors of equal length and has rank 2, where (6) has rank 3. It leaves the "
    "turn about ν* free, and with it, for motion in one plane, the whole place on the orbit. Families "
    "of false meetings satisfy (5), (15), (16) and (17) to rounding; one that is 20° ahead even costs "
    "less than the true one. Repair: an eleventh equation, χ' = c/r² + (r p3/c) ν1/(|ν| + ν3), and "
    "χ(t_k) from λ*.",
)
def reduced_problem() -> Refutation:
    def counterexample() -> Steps:
        yield from rank_of_15()
        for members in (meetings.COPLANAR, meetings.INCLINED):
            yield from meetings.true_meeting(members)
            yield from meetings.false_meetings(members)
        true, cheap = (meetings.outcome(member).cost for member in meetings.COPLANAR[:2])
        yield (
            f"the false meeting 20° ahead has J = {cheap:.4f}, the true one {true:.4f}",
            cheap < 0.75 * true,
        )
        yield from repaired()

    return Refutation(counterexample)


def rank_of_15() -> Steps:
    """(6) determines all three small rotations, (15) only two."""
    yield "by small turns of λ, (6) has rank 3", repair.change_of_mismatch().rank() == 3
    seen = repair.change_of_invariant()
    yield "(15) has rank 2", seen.rank() == 2 and sp.expand(seen.det()) == 0
    (blind,) = seen.nullspace()
    yield "it does not see turns about ν", vanishes(blind.cross(nu))
    angle, axis = sp.Symbol("delta", real=True), sp.Matrix([0, 0, 1])
    turned = product(turn(axis, angle), attitude)
    aligned = product(tilde, pure(axis), attitude)
    kept = vect(product(turned, aligned, conjugate(turned))) - axis
    yield (
        "nor large ones: λ turned about ν* by any δ leaves ν* = i3 as it is",
        all(vanishes(sp.simplify(at_unit_norm(part))) for part in kept),
    )


def repaired() -> Steps:
    """The eleventh variable chi, and the rank of the repaired conditions."""
    charts: tuple[tuple[repair.Chart, str], ...] = ((1, "ν3 = −|ν|"), (-1, "ν3 = |ν|"))
    for chart, name in charts:
        relative = repair.angular_velocity(chart)
        yield f"λ = S∘(turn by χ)∘T~ solves (3), regular off {name}", vanishes(sp.Matrix(relative[:3]))
        expected = c / r**2 + chart * r * p3 / c * nu1 / (repair.length + chart * nu3)
        yield (
            f"with χ' = c/r² ± (r p3/c)ν1/(|ν| ± ν3), ± = {chart:+d}",
            vanishes(repair.chi_rate(chart) - expected),
        )
    at_end = terminal.law().subs(transversality.end_values())
    yield (
        "(16) and (17) with (5) come to (n, p) = α1 + α2p²",
        vanishes(sp.simplify(terminal.hamiltonian_at_a_meeting() - at_end)),
    )
    found = meetings.singular_values(meetings.INCLINED[0], repaired=True)
    yield f"(5), (6) and that law have rank 7: least singular value {found[-1]:.4f}", found[-1] > 1e-3


@claim.proof(
    "conclusion: simpler",
    "the right-hand sides have become simpler",
    remark="They are simpler even with the eleventh equation.",
)
def simpler() -> Steps:
    for mode in ("unsaturated", "saturated"):
        systems = (forms.full(mode), forms.repaired(mode), forms.reduced(mode))
        sixteen, eleven, ten = (sum(sp.count_ops(rate) for rate in form.rates) for form in systems)
        yield (
            f"{mode}: {sixteen} operations in 16 equations, {eleven} in 11, {ten} in 10",
            (ten < eleven < sixteen / 2),
        )
        shared = [sum(sp.count_ops(part) for part in evaluated(form)) for form in systems]
        yield (
            f"what occurs twice counted once: {shared[0]}, {shared[1]}, {shared[2]}",
            shared[2] < shared[1] < shared[0],
        )


def evaluated(form: forms.Form) -> list[sp.Expr]:
    """The expressions to evaluate when common subexpressions are evaluated once."""
    parts, rest = sp.cse(form.rates)
    return [part for _, part in parts] + list(rest)
