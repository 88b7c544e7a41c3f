"""The eleventh equation restores the attitude, and with it the lost condition."""

import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose

from pontryagin.numerics import compile as compiler
from pontryagin.rendezvous.derivation import (
    forms,
    model,
    principle,
    repair,
)
from rendezvous_derived import ATTITUDE, COSTATES, START, multiplied, trajectory


@pytest.mark.parametrize("chart", [1, -1])
def test_chi_and_nu_determine_the_attitude(chart):
    fourteen = trajectory(forms.with_attitude("unsaturated"), [*START, *COSTATES, *ATTITUDE], 1.0)
    invariant = dict(
        zip(
            principle.nu,
            multiplied(multiplied(ATTITUDE, [0, *COSTATES[3:]]), ATTITUDE * [1, -1, -1, -1])[1:],
            strict=True,
        )
    )
    frame = repair.with_length(repair.shortest_turn(chart)).subs(invariant)
    chi = compiler.function("chi", list(model.attitude), {"chi": repair.chi_of(frame)})
    start = float(chi(*ATTITUDE)[0])
    eleven = trajectory(forms.repaired("unsaturated", chart), [*START, *COSTATES, start], 1.0)
    back = compiler.function(
        "back", [repair.chi, *principle.nu], {"lambda": repair.with_length(repair.attitude_of(frame, chart))}
    )(eleven[:, 10], *eleven[:, 7:10].T)[0][..., 0]
    same = np.sign(np.sum(back * fourteen[:, 10:], axis=1))[:, None]
    assert_allclose(same * back, fourteen[:, 10:], atol=1e-11)
    difference = np.angle(np.exp(1j * (eleven[:, 10] - chi(*fourteen[:, 10:].T)[0]) / 1))
    assert_allclose(difference, 0, atol=1e-11)


def test_each_chart_of_the_repair_is_regular_where_the_other_is_singular():
    small = sp.Symbol("h", positive=True)
    nearby = dict(zip(principle.nu, (sp.sin(small), 0, -sp.cos(small)), strict=True))
    slopes = [repair.with_length(repair.chi_rate(chart)).diff(model.thrust[2]) for chart in (1, -1)]
    first, second = (sp.limit(sp.simplify(slope.subs(nearby)), small, 0, "+") for slope in slopes)
    assert first.is_infinite and second == 0


@pytest.mark.slow
def test_6_has_rank_three_and_15_rank_two_as_it_does_not_change_under_rotations_about_nu():
    assert repair.change_of_mismatch().rank() == 3
    change = repair.change_of_invariant()
    assert change.rank() == 2
    (null,) = change.nullspace()
    assert null.cross(principle.nu).applyfunc(sp.simplify).is_zero_matrix
