"""The ledger of Akulenko 1977, examples 1 and 3, entry by entry; each of its checks can fail."""

import re
from dataclasses import replace

import pytest
import sympy as sp

from pontryagin.averaging.claims import least_time, rigid, rigid_cylinder, rigid_ellipsoid, rotor, smooth
from pontryagin.averaging.derivation import rigid_body
from pontryagin.averaging.derivation import smooth as smooth_derivation
from pontryagin.evidence import Misprint
from pontryagin.ledger import VERDICTS, Unsupported, counts

R = sp.Rational
IN_ORDER = (rotor, least_time, smooth, rigid, rigid_ellipsoid, rigid_cylinder)
ENTRIES = [entry for part in IN_ORDER for entry in part.claim]
LABELS = [entry.label for entry in ENTRIES]
WITH_PRINT = [entry for entry in ENTRIES if entry.printed is not None]
REFUTED = [entry for entry in ENTRIES if hasattr(entry.evidence, "counterexample")]


@pytest.mark.parametrize("entry", ENTRIES, ids=LABELS)
def test_the_verdict_is_earned_and_no_other(entry):
    entry.check()
    found = entry.evidence.finding()
    assert found == entry.verdict
    for verdict in set(VERDICTS) - {entry.verdict}:
        with pytest.raises(Unsupported):
            replace(entry, verdict=verdict, remark="altered", build=lambda: Found(found)).check()


class Found:
    """Evidence that has been checked: it finds again what it found."""

    def __init__(self, verdict):
        self.verdict = verdict

    def finding(self):
        return self.verdict


def altered_prints(evidence):
    """The evidence with one printed right-hand side altered at a time."""
    if getattr(evidence, "formula", None):
        for left, formula in altered_prints(evidence.formula):
            yield left, replace(evidence, formula=formula)
        return
    for left, side in evidence.printed.items():
        yield left, replace(evidence, printed={**evidence.printed, left: side + 1})


@pytest.mark.parametrize("entry", WITH_PRINT, ids=[entry.label for entry in WITH_PRINT])
def test_any_other_print_changes_the_verdict(entry):
    altered = list(altered_prints(entry.evidence))
    assert altered
    for _, evidence in altered:
        with pytest.raises(Unsupported):
            evidence.finding()


@pytest.mark.parametrize(
    "entry", [e for e in ENTRIES if isinstance(e.evidence, Misprint)], ids=lambda entry: entry.label
)
def test_a_corrected_print_is_no_misprint(entry):
    corrected = replace(entry.evidence, printed=entry.evidence.derivation())
    with pytest.raises(Unsupported, match="no misprint"):
        corrected.finding()


@pytest.mark.parametrize("entry", REFUTED, ids=lambda entry: entry.label)
def test_a_counterexample_is_needed_and_names_numbers(entry):
    def nothing():
        yield from ()

    with pytest.raises(Unsupported):
        replace(entry.evidence, counterexample=nothing).finding()
    steps = list(entry.evidence.counterexample())
    assert len(steps) >= 2
    assert any(re.search(r"\d", words) for words, _ in steps)


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


def test_labels_are_unique_and_what_fails_has_a_remark():
    assert len(set(LABELS)) == len(LABELS)
    assert all(len(entry.statement) > 10 for entry in ENTRIES)
    assert all(entry.remark for entry in ENTRIES if entry.verdict != "holds")
    assert {"(3.1)", "(3.2)", "(3.10)"} <= set(LABELS)


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
