import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from pontryagin import ledger
from pontryagin.report import tex, tree
from pontryagin.report.render_html import ASSETS

x, y = sp.symbols("x y", real=True)
t, T = sp.symbols("t T", positive=True)
f = sp.Function("f")


def typst_of(formula):
    plain, _ = tex.for_typst(formula)
    return tree.run(["-f", "markdown", "-t", "typst"], f"$${plain}$$").strip()


@pytest.mark.parametrize(
    "expression",
    [
        sp.Matrix([[x, y], [1, 2]]),
        sp.Piecewise((x, x > 0), (y, True)),
        sp.Integral(f(t) * sp.Abs(x), (t, 0, T)),
        sp.sign(x) + sp.Heaviside(t - T),
        sp.Derivative(f(t), (t, 2)),
        sp.Eq(x, sp.sqrt(y) / 3),
        sp.Sum(x**t, (t, 0, sp.oo)),
        sp.And(x > 0, y < 1),
        sp.Max(x, y),
        sp.Symbol(r"\tilde{\lambda}") ** 2,
        sp.Float("1.5e-10"),
        sp.Subs(sp.Derivative(f(x), x), x, 1),
        sp.Interval(0, T),
        sp.Poly(x**2 + 1, x),
    ],
)
def test_what_sympy_prints_can_be_converted(expression):
    assert typst_of(sp.latex(expression)).startswith("$")


@pytest.mark.parametrize(
    ("formula", "shown"),
    [
        (r"\|u\|_\infty", "$ lr(bar.v.double u bar.v.double)_oo $"),
        (r"\left\|u\right\|_2", "$ lr(bar.v.double u bar.v.double)_2 $"),
        (r"\lVert u \rVert", "$ lr(bar.v.double u bar.v.double) $"),
        ("|x|", "$ lr(|x|) $"),
        (r"\lvert x\rvert", "$ lr(|x|) $"),
        (r"\vert{}x\vert{}", "$ lr(|x|) $"),
        (r"\left|x\right|", "$ lr(|x|) $"),
        (r"\max_t |f(t)|", "$ max_t lr(|f ( t )|) $"),
        (r"a\!b", "$ a b $"),
    ],
)
def test_norms_and_absolute_values_become_fences(formula, shown):
    assert typst_of(formula).replace(r"\(", "(").replace(r"\)", ")") == shown


@pytest.mark.parametrize(
    "formula", [r"\{x \mid x > 0\}", "P(a|b)+P(c|d)", r"\bigl|x\bigr|", r"\left.f\right|_{x}"]
)
def test_bars_that_close_nothing_are_left_alone(formula):
    assert tex.for_typst(formula)[0] == formula


def test_a_tag_is_taken_out_and_told():
    assert tex.for_typst(r"x = 1 \tag{2.3}") == ("x = 1 ", "2.3")
    assert tex.for_typst("x = 1") == ("x = 1", None)


def test_the_columns_of_cases_are_set_apart():
    assert r"1 &\quad t < 1" in tex.for_typst(r"\begin{cases}1 & t < 1\\0 & t > 1\end{cases}")[0]


@given(st.text(alphabet=r"x|{}()\a_ &", max_size=12))
def test_rewriting_keeps_braces_as_they_were(formula):
    plain, _ = tex.for_typst(formula)
    assert [c for c in plain if c in "{}"] == [c for c in formula if c in "{}"]


@pytest.mark.parametrize(
    ("latex", "shown"),
    [
        (r"$\displaystyle x^{2}$", "$$x^{2}$$"),
        ("$$x$$", "$$x$$"),
        (r"\[x\]", "$$x$$"),
        ("$x$\n", "$$x$$"),
        ("$a\n\n+ b$", "$$a + b$$"),
    ],
)
def test_an_output_is_one_display_formula(latex, shown):
    assert tex.of_output(latex) == shown


def test_an_environment_that_stands_alone_is_put_between_dollars_once():
    alone = "\\begin{align*}\na &= b\\\\\nc &= d\n\\end{align*}"
    assert tex.display_blocks(f"so\n\n{alone}\n\nthus") == f"so\n\n$${alone}$$\n\nthus"
    for kept in (f"$$\n{alone}\n$$", f"```\n{alone}\n```", "plain \\begin{align} in a line"):
        assert tex.display_blocks(kept) == kept


@pytest.mark.slow
def test_every_formula_of_the_ledger_can_be_set(tmp_path):
    import typst

    written = {f for e in ledger.entries() for f in (e.printed_latex, e.derived_latex) if f}
    assert any(r"\cap" in formula for formula in written)
    formulas = "\n\n".join(f"$${tex.for_typst(formula)[0]}$$" for formula in sorted(written))
    template = (ASSETS / "report.typ").read_text(encoding="utf-8")
    names = [line for line in template.splitlines() if line.startswith("#let sect")]
    page = tmp_path / "formulas.typ"
    page.write_text("\n".join([*names, tree.run(["-f", "markdown", "-t", "typst"], formulas)]))
    assert typst.compile(str(page)).startswith(b"%PDF")
