r"""Formulas that both renderers understand: MathJax reads TeX whole, typst through pandoc's conversion.

What pandoc converts to something that looks wrong is rewritten here; what it cannot convert fails the build.
"""

import re
from itertools import accumulate

_FENCED = {r"\lvert": r"\left|", r"\rvert": r"\right|", r"\overset": r"\stackrel"}
_NORM = re.compile(r"\\left\s*\\(?:lVert|Vert|\|)|\\right\s*\\(?:rVert|Vert|\|)")
_BARE_NORM = re.compile(r"(?:\\\||\\Vert\b\s*)(.+?)(?:\\\||\\Vert\b)")
_SIZED = "".join(
    rf"(?<!\\{c})" for c in ("", "left", "right", "middle", "big", "bigl", "bigr", "Big", "Bigl", "Bigr")
)
_BARE_BARS = re.compile(
    _SIZED + r"\|((?:[^|&\\]|\\(?!left\b|right\b|middle\b|mid\b|[bB]ig))*?)" + _SIZED + r"\|"
)
_ROWS = re.compile(r"\\begin\{(cases|array)\}(\{[^}]*\})?(.*?)\\end\{\1\}", re.DOTALL)
_AMS_BLOCK = re.compile(
    r"^(\\begin\{(align|equation|gather|multline)(\*?)\}.*?\\end\{\2\3\})", re.DOTALL | re.MULTILINE
)


def for_typst(formula: str) -> tuple[str, str | None]:
    r"""A formula as pandoc's typst writer takes it, and the number it is tagged with.

    Parameters
    ----------
    formula : str
        TeX without the dollar signs.

    Returns
    -------
    formula : str
        Norms and absolute values as fences, columns set apart, no negative space.
    tag : str or None
        Content of ``\tag{...}``.

    Examples
    --------
    >>> for_typst(r"\|u\|_\infty \le |c_1| \tag{2.3}")
    ('\\lVert u\\rVert_\\infty \\le \\left|c_1\\right| ', '2.3')
    """
    tag = re.search(r"\\tag\{([^}]*)\}", formula)
    plain = re.sub(r"\\tag\{[^}]*\}|\\!|\\notag\b|\\nonumber\b", "", formula)
    plain = re.sub(r"\\vert\b\s*(?:\{\})?", "|", plain)
    plain = _NORM.sub(lambda fence: r"\lVert " if fence[0].startswith(r"\left") else r"\rVert ", plain)
    plain = _BARE_NORM.sub(r"\\lVert \1\\rVert", plain)
    plain = re.sub(r"\\(?:lvert|rvert|overset)(?![a-zA-Z])", lambda written: _FENCED[written[0]], plain)
    plain = _BARE_BARS.sub(_absolute_value, plain)
    return _ROWS.sub(_spread_columns, plain), tag[1] if tag else None


def display_blocks(markdown: str) -> str:
    r"""Put AMS environments that stand alone in a text between ``$$``, where both renderers look.

    Examples
    --------
    >>> display_blocks("so\n\n\\begin{align}a &= b\\end{align}\n")
    'so\n\n$$\\begin{align}a &= b\\end{align}$$\n'
    """
    parts = re.split(r"(\$\$.*?\$\$|```.*?```)", markdown, flags=re.DOTALL)
    return "".join(p if p.startswith(("$$", "```")) else _AMS_BLOCK.sub(r"$$\1$$", p) for p in parts)


def of_output(latex: str) -> str:
    r"""A ``text/latex`` output, as SymPy and IPython write it, as a display formula.

    Examples
    --------
    >>> of_output(r"$\displaystyle x^{2}$")
    '$$x^{2}$$'
    """
    formula = latex.strip()
    for opening, closing in (("$$", "$$"), ("$", "$"), (r"\[", r"\]")):
        if formula.startswith(opening) and formula.endswith(closing) and len(formula) > len(opening):
            formula = formula[len(opening) : -len(closing)].strip()
            break
    formula = formula.removeprefix(r"\displaystyle").strip()
    return f"$${' '.join(line for line in formula.splitlines() if line.strip())}$$"


def _absolute_value(bars: re.Match[str]) -> str:
    inside = bars[1]
    return rf"\left|{inside}\right|" if inside.strip() and _is_closed(inside) else bars[0]


def _is_closed(part: str) -> bool:
    for opening, closing in ("{}", "()"):
        depth = [0, *accumulate((c == opening) - (c == closing) for c in part)]
        if min(depth) < 0 or depth[-1]:
            return False
    return True


def _spread_columns(rows: re.Match[str]) -> str:
    environment = "matrix" if rows[1] == "array" else rows[1]
    body = re.sub(r"(?<!\\)&\s*", r"&\\quad ", rows[3]) if rows[1] == "cases" else rows[3]
    return rf"\begin{{{environment}}}{body}\end{{{environment}}}"
