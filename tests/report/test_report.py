import re
import subprocess
import sys
from base64 import b64decode
from html.parser import HTMLParser

import pytest

from pontryagin.report import assemble, publish, text, tree
from pontryagin.report.execute import execute
from pontryagin.report.execute import publish as publish_figures
from pontryagin.report.front import front_page
from pontryagin.report.render_html import render_html
from pontryagin.report.render_pdf import render_pdf, typst_text

TITLE = {"pagetitle": "pontryagin", "subtitle": "s", "imprint": "i"}
DRAW = """
from pontryagin.plotting import show, show_table, styled, subplots
@styled
def line():
    figure, axes = subplots(height=2)
    axes.plot([0, 1], [0, 1])
    return figure
show(line(), caption="A line, $|u| = 1$.")
show_table({"$q$": [1, 2], "norm": [0.5, 1e-16]}, "norms", "Norms, $q < 3$.")
"""
FORMULAS = """# Title

See [the next](02-next.ipynb#More) and [a file](../src/a.py). Here $\\|u\\|_2 \\le |c_1|$.

$$x = 1 \\tag{2.3}$$

\\begin{align}
a &= b
\\end{align}
"""


class Page(HTMLParser):
    """What a page would load, and where its links lead."""

    def __init__(self, html):
        super().__init__()
        self.loads, self.links, self.ids = [], [], []
        self.feed(html)

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        self.ids += [given["id"]] if "id" in given else []
        if tag == "a":
            self.links.append(given.get("href", ""))
        else:
            self.loads += [given[name] for name in ("src", "href", "data", "poster", "srcset") if given.get(name)]


def cells(*markdown):
    fence = assemble.FENCE
    places = [f"notebooks/0{k}.ipynb, cell {k}" for k in range(1, len(markdown) + 1)]
    return "\n".join(f'{fence} {{.cell place="{p}"}}\n\n{m}\n\n{fence}\n' for p, m in zip(places, markdown, strict=True))


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    from tests.report.conftest import ENTRIES, Checkout  # noqa: PLC0415

    place = Checkout(tmp_path_factory.mktemp("built") / "checkout")
    paths = [
        place.notebook("01-first", FORMULAS, DRAW, "import sympy as sp; sp.Integral(sp.Symbol('x') ** 2)", "print('said')"),
        place.notebook("02-next", "# Next\n\n## More", "from IPython.display import HTML\nHTML('<table><tr><td>7</td></tr></table>')"),
    ]
    executed = [execute(place.workspace, path) for path in paths]
    publish_figures(place.workspace, executed)
    publish.write_report(place.workspace, executed, [], ENTRIES)
    return place.workspace, executed
