"""Discs along collocated trajectories hold them, and points of the certificate suffice for these discs."""

import numpy as np
import pytest
from numpy.polynomial import Chebyshev

from pontryagin.averaging.averaged.cells import discs, panels
from pontryagin.averaging.averaged.certificate import LEAST_POINTS
from pontryagin.averaging.averaged.collocation import Trajectories
from pontryagin.averaging.averaged.resolution import EXPONENT, REACH
from pontryagin.numerics.collocation import Mesh


def test_discs_hold_the_trajectories_near_their_cells():
    mesh = Mesh((0.0, 0.3, 1.0), 12)
    rng = np.random.default_rng(5)
    z = rng.standard_normal((3, len(mesh.points), 2))
    path = Trajectories(mesh, z, np.ones(3), np.zeros((3, 1)))
    cells = panels(path).halves()
    centre, radius = discs(path, cells, 1.4)
    series = mesh.series(z)
    for i in range(len(cells.low)):
        own = series[cells.member[i], cells.panel[i]]
        domain = mesh.edges[cells.panel[i] : cells.panel[i] + 2]
        middle, half = (cells.low[i] + cells.high[i]) / 2, cells.lengths[i] / 2
        for turn in np.linspace(0, 6, 13):
            for share in (1.0, 0.5):
                s = middle + 1.4 * share * half * np.exp(1j * turn)
                values = np.array([Chebyshev(c, domain)(s) for c in own.T])
                assert (np.abs(values - centre[i]) <= radius[i] * (1 + 1e-9)).all()


def spread(nodes, reach):
    """How much a function bounded by 1 on a disc can be between its zeros at these nodes of [-1, 1]."""
    inside, around = np.linspace(-1, 1, 4001), reach * np.exp(1j * np.linspace(0, np.pi, 2001))
    product = np.abs(inside[:, None] - nodes).prod(axis=1).max()
    return product / np.abs(around[:, None] - nodes).prod(axis=1).min()


def first_kind(count):
    return np.cos(np.pi * (np.arange(count) + 0.5) / count)


@pytest.mark.parametrize("degree", [12, 24])
def test_collocation_and_certificate_leave_no_room_on_a_panel(degree):
    collocated = np.cos(np.pi * np.arange(degree + 1) / degree)
    nodes = np.concatenate([collocated, first_kind(degree + 3)])
    assert spread(nodes, np.cosh(EXPONENT / len(nodes))) < 1e-11


def test_the_certificate_leaves_no_room_on_a_cell():
    assert spread(first_kind(LEAST_POINTS), REACH) < 2e-11
