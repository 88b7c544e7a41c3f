"""The target of (5) and (6) moves as the equations of motion say."""

import sympy as sp

from pontryagin.rendezvous.derivation import (
    model,
    principle,
    transversality,
)


def test_the_target_of_5_and_6_solves_the_equations_of_motion():
    ends = transversality.end_values()
    coasting = principle.state_rates().subs(dict.fromkeys(model.thrust, 0)).subs(ends)
    rates = transversality.meeting()[:3, :].diff(model.anomaly) * model.anomaly_rate()
    assert (coasting[:3, :] - rates).subs(model.gravity, model.GAUSS).applyfunc(sp.simplify).is_zero_matrix
    names = dict(zip(model.attitude, model.target_attitude(), strict=True))
    attitude_rate = model.target_attitude().diff(model.anomaly) * model.anomaly_rate()
    assert (coasting[4:, :].subs(names) - attitude_rate).applyfunc(sp.simplify).is_zero_matrix
