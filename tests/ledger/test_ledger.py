"""Entries, the evidence that earns or breaks their verdicts, and the exports of the ledger."""

import csv
import io
import json
from dataclasses import replace

import pytest
import sympy as sp
from rich.console import Console

from pontryagin import ledger
from pontryagin.ledger import Entry, Page, Unsupported
from pontryagin.ledger.decimals import Decimals, unit
from pontryagin.ledger.evidence import (
    Conditional,
    Consequence,
    Equality,
    LinearSystem,
    Misprint,
    Proof,
    Refutation,
    Slip,
    Unreadable,
    vanishes,
)

x, y = sp.symbols("x y", real=True)
T = sp.Symbol("T", positive=True)


def entry(verdict, evidence, remark="why"):
    return Entry("A paper", "(1)", "something", verdict, remark, lambda: evidence)


def true_steps():
    yield "one is one", True


def false_steps():
    yield "one is one", True
    yield "one is two", False


def no_steps():
    yield from ()


square = Equality({"y": (x + 1) ** 2}, lambda: {"y": x**2 + 2 * x + 1})
slip = Misprint(
    {"y": 2 * x, "z": x},
    lambda: {"y": 3 * x, "z": x},
    defect={"y": -x},
    consequence=lambda: Consequence("y at x = 1", sp.Integer(2), sp.Integer(3)),
)
garbled = Unreadable({"a": x, "b": y}, lambda: {"a": x, "b": x}, legible=("a",))
system = LinearSystem([x + y - 2, x - y], lambda: [x - 1, y - 1], [x, y])
rounded = Decimals({"a": "0.15", "b": "3"}, lambda: {"a": 0.1416, "b": 3.0}, true_steps)
EARNED = {
    "holds": [square, rounded, system, Proof(true_steps), Proof(true_steps, square)],
    "misprint": [slip, Slip(true_steps, counterexample=true_steps)],
    "unreadable": [garbled],
    "false": [Refutation(true_steps), Refutation(true_steps, {"y": x}, lambda: {"y": 2 * x})],
    "conditional": [Conditional(true_steps, counterexample=true_steps)],
    "not checked": [None],
}


@pytest.mark.parametrize(("verdict", "evidence"), [(v, e) for v, kinds in EARNED.items() for e in kinds])
def test_a_verdict_is_earned_by_its_evidence_and_by_no_other(verdict, evidence):
    entry(verdict, evidence).check()
    for other in set(ledger.VERDICTS) - {verdict}:
        with pytest.raises(Unsupported):
            entry(other, evidence).check()


@pytest.mark.parametrize(
    "broken",
    [
        ("holds", Equality({"y": x}, lambda: {"y": 2 * x})),
        ("holds", Equality({"y": x}, lambda: {"z": x})),
        ("holds", Proof(false_steps)),
        ("holds", Proof(no_steps)),
        ("holds", Proof(true_steps, Equality({"y": x}, lambda: {"y": 2 * x}))),
        ("holds", LinearSystem([x + y - 2, x - y], lambda: [x - 1, y - 2], [x, y])),
        ("holds", LinearSystem([x + y - 2], lambda: [x + y - 2], [x, y])),
        ("misprint", replace(slip, printed={"y": 3 * x, "z": x})),
        ("misprint", replace(slip, printed={"y": 4 * x, "z": x})),
        ("misprint", replace(slip, printed={"y": 2 * x, "z": 2 * x})),
        ("misprint", replace(slip, consequence=lambda: Consequence("same", sp.S.One, sp.S.One))),
        ("misprint", replace(slip, consequence=lambda: Consequence("no number", x, sp.S.One))),
        ("unreadable", replace(garbled, printed={"a": x, "b": x})),
        ("unreadable", replace(garbled, printed={"a": y, "b": y})),
        ("false", Refutation(false_steps)),
        ("false", Refutation(no_steps)),
        ("false", Refutation(true_steps, {"y": x}, lambda: {"y": x})),
        ("conditional", Conditional(true_steps, counterexample=false_steps)),
        ("conditional", Conditional(false_steps, counterexample=true_steps)),
        ("conditional", Conditional(true_steps)),
        ("misprint", Slip(true_steps, counterexample=false_steps)),
        ("misprint", Slip(false_steps, counterexample=true_steps)),
        ("misprint", Slip(true_steps)),
        ("holds", replace(rounded, printed={"a": "0.12", "b": "3"})),
        ("holds", replace(rounded, printed={"a": "0.15", "b": "4"})),
        ("holds", replace(rounded, printed={"b": "3", "a": "0.15"})),
        ("holds", replace(rounded, certificate=false_steps)),
        ("holds", replace(rounded, certificate=no_steps)),
    ],
)
def test_broken_evidence_supports_nothing(broken):
    with pytest.raises(Unsupported):
        entry(*broken).check()


