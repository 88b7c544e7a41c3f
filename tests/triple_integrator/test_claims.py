"""The ledger of Gorelov & Morozova 2012, entry by entry, and proof that each of its checks can fail."""

import re

import pytest
import sympy as sp

from pontryagin.ledger import Unsupported, counts
from pontryagin.ledger.evidence import Refutation
from pontryagin.triple_integrator.claims import ENTRIES, model, principle, problems, reach

R = sp.Rational

LABELS = [entry.label for entry in ENTRIES]
NUMBERED = (
    [f"(0.{k})" for k in range(1, 10)]
    + [f"(1.{k})" for k in range(1, 21)]
    + [f"(2.{k})" for k in range(1, 6)]
    + [f"(3.{k})" for k in range(1, 21)]
    + [f"(4.{k})" for k in range(1, 11)]
)


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


def test_at_least_three_claims_fail_as_stated():
    tally = counts(ENTRIES)
    assert tally["false"] + tally["conditional"] >= 3
    assert tally["not checked"] == 0
    assert not any(isinstance(entry.evidence, Refutation) for entry in ENTRIES if entry.verdict == "holds")
