"""The ledger of Akulenko 1977: what its entries say, their order, and that each of their checks can fail."""

import re
from dataclasses import replace

import numpy as np
import pytest
import sympy as sp
from scipy.integrate import solve_ivp

from pontryagin.averaging.claims import (
    ENTRIES,
    approximation,
    averaged,
    discontinuous,
    family,
    instances,
    integral,
    kepler_controls,
    kepler_elements,
    kepler_motion,
    kepler_optimum,
    kepler_principle,
    least_time,
    optimum,
    principle,
    rigid,
    rigid_cylinder,
    rigid_ellipsoid,
    roots,
    rotor,
    smooth,
    statement,
    window,
    worked,
)
from pontryagin.averaging.derivation import kepler, rigid_body, ripple
from pontryagin.averaging.derivation import optimum as derived_optimum
from pontryagin.averaging.derivation import principle as derived_principle
from pontryagin.averaging.derivation import smooth as smooth_derivation
from pontryagin.averaging.derivation.kepler_optimum import duration, energy0, rho
from pontryagin.averaging.derivation.kepler_principle import costate_momentum, price
from pontryagin.ledger import VERDICTS, Unsupported, counts
from pontryagin.ledger.evidence import (
    Misprint,
    Refutation,
)


def entries_of(*parts):
    """The entries of some modules of claims, in order."""
    return [entry for part in parts for entry in part.claim]


THEORY = entries_of(
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
"""The entries of sections 1 and 2."""
KEPLER = (kepler_motion, kepler_elements, kepler_principle, kepler_optimum, kepler_controls)
ORBITS = entries_of(*KEPLER)
"""The entries of example 2."""
ROTATIONS = entries_of(rotor, least_time, smooth, rigid, rigid_ellipsoid, rigid_cylinder)
"""The entries of examples 1 and 3."""
UNSOUND = {
    "conditional": {"after (3.4): e", "(3.7)"},
    "misprint": {"(3.6): γ", "after (3.8): dp_K/dτ", "(3.9): E", "after (3.9): v"},
}
"""Entries of example 2 that do not hold as printed."""


def assert_refused(label, refusal=Unsupported):
    """The check of the entry with a label fails."""
    (entry,) = (entry for entry in ENTRIES if entry.label == label)
    with pytest.raises(refusal):
        replace(entry).check()


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
        (least_time, "TILTED", sp.cos(least_time.x), "example 1: mean force"),
        (smooth, "COST", smooth.COST + smooth.kappa, "after (3.2): J0"),
        (smooth, "XI", smooth.XI + smooth.kappa, "(3.2)"),
        (rigid_ellipsoid, "SLENDER", rigid_body.SYMMETRIC, "example 3: nearly symmetric body"),
        (rigid_cylinder, "SHORT", rigid_cylinder.LEVEL, "example 3: singular controls"),
        (rigid_cylinder, "LEVEL", rigid_cylinder.SHORT, "example 3: singular controls"),
    ],
)
def test_a_wrong_example_is_not_certified(monkeypatch, module, name, wrong, label):
    monkeypatch.setattr(module, name, wrong)
    if label == "after (2.1): q":
        monkeypatch.setattr(family, "first", sp.Symbol("h"))
    assert_refused(label, (Unsupported, ArithmeticError) if module in KEPLER else Unsupported)


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
    right = getattr(module, name)
    monkeypatch.setattr(module, name, lambda: wrong(right))
    assert_refused(label)


@pytest.mark.parametrize(
    ("module", "name", "wrong", "label"),
    [
        (rigid_body, "deceleration", lambda: rigid_body.lx, "example 3: ⟨R⟩"),
        (rigid_body, "phase_rate", lambda: sp.S.Zero, "after (3.10): standard form"),
        (smooth_derivation, "turned", lambda: smooth_derivation.v1, "after J0: second derivative"),
    ],
)
def test_a_wrong_derivation_is_found_out(monkeypatch, module, name, wrong, label):
    monkeypatch.setattr(module, name, wrong)
    assert_refused(label, (Unsupported, ArithmeticError))


def test_every_numbered_formula_is_there_in_the_papers_order():
    numbered = [re.match(r"\((\d)\.(\d+)\)", entry.label) for entry in ENTRIES]
    order = [(int(found[1]), int(found[2])) for found in numbered if found]
    assert order == sorted(order)
    expected = {(1, k) for k in range(1, 9)} | {(2, k) for k in range(1, 18)} | {(3, k) for k in range(1, 11)}
    assert set(order) == expected
    assert {"Figure 1", "Figure 2"} <= {entry.label for entry in ENTRIES}


def test_the_formulas_of_example_2_are_there_in_the_papers_order():
    numbered = [re.match(r"\((3\.\d)\)", entry.label) for entry in ORBITS]
    order = [head.group(1) for head in numbered if head]
    assert list(dict.fromkeys(order)) == [f"3.{k}" for k in range(3, 10)]
    assert order == sorted(order)


def test_the_tally_of_sections_1_and_2():
    tally = counts(THEORY)
    assert tally["not checked"] == 0
    failing = {entry.label for entry in THEORY if entry.verdict == "misprint"}
    assert failing == {
        "section 1: range of ε", "(1.6): p(t1)", "(2.1): p'", "(2.3)", "(2.4)", "(2.5): q"
    }  # fmt: skip
    assert tally["conditional"] >= 10
    assert not any(isinstance(e.evidence, Refutation | Misprint) for e in THEORY if e.verdict == "holds")


def test_what_does_not_hold_in_example_2_is_what_is_listed():
    unsound = {verdict: {e.label for e in ORBITS if e.verdict == verdict} for verdict in VERDICTS}
    assert {v: labels for v, labels in unsound.items() if labels and v != "holds"} == UNSOUND
    assert not any(isinstance(entry.evidence, Misprint) for entry in ORBITS if entry.verdict == "holds")


def test_the_tally_of_examples_1_and_3():
    tally = counts(ROTATIONS)
    assert tally["not checked"] == tally["unreadable"] == 0
    misprints = [entry.label for entry in ROTATIONS if entry.verdict == "misprint"]
    assert misprints == [
        "example 1: special case",
        "example 1: with mean force",
        "(3.2)",
        "example 3: synthesis",
        "example 3: controls on the cylinder",
    ]


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


def test_the_averaged_solution_meets_its_conditions_and_the_printed_one_does_not():
    state, costate = smooth_derivation.averaged_solution()
    tau, T, gap, v1 = (getattr(smooth_derivation, name) for name in ("tau", "T", "gap", "v1"))
    for speed, residual in ((state, 0), (smooth.XI, smooth.kappa * T**2 / 2)):
        assert sp.expand(speed.subs(tau, T)) == v1
        assert sp.expand(speed.subs(tau, 0) - (v1 + gap) - residual) == 0
    assert sp.expand(state.diff(tau) - costate / 2) == 0
    assert sp.expand(smooth.XI.diff(tau) - smooth.ETA / 2) != 0
