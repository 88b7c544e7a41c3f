"""The ledger of Pimkina & Chelnokov and of Sapunkov: its entries, and that their checks can fail."""

import re
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest
import sympy as sp
from scipy.optimize import root

from pontryagin.ledger import Unsupported, counts
from pontryagin.ledger.evidence import (
    Misprint,
    Proof,
    Refutation,
)
from pontryagin.rendezvous.claims import ENTRIES, functional, meetings, spirals
from pontryagin.rendezvous.derivation import (
    forms,
    model,
    principle,
    quaternion,
    reduction,
    sapunkov,
    terminal,
    transversality,
)


def terms(side):
    """The expressions that differ from a printed one by the sign of one term."""
    side = sp.sympify(side)
    for term in side.args if side.is_Add else [side]:
        if not term.is_zero:
            yield side - 2 * term


@pytest.mark.parametrize("label", ["(2)", "(11)", "(12)", "(13)", "(14)", "(16)", "(17)"])
def test_a_formula_with_any_one_sign_changed_is_refuted(label):
    entry = next(entry for entry in ENTRIES if entry.label == label)
    formula = getattr(entry.evidence, "formula", None) or entry.evidence
    derived = formula.derivation()
    tried = 0
    for left, side in formula.printed.items():
        for other in terms(sp.expand(side)):
            changed = replace(formula, printed={**formula.printed, left: other}, derived=lambda: derived)
            with pytest.raises(Unsupported):
                changed.finding()
            tried += 1
    assert tried >= 3


TRUE, CHEAP, *OTHERS = meetings.COPLANAR


@pytest.mark.slow
@pytest.mark.parametrize(
    ("module", "name", "wrong", "label"),
    [
        (meetings, "COPLANAR", (TRUE, TRUE), "conclusion: reduced"),
        (meetings, "COPLANAR", (CHEAP, TRUE), "conclusion: reduced"),
        (meetings, "COPLANAR", (TRUE, *OTHERS), "conclusion: reduced"),
        (
            meetings,
            "INCLINED",
            (meetings.INCLINED[0], replace(meetings.INCLINED[1], duration=8.79)),
            "conclusion: reduced",
        ),
        (meetings, "INCLINED", (meetings.INCLINED[0],) * 2, "before (15)"),
        (meetings, "INCLINED", (replace(meetings.INCLINED[0], duration=8.03),), "section 1: α1 = 0"),
        (meetings, "INCLINED", meetings.INCLINED[1:], "abstract"),
        (meetings, "PEAK", 0.05, "conclusion: reduced"),
        (spirals, "OUTER", sp.Integer(1), "section 1: α1 = 0"),
        (functional, "start_mass", functional.flow_rate, "section 1: dm/dt"),
    ],
)
def test_an_entry_with_a_wrong_example_is_refused(monkeypatch, module, name, wrong, label):
    entry = next(entry for entry in ENTRIES if entry.label == label)
    monkeypatch.setattr(module, name, wrong)
    with pytest.raises((Unsupported, ArithmeticError)):
        replace(entry).check()


def test_every_numbered_formula_has_an_entry_in_the_order_of_the_papers():
    first = [entry.label for entry in ENTRIES if entry.paper == "Pimkina & Chelnokov"]
    numbered = [label for label in first if re.fullmatch(r"\(\d+\)", label)]
    assert numbered == [f"({k})" for k in range(1, 18)]
    second = [entry.label for entry in ENTRIES if entry.paper == "Sapunkov"]
    assert sum(label.startswith("(1)") for label in second) == 6
    assert [entry.paper for entry in ENTRIES] == ["Pimkina & Chelnokov"] * len(first) + ["Sapunkov"] * len(
        second
    )


def test_the_numbers_of_the_verdicts():
    tally = counts(ENTRIES)
    assert tally["not checked"] == 3
    assert tally["misprint"] == 2 and tally["false"] == 2 and tally["conditional"] == 5
    assert not any(
        isinstance(entry.evidence, Refutation | Misprint) for entry in ENTRIES if entry.verdict == "holds"
    )


def test_in_one_plane_the_printed_conditions_have_a_curve_of_solutions_with_nu3_free():
    conditions = meetings.evaluation(0)

    def residual(unknowns, nu3):
        rho, s1, e, duration = unknowns
        member = meetings.Meeting("", (rho, s1, e, 0.0, 0.0, nu3), duration)
        end = conditions(meetings.trajectory(member, np.array([0.0, duration]))[-1], 0.0)
        return [*end["ends"], *end["law"]]

    at = np.array([*TRUE.costates[:3], TRUE.duration])
    for share in (0.25, 0.5, 0.75, 1.0):
        nu3 = TRUE.costates[5] + share * (CHEAP.costates[5] - TRUE.costates[5])
        found = root(residual, at, args=(nu3,), tol=1e-10)
        at = found.x
        assert found.success and np.abs(found.fun).max() < 1e-9
    np.testing.assert_allclose(at, [*CHEAP.costates[:3], CHEAP.duration], atol=1e-6)


