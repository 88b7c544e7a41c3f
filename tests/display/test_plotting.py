"""Figures in one style and the same bytes, kept and displayed under the name of their notebook."""

import itertools
import os
import subprocess
import sys

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from pontryagin.display import plotting

DRAW = """
import sys
import numpy as np
from pontryagin.display import plotting

@plotting.styled
def parabola():
    figure, axes = plotting.subplots(height=2.0)
    t = np.linspace(0, 1, 50)
    axes.plot(t, t**2, label="$u$")
    axes.set(xlabel="$t$", ylabel="$u(t)$")
    axes.legend()
    return figure

sys.stdout.write(plotting.svg_of(parabola()))
"""

# Linear RGB as severe deuteranopes and protanopes see it, by Machado, Oliveira and Fernandes (2009).
DEUTERANOPIA = [
    [0.367322, 0.860646, -0.227968],
    [0.280085, 0.672501, 0.047413],
    [-0.01182, 0.04294, 0.968881],
]
PROTANOPIA = [
    [0.152286, 1.052583, -0.204868],
    [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998],
]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """The folder that figures are kept in."""
    monkeypatch.setenv("PONTRYAGIN_FIGURES", str(tmp_path))
    return tmp_path


@plotting.styled
def two_curves(curves: int = 2) -> Figure:
    figure, axes = plotting.subplots()
    for slope in range(curves):
        axes.plot([0, 1], [0, slope])
    return figure


def lab(colour, seen):
    linear = np.array([c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in to_rgb(colour)])
    linear = np.clip(np.array(seen) @ linear, 0, 1)
    xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]] @ linear
    f = [t ** (1 / 3) if t > 0.008856 else 7.787 * t + 16 / 116 for t in xyz / [0.9505, 1.0, 1.089]]
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


@pytest.mark.parametrize("seen", [np.eye(3), DEUTERANOPIA, PROTANOPIA])
def test_the_first_five_curves_are_told_apart_by_every_colour_vision(seen):
    pairs = itertools.combinations(plotting.PALETTE[:5], 2)
    assert min(np.linalg.norm(lab(a, seen) - lab(b, seen)) for a, b in pairs) > 10


@pytest.mark.slow
def test_a_figure_is_the_same_bytes_in_another_process_with_another_hash_seed():
    drawn = [
        subprocess.run(
            [sys.executable, "-c", DRAW],
            capture_output=True,
            check=True,
            env={**os.environ, "PYTHONHASHSEED": seed},
        ).stdout
        for seed in ("1", "2")
    ]
    assert drawn[0] == drawn[1]
    assert drawn[0].startswith(b"<?xml") and b"<dc:date>" not in drawn[0]


def test_a_styled_figure_does_not_depend_on_the_callers_settings():
    plain = plotting.svg_of(two_curves())
    with mpl.rc_context({"lines.linewidth": 9, "font.size": 30, "svg.fonttype": "none", "axes.grid": False}):
        assert plotting.svg_of(two_curves()) == plain
        assert mpl.rcParams["lines.linewidth"] == 9


def test_the_style_is_applied_for_good_when_asked_for():
    with mpl.rc_context(plotting.STYLE):
        wanted = {key: mpl.rcParams[key] for key in plotting.STYLE}
    with mpl.rc_context():
        assert {key: mpl.rcParams[key] for key in wanted} != wanted
        plotting.apply_style()
        assert {key: mpl.rcParams[key] for key in wanted} == wanted


def test_a_figure_and_a_table_are_kept_under_their_notebook(folder):
    figure = plotting.save(two_curves(), "01-overview")
    table = plotting.save_table({"q": [1, 2]}, "01-overview", "norms")
    assert figure == folder / "01-overview" / "two-curves.svg"
    assert figure.read_text() == plotting.svg_of(two_curves())
    assert table.read_text() == "q\n1\n2\n"


@pytest.mark.parametrize("name", ["../up", "Three Programmes", "a/b", ".hidden"])
def test_names_that_are_no_file_names_are_refused(name, folder):
    with pytest.raises(ValueError, match="name: got"):
        plotting.save(two_curves(), "01-overview", name)
    with pytest.raises(ValueError, match="notebook: got"):
        plotting.save(two_curves(), name)
    assert not list(folder.rglob("*.svg"))


def test_a_figure_without_a_name_is_refused():
    with pytest.raises(ValueError, match="name: got none"):
        plotting.show(Figure())


@pytest.fixture
def displayed(monkeypatch):
    seen = []
    monkeypatch.setattr("IPython.display.display", lambda data, metadata, raw: seen.append((data, metadata)))
    return seen


@pytest.mark.extra(name="report")
def test_show_saves_and_displays_the_same_picture(folder, monkeypatch, displayed):
    monkeypatch.setenv("PONTRYAGIN_NOTEBOOK", "01-overview")
    plotting.show(two_curves(3), name="three", caption="Three lines.")
    plotting.show_table({"q": [1]}, "norms")
    (figure, figure_metadata), (table, table_metadata) = displayed
    assert figure["image/svg+xml"] == (folder / "01-overview" / "three.svg").read_text()
    assert figure_metadata["pontryagin"]["caption"] == "Three lines."
    assert table["text/markdown"] == "| q |\n| --: |\n| 1 |"
    assert table_metadata["pontryagin"] == {
        "kind": "table",
        "notebook": "01-overview",
        "name": "norms",
        "caption": "Norms.",
    }


@pytest.mark.slow
@pytest.mark.extra(name="report")
def test_outside_a_known_notebook_show_only_displays(folder, monkeypatch, displayed):
    monkeypatch.delenv("PONTRYAGIN_NOTEBOOK", raising=False)
    monkeypatch.delenv("JPY_SESSION_NAME", raising=False)
    plotting.show(two_curves())
    assert len(displayed) == 1 and not list(folder.iterdir())
