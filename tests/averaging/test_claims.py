"""The ledger of Akulenko 1977: the entries of sections 1 and 2 one by one, and the order of all entries.

The entries of section 3 are checked by the tests of its examples.
"""

import re
from dataclasses import replace

import numpy as np
import pytest
import sympy as sp

from pontryagin.averaging.claims import (
    ENTRIES,
    approximation,
    averaged,
    discontinuous,
    family,
    instances,
    integral,
    optimum,
    principle,
    roots,
    statement,
    window,
    worked,
)
from pontryagin.averaging.derivation import optimum as derived_optimum
from pontryagin.averaging.derivation import principle as derived_principle
from pontryagin.averaging.derivation import ripple
from pontryagin.ledger import Unsupported, counts
from pontryagin.ledger.evidence import (
    Misprint,
    Refutation,
)

R = sp.Rational

PARTS = (
    statement,
    principle,
    family,
    roots,
    averaged,
    window,
    integral,
    optimum,
    approximation,
    discontinuous,
)
OWN = [entry for part in PARTS for entry in part.claim]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("module", "name", "wrong", "label"),
    [
        (instances, "THREE", instances.TOUCHING, "after (2.13): minimisation"),
        (instances, "THREE", -instances.THREE, "after (2.16): optimal κ"),
        (instances, "TOUCHING", instances.THREE, "after (2.6): neighbourhood"),
        (instances, "ROOT_OF_MASS", sp.S.One, "(2.5): a, p"),
        (discontinuous, "WAVE", sp.sin(discontinuous.phi), "end of section 2: theorem [12]"),
        (discontinuous, "CHIRP", sp.sin(discontinuous.t), "end of section 2: sharper estimate"),
        (averaged, "PRINTED_RATE", sp.S.Zero, "(2.3)"),
        (worked, "predicted_roots", lambda eps: 0.5 / eps, "after (2.2): number of roots"),
        (worked, "deviations", lambda eps: {"phase": 0.1 / eps}, "(2.5): ψ"),
        (ripple, "cost", lambda: ripple.turned(), "(2.14)"),
        (derived_principle, "leading_h", lambda: sp.Symbol("h"), "after (2.1): q"),
        (derived_optimum, "exact_identity", lambda: sp.S.One, "Figure 2"),
    ],
)
def test_a_wrong_example_is_not_certified(monkeypatch, module, name, wrong, label):
    entry = next(entry for entry in OWN if entry.label == label)
    monkeypatch.setattr(module, name, wrong)
    if label == "after (2.1): q":
        monkeypatch.setattr(family, "first", sp.Symbol("h"))
    with pytest.raises(Unsupported):
        replace(entry).check()


def test_every_numbered_formula_is_there_in_the_papers_order():
    numbered = [re.match(r"\((\d)\.(\d+)\)", entry.label) for entry in ENTRIES]
    order = [(int(found[1]), int(found[2])) for found in numbered if found]
    assert order == sorted(order)
    expected = {(1, k) for k in range(1, 9)} | {(2, k) for k in range(1, 18)} | {(3, k) for k in range(1, 11)}
    assert set(order) == expected
    assert {"Figure 1", "Figure 2"} <= {entry.label for entry in ENTRIES}


def test_the_tally():
    tally = counts(OWN)
    assert tally["not checked"] == 0
    failing = {entry.label for entry in OWN if entry.verdict == "misprint"}
    assert failing == {
        "section 1: range of ε", "(1.6): p(t1)", "(2.1): p'", "(2.3)", "(2.4)", "(2.5): q"
    }  # fmt: skip
    assert tally["conditional"] >= 10
    assert not any(isinstance(e.evidence, Refutation | Misprint) for e in OWN if e.verdict == "holds")


@pytest.mark.slow
@pytest.mark.parametrize("epsilon", worked.EPSILONS)
def test_the_extremals_survive_a_finer_integration_and_miss_none(epsilon):
    found = worked.roots(epsilon)
    finer = worked.members(found.start, epsilon, 1e-12)
    assert np.abs(finer.level).max() < 2 * worked.RESIDUAL
    assert np.abs(finer.cost - found.cost).max() < 1e-7
    slopes = worked.members(found.start + 1e-5 * epsilon, epsilon, 1e-12).level
    assert np.all(np.diff(np.sign(slopes)) != 0)
    gaps = np.diff(found.phase)
    assert gaps.max() < 2 * np.pi


def test_extremals_obey_hamiltons_equations_in_time():
    from scipy.integrate import solve_ivp

    epsilon = 0.1
    found, best = worked.roots(epsilon), worked.best(epsilon)

    def rates(_, y):
        v, x, p, q = y
        force = worked.RIPPLE * np.cos(x)
        return [
            epsilon * (p / 2 + force),
            v,
            -q,
            epsilon * p * worked.RIPPLE * np.sin(x),
        ]

    p0 = found.start[best]
    start = [worked.START, 0.0, p0, -epsilon * worked.level(0.0, p0) / worked.START]
    end = solve_ivp(
        rates, (0, found.duration[best] / epsilon), start, "LSODA", rtol=1e-10, atol=1e-12
    ).y[:, -1]  # fmt: skip
    assert end == pytest.approx([worked.END, found.phase[best], found.costate[best], 0.0], abs=1e-5)
