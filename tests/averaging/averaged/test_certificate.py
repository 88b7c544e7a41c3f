"""The certificate of an averaged extremal measures each fault that is put into it.

The solution of the smooth example from 1 to 2 is known: v = 1 + tau, a costate of 2, a running cost of 2, a
duration of 1.
"""

from dataclasses import replace

import numpy as np
import pytest

from pontryagin.averaging import smooth_example
from pontryagin.averaging.averaged import certified as solver

FAULT = 1e-6


@pytest.fixture
def certified(monkeypatch):
    """The certificate of the known solution with faults in the problem or in the path."""
    plain, kept = solver.certify, []
    monkeypatch.setattr(solver, "certify", lambda *given: kept.append(given) or plain(*given))
    smooth_example(1.0, 2.0)
    ((problem, path, names, members, edges),) = kept

    def again(problem_faults=lambda problem: {}, path_faults=lambda path: {}):
        wrong = replace(problem, **problem_faults(problem)), replace(path, **path_faults(path))
        return plain(*wrong, names, members, edges)[0]

    return again


def measured(certificate, name):
    """One residual; all others are those of the solution, unless they are named too."""
    return float(getattr(certificate, name)[0])


def others_hold(certificate, *names):
    every = ("boundary", "transversality", "hamiltonian", "maximality")
    return all(measured(certificate, name) < 1e-11 for name in every if name not in names)


@pytest.mark.parametrize(
    ("fault", "name", "size"),
    [
        (lambda problem: {"start": problem.start + FAULT}, "boundary", FAULT / 2),
        (lambda problem: {"level": problem.level + FAULT}, "boundary", FAULT / 2),
        # H = kappa v, which is FAULT * 2 at the end, in units of the running cost; the costate then changes.
        (lambda problem: {"kappa": problem.kappa + FAULT}, "hamiltonian", FAULT),
    ],
    ids=["start", "target", "anomaly"],
)
def test_another_problem_is_seen_by_its_size(certified, fault, name, size):
    found = certified(fault)
    assert measured(found, name) == pytest.approx(size, rel=5e-3)
    assert others_hold(found, name, *(["transversality"] if name == "hamiltonian" else []))


def test_another_duration_is_seen_in_the_states(certified):
    """dv/ds is 1, the mean rate times the duration 1 + FAULT, relative to a largest v of 2."""
    found = certified(path_faults=lambda path: {"duration": path.duration * (1 + FAULT)})
    assert measured(found, "boundary") == pytest.approx(FAULT / 2, rel=5e-3)
    assert others_hold(found, "boundary")


def test_another_multiplier_is_seen_at_the_end(certified):
    found = certified(path_faults=lambda path: {"multipliers": path.multipliers * (1 + FAULT)})
    assert measured(found, "transversality") == pytest.approx(FAULT, rel=5e-3)
    assert others_hold(found, "transversality")


@pytest.mark.parametrize(("variable", "name"), [(0, "boundary"), (1, "transversality")])
def test_a_fault_at_one_place_is_seen(certified, variable, name):
    """A bump at one point of the mesh has a slope of more than its height over the way to the next point.

    Both variables are at most 2.
    """
    steps = []

    def bump(path):
        z, middle = path.z.copy(), path.z.shape[1] // 2
        z[0, middle, variable] += FAULT
        steps.append(path.mesh.points[middle + 1] - path.mesh.points[middle])
        return {"z": z}

    found = certified(path_faults=bump)
    assert measured(found, name) > FAULT / steps[0] / 2


def test_a_costate_of_another_length_is_seen_by_the_hamiltonian(certified):
    """h0 = (eta / 2)^2 - 1 for the costate eta = 2, in units of the running cost 2."""
    found = certified(path_faults=lambda path: {"z": path.z * [1, 1 + FAULT]})
    assert measured(found, "hamiltonian") == pytest.approx(2 * FAULT / 2, rel=5e-3)
    assert measured(found, "maximality") < 1e-11, "the control is the one that this costate demands"


def test_a_frequency_that_vanishes_on_the_way_is_named(certified):
    with pytest.raises(ValueError, match=r"omega must be positive .*, got -.* at v = "):
        certified(path_faults=lambda path: {"z": path.z - [1.5, 0.0]})


def test_a_certificate_of_a_stack_is_of_each_member(certified):
    together = smooth_example([1.0, 1.0], [2.0, 3.0]).certificate
    assert together.boundary.shape == (2,) and np.all(together.holds(1e-11))
