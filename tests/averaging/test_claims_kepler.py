"""The ledger of Akulenko's example 2, entry by entry, and proof that each of its checks can fail."""

import re
from dataclasses import replace
from itertools import chain

import pytest
import sympy as sp

from pontryagin.averaging.claims import (
    kepler_controls,
    kepler_elements,
    kepler_motion,
    kepler_optimum,
    kepler_principle,
)
from pontryagin.averaging.derivation import kepler
from pontryagin.averaging.derivation.kepler_optimum import duration, energy0, rho
from pontryagin.averaging.derivation.kepler_principle import costate_momentum, price
from pontryagin.ledger import VERDICTS, Unsupported
from pontryagin.ledger.evidence import Misprint

MODULES = (kepler_motion, kepler_elements, kepler_principle, kepler_optimum, kepler_controls)
ENTRIES = tuple(chain.from_iterable(module.claim for module in MODULES))
LABELS = [entry.label for entry in ENTRIES]

UNSOUND = {
    "conditional": {"after (3.4): e", "(3.7)"},
    "misprint": {"(3.6): γ", "after (3.8): dp_K/dτ", "(3.9): E", "after (3.9): v"},
}
"""Entries that do not hold as printed."""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("module", "name", "wrong", "label"),
    [
        (kepler_motion, "CIRCLE", {kepler.energy: -sp.Rational(1, 4), kepler.momentum: 1}, "after (3.4): e"),
        (kepler_elements, "PLACE", {**kepler_elements.PLACE, kepler.anomaly: 0}, "(3.6): γ"),
        (kepler_principle, "ESCAPE", {**kepler_principle.ESCAPE, price: 1}, "(3.7)"),
        (
            kepler_principle,
            "SAMPLE",
            {**kepler_principle.SAMPLE, costate_momentum: 0},
            "after (3.8): dp_K/dτ",
        ),
        (kepler_optimum, "SPENT", {**kepler_optimum.SPENT, rho: 0}, "(3.9): E"),
        (
            kepler_controls,
            "SPENT",
            {**kepler_optimum.SPENT, duration: sp.Rational(1, 2)},
            "after (3.9): e, p",
        ),
        (kepler_controls, "SPENT", {**kepler_optimum.SPENT, energy0: -2}, "after (3.9): e, p"),
    ],
)
def test_a_wrong_example_is_not_certified(monkeypatch, module, name, wrong, label):
    entry = next(entry for entry in ENTRIES if entry.label == label)
    monkeypatch.setattr(module, name, wrong)
    with pytest.raises((Unsupported, ArithmeticError)):
        replace(entry).check()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("label", "module", "name", "wrong"),
    [
        ("(3.3)", kepler, "equations_of_motion", lambda right: -right()),
        ("(3.6): γ", kepler, "element_rates", lambda right: sp.Dict({k: -v for k, v in right().items()})),
        ("after (3.8): dψ", kepler, "weight", lambda right: 1 / right()),
        ("(3.5)", kepler, "weight", lambda right: 2 - right()),
        (
            "(3.9): K",
            kepler_optimum,
            "solution",
            lambda right: sp.Dict({k: v**2 for k, v in right().items()}),
        ),
        (
            "before (3.9)",
            kepler_optimum,
            "solution",
            lambda right: sp.Dict({k: 2 * v for k, v in right().items()}),
        ),
    ],
)
def test_another_derivation_does_not_support_the_verdict(monkeypatch, label, module, name, wrong):
    entry = next(entry for entry in ENTRIES if entry.label == label)
    right = getattr(module, name)
    monkeypatch.setattr(module, name, lambda: wrong(right))
    with pytest.raises(Unsupported):
        replace(entry).check()


def test_every_numbered_formula_is_there_in_the_papers_order():
    numbered = [re.match(r"\((3\.\d)\)", label) for label in LABELS]
    order = [head.group(1) for head in numbered if head]
    assert list(dict.fromkeys(order)) == [f"3.{k}" for k in range(3, 10)]
    assert order == sorted(order)


def test_what_does_not_hold_is_what_is_listed():
    unsound = {verdict: {e.label for e in ENTRIES if e.verdict == verdict} for verdict in VERDICTS}
    assert {v: labels for v, labels in unsound.items() if labels and v != "holds"} == UNSOUND
    assert not any(isinstance(entry.evidence, Misprint) for entry in ENTRIES if entry.verdict == "holds")
