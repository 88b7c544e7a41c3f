"""Symbols with plain names in programs and the paper's in print: with a star, or Greek.

The name is what generated source and functions call the argument; a formula shows `TEX`.
"""

import sympy as sp

TEX = {
    "p_star": "p^*",
    "c_star": "c^*",
    "e_star": "e^*",
    "phi": r"\varphi^*",
    "Phi": r"\Phi^*",
    "C_phi": r"C_\varphi",
    "|nu|": r"|\nu|",
}


class Symbol(sp.Symbol):
    """A symbol that prints as `TEX` has it.

    SymPy sorts by the name of the class: by this one it sorts as among plain symbols.

    Examples
    --------
    >>> sp.latex(Symbol("p_star", positive=True) / 2), str(Symbol("p_star"))
    ('\\\\frac{p^*}{2}', 'p_star')
    """

    __slots__ = ()

    def _latex(self, printer: object) -> str:
        return TEX[self.name]
