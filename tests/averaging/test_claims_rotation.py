"""The ledger of Akulenko 1977, examples 1 and 3, entry by entry; each of its checks can fail."""

from dataclasses import replace

import pytest
import sympy as sp

from pontryagin.averaging.claims import least_time, rigid, rigid_cylinder, rigid_ellipsoid, rotor, smooth
from pontryagin.averaging.derivation import rigid_body
from pontryagin.averaging.derivation import smooth as smooth_derivation
from pontryagin.ledger import Unsupported, counts

R = sp.Rational
IN_ORDER = (rotor, least_time, smooth, rigid, rigid_ellipsoid, rigid_cylinder)
ENTRIES = [entry for part in IN_ORDER for entry in part.claim]
LABELS = [entry.label for entry in ENTRIES]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("module", "name", "wrong", "label"),
    [
        (least_time, "TILTED", sp.cos(least_time.x), "example 1: mean force"),
        (smooth, "COST", smooth.COST + smooth.kappa, "after (3.2): J0"),
        (smooth, "XI", smooth.XI + smooth.kappa, "(3.2)"),
        (rigid_ellipsoid, "SLENDER", rigid_body.SYMMETRIC, "example 3: nearly symmetric body"),
        (rigid_cylinder, "SHORT", rigid_cylinder.LEVEL, "example 3: singular controls"),
        (rigid_cylinder, "LEVEL", rigid_cylinder.SHORT, "example 3: singular controls"),
    ],
)
def test_a_wrong_example_is_not_certified(monkeypatch, module, name, wrong, label):
    entry = next(entry for entry in ENTRIES if entry.label == label)
    monkeypatch.setattr(module, name, wrong)
    with pytest.raises(Unsupported):
        replace(entry).check()


@pytest.mark.parametrize(
    ("module", "name", "wrong", "label"),
    [
        (rigid_body, "deceleration", lambda: rigid_body.lx, "example 3: ⟨R⟩"),
        (rigid_body, "phase_rate", lambda: sp.S.Zero, "after (3.10): standard form"),
        (smooth_derivation, "turned", lambda: smooth_derivation.v1, "after J0: second derivative"),
    ],
)
def test_a_wrong_derivation_is_found_out(monkeypatch, module, name, wrong, label):
    entry = next(entry for entry in ENTRIES if entry.label == label)
    monkeypatch.setattr(module, name, wrong)
    with pytest.raises((Unsupported, ArithmeticError)):
        replace(entry).check()


def test_the_tally():
    tally = counts(ENTRIES)
    assert tally["not checked"] == tally["unreadable"] == 0
    misprints = [entry.label for entry in ENTRIES if entry.verdict == "misprint"]
    assert misprints == [
        "example 1: special case",
        "example 1: with mean force",
        "(3.2)",
        "example 3: synthesis",
        "example 3: controls on the cylinder",
    ]


def test_the_averaged_solution_meets_its_conditions_and_the_printed_one_does_not():
    state, costate = smooth_derivation.averaged_solution()
    tau, T, gap, v1 = (getattr(smooth_derivation, name) for name in ("tau", "T", "gap", "v1"))
    for speed, residual in ((state, 0), (smooth.XI, smooth.kappa * T**2 / 2)):
        assert sp.expand(speed.subs(tau, T)) == v1
        assert sp.expand(speed.subs(tau, 0) - (v1 + gap) - residual) == 0
    assert sp.expand(state.diff(tau) - costate / 2) == 0
    assert sp.expand(smooth.XI.diff(tau) - smooth.ETA / 2) != 0
