"""Symbols that have a plain name in generated source and the paper's name in print.

A symbol's name is that of the argument in generated source and functions; a formula shows its entry in `TEX`.
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


class Symbol(sp.Symbol):  # type: ignore[misc]  # SymPy has no types.
    """A symbol that prints as given in `TEX`.

    SymPy orders expressions by the name of the class; with this name these symbols are ordered among the
    plain ones.

    Examples
    --------
    >>> sp.latex(Symbol("p_star", positive=True) / 2), str(Symbol("p_star"))
    ('\\\\frac{p^*}{2}', 'p_star')
    """

    __slots__ = ()

    def _latex(self, printer: object) -> str:
        return TEX[self.name]
