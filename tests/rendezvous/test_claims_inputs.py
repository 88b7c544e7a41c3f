"""Every argument of the ledger depends on the derivation: with a wrong derived input its check fails.

An input is a function that the argument calls. It is replaced everywhere by a function whose result is
slightly wrong: by a sign, a factor or an additional term.
"""

import sys
from collections.abc import Callable
from dataclasses import dataclass, replace

import pytest
import sympy as sp

from pontryagin.ledger import Unsupported
from pontryagin.ledger.evidence import (
    Proof,
    Refutation,
)
from pontryagin.rendezvous.claims import ENTRIES
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
"""Arguments that use no derived input; `test_claims` refutes them by a wrong example."""


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
