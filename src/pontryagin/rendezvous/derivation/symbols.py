"""Symbols with a star: plain names in programs, the paper's in print.

The name is what generated source and functions call the argument; a formula shows the star.
"""

import sympy as sp

TEX = {
    "p_star": "p^*",
    "c_star": "c^*",
    "e_star": "e^*",
    "phi": r"\varphi^*",
    "Phi": r"\Phi^*",
    "C_phi": r"C_\varphi",
}


class Symbol(sp.Symbol):
    """A symbol of the target; SymPy sorts by the class's name, and so keeps the order of plain ones.

    Examples
    --------
    >>> sp.latex(Symbol("p_star", positive=True) / 2), str(Symbol("p_star"))
    ('\\\\frac{p^*}{2}', 'p_star')
    """

    __slots__ = ()

    def _latex(self, printer: object) -> str:
        return TEX[self.name]
