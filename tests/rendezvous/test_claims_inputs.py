"""Every argument of the rendezvous's ledger rests on what is derived: with a wrong input its check fails.

An input is a function that the argument calls, replaced wherever it is called. What is wrong with it is
slight: a sign, a factor, one term more.
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
class Wrong:
    """A function, what takes its place (it gets the right result), and the labels that this must break."""

    module: object
    name: str
    amiss: Callable
    labels: tuple[str, ...]

    @property
    def right(self):
        return getattr(self.module, self.name)


def areal_rate_with_radial_speed(result):
    rates, omega = result
    return rates + sp.Matrix([0, 0, model.v1]), omega


def velocity_backwards(result):
    return result[0], -result[1]


WRONG = [
    Wrong(
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
    Wrong(model, "cartesian", velocity_backwards, ("(4)", "section 1: η*")),
    Wrong(
        quaternion,
        "product",
        quaternion.conjugate,
        ("(6)", "section 1: Λ*", "section 2: ν = λ~∘ν*∘λ", "(15): origin"),
    ),
    Wrong(
        principle,
        "running_cost",
        lambda cost: 2 * cost,
        ("section 1: energy", "section 1: least time", "(1)", "(10)"),
    ),
    Wrong(
        model,
        "anomaly_rate",
        lambda rate: rate * model.parameter * (1 + sp.cos(model.anomaly)),
        ("section 1: given", "after (16): C_φ", "(16)"),
    ),
    Wrong(
        principle,
        "hamiltonian",
        lambda energy: energy + model.attitude[0] * principle.mu[1],
        ("section 2: ν*", "section 2: integrals", "section 2: six"),
    ),
    Wrong(
        reduction,
        "rates",
        lambda rates: rates + sp.Matrix([reduction.anomaly_constant, *[0] * 8, principle.nu0]),
        ("after (14): order", "after (14): eleven", "(17)"),
    ),
    Wrong(
        transversality,
        "tangent",
        lambda tangent: 2 * tangent,
        ("section 1: moving end",),
    ),
    Wrong(
        principle,
        "switching",
        lambda n: n.multiply_elementwise(sp.Matrix([1, 1, 2])),
        ("(8)",),
    ),
    Wrong(terminal, "end_thrust", lambda thrust: 2 * thrust, ("section 1: α1 = 0",)),
    Wrong(forms, "repaired", lambda _: forms.full("unsaturated"), ("conclusion: simpler",)),
    Wrong(
        sapunkov,
        "spinor_rate",
        lambda rate: 2 * rate,
        ("section 1: both craft", "(1): Q", "(1): q", "abstract: elements"),
    ),
    Wrong(
        sapunkov,
        "element_rates",
        lambda rates: (rates[0] + sapunkov.A / sapunkov.u[0], rates[1]),
        ("abstract: target", "abstract: regular", "(1): u, w"),
    ),
]

ELSEWHERE = {"section 1: dm/dt"}
"""Mechanics of a jet, not of the derivation: broken by a wrong example, in `test_claims`."""


def modules():
    """The modules of the derivation and of the ledger."""
    parts = ("pontryagin.rendezvous.derivation", "pontryagin.rendezvous.claims")
    return [module for name, module in sys.modules.items() if name.startswith(parts)]


def forget():
    """Empty what the modules have kept of earlier calls."""
    for module in modules():
        for value in vars(module).values():
            if hasattr(value, "cache_clear"):
                value.cache_clear()


@pytest.fixture
def fresh():
    forget()
    yield
    forget()


@pytest.mark.parametrize("wrong", WRONG, ids=lambda wrong: wrong.name)
def test_a_wrong_input_breaks_the_arguments_that_rest_on_it(monkeypatch, fresh, wrong):
    right = wrong.right

    def amiss(*given):
        return wrong.amiss(right(*given))

    for module in modules():
        for name, value in list(vars(module).items()):
            if value is right:
                monkeypatch.setattr(module, name, amiss)
    for label in wrong.labels:
        entry = next(entry for entry in ENTRIES if entry.label == label)
        with pytest.raises(Unsupported):
            replace(entry).check()


def test_every_argument_is_put_to_the_test():
    argued = {entry.label for entry in ENTRIES if isinstance(entry.evidence, Proof | Refutation)}
    tried = [label for wrong in WRONG for label in wrong.labels]
    assert len(tried) == len(set(tried))
    assert argued - ELSEWHERE == set(tried)
