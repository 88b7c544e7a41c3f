"""The ledger of Ibragimov 2017: altered examples fail, and all numbered statements have entries."""

import re
from dataclasses import replace

import numpy as np
import pytest
import sympy as sp

from pontryagin.ledger import Unsupported, counts
from pontryagin.ledger.evidence import Misprint, Refutation
from pontryagin.orbit_correction import derivation
from pontryagin.orbit_correction.claims import ENTRIES, convexity, images, reduction, sums, tables, worked
from pontryagin.orbit_correction.claims.regrouping import printed_inputs
from pontryagin.orbit_correction.derivation import exact

R = sp.Rational

LABELS = [entry.label for entry in ENTRIES]


@pytest.mark.parametrize(
    ("module", "name", "wrong", "label"),
    [
        (worked, "SPARSE", (0, 2, 5), "section 1: firings"),
        (worked, "PEAK", 0.0045, "abstract"),
        (worked, "PEAK", 0.0027, "section 1: firings"),
        (worked, "Z0", worked.Z0 * 0.5, "after (12): N_min"),
        (worked, "Z0", worked.Z0 + np.array([0, 0, 1e-5]), "after (12): α"),
        (tables, "ROUNDED", np.zeros(3), "tables: rounding"),
        (tables, "STATES", tables.STATES[::-1], "tables: consistency"),
        (convexity, "E1", sp.Matrix([R(1, 2), 0]), "section 3: the class U_2"),
        (convexity, "E2", sp.Matrix([1, 0]), "section 3: normal cone"),
        (images, "E1", sp.Matrix([R(1, 2), 0]), "proof of Lemma 4: parts"),
        (sums, "E1", sp.zeros(2, 1), "proof of Lemma 5: maximum"),
        (reduction, "CORNER", sp.Matrix([R(1, 2), R(1, 2), R(1, 2)]), "regrouping: ball"),
        (exact, "LENS_CORNER", sp.Matrix([0, R(3, 5)]), "Lemma 5, iii)"),
    ],
)
def test_a_wrong_example_is_not_certified(monkeypatch, module, name, wrong, label):
    entry = next(entry for entry in ENTRIES if entry.label == label)
    monkeypatch.setattr(module, name, wrong)
    with pytest.raises(Unsupported):
        replace(entry).check()


def test_every_numbered_formula_lemma_and_theorem_is_there_in_the_papers_order():
    numbered = [label for label in LABELS if re.fullmatch(r"\(\d+\)", label)]
    assert numbered == [f"({k})" for k in range(1, 13)]
    for kind, last in (("Lemma", 10), ("Corollary", 2), ("Theorem", 4)):
        heads = [re.match(rf"{kind} (\d+)\b", label) for label in LABELS]
        order = [int(head.group(1)) for head in heads if head]
        assert order == sorted(order) and set(order) == set(range(1, last + 1))


def test_the_tally():
    tally = counts(ENTRIES)
    assert tally["not checked"] == 0
    assert tally["misprint"] >= 10 and tally["false"] + tally["conditional"] >= 10
    assert not any(
        isinstance(entry.evidence, Refutation | Misprint) for entry in ENTRIES if entry.verdict == "holds"
    )


@pytest.mark.slow
def test_the_tables_hold_39_numbers_and_the_remarks_name_those_off_by_more_than_half_a_unit():
    rows = [entry for entry in ENTRIES if re.match(r"table \d", entry.label)]
    off = {label: share for entry in rows for label, share in entry.evidence.deviations().items()}
    assert len(off) == 39
    far = {label for label, share in off.items() if share > 0.5}
    assert far == {r"\psi_1(2)", "u^*_2(0)", "u^*_3(0)", "u^*_2(2)", "u^*_2(3)"}
    for entry in rows:
        named = {left for left, share in entry.evidence.deviations().items() if share > 0.5}
        assert bool(entry.remark) == bool(named)
        for left in named:
            assert f"{off[left]:.2f}" in entry.remark
    assert max(off.values()) < 0.82


def test_the_printed_inputs_do_not_give_the_tables_and_the_derived_ones_do():
    assert worked.gauge_with(4, derivation.step_inputs).alpha == pytest.approx(0.92857, abs=1e-5)
    assert worked.gauge_with(4, printed_inputs).alpha == pytest.approx(0.94236, abs=1e-5)
    assert tables.units_off().max() < 1 < 1000 < tables.units_off(printed_inputs).max()
