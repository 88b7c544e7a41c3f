"""The certificate in the elements detects a wrong costate."""

import numpy as np

from pontryagin.rendezvous import (
    solve_in_elements,
)
from pontryagin.rendezvous.elements.certificate import certify
from pontryagin.rendezvous.elements.conditions import ElementsSetting, equations
from pontryagin.rendezvous.root import Root
from rendezvous_problems import problem


def test_the_certificate_detects_a_wrong_costate():
    mine = solve_in_elements(problem(20, duration=6.0))
    moved = mine.root.unknowns + 1e-6 * np.eye(7)[2]
    wrong = Root(moved, equations(ElementsSetting(mine.problem.scaled, mine.flight.law, 1.0), moved))
    assert mine.certificate.holds(1e-10) and not certify(wrong, free=False).holds(1e-8)
