import json
import re
import subprocess
import sys
from base64 import b64decode
from html import unescape
from html.parser import HTMLParser

import pytest
import typst

from pontryagin.report import assemble, browser, publish, text, tree
from pontryagin.report.execute import execute
from pontryagin.report.execute import publish as publish_figures
from pontryagin.report.front import front_page
from pontryagin.report.recordings import Clip
from pontryagin.report.render_html import render_html
from pontryagin.report.render_pdf import render_pdf, typst_text

CLIP = Clip("triple_integrator", "turn", "A turn", "It turns.")
TITLE = {"pagetitle": "pontryagin", "subtitle": "s", "imprint": "i"}
DRAW = """
from pontryagin.display.plotting import show, show_table, styled, subplots
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
            self.loads += [
                given[name] for name in ("src", "href", "data", "poster", "srcset") if given.get(name)
            ]


def cells(*markdown):
    fence = assemble.FENCE
    places = [f"notebooks/0{k}.ipynb, cell {k}" for k in range(1, len(markdown) + 1)]
    return "\n".join(
        f'{fence} {{.cell place="{p}"}}\n\n{m}\n\n{fence}\n' for p, m in zip(places, markdown, strict=True)
    )


@pytest.fixture(scope="module")
def built(tmp_path_factory, new_checkout, entries):
    place = new_checkout(tmp_path_factory.mktemp("built") / "checkout")
    sympy, html = (
        "import sympy as sp; sp.Integral(sp.Symbol('x'))",
        "HTML('<table><tr><td>7</td></tr></table>')",
    )
    paths = [
        place.notebook("01-first", FORMULAS, DRAW, sympy, "print('said')"),
        place.notebook("02-next", "# Next\n\n## More", f"from IPython.display import HTML\n{html}"),
    ]
    executed = [execute(place.workspace, path) for path in paths]
    publish_figures(place.workspace, executed)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(browser, "find", lambda: None)
        publish.write_report(place.workspace, executed, [CLIP], entries)
        yield place.workspace, executed


@pytest.fixture(scope="module")
def page(built):
    return (built[0].report / "index.html").read_text(encoding="utf-8")


@pytest.mark.slow
def test_the_page_loads_nothing_from_anywhere(page):
    loaded = Page(page).loads
    assert loaded and all(source.startswith("data:") for source in loaded)
    styles = " ".join(re.findall(r"<style[^>]*>(.*?)</style>", page, re.DOTALL))
    assert not re.findall(r"url\((?!['\"]?data:)|@import", styles)
    assert unescape(page).count("default-src 'none'") == 1


def test_every_link_inside_the_page_leads_somewhere(page):
    read = Page(page)
    inside = {link[1:] for link in read.links if link.startswith("#")}
    assert inside <= set(read.ids)
    assert {"nb-02-next", "figure-01-first-line", "table-01-first-norms", "ledger", "provenance"} <= inside
    assert {"../../notebooks/01-first.ipynb", "../../figures/01-first/line.svg", "play/turn.html"} <= set(
        read.links
    )


def test_the_page_shows_the_figure_as_it_was_drawn(built, page):
    workspace, _ = built
    (picture,) = [source for source in Page(page).loads if source.startswith("data:image/svg+xml")]
    drawn = (workspace.figures / "01-first" / "line.svg").read_bytes()
    assert b64decode(picture.partition("base64,")[2]) == drawn


def test_code_is_folded_and_outputs_are_not(page):
    folded = re.findall(r'<details class="code">.*?</details>', page, re.DOTALL)
    assert len(folded) == 4 and "styled" in folded[0]
    outside = re.sub(r'<details class="code">.*?</details>', "", page, flags=re.DOTALL)
    text_only = re.sub(r"<(script|style)\b.*?</\1>", "", outside, flags=re.DOTALL)
    assert "said" in text_only and "@styled" not in text_only and "print(" not in text_only


def test_formulas_keep_their_tags_and_bare_environments_are_formulas(page):
    formulas = re.findall(r'<span class="math (?:inline|display)">(.*?)</span>', page, re.DOTALL)
    assert any(r"\tag{2.3}" in formula for formula in formulas)
    assert any(r"\begin{align}" in formula for formula in formulas)
    assert any(r"\int x\, dx" in formula for formula in formulas)


def test_the_ledger_is_counted_and_shown_word_by_word(page):
    assert "a*b_c &lt; |u| and ~x" in page
    row = re.search(r"<td[^>]*>Gorelov &amp; Morozova 2012</td>(.*?)</tr>", page, re.DOTALL)
    assert re.findall(r">(\d+)<", row[1]) == ["1", "1", "2"]
    assert page.index('id="ledger"') < page.index('id="nb-01-first"') < page.index('id="nb-02-next"')


@pytest.mark.slow
def test_rendering_again_touches_nothing_and_a_changed_text_renders_both(built, entries):
    workspace, executed = built
    files = [workspace.report / name for name in ("index.html", "pontryagin.pdf")]
    before = [(path.stat().st_mtime_ns, path.read_bytes()) for path in files]
    publish.write_report(workspace, executed, [CLIP], entries)
    assert [(path.stat().st_mtime_ns, path.read_bytes()) for path in files] == before
    publish.write_report(workspace, executed, [], entries)
    assert all(path.read_bytes() != content for path, (_, content) in zip(files, before, strict=True))
    publish.write_report(workspace, executed, [CLIP], entries)
    assert [path.read_bytes() for path in files] == [content for _, content in before]


def test_the_pdf_is_the_same_bytes_twice_and_has_the_pages(built, tmp_path, entries):
    workspace, executed = built
    read = text.read(publish.whole_text(workspace, executed, [], entries))
    made = [tmp_path / "a.pdf", tmp_path / "b.pdf"]
    for target in made:
        render_pdf(read.document, workspace.root, target, TITLE)
    assert made[0].read_bytes() == made[1].read_bytes()
    assert made[0].read_bytes().startswith(b"%PDF") and made[0].stat().st_size > 20_000


def test_the_pdf_has_the_text_the_tables_and_the_figure_but_not_the_code(built, entries):
    workspace, executed = built
    written = typst_text(text.read(publish.whole_text(workspace, executed, [CLIP], entries)).document, TITLE)
    assert 'image("figures/01-first/line.svg"' in written
    assert "#tagged[2.3]" in written and '#verdict("misprint")' in written
    assert "subplots(height=2)" not in written and "said" in written
    assert re.search(r"#table\(\s*columns: 1.*?\[7\]", written, re.DOTALL)


@pytest.mark.parametrize("formula", [r"\foo x", r"\frac{a}{b", r"x^{2"])
def test_a_formula_that_cannot_be_converted_fails_the_build_at_its_cell(checkout, tmp_path, formula):
    read = text.read(cells("Fine: $x$.", f"Not so:\n\n$${formula}$$"))
    with pytest.raises(tree.PandocWarning) as raised:
        render_pdf(read.document, checkout.root, tmp_path / "a.pdf", TITLE)
    told = str(read.unreadable(str(raised.value)))
    assert told.startswith(f"notebooks/02.ipynb, cell 2: cannot read the formula {formula}")
    assert not (tmp_path / "a.pdf").exists()


def test_names_and_numbers_in_a_table_are_not_broken(checkout):
    long = "a sentence that goes on for longer than a name"
    read = text.read(cells(f"| case | J |\n| - | - |\n| inclined-10 | 1e-15 |\n| {long} | $x + y$ |"))
    page = render_html(read.document, checkout.root, TITLE)
    cell = re.compile(r"<td([^>]*)>(.*?)</td>", re.DOTALL)
    kept = {re.sub("<[^>]*>", "", content): "short" in marks for marks, content in cell.findall(page)}
    assert kept == {"inclined-10": True, "1e-15": True, long: False, r"\(x + y\)": True}


def test_tables_without_a_caption_take_no_number_on_paper_either(checkout, tmp_path):
    table = "| case | J |\n| - | - |\n| one | 1 |"
    read = text.read(cells(f"{table}\n\n{table}\n\n: Numbered.\n\n{table}"))
    draft = tmp_path / "a.typ"
    draft.write_text(typst_text(read.document, TITLE), encoding="utf-8")
    numbers = json.loads(typst.query(str(draft), "figure.where(kind: table)", field="numbering"))
    assert numbers == [None, "1", None]


def test_a_missing_picture_fails_the_build(checkout):
    read = text.read(cells("![a picture](figures/none.svg)"))
    with pytest.raises(tree.PandocWarning, match=r"figures/none\.svg"):
        render_html(read.document, checkout.root, TITLE)


def test_a_piece_that_pandoc_cannot_read_is_placed():
    with pytest.raises(tree.PandocWarning, match=r"notebooks/02\.ipynb, cell 2"):
        text.read(cells("fine", "[a]: b\n\n[a]: c\n\n[a]"))


def test_a_link_that_leads_nowhere_is_placed():
    assert text.read(cells("# Title {#nb-01}", "[there](#nb-01)")).places == {}
    with pytest.raises(tree.PandocWarning, match=r"notebooks/02\.ipynb, cell 2: a link leads to #nb-02"):
        text.read(cells("# Title {#nb-01}", "[there](#nb-02)"))


@pytest.mark.slow
def test_two_figures_of_one_name_are_refused(checkout):
    result = execute(checkout.workspace, checkout.notebook("01", "# Title", DRAW, "show(line())"))
    with pytest.raises(
        assemble.Unprintable, match=r"notebooks/01\.ipynb, cell 3: a second figure is called 'line'"
    ):
        assemble.items([result])


@pytest.mark.slow
def test_a_notebook_without_a_title_is_refused(checkout):
    result = execute(checkout.workspace, checkout.notebook("01", "1 + 1"))
    with pytest.raises(assemble.Unprintable, match=r"notebooks/01\.ipynb, cell 1"):
        assemble.chapter(checkout.workspace, result)


@pytest.mark.slow
def test_the_command_names_the_failing_cell_and_exits_1(checkout):
    checkout.notebook("01", "# Title", "raise ValueError('bad ends')")
    command = [sys.executable, "-m", "pontryagin.report", "--root", str(checkout.root)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 1
    assert "notebooks/01.ipynb, cell 2 of 2: ValueError: bad ends" in done.stdout
    assert "Traceback" not in done.stdout + done.stderr


def test_the_summary_counts_every_entry_once(entries):
    more = [*entries, {**entries[0], "paper": "Sapunkov", "verdict": "false"}]
    front = front_page(more)
    rows = [line.split(" | ") for line in front.splitlines() if line.startswith(("| Gor", "| Sap", "| all"))]
    assert [[cell.strip(" |") for cell in row] for row in rows][:3] == [
        ["Gorelov & Morozova 2012", "1", "1", "0", "2"],
        ["Sapunkov", "0", "0", "1", "1"],
        ["all", "1", "1", "1", "3"],
    ]
