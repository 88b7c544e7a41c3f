"""K in Cartesian coordinates gives Newton's law, and costates that are those of H, in the time s."""

import sympy as sp

from pontryagin.rendezvous.derivation import inertial, principle
from pontryagin.rendezvous.derivation.inertial import (
    force,
    gain,
    position,
    position_costate,
    price,
    velocity,
    velocity_costate,
)


def slopes(value, variables):
    return sp.Matrix([value.diff(x) for x in variables])


def test_k_is_the_hamiltonian_times_the_pace():
    cost = principle.time_weight + principle.energy_weight * force.dot(force)
    values = {gain: velocity_costate.dot(force) - cost, price: sp.Symbol("c")}
    plain = (inertial.hamiltonian() + values[price]) * inertial.pace()
    assert sp.simplify(inertial.regular_hamiltonian().subs(values) - plain) == 0


def test_k_moves_the_craft_by_newton_s_law_without_thrust():
    k, pace = inertial.regular_hamiltonian(), inertial.pace()
    assert sp.simplify(slopes(k, position_costate) - pace * velocity) == sp.zeros(3, 1)
    assert sp.simplify(slopes(k, velocity_costate) - pace * inertial.attraction()) == sp.zeros(3, 1)
    potential = inertial.gravity / principle.size(position)
    assert sp.simplify(inertial.attraction() - slopes(potential, position)) == sp.zeros(3, 1)


def test_the_pace_is_that_of_a_circle():
    radius = sp.Symbol("radius", positive=True)
    there = inertial.pace().subs(dict(zip(position, (radius, 0, 0), strict=True)))
    assert sp.simplify(there**2 * inertial.gravity - radius**3) == 0
