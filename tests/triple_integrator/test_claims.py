"""The ledger of Gorelov & Morozova 2012, entry by entry, and proof that each of its checks can fail."""

import re
from dataclasses import replace

import pytest
import sympy as sp

from pontryagin.evidence import Equality, LinearSystem, Refutation
from pontryagin.ledger import VERDICTS, Unsupported, counts
from pontryagin.triple_integrator.claims import ENTRIES, model, principle, problems, reach

R = sp.Rational

LABELS = [entry.label for entry in ENTRIES]
by_label = pytest.mark.parametrize("entry", ENTRIES, ids=LABELS)
NUMBERED = (
    [f"(0.{k})" for k in range(1, 10)]
    + [f"(1.{k})" for k in range(1, 21)]
    + [f"(2.{k})" for k in range(1, 6)]
    + [f"(3.{k})" for k in range(1, 21)]
    + [f"(4.{k})" for k in range(1, 11)]
)


@by_label
def test_the_verdict_is_earned(entry):
    entry.check()


@by_label
def test_no_other_verdict_is(entry):
    for verdict in set(VERDICTS) - {entry.verdict}:
        with pytest.raises(Unsupported):
            replace(entry, verdict=verdict, remark="altered").check()


def altered_prints(evidence):
    """The evidence with one printed left-hand side altered at a time."""
    if isinstance(evidence, LinearSystem):
        for k, side in enumerate(evidence.printed):
            altered = [*evidence.printed]
            altered[k] = side + 1
            yield replace(evidence, printed=altered)
    elif getattr(evidence, "formula", None):
        for formula in altered_prints(evidence.formula):
            yield replace(evidence, formula=formula)
    elif isinstance(evidence, Equality):
        for left, side in evidence.printed.items():
            off = sp.ones(*side.shape) if isinstance(side, sp.MatrixBase) else 1
            yield replace(evidence, printed={**evidence.printed, left: side + off})


@pytest.mark.parametrize(
    "entry",
    [entry for entry in ENTRIES if entry.printed is not None],
    ids=[entry.label for entry in ENTRIES if entry.printed is not None],
)
def test_any_other_print_changes_the_verdict(entry):
    altered = list(altered_prints(entry.evidence))
    assert altered
    readable = getattr(entry.evidence, "legible", None)
    for evidence, left in zip(altered, entry.printed, strict=True):
        if readable is None or left in readable:
            with pytest.raises(Unsupported):
                replace(entry, build=lambda evidence=evidence: evidence).check()


@pytest.mark.parametrize(
    "entry", [e for e in ENTRIES if e.verdict == "misprint"], ids=lambda entry: entry.label
)
def test_a_corrected_print_is_no_misprint(entry):
    corrected = replace(entry.evidence, printed=entry.evidence.derivation())
    with pytest.raises(Unsupported, match="no misprint"):
        replace(entry, build=lambda: corrected).check()


@pytest.mark.parametrize(
    "entry", [e for e in ENTRIES if e.verdict in ("false", "conditional")], ids=lambda entry: entry.label
)
def test_without_its_counterexample_a_claim_stands(entry):
    def nothing():
        yield from ()

    with pytest.raises(Unsupported):
        replace(entry, build=lambda: replace(entry.evidence, counterexample=nothing)).check()


@pytest.mark.parametrize(
    "entry", [e for e in ENTRIES if e.verdict in ("false", "conditional")], ids=lambda entry: entry.label
)
def test_a_counterexample_names_numbers_and_has_a_certificate(entry):
    steps = list(entry.evidence.counterexample())
    assert len(steps) >= 2
    assert any(re.search(r"\d", words) for words, _ in steps)


@pytest.mark.parametrize(
    ("module", "name", "wrong", "label"),
    [
        (reach, "PULSE", [(R(5, 8), 0), (R(1, 4), 5), (R(1, 8), 0)], "after (4.10): solution"),
        (reach, "PULSE", [(R(3, 8), 0), (R(1, 4), 4), (R(3, 8), 0)], "after (4.10): sum"),
        (reach, "F", 16 * sp.Symbol("c1", real=True), "after (4.10): F = 0"),
        (model, "BANG_BANG", [(R(1, 3), 32), (R(1, 3), -32), (R(1, 3), 32)], "(0.7)"),
        (problems, "IMPULSE_DUAL", sp.Matrix([1, R(-1, 2), R(1, 17)]), "after (1.20)"),
        (principle, "IMPULSE_DUAL", sp.Matrix([1, R(-1, 2), R(1, 17)]), "before (1.13): isometry"),
    ],
)
def test_a_wrong_counterexample_is_not_certified(monkeypatch, module, name, wrong, label):
    entry = next(entry for entry in ENTRIES if entry.label == label)
    monkeypatch.setattr(module, name, wrong)
    with pytest.raises(Unsupported, match="step fails"):
        entry.check()


def test_every_numbered_formula_is_there_in_the_papers_order():
    numbered = [label for label in LABELS if re.fullmatch(r"\(\d\.\d+\)", label)]
    assert numbered == NUMBERED


def test_labels_are_unique_and_statements_say_something():
    assert len(set(LABELS)) == len(LABELS)
    assert all(len(entry.statement) > 10 or entry.printed_latex for entry in ENTRIES)


def test_at_least_three_claims_fail_as_stated():
    tally = counts(ENTRIES)
    assert tally["false"] + tally["conditional"] >= 3
    assert tally["not checked"] == 0
    assert not any(isinstance(entry.evidence, Refutation) for entry in ENTRIES if entry.verdict == "holds")