@dataclass(frozen=True)
class WrongInput:
    """A function, a map from its result to a wrong one, and the labels of the entries that must then fail."""

    module: object
    name: str
    altered: Callable
    labels: tuple[str, ...]

    @property
    def original(self):
        return getattr(self.module, self.name)


def areal_rate_with_radial_speed(result):
    rates, omega = result
    return rates + sp.Matrix([0, 0, model.v1]), omega


def velocity_backwards(result):
    return result[0], -result[1]


WRONG = [
    WrongInput(
        model,
        "motion",
        areal_rate_with_radial_speed,
        (
            "section 1: c*",
            "section 1: m",
            "section 2: costates",
            "abstract",
            "before (15)",
            "conclusion: reduced",
            "section 2: 16",
            "(10), α2 = 0",
        ),
    ),
    WrongInput(model, "cartesian", velocity_backwards, ("(4)", "section 1: η*")),
    WrongInput(
        quaternion,
        "product",
        quaternion.conjugate,
        ("(6)", "section 1: Λ*", "section 2: ν = λ~∘ν*∘λ", "(15): origin"),
    ),
    WrongInput(
        principle,
        "running_cost",
        lambda cost: 2 * cost,
        ("section 1: energy", "section 1: least time", "(1)", "(10)"),
    ),
    WrongInput(
        model,
        "anomaly_rate",
        lambda rate: rate * model.parameter * (1 + sp.cos(model.anomaly)),
        ("section 1: given", "after (16): C_φ", "(16)"),
    ),
    WrongInput(
        principle,
        "hamiltonian",
        lambda energy: energy + model.attitude[0] * principle.mu[1],
        ("section 2: ν*", "section 2: integrals", "section 2: six"),
    ),
    WrongInput(
        reduction,
        "rates",
        lambda rates: rates + sp.Matrix([reduction.anomaly_constant, *[0] * 8, principle.nu0]),
        ("after (14): order", "after (14): eleven", "(17)"),
    ),
    WrongInput(
        transversality,
        "tangent",
        lambda tangent: 2 * tangent,
        ("section 1: moving end",),
    ),
    WrongInput(
        principle,
        "switching",
        lambda n: n.multiply_elementwise(sp.Matrix([1, 1, 2])),
        ("(8)",),
    ),
    WrongInput(terminal, "end_thrust", lambda thrust: 2 * thrust, ("section 1: α1 = 0",)),
    WrongInput(forms, "repaired", lambda _: forms.full("unsaturated"), ("conclusion: simpler",)),
    WrongInput(
        sapunkov,
        "spinor_rate",
        lambda rate: 2 * rate,
        ("section 1: both craft", "(1): Q", "(1): q", "abstract: elements"),
    ),
    WrongInput(
        sapunkov,
        "element_rates",
        lambda rates: (rates[0] + sapunkov.A / sapunkov.u[0], rates[1]),
        ("abstract: target", "abstract: regular", "(1): u, w"),
    ),
]


INDEPENDENT = {"section 1: dm/dt"}
"""Arguments that use no derived input; a wrong example refutes them."""


def modules():
    """The modules of the derivation and of the ledger."""
    parts = ("pontryagin.rendezvous.derivation", "pontryagin.rendezvous.claims")
    return [module for name, module in sys.modules.items() if name.startswith(parts)]


def clear_caches():
    """Empty the caches of the functions of these modules."""
    for module in modules():
        for value in vars(module).values():
            if hasattr(value, "cache_clear"):
                value.cache_clear()


@pytest.fixture
def fresh():
    clear_caches()
    yield
    clear_caches()


@pytest.mark.slow
@pytest.mark.parametrize("wrong", WRONG, ids=lambda wrong: wrong.name)
def test_an_argument_with_a_wrong_input_fails(monkeypatch, fresh, wrong):
    original = wrong.original

    def replacement(*arguments):
        return wrong.altered(original(*arguments))

    for module in modules():
        for name, value in list(vars(module).items()):
            if value is original:
                monkeypatch.setattr(module, name, replacement)
    for label in wrong.labels:
        entry = next(entry for entry in ENTRIES if entry.label == label)
        with pytest.raises(Unsupported):
            replace(entry).check()


def test_every_argument_has_a_wrong_input():
    argued = {entry.label for entry in ENTRIES if isinstance(entry.evidence, Proof | Refutation)}
    tried = [label for wrong in WRONG for label in wrong.labels]
    assert len(tried) == len(set(tried))
    assert argued - INDEPENDENT == set(tried)
