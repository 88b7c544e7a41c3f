"""All forms of the equations have the same trajectories, which are those of Newton's law."""

from functools import cache

import numpy as np
import pytest
import sympy as sp
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from pontryagin.numerics import compile as compiler
from pontryagin.rendezvous.derivation import (
    forms,
    model,
    primer,
    principle,
    quaternion,
    reduction,
)
from rendezvous_derived import (
    ATTITUDE,
    COSTATES,
    SCALE,
    SPAN,
    START,
    TARGET,
    TARGET_SYMBOLS,
    multiplied,
    trajectory,
)


@cache
def measures():
    """Place, velocity, primer vector and its rate in inertial axes, of the reduced variables."""
    place, velocity = model.cartesian()
    vectors = {"primer": principle.switching(), "primer_rate": primer.carried()}
    turned = {name: quaternion.rotated(vector, model.attitude) for name, vector in vectors.items()}
    variables = [*reduction.REDUCED, *model.attitude, model.gravity]
    return compiler.function("measures", variables, {"place": place, "velocity": velocity, **turned})


def lifted_start():
    mu = multiplied(ATTITUDE, [0.0, *COSTATES[3:]])
    return [*START, *ATTITUDE, *COSTATES[:3], 0.7, *mu]


@pytest.mark.parametrize("mode", ["unsaturated", "saturated"])
def test_the_16_equations_are_newton_s_law_with_lawden_s_primer_vector(mode):
    form = forms.full(mode)
    path = dict(zip(form.states, trajectory(form, lifted_start(), SCALE[mode]).T, strict=True))
    nu = [
        multiplied(q * [1, -1, -1, -1], m)
        for q, m in zip(column(path, model.attitude), column(path, principle.mu), strict=True)
    ]
    rows = [path[x] for x in reduction.REDUCED[:7]] + list(np.array(nu).T[1:])
    R, V, N, N_rate = (part[..., 0] for part in measures()(*rows, *column(path, model.attitude).T, 1.0))

    def cartesian(_, y):
        place, primer_ = y[:3], y[6:9]
        r = np.linalg.norm(place)
        length = np.linalg.norm(primer_)
        thrust = primer_ / 2 if mode == "unsaturated" else SCALE[mode] * primer_ / length
        gradient = (3 * np.outer(place, place) / r**2 - np.eye(3)) / r**3
        return [*y[3:6], *(thrust - place / r**3), *y[9:], *(gradient @ primer_)]

    start = [*R[0], *V[0], *N[0], *N_rate[0]]
    inertial = solve_ivp(cartesian, (0, 3), start, method="DOP853", rtol=1e-12, atol=1e-13, t_eval=SPAN).y.T
    assert_allclose(np.hstack([R, V, N, N_rate]), inertial, atol=1e-10)


def column(path, symbols):
    return np.column_stack([path[x] for x in symbols])


@pytest.mark.slow
@pytest.mark.parametrize("mode", principle.MODES)
def test_all_forms_have_the_same_trajectories_and_h_of_17_is_constant(mode):
    sixteen = forms.full(mode)
    path = trajectory(sixteen, lifted_start(), SCALE[mode])
    full = dict(zip(sixteen.states, path.T, strict=True))
    ten = trajectory(forms.reduced(mode), [*START, *COSTATES], SCALE[mode])
    fourteen = trajectory(forms.with_attitude(mode), [*START, *COSTATES, *ATTITUDE], SCALE[mode])
    assert_allclose(ten[:, :7], column(full, reduction.REDUCED[:7]), atol=1e-11)
    assert_allclose(fourteen[:, :10], ten, atol=1e-11)
    assert_allclose(fourteen[:, 10:], column(full, model.attitude), atol=1e-11)
    for row, q, m in zip(ten, column(full, model.attitude), column(full, principle.mu), strict=True):
        assert_allclose(multiplied(q, [0.0, *row[7:]]), m, atol=1e-11)
    energy = compiler.function(
        "energy",
        [
            *reduction.REDUCED,
            *TARGET_SYMBOLS,
            principle.energy_weight if mode == "unsaturated" else principle.peak,
        ],
        {
            "H": reduction.hamiltonian()
            .subs(reduction.anomaly_constant, 0.3)
            .subs(forms.thrust(mode))
            .subs(principle.time_weight, 1)
            .subs(principle.energy_weight if mode != "unsaturated" else sp.Symbol("none"), 1)
        },
    )(*ten.T, *TARGET, SCALE[mode])[0]
    assert_allclose(energy, energy[0], atol=1e-11)


def test_saturated_rates_are_homogeneous_of_degree_zero_and_one_in_the_costates():
    costates = [principle.rho, principle.s1, principle.e, *principle.nu]
    form = forms.reduced("saturated")
    point = {x: sp.Rational(k + 3, k + 7) for k, x in enumerate([*form.states, *form.parameters])}
    scaled = point | {x: 5 * point[x] for x in costates}
    for x, rate in zip(form.states, form.rates, strict=True):
        ratio = (rate.subs(scaled) / rate.subs(point)).evalf(30)
        assert abs(ratio - (5 if x in costates else 1)) < 1e-25
