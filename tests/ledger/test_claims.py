"""All papers' entries: each verdict follows from its evidence, and from no altered printed form."""

import re
from dataclasses import replace
from decimal import Decimal

import pytest
import sympy as sp

from pontryagin import ledger
from pontryagin.ledger import Unsupported
from pontryagin.ledger.evidence import LinearSystem, Misprint

ENTRIES = ledger.entries()


def name(entry):
    return f"{entry.paper}: {entry.label}"


def of(entries):
    return pytest.mark.parametrize("entry", entries, ids=name)


@pytest.mark.slow
@of(ENTRIES)
def test_the_verdict_is_what_the_evidence_finds(entry):
    entry.check()


def altered(side):
    """A printed side with an error: three units of the last digit, or 1 added to every entry."""
    if isinstance(side, str):
        return str(Decimal(side) + 3 * Decimal(1).scaleb(Decimal(side).as_tuple().exponent))
    return side + (sp.ones(*side.shape) if isinstance(side, sp.MatrixBase) else 1)


def altered_prints(evidence):
    """Each printed side in turn, and the evidence with that side altered."""
    if getattr(evidence, "formula", None):
        for left, formula in altered_prints(evidence.formula):
            yield left, replace(evidence, formula=formula)
    elif isinstance(evidence, LinearSystem):
        for k, side in enumerate(evidence.printed):
            others = [*evidence.printed[:k], altered(side), *evidence.printed[k + 1 :]]
            yield None, replace(evidence, printed=others)
    else:
        for left, side in evidence.printed.items():
            yield left, replace(evidence, printed={**evidence.printed, left: altered(side)})


@pytest.mark.slow
@of(ENTRIES)
def test_no_other_evidence_gives_the_verdict(entry):
    """Which evidence an entry has is known when it is built, which takes longer than to collect the tests."""
    evidence = entry.evidence
    if evidence is not None and evidence.printed is not None:
        any_other_print_is_refused(evidence)
    if isinstance(evidence, Misprint):
        a_corrected_print_is_no_misprint(evidence)
    if hasattr(evidence, "counterexample"):
        a_counterexample_is_needed_and_names_numbers(evidence)


def any_other_print_is_refused(evidence):
    others = list(altered_prints(evidence))
    assert others
    readable = getattr(evidence, "legible", None)
    for left, other in others:
        if readable is None or left in readable:
            with pytest.raises(Unsupported):
                other.finding()


def a_corrected_print_is_no_misprint(evidence):
    corrected = replace(evidence, printed=evidence.derivation())
    with pytest.raises(Unsupported, match="no misprint"):
        corrected.finding()


def a_counterexample_is_needed_and_names_numbers(evidence):
    def nothing():
        yield from ()

    with pytest.raises(Unsupported):
        replace(evidence, counterexample=nothing).finding()
    steps = list(evidence.counterexample())
    assert len(steps) >= 2
    assert any(re.search(r"\d", words) for words, _ in steps)


@of(ENTRIES)
def test_an_entry_says_what_is_claimed_and_why_it_fails(entry):
    assert len(entry.statement) > 9 or entry.printed_latex
    assert entry.remark or entry.verdict == "holds"


def test_a_label_stands_once_in_a_paper():
    names = [name(entry) for entry in ENTRIES]
    assert len(set(names)) == len(names)
