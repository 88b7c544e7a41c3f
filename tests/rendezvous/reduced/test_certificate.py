"""Certificates of extremals, which detect wrong costates, places and costs."""

import math
from dataclasses import replace

import numpy as np
import pytest

from pontryagin.rendezvous import (
    Rendezvous,
    solve,
)
from pontryagin.rendezvous.reduced.certificate import certify
from pontryagin.rendezvous.reduced.conditions import Setting, equations
from pontryagin.rendezvous.reduced.quadrature import energy
from pontryagin.rendezvous.reduced.shooting import meet
from pontryagin.rendezvous.root import Root
from rendezvous_problems import CRAFT, orbit, problem


@pytest.mark.slow
def test_the_certificate_detects_a_wrong_costate():
    root = solve(problem(20, duration=3.0)).root
    setting = Setting(problem(20).scaled, 1.0, math.inf, duration=root.flight.duration)
    moved = equations(setting, root.unknowns + 1e-6 * np.eye(6)[3])
    assert certify(root, (0.0, 1.0), free=False).holds(1e-10)
    wrong = Root(root.unknowns, moved)
    assert not certify(wrong, (0.0, 1.0), free=False).holds(1e-8)


@pytest.mark.slow
def test_a_meeting_ahead_of_the_target_violates_only_the_condition_on_the_attitude():
    """In one plane and with a circular target orbit, (5), (15), (16) and H = 0 hold anywhere on the orbit."""
    free = Rendezvous(CRAFT, orbit(0, eccentricity=0.0), 0.002, 1.0, math.inf)
    best = solve(free)
    later = replace(free, target=replace(free.target, anomaly=free.target.anomaly + 0.1))
    ahead = meet(Setting(later.scaled, later.scaled.ratio, math.inf), best.root.unknowns).unknowns
    setting = Setting(free.scaled, free.scaled.ratio, math.inf)
    false = certify(Root(ahead, equations(setting, ahead)), free.scaled.weights, free=True)
    others = (false.boundary, false.transversality, false.hamiltonian, false.maximality, false.agreement)
    assert max(others) < 1e-10
    assert false.attitude == pytest.approx(math.sin(0.05), rel=1e-6)
    assert best.certificate.holds(1e-10)


@pytest.mark.slow
def test_the_certificate_detects_a_wrong_cost(leap, monkeypatch):
    monkeypatch.setattr(
        "pontryagin.rendezvous.reduced.certificate.energy", lambda flight: energy(flight) * (1 + 1e-6)
    )
    again = replace(leap)
    assert float(again.certificate.cost) == pytest.approx(1e-6, rel=1e-3)
    assert not again.certificate.holds(1e-9)