def test_evidence_that_the_table_does_not_admit_earns_nothing():
    class Opinion(Proof):
        """Evidence of a kind that the table of verdicts does not know."""

    with pytest.raises(
        Unsupported, match="Opinion is no evidence that the table of verdicts admits for 'holds'"
    ):
        entry("holds", Opinion(true_steps)).check()


def test_what_does_not_hold_needs_a_remark():
    with pytest.raises(Unsupported, match="remark"):
        entry("misprint", slip, remark="").check()


@pytest.mark.parametrize(
    ("expression", "zero"),
    [
        ((x + 1) ** 2 - x**2 - 2 * x - 1, True),
        (1 / (1 / T + 1 / T**2) - T**2 / (T + 1), True),
        (sp.sin(x) ** 2 + sp.cos(x) ** 2 - 1, True),
        (sp.Matrix([x - x, 0]), True),
        (sp.Matrix([0, x]), False),
        (sp.sqrt(x**2) - x, False),
        (sp.nan, False),
    ],
)
def test_zero_is_recognised_and_nothing_else(expression, zero):
    assert vanishes(expression) is zero


def test_entries_are_selected_by_paper_and_verdict():
    collected = ledger.entries()
    assert ledger.entries(paper="GORELOV") == tuple(e for e in collected if "Gorelov" in e.paper)
    for verdict in ledger.VERDICTS:
        assert all(e.verdict == verdict for e in ledger.entries(verdict=verdict))
    assert sum(ledger.counts(collected).values()) == len(collected)


def test_unknown_papers_and_verdicts_are_named():
    with pytest.raises(ValueError, match=r"verdict: got 'true', takes one of 'holds'"):
        ledger.entries(verdict="true")
    with pytest.raises(ValueError, match=r"paper: got 'Newton', takes \(part of\) one of 'Gorelov"):
        ledger.entries(paper="Newton")


def test_a_page_keeps_its_entries_in_order():
    claim = Page("A paper")

    @claim("(1)", "first", verdict="holds")
    def first():
        return square

    @claim("(2)", "second", verdict="not checked", remark="an opinion")
    def second():
        return None

    assert claim == [first, second]
    assert first.paper == "A paper"
    second.check()


def test_json_and_csv_hold_the_same_entries():
    chosen = ledger.entries(verdict="misprint")
    as_json = json.loads(ledger.to_json(chosen))
    as_csv = list(csv.DictReader(io.StringIO(ledger.to_csv(chosen))))
    assert as_json == as_csv == [e.as_dict() for e in chosen]
    assert all({"paper", "label", "statement", "verdict", "remark"} <= set(row) for row in as_json)


def test_the_table_shows_every_entry_and_the_tally():
    chosen = ledger.entries(verdict="false")
    console = Console(width=400, record=True, file=io.StringIO())
    console.print(ledger.table(chosen))
    text = console.export_text()
    assert f"{len(chosen)} entries: {len(chosen)} false" in text
    assert chosen[0].paper in text
    assert all(e.label in text and e.statement in text for e in chosen)


def test_printed_and_derived_forms_are_latex():
    assert entry("holds", square).printed_latex == r"y = \left(x + 1\right)^{2}"
    assert entry("holds", square).derived_latex == "y = x^{2} + 2 x + 1"
    assert entry("holds", system).printed_latex == r"x + y - 2 = 0,\quad x - y = 0"
    assert entry("holds", Proof(true_steps, display="a < b")).printed_latex == "a < b"
    assert entry("holds", rounded).printed_latex == r"a = 0.15,\quad b = 3"
    assert entry("holds", rounded).derived_latex == r"a = 0.1416,\quad b = 3"
    assert entry("not checked", None).printed_latex == entry("holds", Proof(true_steps)).derived_latex == ""


def test_a_proof_lists_its_steps():
    assert entry("holds", Proof(true_steps)).proof() == ["one is one"]
    assert entry("misprint", slip).proof() == [
        "printed minus derived $y$ is $- x$",
        "y at x = 1: the print gives 2, required is 3",
    ]
    assert entry("holds", rounded).proof() == [
        "one is one",
        "$a$ is 0.1416, printed 0.15: 0.84 of a unit off",
        "$b$ is 3, as printed",
    ]
    with pytest.raises(Unsupported):
        entry("holds", Proof(false_steps)).proof()


def test_a_printed_number_has_the_unit_of_its_last_digit():
    assert unit("0.9286") == 1e-4
    assert unit("-0.37787e-2") == 1e-7
    assert unit("4") == unit("0") == 0
